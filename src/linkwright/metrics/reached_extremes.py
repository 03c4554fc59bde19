"""Extremes and means of what a mechanism does where it reaches a part of its cycle or way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.cached_property import cached_property
from linkwright.cycle.summary import SummaryValue
from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import ROUNDING, Forces
from linkwright.metrics.solved_again import Resolver
from linkwright.metrics.solved_pieces import SolvedStretch

Signal = Callable[[Any], Floats]


class PartlyReached:
    """A motion, its forces if they were solved, and what can be solved again of them where not all is reached."""

    def __init__(self, motion: Motion, forces: Forces | None = None) -> None:
        self.motion = motion
        self.forces = forces
        self.resolver = Resolver(motion, forces)

    @property
    def closed(self) -> bool:
        """Whether the positions are one closed cycle."""
        return self.motion.positions.closed

    @property
    def once(self) -> slice:
        """The positions without the repeated first one at the end of a closed cycle."""
        return slice(0, self.motion.steps - self.motion.positions.repeated)

    @property
    def partial(self) -> bool:
        """Whether the positions are those of the drivers' laws, of which not all are reached."""
        return self.resolver.possible and not self.resolver.whole

    @cached_property
    def ways(self) -> tuple[SolvedStretch, ...]:
        """All stretches that are reached; none where something on them cannot be solved."""
        if not self.resolver.possible or self.motion.steps < 2:
            return ()
        try:
            found = tuple(SolvedStretch(self.resolver, *each) for each in self.resolver.stretches)
            return found if all(each.reached for each in found) else ()
        except LinkwrightError:
            return ()

    def mean(self, values: Floats) -> float:
        """Mean over the time of the cycle, of the positions that are reached."""
        good = np.isfinite(values)
        if self.closed or good.sum() < 2:
            return float(np.nanmean(values[self.once]))
        time, kept = np.abs(self.motion.time[good] - self.motion.time[0]), values[good]
        span = time[-1] - time[0]
        return float(np.trapezoid(kept, time) / span) if span else float(np.mean(kept))

    def extreme_of_part(self, signal: Signal, sign: float, of: str, sample: SummaryValue) -> SummaryValue:
        """The largest (``sign`` 1) or smallest value of a signal, of which one ``sample`` is known; NaN where nothing
        tells it."""
        found = [way.extreme(signal, sign, of) for way in self.ways]
        known = [each for each in found if each is not None]
        if not found or len(known) < len(found):
            return sample
        values = [sign * each.value for each in known]
        best = known[int(np.nanargmax(values))] if not np.isnan(values).all() else known[0]
        unbounded = np.isinf(best.value)
        return best if unbounded or not np.isnan(values).any() else replace(best, value=float("nan"))

    def mean_of_part(self, signal: Signal, of: str, *, square: bool) -> float:
        """The mean of a signal, or of its ``square``, over the time of a way that ends where it is finite, and of one
        that is the same everywhere; NaN of another."""
        solved = [way.at(way.looks, of) for way in self.ways] or [
            self.forces if of == "forces" else self.motion
        ]
        values = np.concatenate([signal(each) for each in solved]) ** (2 if square else 1)
        known = values[np.isfinite(values)]
        if len(known) and np.ptp(known) <= ROUNDING * abs(known[0]):
            return float(known[0])
        if self.closed or not self.ways:
            return float("nan")
        whole = sum(way.integral(signal, of, square=square) for way in self.ways)
        found = whole / sum(way.duration for way in self.ways)
        return float(found) if np.isfinite(found) else float("nan")
