"""Higher pairs: rows of rotations and displacements, and how the forces act by the types of the pairs."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import singledispatch
from math import asin, atan, pi

from linkwright.elements import Connection, Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import NOWHERE, ZERO, Pair, Term, number, symbol, total
from linkwright.joints.base import Joint, LackingError
from linkwright.joints.belt import BeltPair
from linkwright.joints.gear import GearPair
from linkwright.joints.rack import RackPair
from linkwright.joints.rolling import RollingPair
from linkwright.mechanism.mechanism import Mechanism
from linkwright.worked_solutions.chains import ChainClosure, Closure, chain_closures
from linkwright.worked_solutions.symbols import SymbolTable

#: Radians of a degree, as formulas show it.
DEGREE = symbol("π", math.pi) / number(180.0)
Values = Callable[[str], Term]


@dataclass(frozen=True)
class Turned:
    """A rotation in the row: the link, its factor, and the free pin of the group with which it turns."""

    link: str
    factor: float
    source: TreeJoint | None


@dataclass(frozen=True)
class Slid:
    """A displacement in the row: the guide, its factor, and what it is in the group: unknown, cut, or neither."""

    guide: str
    factor: float
    source: TreeJoint | None
    cut: ChainClosure | None


@dataclass(frozen=True)
class PairClosure(Closure):
    """The row of a higher pair, scaled so that its multiplier is a force: Σ r φ + Σ m s + c = 0, in m."""

    cut: Connection
    turns: tuple[Turned, ...]
    slides: tuple[Slid, ...]
    rest: float
    book: SymbolTable
    group: Group

    @property
    def parts(self) -> tuple[Turned | Slid, ...]:
        """All that the row adds up."""
        return (*self.turns, *self.slides)

    # symbols ----------------------------------------------------------------------------------
    def arm(self, part: Turned) -> Term:
        """r: how far the pitch point moves with a link's rotation."""
        return lever(self.book, self.cut.joint, part.link, part.factor)

    def ratio(self, part: Turned, target: Turned) -> Term:
        """i: how the target turns with a link."""
        return _named(self.book, "i", self.cut.joint, part.link, -part.factor / target.factor)

    def _constant(self, letter: str, value: float, *, degrees: bool = False) -> Term:
        joint = self.cut.joint
        if value == 0.0:
            return ZERO
        return symbol(f"{letter}_{joint}", value, degrees=degrees)

    # positions --------------------------------------------------------------------------------
    def sum(self, turn: Values, slide: Values) -> Term:
        """The row itself, m; angles in degrees."""
        turned = [self.arm(part) * turn(part.link) * DEGREE for part in self.turns]
        shifts = [_times(part.factor, slide(part.guide)) for part in self.slides]
        return total([*turned, *shifts, self._constant("c", self.rest)])

    def solved_for(self, target: Turned | Slid, turn: Values, slide: Values) -> Term:
        """An angle (degrees) or a displacement from those of the others."""
        others = [part for part in self.turns if part is not target]
        shifts = [_times(part.factor, slide(part.guide)) for part in self.slides if part is not target]
        if isinstance(target, Slid):
            turned = [self.arm(part) * turn(part.link) * DEGREE for part in others]
            left = total([*turned, *shifts, self._constant("c", self.rest)])
            return _over(left, target.factor)
        found = total([self.ratio(part, target) * turn(part.link) for part in others])
        if not self.slides:
            lean = math.degrees(-self.rest / target.factor)
            return found + self._constant("β", lean, degrees=True)
        left = total([*shifts, self._constant("c", self.rest)])
        return found - left / (self.arm(target) * DEGREE)

    def rate_of(self, target: Turned | Slid, rate: Values, speed: Values) -> Term:
        """Rate (or second derivative) of one from those of the others."""
        others = [part for part in self.turns if part is not target]
        shifts = [_times(part.factor, speed(part.guide)) for part in self.slides if part is not target]
        if isinstance(target, Slid):
            return _over(total([self.arm(part) * rate(part.link) for part in others] + shifts), target.factor)
        found = total([self.ratio(part, target) * rate(part.link) for part in others])
        return found - total(shifts) / self.arm(target) if self.slides else found

    def give(self, step: Step, target: Turned | Slid | None) -> None:
        """Notes the numbers of the row: ratios and the angle of the drawing, or lever arms and a length."""
        ratios = isinstance(target, Turned)
        for part in self.turns:
            if isinstance(target, Turned) and part is not target:
                self._once(step, self.ratio(part, target), "")
            if not ratios or (self.slides and part is target):
                self._once(step, self.arm(part), "m")
        if isinstance(target, Turned) and not self.slides:
            lean = math.degrees(-self.rest / target.factor)
            self._once(step, self._constant("β", lean, degrees=True), "°")
        else:
            self._once(step, self._constant("c", self.rest), "m")

    def _once(self, step: Step, term: Term, unit: str) -> None:
        if not term.is_zero and term.plain not in self.book.introduced:
            self.book.introduced.add(term.plain)
            step.give(term, unit)

    # rates ------------------------------------------------------------------------------------
    def column(self, step: TreeJoint) -> list[Term]:
        parts = [self.arm(part) for part in self.turns if part.source == step]
        parts += [number(part.factor) for part in self.slides if part.source == step]
        for part in self.slides:
            if part.cut is not None:
                parts.append(_times(part.factor, self._along(part, part.cut.moved(step))))
        return [total(parts)]

    def known_rates(self, book: SymbolTable) -> list[Term]:
        found = [self.arm(part) * self._known(part, second=False) for part in self.turns]
        for part in self.slides:
            if part.cut is not None:
                found.append(_times(part.factor, self._along(part, part.cut.drifted(book))))
            elif part.source is None:
                found.append(_times(part.factor, book.slide(part.guide).rate))
        return [total(found)]

    def known_seconds(self, book: SymbolTable, bend: Callable[[ChainClosure], Pair]) -> list[Term]:
        found = [self.arm(part) * self._known(part, second=True) for part in self.turns]
        for part in self.slides:
            if part.cut is not None:
                found.append(_times(part.factor, self._along(part, bend(part.cut))))
            elif part.source is None:
                found.append(_times(part.factor, book.slide(part.guide).second))
        return [total(found)]

    def _along(self, part: Slid, vector: Pair) -> Term:
        return ZERO if vector == NOWHERE else self.book.slide(part.guide).along.dot(vector)

    def _known(self, part: Turned, *, second: bool) -> Term:
        """Of a link's rate what no unknown of the group gives: all of it, or what drivers add on the way."""
        book = self.book
        if part.source is None:
            return book.alpha(part.link) if second else book.omega(part.link)
        found = ZERO
        for step in self.group.path(part.link):
            if step == part.source:
                break
            if step.turns and step.driver is not None:
                rate = book.drive(step.driver)[2 if second else 1]
                own = step.child == book.mechanism.drivers[step.driver].link
                found = found + rate if own else found - rate
        return found


