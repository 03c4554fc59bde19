"""The usual mistakes of worked solutions, and the answers that each of them leads to in a calculation run again.

Every mistake changes a line of the solution, a function or a given number; all that follows is calculated with it, as
on a student's sheet.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial

from linkwright.core.outputs import Output
from linkwright.equations.terms import APPLY, TWO, ZERO, Term
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.worked_solutions.solution import Worked, worked

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


RPM = 2.0 * math.pi / 60.0
#: Off the middle of its link by this share of its length, a mass centre can be measured from the wrong end.
OFF = 1e-6


@dataclass(frozen=True)
class Consequence:
    """What a mistake leads to: its name, where it was made, and all results with it (angles in degrees)."""

    mistake: str
    where: str
    values: Values


class Sheet:
    """The solution of one position of a mechanism, as it is calculated on paper."""

    def __init__(self, mechanism: Mechanism, at: float) -> None:
        self.mechanism, self.at = mechanism, at
        self.lines = _lines(mechanism, at)
        self.evaluate = Calculation(self.lines).values
        self.values = self.evaluate()

    def consequences(self) -> Iterator[Consequence]:
        """The answers of every usual mistake, at every place where it can be made."""
        for name, make in MISTAKES.items():
            for where, values in make(self):
                if values != self.values:
                    yield Consequence(name, where, values)


def _lines(mechanism: Mechanism, at: float) -> tuple[Line, ...]:
    """The equations of the position that the cycle passes at an input."""
    motion, index = passed(mechanism, at)
    source = solve_forces(motion) if mechanism.has_loads else motion
    return lines_of(worked(source, index))


def passed(mechanism: Mechanism, at: float) -> tuple[Motion, int]:
    """A motion that passes an input on the way of its cycle, and the index there."""
    time = float(at_inputs(mechanism, [at]).time[0])
    return solve_motion(mechanism, times=[time]), 0


Made = Iterator[tuple[str, Values]]


def degrees_for_radians(sheet: Sheet) -> Made:
    """The input's degrees are put into the functions as radians; or an angle is answered in radians."""
    q = next((line.result for line in sheet.lines if line.result.plain == "q"), None)
    if q is not None and q.degrees:
        yield "q", sheet.evaluate(data={"q": math.degrees(q.amount)})
    radians = {
        each: math.radians(value) if each.dimension == "angle" else value for each, value in sheet.values.items()
    }
    yield "answer", radians


def rpm_for_radians(sheet: Sheet) -> Made:
    """The speed in revolutions per minute is put in as if it were in radians per second."""
    driver = next(iter(sheet.mechanism.drivers.values()))
    if sheet.mechanism.joints[driver.joint].coordinate == "turn":
        rate = next((line.result.amount for line in sheet.lines if line.result.plain == "q'"), 0.0)
        yield "q'", sheet.evaluate(data={"q'": rate / RPM})


def wrong_assembly_mode(sheet: Sheet) -> Made:
    """The other root of a group."""
    for group in dict.fromkeys(line.group for line in sheet.lines if line.result.plain == "ρ"):
        start = next(i for i, line in enumerate(sheet.lines) if line.group == group and line.result.plain == "ρ")

        def change(number: int, _: Term, formula: Term, group: str = group, start: int = start) -> Term:
            line = sheet.lines[number]
            return formula.replaced(_negated("ρ")) if line.group == group and number > start else formula

        yield group, sheet.evaluate(change)


def _negated(name: str) -> Callable[[Term], Term | None]:
    return lambda term: -term if term.op == "symbol" and term.plain == name else None


def missing_parenthesis(sheet: Sheet) -> Made:
    """Of a quotient only the last term is divided, or only the first factor divides; in one line of the solution."""
    for number, line in enumerate(sheet.lines):
        for wrong in _slips(line.formula):
            yield line.result.plain, sheet.evaluate(_only(number, wrong))
    yield from _pairs(sheet)


def _pairs(sheet: Sheet) -> Made:
    """The same mistake in both coordinates of a point."""
    for number, line in enumerate(sheet.lines[:-1]):
        follower = sheet.lines[number + 1]
        if (
            line.result.plain[1:] != follower.result.plain[1:]
            and line.result.plain[:-1] != follower.result.plain[:-1]
        ):
            continue
        for first, second in zip(_slips(line.formula), _slips(follower.formula), strict=False):

            def change(k: int, _: Term, formula: Term, n: int = number, a: Term = first, b: Term = second) -> Term:
                return a if k == n else b if k == n + 1 else formula

            yield f"{line.result.plain}, {follower.result.plain}", sheet.evaluate(change)


def _only(number: int, wrong: Term) -> Change:
    return lambda k, _, formula: wrong if k == number else formula


