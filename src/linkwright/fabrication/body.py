"""Bodies: stacks of prisms with exact outlines, at their places in the machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.shapes.loop import Loop

Place = TypeVar("Place", complex, Complexes)
#: Largest distance between an arc and the chords that stand for it: m, and as a share of half the outline's extent.
FLATTENING, ROUND = 1e-5, 2e-3


@dataclass(frozen=True, eq=False)
class Section:
    """A prism between the heights ``low`` and ``high``, m: the loops of its outline, outer ones counter-clockwise,
    inner ones clockwise."""

    loops: tuple[Loop, ...]
    low: float
    high: float

    @cached_property
    def extent(self) -> float:
        """Width and height of the outline together, m, by which sections are told wider and narrower."""
        lows, highs = zip(*(loop.box for loop in self.loops), strict=True)
        width = max(each.real for each in highs) - min(each.real for each in lows)
        return float(width + max(each.imag for each in highs) - min(each.imag for each in lows))


@dataclass(frozen=True)
class Pose:
    """Where a body is in the machine: its origin ``at`` (m) and its x axis ``along`` (a unit complex number) in the
    axes of the frame, its height ``z`` (m)."""

    at: complex = 0.0
    along: complex = 1.0
    z: float = 0.0

    def of(self, place: Place) -> Place:
        """A place in the body's axes, or several, in those of the frame, m."""
        return self.at + self.along * place

    def local(self, place: complex) -> complex:
        """A place in the axes of the frame in the body's, m."""
        return (place - self.at) / self.along


def link_poses(motion: Motion, index: int) -> dict[str, Pose]:
    """Where every link is at a position of the motion, the frame included."""
    found = {}
    for name, placed in placements(motion).items():
        (x, y), (c, s) = placed.origin[index].tolist(), placed.direction[index].tolist()
        found[name] = Pose(complex(x, y), complex(c, s))
    return found


@dataclass(frozen=True, eq=False)
class Body:
    """A part in space, as often as it has ``poses``: sections from below upwards, each touching the next.

    Where two sections meet, the outline of one lies within the other's and is a single loop, as at the heads of a
    pin; ``colour`` as #rrggbb.
    """

    name: str
    sections: tuple[Section, ...]
    poses: tuple[Pose, ...] = (Pose(),)
    colour: str = "#9fb4c8"


def corners(loop: Loop, tolerance: float = FLATTENING) -> Complexes:
    """A polygon for a loop, (k,), no farther from its arcs than a tolerance (m), and finer where it is small."""
    low, high = loop.box
    return loop.points(min(tolerance, ROUND * 0.5 * max((high - low).real, (high - low).imag)))


def regions(loops: Sequence[Loop]) -> list[tuple[Loop, ...]]:
    """Outer loops, each with the inner ones that lie within it."""
    found = [[loop] for loop in loops if loop.area > 0]
    for loop in loops:
        if loop.area <= 0:
            start = loop.edges[0].start
            around = [each for each in found if _inside(start, corners(each[0]))]
            min(around, key=lambda each: each[0].area).append(loop)
    return [tuple(each) for each in found]


def _inside(place: complex, polygon: Complexes) -> bool:
    """Whether a place lies within a polygon: by the turns of its corners about the place."""
    way = polygon - place
    return bool(abs(np.angle(np.roll(way, -1) / way).sum()) > np.pi)