def pair_closures(book: SymbolTable, group: Group, chains: Sequence[ChainClosure]) -> list[PairClosure]:
    """The rows of a group's higher pairs; ``chains``: its other cuts.

    Raises:
        LackingError: a kind whose row is no sum of rotations and displacements, or that does not give it.
    """
    cut_guides = {closure.cut.joint: closure for closure in chains if closure.across is not None}
    free = {step.joint: step for step in group.unknowns if step.slides}
    found = []
    for cut in group.cuts:
        if not cut.higher:
            continue
        joint = book.mechanism.joints[cut.joint]
        rotations, slides, rest = joint.sums(book.mechanism)
        try:
            scale = contact_of(joint, book.mechanism).scale
        except LackingError:
            scale = 1.0
        turns = (Turned(k, scale * f, _source(group, k)) for k, f in rotations.items() if f and k != "frame")
        shifts = (Slid(k, scale * f, free.get(k), cut_guides.get(k)) for k, f in slides.items() if f)
        found.append(PairClosure(cut, tuple(turns), tuple(shifts), scale * rest, book, group))
    return found


def lever(book: SymbolTable, joint: str, link: str, value: float) -> Term:
    """r: the lever arm of a link in the row of a pair, m."""
    return _named(book, "r", joint, link, value)


def _named(book: SymbolTable, letter: str, joint: str, link: str, value: float) -> Term:
    n = book.numbers[link]
    return symbol(f"{letter}_{joint},{n}", value)


