"""What signals do towards the ends of what a mechanism reaches of its cycle or way."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.kinematics.motion import Motion
from linkwright.metrics.one_sided_limits import SLOWED, STEEPEST, limit, towards
from linkwright.metrics.solved_again import Resolver


class RangeEnds:
    """The ends of what is reached, and the limits of signals there."""

    def __init__(self, motion: Motion, resolver: Resolver) -> None:
        self._motion, self._resolver = motion, resolver
        self._edges = resolver.edges if resolver.possible else ()
        self._solved: dict[tuple[str, float], Any] = {}

    @property
    def times(self) -> tuple[float, ...]:
        """Where they are, s."""
        return tuple(time for time, _ in self._edges)

    def limits(self, signal: Callable[[Any], Floats], of: str) -> list[float]:
        """Limits of a signal, which takes Motion or Forces (``of="forces"``) and gives (n,); NaN where not known."""
        found = [float("nan")] * len(self._edges)
        for slowed in SLOWED:
            if np.isnan(found).any():
                places = self._near(slowed)
                if (of, slowed) not in self._solved:
                    self._solved[of, slowed] = self._resolver.at(places.ravel(), of)
                rows = np.reshape(signal(self._solved[of, slowed]), places.shape)
                found = [
                    limit(row, STEEPEST) if np.isnan(old) else old
                    for old, row in zip(found, rows, strict=True)
                ]
        return found

    def tell(self, signal: Callable[[Any], Floats], of: str, value: float, time: float) -> bool:
        """Whether a value at a time, s, is the largest of a signal: it is neither among those from which a limit was
        not found, nor less than one of them."""
        unknown = np.isnan(self.limits(signal, of))
        if not unknown.any():
            return True
        ends, places = np.array(self.times), self._near(SLOWED[0])
        among = np.abs(time + self._laps - ends).min(axis=0) < np.abs(places[:, -1] - ends)
        beside = np.reshape(signal(self._solved[of, SLOWED[0]]), places.shape)
        return not (unknown & (among | ~(beside <= value).all(axis=1))).any()

    def without(self, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        """Stretches (k,) of time, s, without what is nearer to an end than all places from which limits are found:
        there the digits of what does not grow are those of what does."""
        low, high = low.copy(), high.copy()
        for sense, nearest in self._nearest():
            for place in (nearest + self._laps).ravel():
                bound = high if sense < 0 else low
                bound[(low < place) & (high > place)] = place
        return low, high

    def far(self, time: Floats) -> Flags:
        """Which times (n,), s, are not so near to an end."""
        found = np.ones(len(time), dtype=np.bool_)
        for (end, sense), (_, nearest) in zip(self._edges, self._nearest(), strict=True):
            way = sense * (time + self._laps - end)
            found &= ~((way >= 0.0) & (way < sense * (nearest - end))).any(axis=0)
        return found

    def _nearest(self) -> list[tuple[int, float]]:
        """Senses of the ends, with the nearest of those places, s."""
        near = self._near(SLOWED[0])[:, 0].tolist() if self._edges else []
        return [(sense, place) for (_, sense), place in zip(self._edges, near, strict=True)]

    @property
    def _laps(self) -> Floats:
        """A turn of a closed cycle back, none and one ahead, (3, 1) s."""
        return np.array([[-1.0], [0.0], [1.0]]) * (self._motion.positions.period or 0.0)

    def _near(self, slowed: float) -> Floats:
        """Times, s, near each end at which positions are reached, the nearest first, (ends, k); see ``towards``."""
        time, period = self._motion.time, self._motion.positions.period
        at, sense = (np.array(each) for each in zip(*self._edges, strict=True))
        ends = [at - period, at, at + period] if period else [at, time[[0, -1]]]
        way = sense[:, None] * (np.concatenate(ends) - at[:, None])
        length = np.where(way > 0.0, way, np.inf).min(axis=1)
        return np.asarray(at[:, None] + sense[:, None] * towards(length, slowed))
