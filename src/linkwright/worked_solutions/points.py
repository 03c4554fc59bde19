"""Points of a group's links: places, velocities, accelerations, each from a point that is known already."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.outputs import Output
from linkwright.elements.topology import Group, TreeJoint
from linkwright.equations.steps import Step
from linkwright.equations.terms import TWO, Pair, Term, number, symbol
from linkwright.words import _
from linkwright.worked_solutions.chains import attach, turned
from linkwright.worked_solutions.higher_pairs import pair_closures
from linkwright.worked_solutions.places import Places
from linkwright.worked_solutions.symbols import PointState, Slide, SymbolTable


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
    step.say(book.say(_("The closure put in: what is left is zero to the digits shown.")))
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
