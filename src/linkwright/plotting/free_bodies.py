"""Free bodies: all that acts on a link at one position, and the picture of the link by itself.

All that acts on a link is in balance: the forces add up to zero, and so do their moments about any point.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import owners_of
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.kinetostatics.forces import Forces, link_numbers
from linkwright.kinetostatics.link_balance import AppliedWrench, applied_wrenches, driver_wrenches
from linkwright.pictures.drawing import Sketch, bounds
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import GRAPHICAL, Line, SvgNode, round_up
from linkwright.pictures.svg import group
from linkwright.pictures.symbols.base import SYMBOLS, points, vec
from linkwright.plotting.drawing.machine import DrawnMechanism, Part, View
from linkwright.plotting.drawing.scene import Scene, parts_of, point_labels
from linkwright.plotting.drawing.vectors import NAME_SIZE, NOTHING, force_vectors, link_middle

#: Roles with the classes of their arrows.
STYLES = {
    "reaction": "lw-force",
    "load": "lw-load",
    "friction": "lw-load",
    "weight": "lw-weight",
    "inertia": "lw-inertia",
    "driver": "lw-driver",
}


@dataclass(frozen=True)
class Action:
    """A force (2,) N at a place (2,) m, frame axes, or a couple, N·m, that is drawn there.

    ``letter`` and ``index`` make its symbol: F with 12 is what link 1 exerts on link 2.
    """

    role: str
    letter: str
    index: str
    place: Floats
    force: Floats
    torque: float = 0.0

    @property
    def couple(self) -> bool:
        """Whether it is a couple."""
        return not self.force.any()

    @property
    def size(self) -> float:
        """Size of the force, N."""
        return float(np.hypot(*self.force))

    @property
    def symbol(self) -> str:
        """Letter and index on one line."""
        return self.letter + (f"_{self.index}" if self.index else "")

    def moment(self, about: Floats) -> float:
        """Its moment about a point, N·m, counter-clockwise."""
        x, y = self.place - about
        return float(x * self.force[1] - y * self.force[0] + self.torque)


@dataclass(frozen=True)
class FreeBody:
    """A link with all that acts on it; ``centre``: its mass centre (2,) m."""

    link: str
    number: int
    centre: Floats
    actions: tuple[Action, ...]

    @property
    def forces(self) -> list[Action]:
        """Those of its actions that are forces."""
        return [each for each in self.actions if not each.couple]

    @property
    def couples(self) -> list[Action]:
        """Those that are couples."""
        return [each for each in self.actions if each.couple]


def free_bodies(forces: Forces, index: int) -> list[FreeBody]:
    """All links on which something acts, groups in the order of statics: the last of the motion first.

    What is less than a billionth of the largest of the machine is left out.
    """
    applied = [each for each in applied_wrenches(forces, index) if each.link != "frame" and not each.idle]
    found = [
        _body(forces, link, index, applied)
        for group in reversed(forces.motion.structure.groups)
        for link in group.links
    ]
    force = max((each.size for body in found for each in body.forces), default=0.0)
    torque = max((abs(each.torque) for body in found for each in body.couples), default=0.0)
    reach = max((link.reach for link in forces.mechanism.links.values()), default=0.0)
    force_threshold, torque_threshold = NOTHING * force, NOTHING * max(torque, force * reach)
    drawn = []
    for body in found:
        actions = tuple(
            a for a in body.actions if (abs(a.torque) > torque_threshold if a.couple else a.size > force_threshold)
        )
        if actions:
            drawn.append(FreeBody(body.link, body.number, body.centre, actions))
    return drawn


def idle_loads(forces: Forces, index: int) -> list[str]:
    """The loads that do nothing to any moving link at a position."""
    acting = {each.name for each in applied_wrenches(forces, index) if each.link != "frame" and not each.idle}
    return [name for name in forces.mechanism.loads if name not in acting]


def _body(forces: Forces, link: str, index: int, applied: Sequence[AppliedWrench]) -> FreeBody:
    centre = np.asarray(forces.motion.link(link).centre.position[index])
    number = link_numbers(forces.mechanism)[link]
    actions = [
        *_reactions(forces, link, index),
        *_applied(forces, link, index, applied),
        *_own(forces, link, index, number),
        *_drivers(forces, link, index),
    ]
    return FreeBody(link, number, centre, tuple(actions))


def _reactions(forces: Forces, link: str, index: int) -> Iterator[Action]:
    """Forces of joints, those of teeth and cams on their lines of action; couples of guides and welds."""
    names = [f"{link}.{name}" for name, joint in forces.mechanism.joints.items() if link in joint.joined]
    arrows = force_vectors(forces, names)
    pushes, couples = arrows.vectors[0], arrows.torques[0]
    for name, (letter, low) in pushes.symbols.items():
        yield Action("reaction", letter, low, pushes.feet[name][index], pushes.values[name][index])
    for name, (letter, low) in couples.symbols.items():
        yield _couple("reaction", letter, low, couples.places[name][index], couples.values[name][index])


def _couple(role: str, letter: str, index: str, place: Floats, torque: float) -> Action:
    return Action(role, letter, index, np.asarray(place), np.zeros(2), float(torque))


def _applied(forces: Forces, link: str, index: int, applied: Sequence[AppliedWrench]) -> Iterator[Action]:
    """Loads and friction; of a load with a force and a torque both."""
    own = [each for each in applied if each.link == link]
    count = Counter(each.name for each in own)
    for number, each in enumerate(own, 1):
        rubbing = "".join(owners_of("friction", [each.name])) if each.name not in forces.mechanism.loads else ""
        role = "friction" if rubbing else "load"
        name = f"{each.name}_{number}" if count[each.name] > 1 else each.name
        force, place = np.array(each.force), np.array(each.place)
        if force.any():
            letter, low = ("F", f"f,{rubbing}") if rubbing else (name, "")
            yield Action(role, letter, low, place, force)
        if each.torque:
            letter, low = ("M", f"f,{rubbing}") if rubbing else ("M", name) if force.any() else (name, "")
            shown = place if force.any() else _turned_at(forces, link, rubbing, index)
            yield _couple(role, letter, low, shown, each.torque)


def _turned_at(forces: Forces, link: str, joint: str, index: int) -> Floats:
    """Where a couple is shown: at its joint, else at a pin of the link on the frame or at its mass centre."""
    motion = forces.motion
    known = joint in forces.mechanism.joints
    places = motion.reaction_place(joint) if known else link_middle(motion, link)
    return np.asarray(places[index])


def _own(forces: Forces, link: str, index: int, number: int) -> Iterator[Action]:
    """Weight, inertia force and inertia couple at the mass centre."""
    part, state = forces.mechanism.links[link], forces.motion.link(link)
    centre = np.asarray(state.centre.position[index])
    gravity = np.asarray(forces.mechanism.gravity, dtype=float)
    if part.mass and gravity.any():
        yield Action("weight", "G", str(number), centre, part.mass * gravity)
    if forces.static or not forces.mechanism.drivers:
        return
    inertia = -part.mass * np.asarray(state.centre.acceleration[index])
    if inertia.any():
        yield Action("inertia", "F", f"I{number}", centre, inertia)
    couple = -part.inertia * float(state.angular_acceleration[index])
    if couple:
        yield _couple("inertia", "M", f"I{number}", centre, couple)


def _drivers(forces: Forces, link: str, index: int) -> Iterator[Action]:
    """What drivers exert on the link that they drive, and on the one against which they do."""
    mechanism = forces.mechanism
    for name, force, couple in driver_wrenches(forces, link):
        low = "d" if len(mechanism.drivers) == 1 else f"d,{name}"
        joint = mechanism.joints[mechanism.drivers[name].joint]
        place = np.asarray(forces.motion.reaction_place(joint.name)[index])
        letter = "M" if joint.coordinate == "turn" else "F"
        yield Action("driver", letter, low, place, force[index], float(couple[index]))


#: Printed width of a unit of the paper, mm.
MILLIMETRE = 0.25
#: Arrows shorter than SHORT mm are drawn STUB mm long and dashed.
SHORT, STUB = 2.5, 4.0
#: How far an arrow's point keeps from the place on which it presses, and how far it may be moved along its line.
GAP, MOVES = 6.0, (0.0, 42.0, 84.0, 126.0)
#: Nearer than this two lines cover each other; the part of an arrow next to its place does not count.
NEAR, FREE = 6.0, 12.0
#: Radius of the first arc at a place, and of the next ones.
RADIUS, WIDER = 17.0, 8.0


@dataclass(frozen=True)
class Arrow:
    """The arrow of a force on the paper: foot and point, (2,) units; ``to_scale``: whether its length is the force's.

    ``place``: where the force acts.
    """

    action: Action
    foot: Floats
    point: Floats
    place: Floats
    to_scale: bool

    @property
    def elements(self) -> tuple[SvgNode, ...]:
        """The arrow with its line of action up to its place, where it is drawn away from that."""
        style = STYLES[self.action.role]
        shown = SYMBOLS["arrow"](start=vec(self.foot), end=vec(self.point), style=style).elements
        arrow = group(shown, None if self.to_scale else "lw-short", **{"data-action": self.action.symbol})
        near = min((self.foot, self.point), key=lambda end: math.dist(end, self.place))
        if math.dist(near, self.place) < 2 * GAP:
            return (arrow,)
        return Line(points([near, self.place]), "lw-leader"), arrow

    @property
    def ink(self) -> Floats:
        """Foot and point, (2, 2)."""
        return np.array([self.foot, self.point])

    @property
    def label(self) -> Label:
        """Its symbol, at its free end or along it."""
        ends = sorted((self.foot, self.point), key=lambda end: -math.dist(end, self.place))
        places = tuple(vec(ends[0] + share * (ends[1] - ends[0])) for share in (0.0, 0.25, 0.5, 0.75))
        return _label(self.action, places, 5.0)


def _label(action: Action, places: tuple[tuple[float, float], ...], clear: float) -> Label:
    style = f"{STYLES[action.role]}-name"
    return Label(action.letter, places, style, NAME_SIZE, clear, index=action.index)


def arranged(actions: Sequence[Action], view: View, per_newton: float, body: Sequence[Floats]) -> list[Arrow]:
    """The arrows of forces, the largest first; ``per_newton``: units of the paper; ``body``: the link's lines."""
    chosen: list[Arrow] = []
    link = _sampled(body)
    for action in sorted(actions, key=lambda each: -each.size):
        place = np.asarray(view.paper(action.place))
        options = list(_options(action, place, per_newton))
        costs = [
            0.02 * moved + _covered(each, link, 1.0) + sum(_covered(each, _sampled([o.ink]), 4.0) for o in chosen)
            for each, moved in options
        ]
        chosen.append(options[int(np.argmin(costs))][0])
    return chosen


