"""What the layers of a machine must keep, from its solids and the smallest gaps between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

from linkwright.collisions.gaps import Gap, Moving, smallest_gaps
from linkwright.kinematics.motion import Motion
from linkwright.layering.problem import Apart, Demand, Fixed, Level, Part, Problem
from linkwright.shapes.shape import Shape, disc
from linkwright.solids.solid import Solid, Solids

BASE, COVER = "frame", "cover"
#: Share of the machine's size by which gaps are found too small at most.
ROUNDING = 1e-9
#: A body or the heads of one.
Piece = tuple[str, Part]


def is_too_small(gap: Gap, clearance: float, motion: Motion) -> bool:
    """Whether a gap is an overlap, or smaller than the clearance, m, by more than rounding."""
    return gap.size <= 0.0 or gap.size < clearance - ROUNDING * motion.mechanism.size


@dataclass(frozen=True, eq=False)
class Demands:
    """The solids of a machine in motion, the plates whose layers are fixed (None: in all layers), and the smallest
    gap (m) that is wanted in one layer."""

    solids: Solids
    motion: Motion
    fixed: Mapping[str, int | None]
    clearance: float

    @cached_property
    def gaps(self) -> Mapping[tuple[Piece, Piece], Gap]:
        """The smallest gaps of all that may be in one layer."""
        pairs = [*self._pairs()]
        found = smallest_gaps(self.motion, [(self._moving(*one), self._moving(*other)) for one, other in pairs])
        return dict(zip(pairs, found, strict=True))

    def problem(self) -> Problem:
        """What must be apart: what overlaps somewhere in the cycle, or comes nearer than the clearance."""
        apart = [
            Apart(one[0], other[0], (one[1], other[1]), gap)
            for (one, other), gap in self.gaps.items()
            if is_too_small(gap, self.clearance, self.motion)
        ]
        level = [Level(*each) for each in self.solids.level if {*each} <= self._known.keys()]
        demands: list[Demand] = [*(Fixed(*each) for each in self.fixed.items()), *level, *apart]
        bodies = {
            name: tuple(plate for plate in each.plates if plate in self._known) for name, each in self._known.items()
        }
        base, cover = (name if name in self._known else "" for name in (BASE, COVER))
        return Problem(bodies, tuple(demands), base, cover)

    def clear_width(self, plate: str, other: str) -> float:
        """The width, m, below which a plate keeps the clearance from another body and its heads; 0 where the line or
        polygon around which it is wide does not."""
        parts: tuple[Part, ...] = ("body", "heads") if self._known[other].head else ("body",)
        pairs = [(self._core(plate), self._moving(other, part)) for part in parts]
        return 2.0 * max(0.0, min(each.size for each in smallest_gaps(self.motion, pairs)) - self.clearance)

    def distance(self, one: str, other: str) -> float:
        """What the radii of two bodies may be together, m, so that they keep the clearance; 0 where none will do."""
        (gap,) = smallest_gaps(self.motion, [(self._core(one), self._core(other))])
        return max(0.0, gap.size - self.clearance)

    def _core(self, name: str) -> Moving:
        """The points, lines or polygons around which a body is wide."""
        solid = self._known[name]
        return Moving(solid.carrier, Shape(tuple(replace(piece, radius=0.0) for piece in solid.shape.pieces)))

    @cached_property
    def _known(self) -> Mapping[str, Solid]:
        return {name: each for name, each in self.solids.by_name.items() if each.shape.pieces}

    def _moving(self, name: str, part: Part) -> Moving:
        solid = self._known[name]
        centre = complex(solid.shape.pieces[0].corners[0])
        return Moving(solid.carrier, solid.shape if part == "body" else disc(centre, solid.head))

    def _pairs(self) -> Iterator[tuple[Piece, Piece]]:
        """Pairs that some layers would bring together: not those whose contact is meant, nor the base and the cover
        with bodies that are always above the one and below the other."""
        for one, other in combinations(self._known.values(), 2):
            if (min(one.name, other.name), max(one.name, other.name)) in self.solids.joined:
                continue
            if not any(self._is_outside(*each) for each in ((one, other), (other, one))):
                yield (one.name, "body"), (other.name, "body")
            if one.head:
                yield (one.name, "heads"), (other.name, "body")
            if other.head:
                yield (one.name, "body"), (other.name, "heads")
            if one.head and other.head:
                yield (one.name, "heads"), (other.name, "heads")

    def _is_outside(self, plate: Solid, body: Solid) -> bool:
        """Whether a plate is the base below, or the cover above, another body in any layers."""
        if plate.name not in (BASE, COVER) or plate.name in body.plates:
            return False
        return plate.name == COVER or not self._reaching_base.intersection(body.plates)

    @cached_property
    def _reaching_base(self) -> frozenset[str]:
        """Plates that layers which are fixed bring to where the base is: all, where the base is in all layers."""
        if BASE in self.fixed and self.fixed[BASE] is None:
            return frozenset(self._known)
        return frozenset(name for name, layer in self.fixed.items() if layer == 0)
