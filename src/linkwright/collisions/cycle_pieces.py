"""Pieces of a cycle between which signals are polynomials: their times, and the driver's coordinate there."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.core.arrays import Floats, Indices
from linkwright.curves.polynomials import POINTS
from linkwright.kinematics.motion import Motion

#: Pieces of a lap to begin with.
PIECES = 24
#: Added to every signal, each of about size 1, so that what is zero but for rounding is not taken for a signal.
_LEVEL = 2.0

#: An interval of time, s.
Span = tuple[float, float]


class CyclePieces:
    """Signals ``values`` (signals, pieces, POINTS) of a motion, of about size 1, at the Gauss points of pieces of its
    cycle, or of what is reached of it.

    ``exact``: whether they hold between the positions that were solved, if anything moves. Where positions follow no
    law in time, or something goes away without bound, every position is a piece without width.
    """

    def __init__(self, motion: Motion, signals: Callable[[Motion], Floats], count: int) -> None:
        self._analysis = Analysis.of(motion)
        self._ways, self._number = self._analysis.ways, np.empty(0, dtype=np.intp)
        if self._ways is not None:
            found = self._ways.curve(lambda each: signals(each) + _LEVEL, "motion", count, PIECES)
            if np.isfinite(found.values).all() and not (found.unbounded | found.unresolved).any():
                self.values = np.moveaxis(found.values, 1, 2) - _LEVEL
                self._low, self._high = found.edges[:-1], found.edges[1:].copy()
                begins = self._low == self._low[0]
                self._high[np.flatnonzero(begins[1:])] = found.edges[-1]
                self._way: Indices = np.cumsum(begins) - 1
            else:
                self._ways = None
        self.exact = self._ways is not None or not motion.inputs
        if self._ways is None:
            self._take_positions(signals)
        self.count = len(self._low)

    def _take_positions(self, signals: Callable[[Motion], Floats]) -> None:
        motion = self._analysis.motion
        values = signals(motion)
        self._number = np.flatnonzero(motion.ok & np.isfinite(values).all(axis=0))
        self.values = np.repeat(values[:, self._number, None], POINTS, axis=2)
        self._low = self._high = motion.time[self._number]

    def time(self, piece: Indices, x: Floats) -> Floats:
        """Times, s, of places ``x``, -1 to 1, of pieces, within the cycle."""
        found = self._time(piece, x)
        return found if self._end is None else np.where(found > self._end, found - self._period, found)

    def _time(self, piece: Indices, x: Floats) -> Floats:
        """The same, beyond the end of a closed cycle for what is reached across it."""
        place = self._low[piece] + 0.5 * (1.0 + x) * (self._high[piece] - self._low[piece])
        return place if self._ways is None else self._ways.time(place, self._way[piece])

    @cached_property
    def _period(self) -> float:
        """That of a closed cycle, s; 0 of another."""
        positions = self._analysis.motion.positions
        return positions.period or 0.0 if positions.closed else 0.0

    @cached_property
    def _end(self) -> float | None:
        """When a closed cycle ends, s."""
        return float(self._analysis.motion.time[0]) + self._period if self._period else None

    def input(self, piece: Indices, time: Floats) -> Floats:
        """The first driver's coordinate at times of pieces, rad or m; NaN without a driver."""
        motion = self._analysis.motion
        if not motion.inputs:
            return np.full(len(time), np.nan)
        if self._ways is None:
            return motion.input[self._number[piece]]
        return np.array([self._analysis.resolver.input_at(float(each)) for each in time])

    @cached_property
    def duration(self) -> float:
        """Time of all pieces together, s."""
        return float(self._widths.sum())

    @cached_property
    def _widths(self) -> Floats:
        every, ones = np.arange(self.count), np.ones(self.count)
        return np.abs(self._time(every, ones) - self._time(every, -ones))

    def share(self, piece: Indices) -> Floats:
        """Shares (n,) of that time in pieces."""
        return self._widths[piece] / (self.duration or 1.0)

    def spans(self, piece: Indices, low: Floats, high: Floats, slack: float) -> tuple[Span, ...]:
        """Intervals from ``low`` to ``high`` of pieces as times, joined where no more than a share ``slack`` of the
        cycle is between them; of positions alone from the first to the last of those that follow each other."""
        if self._ways is None:
            number = np.unique(piece)
            breaks = np.flatnonzero(np.diff(number) > 1)
            begin, end = self._low[number], self._low[number]
        else:
            begin, end = self._time(piece, low), self._time(piece, high)
            order = np.argsort(begin, kind="stable")
            begin, end = begin[order], np.maximum.accumulate(end[order])
            breaks = np.flatnonzero(begin[1:] - end[:-1] > slack * self.duration)
        if not len(begin):
            return ()
        firsts, lasts = np.append(0, breaks + 1), np.append(breaks, len(begin) - 1)
        return self._within(zip(begin[firsts].tolist(), end[lasts].tolist(), strict=True))

    def _within(self, spans: Iterable[Span]) -> tuple[Span, ...]:
        """Spans within the cycle, in two where they go over its end."""
        if self._end is None:
            return tuple(spans)
        end, period, found = self._end, self._period, list[Span]()
        for first, last in spans:
            if last <= end:
                found.append((first, last))
                continue
            found += [(first, end)] if first < end else []
            found.append((max(first, end) - period, last - period))
        return tuple(sorted(found))
