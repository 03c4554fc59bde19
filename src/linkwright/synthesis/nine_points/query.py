"""All classes of four-bars through nine given points: from the start set to the points.

What lost paths leave open is sought again: by the conjugate solutions (real points: the set is closed under
conjugation), with smaller steps from all three cognates (where one of them goes far, another need not), and along
other ways: to the points turned about the first one, from where the solutions are turned back.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Integers
from linkwright.synthesis.nine_points.classes import (
    CLASSES,
    class_keys,
    conjugate,
    filled,
    new_classes,
    relatives,
    turned,
)
from linkwright.synthesis.nine_points.start import start_set
from linkwright.synthesis.nine_points.tracker import MOST_STEPS, TOLERANCE, track

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
