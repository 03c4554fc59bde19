"""Velocities and accelerations: of a group from its differentiated closure, and of the points of its links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from linkwright.core.outputs import Output
from linkwright.elements import Connection, Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import NOWHERE, TWO, ZERO, Pair, Term, number, symbol, total
from linkwright.words import _
from linkwright.worked_solutions.chains import (
    ChainClosure,
    Closure,
    Drift,
    attach,
    bends,
    matrix,
    turned,
    unknown_names,
)
from linkwright.worked_solutions.higher_pairs import PairClosure, pair_closures
from linkwright.worked_solutions.places import Places
from linkwright.worked_solutions.symbols import PointState, Slide, SymbolTable

#: Marks of parts of an acceleration as they are printed above its letter.
RAISED = {"n": "ⁿ", "t": "ᵗ", "k": "ᵏ", "d": "ᵈ"}
#: What both ends at cut joints have in common: by whether of accelerations, and whether across a guide.
CLOSURES = {
    (False, False): _("Both ends at {joints} have the same velocity:"),
    (False, True): _("Both ends at {joints} have the same velocity (for a guide: across it):"),
    (True, False): _("Both ends at {joints} have the same acceleration:"),
    (True, True): _(
        "Both ends at {joints} have the same acceleration (for a guide: across it, with Coriolis' part):"
    ),
}
#: Parts of an acceleration that are known.
PARTS = {
    "tangential": _("Tangential part α × r of {label}:"),
    "centripetal": _("Centripetal part -ω² r of {label}:"),
    "coriolis": _("Coriolis' part 2 ω s' n⊥ of {label}:"),
    "driven_turn": _("Part of the driver's angular acceleration at {label}:"),
    "driven_slide": _("Part of the driver's acceleration along {label}:"),
}


@dataclass
class System:
    """The matrix of a group, as symbols with values, with its determinant if it is small."""

    entries: list[list[Term]]
    determinant: Term | None


def name_matrix(step: Step, group: Group, cuts: Sequence[Closure]) -> System:
    """Notes every entry of the group's matrix J and, for two unknowns, the determinant."""
    formulas = matrix(group, cuts)
    entries = []
    for i, row in enumerate(formulas, 1):
        named = []
        for j, entry in enumerate(row, 1):
            unit = "m" if group.unknowns[j - 1].turns else ""
            named.append(ZERO if entry.is_zero else step.define(f"J{i}{j}", entry, unit))
        entries.append(named)
    if len(entries) != 2:
        return System(entries, None)
    (a, b), (c, d) = entries
    turning = sum(each.turns for each in group.unknowns)
    return System(entries, step.define("det J", a * d - b * c, ("", "m", "m²")[turning]))


def solve(
    step: Step,
    book: SymbolTable,
    system: System,
    unknowns: list[Term],
    right: list[Term],
    outputs: Sequence[str | Output],
    *,
    transposed: bool = False,
) -> None:
    """Notes the solution of J q = right (or Jᵀ q = right): Cramer's rule, or for more unknowns each row put in."""
    rows = [list(r) for r in zip(*system.entries, strict=True)] if transposed else system.entries
    if len(rows) == 1:
        step.find(unknowns[0], right[0] / rows[0][0], outputs[0])
        return
    if system.determinant is not None:
        (a, b), (c, d) = rows
        found = (right[0] * d - b * right[1], a * right[1] - right[0] * c)
        for term, above, output in zip(unknowns, found, outputs, strict=True):
            step.find(term, above / system.determinant, output)
        return
    step.note(book.translate(_("Solution of the {count} linear equations (by elimination):", count=len(rows))))
    for term, output in zip(unknowns, outputs, strict=True):
        step.give(term, output)
    step.note(book.translate(_("Put into the left sides, row by row:")))
    for row, goal in zip(rows, right, strict=True):
        left = total([entry * term for entry, term in zip(row, unknowns, strict=True)])
        if goal.is_zero:
            goal = symbol("0", 0.0)
        step.find(goal, left, "")


