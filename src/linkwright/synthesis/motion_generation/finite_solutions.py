"""Poses and points mixed, just as many as leave finitely many four-bars: all of them, from a start set.

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

from linkwright.core.arrays import Complexes
from linkwright.designs.checkpoints import checkpointed
from linkwright.synthesis.nine_points.classes import MIX, PROBES, conjugate, repeated, turned
from linkwright.synthesis.nine_points.start import displacements
from linkwright.synthesis.nine_points.tracker import TOLERANCE, Places, carried, polished

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