def _slips(formula: Term) -> Iterator[Term]:
    """A formula with the parentheses of one of its quotients left out, above or below the line, or of one factor."""
    for product in _parts(formula, "product"):
        for place, factor in enumerate(product.args):
            if place and factor.op == "sum" and len(factor.args) > 1:
                head = Term("product", (*product.args[:place], factor.args[0]))
                rest = zip(factor.args[1:], factor.signs[1:], strict=True)
                tail = [Term("product", (last, *product.args[place + 1 :])) for last, _ in rest]
                signs = (1, *factor.signs[1:])
                yield formula.replaced(_put(product, Term("sum", (head, *tail), signs)))
    for quotient in _parts(formula, "quotient"):
        above, below = quotient.args
        if above.op == "sum" and len(above.args) > 1:
            yield from (formula.replaced(_put(quotient, wrong)) for wrong in _undivided(above, below))
        if below.op == "product":
            first = Term("quotient", (above, below.args[0]))
            yield formula.replaced(_put(quotient, Term("product", (first, *below.args[1:]))))


def _undivided(above: Term, below: Term) -> Iterator[Term]:
    """Of a sum only the last or only the first term divided, the others with the sign of either way to write it."""
    for divided in (len(above.args) - 1, 0):
        rest = [i for i in range(len(above.args)) if i != divided]
        part = Term("quotient", (above.args[divided], below))
        others = tuple(above.args[i] for i in rest)
        for sense in (1, -1):
            signs = tuple(sense * above.signs[i] for i in rest)
            yield Term("sum", (*others, part), (*signs, above.signs[divided]))


def _put(old: Term, new: Term) -> Callable[[Term], Term | None]:
    return lambda term: new if term is old else None


def _parts(term: Term, operation: str) -> Iterator[Term]:
    """All parts of a term that are one operation."""
    if term.op == operation:
        yield term
    for each in term.args:
        yield from _parts(each, operation)


def arctangent_quadrant(sheet: Sheet) -> Made:
    """arctan(y/x) without regard to the signs, so between -90° and 90°: in all lines, or in one."""

    def principal(_: Term, values: list[float]) -> float:
        return math.degrees(math.atan(values[0] / values[1])) if values[1] else math.copysign(90.0, values[0])

    yield "", sheet.evaluate(functions={"atan2": principal})
    for number, line in enumerate(sheet.lines):
        if line.formula.op == "atan2":
            y, x = line.formula.args
            wrong = Term("atan2", (y / x, Term("number", amount=1.0)))
            yield line.result.plain, sheet.evaluate(_only(number, wrong))


def inertia_couple_sign(sheet: Sheet) -> Made:
    """The inertia couples are taken along the angular accelerations: of all links, or of one."""
    places = [i for i, line in enumerate(sheet.lines) if line.result.plain.startswith("M_J") and not line.is_given]

    for chosen in dict.fromkeys((tuple(places), *((place,) for place in places))):
        where = ", ".join(sheet.lines[place].result.plain for place in chosen)
        yield where, sheet.evaluate(partial(_reversed, chosen))


def _reversed(chosen: tuple[int, ...], number: int, _: Term, formula: Term) -> Term:
    return -formula if number in chosen else formula


def missing_coriolis(sheet: Sheet) -> Made:
    """The Coriolis accelerations 2 ω s' are left out."""

    def coriolis(term: Term) -> Term | None:
        if term.op != "product" or TWO not in term.args:
            return None
        names = [each.plain for each in term.args if each.op == "symbol"]
        slides = any(name.startswith("s'") and not name.startswith("s''") for name in names)
        return ZERO if slides and any(name.startswith("ω") for name in names) else None

    yield "", sheet.evaluate(lambda _, __, formula: formula.replaced(coriolis))


def mass_centre_wrong_end(sheet: Sheet) -> Made:
    """The mass centre's distance is measured from the link's other end: of one link, or of all."""
    turned = {}
    for name, link in sheet.mechanism.links.items():
        if link.mass and link.mass_centre is not None and len(link.points) > 1:
            (ax, ay), (bx, by) = list(link.points.values())[:2]
            x, y = link.centre
            moved = (ax + bx - x, ay + by - y)
            if math.dist(moved, (x, y)) > OFF * math.dist((ax, ay), (bx, by)):
                turned[name] = replace(link, mass_centre=moved)
    for names in dict.fromkeys([*((name,) for name in turned), tuple(turned)]):
        if names:
            links = {**sheet.mechanism.links, **{name: turned[name] for name in names}}
            yield (", ".join(names), Calculation(_lines(replace(sheet.mechanism, links=links), sheet.at)).values())


MISTAKES: dict[str, Callable[[Sheet], Made]] = {
    make.__name__: make
    for make in (
        degrees_for_radians,
        wrong_assembly_mode,
        missing_parenthesis,
        arctangent_quadrant,
        inertia_couple_sign,
        missing_coriolis,
        mass_centre_wrong_end,
        rpm_for_radians,
    )
}
