"""The exploded view of a machine: all parts lifted along their axes, layer by layer, in dimetric projection."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.fabrication.bodies import bodies_of, pale
from linkwright.fabrication.body import Body, Pose, Section
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.part import Part, Place
from linkwright.fabrication.parts_list import called
from linkwright.kinematics.motion import Motion
from linkwright.pictures.drawing import Sketch
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Vec
from linkwright.pictures.svg import element, path_data
from linkwright.words import Translate

#: Dimetric projection of ISO 5456-3: x at 7 degrees at full length, y at 42 degrees at half of it, heights upright.
X_AXIS = np.exp(-1j * math.radians(7.0))
Y_AXIS = 0.5 * np.exp(1j * math.radians(42.0))
#: Largest width and height of the machine on the paper; the gap between layers as a share of the depth of the machine
#: there, its smallest.
WIDE, HIGH, SHARE, GAP = 640.0, 900.0, 0.3, 48.0
#: How far blocks are above their guides, washers and pins above the plates below them, as shares of the gap.
BLOCK, ABOVE = 0.35, 0.45
#: Largest distance of chords from arcs, angle of a corner that is drawn, sizes of letters; distance of the lines that
#: keep names away from faces.
FINE, CORNER, LETTERS, ROWS = 0.15, math.radians(25.0), 12.5, 9.0
CSS = (
    ".lw-top,.lw-wall{stroke-linejoin:round;stroke:none}.lw-outline{fill:none;stroke:#1c2733;stroke-width:1.2;"
    "stroke-linejoin:round;stroke-linecap:round}"
    ".lw-centre{fill:none;stroke:#5b6672;stroke-width:.9;stroke-dasharray:12 3 2 3}"
)


def exploded_view(cut: CutParts, motion: Motion, translate: Translate, index: int = 0) -> Sketch:
    """All parts at a position of the motion, lifted layer by layer, with the axes that they share."""
    return _Exploded(cut, motion, index).drawn(translate)


@dataclass(frozen=True, eq=False)
class _Item:
    """A part at one place, how high it is lifted on the paper, and the axis on which it is, if it is a round part."""

    part: Part
    body: Body
    pose: Pose
    place: Place
    lift: float

    @property
    def tall(self) -> float:
        """From its lowest to its highest face, m."""
        return self.body.sections[-1].high - self.body.sections[0].low


class _Exploded:
    """An exploded view in the making."""

    def __init__(self, cut: CutParts, motion: Motion, index: int) -> None:
        self.cut = cut
        self.bodies = bodies_of(cut, motion, index)
        ground = np.concatenate([self._ground(pose, body) for body in self.bodies for pose in body.poses])
        flat = _projected(ground)
        self.scale = WIDE / float(np.ptp(flat.real))
        self.depth = float(np.ptp(flat.imag))
        tall = self._lifts[-1][1] + self.scale * self.depth
        if tall > HIGH:
            self.scale *= HIGH / tall
            del self._lifts

    @property
    def gap(self) -> float:
        """The smallest gap between what is in one layer and what is above it, on the paper."""
        return max(SHARE * self.scale * self.depth, GAP)

    @staticmethod
    def _ground(pose: Pose, body: Body) -> Complexes:
        """The corners of a body seen from above, m."""
        return np.concatenate([pose.of(loop.points(1e-3)) for each in body.sections for loop in each.loops])

    @cached_property
    def floors(self) -> list[tuple[float, float]]:
        """Lower and upper face of every layer that has plates, m, from below."""
        layers = self.cut.layers
        found = []
        for layer in sorted(set(layers.layer.values())):
            ends = [layers.height[plate] for plate, own in layers.layer.items() if own == layer]
            found.append((min(low for low, _ in ends), max(high for _, high in ends)))
        return found

    @cached_property
    def items(self) -> list[_Item]:
        """All parts at all places in the order in which they cover each other."""
        found = []
        for part, body in zip(self.cut.parts, self.bodies, strict=True):
            for place, pose in zip(part.places, body.poses, strict=True):
                found.append(_Item(part, body, pose, place, self._lift(part, place)))
        return sorted(
            found, key=lambda item: (item.lift, -float(_projected(self._ground(item.pose, item.body)).imag.min()))
        )

    @cached_property
    def _lifts(self) -> list[tuple[float, float]]:
        """How high the lower and the upper faces of the layers are on the paper, with room for what is between."""
        between = [0.0] * len(self.floors)
        for part in self.cut.parts:
            if part.sort != "plate":
                for place in part.places:
                    floor = self._below(part, place)
                    between[floor] = max(between[floor], self.scale * (part.length + sum(part.heads)))
        found, lift = [], 0.0
        for (low, high), tall in zip(self.floors, between, strict=True):
            found.append((lift, lift + self.scale * (high - low)))
            lift = found[-1][1] + tall + self.gap
        return found

    def _lift(self, part: Part, place: Place) -> float:
        """How high a part is on the paper: plates by their layers, pins above their highest one, rings between."""
        lower, upper = self._lifts[self._below(part, place)]
        if part.sort != "plate":
            return upper + ABOVE * self.gap
        solid = self.cut.layers.solids.by_name.get(part.name)
        return lower + (BLOCK * self.gap if solid is not None and solid.sort == "block" else 0.0)

    def _below(self, part: Part, place: Place) -> int:
        """The layer of a plate, the highest one of a pin, that below a ring."""
        return self._floor(place.z + part.length - 1e-9 if part.sort == "pin" else place.z)

    def _floor(self, z: float) -> int:
        """The number of the highest layer that begins at a height or below."""
        return max((k for k, (low, _high) in enumerate(self.floors) if low <= z + 1e-9), default=0)

    def paper(self, places: Complexes, lift: float) -> Floats:
        """Places in the frame, m, that are lifted, on the paper."""
        flat = self.scale * _projected(places)
        return np.column_stack([flat.real, -flat.imag - lift])

    def drawn(self, translate: Translate) -> Sketch:
        """The whole view."""
        paper = Sketch()
        paper.content.append(element("style", None, CSS))
        for item in self.items:
            self._part(paper, item)
            self._axis(paper, item)
        self._names(paper, translate)
        return paper

    def _part(self, paper: Sketch, item: _Item) -> None:
        """Walls that face the viewer, then the upper face of every section from below."""
        bottom = item.body.sections[0].low
        for section in item.body.sections:
            lift = item.lift + self.scale * (section.low - bottom)
            tall = self.scale * (section.high - section.low)
            rings = [self.paper(item.pose.of(loop.points(FINE / self.scale)), lift) for loop in section.loops]
            for ring in (*rings[1:], rings[0]):  # walls of holes go on behind the wall in front of them
                for wall in _walls(ring):
                    self._wall(paper, wall, tall, item.body.colour)
            tops = [ring - (0.0, tall) for ring in rings]
            data = "".join(path_data(top, closed=True) for top in tops)
            style = {"fill": pale(item.body.colour, 0.5), "fill-rule": "evenodd"}
            paper.draw([element("path", {"class": "lw-top", "d": data, **style})])
            paper.draw([element("path", {"class": "lw-outline", "d": data})], [_closed(top) for top in tops])

    def _wall(self, paper: Sketch, wall: Floats, tall: float, colour: str) -> None:
        """A wall over a line of the outline, with its corners."""
        up = wall - (0.0, tall)
        data = path_data(np.vstack([wall, up[::-1]]), closed=True)
        paper.draw([element("path", {"class": "lw-wall", "d": data, "fill": pale(colour, 0.85)})])
        paper.ink += _rows(np.vstack([wall, up[::-1]]))
        way = np.diff(wall, axis=0)
        turn = np.abs(np.diff(np.unwrap(np.arctan2(way[:, 1], way[:, 0]))))
        corners = [0, *(np.flatnonzero(turn > CORNER) + 1).tolist(), len(wall) - 1]
        lines = [wall, *(np.array([wall[k], up[k]]) for k in corners)]
        paper.draw([element("path", {"class": "lw-outline", "d": "".join(map(path_data, lines))})], lines)

    def _axis(self, paper: Sketch, item: _Item) -> None:
        """The axes from a part up to the next parts on them."""
        for on, place in self._axes(item):
            others = [
                each for each in self.items if each.lift > item.lift and on in {name for name, _ in self._axes(each)}
            ]
            if others:
                start, end = item.lift + self.scale * item.tall, min(each.lift for each in others)
                line = np.vstack([self.paper(np.array([place]), lift) for lift in (start, end)])
                paper.line(line, "lw-centre")

    def _axes(self, item: _Item) -> Iterator[tuple[str, complex]]:
        """The pins on whose axes a part is, with their places in the frame, m."""
        if item.part.sort == "plate":
            yield from ((hole.pin, item.pose.of(hole.centre)) for hole in item.part.holes if hole.pin)
        else:
            yield item.place.on, item.pose.at

    def _names(self, paper: Sketch, translate: Translate) -> None:
        """The names of plates and pins where they are seen, next to material where there is room."""
        tops = [self._top(item) for item in self.items]
        paper.ink += [line for top in tops for line in _rows(top)]
        for k, item in enumerate(self.items):
            if item.part.sort in ("plate", "pin"):
                places = _extremes(tops[k])
                seen = [place for place in places if not any(_inside(place, other) for other in tops[k + 1 :])]
                anchors = tuple(seen or places)
                paper.labels.append(Label(called([item.part], translate), anchors, "lw-legend", LETTERS, 6.0))

    def _top(self, item: _Item) -> Floats:
        """The outline of the upper face of a part on the paper."""
        section: Section = item.body.sections[-1]
        lift = item.lift + self.scale * item.tall
        return self.paper(item.pose.of(section.loops[0].points(FINE / self.scale)), lift)


def _projected(places: Complexes) -> Complexes:
    """Places of the plane in dimetric projection, y up."""
    return np.asarray(X_AXIS * places.real + Y_AXIS * places.imag)


def _walls(ring: Floats) -> Iterator[Floats]:
    """The lines of an outline over which the walls face the viewer: those that go to the right."""
    ahead = np.roll(ring, -1, axis=0)[:, 0] > ring[:, 0]
    starts = np.flatnonzero(ahead & ~np.roll(ahead, 1))
    for start in starts.tolist():
        count = 1
        while ahead[(start + count) % len(ring)]:
            count += 1
        yield ring[(start + np.arange(count + 1)) % len(ring)]


def _closed(ring: Floats) -> Floats:
    return np.vstack([ring, ring[:1]])


def _rows(ring: Floats) -> Iterator[Floats]:
    """Level lines within an outline, which keep names away from it."""
    ahead = np.roll(ring, -1, axis=0)
    for y in np.arange(ring[:, 1].min() + 0.5 * ROWS, ring[:, 1].max(), ROWS).tolist():
        crossing = (ring[:, 1] <= y) != (ahead[:, 1] <= y)
        (x, low), (other, high) = ring[crossing].T, ahead[crossing].T
        places = np.sort(x + (y - low) / (high - low) * (other - x))
        yield from (np.array([(start, y), (end, y)]) for start, end in places.reshape(-1, 2).tolist())


def _extremes(ring: Floats) -> list[Vec]:
    """The leftmost, rightmost, lowest and highest place of an outline."""
    picked = (ring[:, 0].argmin(), ring[:, 0].argmax(), ring[:, 1].argmax(), ring[:, 1].argmin())
    return [(float(ring[k, 0]), float(ring[k, 1])) for k in picked]


def _inside(place: Vec, ring: Floats) -> bool:
    if (ring.max(axis=0) < place).any() or (ring.min(axis=0) > place).any():
        return False
    way = ring[:, 0] - place[0] + 1j * (ring[:, 1] - place[1])
    return bool(np.all(way) and abs(np.angle(np.roll(way, -1) / way).sum()) > np.pi)
