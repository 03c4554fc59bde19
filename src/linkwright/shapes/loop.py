"""Closed outlines of lines and arcs."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Complexes

#: Angle (rad) below which an arc is a line.
STRAIGHT = 1e-12


@dataclass(frozen=True)
class Edge:
    """A line or an arc from one place to another, x + i y, m.

    ``bulge``: the tangent of a quarter of the arc's angle, as in DXF files: 0 a line, 1 a half circle; positive
    counter-clockwise.
    """

    start: complex
    end: complex
    bulge: float = 0.0

    @property
    def angle(self) -> float:
        """Angle of the arc, rad, counter-clockwise positive; 0 of a line."""
        return 4.0 * math.atan(self.bulge)

    @property
    def radius(self) -> float:
        """Radius of the arc, m; infinite of a line."""
        if not self.bulge:
            return math.inf
        return abs(self.end - self.start) * (1.0 + self.bulge**2) / (4.0 * abs(self.bulge))

    @property
    def centre(self) -> complex:
        """Centre of the arc; of a line the middle between its ends."""
        middle = 0.5 * (self.start + self.end)
        if not self.bulge:
            return middle
        return middle + 1j * (self.end - self.start) * (1.0 - self.bulge**2) / (4.0 * self.bulge)

    @property
    def length(self) -> float:
        """Length along the edge, m."""
        return self.radius * abs(self.angle) if self.bulge else abs(self.end - self.start)

    @property
    def reversed(self) -> Edge:
        """The same edge from its end to its start."""
        return Edge(self.end, self.start, -self.bulge)

    def at(self, share: float) -> complex:
        """The place at a share, 0 to 1, of the length."""
        half = 0.5 * self.angle
        if abs(half) < STRAIGHT:
            return self.start + share * (self.end - self.start)
        # a chord over the share's angle has its ratio to the whole chord, and half of the rest's angle to it
        ratio = math.sin(half * share) / math.sin(half)
        return self.start + ratio * cmath.exp(1j * half * (share - 1.0)) * (self.end - self.start)

    def points(self, tolerance: float) -> list[complex]:
        """Places on the edge from its start on, without its end, whose chords leave it by no more than ``tolerance``
        (m)."""
        if not self.bulge or self.start == self.end:
            return [self.start]
        reach = math.acos(max(1.0 - tolerance / self.radius, 0.0))
        count = max(math.ceil(0.5 * abs(self.angle) / reach - 1e-9), 1)
        return [self.start, *(self.at(k / count) for k in range(1, count))]

    def heading(self, share: float) -> float:
        """Direction (rad) in which the edge goes on at a share of its length."""
        return cmath.phase(self.end - self.start) + (share - 0.5) * self.angle

    def distance(self, place: complex) -> float:
        """Distance (m) of a place from the edge."""
        ends = min(abs(place - self.start), abs(place - self.end))
        chord = self.end - self.start
        if not self.bulge:
            share = ((place - self.start) * chord.conjugate()).real / (abs(chord) ** 2 or 1.0)
            return abs(place - self.start - share * chord) if 0.0 < share < 1.0 else ends
        away = place - self.centre
        if away:
            from_middle = abs(cmath.phase(away / (self.at(0.5) - self.centre)))
            ends = ends if from_middle > 0.5 * abs(self.angle) else abs(abs(away) - self.radius)
        return ends

    def areas(self, origin: complex) -> tuple[float, float]:
        """Areas (m²) of the triangle from an origin over the chord, and of the segment between chord and arc, each
        positive counter-clockwise."""
        triangle = 0.5 * ((self.start - origin).conjugate() * (self.end - origin)).imag
        segment = 0.5 * self.radius**2 * (self.angle - math.sin(self.angle)) if self.bulge else 0.0
        return triangle, segment

    @property
    def box(self) -> tuple[complex, complex]:
        """Lowest and highest x and y on the edge."""
        places = [self.start, self.end, *self._extremes()]
        xs, ys = [each.real for each in places], [each.imag for each in places]
        return complex(min(xs), min(ys)), complex(max(xs), max(ys))

    def _extremes(self) -> Iterator[complex]:
        """Where the arc's tangent is parallel to an axis."""
        if not self.bulge:
            return
        centre, radius, middle = self.centre, self.radius, self.at(0.5)
        for way in (1.0, 1j, -1.0, -1j):
            if middle != centre and abs(cmath.phase(way / (middle - centre))) < 0.5 * abs(self.angle):
                yield centre + radius * way


@dataclass(frozen=True)
class Loop:
    """A closed outline, each edge beginning where the one before it ends: counter-clockwise around material,
    clockwise around an opening."""

    edges: tuple[Edge, ...]

    @cached_property
    def length(self) -> float:
        """Length of the outline, m."""
        return math.fsum(edge.length for edge in self.edges)

    @cached_property
    def area(self) -> float:
        """Area within, m², negative where the loop runs clockwise."""
        origin = self.edges[0].start
        return math.fsum(part for edge in self.edges for part in edge.areas(origin))

    @cached_property
    def box(self) -> tuple[complex, complex]:
        """Lowest and highest x and y, arcs as they are."""
        lows, highs = zip(*(edge.box for edge in self.edges), strict=True)
        return (
            complex(min(each.real for each in lows), min(each.imag for each in lows)),
            complex(max(each.real for each in highs), max(each.imag for each in highs)),
        )

    @property
    def reversed(self) -> Loop:
        """The same outline the other way around."""
        return Loop(tuple(edge.reversed for edge in reversed(self.edges)))

    def moved(self, turn: float = 0.0, to: complex = 0j) -> Loop:
        """The outline turned about the origin by an angle (rad), then moved by a vector (m)."""
        way = cmath.exp(1j * turn)
        return Loop(tuple(Edge(way * each.start + to, way * each.end + to, each.bulge) for each in self.edges))

    def points(self, tolerance: float) -> Complexes:
        """Corners of a polygon on the outline, (k,), which leaves no arc by more than ``tolerance`` (m)."""
        return np.array([place for edge in self.edges for place in edge.points(tolerance)])


def circle(centre: complex, radius: float, clockwise: bool = False) -> Loop:
    """A circle of two half arcs."""
    right, left, bulge = centre + radius, centre - radius, -1.0 if clockwise else 1.0
    return Loop((Edge(right, left, bulge), Edge(left, right, bulge)))
