"""The picture of one link by itself: its shape as it stands, what acts on it to a round scale, the symbols."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache, cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.pictures.drawing import Box, bounds
from linkwright.pictures.labels import Label, Obstacles, place, written
from linkwright.pictures.picture import SvgNode
from linkwright.pictures.symbols.base import SYMBOLS, points
from linkwright.plot.drawing.machine import Machine, Part, View
from linkwright.plot.drawing.scene import Scene, parts_of
from linkwright.plot.free_bodies.actions import FreeBody
from linkwright.plot.free_bodies.arrows import MILLIMETRE, arcs, arranged

#: Longest link and longest arrow, mm: the first pair with which a picture fits its place is taken, the last at most.
SIZES = (
    (46.0, 28.0), (38.0, 25.0), (31.0, 22.0), (25.0, 18.0), (20.0, 14.0), (16.0, 11.0), (12.0, 8.0), (7.0, 6.0),
)  # fmt: skip
#: Millimetres of the whole machine where sizes are read off a drawing of it.
FINE = 400.0
#: Round numbers of scales.
ROUND = (1.0, 2.0, 2.5, 4.0, 5.0, 10.0)


@dataclass(frozen=True)
class BodyPicture:
    """A drawn link: elements over a ``box`` of the paper; metres and newtons per printed millimetre."""

    body: FreeBody
    elements: tuple[SvgNode, ...]
    box: Box
    length_scale: float
    force_scale: float | None
    shortened: bool


def round_scale(largest: float, millimetres: float) -> float:
    """The smallest round scale (1, 2, 2.5, 4, 5 times powers of ten) with which a quantity is at most so many
    millimetres long."""
    raw = largest / millimetres
    power = 10.0 ** math.floor(math.log10(raw))
    return next(k * power for k in ROUND if k * power >= raw * (1.0 - 1e-9))


class LinkShapes:
    """The links of a motion at one position, drawn to any scale."""

    def __init__(self, motion: Motion, index: int) -> None:
        self.motion, self.index = motion, index
        self._placed = placements(motion)
        self.scene = cache(self._scene)

    def _scene(self, metres: float) -> Scene:
        """All parts, ``metres`` a printed millimetre."""
        view = View(1.0 / (metres * MILLIMETRE))
        machine = Machine(self.motion, self._placed, view)
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
        """The longer side of a link as it stands, with its wheels and racks, m; zero of one that is a point."""
        body = self.motion.mechanism.links[link]
        places = [self._placed[link].world(at)[self.index] for at in (*body.points.values(), body.centre)]
        scene = self.scene(self._whole / FINE)
        wheels = tuple(part for part in scene.parts if part.carrier == link and part.layer == "ground")
        view = scene.machine.view
        ink = [view.paper(np.array(places)), *Scene(scene.machine, wheels).ink(self.index)]
        left, top, right, bottom = bounds(ink)
        return max(right - left, bottom - top) / view.scale

    @cached_property
    def _whole(self) -> float:
        """The longer side of all points as they stand, m."""
        links = self.motion.mechanism.links.values()
        places = [
            self._placed[link.name].world(at)[self.index] for link in links for at in link.points.values()
        ]
        return float(np.ptp(np.array(places), axis=0).max()) or 1.0


def body_picture(shapes: LinkShapes, body: FreeBody, usual: float, room: tuple[float, float]) -> BodyPicture:
    """The picture of a link, as large as fits ``room`` (units of the paper).

    ``usual``: metres per millimetre of a link that is but a point.
    """
    reach = shapes.reach(body.link)
    force = max((each.size for each in body.forces), default=0.0)

    def sketch(length: float, longest: float) -> _Sketch:
        metres = round_scale(reach, length) if reach else usual
        return _Sketch(shapes, body, metres, round_scale(force, longest) if force else None)

    for size in SIZES[:-1]:
        drawn = sketch(*size)
        if _fits(bounds(drawn.ink), room) and _fits((found := drawn.finished()).box, room):
            return found
    return sketch(*SIZES[-1]).finished()


def _fits(box: Box, room: tuple[float, float]) -> bool:
    left, top, right, bottom = box
    return right - left <= room[0] and bottom - top <= room[1]


class _Sketch:
    """A link with its arrows and arcs at given scales, without names so far."""

    def __init__(self, shapes: LinkShapes, body: FreeBody, metres: float, newtons: float | None) -> None:
        self.body, self.metres, self.newtons, self.index = body, metres, newtons, shapes.index
        self.scene = shapes.of(body.link, metres)
        view, link = self.scene.machine.view, self.scene.ink(shapes.index)
        per_newton = 1.0 / (newtons * MILLIMETRE) if newtons else 0.0
        self.arrows = arranged(body.forces, view, per_newton, link)
        self.turns, turned, self.labels = arcs(body.couples, view)
        self.ink = [*link, *(a.ink for a in self.arrows), *turned]

    def finished(self) -> BodyPicture:
        """The picture with its names."""
        elements = self.scene.at(self.index)
        elements += [each for arrow in self.arrows for each in arrow.elements]
        elements += self.turns
        labels = [*(arrow.label for arrow in self.arrows), *self.labels]
        labels += _names(self.scene, self.body.link, self.index)
        texts, extent = _placed_labels(labels, self.ink)
        box = bounds([*self.ink, *extent])
        short = any(not arrow.to_scale for arrow in self.arrows)
        return BodyPicture(self.body, (*elements, *texts), box, self.metres, self.newtons, short)


def _names(scene: Scene, link: str, index: int) -> list[Label]:
    """Names of the link's points, each place once."""
    machine, found, seen = scene.machine, [], set[tuple[int, int]]()
    for name in machine.motion.mechanism.links[link].points:
        x, y = machine.paper(link, name, index)
        if (round(x), round(y)) not in seen:
            seen.add((round(x), round(y)))
            found.append(Label(name, ((x, y),), size=13.0, clearance=8.0))
    return found


def _placed_labels(labels: Sequence[Label], ink: Sequence[Floats]) -> tuple[list[SvgNode], list[Floats]]:
    """Labels clear of what is drawn and of each other, and their corners."""
    texts, extent = [], []
    for label, chosen in zip(labels, place(labels, Obstacles.of(ink)), strict=True):
        texts += written(label, chosen)
        left, top, right, bottom = chosen.box
        extent.append(points([(left, top), (right, bottom)]))
    return texts, extent
