"""Plane geometry of curves and point sets."""

from __future__ import annotations

import numpy as np

from linkwright.kinematics.cycle import Floats


def cross(a: Floats, b: Floats) -> Floats:
    """a × b of vectors (n, 2), (n,)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def convex_hull(points: Floats) -> Floats:
    """Corners (m, 2) of the convex hull of points (n, 2), counter-clockwise (Andrew's monotone chain, of the points
    that do not lie inside the polygon of those farthest in some directions)."""
    ring = points[(points @ _DIRECTIONS).argmax(axis=0)]
    side = np.roll(ring, -1, axis=0) - ring
    ring, side = ring[side.any(axis=1)], side[side.any(axis=1)]
    inside = (
        points @ np.stack([-side[:, 1], side[:, 0]]) > cross(side, ring) + 1e-12 * np.abs(points).max() ** 2
    )
    points = points[~inside.all(axis=1)] if len(side) > 2 else points
    ordered = sorted(set(map(tuple, points.tolist())))
    if len(ordered) < 3:
        return np.array(ordered)
    return np.array(_half(ordered)[:-1] + _half(ordered[::-1])[:-1])


_DIRECTIONS = np.stack([np.cos(turn := np.linspace(0.0, 2.0 * np.pi, 33)[:-1]), np.sin(turn)])


def _half(ordered: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    chain: list[tuple[float, ...]] = []
    for x, y in ordered:
        while len(chain) > 1:
            (ax, ay), (bx, by) = chain[-2], chain[-1]
            if (bx - ax) * (y - by) - (by - ay) * (x - bx) > 0.0:
                break
            chain.pop()
        chain.append((x, y))
    return chain


def area(corners: Floats) -> float:
    """Area of a polygon (m, 2), m², counter-clockwise positive."""
    return 0.5 * float(cross(corners, np.roll(corners, -1, axis=0)).sum())


def crossings(path: Floats) -> list[tuple[float, float]]:
    """Where a closed polygon (n, 2) crosses itself: pairs of places i + share along it."""
    n = len(path)
    d = np.roll(path, -1, axis=0) - path
    i, j = np.triu_indices(n, 2)
    keep = ~((i == 0) & (j == n - 1))
    i, j = i[keep], j[keep]
    gap, turn = path[j] - path[i], cross(d[i], d[j])
    with np.errstate(all="ignore"):
        s, t = cross(gap, d[j]) / turn, cross(gap, d[i]) / turn
    hit = (s >= 0) & (s < 1) & (t >= 0) & (t < 1)
    return [(float(a + x), float(b + y)) for a, b, x, y in zip(i[hit], j[hit], s[hit], t[hit], strict=True)]
