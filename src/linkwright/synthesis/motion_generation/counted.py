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

from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.synthesis.nine_points.classes import MIX, PROBES, conjugate
from linkwright.synthesis.nine_points.start import displacements

FILE = "mixed_starts.npz"
#: Four-bars through M poses and 10 - 2 M points.
KNOWN = {4: 30, 3: 201, 2: 1112}
TOLERANCE, SMALLEST, LARGEST, MOST_STEPS = 1e-3, 1e-12, 0.2, 1500
SAME, REAL, TURNS = 1e-7, 1e-6, 6


@dataclass(frozen=True, eq=False)
class Places:
    """Displacements d, partners e (n,) of the places after the first, the poses first, and g (M - 1,) of those."""

    d: Complexes
    e: Complexes
    g: Complexes

    def toward(self, other: Places, t: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """d, e (n, K) and g (M - 1, K) at the parts t (K,) of the way."""
        pairs = ((self.d, other.d), (self.e, other.e), (self.g, other.g))
        d, e, g = (a[:, None] + t * (b - a)[:, None] for a, b in pairs)
        return d, e, g

    def turned(self, way: complex) -> Places:
        """The places turned about the first."""
        return Places(self.d * way, self.e / way, self.g)


def all_four_bars(places: Places) -> Complexes:
    """The solutions (K, 8 + N) of real places, one of both orders of the dyads."""
    poses = len(places.g) + 1
    first, start = start_set(poses)
    ends, arrived = carried(start, first, places)
    found = _distinct(ends[arrived])
    for turn in range(TURNS + 1):
        if len(found) >= KNOWN[poses]:
            break
        way = np.exp(1j * turn)
        ends, arrived = carried(start, first, places.turned(way), 0.1 * TOLERANCE)
        more = ends[arrived]
        more[:, :8:2] /= way
        more[:, 1:8:2] *= way
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
    for _ in range(4):
        u = u + linear_step(u.T, *places.toward(places, np.zeros(len(u))), None).T
    return places, u


def build(path: Path, seed: int = 1, idle: int = 8) -> None:
    """Makes the start sets and writes them: carried around triangles until ``idle`` of them bring nothing new."""
    rng = np.random.default_rng(seed)
    kept: dict[str, NDArray[Any]] = {}
    for poses in KNOWN:
        places, u = _made_up(poses, rng)
        quiet = 0
        while quiet < idle:
            ends = around(places, u, rng)
            more = _distinct(np.concatenate([u, ends]))
            quiet = quiet + 1 if len(more) == len(u) else 0
            u = more
        kept |= {f"d{poses}": places.d, f"e{poses}": places.e, f"g{poses}": places.g}
        kept[f"u{poses}"] = u.astype(np.complex64)
    with path.open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, **kept)


def around(places: Places, u: Complexes, rng: np.random.Generator) -> Complexes:
    """Solutions carried around a random triangle, less the lost ones."""
    corners = [places, _general(places, rng), _general(places, rng), places]
    for first, second in pairwise(corners):
        ends, arrived = carried(u, first, second)
        u = ends[arrived]
    return u


def carried(
    u: Complexes, first: Places, last: Places, tolerance: float = TOLERANCE
) -> tuple[Complexes, Flags]:
    """Solutions (K, 8 + N) of the places ``first`` carried straight to ``last``, and which arrived.

    Runge and Kutta's fourth order, two Newton corrections, the step from the first one.
    """
    change = (last.d - first.d)[:, None], (last.e - first.e)[:, None], (last.g - first.g)[:, None]
    ends, arrived = u.copy(), np.zeros(len(u), bool)
    who, t, h, z = np.arange(len(u)), np.zeros(len(u)), np.full(len(u), 0.02), u.T.copy()

    def rate(at: Complexes, part: Floats) -> Complexes:
        return linear_step(at, *first.toward(last, part), change)

    with np.errstate(all="ignore"):
        for _ in range(MOST_STEPS):
            h = np.minimum(h, 1 - t)
            k1 = rate(z, t)
            k2 = rate(z + h / 2 * k1, t + h / 2)
            k3 = rate(z + h / 2 * k2, t + h / 2)
            k4 = rate(z + h * k3, t + h)
            moved = z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            sizes = []
            for _ in range(2):
                step = linear_step(moved, *first.toward(last, t + h), None)
                sizes.append(_size(step, moved))
                moved = moved + step
            good = (sizes[0] < 8 * tolerance) & (sizes[1] < np.clip(0.1 * sizes[0], 1e-7, 1e-5))
            z, t = np.where(good, moved, z), np.where(good, t + h, t)
            growth = 0.85 * (tolerance / (np.minimum(sizes[0], 1e3) + 1e-12)) ** 0.2
            h = np.minimum(LARGEST, h * np.where(good, np.clip(growth, 0.4, 2), np.clip(growth, 0.2, 0.6)))
            done = t >= 1 - 1e-14
            ends[who[done]], arrived[who[done]] = z[:, done].T, True
            stay = ~done & (h > SMALLEST)
            z, t, h, who = z[:, stay], t[stay], h[stay], who[stay]
            if not len(who):
                break
        for _ in range(2):
            step = linear_step(ends.T, *last.toward(last, np.zeros(len(ends))), None)
            ends = np.where((_size(step, ends.T) < 1e-6)[:, None], ends + step.T, ends)
    return ends, arrived


