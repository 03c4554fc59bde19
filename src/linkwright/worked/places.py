"""Positions of a group: the closed form of its kind, or the closure equations of a group without one."""

from __future__ import annotations

import math
from collections.abc import Sequence

from linkwright.core.inputs import Input
from linkwright.core.outputs import Output
from linkwright.elements.topology import Group, TreeJoint
from linkwright.groups.base import Dyad
from linkwright.kinematics.groups import dyad_shape, in_one_step, whole_form
from linkwright.worked.chains import ChainClosure, Trail, attach, chain_closures, trail
from linkwright.worked.higher_pairs import PairClosure, Slid, Turned, is_unknown, pair_closures
from linkwright.worked.page import Step
from linkwright.worked.symbols import Book, Slide, Spot, tex
from linkwright.worked.terms import (
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


class Places:
    """Writes the positions of groups, one after the other; remembers what is known."""

    def __init__(self, book: Book) -> None:
        self.book = book
        self.known: set[str] = set()
        self.angles: set[str] = {"frame"}
        self.guides: set[str] = set()
        self.slid: set[str] = set()

    # pieces that every group needs --------------------------------------------------------
    def point(self, step: Step, spot: Spot, formula: Pair) -> None:
        """Notes where a point is."""
        if spot.key in self.known or spot.fixed:
            return
        self.known.add(spot.key)
        for term, part, c in ((spot.place.x, formula.x, "x"), (spot.place.y, formula.y, "y")):
            step.find(term, part, self.output(spot, "position", c))

    @staticmethod
    def output(spot: Spot, kind: str, component: str) -> str | Output:
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
            self.angle(step, joint.child, self._followed(joint))

    def _followed(self, joint: TreeJoint) -> Term:
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

    # a group --------------------------------------------------------------------------------
    def place(self, step: Step, group: Group) -> None:
        """Positions of a group's links and of all their points."""
        for joint in group.tree:
            if joint.slides and joint.driver is not None:
                self.displacement(step, self.book.slide(joint.joint), self.book.drive(joint.driver)[0])
        shape = dyad_shape(group) if group.unknowns else None
        if shape is not None and hasattr(shape[0], "work") and self._plain(group, shape[1]):
            self._dyad(step, group, *shape)
        elif group.unknowns and not in_one_step(group):
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

    def _dyad(self, step: Step, group: Group, dyad: Dyad, ends: tuple[str, str]) -> None:
        cut = group.cuts[0]
        tip = self.book.spot(cut.a, cut.joint)
        mode = self.mode(group)
        dyad.work(self, step, group, ends, tip, mode)

    def mode(self, group: Group) -> int:
        """+1 or -1: the assembly mode in this position."""
        rows = self.book.motion.modes.get(Input("mode", group.name).name)
        if rows is not None:
            return 1 if rows[self.book.index] > 0 else -1
        return 1 if self.book.motion.design.modes.get(group.name, 1.0) > 0 else -1

    def _arm(self, step: Step, group: Group, end: str, tip: Spot) -> tuple[Spot, TreeJoint, Trail]:
        """Pin, its joint and the way to the cut, for a chain that begins with a free pin."""
        steps = self._steps(group, end)
        pivot = self.book.spot(steps[0].parent, steps[0].joint)
        way = trail(self.book, steps[1:], steps[0].child, steps[0].joint, tip.key, local=True)
        return pivot, steps[0], way

    def _length(self, step: Step, pivot: Spot, tip: Spot, reach: Pair) -> tuple[Term, Term]:
        """Distance from pin to cut and the angle under which the link's axes see it."""
        sub = f"{pivot.label}{tip.label}"
        ahead, aside = reach.x, reach.y
        size = symbol(f"l_{sub}", f"l_{{{tex(sub)}}}", math.hypot(ahead.value, aside.value))
        if aside.is_zero and ahead.op == "symbol":
            if ahead.plain[:2] in ("l_", "u_"):
                step.give(size, "m")
            else:
                step.find(size, ahead if ahead.amount > 0 else -ahead, "m")
            return size, ZERO if ahead.amount > 0 else self.book.degrees(math.pi)
        parts = []
        for name, part in (("u", ahead), ("w", aside)):
            if part.is_zero:
                parts.append(ZERO)
                continue
            term = symbol(f"{name}_{sub}", f"{name}_{{{tex(sub)}}}", part.value)
            parts.append(step.give(term, "m") if part.op == "symbol" else step.find(term, part, "m"))
        step.find(size, root(parts[0].squared + parts[1].squared), "m")
        lean = direction(parts[1], parts[0])
        own = symbol(f"ε_{sub}", rf"\varepsilon_{{{tex(sub)}}}", lean.value, degrees=True)
        return size, step.find(own, lean, "°")

    def _apart(self, step: Step, p: Spot, q: Pair) -> tuple[Pair, Term]:
        """The vector d from P to Q and the square of its length."""
        d = q - p.place
        named = Pair(symbol("d_x", "d_x", d.x.value), symbol("d_y", "d_y", d.y.value))
        step.find(named.x, d.x, "m")
        step.find(named.y, d.y, "m")
        square = named.x.squared + named.y.squared
        return named, step.find(symbol("d²", "d^2", square.value), square, "m²")

    def rrr(self, step: Step, group: Group, ends: tuple[str, str], tip: Spot, mode: int) -> None:
        (p, first, way_1), (q, second, way_2) = (self._arm(step, group, end, tip) for end in ends)
        r1, lean_1 = self._length(step, p, tip, way_1.reach)
        r2, lean_2 = self._length(step, q, tip, way_2.reach)
        d, dd = self._apart(step, p, q.place)
        t_is = dd + r1.squared - r2.squared
        t = step.find(symbol("t", "t", t_is.value), t_is, "m²")
        rho = self._root(step, FOUR * r1.squared * dd - t.squared, "m²")
        self._mode_note(step, "mode_rrr", mode, (p, q, tip))
        side = d.perp.times(rho)
        turn = d.times(t) + side if mode > 0 else d.times(t) - side
        b = Pair(p.place.x + turn.x / (TWO * dd), p.place.y + turn.y / (TWO * dd))
        self.point(step, tip, b)
        for joint, pivot, lean in ((first, p, lean_1), (second, q, lean_2)):
            arm = tip.place - pivot.place
            self.angle(step, joint.child, direction(arm.y, arm.x) - lean)

    def _root(self, step: Step, square: Term, unit: str) -> Term:
        value = square.value
        rho = symbol("ρ", r"\rho", math.sqrt(max(value, 0.0)))
        return step.find(rho, root(square), unit)

    def _mode_note(self, step: Step, key: str, mode: int, spots: tuple[Spot, Spot, Spot]) -> None:
        p, q, b = (spot.label for spot in spots)
        step.say(self.book.say(f"worked.{key}_{'plus' if mode > 0 else 'minus'}", p=p, q=q, b=b))

    def _frame_chain(self, step: Step, group: Group, end: str, tip: Spot, name: str) -> tuple[Pair, Trail]:
        """Where the cut would be with the slides at zero, for a chain of guides."""
        steps = self._steps(group, end)
        if not steps:
            return tip.place, Trail()
        for joint in steps:
            self.follow(step, joint)
            if joint.slides:
                self.guide(step, joint.joint)
        start = attach(steps[0], steps[0].parent, self.book)
        base = self.book.spot(steps[0].parent, start)
        way = trail(self.book, steps, steps[0].parent, start, tip.key, local=False)
        zero = Pair(
            symbol(f"x_{name}", f"x_{{{name}}}", (base.place.x + way.reach.x).value),
            symbol(f"y_{name}", f"y_{{{name}}}", (base.place.y + way.reach.y).value),
        )
        if way.reach == NOWHERE:
            return base.place, way
        step.say(self.book.say("worked.zero_slide", name=name, b=tip.label))
        step.find(zero.x, base.place.x + way.reach.x, "m")
        step.find(zero.y, base.place.y + way.reach.y, "m")
        return zero, way

    def rrp(self, step: Step, group: Group, ends: tuple[str, str], tip: Spot, mode: int) -> None:
        p, joint, way_1 = self._arm(step, group, ends[0], tip)
        r, lean = self._length(step, p, tip, way_1.reach)
        zero, way = self._frame_chain(step, group, ends[1], tip, f"{tip.label}0")
        guide, n, _ = way.slides[0]
        f = p.place - zero
        h = step.find(symbol("h", "h", n.cross(f).value), n.cross(f), "m")
        along = step.find(symbol("f", "f", n.dot(f).value), n.dot(f), "m")
        rho = self._root(step, r.squared - h.squared, "m")
        self._mode_note(step, "mode_rrp", mode, (p, p, tip))
        slide = self.book.slide(guide.joint)
        ahead = (mode > 0) == (
            guide.child == guide.connection.b
        )  # words are seen along the guide of the file
        self.displacement(step, slide, along + rho if ahead else along - rho)
        self.point(step, tip, zero + n.times(slide.s))
        arm = tip.place - p.place
        self.angle(step, joint.child, direction(arm.y, arm.x) - lean)

    def rpr(self, step: Step, group: Group, ends: tuple[str, str], tip: Spot, mode: int) -> None:
        p, joint, way = self._arm(step, group, ends[0], tip)
        guide, m, heading = way.slides[0]
        aside, ahead = m.cross(way.reach), m.dot(way.reach)
        e = ZERO if aside.is_zero else step.find(symbol("e", "e", aside.value), aside, "m")
        b = ZERO if ahead.is_zero else step.find(symbol("b", "b", ahead.value), ahead, "m")
        d, dd = self._apart(step, p, tip.place)
        rho = self._root(step, dd - e.squared, "m")
        self._mode_note(step, "mode_rpr", mode, (p, tip, tip))
        reach = rho if mode > 0 else -rho
        slide = self.book.slide(guide.joint)
        self.displacement(step, slide, reach - b)
        cosine_is, sine_is = (reach * d.x + e * d.y) / dd, (reach * d.y - e * d.x) / dd
        nx = step.find(symbol("n_x", "n_x", cosine_is.value), cosine_is, "")
        ny = step.find(symbol("n_y", "n_y", sine_is.value), sine_is, "")
        self.angle(step, joint.child, direction(ny, nx) - heading)

    def slides(
        self, step: Step, group: Group, ends: tuple[str, str], tip: Spot, mode: int, *, apart: bool
    ) -> None:
        """PRP (a slide in each chain) and RPP (both in one)."""
        zero_1, way_1 = self._frame_chain(step, group, ends[0], tip, f"{tip.label}1")
        zero_2, way_2 = self._frame_chain(step, group, ends[1], tip, f"{tip.label}2")
        (g1, n1, _), (g2, n2, _) = [*way_1.slides, *way_2.slides]
        f = zero_2 - zero_1
        f = Pair(
            step.find(symbol("f_x", "f_x", f.x.value), f.x, "m"),
            step.find(symbol("f_y", "f_y", f.y.value), f.y, "m"),
        )
        sine_is = n1.cross(n2)
        det = step.find(symbol("k", "k", sine_is.value), sine_is, "")
        self.displacement(step, self.book.slide(g1.joint), f.cross(n2) / det)
        self.displacement(step, self.book.slide(g2.joint), (f.cross(n1) if apart else n1.cross(f)) / det)
        if apart:
            self.point(step, tip, zero_1 + n1.times(self.book.slide(g1.joint).s))

    # groups without a dyad's closed form ----------------------------------------------------
    def _numerically(self, step: Step, group: Group) -> None:
        """The closure equations with the pairs' rows put in, and the unknowns that solve them; the closure is
        checked once all points are placed."""
        book = self.book
        chains = chain_closures(book, group)
        rows = pair_closures(book, group, chains)
        known = self._held(group)
        if rows:
            step.say(book.say("worked.newton_pairs", joints=", ".join(row.cut.joint for row in rows)))
        for row in rows:
            known |= self._tied(step, row, known)
        if chains:
            joints = ", ".join(dict.fromkeys(closure.cut.joint for closure in chains))
            step.say(book.say("worked.newton_chains", joints=joints))
        for closure in chains:
            self._closure(step, group, closure, known)
        form = whole_form(group)
        step.say(
            book.say("worked.newton")
            if form is None
            else book.say("worked.own_form", form=form.signature or type(form).__name__)
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
                known[book.turn(joint.child).plain] = self._followed(joint).put(known)
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
        a, b = (
            self._reach(group, end, name, name) for end, name in ((cut.a, joint.through), (cut.b, joint.at))
        )
        offset = symbol(f"h_{cut.joint}", f"h_{{{tex(cut.joint)}}}", joint.offset) if joint.offset else ZERO
        step.relate(ZERO, minus(closure.across.along.cross(b - a).put(known), offset))

    def _reach(self, group: Group, end: str, solved: str, tip: str) -> Pair:
        """The end of a chain: from a point solved before along the chain to the point ``tip`` of its last link."""
        steps = self._steps(group, end)
        if not steps:
            return self.book.spot(end, solved).place
        start = attach(steps[0], steps[0].parent, self.book)
        way = trail(self.book, steps, steps[0].parent, start, tip, local=False)
        found = self.book.spot(steps[0].parent, start).place + way.reach
        for joint, along, _ in way.slides:
            found = found + along.times(self.book.slide(joint.joint).s)
        return found

    def check_pairs(self, step: Step, rows: Sequence[PairClosure]) -> None:
        """What is left of the rows of higher pairs with the numbers put in."""
        for row in rows:
            row.give(step, None)
            left = row.sum(self.book.rotation, lambda guide: self.book.slide(guide).s)
            name = row.cut.joint
            step.find(symbol(f"Δ_{name}", rf"\Delta_{{{tex(name)}}}", 0.0), left, "m")
