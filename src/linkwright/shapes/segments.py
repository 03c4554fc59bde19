"""Lines and arcs on which the outline of a piece lies, and where two of them meet."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.plane import area
from linkwright.shapes.loop import Edge
from linkwright.shapes.rings import clear_of_each_other
from linkwright.shapes.shape import Piece

#: Turn (rad) below which two directions are one.
PARALLEL = 1e-12


@dataclass(frozen=True)
class Segment:
    """A line, or an arc about a ``centre`` by the angle ``sweep`` (rad, counter-clockwise positive, 0 of a line); its
    piece lies to the left of it, or on both sides."""

    start: complex
    end: complex
    centre: complex = 0j
    sweep: float = 0.0

    @cached_property
    def radius(self) -> float:
        """Radius of an arc, m."""
        return abs(self.start - self.centre)

    @cached_property
    def length(self) -> float:
        """Length along it, m."""
        return self.radius * abs(self.sweep) if self.sweep else abs(self.end - self.start)

    @cached_property
    def edge(self) -> Edge:
        """The same as an edge of an outline."""
        return Edge(self.start, self.end, math.tan(0.25 * self.sweep))

    @property
    def reversed(self) -> Segment:
        """The same from its end to its start."""
        return Segment(self.end, self.start, self.centre, -self.sweep)

    def at(self, share: float) -> complex:
        """The place at a share of the length."""
        if self.sweep:
            return self.centre + (self.start - self.centre) * cmath.exp(1j * self.sweep * share)
        return self.start + share * (self.end - self.start)

    def along(self, place: complex) -> float:
        """How far (m) from the start a place near the segment lies along it; beyond the ends below 0 or above the
        length."""
        if not self.sweep:
            chord = self.end - self.start
            return ((place - self.start) * chord.conjugate()).real / (abs(chord) or 1.0)
        sign = math.copysign(1.0, self.sweep)
        angle = sign * cmath.phase((place - self.centre) / (self.start - self.centre))
        # the half of what the arc leaves open that is nearer to the start counts as before it
        if angle < 0.5 * abs(self.sweep) - math.pi:
            angle += 2.0 * math.pi
        return angle * self.radius

    def part(self, first: float, last: float, ends: tuple[complex, complex]) -> Segment:
        """The part between two lengths from the start, with ends given."""
        sweep = self.sweep * (last - first) / self.length if self.sweep else 0.0
        return Segment(*ends, self.centre, sweep)


def meeting(one: Segment, other: Segment, near: float) -> Iterator[complex]:
    """Places where two segments, each continued as a whole line or circle, meet or touch; ends of the one on the
    other where both lie on one line or circle. ``near``: distance, m, within which they count as touching."""
    if not one.sweep and not other.sweep:
        return _lines(one, other, near)
    if one.sweep and other.sweep:
        return _circles(one, other, near)
    return _line_and_circle(one, other, near) if other.sweep else _line_and_circle(other, one, near)


def _lines(one: Segment, other: Segment, near: float) -> Iterator[complex]:
    a, b, gap = one.end - one.start, other.end - other.start, other.start - one.start
    turn = (a.conjugate() * b).imag
    length = abs(a)
    off = [abs((a.conjugate() * each).imag) for each in (gap, gap + b)]
    if max(off) <= near * length:
        yield from (one.start, one.end, other.start, other.end)
    elif abs(turn) > PARALLEL * length * abs(b):
        yield one.start + a * ((gap.conjugate() * b).imag / turn)


def _line_and_circle(line: Segment, arc: Segment, near: float) -> Iterator[complex]:
    way = line.end - line.start
    way /= abs(way)
    gap = (arc.centre - line.start) * way.conjugate()
    foot, height = line.start + way * gap.real, abs(gap.imag)
    if abs(height - arc.radius) <= near:
        yield foot
    elif height < arc.radius:
        half = math.sqrt((arc.radius - height) * (arc.radius + height))
        yield foot - way * half
        yield foot + way * half


def _circles(one: Segment, other: Segment, near: float) -> Iterator[complex]:
    gap = other.centre - one.centre
    apart, sum_, difference = abs(gap), one.radius + other.radius, one.radius - other.radius
    if apart + abs(difference) <= near:
        yield from (one.start, one.end, other.start, other.end)
    elif min(abs(apart - sum_), abs(apart - abs(difference))) <= near:
        # outside of each other the touching point is between the centres, else beyond that of the smaller one
        sign = -1.0 if abs(apart - sum_) > near and difference < 0.0 else 1.0
        yield one.centre + sign * one.radius * gap / apart
    elif abs(difference) < apart < sum_:
        foot = 0.5 * (apart + difference * sum_ / apart)
        half = math.sqrt(max((one.radius - foot) * (one.radius + foot), 0.0))
        way = gap / apart
        yield one.centre + way * complex(foot, half)
        yield one.centre + way * complex(foot, -half)


def tours(piece: Piece, near: float) -> Iterator[list[Segment]]:
    """Closed rows of lines and arcs among which the outline of a piece is: where its core is followed at the distance
    of the radius, to the right. Rows have gaps at inner corners, which lie within the piece."""
    for ring in piece.rings:
        corners = _distinct(ring.tolist(), near)
        if piece.filled and len(corners) > 1 and abs(corners[-1] - corners[0]) <= near:
            corners.pop()
        if piece.filled and len(corners) > 2:
            ring = np.array(corners)
            ways = [corners, corners[::-1]]
            if len(piece.rings) == 1 and piece.radius and clear_of_each_other([ring], near):
                # only the outer side of a ring that does not cross itself
                ways = ways[:1] if area(ring) > 0.0 else ways[1:]
            yield from (around(way, piece.radius) for way in (ways if piece.radius else ways[:1]))
        elif piece.radius:
            yield around([*corners, *reversed(corners[1:-1])], piece.radius)


def around(corners: Sequence[complex], radius: float) -> list[Segment]:
    """Lines to the right of the sides of a ring of distinct corners, with arcs about the corners where it turns
    left."""
    if len(corners) == 1:
        right, left = corners[0] + radius, corners[0] - radius
        return [Segment(right, left, corners[0], math.pi), Segment(left, right, corners[0], math.pi)]
    found = []
    ways = [(after - at) / abs(after - at) for at, after in zip(corners, [*corners[1:], corners[0]], strict=True)]
    for k, (at, way) in enumerate(zip(corners, ways, strict=True)):
        after, then = corners[(k + 1) % len(corners)], ways[(k + 1) % len(corners)]
        aside = -1j * radius * way
        found.append(Segment(at + aside, after + aside))
        turn = cmath.phase(then / way)
        if turn < 1e-6 - math.pi:  # the way back: which way it turns is rounding
            turn += 2.0 * math.pi
        if radius and turn > PARALLEL:
            found.append(Segment(after + aside, after - 1j * radius * then, after, turn))
    return found


def _distinct(corners: Sequence[complex], near: float) -> list[complex]:
    """Corners without those at the place of the one before."""
    found = list(corners[:1])
    for each in corners[1:]:
        if abs(each - found[-1]) > near:
            found.append(each)
    return found
