"""All classes of four-bars through nine given points: from the start set to the points.

Lost paths are tried again: with smaller steps, by the conjugate solutions (real points: the set is closed under
conjugation), along bent ways (nearly the same way, so nearly always the same end, but past the place where a path
came too near a singular point), and along other ways altogether.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linkwright.synthesis.nine_points.classes import (
    CLASSES,
    class_keys,
    conjugate,
    filled,
    new_classes,
)
from linkwright.synthesis.nine_points.start import random_points, start_set
from linkwright.synthesis.nine_points.tracker import MOST_STEPS, TOLERANCE, track

Complexes = NDArray[np.complex128]
Whole = NDArray[np.int64]

BENDS, DETOURS = 6, 2
BEND = 0.15


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


def _completed(
    found: Complexes, solutions: Complexes, arrived: NDArray[np.bool_], q: Complexes
) -> tuple[Complexes, int]:
    """The classes with those of lost and crossed paths, and how many further passes it took."""
    q0, u0 = start_set()
    found = filled(found, conjugate(found))
    again = u0[_doubtful(solutions, arrived)]
    extra = 0
    if len(found) < CLASSES:
        ends = track(again, q0, q, tolerance=0.1 * TOLERANCE, most=10 * MOST_STEPS)
        found, extra = filled(found, ends.solutions[ends.arrived]), 1
    rng = np.random.default_rng(0)
    for attempt in range(BENDS + DETOURS):
        if len(found) == CLASSES:
            break
        bent = attempt < BENDS
        via = 0.5 * (q0 + q) + BEND * random_points(rng) if bent else random_points(rng)
        ends = track(again if bent else u0, q0, via)
        ends = track(ends.solutions[ends.arrived], via, q)
        found = filled(found, ends.solutions[ends.arrived])
        found, extra = filled(found, conjugate(found)), extra + 1
    return found, extra


def _doubtful(solutions: Complexes, arrived: NDArray[np.bool_]) -> Whole:
    """Starts whose path was lost, and both of every pair with the same end."""
    good = np.flatnonzero(arrived)
    keys = class_keys(solutions[good])
    order = np.argsort(keys.real)
    near = np.abs(np.diff(keys[order])) < 1e-8
    twins = good[np.union1d(order[:-1][near], order[1:][near])]
    return np.union1d(np.flatnonzero(~arrived), twins)
