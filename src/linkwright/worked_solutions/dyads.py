"""Closed forms of dyads in worked solutions, by their types."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, singledispatch

from linkwright.elements.topology import Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import FOUR, NOWHERE, TWO, ZERO, Pair, Term, direction, root, symbol
from linkwright.groups.prp import PRP
from linkwright.groups.rpp import RPP
from linkwright.groups.rpr import RPR
from linkwright.groups.rrp import RRP
from linkwright.groups.rrr import RRR
from linkwright.words import Message, _
from linkwright.worked_solutions.chains import Trail, attach, trail
from linkwright.worked_solutions.placing import Placing
from linkwright.worked_solutions.symbols import PointState, SymbolTable

#: On which side a joint lies: with the root +, and with the root -.
MODE_RPR = (
    _("The block lies ahead of the foot of the perpendicular from {p}, looking along the guide: +ρ."),
    _("The block lies behind the foot of the perpendicular from {p}, looking along the guide: -ρ."),
)
MODE_RRP = (
    _("{b} lies ahead of the foot of the perpendicular from {p}, looking along the guide: +ρ."),
    _("{b} lies behind the foot of the perpendicular from {p}, looking along the guide: -ρ."),
)
MODE_RRR = (
    _("{b} lies on the left of the ray {p}→{q}: the root with +d⊥ = (-d_y, d_x)."),
    _("{b} lies on the right of the ray {p}→{q}: the root with -d⊥ = (d_y, -d_x)."),
)


@dataclass(frozen=True)
class DyadWriter:
    """The pieces of which closed forms of dyads are written: chains to the cut, lengths, distances, roots.

    ``ends``: the links that meet in the cut, that of chain a first; ``mode``: +1 or -1.
    """

    placing: Placing
    step: Step
    group: Group
    ends: tuple[str, str]
    mode: int

    @property
    def book(self) -> SymbolTable:
        return self.placing.book

    @cached_property
    def tip(self) -> PointState:
        """The inner joint, where the group is cut."""
        cut = self.group.cuts[0]
        return self.book.spot(cut.a, cut.joint)

    def _steps(self, end: str) -> list[TreeJoint]:
        return list(reversed(list(self.group.path(end))))

    def arm(self, end: str) -> tuple[PointState, TreeJoint, Trail]:
        """Pin, its joint and the way to the cut, for a chain that begins with a free pin."""
        steps = self._steps(end)
        pivot = self.book.spot(steps[0].parent, steps[0].joint)
        way = trail(self.book, steps[1:], steps[0].child, steps[0].joint, self.tip.key, local=True)
        return pivot, steps[0], way

    def length(self, pivot: PointState, reach: Pair) -> tuple[Term, Term]:
        """Distance from pin to cut and the angle under which the link's axes see it."""
        sub = f"{pivot.label}{self.tip.label}"
        ahead, aside = reach.x, reach.y
        size = symbol(f"l_{sub}", math.hypot(ahead.value, aside.value))
        if aside.is_zero and ahead.op == "symbol":
            if ahead.plain[:2] in ("l_", "u_"):
                self.step.give(size, "m")
            else:
                self.step.find(size, ahead if ahead.amount > 0 else -ahead, "m")
            return size, ZERO if ahead.amount > 0 else self.book.degrees(math.pi)
        parts = []
        for name, part in (("u", ahead), ("w", aside)):
            known = part.op == "symbol" and self.step.give(symbol(f"{name}_{sub}", part.value), "m")
            parts.append(known or (ZERO if part.is_zero else self.step.define(f"{name}_{sub}", part, "m")))
        self.step.find(size, root(parts[0].squared + parts[1].squared), "m")
        return size, self.step.define(f"ε_{sub}", direction(parts[1], parts[0]), "°", degrees=True)

    def difference(self, p: PointState, q: Pair) -> tuple[Pair, Term]:
        """The vector d from P to Q and the square of its length."""
        d = q - p.place
        named = Pair(symbol("d_x", d.x.value), symbol("d_y", d.y.value))
        self.step.find(named.x, d.x, "m")
        self.step.find(named.y, d.y, "m")
        square = named.x.squared + named.y.squared
        return named, self.step.define("d²", square, "m²")

    def root(self, square: Term, unit: str) -> Term:
        value = square.value
        rho = symbol("ρ", math.sqrt(max(value, 0.0)))
        return self.step.find(rho, root(square), unit)

    def note_mode(self, modes: tuple[Message, Message], *spots: PointState) -> None:
        p, q, b = (spot.label for spot in spots)
        message = modes[0] if self.mode > 0 else modes[1]
        self.step.say(self.book.say(message.format(p=p, q=q, b=b)))

    def frame_chain(self, end: str, name: str) -> tuple[Pair, Trail]:
        """Where the cut would be with the slides at zero, for a chain of guides."""
        steps = self._steps(end)
        if not steps:
            return self.tip.place, Trail()
        for joint in steps:
            self.placing.follow(self.step, joint)
            if joint.slides:
                self.placing.guide(self.step, joint.joint)
        start = attach(steps[0], steps[0].parent, self.book)
        base = self.book.spot(steps[0].parent, start)
        way = trail(self.book, steps, steps[0].parent, start, self.tip.key, local=False)
        if way.reach == NOWHERE:
            return base.place, way
        self.step.say(
            self.book.say(_("{name}: where {b} would be with the displacement 0.", name=name, b=self.tip.label))
        )
        zero = base.place + way.reach
        return Pair(self.step.define(f"x_{name}", zero.x, "m"), self.step.define(f"y_{name}", zero.y, "m")), way