def _options(action: Action, place: Floats, per_newton: float) -> Iterator[tuple[Arrow, float]]:
    """Arrows that go from the place or end at it, and the same moved along their line; how far they are moved."""
    along = action.force * (1.0, -1.0) / action.size
    length = per_newton * action.size
    to_scale = length * MILLIMETRE >= SHORT
    if not to_scale:
        length = STUB / MILLIMETRE
    for moved in MOVES:
        foot = place + moved * along
        yield Arrow(action, foot, foot + length * along, place, to_scale), moved
        point = place - (moved + GAP) * along
        yield Arrow(action, point - length * along, point, place, to_scale), moved + GAP


def _sampled(lines: Sequence[Floats]) -> Floats:
    """Points along polylines, (n, 2), nearer to each other than lines that cover each other."""
    found = [np.zeros((0, 2))]
    for line in lines:
        for start, end in pairwise(line):
            if np.isfinite([start, end]).all():
                count = 2 + int(math.dist(start, end) / (0.7 * NEAR))
                found.append(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))
    return np.concatenate(found)


def _covered(arrow: Arrow, others: Floats, weight: float) -> float:
    """Share of an arrow that lies on other lines, times a weight."""
    own = _sampled([arrow.ink])
    own = own[np.hypot(*(own - arrow.place).T) > FREE]
    if not len(own) or not len(others):
        return 0.0
    gaps = np.hypot(*(own[:, None] - others[None]).transpose(2, 0, 1))
    return weight * float(np.mean(gaps.min(axis=1) < NEAR))


