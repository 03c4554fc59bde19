"""The start set: nine general complex points and one solution of each of their 1442 classes.

Made by monodromy: from one made-up four-bar, all known solutions are carried around triangles through random points;
what comes back different is new. ``build`` makes it; the package has one, stored in single precision and polished
when it is read.
Source: Duff, Hill, Jensen, Lee, Leykin and Sommars 2019, IMA J. Numer. Anal. 39 (solving by monodromy).
"""

from __future__ import annotations

from functools import cache
from importlib import resources
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import numpy as np

from linkwright.core.arrays import Complexes, Integers
from linkwright.synthesis.nine_points.classes import CLASSES, class_keys, new_classes
from linkwright.synthesis.nine_points.tracker import track

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
