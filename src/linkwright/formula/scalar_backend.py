"""Evaluation of one design at one position on Python floats."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

from linkwright.formula.operations import FUNCTIONS
from linkwright.formula.program import Line, Lines, Program
from linkwright.formula.table import Tables, tables_in_order

#: (function, line to fill, first argument, second argument); one form for all, as a loop likes it.
Step = tuple[Callable[[Any, Any], Any], int, int, int]


def _divide(a: float, b: float) -> float:
    if b != 0.0:
        return a / b
    if a == 0.0 or a != a:
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def _both(a: bool, b: bool) -> bool:
    return a and b


def _either(a: bool, b: bool) -> bool:
    return a or b


def _pair(a: float, b: float) -> tuple[float, float]:
    return a, b


def _pick(condition: bool, pair: tuple[float, float]) -> float:
    return pair[0] if condition else pair[1]


def _of_one(function: Callable[[Any], Any]) -> Callable[[Any, Any], Any]:
    return lambda x, _: function(x)


def _lookup(order: int) -> Callable[[Any, Any], Any]:
    return lambda x, table: float(table(x, order))


_PLAIN: dict[str, Callable[[Any, Any], Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "less": operator.lt,
    "less_equal": operator.le,
    "and": _both,
    "or": _either,
    "not": _of_one(operator.not_),
    "number": _of_one(float),
    "truth": _of_one(bool),
}
_CAREFUL = _PLAIN | {
    op: _of_one(function.value) if len(function.slopes) == 1 else function.value for op, function in FUNCTIONS.items()
}
_QUICK = _CAREFUL | {
    "div": operator.truediv,
    "sqrt": _of_one(math.sqrt),
    "sin": _of_one(math.sin),
    "cos": _of_one(math.cos),
}
_CAREFUL["div"] = _divide


def start_values(lines: Sequence[Line]) -> list[Any]:
    """Room for the values of the lines, constants filled in, and two places of :class:`LineRunner`.

    The tables that are looked up, in their order, come behind.
    """
    return [*(line.constant for line in lines), -1.0, None]


class LineRunner:
    """Evaluates chosen lines in place on a list of values (see :func:`start_values`).

    Division by zero gives an infinity or NaN and the root of a negative number NaN, as in
    IEEE 754: where Python would raise, the lines are evaluated again with careful functions.
    """

    def __init__(self, lines: Sequence[Line], chosen: Sequence[int]) -> None:
        self._quick = _steps(_QUICK, lines, chosen)
        self._careful = _steps(_CAREFUL, lines, chosen)

    def run(self, values: list[Any]) -> None:
        """Fill the chosen lines of ``values``."""
        try:
            for function, index, a, b in self._quick:
                values[index] = function(values[a], values[b])
        except (ZeroDivisionError, ValueError):
            for function, index, a, b in self._careful:
                values[index] = function(values[a], values[b])


def _steps(
    functions: dict[str, Callable[[Any, Any], Any]], lines: Sequence[Line], chosen: Sequence[int]
) -> list[Step]:
    minus_one, pair = len(lines), len(lines) + 1
    steps: list[Step] = []
    for index in chosen:
        line = lines[index]
        if line.op == "select":
            steps.append((_pair, pair, line.args[1], line.args[2]))
            steps.append((_pick, index, line.args[0], pair))
        elif line.op == "lookup":
            steps.append((_lookup(int(line.constant)), index, line.args[0], pair + 1 + line.place))
        elif line.op == "neg":
            steps.append((operator.mul, index, line.args[0], minus_one))
        else:
            steps.append((functions[line.op], index, line.args[0], line.args[-1]))
    return steps


class ScalarProgram:
    """A program for one design and one position at a time, as an iteration needs it.

    The lines that differ from design to design only are evaluated again only when the
    parameters change. May be used from several threads. ``tables``: those that the program looks up.
    Raises ValueError for missing ones.
    """

    def __init__(self, program: Program, tables: Tables | None = None) -> None:
        self.program = program
        self.lines = Lines.of(program)
        lines = self.lines.lines
        self._start = [*start_values(lines), *tables_in_order(program.tables, tables)]
        self._design = LineRunner(lines, self.lines.design_lines())
        self._position = LineRunner(lines, [i for i, x in enumerate(lines) if x.varies and x.is_operation])
        self._inputs = {
            op: [i for i, line in enumerate(lines) if line.op == op] for op in ("parameter", "position", "field")
        }
        self._prepared: tuple[tuple[float, ...] | None, list[Any]] = (None, [])

    def step(
        self, parameters: Sequence[float], positions: Sequence[float], fields: Sequence[float] = ()
    ) -> list[float]:
        """Outputs at one position.

        All arguments in the order of ``program.parameters``, ``.positions`` and ``.fields``, as Python floats. Truth
        values among the outputs are 1.0 or 0.0. Raises ValueError where a number of inputs is wrong.
        """
        values = self._design_values(parameters)
        self._put(values, "position", positions)
        self._put(values, "field", fields)
        self._position.run(values)
        return [float(values[i]) for i in self.lines.outputs]

    def of_design(self, parameters: Sequence[float]) -> Callable[[Sequence[float]], list[float]]:
        """Outputs of one design from the inputs per position, of programs without fields."""
        known, places, outputs = list(self._start), self._inputs["position"], self.lines.outputs
        for index, value in zip(self._inputs["parameter"], parameters, strict=True):
            known[index] = value
        self._design.run(known)

        def at(positions: Sequence[float]) -> list[float]:
            values = known.copy()
            for index, value in zip(places, positions, strict=True):
                values[index] = value
            self._position.run(values)
            return [float(values[i]) for i in outputs]

        return at

    def _design_values(self, parameters: Sequence[float]) -> list[Any]:
        known, values = self._prepared
        if parameters is known:
            return list(values)
        numbers = tuple(float(p) for p in parameters)
        if numbers != known:
            values = list(self._start)
            self._put(values, "parameter", numbers)
            self._design.run(values)
            self._prepared = numbers, values
        return list(values)

    def _put(self, values: list[Any], op: str, numbers: Sequence[float]) -> None:
        places = self._inputs[op]
        if len(places) != len(numbers):
            raise ValueError(f"the program has {len(places)} {op} inputs, found {len(numbers)}")
        for index, value in zip(places, numbers, strict=True):
            values[index] = float(value)
