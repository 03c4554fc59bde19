"""Metrics from many solved positions alone: each extreme between bounds, each mean with its slack.

A smooth extreme is the top of the parabola through three samples; where a signal jumps or bends, its extreme
is a sample or beyond it by what the smooth side changes within one step. The differences of neighbouring steps say
which of the two it is, and how far either may be off.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
#: Neighbours that bounds look at.
REACH = 4
#: A signal is smooth around a sample where its steps change by less than this share of its curvature.
SMOOTH = 0.1
#: Weights of the trapezoid rule at the ends of an open course (Gregory), to the fourth order.
GREGORY = np.array([3 / 8, 7 / 6, 23 / 24])


class Bounded(NamedTuple):
    """A number that is right to ``slack``."""

    value: float
    slack: float


def extended(samples: Array, closed: bool) -> Array:
    """Samples with some more on either side: those of the next turn, or the odd continuation."""
    if closed:
        return np.pad(samples, REACH, mode="wrap")
    return np.pad(samples, REACH, mode="reflect", reflect_type="odd")


def unevenness(steps: Array) -> Array:
    """How far each step is from the mean of its neighbours; the first and the last are left out."""
    return np.asarray(np.abs(steps[1:-1] - 0.5 * (steps[:-2] + steps[2:])))


def maximum(samples: Array, closed: bool) -> Bounded:
    """The largest value of the course between its samples."""
    low, high = _bounds(samples, closed)
    return Bounded(0.5 * (low + high), 0.5 * (high - low))


def _bounds(samples: Array, closed: bool) -> tuple[float, float]:
    g = extended(samples, closed)
    steps = np.diff(g)
    size, uneven = np.abs(steps), unevenness(steps)
    at = np.arange(len(samples)) + REACH
    a, b, c = g[at - 1], g[at], g[at + 1]
    curvature = 2 * b - a - c
    # unevenness [k] belongs to the step from sample k + 1
    worst = np.max([uneven[at + shift] for shift in (-3, -2, -1, 0)], axis=0)
    before, after = np.maximum(size[at - 1], size[at - 2]), np.maximum(size[at], size[at + 1])
    smooth = (worst <= SMOOTH * curvature) & (curvature > 0)
    top = b + (a - c) ** 2 / (8 * np.where(smooth, curvature, np.inf))
    low = np.where(smooth, top - worst, b)
    high = np.where(smooth, top + worst, b + 1.5 * np.minimum(before, after))
    peaks = (b >= a) & (b >= c)
    ends = np.empty((2, 0)) if closed else np.array([_end(samples), _end(samples[::-1])]).T
    tops = low[peaks].max(initial=-np.inf), high[peaks].max(initial=-np.inf)
    return max((tops[0], *ends[0])), max((tops[1], *ends[1]))


def _end(samples: Array) -> tuple[float, float]:
    """Bounds of the value at the first sample of an open course: where it jumps from the next one, it may be there
    for that instant alone, as of a load that acts from rest on."""
    first, following = samples[0], np.abs(np.diff(samples[: REACH + 1]))
    return (min(first, samples[1]) if following[0] > REACH * following[1:].max() else first), first


def minimum(samples: Array, closed: bool) -> Bounded:
    """The smallest value."""
    value, slack = maximum(-samples, closed)
    return Bounded(-value, slack)


def peak(samples: Array, closed: bool) -> Bounded:
    """The largest size."""
    high, low = maximum(samples, closed), maximum(-samples, closed)
    return max(high, low, key=lambda each: each.value)


def extent(samples: Array, closed: bool) -> Bounded:
    """The largest less the smallest value."""
    high, low = maximum(samples, closed), minimum(samples, closed)
    return Bounded(high.value - low.value, high.slack + low.slack)


def place_of_maximum(samples: Array) -> Bounded:
    """The share of a closed course at which its largest value is; NaN where it is there more than once."""
    g, count = extended(samples, True), len(samples)
    k = int(np.argmax(samples))
    a, b, c = g[k + REACH - 1 : k + REACH + 2]
    curvature = 2 * b - a - c
    others = np.abs((np.arange(count) - k + count / 2) % count - count / 2) > count / 100
    scale = float(np.ptp(samples))
    if curvature <= 1e-10 * scale or samples[others].max() > b - 1e-6 * scale:
        return Bounded(np.nan, 0.0)
    uneven = unevenness(np.diff(g))[k + REACH - 3 : k + REACH + 1].max() + 1e-14 * scale
    shift = 0.5 * (c - a) / curvature
    return Bounded((k + shift) / count, min(1.0, uneven / curvature) / count)


def mean(samples: Array, closed: bool) -> Bounded:
    """The mean over time, of positions at equal intervals."""
    weights = np.ones(len(samples))
    if not closed:
        weights[: len(GREGORY)], weights[-len(GREGORY) :] = GREGORY, GREGORY[::-1]
    slack = 0.5 * unevenness(np.diff(extended(samples, closed))).sum() / len(samples)
    return Bounded(float(weights @ samples / weights.sum()), float(slack))


def rms(samples: Array, closed: bool) -> Bounded:
    """The root mean square."""
    square = mean(samples**2, closed)
    value = float(np.sqrt(max(square.value, 0.0)))
    return Bounded(value, min(square.slack / value, np.sqrt(square.slack)) if value else 0.0)


def excess(samples: Array) -> Bounded:
    """Largest rise of the integral of the mean less a signal over a closed course, in parts of its length."""
    count, average = len(samples), mean(samples, True)
    g = extended(average.value - samples, True)
    at = np.arange(count) + REACH
    gained = (13 * (g[at] + g[at + 1]) - g[at - 1] - g[at + 2]) / (24 * count)
    energy = np.concatenate([[0.0], np.cumsum(gained)[:-1]])
    found = extent(energy, True)
    return Bounded(found.value, found.slack + 2.0 * average.slack)


def hull_area(places: Array) -> float:
    """Area of the convex hull of points (n, 2)."""
    size = float(np.ptp(places, axis=0).max())
    if not size:
        return 0.0
    ordered = np.unique(np.round(places / size, 13), axis=0) * size  # one of those equal but for rounding
    sides = [_chain(ordered), _chain(ordered[::-1])]
    x, y = np.array(sides[0][:-1] + sides[1][:-1]).T
    return float(0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def _chain(ordered: Array) -> list[Any]:
    chain: list[Any] = []
    for p in ordered.tolist():
        while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 0:
            chain.pop()
        chain.append(p)
    return chain


def _turn(a: list[float], b: list[float], c: list[float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