def linear_step(
    u: Complexes, d: Complexes, e: Complexes, given: Complexes,
    change: tuple[Complexes, Complexes, Complexes] | None,
) -> Complexes:  # fmt: skip
    """du/dt (8 + N, K) for places that move by ``change``, or the Newton correction where that is None."""
    poses, count = len(given), u.shape[1]
    g = np.concatenate([given, u[8:]])
    near = 1.0 / (1.0 + g)
    f = -g * near
    gradients, slopes, rights = [], [], []
    for o in (0, 4):
        x, xc, w, wc = u[o], u[o + 1], u[o + 2], u[o + 3]
        m, n = d + x * g, e + xc * f
        mw, nw = m - w, n - wc
        gradients.append(np.stack([g * nw, f * mw, -n, -m], 2))
        slope = x * nw - xc * mw * near * near
        slopes.append(slope)
        if change is None:
            rights.append(n * w - m * nw)
        else:
            right = -(change[0] * nw + change[1] * mw)
            right[:poses] -= slope[:poses] * change[2]
            rights.append(right)
    first, second = (slope[poses:] for slope in slopes)
    size = np.sqrt(np.abs(first) ** 2 + np.abs(second) ** 2) + 1e-150
    p, r = second / size, -first / size
    system, right = np.zeros((count, 8, 8), complex), np.empty((count, 8), complex)
    for k, o in ((0, 0), (1, 4)):
        rows = slice(k * poses, (k + 1) * poses)
        system[:, rows, o : o + 4] = gradients[k][:poses].transpose(1, 0, 2)
        right[:, rows] = rights[k][:poses].T
        system[:, 2 * poses :, o : o + 4] = ((p, r)[k][:, :, None] * gradients[k][poses:]).transpose(1, 0, 2)
    right[:, 2 * poses :] = (p * rights[0][poses:] + r * rights[1][poses:]).T
    bad = ~np.isfinite(system.sum((1, 2)) + right.sum(1))
    system[bad], right[bad] = np.eye(8), np.nan
    lengths = np.linalg.solve(system, right[:, :, None])[:, :, 0].T
    rest = [
        rights[k][poses:] - np.einsum("jkc,ck->jk", gradients[k][poses:], lengths[4 * k : 4 * k + 4])
        for k in (0, 1)
    ]
    by_first = np.abs(first) > np.abs(second)
    turns = np.where(by_first, rest[0], rest[1]) / np.where(by_first, first, second)
    return np.concatenate([lengths, turns])


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
    found = keys(u)
    order = np.argsort(found.real, kind="stable")
    repeated = np.zeros(len(u), bool)
    for step in range(1, len(u)):
        one, two = order[:-step], order[step:]
        near = found.real[two] - found.real[one] < SAME
        if not near.any():
            break
        repeated[np.maximum(one, two)[near & (np.abs(found[two] - found[one]) < SAME)]] = True
    return u[~repeated]


def _size(step: Complexes, u: Complexes) -> Floats:
    lengths = (np.abs(step[:8]) / (np.abs(u[:8]) + 0.01)).max(0)
    turns = (np.abs(step[8:]) / np.minimum(np.abs(u[8:]) + 0.01, np.abs(1 + u[8:]))).max(0)
    size = np.maximum(lengths, turns)
    return np.asarray(np.where(np.isfinite(size), size, np.inf))


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
