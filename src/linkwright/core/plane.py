"""Plane geometry of curves and point sets."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Indices

#: Points and vectors, x + i y.

#: Rounds in which points that are no corners are left out all at once.
ROUNDS = 6
#: Of more points than this those inside a polygon are left out first, of yet more those inside a finer one, too.
MANY, MORE = 400, 1000
_DIRECTIONS = np.exp(2j * np.pi * np.arange(24) / 24.0)


def cross(a: Floats, b: Floats) -> Floats:
    """a × b of plane vectors (…, 2), (…)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def hull_corners(points: Complexes) -> Indices:
    """Numbers (m,) of the corners of the convex hull of points (n,), counter-clockwise (Andrew's monotone chains)."""
    number = _outer(points) if len(points) > MANY else np.arange(len(points))
    number = number[np.argsort(points[number], kind="stable")]
    ordered = points[number]
    number = number[np.append(True, ordered[1:] != ordered[:-1])]
    if len(number) < 3:
        return np.asarray(number)
    below, above = _half(points[number]), _half(points[number[::-1]])
    return np.asarray(np.concatenate([number[below], number[::-1][above]]))


def convex_hull(points: Complexes) -> Complexes:
    """These corners (m,)."""
    return np.asarray(points[hull_corners(points)])


def _outer(points: Complexes) -> Indices:
    """Numbers (m,) of the points that do not lie clearly inside a polygon of those farthest in some directions, and
    where they are many of those farthest beyond its sides."""
    number, far = np.arange(len(points)), _along(_DIRECTIONS, points)
    ring, slack = points[far.argmax(axis=1)], 1e-12 * float(np.abs(points).max())
    for _ in range(1 if len(points) < MORE else 2):
        side = ring[[*range(1, len(ring)), 0]] - ring
        ring, side = ring[side != 0.0], side[side != 0.0]
        if len(ring) < 3:
            return number
        outward = -1j * side
        reach = _along(outward, points[number])
        edge = (outward.conj() * ring).real - slack * np.abs(side)
        beyond = (reach >= edge[:, None]).any(axis=0)
        number, reach = number[beyond], reach[:, beyond]
        ring = np.stack([ring, points[number[reach.argmax(axis=1)]]], axis=1).ravel()
    return number


def _along(directions: Complexes, points: Complexes) -> Floats:
    """Products (k, n) of vectors (k,) with vectors (n,)."""
    return np.asarray(directions.view(float).reshape(-1, 2) @ points.view(float).reshape(-1, 2).T)


def _half(chain: Complexes) -> Indices:
    """Numbers of the corners below a chain that goes to the right, all but the last: none is what does not lie below
    the line between two others, first of all points at the same time, then of those next to what was left out."""
    number = np.arange(len(chain))
    for _ in range(ROUNDS):
        convex = _turns_left(chain[number])
        if convex.all():
            return number[:-1]
        number = number[np.concatenate([[True], convex, [True]])]
    places, last = chain[number].tolist(), len(number) - 1
    before, after, there = [*range(-1, last)], [*range(1, last + 2)], [True] * (last + 1)
    doubtful = (np.flatnonzero(~_turns_left(chain[number])) + 1).tolist()
    while doubtful:
        k = doubtful.pop()
        if not there[k] or not 0 < k < last:
            continue
        i, j = before[k], after[k]
        a, b = places[k] - places[i], places[j] - places[k]
        if not a.real * b.imag - a.imag * b.real > 0.0:
            there[k], after[i], before[j] = False, j, i
            doubtful += [i, j]
    return number[there][:-1]


def _turns_left(chain: Complexes) -> Flags:
    """Where a chain bends to the left, its ends left out."""
    step = chain[1:] - chain[:-1]
    along, across = step.real, step.imag
    return np.asarray(along[:-1] * across[1:] - across[:-1] * along[1:] > 0.0)


def area(corners: Complexes) -> float:
    """Area of a polygon (m,), m², counter-clockwise positive; its first corner may be repeated at the end."""
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
