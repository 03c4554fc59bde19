"""Spread of curves over the cycle among many machines, in fixed memory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats, Integers
from linkwright.designs.designs import sweep_curves
from linkwright.mechanism.mechanism import Mechanism

#: Bins per position in which machines are counted, and how far they reach, in linear standard deviations; values
#: beyond count in the last bins.
BINS, REACH = 2048, 8.0


@dataclass(frozen=True)
class CurveSpread:
    """A curve among machines, (n,) each, SI: mean, standard deviation, minimum and maximum, and the values that
    0.135 % and 99.865 % of the machines stay below (±3σ of a normal distribution), within 1/128 of the linear σ."""

    mean: Floats
    deviation: Floats
    minimum: Floats
    maximum: Floats
    low: Floats
    high: Floats
    machines: int

    def moved(self, shift: Floats) -> CurveSpread:
        """The same about other values."""
        places = (self.mean + shift, self.minimum + shift, self.maximum + shift, self.low + shift, self.high + shift)
        mean, minimum, maximum, low, high = places
        return CurveSpread(mean, self.deviation, minimum, maximum, low, high, self.machines)


class Counted:
    """Machines' values of one curve, counted: sums, extremes and bins per position."""

    def __init__(self, middle: Floats, sigma: Floats) -> None:
        self.middle = middle
        self.width = np.where(sigma > 0.0, sigma, np.abs(middle) + 1.0) * (2.0 * REACH / BINS)
        self.count = 0
        self.sums = np.zeros((2, len(middle)))
        self.minimum, self.maximum = np.full(len(middle), np.inf), np.full(len(middle), -np.inf)
        self.bins: Integers = np.zeros((len(middle), BINS), dtype=np.int64)

    def add(self, values: Floats) -> None:
        """Counts curves of more machines, (machines, n)."""
        away = values - self.middle
        self.count += len(values)
        self.sums += away.sum(axis=0), (away * away).sum(axis=0)
        self.minimum, self.maximum = (
            np.minimum(self.minimum, values.min(axis=0)),
            np.maximum(self.maximum, values.max(axis=0)),
        )
        place = np.clip(away / self.width + BINS / 2, 0, BINS - 1).astype(np.int64)
        place += BINS * np.arange(len(self.middle))
        self.bins += np.bincount(place.ravel(), minlength=self.bins.size).reshape(self.bins.shape)

    def spread(self, shares: tuple[float, float]) -> CurveSpread:
        """What the machines counted so far show."""
        mean = self.sums[0] / self.count
        variance = np.maximum(self.sums[1] - self.count * mean * mean, 0.0) / max(self.count - 1, 1)
        low, high = (self._quantile(share) for share in shares)
        return CurveSpread(self.middle + mean, np.sqrt(variance), self.minimum, self.maximum, low, high, self.count)

    def _quantile(self, share: float) -> Floats:
        """The value that a share of the machines stays below, even within each bin, (n,)."""
        below = np.cumsum(self.bins, axis=1)
        wanted, rows = share * self.count, np.arange(len(self.middle))
        place = (below < wanted).sum(axis=1).clip(0, BINS - 1)
        before = below[rows, place] - self.bins[rows, place]
        part = (wanted - before) / np.maximum(self.bins[rows, place], 1)
        found = self.middle + (place + part - BINS / 2) * self.width
        return np.asarray(np.clip(found, self.minimum, self.maximum))


def curve_spreads(
    mechanism: Mechanism,
    drawn: Mapping[str, Floats],
    expected: Mapping[str, tuple[Floats, Floats]],
    steps: int,
    shares: tuple[float, float],
) -> dict[str, CurveSpread]:
    """Curves of all machines ``drawn`` that pass the cycle; ``expected``: their nominal values and linear σ (n,)."""
    counted = {name: Counted(middle, sigma) for name, (middle, sigma) in expected.items()}
    names: Sequence[str] = tuple(expected)
    for _, values in sweep_curves(mechanism, drawn, outputs=names, steps=steps):
        for name, curves in values.items():
            passed = np.isfinite(curves).all(axis=1)
            if passed.any():
                counted[name].add(curves[passed])
    return {name: each.spread(shares) for name, each in counted.items() if each.count}
