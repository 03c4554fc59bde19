"""All classes of four-bars through nine given points: classes of solutions, the start set, the query.

Nine general points have 8652 solutions in 1442 classes (Wampler, Morgan and Sommese 1992). One solution of each
class is carried; the others follow: the cognate that keeps the first pivot exchanges x and w (Roberts 1875), so it
is exact.

Made by monodromy: from one made-up four-bar, all known solutions are carried around triangles through random points;
what comes back different is new. ``build`` makes it; the package has one, stored in single precision and polished
when it is read.
Source: Duff, Hill, Jensen, Lee, Leykin and Sommars 2019, IMA J. Numer. Anal. 39 (solving by monodromy).

What lost paths leave open is sought again: by the conjugate solutions (real points: the set is closed under
conjugation), with smaller steps from all three cognates (where one of them goes far, another need not), and along
other ways: to the points turned about the first one, from where the solutions are turned back.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib import resources
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Integers
from linkwright.synthesis.path_generation.tracking import MOST_STEPS, TOLERANCE, track

CLASSES = 1442
#: Constants of the key that distinguishes classes: any general complex numbers do.
PROBES = np.array([[0.31 + 1.7j, -1.9 - 0.6j], [1.4 - 1.1j, -0.8 + 1.3j]])
MIX = np.array([[1.0, 0.62 - 0.7j], [-0.41 + 0.9j, 0.83 + 0.35j]])
SAME = 1e-8


def exchanged(u: Complexes) -> Complexes:
    """The solutions with their dyads exchanged."""
    return np.concatenate([u[:, 4:8], u[:, :4], u[:, 8:]], 1)


def cognate(u: Complexes, q: Complexes) -> Complexes:
    """The cognates that keep the first pivot."""
    v = u.copy()
    for s in (0, 1):
        x, w, y, r = (u[:, s + 2 * k] for k in range(4))
        v[:, s], v[:, 2 + s], v[:, 4 + s], v[:, 6 + s] = w, x, w * y / (y - x), x * r / (x - y)
    v[:, 8:] = -(q[0] + u[:, :1] * u[:, 8:]) / u[:, 2:3]
    return v


def relatives(u: Complexes, q: Complexes) -> list[Complexes]:
    """The six solutions of each class."""
    three = [u, cognate(u, q), cognate(exchanged(u), q)]
    return three + [exchanged(v) for v in three]


def conjugate(u: Complexes) -> Complexes:
    """The conjugate solutions: with real points they are solutions as well."""
    v = u.conj()
    v[:, :8] = v[:, [1, 0, 3, 2, 5, 4, 7, 6]]
    v[:, 8:] = -v[:, 8:] / (1 + v[:, 8:])
    return v


def turned(u: Complexes, way: complex) -> Complexes:
    """The solutions for points multiplied by the unit vector ``way``."""
    v = u.copy()
    v[:, :8:2] *= way
    v[:, 1:8:2] /= way
    return v


def is_real(u: Complexes) -> Flags:
    """Which solutions are four-bars of the real plane."""
    return np.asarray(np.abs(conjugate(u) - u).max(1) < 1e-7 * np.abs(u).max(1))


def class_keys(u: Complexes) -> Complexes:
    """A number of each class (N,): symmetric in the three pivots of the cognates, bounded where pivots go far."""
    key = np.zeros(len(u), complex)
    for s in (0, 1):
        x, w, y, v = (u[:, s + 2 * k] for k in range(4))
        pivots = np.stack([x + w, y + v, (v * x - w * y) / (x - y)])
        for k in (0, 1):
            key += MIX[s, k] * (1 / (pivots - PROBES[s, k])).sum(0)
    return key


def new_classes(u: Complexes, known: Complexes) -> Integers:
    """Rows of u whose class is neither among the ``known`` keys nor earlier in u."""
    return np.flatnonzero(~repeated(np.concatenate([known, class_keys(u)]), SAME)[len(known) :])


def repeated(keys: Complexes, same: float) -> Flags:
    """Which keys differ by less than ``same`` from one before them."""
    order = np.argsort(keys.real, kind="stable")
    found = np.zeros(len(keys), bool)
    for step in range(1, len(keys)):
        first, second = order[:-step], order[step:]
        near = keys.real[second] - keys.real[first] < same
        if not near.any():
            break
        near &= np.abs(keys[second] - keys[first]) < same
        found[np.maximum(first, second)[near]] = True
    return found


def filled(found: Complexes, candidates: Complexes) -> Complexes:
    """``found`` with candidates of missing classes, the farthest from the known first, up to the known count."""
    candidates = candidates[new_classes(candidates, class_keys(found))]
    if not len(candidates):
        return found
    gap = np.abs(class_keys(candidates)[:, None] - class_keys(found)).min(1)
    order = np.argsort(-gap)[: CLASSES - len(found)]
    return np.concatenate([found, candidates[order[gap[order] > 10 * SAME]]])


FILE = "start_set.npz"


@cache
def start_set() -> tuple[Complexes, Complexes]:
    """Points q (2, 8) and solutions (1442, 16). Raises ValueError where the file of the package is damaged."""
    content = (resources.files(__package__) / FILE).read_bytes()
    with np.load(BytesIO(content), allow_pickle=False) as data:
        q, u = data["q"], data["u"].astype(complex)
    ends = track(u, q, q)
    if not ends.arrived.all() or len(new_classes(ends.solutions, np.empty(0, complex))) != CLASSES:
        raise ValueError("the start set of nine-point synthesis is damaged; install the package again")
    return q, ends.solutions


def build(path: Path, seed: int = 1, enough: int = CLASSES) -> None:
    """Makes a start set and writes it."""
    rng = np.random.default_rng(seed)
    q, u = _made_up(rng)
    while len(u) < enough:
        ends, _ = around(q, u, rng)
        u = np.concatenate([u, ends[new_classes(ends, class_keys(u))]])
    np.savez_compressed(path, q=q, u=u.astype(np.complex64))


def around(q: Complexes, u: Complexes, rng: np.random.Generator) -> tuple[Complexes, int]:
    """Solutions carried around a random triangle from q back to q, and how many were lost on the way."""
    corners = [q, random_points(rng), random_points(rng), q]
    count = len(u)
    for first, second in pairwise(corners):
        ends = track(u, first, second)
        u = ends.solutions[ends.arrived]
    return u, count - len(u)


def random_points(rng: np.random.Generator) -> Complexes:
    """General complex displacements and partners, (2, 8)."""
    return np.asarray(rng.normal(size=(2, 8)) + 1j * rng.normal(size=(2, 8)))


def _made_up(rng: np.random.Generator) -> tuple[Complexes, Complexes]:
    """Eight displacements of a made-up complex four-bar, and it as their first solution."""
    z = rng.normal(size=8) + 1j * rng.normal(size=8)
    g = np.exp(0.5 * rng.normal(size=8) + 2j * np.pi * rng.random(8)) - 1
    return np.stack(displacements(z, g, rng.choice([-1, 1], 8))), np.concatenate([z, g])[None]


def displacements(z: Complexes, g: Complexes, sign: Integers) -> tuple[Complexes, Complexes]:
    """Displacement and partner (d, e) at which the four-bar z (8,) has the coupler rotations 1 + g.

    Each dyad gives d e + l d + m e + c = 0; their difference is a line, the other intersection a square root.
    """
    f = -g / (1 + g)

    def circle(x: complex, xc: complex, w: complex, wc: complex) -> tuple[Complexes, Complexes, Complexes]:
        s, sc = x * g, xc * f
        return sc - wc, s - w, s * sc - s * wc - sc * w

    l1, m1, c1 = circle(*z[:4])
    l2, m2, c2 = circle(*z[4:])
    dl, dm, dc = l1 - l2, m1 - m2, c1 - c2
    qa, qb, qc = -dl / dm, l1 - (dc + m1 * dl) / dm, c1 - m1 * dc / dm
    d = (-qb + sign * np.sqrt(qb * qb - 4 * qa * qc + 0j)) / (2 * qa)
    return d, -(dl * d + dc) / dm


#: Other ways that are tried at most; with more classes missing the points are special, and other ways miss them too.
TURNS, SPECIAL = 8, 100
#: Second corrections that are taken for rounding where a lost path is tracked again.
COARSE = 3e-6


@dataclass(frozen=True, eq=False)
class NinePoints:
    """One solution per class (K, 16) in units of ``scale`` (m) with the first point at 0, and the points q (2, 8).

    ``lost``: paths of the first pass that did not arrive; ``extra``: passes that were needed after it.
    """

    solutions: Complexes
    q: Complexes
    scale: float
    lost: int
    extra: int

    @property
    def complete(self) -> bool:
        """Whether every class is there."""
        return len(self.solutions) == CLASSES


def nine_points(points: Complexes) -> NinePoints:
    """The classes of four-bars through nine points (9,)."""
    d = points[1:] - points[0]
    scale = float(np.sqrt(np.mean(np.abs(d) ** 2)))
    q = np.stack([d / scale, d.conj() / scale])
    q0, u0 = start_set()
    ends = track(u0, q0, q)
    good = np.flatnonzero(ends.arrived)
    found = ends.solutions[good[new_classes(ends.solutions[good], np.empty(0, complex))]]
    lost, extra = len(u0) - len(good), 0
    if len(found) < CLASSES:
        found, extra = _completed(found, ends.solutions, ends.arrived, q)
    return NinePoints(found, q, scale, lost, extra)


def _completed(found: Complexes, solutions: Complexes, arrived: Flags, q: Complexes) -> tuple[Complexes, int]:
    """The classes with those of lost and crossed paths, and how many further passes it took."""
    q0, u0 = start_set()
    found = filled(found, conjugate(found))
    again = np.concatenate(relatives(u0[_doubtful(solutions, arrived)], q0)[:3])
    extra = 0
    if len(found) < CLASSES:
        ends = track(again, q0, q, tolerance=0.1 * TOLERANCE, most=10 * MOST_STEPS, rounding=COARSE)
        found, extra = filled(found, ends.solutions[ends.arrived]), 1
    for turn in range(1, TURNS + 1):
        if len(found) == CLASSES or CLASSES - len(found) > SPECIAL:
            break
        way = np.exp(1j * turn)
        ends = track(u0, q0, q * np.array([[way], [1 / way]]))
        found, extra = filled(found, turned(ends.solutions[ends.arrived], 1 / way)), extra + 1
        found = filled(found, conjugate(found))
    return found, extra


def _doubtful(solutions: Complexes, arrived: Flags) -> Integers:
    """Starts whose path was lost, and both of every pair with the same end."""
    good = np.flatnonzero(arrived)
    keys = class_keys(solutions[good])
    order = np.argsort(keys.real)
    near = np.abs(np.diff(keys[order])) < 1e-8
    twins = good[np.union1d(order[:-1][near], order[1:][near])]
    return np.union1d(np.flatnonzero(~arrived), twins)
