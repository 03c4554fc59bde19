"""Positions of a group: closed forms of dyads by type, or the closure equations with what is left to check."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, singledispatch

from linkwright.core.inputs import Input
from linkwright.core.outputs import Output
from linkwright.elements import Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import (
    FOUR,
    NOWHERE,
    TWO,
    ZERO,
    Pair,
    Term,
    cosine,
    direction,
    minus,
    number,
    root,
    sine,
    symbol,
)
from linkwright.groups.base import Dyad
from linkwright.groups.prp import PRP
from linkwright.groups.rpp import RPP
from linkwright.groups.rpr import RPR
from linkwright.groups.rrp import RRP
from linkwright.groups.rrr import RRR
from linkwright.kinematics.groups import complete_form, dyad_shape, in_one_step
from linkwright.words import Message, _
from linkwright.worked_solutions.chains import ChainClosure, Trail, attach, chain_closures, trail
from linkwright.worked_solutions.higher_pairs import PairClosure, Slid, Turned, is_unknown, pair_closures
from linkwright.worked_solutions.symbols import PointState, Slide, SymbolTable


class Placing:
    """Writes points, angles and displacements, each once; remembers what is known."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self.known: set[str] = set()
        self.angles: set[str] = {"frame"}
        self.guides: set[str] = set()
        self.slid: set[str] = set()

    def point(self, step: Step, spot: PointState, formula: Pair) -> None:
        """Notes where a point is."""
        if spot.key in self.known or spot.fixed:
            return
        self.known.add(spot.key)
        for term, part, c in ((spot.place.x, formula.x, "x"), (spot.place.y, formula.y, "y")):
            step.find(term, part, self.output(spot, "position", c))

    @staticmethod
    def output(spot: PointState, kind: str, component: str) -> str | Output:
        """The output that a point's motion is, or its unit."""
        found = Output(kind, spot.key, component)
        return found.unit if spot.key.endswith("@centre") else found

    def angle(self, step: Step, link: str, formula: Term) -> None:
        """Notes the angle of a link."""
        if link not in self.angles:
            self.angles.add(link)
            turn = self.book.turn(link)
            rounds = round((turn.amount - formula.value) / 360.0)
            turns = number(360.0 * abs(rounds), degrees=True)
            formula = formula - turns if rounds < 0 else formula + turns
            step.find(turn, formula, Output("angle", link))

    def follow(self, step: Step, joint: TreeJoint) -> None:
        """Notes the angle of a link that a guide, a weld or a driver turns."""
        if not (joint.free and joint.turns):
            self.angle(step, joint.child, self._driven_angle(joint))

    def _driven_angle(self, joint: TreeJoint) -> Term:
        """The angle of such a link, from that of its parent."""
        book = self.book
        parent = book.turn(joint.parent)
        if not joint.turns:
            return parent + book.turned(joint)
        assert joint.driver is not None
        q = book.drive(joint.driver)[0]
        return parent + q if joint.child == book.mechanism.drivers[joint.driver].link else parent - q

    def guide(self, step: Step, joint: str) -> Slide:
        """Notes the direction of a guide."""
        slide = self.book.slide(joint)
        if joint not in self.guides:
            self.guides.add(joint)
            turn = self._guide_turn(joint)
            for term, part in ((slide.along.x, cosine(turn)), (slide.along.y, sine(turn))):
                if term.op == "symbol":
                    step.find(term, part, "")
        return slide

    def _guide_turn(self, joint: str) -> Term:
        """Angle of a guide's direction."""
        prismatic = self.book.mechanism.guides[joint]
        own = self.book.degrees(prismatic.direction)
        return self.book.turn(prismatic.guide) + own

    def displacement(self, step: Step, slide: Slide, formula: Term) -> None:
        """Notes the displacement of a block."""
        if slide.joint in self.slid:
            return
        self.slid.add(slide.joint)
        step.find(slide.s, formula, Output("displacement", slide.joint))


