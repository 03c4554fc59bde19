"""A program laid out for arrays of one shape: a list of calls on buffers that stay."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Floats
from linkwright.formula.functions import FUNCTIONS
from linkwright.formula.lines import Lines
from linkwright.formula.registers import NUMBER, ROW, TRUTH, Registers
from linkwright.formula.table import Table

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