def arcs(couples: Sequence[Action], view: View) -> tuple[list[SvgNode], list[Floats], list[Label]]:
    """Arcs of couples about their places, wider where several have one place, their ink, and their symbols."""
    found, ink, labels, used = list[SvgNode](), list[Floats](), [], list[Floats]()
    for each in couples:
        at = np.asarray(view.paper(each.place))
        radius = RADIUS + WIDER * sum(math.dist(at, other) < 4.0 for other in used)
        used.append(at)
        turning = 1 if each.torque > 0 else -1
        shape = SYMBOLS["moment"](at=vec(at), turning=turning, radius=radius, style=STYLES[each.role])
        found.append(group(shape.elements, None, **{"data-action": each.symbol}))
        ink += shape.ink
        sides = [(0.0, -1.0), (0.7, -0.7), (-0.7, -0.7), (1.0, 0.0), (-1.0, 0.0)]
        labels.append(_label(each, tuple((at[0] + radius * x, at[1] + radius * y) for x, y in sides), 6.0))
    return found, ink, labels


#: Longest link and longest arrow, mm: the first pair with which a picture fits its place is taken, the last at most.
SIZES = ((46.0, 28.0), (38.0, 25.0), (31.0, 22.0), (25.0, 18.0), (20.0, 14.0), (16.0, 11.0), (12.0, 8.0), (7.0, 6.0))
#: Millimetres of the complete machine where sizes are read off a drawing of it.
FINE = 400.0


