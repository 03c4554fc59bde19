"""Fronts of several objectives: evenly spread aims, and the designs that come nearest to them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.designs.optimise.task import Judged

#: The share of all objectives that is added to the largest, so that no other one is left worse than need be.
SHARED = 1e-4
#: What a design that misses a demand, or does not move, lies behind all others.
_BEHIND = 1e6


@dataclass(frozen=True, eq=False)
class Scale:
    """The minimum values of the objectives and the way from them to the worst of the designs that are best in one,
    (goals,) each."""

    minimum: Floats
    span: Floats

    @classmethod
    def of(cls, judged: Judged) -> Scale:
        """Of the designs that meet the demands, or, where none does, of those with the smallest violation."""
        moving = np.flatnonzero(np.isfinite(judged.goals).all(axis=1))
        if not len(moving):
            goals = np.zeros((1, judged.goals.shape[1]))
        else:
            missed = judged.total[moving]
            goals = judged.goals[moving[missed <= max(0.0, float(np.quantile(missed, 0.05)))]]
        minimum = goals.min(axis=0)
        span = goals[goals.argmin(axis=0)].max(axis=0) - minimum
        size = np.where(np.abs(minimum) > 0.0, np.abs(minimum), 1.0)
        return cls(minimum, np.where(span > 1e-9 * size, span, size))

    def shares(self, goals: Floats) -> Floats:
        """Objectives (N, goals) as shares of the way."""
        return np.asarray((goals - self.minimum) / self.span)

    def aims(self, points: Floats) -> Floats:
        """Objectives at shares (R, goals)."""
        return np.asarray(self.minimum + self.span * points)


def spread(goals: int, count: int) -> Floats:
    """Points (R, goals) spread evenly over the part of a plane where coordinates are positive and add up to 1: about
    ``count`` of them, one for one objective (Das and Dennis 1998)."""
    parts = 0
    while goals > 1 and math.comb(parts + goals, goals - 1) <= count:
        parts += 1
    rows = [np.diff([-1, *bars, parts + goals - 1]) - 1 for bars in combinations(range(parts + goals - 1), goals - 1)]
    return np.array(rows, dtype=float)[::-1] / max(parts, 1) if parts else np.ones((1, goals)) / goals


def nearest(judged: Judged, scale: Scale, points: Floats) -> Floats:
    """How far every design (N) is from every point (R): the largest distance in an objective, as share of its way,
    and a little of all of them; designs that miss demands lie behind those that meet them, (R, N)."""
    with np.errstate(invalid="ignore"):
        shares = scale.shares(judged.goals)
        found = (shares[None] - points[:, None]).max(axis=2) + SHARED * shares.sum(axis=1)
        behind = np.where(judged.total > 0.0, _BEHIND * (1.0 + judged.total), 0.0)
    return np.asarray(np.nan_to_num(found + behind, nan=np.inf, posinf=np.inf))


def picked(judged: Judged, distance: Floats, count: int, separation: float) -> list[int]:
    """Rows of at most ``count`` designs, no two nearer than ``separation`` in the cube: by turns the nearest
    to each point."""
    left, rows = distance.copy(), list[int]()
    for turn in range(count):
        row = int(left[turn % len(left)].argmin())
        if not np.isfinite(left[turn % len(left), row]):
            break
        rows.append(row)
        left[:, np.abs(judged.x - judged.x[row]).max(axis=1) <= separation] = np.inf
    return rows


def without_own(judged: Judged, points: Floats) -> Indices:
    """Points (R) whose nearest design is nearer to another one, so that the front has a gap there."""
    distance = nearest(judged, Scale.of(judged), points)
    rows, nearest_distance = distance.argmin(axis=1), distance.min(axis=1)
    order = np.lexsort((nearest_distance, rows))
    _, first = np.unique(rows[order], return_index=True)
    return np.setdiff1d(np.arange(len(points)), order[first])
