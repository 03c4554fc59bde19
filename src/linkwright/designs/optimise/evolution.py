"""The global search: generalised differential evolution for one objective or several, with demands.

A trial takes a design's place where it is feasible and the design is not, or violates less, or dominates it; of two
that beat each other in something both stay, and the crowded of the worst fronts leave (GDE3: Kukkonen and Lampinen
2005; feasibility: Deb 2000). A generation is judged in one sweep. All random numbers come from the seed, and a state
holds everything, so a search that was interrupted goes on as if it had not been.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices, Integers
from linkwright.designs.optimise.task import Judged, Task

#: A search with one objective ends where the best of this many generations gained less than this share.
IDLE, GAIN = 20, 1e-4


@dataclass
class State:
    """Population with its judgement, generations done, evaluations, and the random generator."""

    judged: Judged
    generation: int
    evaluations: int
    draw: np.random.Generator
    history: list[float]

    def data(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "x": self.judged.x,
            "generation": self.generation,
            "evaluations": self.evaluations,
            "draw": self.draw.bit_generator.state,
            "history": np.array(self.history),
        }


def begin(task: Task, count: int) -> State:
    """The start itself, designs near it, and others spread evenly between the bounds (a Latin hypercube)."""
    k = len(task.problem.variables)
    draw = np.random.default_rng(task.problem.seed)
    x = np.column_stack([(draw.permutation(count) + draw.random(count)) / count for _ in range(k)])
    x[0] = np.clip(task.inverse(task.problem.start), 0, 1)
    near = max(2, count // 4)
    x[1:near] = np.clip(x[0] + 0.05 * draw.normal(size=(near - 1, k)), 0, 1)
    return State(task.judge(x), 0, count, draw, [])


def resumed(task: Task, data: dict[str, Any]) -> State:
    """A state from its data; the population is judged anew. Raises ValueError for data of no search."""
    draw = np.random.default_rng()
    draw.bit_generator.state = data["draw"]
    x = np.array(data["x"], dtype=float)
    done, evaluations = int(data["generation"]), int(data["evaluations"])
    history = [*map(float, data["history"])]
    if x.shape[1:] != (len(task.problem.variables),) or not ((x >= 0.0) & (x <= 1.0)).all():
        raise ValueError("x")
    if done != len(history) or evaluations < len(x) * (done + 1):
        raise ValueError("generation")
    return State(task.judge(x), done, evaluations, draw, history)


def generation(task: Task, state: State) -> None:
    """One generation."""
    judged, draw = state.judged, state.draw
    size, k = judged.x.shape
    trial = task.judge(_trials(judged, draw, size, k))
    better = dominates(trial, judged, np.arange(size), np.arange(size))
    worse = dominates(judged, trial, np.arange(size), np.arange(size))
    both = ~better & ~worse & np.isfinite(trial.goals).all(axis=1)
    if judged.goals.shape[1] == 1:
        better, both = ~worse & np.isfinite(trial.goals[:, 0]), np.zeros(size, bool)
    merged = joined(judged, trial, np.flatnonzero(better), np.flatnonzero(both & ~better))
    state.judged = survivors(merged, size)
    state.generation += 1
    state.evaluations += size
    state.history.append(best_value(state.judged))


def _trials(judged: Judged, draw: np.random.Generator, size: int, k: int) -> Floats:
    """A design, moved towards one of the best and along the difference of two others; some numbers stay."""
    order = ranked(judged)
    leaders = order[draw.integers(0, max(2, size // 5), size)]
    a, b, c = (draw.permutation(size) for _ in range(3))
    f = draw.uniform(0.4, 0.95, (size, 1))
    x = judged.x
    greedy = draw.random((size, 1)) < 0.5
    base = np.where(greedy, x + f * (x[leaders] - x), x[c])
    moved = base + f * (x[a] - x[b])
    crossed = draw.random((size, k)) < draw.choice([0.5, 0.95], (size, 1))
    crossed[np.arange(size), draw.integers(0, k, size)] = True
    moved = np.where(crossed, moved, x)
    moved = np.where(moved < 0, -moved, moved)
    return np.clip(np.where(moved > 1, 2 - moved, moved), 0, 1)


def dominates(a: Judged, b: Judged, i: Indices, j: Indices) -> Flags:
    """Which designs a[i] beat b[j]: feasible before not, less violation, no objective worse and one better."""
    va, vb = a.total[i], b.total[j]
    goals = [(of_a[i], of_b[j]) for of_a, of_b in zip(a.goals.T, b.goals.T, strict=True)]
    with np.errstate(invalid="ignore"):
        front = np.logical_and.reduce([x <= y for x, y in goals])
        front &= np.logical_or.reduce([x < y for x, y in goals])
    return np.asarray(np.where((va == 0) & (vb == 0), front, va < vb))


def joined(old: Judged, new: Judged, replaced: Indices, added: Indices) -> Judged:
    """The old designs, some replaced by the new ones of the same number, and further new ones."""

    def merged(a: Floats, b: Floats) -> Floats:
        found = a.copy()
        found[replaced] = b[replaced]
        return np.concatenate([found, b[added]])

    values = {text: merged(each, new.values[text]) for text, each in old.values.items()}
    return Judged(merged(old.x, new.x), merged(old.goals, new.goals), merged(old.violations, new.violations), values)


def taken(judged: Judged, rows: Indices) -> Judged:
    """Some of the designs."""
    values = {text: each[rows] for text, each in judged.values.items()}
    return Judged(judged.x[rows], judged.goals[rows], judged.violations[rows], values)


def fronts(judged: Judged) -> Integers:
    """The number of every design's front: 0 is beaten by none, 1 by none but those of 0, …"""
    size, rows = len(judged.x), np.arange(len(judged.x))
    beats = dominates(judged, judged, rows[:, None], rows)
    level, left, number = np.zeros(size, np.int64), np.ones(size, bool), 0
    while left.any():
        now = left & ~(beats[left].any(axis=0))
        if not now.any():
            now = left.copy()
        level[now] = number
        left &= ~now
        number += 1
    return level


