"""The local search on a task: what designs are made better by, and whether they became it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.designs.optimise.descent import LITTLE, STEPS, Model, descended
from linkwright.designs.optimise.evolution import joined
from linkwright.designs.optimise.front import SHARED
from linkwright.designs.optimise.task import Judged, Side, Task

#: Margin to the limit of a demand, in its scales, and the step of differences where no exact slope is had.
ROOM, STEP = 2e-7, 1e-5
#: A place in the cube nearer to a bound lies on it.
AT_BOUND = 1e-8
#: Minimum size of a demand relative to the start's value.
FINE = 1e-3
#: What demands leave to a machine that does not move, and the share of the machines on either side of a quantile
#: whose slopes count for it, one in so many.
STUCK, QUANTILE_SHARE = -1.0, 64
#: The value of an objective without weight: below all others.
_NONE = -1e6


class Polish:
    """Moves designs to the nearest optimum; variables with choices stay as they are."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.free = np.array([each.choices is None and each.high > each.low for each in task.problem.variables])
        self.names = tuple(each.address for each in task.problem.variables)
        self.span = np.where(task.high > task.low, task.high - task.low, 1.0)
        self.limits: list[tuple[str, float, float]] = []
        for each in task.bounds:
            start = abs(task.at_start[each.text])
            size = max(each.scale, FINE * start) if np.isfinite(start) else each.scale
            edge = ROOM * each.scale / size
            if np.isfinite(each.low):
                self.limits.append((each.text, 1 / size, -each.low / size - edge))
            if np.isfinite(each.high):
                self.limits.append((each.text, -1 / size, each.high / size - edge))

    def polished(
        self, before: Judged, weights: Floats, aims: Floats, steps: int = STEPS, little: float = LITTLE
    ) -> Judged:
        """The designs (K) with the largest of ``weights`` · (objective − ``aims``), (K, goals) each, made least and
        the demands kept; each where it became better, or misses less, else as it was."""
        sampled = self.task.problem.robust and not self.task.exact
        if not self.free.any() or sampled or not len(before.x):
            return before

        def evaluate(free: Floats, rows: Indices) -> Model:
            return self._model(self._all_variables(before.x[rows], free), weights[rows], aims[rows])

        moved = descended(evaluate, before.x[:, self.free], steps, little)
        moved = np.where(np.minimum(moved, 1.0 - moved) < AT_BOUND, np.round(moved), moved)
        after = self.task.judge(self._all_variables(before.x, moved))
        was, now = (_weighed(each.goals, weights, aims).max(axis=1) for each in (before, after))
        with np.errstate(invalid="ignore"):
            better = (after.total < before.total) | ((after.total == before.total) & (now <= was))
        return joined(before, after, np.flatnonzero(better), np.array([], dtype=np.intp))

    def _all_variables(self, x: Floats, free: Floats) -> Floats:
        found = x.copy()
        found[:, self.free] = free
        return found

    def _model(self, x: Floats, weights: Floats, aims: Floats) -> Model:
        """Objectives, what is left to demands, and the slopes of both by the free variables."""
        columns = self.task.columns_of(self.task.place(x))
        found = self._with_slopes(x, columns)
        own = [(goal.sign, *found[goal.text, goal.sign]) for goal in self.task.problem.goals]
        goals = np.column_stack([sign * value for sign, value, _ in own])
        falls = np.stack([sign * slope for sign, _, slope in own], axis=1)
        if self.task.problem.robust == "yield" and self.limits:
            rooms, climbs = self._left_to_share(columns)
        else:
            rooms, climbs = self._left(found)
        falls = weights[:, :, None] * falls
        falls += SHARED * falls.sum(axis=1, keepdims=True)
        goals = np.where(weights > 0.0, _weighed(goals, weights, aims), _NONE)
        bends = self._bends(columns, weights)
        return Model(x[:, self.free], goals, rooms, falls[:, :, self.free], climbs[:, :, self.free], bends)

    def _left(self, found: Mapping[Side, tuple[Floats, Floats]]) -> tuple[Floats, Floats]:
        """What is left to the demands, (K, demands), and its slopes, (K, demands, k)."""
        each = [(weight, offset, *found[text, -np.sign(weight)]) for text, weight, offset in self.limits]
        rooms = [weight * value + offset for weight, offset, value, _ in each]
        climbs = [weight * slope for weight, _, _, slope in each]
        shape = len(next(iter(found.values()))[0]), 0, len(self.names)
        return (np.stack(rooms, 1), np.stack(climbs, 1)) if each else (np.empty(shape[:2]), np.empty(shape))

    def _left_to_share(self, columns: Mapping[str, Floats]) -> tuple[Floats, Floats]:
        """What all demands leave to the best machine that must not be missed, (K, 1), and its slope, (K, 1, k).

        A share of the machines made meets the demands where a quantile of what these leave to the machines is not
        negative; its slope is that of the machine there (Hong 2009, *Operations Research* 57, 118), here the mean
        of some neighbours.
        """
        made, count = self.task.made(columns, self.task.samples), len(next(iter(columns.values())))
        values, slopes = self.task.measures.with_slopes(made, self.names)
        sides = {(text, sign): (values[text], slopes[text] * self.span) for text, sign in self.task.sides}
        rooms, climbs = self._left(sides)
        tightest = np.argmin(np.where(np.isnan(rooms), -np.inf, rooms), axis=1)
        room = np.take_along_axis(rooms, tightest[:, None], 1).reshape(count, -1)[:, 1:]
        climb = np.take_along_axis(climbs, tightest[:, None, None], 1).reshape(count, -1, len(self.names))[:, 1:]
        lost = ~np.isfinite(room)
        room, climb = np.where(lost, STUCK, room), np.where(lost[:, :, None], 0.0, climb)
        order, machines = np.argsort(room, axis=1), room.shape[1]
        last = min(int((1.0 - self.task.wanted) * machines + 1e-9), machines - 1)
        near = machines // QUANTILE_SHARE
        around = order[:, max(0, last - near) : last + near + 1]
        slope = np.take_along_axis(climb, around[:, :, None], 1).mean(axis=1)
        return np.take_along_axis(room, order[:, last : last + 1], 1), slope[:, None, :]

    def _bends(self, columns: Mapping[str, Floats], weights: Floats) -> Floats:
        """What is known of the weighted objectives' curvatures by the free variables, (K, goals, n, n)."""
        span = self.span[self.free]
        found = np.zeros((*weights.shape, len(span), len(span)))
        for k, goal in enumerate(self.task.problem.goals):
            bent = self.task.measures.curvatures(goal.text, columns, self.names)
            if bent is not None and goal.sign > 0.0:
                free = bent[:, self.free][:, :, self.free] * span[:, None] * span
                found[:, k] = weights[:, k, None, None] * free
        return np.asarray(found + SHARED * found.sum(axis=1, keepdims=True))

    def _with_slopes(self, x: Floats, columns: Mapping[str, Floats]) -> dict[Side, tuple[Floats, Floats]]:
        """Values (K,) and gradients (K, k) by the cube's coordinates, exact where they can be had, of what must not
        become larger (1) or smaller (-1): of the worst machine within the tolerances where that is asked."""
        measures, sides = self.task.measures, self.task.sides
        if not measures.side_by_side:
            values, slopes = self._by_differences(x)
            return {(text, sign): (values[text], slopes[text]) for text, sign in sides}
        if self.task.at_corners:
            columns, _ = self.task.corners(columns)
        values, slopes = measures.with_slopes(columns, self.names)
        per_design, found = len(next(iter(columns.values()))) // len(x), {}
        for k, (text, sign) in enumerate(sides):
            rows = slice(k if per_design > 1 else 0, None, per_design)
            found[text, sign] = values[text][rows], slopes[text][rows] * self.span
        return found

    def _by_differences(self, x: Floats) -> tuple[dict[str, Floats], dict[str, Floats]]:
        """The same by central differences, all designs in one go."""
        (count, k), free = x.shape, np.flatnonzero(self.free)
        step = np.zeros((2 * len(free) + 1, k))
        step[1 + np.arange(len(free)), free] = STEP
        step[1 + len(free) + np.arange(len(free)), free] = -STEP
        rows = np.clip(x[:, None, :] + step, 0.0, 1.0)
        found = self.task.measures(self.task.columns_of(self.task.place(rows.reshape(-1, k))))
        width = np.maximum((rows[:, 1 : len(free) + 1] - rows[:, len(free) + 1 :])[:, range(len(free)), free], 1e-12)
        values, slopes = {}, {}
        for text, column in found.items():
            each = column.reshape(count, -1)
            values[text], slopes[text] = each[:, 0], np.zeros((count, k))
            slopes[text][:, free] = (each[:, 1 : len(free) + 1] - each[:, len(free) + 1 :]) / width
        return values, slopes


def _weighed(goals: Floats, weights: Floats, aims: Floats) -> Floats:
    """What is minimized, (K, goals): the largest counts."""
    with np.errstate(invalid="ignore"):
        found = np.where(weights > 0.0, weights * (goals - aims), 0.0)
        return np.asarray(found + SHARED * found.sum(axis=1, keepdims=True))
