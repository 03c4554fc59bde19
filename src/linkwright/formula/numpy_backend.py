"""Evaluation by NumPy: the reference, always there."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.formula.bound import BoundPlan
from linkwright.formula.lines import Lines
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.registers import Registers
from linkwright.formula.scalar_backend import LineRunner, start_values
from linkwright.formula.table import Table, Tables, tables_in_order

Arrays = Mapping[str, ArrayLike]
Source = tuple[str, tuple[str, ...], Any]

#: Numbers in one buffer of a block; all buffers of a block together stay in a core's cache.
_CACHE_NUMBERS = 120_000
_CACHED_PLANS = 6


class NumpyProgram:
    """A program evaluated over arrays of positions, for one or many designs.

    What depends on the design only is evaluated once per design. Division by zero and roots of
    negative numbers give infinities and NaN without warnings. Truth values among the outputs
    are 1.0 or 0.0. May be used from several threads.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self.lines = Lines.of(program)
        self.registers = Registers.of(self.lines)
        lines = self.lines.lines
        self._start = start_values(lines)
        self._parameter_lines = [i for i, line in enumerate(lines) if line.op == "parameter"]
        self._design = LineRunner(lines, self.lines.design_lines())
        self._own = threading.local()

    def run(
        self,
        parameters: ArrayLike,
        positions: Arrays,
        fields: Arrays | None = None,
        *,
        length: int | None = None,
        tables: Tables | None = None,
    ) -> Floats:
        """Outputs of one design, shape (outputs, n).

        ``parameters``: (parameters,) in the order of ``program.parameters``. ``positions``,
        ``fields``: one (n,) array per name; names that the program does not need are ignored.
        ``length``: n, where no input is an array. ``tables``: those that the program looks up, by name.
        Raises ValueError for missing inputs and unequal lengths.
        """
        fields = fields or {}
        n = self._length(positions, fields, length)
        plan = self._plan(None, n)
        self._set_design(plan, _numbers(parameters), tables)
        for kind, names, arrays in self._sources(positions, fields):
            for buffer, name in zip(plan.inputs[kind], names, strict=True):
                buffer[...] = arrays[name]
        with np.errstate(all="ignore"):
            plan.run()
        return plan.outputs.copy()

    def _set_design(self, plan: BoundPlan, numbers: list[float], tables: Tables | None) -> None:
        """The lines per design; those of the call before where the same numbers are passed again."""
        if numbers == plan.numbers and not self.program.tables:
            return
        plan.tables[:] = tables_in_order(self.program.tables, tables)
        values = [*self._start, *plan.tables]
        for index, value in zip(self._parameter_lines, numbers, strict=True):
            values[index] = value
        self._design.run(values)
        plan.set_design(values)
        plan.numbers = numbers

    def run_designs(
        self,
        parameters: ArrayLike,
        positions: Arrays,
        fields: Arrays | None = None,
        *,
        length: int | None = None,
        tables: Tables | None = None,
    ) -> Floats:
        """Outputs of many designs, shape (designs, outputs, n).

        ``parameters``: (designs, parameters); ``fields``: (designs, n) per name; otherwise as :meth:`run`.
        """
        table = self._table(parameters)
        n = self._length(positions, fields or {}, length)
        result = np.empty((len(table), len(self.program.outputs), n))
        for designs, columns, outputs in self.blocks(table, positions, fields, length=n, tables=tables):
            result[designs, :, columns] = outputs.transpose(1, 0, 2)
        return result

    def blocks(
        self,
        table: Floats,
        positions: Arrays,
        fields: Arrays | None = None,
        *,
        length: int | None = None,
        tables: Tables | None = None,
    ) -> Iterator[tuple[slice, slice, Floats]]:
        """Outputs block by block: (designs, positions, outputs (outputs, designs, positions)).

        Inputs as for :meth:`run_designs`. A block's outputs are overwritten by the next block.
        """
        fields = fields or {}
        n = self._length(positions, fields, length)
        found = tables_in_order(self.program.tables, tables)
        size, width = self.block(n)
        for first in range(0, len(table), size):
            part = slice(first, min(first + size, len(table)))
            sources = self._sources(positions, _cut(fields, part))
            for columns, outputs in self._columns(table[part], sources, found, n, width):
                yield part, columns, outputs

    def _columns(
        self, table: Floats, sources: list[Source], tables: list[Table], n: int, width: int
    ) -> Iterator[tuple[slice, Floats]]:
        """Some designs, ``width`` positions at a time."""
        plan: BoundPlan | None = None
        for first in range(0, n, width):
            columns = slice(first, min(first + width, n))
            previous, plan = plan, self._plan(len(table), columns.stop - first)
            with np.errstate(all="ignore"):
                if plan is not previous:
                    plan.tables[:] = tables
                    for place, parameter in enumerate(plan.inputs["parameter"]):
                        parameter[:, 0] = table[:, place]
                    plan.run_design()
                for kind, names, arrays in sources:
                    for buffer, name in zip(plan.inputs[kind], names, strict=True):
                        buffer[...] = np.asarray(arrays[name])[..., columns]
                plan.run()
            yield columns, plan.outputs

    def block(self, n: int) -> tuple[int, int]:
        """Designs and positions of one block, so that its buffers stay in the cache."""
        buffers = self.registers.numbers + len(self.program.outputs) + len(self.program.fields) + 2
        room = max(256, 4 * _CACHE_NUMBERS // buffers)
        width = min(n, room) or 1
        return max(1, room // width), width

    def _sources(self, positions: Arrays, fields: Arrays) -> list[Source]:
        sources: list[Source] = [
            ("position", self.program.positions, positions),
            ("field", self.program.fields, fields),
        ]
        for kind, names, arrays in sources:
            missing = [name for name in names if name not in arrays]
            if missing:
                raise ValueError(f"the program needs the {kind} inputs {', '.join(missing)}: give them")
        return sources

    def _length(self, positions: Arrays, fields: Arrays, length: int | None) -> int:
        lengths = {np.shape(positions[name])[-1] for name in self.program.positions if name in positions}
        lengths |= {np.shape(fields[name])[-1] for name in self.program.fields if name in fields}
        if length is not None:
            lengths.add(length)
        if not lengths:
            lengths = {np.shape(array)[-1] for array in positions.values()}
        if len(lengths) != 1:
            raise ValueError(f"inputs over the positions must have one length, but have {sorted(lengths)}")
        return int(lengths.pop())

    def _table(self, parameters: ArrayLike) -> Floats:
        table = np.asarray(parameters, dtype=np.float64)
        if table.ndim != 2 or table.shape[1] != len(self.program.parameters):
            wanted = len(self.program.parameters)
            raise ValueError(f"parameters must have the shape (designs, {wanted}), but have {table.shape}")
        return table

    def _plan(self, designs: int | None, n: int) -> BoundPlan:
        """That of this thread."""
        plans: dict[tuple[int | None, int], BoundPlan] = self._own.__dict__.setdefault("plans", {})
        key = designs, n
        if key not in plans:
            if len(plans) >= _CACHED_PLANS:
                plans.pop(next(iter(plans)))
            plans[key] = BoundPlan(self.lines, self.registers, designs, n)
        return plans[key]


def numpy_program(program: Program) -> NumpyProgram:
    """The evaluator of a program; the same one for the same program, as long as it is of use."""
    return _evaluators.get(program, None, lambda: NumpyProgram(program))


_evaluators: Recent[Program, NumpyProgram] = Recent(64)


def _numbers(parameters: ArrayLike) -> list[float]:
    return [float(p) for p in np.asarray(parameters, dtype=np.float64).ravel().tolist()]


def _cut(arrays: Arrays, part: slice) -> dict[str, Floats]:
    return {name: np.asarray(array, dtype=np.float64)[part] for name, array in arrays.items()}
