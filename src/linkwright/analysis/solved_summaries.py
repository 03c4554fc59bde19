"""Summaries of a signal that is solved again on the ways that a motion reaches, or of its positions alone."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from linkwright.analysis.reachable_intervals import SIDE, Signal, SignalsOnWays, Ways
from linkwright.applied_loads.signals import Limit
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import Output
from linkwright.core.search import first_largest
from linkwright.curves.pieces import LOW, Pieces
from linkwright.cycle.summaries import EVEN, Asked, Extremes, StrokeSummary, Summaries, Summary, SummaryValue
from linkwright.cycle.summaries import Signal as Named
from linkwright.kinematics.motion import Motion

#: An output with its limit positions.
Reversals = tuple[Output, Sequence[Limit]]
#: To this share of a signal's size polynomials meet what is smooth at a change point.
PASSED = 1e-8


class SolvedSummary(Summaries):
    """One summary of a signal of the motion, or of the forces, on ways; ``reversals``: of the output on whose strokes
    it is asked for."""

    def __init__(
        self, ways: Ways, part: Summary, signal: Signal, of: str, reversals: Reversals | None = None
    ) -> None:
        squared = part.kind == "rms"
        strokes = {"": (reversals[0], part.way)} if reversals and isinstance(part, StrokeSummary) else {}
        self.asked = Asked({"": part}, {"": Named("", squared)}, {}, strokes)
        self._ways, self.limits = ways, {}
        self._reversals = sorted(reversals[1], key=lambda each: each.time) if reversals else []

        def read(solved: object) -> Floats:
            values = np.asarray(signal(solved), dtype=float)
            return np.atleast_2d(values * values if squared else values)

        more = np.array([each.time for each in self._reversals])
        self._signals = SignalsOnWays.resolved(ways, read, of, self.asked.wanted(), more, paced=self.asked.even)
        self.span = self._signals.stretches.span

    @property
    def pieces(self) -> Pieces:
        return self._signals.pieces

    @property
    def passed(self) -> Flags:
        return self.pieces.passed

    @property
    def speed(self) -> Floats:
        course = self._ways.course
        rate = course.first.law.coordinate(np.array([course.begin]))[1]
        return np.full(self.span.count, rate[0])

    @property
    def begins(self) -> Floats:
        return self.inside(super().begins)

    def inside(self, time: Floats, design: Indices | slice = slice(None)) -> Floats:
        return self._ways.time(time, np.arange(self.span.count)[design])

    def input_at(self, time: Floats) -> Floats:
        return np.array([self._ways.resolver.input_at(float(each)) for each in time])

    def _on_stroke(self, output: Output, way: str) -> Flags:
        middle = self.pieces.columns[LOW] + 0.5 * self.pieces.width
        before = np.searchsorted([each.time for each in self._reversals], middle, "right") - 1
        grows = np.array([each.kind == "min" for each in self._reversals])
        return np.asarray(grows[before] == (way == "rising"))

    @cached_property
    def means(self) -> dict[int, Floats]:
        """Infinite, or undefined where a signal grows to both signs, next to what it cannot pass."""
        found = super().means
        for way in range(self.span.count):
            steep = [each.limit for each in self._signals.ends if each.way == way and not np.isfinite(each.limit)]
            if any(map(np.isinf, steep)) or (steep and not self._ways.complete):
                for mean in found.values():
                    mean[way] = np.sum(steep)
        return found

    @cached_property
    def extremes(self) -> Extremes:
        """Infinite, or NaN where they are undetermined, next to what the signal cannot pass."""
        found = super().extremes
        for n, (_, sign, _) in enumerate(self.asked.sides):
            for way in range(self.span.count):
                ends = [each for each in self._signals.ends if each.way == way]
                steep = [each for each in ends if each.limit == sign * np.inf]
                most, piece = sign * found.value[n, way], found.piece[n, way]
                around = [each.nearby_values for each in ends if np.isnan(each.limit)]
                if steep:
                    found.value[n, way], found.time[n, way] = steep[0].limit, steep[0].time
                elif not self._ways.complete and around:
                    if self.pieces.columns[SIDE][piece] or (sign * np.concatenate(around) > most).any():
                        found.value[n, way] = np.nan
                elif len(self._ways.resolver.changes) and abs(most) <= PASSED * self.pieces.size[0, way]:
                    found.value[n, way] = 0.0
        return found

    def found(self) -> SummaryValue:
        """That of all ways."""
        kind, value = self.asked.parts[""].kind, self.values[""]
        if kind in EVEN:
            return SummaryValue(self._mean(kind, value), np.nan, np.nan, self._ways.complete)
        sides, time = self.extremes.value[[*self.asked.sides_of[""]]], self.time_of("")
        sizes = value if len(sides) > 1 else sides[0] * self.asked.sides[0][1]
        best = int(np.nanargmax(sizes)) if not np.isnan(sizes).all() else 0
        exact = bool(np.isinf(sizes[best]) or not np.isnan(sizes).any())
        place = self.input_at(time[[best]])[0] if np.isfinite(time[best]) else np.nan
        return SummaryValue(float(value[best]) if exact else np.nan, float(time[best]), float(place), exact)

    def _mean(self, kind: str, value: Floats) -> float:
        if self._ways.complete:
            return float(value[0])
        power, share = 2 if kind == "rms" else 1, self._ways.durations / self._ways.durations.sum()
        found = float((value**power @ share) ** (1.0 / power))
        return found if np.isfinite(found) else np.nan


def of_positions(motion: Motion, values: Floats, kind: str) -> SummaryValue:
    """The same of what is known at positions (n,) alone; NaN where there is nothing."""
    if kind == "excess" or not np.isfinite(values).any():
        return SummaryValue(np.nan, np.nan, np.nan, False)
    if kind in ("mean", "rms"):
        return SummaryValue(_mean(motion, values, 2 if kind == "rms" else 1), np.nan, np.nan, False)
    high, low = first_largest(values), first_largest(-values)
    if kind == "range":
        return SummaryValue(float(values[high] - values[low]), np.nan, np.nan, False)
    index = low if kind.endswith("min") else high
    if kind == "peak":
        index = first_largest(np.abs(values))
    at = float(motion.input[index]) if motion.inputs else np.nan
    value = at if kind.startswith("arg") else abs(values[index]) if kind == "peak" else values[index]
    return SummaryValue(float(value), float(motion.time[index]), at, False)


def _mean(motion: Motion, values: Floats, power: int) -> float:
    """Over the time of the cycle, of the positions that are reached."""
    values, time = values**power, motion.time
    good = np.isfinite(values)
    if motion.positions.closed or good.sum() < 2:
        found = float(np.nanmean(values[: motion.steps - motion.positions.repeated]))
    else:
        time, values_there = np.abs(time[good] - time[0]), values[good]
        span = time[-1] - time[0]
        found = float(np.trapezoid(values_there, time) / span) if span else float(np.mean(values_there))
    return float(found ** (1.0 / power))
