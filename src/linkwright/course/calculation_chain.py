"""A worked solution as a calculation that can be run again, with a formula changed on the way."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.worked.solution import Worked
from linkwright.worked.terms import APPLY, Term

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
    def given(self) -> bool:
        """Whether it is only told, not reckoned."""
        return self.formula is self.result


def lines_of(solution: Worked) -> tuple[Line, ...]:
    """The equations of a worked solution in their order."""
    return tuple(
        Line(*equation.terms, step.group, equation.output)
        for step in solution.steps
        for equation in step.equations
        if equation.terms is not None
    )


def run(
    lines: tuple[Line, ...],
    change: Change | None = None,
    functions: Mapping[str, Function] | None = None,
    given: Mapping[str, float] | None = None,
) -> Values:
    """Results by output (angles in degrees), every line reckoned from those before it.

    ``change``: puts another formula into lines; ``functions``: other meanings of ``cos``, ``sin``, ``atan2``;
    ``given``: other values of symbols that are only told. A value that a formula does not have (a root of a negative
    number) is NaN, and so is what follows from it.
    """
    known: dict[str, float] = dict(given or {})
    found: Values = {}
    for number, line in enumerate(lines):
        name = line.result.plain
        if line.given:
            value = known.get(name, line.result.amount)
        else:
            formula = line.formula if change is None else change(number, line.result, line.formula)
            value = reckon(formula, known, functions or {})
        known[name] = value
        if line.output:
            found[line.output] = value
    return found


def reckon(term: Term, known: Mapping[str, float], functions: Mapping[str, Function]) -> float:
    """A term with the values that are known; symbols that are not have their own."""
    if not term.args:
        return known.get(term.plain, term.amount) if term.op == "symbol" else term.amount
    values = [reckon(each, known, functions) for each in term.args]
    try:
        if term.op in functions:
            return functions[term.op](term, values)
        return APPLY[term.op](term, values)
    except (ValueError, ZeroDivisionError, OverflowError):
        return math.nan


def with_terms(term: Term, replace: Callable[[Term], Term | None]) -> Term:
    """A term with parts of it replaced, from the outside in."""
    new = replace(term)
    if new is not None:
        return new
    if not term.args:
        return term
    return Term(term.op, tuple(with_terms(each, replace) for each in term.args), term.signs)