def crowding(goals: Floats) -> Floats:
    """Distance between the neighbours of each design in the objectives."""
    return _crowding(goals, [np.argsort(column, kind="stable") for column in goals.T])


def _crowding(goals: Floats, orders: list[Indices]) -> Floats:
    """The same of the designs in the orders of each objective; 0 for others."""
    found = np.zeros(len(goals))
    for column, order in zip(goals.T, orders, strict=True):
        span = column[order[-1]] - column[order[0]] if np.isfinite(column[order[0]]) else 0.0
        found[order[[0, -1]]] = np.inf
        if len(order) > 2 and 0 < span < np.inf:
            found[order[1:-1]] += (column[order[2:]] - column[order[:-2]]) / span
    return found


def survivors(judged: Judged, size: int) -> Judged:
    """The best ``size`` designs: front by front, the crowded of the last one left out one by one."""
    if len(judged.x) <= size:
        return judged
    level = fronts(judged)
    order = np.argsort(level, kind="stable")
    cut = level[order[size - 1]]
    sure, last = np.flatnonzero(level < cut), np.flatnonzero(level == cut)
    goals, left = judged.goals[last], np.arange(len(last))
    orders = [np.argsort(column, kind="stable") for column in goals.T]
    while len(sure) + len(left) > size:
        crowded = left[np.argmin(_crowding(goals, orders)[left])]
        left, *orders = (each[each != crowded] for each in (left, *orders))
    return taken(judged, np.concatenate([sure, last[left]]))


def ranked(judged: Judged) -> Indices:
    """Rows, the best first."""
    if judged.goals.shape[1] == 1:
        return np.lexsort((judged.goals[:, 0], judged.total))
    level = fronts(judged)
    with np.errstate(invalid="ignore"):
        return np.lexsort((-crowding(judged.goals), level))


def best_value(judged: Judged) -> float:
    """The smallest first objective of feasible designs; infinite where there is none."""
    good = judged.total == 0
    return float(judged.goals[good, 0].min()) if good.any() else float("inf")


def idle(state: State) -> bool:
    """Whether one objective gains nothing any more."""
    found = state.history
    if state.judged.goals.shape[1] > 1 or len(found) <= IDLE or not np.isfinite(found[-IDLE]):
        return False
    return found[-IDLE] - found[-1] <= GAIN * abs(found[-1])


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
