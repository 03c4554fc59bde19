"""A worked solution as a calculation that can be run again, with a formula changed on the way."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

from linkwright.core.outputs import Output
from linkwright.equations.terms import APPLY, Term
from linkwright.worked_solutions.solution import Worked

#: Changes the formula of one line: its number, its result, its formula.
Change = Callable[[int, Term, Term], Term]
Function = Callable[[Term, list[float]], float]
Values = dict[Output, float]


@dataclass(frozen=True)
class Line:
    """One equation: its result (a symbol), its formula, its Assur group, and which of the outputs it is."""

    result: Term
    formula: Term
    group: str
    output: Output | None

    @property
    def is_given(self) -> bool:
        """Whether it is given data, not calculated."""
        return self.formula is self.result

    @cached_property
    def symbols(self) -> frozenset[str]:
        """Names of the symbols in its formula."""
        return frozenset(each.plain for each in self.formula.leaves() if each.op == "symbol")


def lines_of(solution: Worked) -> tuple[Line, ...]:
    """The equations of a worked solution in their order."""
    return tuple(
        Line(*equation.terms, step.group, equation.output)
        for step in solution.steps
        for equation in step.equations
        if equation.terms is not None
    )


@dataclass(frozen=True)
class Calculation:
    """Equations that are evaluated one after the other."""

    lines: tuple[Line, ...]

    def values(
        self,
        change: Change | None = None,
        functions: Mapping[str, Function] | None = None,
        data: Mapping[str, float] | None = None,
    ) -> Values:
        """Results by output (angles in degrees), every line evaluated from those before it.

        ``change``: puts another formula into lines; ``functions``: other meanings of ``cos``, ``sin``, ``atan2``;
        ``data``: other values of given symbols. A value that a formula does not have (a root of a
        negative number) is NaN, and so is what follows from it.
        """
        every = self._evaluated(change, functions, data)
        return {line.output: value for line, value in zip(self.lines, every, strict=True) if line.output}

    @cached_property
    def _right(self) -> list[float]:
        return self._evaluated(functions={})

    def _evaluated(
        self,
        change: Change | None = None,
        functions: Mapping[str, Function] | None = None,
        data: Mapping[str, float] | None = None,
    ) -> list[float]:
        """Values of all lines; where functions mean what they do, only what a change reaches is evaluated anew."""
        known, moved, found = dict(data or {}), set(data or ()), list[float]()
        right = self._right if functions is None else [math.nan] * len(self.lines)
        apply = {**APPLY, **(functions or {})}

        def leaf(term: Term) -> float:
            return known.get(term.plain, term.amount) if term.op == "symbol" else term.amount

        for number, (line, value) in enumerate(zip(self.lines, right, strict=True)):
            formula = line.formula if change is None else change(number, line.result, line.formula)
            if line.is_given:
                value = leaf(line.result)
            elif functions is not None or formula is not line.formula or not moved.isdisjoint(line.symbols):
                value = formula.evaluate(leaf, apply)
            known[line.result.plain] = value
            (moved.discard if value == right[number] else moved.add)(line.result.plain)
            found.append(value)
        return found
