"""Solutions and their classes: every curve belongs to six solutions, two orders of the dyads times three cognates.

Nine general points have 8652 solutions in 1442 classes (Wampler, Morgan and Sommese 1992). One solution of each
class is carried; the others follow: the cognate that keeps the first pivot exchanges x and w (Roberts 1875), so it
is exact.
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Integers

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