def closures(book: SymbolTable, group: Group) -> list[Closure]:
    """All cuts of a group, in their order."""
    chains = chain_closures(book, group)
    return sorted([*chains, *pair_closures(book, group, chains)], key=lambda c: group.cuts.index(c.cut))


def one_by_one(group: Group, rows: Sequence[PairClosure]) -> Iterator[tuple[PairClosure, Turned | Slid]]:
    """The rows in an order in which each gives one more unknown; none at all where there is no such order."""
    waiting, found = list(rows), list[tuple[PairClosure, Turned | Slid]]()
    known: set[TreeJoint] = set()
    while waiting:
        for row in waiting:
            parts = [part for part in row.parts if part.source and part.source not in known]
            if len(parts) == 1 and is_unknown(parts[0]):
                break
        else:
            return
        (target,) = parts
        assert target.source is not None
        known.add(target.source)
        waiting.remove(row)
        found.append((row, target))
    if len(found) == len(group.unknowns):
        yield from found


def is_unknown(part: Turned | Slid) -> bool:
    """Whether a part of a row is the coordinate of its joint itself."""
    if isinstance(part, Slid):
        return True
    return part.source is not None and part.source.child == part.link


def _source(group: Group, link: str) -> TreeJoint | None:
    for step in group.path(link):
        if step.free and step.turns:
            return step
    return None


def _times(factor: float, term: Term) -> Term:
    return -term if factor == -1.0 else number(factor) * term


def _over(left: Term, factor: float) -> Term:
    """-left / factor, for a factor of one without a quotient."""
    if abs(factor) == 1.0:
        return -left if factor > 0 else left
    return -left / number(factor)


@dataclass(frozen=True)
class Contact:
    """The force T of a higher pair on its first link, T being the multiplier of ``scale`` times the row of its sums.

    With the unit vector e at ``angle`` in the axes of ``link``, e⊥ left of it, and the angle ``lean`` of teeth or of
    ``strands``: force e⊥ T + e ``press`` |T| tan lean, or e⊥ T sin lean + e (``press`` |T| + 2 ``pull``) cos lean, N
    (``pull``: that each strand has without load). With the lever arm r of its first link, m, its row's factor: teeth
    touch in the point ``at`` (link, name) + r e, strands give ``at`` the couple r T, N·m.
    """

    scale: float
    link: str
    angle: float
    at: tuple[str, str]
    lean: float = 0.0
    strands: bool = False
    press: float = 0.0
    pull: float = 0.0


@singledispatch
def contact_of(joint: Joint, mechanism: Mechanism) -> Contact:
    """How the force of a higher pair acts.

    Raises:
        LackingError: nothing is registered for its kind.
    """
    raise joint.lacks("contact")


@contact_of.register
def of_rolling(joint: RollingPair, mechanism: Mechanism) -> Contact:
    """That of two wheels which roll on each other."""
    _, other = joint.arms(mechanism)
    angle, at = cmath.phase(joint.line(mechanism)), (joint.carrier, joint.centres[0])
    return Contact(-other, joint.carrier, angle, at, press=joint.sense)


@contact_of.register
def _(joint: GearPair, mechanism: Mechanism) -> Contact:
    return replace(of_rolling(joint, mechanism), lean=atan(joint.working_slope(mechanism)))


@contact_of.register
def _(joint: BeltPair, mechanism: Mechanism) -> Contact:
    line, (first, other) = joint.line(mechanism), joint.arms(mechanism)
    return Contact(
        -other,
        joint.carrier,
        cmath.phase(line),
        (joint.carrier, joint.centres[0]),
        lean=asin((first + other) / abs(line)),
        strands=True,
        press=0.0 if joint.pretension else 1.0,
        pull=joint.pretension,
    )


@contact_of.register
def _(joint: RackPair, mechanism: Mechanism) -> Contact:
    angle, at = joint.direction - 0.5 * pi, (joint.pinion, joint.centre)
    return Contact(1.0, joint.rack, angle, at, joint.pressure_angle, press=-joint.side)