class Places(Placing):
    """Writes the positions of groups, one after the other."""

    def place(self, step: Step, group: Group) -> None:
        """Positions of a group's links and of all their points."""
        for joint in group.tree:
            if joint.slides and joint.driver is not None:
                self.displacement(step, self.book.slide(joint.joint), self.book.drive(joint.driver)[0])
        shape = dyad_shape(group) if group.unknowns else None
        known = shape is not None and self._dyad(step, group, *shape)
        if not known and group.unknowns and not in_one_step(group):
            self._numerically(step, group)
        for joint in group.tree:
            self.follow(step, joint)
            if joint.slides:
                self.guide(step, joint.joint)

    def _plain(self, group: Group, ends: tuple[str, str]) -> bool:
        """Whether the chains begin with what the closed forms speak of."""
        for end in ends:
            steps = list(reversed(list(group.path(end))))
            free = [joint for joint in steps if joint.free]
            if free and free[0].turns and steps[0] is not free[0]:
                return False
        return True

    def _steps(self, group: Group, end: str) -> list[TreeJoint]:
        return list(reversed(list(group.path(end))))

    def _dyad(self, step: Step, group: Group, dyad: Dyad, ends: tuple[str, str]) -> bool:
        """Writes a closed form; False where there is none that speaks of the group's chains."""
        return self._plain(group, ends) and write_dyad(dyad, DyadWriter(self, step, group, ends, self.mode(group)))

    def mode(self, group: Group) -> int:
        """+1 or -1: the assembly mode in this position."""
        rows = self.book.motion.modes.get(Input("mode", group.name).name)
        if rows is not None:
            return 1 if rows[self.book.index] > 0 else -1
        return 1 if self.book.motion.design.modes.get(group.name, 1.0) > 0 else -1

    # groups without a dyad's closed form ----------------------------------------------------
    def _numerically(self, step: Step, group: Group) -> None:
        """The closure equations with the pairs' rows put in, and the unknowns that solve them; the closure is
        checked once all points are placed."""
        book = self.book
        chains = chain_closures(book, group)
        rows = pair_closures(book, group, chains)
        known = self._held(group)
        if rows:
            step.note(
                book.translate(
                    _(
                        "The pairs {joints} tie rotations, counted with their turns, and displacements to "
                        "each other, as the closure equations have them (i: ratio to each link, r: lever "
                        "arm; β, c: from the drawing or the file):",
                        joints=", ".join(row.cut.joint for row in rows),
                    )
                )
            )
        for row in rows:
            known |= self._tied(step, row, known)
        if chains:
            joints = ", ".join(dict.fromkeys(closure.cut.joint for closure in chains))
            step.note(book.translate(_("Closure equations of the chains, cut at {joints}:", joints=joints)))
        for closure in chains:
            self._closure(step, group, closure, known)
        form = complete_form(group)
        step.note(
            book.translate(_("They have no closed form; Newton's method gives"))
            if form is None
            else book.translate(
                _("The closed form {form} of a package gives", form=form.signature or type(form).__name__)
            )
        )
        self.give(step, group)

    def give(self, step: Step, group: Group) -> None:
        """The unknowns of a group as they were found."""
        for joint in group.unknowns:
            if joint.slides:
                self.slid.add(joint.joint)
                step.give(self.book.slide(joint.joint).s, Output("displacement", joint.joint))
            else:
                self.angles.add(joint.child)
                step.give(self.book.turn(joint.child), Output("angle", joint.child))

    def _held(self, group: Group) -> dict[str, Term]:
        """Angles of links that turn with an unknown one, and the directions of guides on moving links."""
        book = self.book
        known: dict[str, Term] = {}
        for joint in group.tree:
            if not (joint.free and joint.turns):
                known[book.turn(joint.child).plain] = self._driven_angle(joint).put(known)
        for connection in group.joints:
            if connection.slides and connection.a != "frame":
                turn, along = self._guide_turn(connection.joint), book.slide(connection.joint).along
                for term, part in ((along.x, cosine(turn)), (along.y, sine(turn))):
                    if term.op == "symbol":
                        known[term.plain] = part.put(known)
        return known

    def _tied(self, step: Step, row: PairClosure, known: dict[str, Term]) -> dict[str, Term]:
        """Notes a pair's row, solved for an unknown of the group where it has one; what that replaces."""
        book = self.book
        free = [part for part in row.parts if part.source is not None]
        parts = {id(part): self._symbol(part) for part in free}
        mine = [part for part in free if parts[id(part)].plain not in known]
        target = next((part for part in reversed(mine) if is_unknown(part)), None)
        row.give(step, target)
        if target is None:
            step.relate(ZERO, row.sum(book.turn, lambda guide: book.slide(guide).s).put(known))
            return {}
        found = row.solved_for(target, book.turn, lambda guide: book.slide(guide).s).put(known)
        name = parts[id(target)]
        step.relate(name, found)
        for key, term in known.items():
            known[key] = term.put({name.plain: found})
        return {name.plain: found}

    def _symbol(self, part: Turned | Slid) -> Term:
        return self.book.slide(part.guide).s if isinstance(part, Slid) else self.book.turn(part.link)

    def _closure(self, step: Step, group: Group, closure: ChainClosure, known: dict[str, Term]) -> None:
        """The two chains of a cut meet, in components; of a guide across it."""
        book, cut = self.book, closure.cut
        if closure.across is None:
            (a, b) = (self._reach(group, end, cut.joint, cut.joint).put(known) for end in (cut.a, cut.b))
            step.relate(ZERO, minus(a.x, b.x))
            step.relate(ZERO, minus(a.y, b.y))
            return
        joint = book.mechanism.guides[cut.joint]
        a, b = (self._reach(group, end, name, name) for end, name in ((cut.a, joint.through), (cut.b, joint.at)))
        offset = symbol(f"h_{cut.joint}", joint.offset) if joint.offset else ZERO
        step.relate(ZERO, minus(closure.across.along.cross(b - a).put(known), offset))

    def _reach(self, group: Group, end: str, solved: str, tip: str) -> Pair:
        """The end of a chain: from a point solved before along the chain to the point ``tip`` of its last link."""
        steps = self._steps(group, end)
        if not steps:
            return self.book.spot(end, solved).place
        start = attach(steps[0], steps[0].parent, self.book)
        way = trail(self.book, steps, steps[0].parent, start, tip, local=False)
        found = self.book.spot(steps[0].parent, start).place + way.reach
        for joint, along, _unused in way.slides:
            found = found + along.times(self.book.slide(joint.joint).s)
        return found

    def check_pairs(self, step: Step, rows: Sequence[PairClosure]) -> None:
        """What is left of the rows of higher pairs with the numbers put in."""
        for row in rows:
            row.give(step, None)
            left = row.sum(self.book.rotation, lambda guide: self.book.slide(guide).s)
            name = row.cut.joint
            step.find(symbol(f"Δ_{name}", 0.0), left, "m")


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
        self.step.note(self.book.translate(message.format(p=p, q=q, b=b)))

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
        self.step.note(
            self.book.translate(_("{name}: where {b} would be with the displacement 0.", name=name, b=self.tip.label))
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
