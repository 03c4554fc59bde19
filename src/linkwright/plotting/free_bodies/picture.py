"""The picture of one link by itself: its shape, and what acts on it to a round scale, clear of each other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.pictures.drawing import bounds
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import GRAPHICAL, Line, SvgNode, round_up
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.svg.element import group
from linkwright.pictures.symbols.base import SYMBOLS, points, vec
from linkwright.plotting.drawing.machine import DrawnMechanism, Part, View
from linkwright.plotting.drawing.scene import Scene, parts_of, point_labels
from linkwright.plotting.drawing.vectors import NAME_SIZE
from linkwright.plotting.free_bodies.actions import STYLES, Action, FreeBody

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