class RateWriter:
    """Writes the rates of a group's unknowns and links."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self.written: set[str] = set()

    def velocities(self, step: Step, group: Group, cuts: Sequence[Closure]) -> System | None:
        """The matrix, the right sides, and the unknown velocities."""
        book, system = self.book, None
        self.links(step, group, second=False, before=True)
        if group.unknowns:
            names = unknown_names(book, group, 1)
            self._relations(step, group, cuts, names, second=False)
            system = name_matrix(step, group, cuts)
            gaps = [-row for closure in cuts for row in closure.known_rates(book)]
            right = self._right(step, gaps, "b", "m/s")
            solve(step, book, system, names, right, self._outputs(group, second=False))
        self.links(step, group, second=False, before=False)
        return system

    def accelerations(self, step: Step, group: Group, cuts: Sequence[Closure], system: System | None) -> None:
        """The known parts one by one, the right sides, and the unknown accelerations."""
        book = self.book
        self.links(step, group, second=True, before=True)
        if group.unknowns:
            assert system is not None
            names = unknown_names(book, group, 2)
            self._relations(step, group, cuts, names, second=True)
            noted: dict[Connection, Pair] = {}

            def bend(closure: ChainClosure) -> Pair:
                if closure.cut not in noted:
                    noted[closure.cut] = self._bend(step, closure)
                return noted[closure.cut]

            gaps = [-row for closure in cuts for row in closure.known_seconds(book, bend)]
            right = self._right(step, gaps, "c", "m/s²")
            solve(step, book, system, names, right, self._outputs(group, second=True))
        self.links(step, group, second=True, before=False)

    def _relations(
        self, step: Step, group: Group, cuts: Sequence[Closure], names: list[Term], *, second: bool
    ) -> None:
        joints = ", ".join(dict.fromkeys(c.cut.joint for c in cuts if not c.cut.higher))
        pairs = ", ".join(c.cut.joint for c in cuts if c.cut.higher)
        across = any(closure.cut.slides for closure in cuts)
        if joints:
            step.note(self.book.translate(CLOSURES[second, across].format(joints=joints)))
        if pairs:
            step.note(
                self.book.translate(
                    _("The rows of {joints}, differentiated (r: lever arms of the rotations):", joints=pairs)
                )
            )
            for closure in cuts:
                if isinstance(closure, PairClosure):
                    closure.give(step, None)
        letter = "c" if second else "b"
        for i, row in enumerate(matrix(group, cuts), 1):
            entries = [ZERO if entry.is_zero else symbol(f"J{i}{j}", 0.0) for j, entry in enumerate(row, 1)]
            left = total([entry * name for entry, name in zip(entries, names, strict=True)])
            step.relate(left, symbol(f"{letter}{i}", 0.0))

    def _right(self, step: Step, gaps: list[Term], letter: str, unit: str) -> list[Term]:
        found = []
        step.note(self.book.translate(_("Right sides:")))
        for i, gap in enumerate(gaps, 1):
            term = step.define(f"{letter}{i}", gap, unit)
            found.append(ZERO if gap.is_zero else term)
        return found

    def _bend(self, step: Step, closure: ChainClosure) -> Pair:
        """Notes the known parts of the accelerations of both ends; gives their difference."""
        ends = []
        for chain in closure.chains:
            total = NOWHERE
            for part in bends(chain, self.book):
                total = total + (part.vector if part.kind == "base" else self._part(step, part))
            ends.append(total)
        return closure.joined(ends)

    def _part(self, step: Step, part: Drift) -> Pair:
        """Notes one known part of an acceleration, unless the other cut has noted it already."""
        mark = {"centripetal": "n", "tangential": "t", "coriolis": "k"}.get(part.kind, "d")
        noted = {equation.symbol for equation in step.equations}
        begun = False
        found = []
        for c, formula in (("x", part.vector.x), ("y", part.vector.y)):
            plain, look = (f"a{each}_{part.label},{c}" for each in (mark, RAISED[mark]))
            term = ZERO if formula.is_zero else symbol(plain, formula.value, look=look)
            if not term.is_zero and plain not in noted:
                if not begun:
                    step.note(self.book.translate(PARTS[part.kind].format(label=part.label)))
                begun = True
                step.find(term, formula, "m/s²")
            found.append(term)
        return Pair(found[0], found[1])

    def _outputs(self, group: Group, *, second: bool) -> list[Output]:
        """What the unknowns' rates are; links that turn count as written."""
        self.written.update(f"{joint.child}{second}" for joint in group.unknowns if not joint.slides)
        places = (
            Output("displacement", joint.joint) if joint.slides else Output("angle", joint.child)
            for joint in group.unknowns
        )
        return [place.course[1 + second] for place in places]

    def links(self, step: Step, group: Group, *, second: bool, before: bool) -> None:
        """Rotation of links that turn with another one; ``before``: those that depend on no unknown."""
        book = self.book
        for joint in group.tree:
            key = f"{joint.child}{second}"
            free = {each.child for each in group.unknowns if each.turns}
            waits = any(each.child in free for each in group.path(joint.child))
            if key in self.written or joint.child in free or (before and waits):
                continue
            self.written.add(key)
            rate = book.alpha if second else book.omega
            formula = rate(joint.parent)
            if joint.turns and joint.driver is not None:
                own = joint.child == book.mechanism.drivers[joint.driver].link
                driver_rate = book.drive(joint.driver)[2 if second else 1]
                formula = formula + driver_rate if own else formula - driver_rate
            if not rate(joint.child).is_zero:
                step.find(rate(joint.child), formula, Output("angle", joint.child).course[1 + second])


