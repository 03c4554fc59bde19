"""Area, first and polar moments of plates by closed forms: of numbers, and of traced values that vary."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations, permutations

from linkwright.fields.outline import Ring
from linkwright.formula.trace import Mask, Scalar, absolute, angle, maximum, minimum, select, sqrt

Point = tuple[Scalar, Scalar]
#: Three points count as in line whose triangle is smaller than this share of the squares of its sides.
FLAT = 1e-12


@dataclass(frozen=True)
class PlaneMoments:
    """``area`` m², first moments ``x`` and ``y`` m³, and the ``polar`` moment m⁴, all about an origin."""

    area: Scalar = 0.0
    x: Scalar = 0.0
    y: Scalar = 0.0
    polar: Scalar = 0.0

    def __add__(self, other: PlaneMoments) -> PlaneMoments:
        return PlaneMoments(self.area + other.area, self.x + other.x, self.y + other.y, self.polar + other.polar)

    def __neg__(self) -> PlaneMoments:
        return PlaneMoments(-self.area, -self.x, -self.y, -self.polar)

    @property
    def about_centre(self) -> tuple[Scalar, Point, Scalar]:
        """Area, its centre, and the polar moment about that."""
        x, y = self.x / self.area, self.y / self.area
        return self.area, (x, y), self.polar - (self.x * x + self.y * y)


def disc_moments(centre: Point, radius: Scalar) -> PlaneMoments:
    """Those of a disc: π r², and about its centre π r⁴/2."""
    x, y = centre
    area = math.pi * radius * radius
    return PlaneMoments(area, area * x, area * y, area * (x * x + y * y) + 0.5 * area * radius * radius)


def polygon_moments(ring: Sequence[Point]) -> PlaneMoments:
    """Those of a polygon, counter-clockwise positive (Green's theorem)."""
    return _sum(triangle_moments(a, b) for a, b in zip(ring, (*ring[1:], ring[0]), strict=True))


def outline_moments(rings: Sequence[Ring]) -> PlaneMoments:
    """Those of an outline without its holes, whichever way these go round."""
    found = [polygon_moments(ring) for ring in rings]
    turned = [-each if each.area < 0.0 else each for each in found]
    return _sum([turned[0], *(-each for each in turned[1:])])


def triangle_moments(a: Point, b: Point) -> PlaneMoments:
    """Those of the triangle of the origin, a and b: (a × b)/2, centre (a + b)/3, polar A (a² + a·b + b²)/6."""
    (ax, ay), (bx, by) = a, b
    area = 0.5 * (ax * by - bx * ay)
    spread = ax * ax + ay * ay + ax * bx + ay * by + bx * bx + by * by
    return PlaneMoments(
        area, area * (ax + bx) * (1.0 / 3.0), area * (ay + by) * (1.0 / 3.0), area * spread * (1.0 / 6.0)
    )


def hull_moments(points: Sequence[Point], radius: Scalar) -> PlaneMoments:
    """Those of all places within ``radius`` of the convex hull of points: of a bar where they are in line.

    To the polygon come a strip along every side and a sector at every corner (Steiner's formulas). Which points are
    corners is decided by the values themselves, so that traced ones stay right where the hull changes.
    """
    if len(points) == 1:
        return disc_moments(points[0], radius)
    if len(points) == 2:
        return bar_moments(points[0], points[1], radius)
    if all(isinstance(y, float) and y == 0.0 for _unused, y in points):
        low = high = points[0][0]
        for x, _unused in points[1:]:
            low, high = minimum(low, x), maximum(high, x)
        return bar_moments((low, 0.0), (high, 0.0), radius)
    return _plate(points, radius)


def bar_moments(a: Point, b: Point, radius: Scalar) -> PlaneMoments:
    """Those of a bar with round ends from a to b: a rectangle and two half discs."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    x, y = 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])
    square = dx * dx + dy * dy
    length = absolute(dx) if isinstance(dy, float) and dy == 0.0 else sqrt(square)
    r2 = radius * radius
    area = 2.0 * radius * length + math.pi * r2
    own = radius * length * (square + 4.0 * r2) * (1.0 / 6.0)
    ends = 0.5 * math.pi * r2 * (r2 + 0.5 * square) + (4.0 / 3.0) * r2 * radius * length
    return PlaneMoments(area, area * x, area * y, own + ends + area * (x * x + y * y))


def _plate(points: Sequence[Point], radius: Scalar) -> PlaneMoments:
    """A = A₀ + P r + π r², first moments S₀ + r Σ l m + r²/2 Σ θ p, polar J₀ + r Σ l (a² + a·d + d²/3) +
    r² (2 A₀ + Σ θ p²/2) + P r³ + π r⁴/2: of the sides d = b - a of length l with middle m, perimeter P, and of the
    corners p with outer angles θ."""
    sides = _sides(points)
    whole = _sum(_of_side(triangle_moments(points[i], points[j]), mask) for (i, j), mask in sides.items())
    lengths = {pair: _distance(points[pair[0]], points[pair[1]]) for pair in sides}
    perimeter: Scalar = 0.0
    strips, corners = PlaneMoments(), PlaneMoments()
    for (i, j), mask in sides.items():
        (ax, ay), (bx, by) = points[i], points[j]
        length = select(mask, lengths[i, j], 0.0)
        dx, dy = bx - ax, by - ay
        perimeter = perimeter + length
        spread = ax * bx + ay * by + (dx * dx + dy * dy) * (1.0 / 3.0)
        strips = strips + PlaneMoments(length, 0.5 * length * (ax + bx), 0.5 * length * (ay + by), length * spread)
    for k, (x, y) in enumerate(points):
        half = 0.5 * _turn(points, sides, lengths, k)
        corners = corners + PlaneMoments(half, half * x, half * y, half * (x * x + y * y))
    r2 = radius * radius
    return PlaneMoments(
        whole.area + perimeter * radius + math.pi * r2,
        whole.x + radius * strips.x + r2 * corners.x,
        whole.y + radius * strips.y + r2 * corners.y,
        whole.polar
        + radius * strips.polar
        + r2 * (2.0 * whole.area + corners.polar)
        + perimeter * radius * r2
        + 0.5 * math.pi * r2 * r2,
    )


def _sides(points: Sequence[Point]) -> dict[tuple[int, int], Mask]:
    """For every two points whether the hull has a side from the one to the other: all others are left of it, or on it
    and between them."""
    turns = {three: _cross(*(points[k] for k in three)) for three in combinations(range(len(points)), 3)}
    sides: dict[tuple[int, int], Mask] = {}
    for i, j in permutations(range(len(points)), 2):
        mask: Mask = True
        for k in range(len(points)):
            if k in (i, j):
                continue
            low, middle, high = sorted((i, j, k))
            (a, b, c), (area, size) = (points[i], points[j], points[k]), turns[low, middle, high]
            area = area if (i, j, k) in ((low, middle, high), (middle, high, low), (high, low, middle)) else -area
            mask = mask & ((area > size) | ((area >= -size) & _between(a, b, c, (i, j, k))))
        sides[i, j] = mask
    return sides


def _between(a: Point, b: Point, c: Point, numbers: tuple[int, int, int]) -> Mask:
    """Whether c lies between a and b; of points at one place the first one is the corner."""
    i, j, k = numbers
    to_a, to_b = (c[0] - a[0], c[1] - a[1]), (c[0] - b[0], c[1] - b[1])
    share = to_a[0] * to_b[0] + to_a[1] * to_b[1]
    if (k > i) == (k > j):
        return share <= 0.0 if k > i else share < 0.0
    near, far = (to_a, to_b) if k > i else (to_b, to_a)  # c may be where that one is, whose number is lower
    nearer = near[0] * near[0] + near[1] * near[1] < far[0] * far[0] + far[1] * far[1]
    return (share < 0.0) | ((share <= 0.0) & nearer)


def _cross(a: Point, b: Point, c: Point) -> tuple[Scalar, Scalar]:
    """Twice the area of a triangle, and up to where it is rounding."""
    (px, py), (qx, qy) = (b[0] - a[0], b[1] - a[1]), (c[0] - a[0], c[1] - a[1])
    return px * qy - qx * py, FLAT * (px * px + py * py + qx * qx + qy * qy)


def _turn(
    points: Sequence[Point], sides: dict[tuple[int, int], Mask], lengths: dict[tuple[int, int], Scalar], k: int
) -> Scalar:
    """The outer angle of the hull at a point, 0 where it is no corner: between the sides that come and go."""
    into: Point = (0.0, 0.0)
    out: Point = (0.0, 0.0)
    corner: Scalar = 0.0
    for other in range(len(points)):
        if other == k:
            continue
        (x, y), (px, py) = points[k], points[other]
        length = lengths[k, other]
        safe = select(length > 0.0, length, 1.0)
        way = (px - x) / safe, (py - y) / safe
        leaves, comes = select(sides[k, other], 1.0, 0.0), select(sides[other, k], 1.0, 0.0)
        out = out[0] + leaves * way[0], out[1] + leaves * way[1]
        into = into[0] - comes * way[0], into[1] - comes * way[1]
        corner = corner + leaves
    along = into[0] * out[0] + into[1] * out[1]
    return angle(absolute(into[0] * out[1] - into[1] * out[0]), along + (1.0 - corner))


def _of_side(moments: PlaneMoments, mask: Mask) -> PlaneMoments:
    return PlaneMoments(*(select(mask, each, 0.0) for each in (moments.area, moments.x, moments.y, moments.polar)))


def _distance(a: Point, b: Point) -> Scalar:
    dx, dy = b[0] - a[0], b[1] - a[1]
    return sqrt(dx * dx + dy * dy)


def _sum(moments: Iterable[PlaneMoments]) -> PlaneMoments:
    return sum(moments, start=PlaneMoments())
