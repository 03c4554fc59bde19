"""Plane geometry of curves and point sets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from linkwright.kinematics.cycle import Floats

#: Points and vectors, x + i y.
Places = NDArray[np.complex128]

#: Rounds in which points that are no corners are left out all at once.
ROUNDS = 6
#: Of more points than this those inside a polygon are left out first, of yet more those inside a finer one, too.
MANY, MORE = 400, 1000
_DIRECTIONS = np.exp(2j * np.pi * np.arange(24) / 24.0)


def cross(a: Floats, b: Floats) -> Floats:
    """a × b of vectors (n, 2), (n,)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def convex_hull(points: Places) -> Places:
    """Corners (m,) of the convex hull of points (n,), counter-clockwise (Andrew's monotone chains)."""
    ordered = np.sort(_outer(points) if len(points) > MANY else points)
    ordered = ordered[np.append(True, ordered[1:] != ordered[:-1])]
    return ordered if len(ordered) < 3 else np.concatenate([_half(ordered), _half(ordered[::-1])])


def _outer(points: Places) -> Places:
    """The points (m,) that do not lie clearly inside a polygon of those farthest in some directions, and where they
    are many of those farthest beyond its sides."""
    ring, slack = points[_along(_DIRECTIONS, points).argmax(axis=1)], 1e-12 * float(np.abs(points).max())
    for _ in range(1 if len(points) < MORE else 2):
        side = ring[[*range(1, len(ring)), 0]] - ring
        ring, side = ring[side != 0.0], side[side != 0.0]
        if len(ring) < 3:
            return points
        outward = -1j * side
        reach = _along(outward, points)
        edge = (outward.conj() * ring).real - slack * np.abs(side)
        beyond = (reach >= edge[:, None]).any(axis=0)
        points, reach = points[beyond], reach[:, beyond]
        ring = np.stack([ring, points[reach.argmax(axis=1)]], axis=1).ravel()
    return points


def _along(directions: Places, points: Places) -> Floats:
    """Products (k, n) of vectors (k,) with vectors (n,)."""
    return np.asarray(directions.view(float).reshape(-1, 2) @ points.view(float).reshape(-1, 2).T)


def _half(chain: Places) -> Places:
    """The corners below a chain that goes to the right, all but the last: none is what does not lie below the line
    between two others, first of all points at the same time, then of those beside what was left out."""
    for _ in range(ROUNDS):
        bends = _bends(chain)
        if bends.all():
            return chain[:-1]
        chain = chain[np.concatenate([[True], bends, [True]])]
    places, last = chain.tolist(), len(chain) - 1
    before, after, there = [*range(-1, last)], [*range(1, last + 2)], [True] * (last + 1)
    doubtful = (np.flatnonzero(~_bends(chain)) + 1).tolist()
    while doubtful:
        k = doubtful.pop()
        if not there[k] or not 0 < k < last:
            continue
        i, j = before[k], after[k]
        a, b = places[k] - places[i], places[j] - places[k]
        if not a.real * b.imag - a.imag * b.real > 0.0:
            there[k], after[i], before[j] = False, j, i
            doubtful += [i, j]
    return chain[there][:-1]


def _bends(chain: Places) -> NDArray[np.bool_]:
    """Where a chain bends to the left, its ends left out."""
    step = chain[1:] - chain[:-1]
    along, across = step.real, step.imag
    return np.asarray(along[:-1] * across[1:] - across[:-1] * along[1:] > 0.0)


def area(corners: Places) -> float:
    """Area of a polygon (m,), m², counter-clockwise positive."""
    gap = corners - corners[0]
    return 0.5 * float(np.vdot(gap[:-1], gap[1:]).imag)


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