def named_points(book: SymbolTable, link: str) -> Iterator[tuple[str, PointState]]:
    """The points of a moving link, its mass centre last if it has mass."""
    part = book.mechanism.links[link]
    for point in part.points:
        yield point, book.spot(link, point)
    if part.mass and book.centre_name(link) == "@centre":
        yield "@centre", book.spot(link, "@centre")


def _start(book: SymbolTable, joint: TreeJoint) -> tuple[str, PointState, str, PointState]:
    """Where a joint holds its two links: point of the parent, point of the child."""
    held, own = attach(joint, joint.parent, book), attach(joint, joint.child, book)
    return held, book.spot(joint.parent, held), own, book.spot(joint.child, own)


def place_points(book: SymbolTable, places: Places, step: Step, group: Group) -> None:
    """Places of all points of a group's links, and for groups without closed form the closure put in."""
    for joint in group.tree:
        _unused, held, own, start = _start(book, joint)
        link = joint.child
        at = next((p for p, spot in named_points(book, link) if spot.key in places.known or spot.fixed), None)
        if at is None:
            at = own
            if joint.slides:
                places.point(step, start, _slid(book, joint, held))
            else:
                places.point(step, start, held.place)
        base = book.spot(link, at)
        for point, spot in named_points(book, link):
            arm = turned(book.arm(link, at, point), book.turn(link))
            places.point(step, spot, base.place + arm)


def _slid(book: SymbolTable, joint: TreeJoint, held: PointState) -> Pair:
    """Place of the point by which a guide holds its second link."""
    prismatic = book.mechanism.guides[joint.joint]
    slide = book.slide(joint.joint)
    shift = slide.along.times(slide.s)
    if prismatic.offset:
        name = f"h_{joint.joint}"
        shift = shift + slide.along.perp.times(symbol(name, prismatic.offset))
    return held.place + shift if joint.child == prismatic.block else held.place - shift


def cut_displacements(book: SymbolTable, places: Places, step: Step, group: Group) -> None:
    """Displacements of the guides at which a group was cut."""
    for cut in group.cuts:
        if cut.slides:
            slide = places.guide(step, cut.joint)
            held, block = _guide_ends(book, cut.joint)
            places.displacement(step, slide, slide.along.dot(block.place - held.place))


def _guide_ends(book: SymbolTable, joint: str) -> tuple[PointState, PointState]:
    prismatic = book.mechanism.guides[joint]
    return book.spot(prismatic.guide, prismatic.through), book.spot(prismatic.block, prismatic.at)


def check_closure(book: SymbolTable, places: Places, step: Step, group: Group) -> None:
    """What is left of the closure equations with the numbers put in: zero but for rounding."""
    step.note(book.translate(_("The closure put in: what is left is zero to the digits shown.")))
    for cut in group.cuts:
        if cut.higher:
            continue
        ends = []
        for end in (cut.a, cut.b):
            name = book.mechanism.joints[cut.joint].point_on(end)
            at = attach_of(book, group, end)
            base = book.spot(end, at)
            arm = turned(book.arm(end, at, name), book.turn(end)) if end != "frame" else None
            spot = book.spot(end, name)
            ends.append(spot.place if arm is None or (spot.fixed and end == "frame") else base.place + arm)
        gap = ends[0] - ends[1]
        if cut.turns:
            rows = (("x", gap.x), ("y", gap.y))
        else:
            slide, joint = book.slide(cut.joint), book.mechanism.guides[cut.joint]
            off = symbol(f"h_{cut.joint}", joint.offset) if joint.offset else number(0.0)
            rows = (("n", slide.along.cross(-gap) - off),)  # type: ignore[assignment]
        for c, row in rows:
            zero = symbol(f"Δ{c}_{cut.joint}", 0.0)
            step.find(zero, row, "m")
    places.check_pairs(step, pair_closures(book, group, ()))


