"""Smallest and largest values of a function over a range, proved by a bound of its rate.

A function that changes by at most L per unit of its argument lies, over an interval of half width h, within L h of
its value in the middle. Intervals that could hold a new extreme are halved until none is left. A dyad of the lengths
b and r can be assembled over a range just where the distance of its ends stays between |b - r| and b + r; its angle,
cos μ = (b² + r² - D²)/(2 b r), is then worst at an extreme of the distance D.
Source: Piyavskii 1972, USSR Comp. Math. Math. Phys. 12.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from linkwright.core.arrays import Floats

#: Intervals at first, and evaluations after which a range is abandoned.
FIRST, MOST = 256, 400_000
#: What is shown of a distance, in units of the dyad's lengths.
WITHIN = 1e-7


def extremes(
    function: Callable[[Floats], Floats], rate: float, low: float, high: float, within: float
) -> tuple[float, float] | None:
    """Smallest and largest value over [low, high], no value beyond them by more than ``within``; None: not proved.

    ``rate``: a bound of the function's derivative; ``function`` takes and gives (n,).
    """
    edges = np.linspace(low, high, FIRST + 1)
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * (high - low) / FIRST
    ends = function(np.array([low, high]))
    smallest, largest, count = float(ends.min()), float(ends.max()), 0
    while len(middle):
        value = function(middle)
        count += len(value)
        if not np.isfinite(value).all() or count > MOST:
            return None
        smallest, largest = min(smallest, float(value.min())), max(largest, float(value.max()))
        open_ = (value - rate * half < smallest - within) | (value + rate * half > largest + within)
        half = 0.5 * half
        middle = np.concatenate([middle[open_] - half, middle[open_] + half])
    return smallest, largest


def minimum_sine(
    distance: Callable[[Floats], Floats], rate: float, lengths: tuple[float, float], low: float, high: float
) -> float:
    """Minimum sine of a dyad's angle over a range of the input; 0 where it is not shown to be assembled everywhere.

    ``distance``: of its two ends (m) at inputs (n,), which changes by at most ``rate``; ``lengths``: b and r.
    """
    b, r = lengths
    within = WITHIN * (b + r)
    found = extremes(distance, rate, low, high, within)
    if found is None or found[0] - within <= abs(b - r) or found[1] + within >= b + r:
        return 0.0
    cosines = [(b * b + r * r - each * each) / (2 * b * r) for each in found]
    return min(math.sqrt(max(0.0, 1 - each * each)) for each in cosines)
