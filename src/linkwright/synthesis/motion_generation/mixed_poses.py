"""Poses and points mixed: all four-bars where they can be counted, else two dyads of least squares.

M poses and N points with 2 M + N = 10 leave finitely many: ``counted``, or nine points (``nine_points``). Else both
pins keep their distances from their centres, |p_j + z e^{iφ_j} - C| = |p_0 + z e^{iφ_0} - C|, j = 1 … n - 1; the
angles of points are free. Up to 4 + (number of free angles)/2 such conditions can be met exactly (nine points without
any angle: Alt's problem). From many random starts at once, so what is found need not be all.
Source: Tong, Myszka and Murray 2013, ASME DETC2013-12326 (mixed exact pose and point synthesis).

M poses and N points with free angles fix a four-bar up to finitely many where 2 M + N = 10. With the first pose as
d = 0, a dyad has its moving pin at x and its pivot at x + w; X, W, e are the conjugates' partners, 1 + g the
coupler's rotation, f = -g/(1 + g). At every further place both dyads give

    m n - m W - n w = 0,  m = d + x g,  n = e + X f,

g being given at poses and unknown at points: 8 + N equations for (x, X, w, W, y, Y, v, V, g₁ … g_N). In a linear
solve the two equations of a point lose dg by one combination; an 8 × 8 system is left. A start set of general
complex places, made by monodromy, is carried to the given ones.
Sources: Tong, Myszka and Murray 2013, ASME DETC2013-12326; Brake et al. 2016, J. Mechanisms Robotics 8 (Alt–Burmester
problems).
"""

from __future__ import annotations

from functools import cache
from importlib import resources
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Complexes, Floats, Integers
from linkwright.designs.checkpoints import checkpointed
from linkwright.synthesis.least_squares import minimise, with_differences
from linkwright.synthesis.motion_generation.burmester import Dyads
from linkwright.synthesis.path_generation.nine_points import (
    CLASSES,
    MIX,
    PROBES,
    conjugate,
    displacements,
    is_real,
    nine_points,
    relatives,
    repeated,
    turned,
)
from linkwright.synthesis.path_generation.tracking import TOLERANCE, Places, carried, polished

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


FILE = "mixed_starts.npz"
#: Four-bars through M poses and 10 - 2 M points.
KNOWN = {4: 30, 3: 201, 2: 1112}
SAME, REAL, TURNS = 1e-7, 1e-6, 6


def all_four_bars(places: Places) -> Complexes:
    """The solutions (K, 8 + N) of real places, one of both orders of the dyads."""
    poses = len(places.g) + 1
    first, start = start_set(poses)
    found = _distinct(_arrived(start, first, places))
    for turn in range(TURNS + 1):
        if len(found) >= KNOWN[poses]:
            break
        way = np.exp(1j * turn)
        more = turned(_arrived(start, first, places.turned(way), 0.1 * TOLERANCE), 1 / way)
        found = _distinct(np.concatenate([found, more, conjugate(more)]))
    return found


def real_ones(u: Complexes) -> Complexes:
    """Those of the solutions that are four-bars of the real plane."""
    off = np.abs(conjugate(u) - u).max(1)
    return np.asarray(u[off < REAL * np.abs(u).max(1)])


@cache
def start_set(poses: int) -> tuple[Places, Complexes]:
    """General complex places and the solutions there, for 2, 3 or 4 poses."""
    with np.load(BytesIO((resources.files(__package__) / FILE).read_bytes()), allow_pickle=False) as data:
        places = Places(data[f"d{poses}"], data[f"e{poses}"], data[f"g{poses}"])
        u = data[f"u{poses}"].astype(complex)
    return places, polished(u, np.ones(len(u), bool), places)


def build(path: Path, seed: int = 1, idle: int = 8) -> None:
    """Makes the start sets and writes them: carried around triangles until ``idle`` of them bring nothing new."""
    rng = np.random.default_rng(seed)
    arrays: dict[str, NDArray[Any]] = {}
    for poses in KNOWN:
        places, u = _made_up(poses, rng)
        quiet = 0
        while quiet < idle:
            ends = around(places, u, rng)
            more = _distinct(np.concatenate([u, ends]))
            quiet = quiet + 1 if len(more) == len(u) else 0
            u = more
        arrays |= {f"d{poses}": places.d, f"e{poses}": places.e, f"g{poses}": places.g}
        arrays[f"u{poses}"] = u.astype(np.complex64)
    with path.open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, **arrays)


def around(places: Places, u: Complexes, rng: np.random.Generator) -> Complexes:
    """Solutions carried around a random triangle, less the lost ones."""
    corners = [places, _general(places, rng), _general(places, rng), places]
    for first, second in pairwise(corners):
        u = _arrived(u, first, second)
    return u


def _arrived(u: Complexes, first: Places, last: Places, tolerance: float = TOLERANCE) -> Complexes:
    """Solutions of the places ``first`` carried to ``last``, less the lost ones."""

    def arrived() -> Complexes:
        ends = carried(u, first, last, tolerance)
        return ends.solutions[ends.arrived]

    return checkpointed(arrived, lambda: (u, first.d, first.e, first.g, last.d, last.e, last.g, tolerance))


def keys(u: Complexes) -> Complexes:
    """A number of each solution (K,), the same for both orders of its dyads."""
    key = np.zeros(len(u), complex)
    for o in (0, 4):
        for s in (0, 1):
            x, w = u[:, o + s], u[:, o + 2 + s]
            key += MIX[s, 0] / (x + w - PROBES[s, 0]) + MIX[s, 1] / (x - PROBES[s, 1])
    return key


def _distinct(u: Complexes) -> Complexes:
    """The first of every solution."""
    return u[~repeated(keys(u), SAME)]


def _made_up(poses: int, rng: np.random.Generator) -> tuple[Places, Complexes]:
    count = 9 - poses
    z = rng.normal(size=8) + 1j * rng.normal(size=8)
    g = np.exp(0.5 * rng.normal(size=count) + 2j * np.pi * rng.random(count)) - 1
    d, e = displacements(z, g, rng.choice([-1, 1], count))
    return Places(d, e, g[: poses - 1]), np.concatenate([z, g[poses - 1 :]])[None]


def _general(like: Places, rng: np.random.Generator) -> Places:
    """General complex places, as many."""
    count, poses = len(like.d), len(like.g)
    d, e = rng.normal(size=(2, count)) + 1j * rng.normal(size=(2, count))
    return Places(d, e, np.exp(0.5 * rng.normal(size=poses) + 2j * np.pi * rng.random(poses)) - 1)
