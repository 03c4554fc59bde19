"""The local search: sequential quadratic programming with exact gradients (Kraft 1988), several designs at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.optimisation.evolution import taken
from linkwright.optimisation.task import Judged, Task
from linkwright.optimisation.together import together

Floats = NDArray[np.float64]
STEPS = 30
#: A place of the cube, and whether gradients are wanted there beside values; by text what was found.
Question = tuple[Floats, bool]
Ask = Callable[[Question], dict[str, Floats]]


class Polish:
    """Moves designs to the nearest optimum; variables with choices stay as they are."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.free = np.array(
            [each.choices is None and each.high > each.low for each in task.problem.variables]
        )
        self.names = tuple(each.address for each in task.problem.variables)
        self.span = np.where(task.high > task.low, task.high - task.low, 1.0)

    def polished(self, judged: Judged, rows: Sequence[int], lead: Sequence[int]) -> Judged:
        """The designs of some rows after it, where they are feasible and better, or miss less.

        ``lead``: which objective each makes least; the others stay at most what they were, or are free (~number).
        """
        if not self.free.any() or self.task.problem.robust or not rows:
            return taken(judged, np.array(rows, dtype=np.intp))
        searches = [
            partial(self._one, judged.x[r], judged.goals[r], k) for r, k in zip(rows, lead, strict=True)
        ]
        moved = np.array(together(searches, self._answers))
        after, before = self.task.judge(moved), taken(judged, np.array(rows, dtype=np.intp))
        feasible, was = after.total == 0, before.total == 0
        own, chief = np.arange(len(rows)), np.array([k if k >= 0 else ~k for k in lead])
        no_worse = after.goals[own, chief] <= before.goals[own, chief]
        better = np.where(feasible & was, no_worse, np.where(feasible, True, after.total < before.total))
        pick = np.where(better, np.arange(len(rows)) + len(rows), np.arange(len(rows)))
        both = Judged(
            np.concatenate([before.x, after.x]), np.concatenate([before.goals, after.goals]),
            np.concatenate([before.violations, after.violations]),
            {text: np.concatenate([each, after.values[text]]) for text, each in before.values.items()},
        )  # fmt: skip
        return taken(both, pick.astype(np.intp))

    def _one(self, x: Floats, goals: Floats, lead: int, ask: Ask) -> Floats:
        """One objective made least, the others at most what they were (free: ``lead`` < 0), the demands kept."""
        from scipy.optimize import minimize

        at = _Place(ask)
        sizes = np.where(np.isfinite(goals) & (goals != 0), np.abs(goals), 1.0)
        own = lead if lead >= 0 else ~lead
        chief, scale = self.task.problem.goals[own].text, self.task.problem.goals[own].sign / sizes[own]
        limits: list[tuple[str, float, float]] = []
        for each in self.task.bounds:
            room = 2e-7 * each.scale
            if np.isfinite(each.low):
                limits.append((each.text, 1 / each.scale, -(each.low + room) / each.scale))
            if np.isfinite(each.high):
                limits.append((each.text, -1 / each.scale, (each.high - room) / each.scale))
        if lead >= 0 and np.isfinite(goals).all():
            limits += [(goal.text, -goal.sign / sizes[k], goals[k] / sizes[k])
                       for k, goal in enumerate(self.task.problem.goals) if k != lead]  # fmt: skip

        def whole(y: Floats) -> Floats:
            z = x.copy()
            z[self.free] = np.clip(y, 0, 1)
            return z

        def value(y: Floats) -> float:
            found = scale * at.values(whole(y))[chief]
            return float(found) if np.isfinite(found) else 1e6

        def slope(y: Floats) -> Floats:
            return np.asarray(np.nan_to_num(scale * at.slopes(whole(y))[chief][self.free]))

        def rooms(y: Floats) -> Floats:
            values = at.values(whole(y))
            found = np.array([weight * values[text] + offset for text, weight, offset in limits])
            return np.asarray(np.where(np.isfinite(found), found, -1e3))

        def room_slopes(y: Floats) -> Floats:
            slopes = at.slopes(whole(y))
            return np.asarray(np.nan_to_num([w * slopes[text][self.free] for text, w, _ in limits]))

        keep: Any = [{"type": "ineq", "fun": rooms, "jac": room_slopes}] if limits else []
        try:
            done = minimize(
                value, x[self.free], jac=slope, method="SLSQP", bounds=[(0.0, 1.0)] * int(self.free.sum()),
                constraints=keep, options={"maxiter": STEPS, "ftol": 1e-8},
            )  # fmt: skip
        except ValueError:  # a design that does not move gave no slope
            return x
        return whole(np.asarray(done.x)) if np.isfinite(done.x).all() else x

    def _answers(self, asked: list[Question]) -> list[dict[str, Floats]]:
        """Values by text, or gradients by the cube's coordinates, of places, all that go side by side at once."""
        found: list[dict[str, Floats]] = [{} for _ in asked]
        for sloped, answers in ((False, self._values), (True, self._slopes)):
            rows = [k for k, (_, slope) in enumerate(asked) if slope is sloped]
            if rows:
                for text, each in answers(np.array([asked[k][0] for k in rows])).items():
                    for k, one in zip(rows, each, strict=True):
                        found[k][text] = one
        return found

    def _values(self, x: Floats) -> dict[str, Floats]:
        return self.task.measures(self.task.columns_of(self.task.place(x)))

    def _slopes(self, x: Floats) -> dict[str, Floats]:
        """Gradients (places, k), exact where they can be had."""
        measures = self.task.measures
        if not measures.side_by_side:
            parts = [self._by_differences(each) for each in x]
            return {text: np.array([part[text] for part in parts]) for text in measures.expressions}
        columns = self.task.columns_of(self.task.place(x))
        return {
            text: measures.gradient(text, columns, self.names) * self.span for text in measures.expressions
        }

    def _by_differences(self, x: Floats) -> dict[str, Floats]:
        """Central differences, where no exact gradient is had."""
        k, h = len(x), 1e-5 * np.eye(len(x))
        rows = np.clip(np.concatenate([x + h, x - h]), 0, 1)
        found = self.task.measures(self.task.columns_of(self.task.place(rows)))
        width = np.maximum(np.diagonal(rows[:k] - rows[k:]), 1e-12)
        return {text: (each[:k] - each[k:]) / width for text, each in found.items()}


class _Place:
    """What is known of the last place that a search asked for."""

    def __init__(self, ask: Ask) -> None:
        self.ask, self._known = ask, dict[tuple[bytes, bool], dict[str, Floats]]()

    def values(self, x: Floats) -> dict[str, Floats]:
        """Values by text."""
        return self._at(x, False)

    def slopes(self, x: Floats) -> dict[str, Floats]:
        """Gradients (k,) by text."""
        return self._at(x, True)

    def _at(self, x: Floats, sloped: bool) -> dict[str, Floats]:
        if not any(known == x.tobytes() for known, _ in self._known):
            self._known.clear()
        key = x.tobytes(), sloped
        if key not in self._known:
            self._known[key] = self.ask((x, sloped))
        return self._known[key]
