"""Evaluation by NumPy: the reference, always there; a program laid out as calls on buffers that stay."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.core.arrays import Floats
from linkwright.formula.operations import FUNCTIONS
from linkwright.formula.program import Lines, Program
from linkwright.formula.recently_made import Recent
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


Call = tuple[Callable[..., Any], tuple[Any, ...]]

UFUNCS: dict[str, Callable[..., Any]] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "neg": np.negative,
    "less": np.less,
    "less_equal": np.less_equal,
    "and": np.logical_and,
    "or": np.logical_or,
    "not": np.logical_not,
} | {op: getattr(np, function.ufunc) for op, function in FUNCTIONS.items()}
_ZERO = np.zeros(())


class BoundPlan:
    """Buffers and calls for ``designs`` designs (None: one, without an axis) and ``positions`` positions.

    Fill ``inputs[kind][place]`` (and, without an axis for the designs, the numbers of the boundary through
    :meth:`set_design`; ``numbers``: the parameters that these are for) and ``tables`` in the program's order, call
    :meth:`run`, read ``outputs`` of shape (outputs, designs, positions) or (outputs, positions).
    """

    def __init__(self, lines: Lines, registers: Registers, designs: int | None, positions: int) -> None:
        self._lines = lines
        self._single = designs is None
        self._full: tuple[int, ...] = (positions,) if designs is None else (designs, positions)
        self._shapes: dict[str, tuple[int, ...]] = {
            "parameter": () if designs is None else (designs, 1),
            "position": (positions,) if designs is None else (1, positions),
            "field": self._full,
        }
        self.outputs: Floats = np.empty((len(lines.outputs), *self._full))
        self.tables: list[Table] = []
        self.numbers: list[float] | None = None
        self.inputs: dict[str, list[Floats]] = {kind: [] for kind in self._shapes}
        self._numbers_at = [i for i in lines.boundary() if not lines.lines[i].truth]
        self._truths_at = [i for i in lines.boundary() if lines.lines[i].truth]
        self._design_numbers = np.empty(len(self._numbers_at))
        self._design_truths = np.empty(len(self._truths_at), dtype=np.bool_)
        self._design_places = {i: self._design_truths[k, ...] for k, i in enumerate(self._truths_at)} | {
            i: self._design_numbers[k, ...] for k, i in enumerate(self._numbers_at)
        }
        self._arrays = self._lay_out(registers)
        self._calls = self._calls_for([i for i, line in enumerate(lines.lines) if line.varies and line.is_operation])
        self._calls += [(np.copyto, (self.outputs[row], self._arrays[i])) for row, i in registers.copies]
        self._design_calls = [] if self._single else self._calls_for(lines.design_lines())

    def _lay_out(self, registers: Registers) -> list[NDArray[Any]]:
        """The array of every line. One object per buffer: NumPy then sees what is in place."""
        pools: dict[str, list[NDArray[Any]]] = {
            ROW: list(self.outputs),
            NUMBER: list(np.empty((registers.numbers, *self._full))),
            TRUTH: list(np.empty((registers.truths, *self._full), dtype=np.bool_)),
        }
        arrays: list[NDArray[Any]] = []
        for index, line in enumerate(self._lines.lines):
            if index in registers.places:
                kind, number = registers.places[index]
                array = pools[kind][number]
            elif line.op == "constant":
                array = np.array(line.constant)
            elif self._single and not line.varies:
                array = self._design_places.get(index, _ZERO)
            elif line.is_input:
                array = np.empty(self._shapes[line.op])
            else:
                array = np.empty(self._shapes["parameter"], dtype=np.bool_ if line.truth else np.float64)
            if line.is_input:
                self.inputs[line.op].append(array)
            arrays.append(array)
        return arrays

    def _calls_for(self, chosen: list[int]) -> list[Call]:
        calls: list[Call] = []
        for index in chosen:
            line, out = self._lines.lines[index], self._arrays[index]
            args = [self._arrays[a] for a in line.args]
            if line.op == "select":
                if out is not args[2]:
                    calls.append((np.copyto, (out, args[2])))
                calls.append((np.copyto, (out, args[1], "same_kind", args[0])))
            elif line.op == "lookup":
                calls.append((_look_up, (self.tables, line.place, int(line.constant), args[0], out)))
            elif line.op == "number":
                calls.append((np.copyto, (out, args[0])))
            elif line.op == "truth":
                calls.append((np.not_equal, (args[0], _ZERO, out)))
            else:
                calls.append((UFUNCS[line.op], (*args, out)))
        return calls

    def set_design(self, values: list[Any]) -> None:
        """Values of all lines per design, by line number (plans without an axis for the designs)."""
        if self._numbers_at:
            self._design_numbers[:] = [values[i] for i in self._numbers_at]
        if self._truths_at:
            self._design_truths[:] = [values[i] for i in self._truths_at]

    def run_design(self) -> None:
        """Evaluate the lines per design (plans with an axis for the designs)."""
        for function, args in self._design_calls:
            function(*args)

    def run(self) -> None:
        """Evaluate the lines per position and fill the outputs."""
        for function, args in self._calls:
            function(*args)


def _look_up(tables: list[Table], place: int, order: int, x: Floats, out: Floats) -> None:
    out[...] = tables[place](x, order)


#: Kinds of places: a row of the result, a number buffer, a truth buffer.
ROW, NUMBER, TRUTH = "row", "number", "truth"
Place = tuple[str, int]


@dataclass(frozen=True, slots=True)
class Registers:
    """Places of the lines that vary; numbers of buffers; result rows filled by copying."""

    places: dict[int, Place]
    numbers: int
    truths: int
    copies: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, lines: Lines) -> Registers:
        """Give every line that varies a place; an output is found where it is wanted."""
        last = _last_uses(lines)
        places: dict[int, Place] = {}
        copies: list[tuple[int, int]] = []
        for row, index in enumerate(lines.outputs):
            line = lines.lines[index]
            if line.varies and line.is_operation and not line.truth and index not in places:
                places[index] = (ROW, row)
            else:
                copies.append((row, index))
        free: dict[str, list[int]] = {NUMBER: [], TRUTH: []}
        counts = {NUMBER: 0, TRUTH: 0}
        for index, line in enumerate(lines.lines):
            if not (line.varies and line.is_operation):
                continue
            dying = {a for a in line.args if last.get(a) == index and places.get(a, (ROW, 0))[0] != ROW}
            early = {a for a in dying if line.op != "select" or a == line.args[2]}
            _release(places, free, early)
            if index not in places:
                kind = TRUTH if line.truth else NUMBER
                if free[kind]:
                    number = free[kind].pop()
                else:
                    number = counts[kind]
                    counts[kind] += 1
                places[index] = (kind, number)
            _release(places, free, dying - early)
        return cls(places, counts[NUMBER], counts[TRUTH], tuple(copies))


def _last_uses(lines: Lines) -> dict[int, int]:
    last = {a: index for index, line in enumerate(lines.lines) for a in line.args}
    last.update(dict.fromkeys(lines.outputs, len(lines.lines)))
    return last


def _release(places: dict[int, Place], free: dict[str, list[int]], indices: set[int]) -> None:
    for index in sorted(indices):
        kind, number = places[index]
        free[kind].append(number)
