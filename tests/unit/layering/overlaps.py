"""What overlaps in a machine, by shapely at many positions, and what its layers must keep, told anew.

Nothing is taken from the code that finds the layers but the solids themselves and which contacts are meant.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product

import numpy as np
import shapely
from shapely.affinity import affine_transform

import linkwright as lw
from linkwright.core.arrays import Floats
from linkwright.kinematics.placement import placements
from linkwright.shapes.shape import Shape
from linkwright.solids.solid import Solid, Solids

#: Sides of a quarter of a circle, and the share of a machine's size by which overlaps are mere contact.
SEGMENTS, CONTACT = 32, 1e-4
Overlap = tuple[tuple[str, str], tuple[str, str]]


@dataclass(frozen=True)
class Oracle:
    """The solids of a machine at so many positions of its cycle."""

    mechanism: lw.Mechanism
    solids: Solids
    steps: int

    @cached_property
    def overlaps(self) -> list[Overlap]:
        """All pairs of bodies and heads that overlap somewhere, by more than mere contact."""
        placed = placements(lw.solve_motion(self.mechanism, steps=self.steps))
        shrink = CONTACT * self.mechanism.size
        outlines = {
            (solid.name, part): [
                affine_transform(outline, [c, -s, s, c, x, y])
                for (x, y), (c, s) in zip(placed[solid.carrier].origin, placed[solid.carrier].direction, strict=True)
            ]
            for solid in self.solids.by_name.values()
            for part, outline in _outlines(solid, shrink)
        }
        return [
            (one, other)
            for one, other in combinations(outlines, 2)
            if tuple(sorted((one[0], other[0]))) not in self.solids.joined and one[0] != other[0]
            if shapely.intersects(outlines[one], outlines[other]).any()
        ]

    def reached(self, layer: Mapping[str, int], name: str, part: str) -> set[int]:
        """The layers of a body, or of its heads: pins end in base and cover without heads."""
        plates = self.solids.by_name[name].plates
        low, high = min(layer[each] for each in plates), max(layer[each] for each in plates)
        if part == "body":
            return {*range(low, high + 1)}
        return {*([low - 1] if "frame" not in plates else []), *([high + 1] if "cover" not in plates else [])}

    def collisions(self, layer: Mapping[str, int]) -> list[Overlap]:
        """What overlaps in one layer."""
        return [each for each in self.overlaps if self.reached(layer, *each[0]) & self.reached(layer, *each[1])]

    def assignments(self, count: int) -> Iterator[Mapping[str, int]]:
        """All ways to put the plates into so many layers above the frame's in which nothing collides."""
        ends = {"frame": 0, "cover": count}
        own = {name: each for name, each in ends.items() if name in self.solids.by_name}
        free = [name for name, each in self.solids.by_name.items() if each.is_plate and name not in own]
        for each in product(range(1, count + 1 - ("cover" in own)), repeat=len(free)):
            layer = dict(zip(free, each, strict=True)) | own
            level = all(layer[one] == layer[other] for one, other in self.solids.level)
            if level and not any(self.reached(layer, *a) & self.reached(layer, *b) for a, b in self.overlaps):
                yield layer

    def pins(self, layer: Mapping[str, int]) -> int:
        """How many layers all that is no plate reaches through."""
        return sum(len(self.reached(layer, name, "body")) for name in self.solids.by_name)


def _outlines(solid: Solid, shrink: float) -> Iterator[tuple[str, shapely.Geometry]]:
    yield "body", _outline(solid.shape).buffer(-shrink)
    if solid.head:
        place = solid.shape.pieces[0].corners[0]
        yield "heads", shapely.Point(place.real, place.imag).buffer(solid.head - shrink, SEGMENTS)


def _outline(shape: Shape) -> shapely.Geometry:
    return shapely.union_all([_piece(each.rings, each.radius, filled=each.filled) for each in shape.pieces])


def _piece(rings: tuple[Floats, ...], radius: float, *, filled: bool) -> shapely.Geometry:
    paths = [np.stack([ring.real, ring.imag], axis=1) for ring in rings]
    if filled:
        core = shapely.Polygon(paths[0], paths[1:])
    else:
        core = shapely.LineString(paths[0]) if len(paths[0]) > 1 else shapely.Point(paths[0][0])
    return core.buffer(radius, SEGMENTS) if radius else core