class LinkShapes:
    """The links of a motion at one position, drawn to any scale."""

    def __init__(self, motion: Motion, index: int) -> None:
        self.motion, self.index = motion, index
        self._placed = placements(motion)
        self.scene = cache(self._scene)

    def _scene(self, metres: float) -> Scene:
        """All parts, ``metres`` a printed millimetre."""
        view = View(1.0 / (metres * MILLIMETRE))
        machine = DrawnMechanism(self.motion, self._placed, view)
        return Scene(machine, tuple(parts_of(machine)))

    def of(self, link: str, metres: float) -> Scene:
        """The parts of one link, with all of its pins and its mass centre."""
        scene = self.scene(metres)
        own = [part for part in scene.parts if part.carrier == link and part.layer != "marks"]
        machine = scene.machine
        for name, joint in machine.pins.items():
            if link in joint.links:
                own.append(Part("pins", link, SYMBOLS["pin"](at=machine.local(link, name))))
        body = self.motion.mechanism.links[link]
        if body.mass:
            own.append(Part("marks", link, SYMBOLS["mass_centre"](at=machine.view.local(body.centre))))
        return Scene(machine, tuple(own))

    def reach(self, link: str) -> float:
        """The longer side of a link in its position, with its wheels and racks, m; zero of one that is a point."""
        body = self.motion.mechanism.links[link]
        places = [self._placed[link].world(at)[self.index] for at in (*body.points.values(), body.centre)]
        scene = self.scene(self._extent / FINE)
        wheels = tuple(part for part in scene.parts if part.carrier == link and part.layer == "ground")
        view = scene.machine.view
        ink = [view.paper(np.array(places)), *Scene(scene.machine, wheels).ink(self.index)]
        left, top, right, bottom = bounds(ink)
        return max(right - left, bottom - top) / view.scale

    @cached_property
    def _extent(self) -> float:
        """The longer side of all points in their position, m."""
        links = self.motion.mechanism.links.values()
        places = [self._placed[link.name].world(at)[self.index] for link in links for at in link.points.values()]
        return float(np.ptp(np.array(places), axis=0).max()) or 1.0


def body_sketch(shapes: LinkShapes, body: FreeBody, usual: float, room: tuple[float, float]) -> BodySketch:
    """The picture of a link, as large as fits ``room`` (units of the paper).

    ``usual``: metres per millimetre of a link that is but a point.
    """
    reach = shapes.reach(body.link)
    force = max((each.size for each in body.forces), default=0.0)
    for length, longest in SIZES:
        metres = round_up(reach / length, GRAPHICAL) if reach else usual
        newtons = round_up(force / longest, GRAPHICAL) if force else None
        drawn = BodySketch(shapes, body, metres, newtons)
        last = (length, longest) == SIZES[-1]
        if last or drawn.fits(room):
            drawn.write_names()
        if last or drawn.fits(room):
            break
    return drawn


class BodySketch(Sketch):
    """A link with its arrows and arcs to ``metres`` and ``newtons`` per printed millimetre; ``shortened``: whether an
    arrow is not to scale."""

    def __init__(self, shapes: LinkShapes, body: FreeBody, metres: float, newtons: float | None) -> None:
        super().__init__()
        self.body, self.metres, self.newtons = body, metres, newtons
        scene = shapes.of(body.link, metres)
        view = scene.machine.view
        self.draw(scene.at(shapes.index), scene.ink(shapes.index))
        per_newton = 1.0 / (newtons * MILLIMETRE) if newtons else 0.0
        arrows = arranged(body.forces, view, per_newton, self.ink)
        for arrow in arrows:
            self.draw(arrow.elements, [arrow.ink])
            self.labels.append(arrow.label)
        turns, turned, names = arcs(body.couples, view)
        self.draw(turns, turned)
        points_named = point_labels(scene.machine, shapes.index, [body.link])
        self.labels += [*names, *(replace(label, size=13.0) for label in points_named)]
        self.shortened = any(not arrow.to_scale for arrow in arrows)

    def fits(self, room: tuple[float, float]) -> bool:
        """Whether what is drawn so far is no larger than a room."""
        left, top, right, bottom = self.box
        return right - left <= room[0] and bottom - top <= room[1]