@singledispatch
def write_dyad(dyad: object, write: DyadWriter) -> bool:
    """Writes the positions of a dyad by its closed form; False of one whose form is not known here."""
    return False


@write_dyad.register
def _rrr(dyad: RRR, write: DyadWriter) -> bool:
    step, tip, mode = write.step, write.tip, write.mode
    (p, first, way_1), (q, second, way_2) = (write.arm(end) for end in write.ends)
    r1, lean_1 = write.length(p, way_1.reach)
    r2, lean_2 = write.length(q, way_2.reach)
    d, dd = write.difference(p, q.place)
    t = step.define("t", dd + r1.squared - r2.squared, "m²")
    rho = write.root(FOUR * r1.squared * dd - t.squared, "m²")
    write.note_mode(MODE_RRR, p, q, tip)
    side = d.perp.times(rho)
    turn = d.times(t) + side if mode > 0 else d.times(t) - side
    b = Pair(p.place.x + turn.x / (TWO * dd), p.place.y + turn.y / (TWO * dd))
    write.placing.point(step, tip, b)
    for joint, pivot, lean in ((first, p, lean_1), (second, q, lean_2)):
        arm = tip.place - pivot.place
        write.placing.angle(step, joint.child, direction(arm.y, arm.x) - lean)
    return True


@write_dyad.register
def _rrp(dyad: RRP, write: DyadWriter) -> bool:
    step, tip, mode = write.step, write.tip, write.mode
    p, joint, way_1 = write.arm(write.ends[0])
    r, lean = write.length(p, way_1.reach)
    zero, way = write.frame_chain(write.ends[1], f"{tip.label}0")
    guide, n, _unused = way.slides[0]
    f = p.place - zero
    h = step.define("h", n.cross(f), "m")
    along = step.define("f", n.dot(f), "m")
    rho = write.root(r.squared - h.squared, "m")
    write.note_mode(MODE_RRP, p, p, tip)
    slide = write.book.slide(guide.joint)
    ahead = (mode > 0) == (guide.child == guide.connection.b)  # words are meant along the guide of the file
    write.placing.displacement(step, slide, along + rho if ahead else along - rho)
    write.placing.point(step, tip, zero + n.times(slide.s))
    arm = tip.place - p.place
    write.placing.angle(step, joint.child, direction(arm.y, arm.x) - lean)
    return True


@write_dyad.register
def _rpr(dyad: RPR, write: DyadWriter) -> bool:
    step, tip, mode = write.step, write.tip, write.mode
    p, joint, way = write.arm(write.ends[0])
    guide, m, heading = way.slides[0]
    aside, ahead = m.cross(way.reach), m.dot(way.reach)
    e = ZERO if aside.is_zero else step.define("e", aside, "m")
    b = ZERO if ahead.is_zero else step.define("b", ahead, "m")
    d, dd = write.difference(p, tip.place)
    rho = write.root(dd - e.squared, "m")
    write.note_mode(MODE_RPR, p, tip, tip)
    reach = rho if mode > 0 else -rho
    slide = write.book.slide(guide.joint)
    write.placing.displacement(step, slide, reach - b)
    nx = step.define("n_x", (reach * d.x + e * d.y) / dd, "")
    ny = step.define("n_y", (reach * d.y - e * d.x) / dd, "")
    write.placing.angle(step, joint.child, direction(ny, nx) - heading)
    return True


def _slides(write: DyadWriter, *, separate: bool) -> bool:
    """PRP (a slide in each chain) and RPP (both in one)."""
    step, tip = write.step, write.tip
    zero_1, way_1 = write.frame_chain(write.ends[0], f"{tip.label}1")
    zero_2, way_2 = write.frame_chain(write.ends[1], f"{tip.label}2")
    (g1, n1, _unused), (g2, n2, _unused2) = [*way_1.slides, *way_2.slides]
    f = zero_2 - zero_1
    f = Pair(step.define("f_x", f.x, "m"), step.define("f_y", f.y, "m"))
    det = step.define("k", n1.cross(n2), "")
    write.placing.displacement(step, write.book.slide(g1.joint), f.cross(n2) / det)
    write.placing.displacement(step, write.book.slide(g2.joint), (f.cross(n1) if separate else n1.cross(f)) / det)
    if separate:
        write.placing.point(step, tip, zero_1 + n1.times(write.book.slide(g1.joint).s))
    return True


@write_dyad.register
def _prp(dyad: PRP, write: DyadWriter) -> bool:
    return _slides(write, separate=True)


@write_dyad.register
def _rpp(dyad: RPP, write: DyadWriter) -> bool:
    return _slides(write, separate=False)
