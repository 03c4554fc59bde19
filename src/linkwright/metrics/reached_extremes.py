"""Extremes and means of what a mechanism does where it reaches a part of its cycle or way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.search import first_largest, peaks
from linkwright.kinetostatics.forces import ROUNDING

if TYPE_CHECKING:
    from linkwright.metrics.analysis import Analysis, Extreme

#: Samples that may hold an extreme at most.
MOST = 4

Signal = Callable[[Any], Floats]


def extreme_of_part(analysis: Analysis, signal: Signal, sign: float, of: str, sample: Extreme) -> Extreme:
    """The largest (``sign`` 1) or smallest value of a signal, of which one ``sample`` is known; NaN where nothing
    tells it."""
    ends, resolver = analysis.ends, analysis.resolver
    times, values = _samples(analysis, signal, of)
    index = first_largest(sign * values)
    if sign * values[index] > sign * sample.value or analysis.ways.known:
        time = float(times[index])
        sample = replace(sample, value=float(values[index]), time=time, input=resolver.input_at(time))
    for end, value in zip(ends.times, ends.limits(signal, of), strict=True):
        if sign * value > sign * sample.value:
            sample = replace(sample, value=value, time=end, input=resolver.input_at(end), exact=True)
    if np.isinf(sample.value):
        return sample
    near = peaks(sign * values, False)[:MOST]
    low, high = ends.without(times[np.maximum(near - 1, 0)], times[np.minimum(near + 1, len(times) - 1)])
    best = analysis.narrowed(lambda t: sign * signal(resolver.at(t, of)), low, high, sign, sample)
    told = ends.tell(lambda solved: sign * signal(solved), of, sign * best.value, best.time)
    return best if told else replace(best, value=float("nan"))


def _samples(analysis: Analysis, signal: Signal, of: str) -> tuple[Floats, Floats]:
    """Times, s, with a signal there; on the ways where these are known, NaN next to their ends."""
    if not analysis.ways.known:
        solved = analysis.forces if of == "forces" else analysis.motion
        return analysis.motion.time, signal(solved)
    times, values = map(np.concatenate, zip(*analysis.ways.read(signal, of), strict=True))
    far = analysis.ends.far(times)
    known = np.where(far, values, np.nan)
    return times, known if np.isfinite(known).any() else values


def mean_of_part(analysis: Analysis, signal: Signal, of: str) -> float:
    """The mean of a signal over the time of a way that ends where it is finite, and of one that is the same
    everywhere; NaN of another."""
    _, values = _samples(analysis, signal, of)
    known = values[np.isfinite(values)]
    if len(known) and np.ptp(known) <= ROUNDING * abs(known[0]):
        return float(known[0])
    if analysis.closed or not np.isfinite(analysis.ends.limits(signal, of)).all():
        return float("nan")
    return analysis.ways.mean(signal, of) if analysis.ways.known else analysis.mean(values)
