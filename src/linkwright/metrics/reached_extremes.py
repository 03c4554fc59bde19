"""Extremes and means of what a mechanism does where it reaches a part of its cycle or way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.cached_property import cached_property
from linkwright.core.search import first_largest, lowest, peaks
from linkwright.cycle.summary import Extreme
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import ROUNDING, Forces
from linkwright.metrics.range_ends import RangeEnds
from linkwright.metrics.reached_ways import Ways
from linkwright.metrics.solved_again import Resolver

#: Samples that may hold an extreme at most.
MOST = 4

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
    def ways(self) -> Ways:
        """The motion on all stretches that are reached."""
        return Ways(self.motion, self.resolver)

    @cached_property
    def ends(self) -> RangeEnds:
        """The ends of what is reached."""
        return RangeEnds(self.motion, self.resolver)

    def mean(self, values: Floats) -> float:
        """Mean over the time of the cycle, of the positions that are reached."""
        good = np.isfinite(values)
        if self.closed or good.sum() < 2:
            return float(np.nanmean(values[self.once]))
        time, kept = np.abs(self.motion.time[good] - self.motion.time[0]), values[good]
        span = time[-1] - time[0]
        return float(np.trapezoid(kept, time) / span) if span else float(np.mean(kept))

    def narrowed(
        self, signal: Callable[[Floats], Floats], low: Floats, high: Floats, sign: float, first: Extreme
    ) -> Extreme:
        """The best of some brackets of a signal, of which ``sign`` makes the largest the extreme, and a sample."""
        places, least = lowest(lambda time: -signal(time.ravel()).reshape(time.shape), low, high)
        best = first_largest(-least)
        if not -least[best] > sign * first.value:
            return Extreme(first.value, first.time, first.input, True)
        time = float(places[best])
        return Extreme(-sign * float(least[best]), time, self.resolver.input_at(time), True)

    def extreme_of_part(self, signal: Signal, sign: float, of: str, sample: Extreme) -> Extreme:
        """The largest (``sign`` 1) or smallest value of a signal, of which one ``sample`` is known; NaN where nothing
        tells it."""
        ends, resolver = self.ends, self.resolver
        times, values = self._samples(signal, of)
        index = first_largest(sign * values)
        if sign * values[index] > sign * sample.value or self.ways.known:
            time = float(times[index])
            sample = replace(sample, value=float(values[index]), time=time, input=resolver.input_at(time))
        for end, value in zip(ends.times, ends.limits(signal, of), strict=True):
            if sign * value > sign * sample.value:
                sample = replace(sample, value=value, time=end, input=resolver.input_at(end), exact=True)
        if np.isinf(sample.value):
            return sample
        near = peaks(sign * values, False)[:MOST]
        low, high = ends.without(times[np.maximum(near - 1, 0)], times[np.minimum(near + 1, len(times) - 1)])
        best = self.narrowed(lambda t: sign * signal(resolver.at(t, of)), low, high, sign, sample)
        told = ends.tell(lambda solved: sign * signal(solved), of, sign * best.value, best.time)
        return best if told else replace(best, value=float("nan"))

    def _samples(self, signal: Signal, of: str) -> tuple[Floats, Floats]:
        """Times, s, with a signal there; on the ways where these are known, NaN next to their ends."""
        if not self.ways.known:
            solved = self.forces if of == "forces" else self.motion
            return self.motion.time, signal(solved)
        times, values = map(np.concatenate, zip(*self.ways.read(signal, of), strict=True))
        far = self.ends.far(times)
        known = np.where(far, values, np.nan)
        return times, known if np.isfinite(known).any() else values

    def mean_of_part(self, signal: Signal, of: str) -> float:
        """The mean of a signal over the time of a way that ends where it is finite, and of one that is the same
        everywhere; NaN of another."""
        _, values = self._samples(signal, of)
        known = values[np.isfinite(values)]
        if len(known) and np.ptp(known) <= ROUNDING * abs(known[0]):
            return float(known[0])
        if self.closed or not np.isfinite(self.ends.limits(signal, of)).all():
            return float("nan")
        return self.ways.mean(signal, of) if self.ways.known else self.mean(values)
