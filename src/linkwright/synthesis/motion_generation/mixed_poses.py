"""Poses and points mixed: all four-bars where they can be counted, else two dyads of least squares.

M poses and N points with 2 M + N = 10 leave finitely many: ``counted``, or nine points (``nine_points``). Else both
pins keep their distances from their centres, |p_j + z e^{iφ_j} - C| = |p_0 + z e^{iφ_0} - C|, j = 1 … n - 1; the
angles of points are free. Up to 4 + (number of free angles)/2 such conditions can be met exactly (nine points without
any angle: Alt's problem). From many random starts at once, so what is found need not be all.
Source: Tong, Myszka and Murray 2013, ASME DETC2013-12326 (mixed exact pose and point synthesis).
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Floats, Integers
from linkwright.synthesis.least_squares import minimise, with_differences
from linkwright.synthesis.motion_generation.burmester import Dyads
from linkwright.synthesis.motion_generation.finite_solutions import KNOWN, all_four_bars, real_ones
from linkwright.synthesis.nine_points.classes import CLASSES, is_real, relatives
from linkwright.synthesis.nine_points.query import nine_points
from linkwright.synthesis.nine_points.tracker import Places

STARTS, LEFT, STEPS = 800, 120, 80


#: Angles (n,) of the body, the two dyads and their sum of squares.
Solution = tuple[Floats, Dyads, float]
#: Solutions that reach farther, in units of the places' extent, are left out.
FAR = 1e4


def counted_solutions(p: Complexes, phi: Floats) -> tuple[list[Solution], int, int] | None:
    """All real solutions, how many complex ones were found, and how many there are; None: they are not finitely many.

    Pairs of dyads count once.
    """
    posed = np.flatnonzero(~np.isnan(phi))
    first = int(posed[0]) if len(posed) else 0
    order = np.concatenate([[first], np.setdiff1d(posed, [first]), np.setdiff1d(np.arange(len(p)), [*posed, first])])
    order = order.astype(np.int64)
    base = phi[first] if len(posed) else 0.0
    d = p[order[1:]] - p[first]
    scale = float(np.sqrt(np.mean(np.abs(d) ** 2)))
    if len(p) == 9 and len(posed) < 2:
        nine = nine_points(p[order])
        u, scale = np.concatenate(relatives(nine.solutions[is_real(nine.solutions)], nine.q)[:3]), nine.scale
        found, known, turns = 3 * len(nine.solutions), 3 * CLASSES, u[:, 8:]
    elif len(posed) in KNOWN and 2 * len(posed) + len(p) - len(posed) == 10:
        g = np.exp(1j * (phi[posed] - base))[posed != first] - 1
        every = all_four_bars(Places(d / scale, d.conj() / scale, g))
        u = real_ones(every)
        found, known = len(every), KNOWN[len(posed)]
        turns = np.concatenate([np.broadcast_to(g, (len(u), len(g))), u[:, 8:]], 1)
    else:
        return None
    near = np.isfinite(u).all(1) & (np.abs(u[:, :8]).max(1) < FAR)
    return (
        [_solution(row, g, p, order, base, scale) for row, g in zip(u[near], turns[near], strict=True)],
        found,
        known,
    )


def _solution(u: Complexes, g: Complexes, p: Complexes, order: Integers, base: float, scale: float) -> Solution:
    """A solution in the order of the places as they were given."""
    angles = np.empty(len(p))
    angles[order] = base + np.concatenate([[0.0], np.angle(1 + g)])
    points = scale * u[[0, 4]] * np.exp(-1j * base)
    positions = p + points[:, None] * np.exp(1j * angles)
    middles = p[order[0]] + scale * (u[[0, 4]] + u[[2, 6]])
    return angles, Dyads(positions[:, 0] - p[0], positions, middles, np.full(2, np.nan + 0j)), 0.0


def mixed_solutions(p: Complexes, phi: Floats) -> list[Solution]:
    """Angles (n,) of the body, the two dyads and their sum of squares, for every different optimum, best first."""
    size = float(np.abs(p - p.mean()).max())
    x, f, _ = _optima((p - p[0]) / size, phi, np.random.default_rng(0))
    found = []
    for row, squares in zip(x, f, strict=True):
        angles = _angles(row[None], phi)[0]
        turn = np.exp(1j * angles)
        points, middles = (row[0:4:2] + 1j * row[1:4:2]) * size, (row[4:8:2] + 1j * row[5:8:2]) * size
        if np.abs(np.concatenate([points, middles])).max() > 50 * size:
            continue
        positions = p + points[:, None] * turn
        pair = Dyads(points * turn[0], positions, p[0] + middles, np.full(2, np.nan + 0j))
        found.append((angles, pair, float(squares) * size**2))
    return found


def _optima(p: Complexes, phi: Floats, rng: np.random.Generator) -> tuple[Floats, Floats, Integers]:
    free = int(np.isnan(phi).sum())
    start = np.column_stack([rng.normal(0, 1.5, (STARTS, 8)), _free_angles(p, phi, rng, free)])

    def residual(x: Floats, _: Integers) -> Floats:
        turn = np.exp(1j * _angles(x, phi))
        off = []
        for k in (0, 2):
            z, c = x[:, k] + 1j * x[:, k + 1], x[:, k + 4] + 1j * x[:, k + 5]
            far = np.abs(p + z[:, None] * turn - c[:, None])
            off.append(far - far.mean(1, keepdims=True))
        distance = np.abs(x[:, 0] + 1j * x[:, 1] - x[:, 2] - 1j * x[:, 3])
        return np.column_stack([*off, np.maximum(0.05 - distance, 0)])

    return minimise(with_differences(residual), start, steps=STEPS, keep=LEFT, halve=10)


def _angles(x: Floats, phi: Floats) -> Floats:
    """Angles (K, n) with the free ones from the parameters."""
    angles = np.tile(phi, (len(x), 1))
    angles[:, np.isnan(phi)] = x[:, 8:]
    return angles


def _free_angles(p: Complexes, phi: Floats, rng: np.random.Generator, free: int) -> Floats:
    """Random angles (STARTS, free) near those of the given poses, or along a random turn where there are none."""
    share = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(p)))])
    known = ~np.isnan(phi)
    if known.any():
        base = np.interp(share, share[known], np.unwrap(phi[known]))[~known]
        return np.asarray(base + rng.normal(0, 0.7, (STARTS, free)))
    turn = rng.uniform(-2, 2, (STARTS, 1)) * share / share[-1]
    return np.asarray((turn + rng.normal(0, 0.4, turn.shape))[:, ~known])
