"""Plane geometry of curves and point sets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from linkwright.kinematics.cycle import Floats

#: Rounds in which points that are no corners are left out all at once.
ROUNDS = 6
#: Of more points than this those inside a polygon are left out first, of yet more those inside a finer one, too.
MANY, MORE = 400, 1000
_AROUND = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
_DIRECTIONS = np.stack([np.cos(_AROUND), np.sin(_AROUND)], axis=1)


def cross(a: Floats, b: Floats) -> Floats:
    """a × b of vectors (n, 2), (n,)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def convex_hull(points: Floats) -> Floats:
    """Corners (m, 2) of the convex hull of points (n, 2), counter-clockwise (Andrew's monotone chains)."""
    some = _outer(points) if len(points) > MANY else points
    ordered = np.sort(some[:, 0] + 1j * some[:, 1])
    ordered = np.concatenate([ordered[:1], ordered[1:][ordered[1:] != ordered[:-1]]])
    corners = ordered if len(ordered) < 3 else np.concatenate([_half(ordered), _half(ordered[::-1])])
    return np.stack([corners.real, corners.imag], axis=1)


def _outer(points: Floats) -> Floats:
    """The points (m, 2) that do not lie clearly inside a polygon of those farthest in some directions, and where they
    are many of those farthest beyond its sides."""
    along = np.ascontiguousarray(points.T)
    ring, slack = points[(_DIRECTIONS @ along).argmax(axis=1)], 1e-12 * float(np.abs(along).max())
    for _ in range(1 if len(points) < MORE else 2):
        side = ring[[*range(1, len(ring)), 0]] - ring
        length = np.hypot(side[:, 0], side[:, 1])
        ring, side, length = ring[length > 0.0], side[length > 0.0], length[length > 0.0]
        if len(ring) < 3:
            return points
        outward = np.stack([side[:, 1] / length, -side[:, 0] / length], axis=1)
        reach, edge = outward @ along, (ring * outward).sum(axis=1) - slack
        beyond = (reach >= edge[:, None]).any(axis=0)
        points, along, reach = points[beyond], along[:, beyond], reach[:, beyond]
        ring = np.stack([ring, points[reach.argmax(axis=1)]], axis=1).reshape(-1, 2)
    return points


def _half(chain: NDArray[np.complex128]) -> NDArray[np.complex128]:
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


def _bends(chain: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Where a chain bends to the left, its ends left out."""
    step = chain[1:] - chain[:-1]
    along, across = step.real, step.imag
    return np.asarray(along[:-1] * across[1:] - across[:-1] * along[1:] > 0.0)


def area(corners: Floats) -> float:
    """Area of a polygon (m, 2), m², counter-clockwise positive."""
    x, y = (corners[1:] - corners[0]).T
    return 0.5 * float(x[:-1] @ y[1:] - y[:-1] @ x[1:])


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
