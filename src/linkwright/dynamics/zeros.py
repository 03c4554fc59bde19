"""All zeros of a function over a range from its values and exact slopes: crossings, touchings, jumps, flat parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from linkwright.core.arrays import Flags, Floats, runs

#: A value and its slope (2, n) at places (n,).
Function = Callable[[Floats], Floats]
#: How a function passes zero: from below, from above, without passing, or zero over a part of the range.
Kind = Literal["rising", "falling", "touching", "flat"]
#: Shares of the function's scale: where it is flat, where a jump is meant and no crossing, where it touches.
FLAT, JUMP, TOUCH = 1e-9, 1e-6, 1e-11
#: How far a cubic between two places may miss the function, as share of the larger value there, and how often the
#: places between are halved for it.
MISS, ROUNDS = 0.01, 8
#: Places of Gauss's rule in one step.
GAUSS = np.polynomial.legendre.leggauss(5)


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """The zero between two places at which a function has values of opposite sign, to rounding."""
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=1e-15, rtol=1e-15))


@dataclass(frozen=True)
class Zero:
    """A zero at ``place``; of a ``flat`` part ``low`` to ``high``. ``jump``: the function changes sign there without
    being zero."""

    place: float
    kind: Kind
    jump: bool = False
    low: float = float("nan")
    high: float = float("nan")


class Sampled:
    """A function over places that lie so near to each other that cubics between them follow it.

    ``scale``: the size of what adds up to the function. Where it is not finite there is nothing.
    """

    def __init__(self, function: Function, places: Floats, scale: float) -> None:
        self.function, self.scale = function, scale
        self.places, self.values, self.slopes = self._followed(places)

    def _followed(self, places: Floats) -> tuple[Floats, Floats, Floats]:
        q, (value, slope) = places, self.function(places)
        low, high = np.arange(len(q) - 1), np.arange(1, len(q))
        for _round in range(ROUNDS):
            step = q[high] - q[low]
            middle = 0.5 * (q[low] + q[high])
            expected = 0.5 * (value[low] + value[high]) + 0.125 * step * (slope[low] - slope[high])
            found, found_slope = self.function(middle)
            size = np.maximum(np.abs([value[low], value[high], found]).max(axis=0), TOUCH * self.scale)
            with np.errstate(invalid="ignore"):
                missed = np.abs(found - expected) > MISS * size
            added = len(q) + np.arange(len(middle))
            q, value = np.concatenate([q, middle]), np.concatenate([value, found])
            slope = np.concatenate([slope, found_slope])
            if not missed.any():
                break
            halves = added[missed]
            low, high = np.concatenate([low[missed], halves]), np.concatenate([halves, high[missed]])
        order = np.argsort(q)
        return q[order], value[order], slope[order]

    @cached_property
    def zeros(self) -> list[Zero]:
        """All zeros by place."""
        q, value, flat = self.places, self.values, self._flat
        found = [self._part(begin, end) for begin, end in runs(flat)]
        isolated = ~(np.append(False, flat[:-1]) | flat | np.append(flat[1:], False))
        found += [self._crossing(place, place) for place in q[(value == 0.0) & isolated]]
        for i in range(len(q) - 1):
            if flat[i] or flat[i + 1] or not np.isfinite(value[i : i + 2]).all():
                continue
            if value[i] * value[i + 1] < 0.0:
                found.append(self._crossing(q[i], q[i + 1]))
            elif value[i] * value[i + 1] > 0.0:
                found += self._hidden(i)
        return sorted(found, key=lambda each: each.place)

    @property
    def _flat(self) -> Flags:
        """Places in parts where the function is zero but for rounding."""
        small = np.abs(self.values) <= FLAT * self.scale
        for begin, end in runs(small):
            if end - begin < 2:
                small[begin : end + 1] = False
        return small

    def _part(self, begin: int, end: int) -> Zero:
        low, high = (float(self.places[each]) for each in (begin, end))
        return Zero(0.5 * (low + high), "flat", low=low, high=high)

    def _hidden(self, i: int) -> list[Zero]:
        """Two crossings, or one touching, between places of equal sign: about an extreme towards zero."""
        (low, high), side = self.places[i : i + 2], np.sign(self.values[i])
        if side * self.slopes[i] >= 0.0 or side * self.slopes[i + 1] <= 0.0:
            return []
        extreme = root(lambda x: self._at(x)[1], low, high)
        value = self._at(extreme)[0]
        if abs(value) <= TOUCH * self.scale:
            return [Zero(extreme, "touching")]
        return [self._crossing(low, extreme), self._crossing(extreme, high)] if side * value < 0.0 else []

    def _crossing(self, low: float, high: float) -> Zero:
        place = float(low if low == high else root(lambda x: self._at(x)[0], low, high))
        near = max(1e-7 * abs(self.places[-1] - self.places[0]), 2.0 * (high - low) if high - low < 1e-9 else 0.0)
        before, behind = self._at(place - near)[0], self._at(place + near)[0]
        jump = abs(self._at(place)[0]) > JUMP * self.scale
        if before * behind >= 0.0 and not jump:
            return Zero(place, "touching")
        return Zero(place, "rising" if behind > before else "falling", jump)

    def value(self, place: float) -> float:
        """The function there."""
        return self._at(place)[0]

    def extreme_near(self, index: int) -> float:
        """The place of the extreme next to one of the places that is larger, or smaller, than its neighbours."""
        q, slope = self.places, self.slopes
        for low, high in ((index - 1, index), (index, index + 1)):
            if low >= 0 and high < len(q) and slope[low] * slope[high] < 0.0:
                return root(lambda x: self._at(x)[1], q[low], q[high])
        return float(q[index])

    def _at(self, place: float) -> tuple[float, float]:
        value, slope = self.function(np.array([place]))[:, 0]
        return float(value), float(slope)

    def integral(self, low: float, high: float) -> float:
        """Integral of the function from one place to another."""
        inside = self.places[(self.places > low) & (self.places < high)]
        edges = np.concatenate([[low], inside, [high]])
        nodes, weights = GAUSS
        half = 0.5 * np.diff(edges)
        places = 0.5 * (edges[:-1] + edges[1:])[:, None] + half[:, None] * nodes
        values = self.function(places.ravel())[0].reshape(places.shape)
        return float((values @ weights) @ half)
