"""A problem as numbers: objectives and violations of designs in the unit cube, also under tolerances."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.designs.demands import Bounds, bounds_of
from linkwright.designs.optimise.measures import Measures
from linkwright.designs.optimise.problem import Problem
from linkwright.errors import Finding, ModelError, QuantityError

#: A number, and 1 where it must not become larger, -1 where it must not become smaller.
Side = tuple[str, float]
#: Samples of the tolerances while searching, where designs go one by one, and at the end.
SAMPLES, SAMPLES_ALONE, CHECKED = 64, 16, 512
#: Other samples that say what share of the machines meets the demands: those that chose a design flatter it.
OTHERS = 8192
#: Most toleranced dimensions all of whose corners are tried.
ALL_CORNERS = 4
#: Places between its bounds at which a variable is tried for an effect; numbers differ by less where it has none.
PROBED, SAME = (0.0, 0.35, 1.0), 1e-9


@dataclass(frozen=True, eq=False)
class Judged:
    """Designs (N, k) with objectives (N, goals) to be made small and violations (N, demands); inf: does not move."""

    x: Floats
    goals: Floats
    violations: Floats
    values: Mapping[str, Floats]

    @property
    def total(self) -> Floats:
        """Sum of violations, (N,)."""
        return np.asarray(self.violations.sum(axis=1))


class Task:
    """Evaluates designs x (N, k), 0 to 1 between the bounds of the variables; ``samples`` of the tolerances each."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.measures = Measures(problem)
        self.samples = SAMPLES if self.measures.side_by_side else SAMPLES_ALONE
        self.wanted = problem.min_yield
        self.low = np.array([each.low for each in problem.variables])
        self.high = np.array([each.high for each in problem.variables])
        self.at_start = {
            text: float(value[0]) for text, value in self.measures(self.columns_of(problem.start[None])).items()
        }
        self.bounds = self._bounds()

    # places ------------------------------------------------------------------------------------------
    def place(self, x: Floats) -> Floats:
        """Values (N, k), SI, of places in the cube; variables with choices take the nearest."""
        span = np.where(self.high > self.low, self.high - self.low, 0.0)
        raw = self.low + np.clip(x, 0.0, 1.0) * span
        return np.column_stack([each.allowed(raw[:, k]) for k, each in enumerate(self.problem.variables)])

    def every(self, most: int) -> Floats | None:
        """Places (N, k) of all designs, where there are no more than ``most``; None where there are."""
        choices = [each.choices for each in self.problem.variables if each.choices is not None]
        if len(choices) < len(self.problem.variables) or math.prod(map(len, choices)) > most:
            return None
        return self.inverse(np.array([*product(*choices)]))

    def inverse(self, values: Floats) -> Floats:
        """Places in the cube of values (k,)."""
        return np.asarray((values - self.low) / np.where(self.high > self.low, self.high - self.low, 1.0))

    def columns_of(self, values: Floats) -> dict[str, Floats]:
        """Columns by address of values (N, k), with the nominal values of dimensions that have only tolerances."""
        columns = {each.address: values[:, k] for k, each in enumerate(self.problem.variables)}
        for address in self.problem.tolerances:
            columns.setdefault(address, np.full(len(values), self.problem.mechanism.dimension(address)))
        return columns

    # judging -----------------------------------------------------------------------------------------
    def judge(self, x: Floats) -> Judged:
        """Objectives and violations of designs."""
        columns = self.columns_of(self.place(x))
        if self.at_corners:
            return self._worst(x, columns)
        if self.problem.robust:
            return self._robust(x, columns, self.samples)
        values = self.measures(columns)
        goals = np.column_stack([goal.sign * values[goal.text] for goal in self.problem.goals])
        return Judged(x, *self._finite(goals, values), values)

    def _finite(self, goals: Floats, values: Mapping[str, Floats]) -> tuple[Floats, Floats]:
        misses = [each.violation(values[each.text]) for each in self.bounds]
        violations = np.column_stack(misses) if misses else np.zeros((len(goals), 1))
        stuck = ~np.isfinite(np.column_stack([goals, *(values[each.text] for each in self.bounds)])).all(axis=1)
        goals, violations = goals.copy(), violations.copy()
        goals[stuck], violations[stuck] = np.inf, np.inf
        return goals, violations

    @property
    def written(self) -> bool:
        """Whether expressions alone judge a design: nothing is solved, and no tolerance is sampled."""
        measures = self.measures
        return not (measures.numbers or measures.passing or self.problem.paths or self.problem.tolerances)

    @property
    def exact(self) -> bool:
        """Whether the last steps follow exact gradients."""
        return self.measures.side_by_side

    @property
    def at_corners(self) -> bool:
        """Whether the worst within the tolerances is looked for where exact slopes say, not among samples."""
        return self.problem.robust == "worst" and self.measures.side_by_side

    @cached_property
    def sides(self) -> tuple[Side, ...]:
        """What must not become larger (1) or smaller (-1): objectives, and numbers that have demands."""
        found = [(goal.text, goal.sign) for goal in self.problem.goals]
        for each in self.bounds:
            ends = ((1.0, each.high), (-1.0, each.low))
            found += [(each.text, sign) for sign, end in ends if np.isfinite(end)]
        return tuple(dict.fromkeys(found))

    def corners(self, columns: Mapping[str, Floats]) -> tuple[dict[str, Floats], Floats]:
        """Columns (N · sides,) of the machines within the tolerances of designs (N,) that are the worst for one side
        after another, and what the side's number comes to there, (N, sides)."""
        away = self._away(columns)
        values, count = self.measures(self._made(columns, away)), len(away)
        numbers = np.stack([sign * values[text].reshape(count, -1) for text, sign in self.sides], axis=1)
        rows = np.where(np.isnan(numbers), np.inf, numbers).argmax(axis=2)
        worst = np.take_along_axis(numbers, rows[:, :, None], axis=2)[:, :, 0]
        own = np.take_along_axis(away, rows[:, :, None], axis=1)
        return self._made(columns, own), worst * np.array([sign for _unused, sign in self.sides])

    def _away(self, columns: Mapping[str, Floats]) -> Floats:
        """Corners of the tolerances, (N, corners, dimensions): all where they are few, else those to which the exact
        slopes of every side point, and those opposite."""
        names = tuple(self.problem.tolerances)
        if len(names) <= ALL_CORNERS:
            every = np.array([*product((-1.0, 1.0), repeat=len(names))])
            return np.tile(every, (len(next(iter(columns.values()))), 1, 1))
        _unused, slopes = self.measures.with_slopes(columns, names)
        found = np.stack([sign * slopes[text] for text, sign in self.sides], axis=1)
        found = np.where(found < 0.0, -1.0, 1.0)
        return np.concatenate([found, -found], axis=1)

    def _made(self, columns: Mapping[str, Floats], away: Floats) -> dict[str, Floats]:
        """Columns (N · corners,) of the machines in corners (N, corners, dimensions) of the tolerances."""
        found = {name: np.repeat(column, away.shape[1]) for name, column in columns.items()}
        for k, (name, tolerance) in enumerate(self.problem.tolerances.items()):
            found[name] = found[name] + tolerance * away[:, :, k].ravel()
        return found

    def _worst(self, x: Floats, columns: Mapping[str, Floats]) -> Judged:
        """Objectives and violations of the worst machines within the tolerances."""
        drawn, (_unused, found) = self.measures(columns), self.corners(columns)
        worst = dict(zip(self.sides, found.T, strict=True))
        goals = np.column_stack([goal.sign * worst[goal.text, goal.sign] for goal in self.problem.goals])
        misses = [np.zeros(len(x))]
        for each in self.bounds:
            both = [each.violation(worst[each.text, sign]) for sign in (1.0, -1.0) if (each.text, sign) in worst]
            misses.append(np.max(both, axis=0))
        stuck = ~np.isfinite([*drawn.values(), *worst.values()]).all(axis=0)
        violations = np.column_stack(misses)
        goals[stuck], violations[stuck] = np.inf, np.inf
        return Judged(x, goals, violations, drawn)

    def _robust(self, x: Floats, columns: Mapping[str, Floats], samples: int) -> Judged:
        """The worst of the samples, or their share that meets all demands."""
        values = self.sampled(columns, samples)
        signs = {goal.text: goal.sign for goal in self.problem.goals}
        worst = {}
        for text, each in values.items():
            sign = signs.get(text, 1.0)
            worst[text] = np.where(np.isnan(each).any(1), np.nan, sign * (sign * each).max(1))
        goals = np.column_stack([goal.sign * worst[goal.text] for goal in self.problem.goals])
        misses = [each.violation(values[each.text]) for each in self.bounds]
        if self.problem.robust == "worst":
            violations = np.column_stack([each.max(1) for each in misses]) if misses else np.zeros((len(x), 1))
        else:
            missed = sum(misses, np.zeros(next(iter(values.values())).shape))
            met = (missed == 0.0) & np.isfinite([*values.values()]).all(axis=0)
            lack = np.maximum(self.wanted - met[:, 1:].mean(axis=1), 0.0)
            violations = np.where(lack > 0.0, lack + missed[:, 1:].mean(axis=1), 0.0)[:, None]
            goals = np.column_stack([goal.sign * values[goal.text][:, 0] for goal in self.problem.goals])
        stuck = ~np.isfinite(goals).all(axis=1) | np.isnan(violations).any(axis=1)
        goals[stuck], violations[stuck] = np.inf, np.inf
        return Judged(x, goals, violations, {text: each[:, 0] for text, each in values.items()})

    def sampled(self, columns: Mapping[str, Floats], samples: int) -> dict[str, Floats]:
        """Values (N, 1 + samples) of the designs as drawn (first) and as made."""
        found = self.measures(self.made(columns, samples))
        return {text: value.reshape(-1, samples + 1) for text, value in found.items()}

    def made(self, columns: Mapping[str, Floats], samples: int) -> dict[str, Floats]:
        """Columns (N · (1 + samples),) of the designs as drawn (first) and as made."""
        none, off = np.zeros(samples + 1), self._deviations(samples)
        return {each: (column[:, None] + off.get(each, none)).ravel() for each, column in columns.items()}

    def _deviations(self, samples: int) -> dict[str, Floats]:
        """The same deviations for all designs: drawn evenly, uniform within ±; for the worst all corners where these
        are no more."""
        if samples not in self._shares:
            from scipy.stats import qmc

            names = list(self.problem.tolerances)
            if self.problem.robust == "worst" and 2 ** len(names) <= samples < CHECKED:
                share = np.array([*product((0.0, 1.0), repeat=len(names))])
                share = np.tile(share, (samples // len(share) + 1, 1))[:samples]
            else:
                draw = np.random.default_rng((self.problem.seed, samples == OTHERS))
                share = qmc.Sobol(len(names), rng=draw).random(samples)
            self._shares[samples] = {
                name: np.concatenate([[0.0], self.problem.tolerances[name] * (2 * share[:, k] - 1)])
                for k, name in enumerate(names)
            }
        return self._shares[samples]

    @cached_property
    def _shares(self) -> dict[int, dict[str, Floats]]:
        return {}

    def worst_of(self, values: Floats) -> dict[str, tuple[float, ...]]:
        """What the numbers of a design (k,) come to at the worst within the tolerances, side after side."""
        _unused, (worst,) = self.corners(self.columns_of(values[None]))
        found = dict[str, tuple[float, ...]]()
        for (text, _unused2), value in zip(self.sides, worst.tolist(), strict=True):
            found[text] = (*found.get(text, ()), value)
        return found

    def without_effect(self, values: Floats) -> tuple[str, ...]:
        """Variables that change no number where each alone moves from a design (k,) over its bounds."""
        count = len(values)
        shares = np.concatenate([[np.nan], np.repeat(PROBED, count)])
        designs = np.tile(values, (len(shares), 1))
        for k in range(count):
            rows = 1 + k + count * np.arange(len(PROBED))
            place = self.low[k] + shares[rows] * (self.high[k] - self.low[k])
            designs[rows, k] = self.problem.variables[k].allowed(place)
        found = np.column_stack(list(self.measures(self.columns_of(designs)).values()))
        same = (np.abs(found[1:] - found[0]) <= SAME * np.abs(found[0])).all(axis=1)
        idle = same.reshape(len(PROBED), count).all(axis=0)
        return tuple(each.address for each, none in zip(self.problem.variables, idle, strict=True) if none)

    def yield_of(self, values: Floats) -> float:
        """Share of many samples of a design (k,) that move and meet all demands."""
        samples = OTHERS if self.measures.side_by_side else CHECKED
        found = self.sampled(self.columns_of(values[None]), samples)
        met = np.ones(samples + 1, bool)
        for text, each in found.items():
            met &= np.isfinite(each[0])
            for bounds in self.bounds:
                if bounds.text == text:
                    met &= bounds.violation(each[0]) == 0.0
        return float(met[1:].mean())

    # demands -----------------------------------------------------------------------------------------
    def _bounds(self) -> tuple[Bounds, ...]:
        findings: list[Finding] = []
        found = []
        for demand in self.problem.demands:
            try:
                text = demand.text
                found.append(bounds_of(demand, self.measures.dimension(text), self.at_start[text]))
            except QuantityError as error:
                place = self.problem.mechanism.name
                key = f"optimize.keep.{demand.text}"
                findings.append(Finding("error", place, key, error.sentence, code=error.code))
        if findings:
            raise ModelError(findings)
        return tuple(found)
