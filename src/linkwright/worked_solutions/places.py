"""Positions of a group: the closed form of its kind, or the closure equations of a group without one."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.core.inputs import Input
from linkwright.core.outputs import Output
from linkwright.elements.topology import Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import ZERO, Pair, Term, cosine, minus, sine, symbol
from linkwright.groups.base import Dyad
from linkwright.kinematics.groups import complete_form, dyad_shape, in_one_step
from linkwright.words import _
from linkwright.worked_solutions.chains import ChainClosure, attach, chain_closures, trail
from linkwright.worked_solutions.dyads import DyadWriter, write_dyad
from linkwright.worked_solutions.higher_pairs import PairClosure, Slid, Turned, is_unknown, pair_closures
from linkwright.worked_solutions.placing import Placing


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
            step.say(
                book.say(
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
            step.say(book.say(_("Closure equations of the chains, cut at {joints}:", joints=joints)))
        for closure in chains:
            self._closure(step, group, closure, known)
        form = complete_form(group)
        step.say(
            book.say(_("They have no closed form; Newton's method gives"))
            if form is None
            else book.say(_("The closed form {form} of a package gives", form=form.signature or type(form).__name__))
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
                known[book.turn(joint.child).plain] = self._cam_followed(joint).put(known)
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