def attach_of(book: SymbolTable, group: Group, link: str) -> str:
    """The point by which a link hangs in its chain; any point for a link solved before."""
    for joint in group.tree:
        if joint.child == link:
            return attach(joint, link, book)
    return next(iter(book.mechanism.link(link).points))


class Movers:
    """Writes velocities and accelerations of points; remembers which are known."""

    def __init__(self, book: SymbolTable) -> None:
        self.book = book
        self.velocities: set[str] = set()
        self.accelerations: set[str] = set()

    def move(self, step: Step, group: Group, *, second: bool) -> None:
        """Velocities (or accelerations) of all points of a group's links."""
        book = self.book
        known = self.accelerations if second else self.velocities
        for joint in group.tree:
            _unused, held, own, start = _start(book, joint)
            if joint.slides:
                formula = self._slid(joint, held, start, second=second)
            else:
                formula = held.acceleration if second else held.velocity
            self._note(step, start, formula, known, second=second)
            for point, spot in named_points(book, joint.child):
                if point != own:
                    self._note(
                        step, spot, self._carried(joint.child, start, spot, second=second), known, second=second
                    )

        self._guides(step, group, second=second)

    def _guides(self, step: Step, group: Group, *, second: bool) -> None:
        """Rates of driven guides, and of the guides at which the group was cut."""
        book = self.book
        for cut in group.cuts:
            if not cut.slides:
                continue
            slide = book.slide(cut.joint)
            held, block = _guide_ends(book, cut.joint)
            motion = block.acceleration if second else block.velocity
            carried = self._carried(cut.a, held, block, second=second)
            self._guide(step, slide, slide.along.dot(motion - carried), second=second)

    def driven_guides(self, step: Step, group: Group, *, second: bool) -> None:
        """Rates of driven guides, which everything else in the group follows."""
        for joint in group.tree:
            if joint.slides and joint.driver is not None:
                rate = self.book.drive(joint.driver)[2 if second else 1]
                self._guide(step, self.book.slide(joint.joint), rate, second=second)

    @staticmethod
    def _guide(step: Step, slide: Slide, formula: Term, *, second: bool) -> None:
        found = Output("displacement", slide.joint).course[1 + second]
        step.find(slide.second if second else slide.rate, formula, found)

    def _note(self, step: Step, spot: PointState, formula: Pair, known: set[str], *, second: bool) -> None:
        if spot.key in known or spot.fixed:
            return
        known.add(spot.key)
        target = spot.acceleration if second else spot.velocity
        kind = "acceleration" if second else "velocity"
        for c, term, part in (("x", target.x, formula.x), ("y", target.y, formula.y)):
            step.find(term, part, Places.output(spot, kind, c))

    def _carried(self, link: str, start: PointState, spot: PointState, *, second: bool) -> Pair:
        arm = spot.place - start.place
        omega = self.book.omega(link)
        if not second:
            return start.velocity + arm.perp.times(omega)
        return start.acceleration + arm.perp.times(self.book.alpha(link)) - arm.times(omega.squared)

    def _slid(self, joint: TreeJoint, held: PointState, start: PointState, *, second: bool) -> Pair:
        """Through a guide: carried motion, motion along the guide, and for accelerations Coriolis'."""
        book = self.book
        slide = book.slide(joint.joint)
        sign = 1 if joint.child == joint.connection.b else -1
        carried = self._carried(joint.parent, held, start, second=second)
        along = slide.along.times(slide.second if second else slide.rate)
        found = carried + along if sign > 0 else carried - along
        if second:
            coriolis = slide.along.perp.times(TWO * book.omega(joint.parent) * slide.rate)
            found = found + coriolis if sign > 0 else found - coriolis
        return found
