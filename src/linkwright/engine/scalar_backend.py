"""Evaluation of one design at one position on Python floats."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

from linkwright.engine.lines import Line, Lines
from linkwright.engine.program import Program

#: (function, line to fill, first, second, third argument); -1 where there is no argument.
Step = tuple[Callable[..., Any], int, int, int, int]


def _divide(a: float, b: float) -> float:
    if b != 0.0:
        return a / b
    if a == 0.0 or a != a:
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def _root(x: float) -> float:
    return math.nan if x < 0.0 else math.sqrt(x)


def _sine(x: float) -> float:
    return math.nan if math.isinf(x) else math.sin(x)


def _cosine(x: float) -> float:
    return math.nan if math.isinf(x) else math.cos(x)


def _choose(condition: bool, a: float, b: float) -> float:
    return a if condition else b


def _both(a: bool, b: bool) -> bool:
    return a and b


def _either(a: bool, b: bool) -> bool:
    return a or b


_QUICK: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
    "neg": operator.neg,
    "sqrt": math.sqrt,
    "abs": abs,
    "sin": math.sin,
    "cos": math.cos,
    "less": operator.lt,
    "less_equal": operator.le,
    "and": _both,
    "or": _either,
    "not": operator.not_,
    "select": _choose,
    "number": float,
    "truth": bool,
}
_CAREFUL = _QUICK | {"div": _divide, "sqrt": _root, "sin": _sine, "cos": _cosine}


class LineRunner:
    """Evaluates chosen lines in place on a list of values.

    Division by zero gives an infinity or NaN and the root of a negative number NaN, as in
    IEEE 754: where Python would raise, the lines are evaluated again with careful functions.
    """

    def __init__(self, lines: Sequence[Line], chosen: Sequence[int]) -> None:
        self._quick = [_step(_QUICK, lines[i], i) for i in chosen]
        self._careful = [_step(_CAREFUL, lines[i], i) for i in chosen]

    def run(self, values: list[Any]) -> None:
        """Fill the chosen lines of ``values``."""
        try:
            _evaluate(self._quick, values)
        except (ZeroDivisionError, ValueError):
            _evaluate(self._careful, values)


def _step(functions: dict[str, Callable[..., Any]], line: Line, index: int) -> Step:
    first, second, third = (*line.args, -1, -1)[:3]
    return functions[line.op], index, first, second, third


def _evaluate(steps: list[Step], values: list[Any]) -> None:
    for function, index, a, b, c in steps:
        if b < 0:
            values[index] = function(values[a])
        elif c < 0:
            values[index] = function(values[a], values[b])
        else:
            values[index] = values[b] if values[a] else values[c]


class ScalarProgram:
    """A program for one design and one position at a time, as an iteration needs it.

    The lines that differ from design to design only are evaluated again only when the
    parameters change.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self.lines = Lines.of(program)
        lines = self.lines.lines
        self._start = [line.constant for line in lines]
        self._design = LineRunner(lines, self.lines.design_lines())
        self._position = LineRunner(lines, [i for i, x in enumerate(lines) if x.varies and x.is_operation])
        self._inputs = {
            op: [i for i, line in enumerate(lines) if line.op == op]
            for op in ("parameter", "position", "field", "state")
        }
        self._parameters: tuple[float, ...] | None = None
        self._prepared: list[Any] = []

    def step(
        self,
        parameters: Sequence[float],
        positions: Sequence[float],
        states: Sequence[float] = (),
        fields: Sequence[float] = (),
    ) -> tuple[list[float], list[float]]:
        """Outputs and next states at one position.

        All arguments in the order of ``program.parameters``, ``.positions``, ``.states`` and
        ``.fields``, as Python floats. Truth values among the outputs are 1.0 or 0.0.
        Raises ValueError where a number of inputs is wrong.
        """
        values = self._design_values(parameters)
        self._put(values, "position", positions)
        self._put(values, "field", fields)
        self._put(values, "state", states)
        self._position.run(values)
        return (
            [float(values[i]) for i in self.lines.outputs],
            [values[i] for i in self.lines.carried],
        )

    def _design_values(self, parameters: Sequence[float]) -> list[Any]:
        given = tuple(float(p) for p in parameters)
        if given != self._parameters:
            values: list[Any] = list(self._start)
            self._put(values, "parameter", given)
            self._design.run(values)
            self._parameters, self._prepared = given, values
        return list(self._prepared)

    def _put(self, values: list[Any], op: str, given: Sequence[float]) -> None:
        places = self._inputs[op]
        if len(places) != len(given):
            raise ValueError(f"the program has {len(places)} {op} inputs, but {len(given)} are given")
        for index, value in zip(places, given, strict=True):
            values[index] = float(value)
