"""When gaps are smaller than a clearance: intervals of time, none of which is missed however short it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from linkwright.collisions.approaches import Approaches
from linkwright.collisions.columns import Columns
from linkwright.collisions.cycle_pieces import Span
from linkwright.collisions.search import Search
from linkwright.core.arrays import Flags, Floats, Indices

#: To which share of the cycle ends are found.
SHORT = 1e-9


@dataclass(frozen=True, eq=False)
class _Intervals(Columns):
    """Intervals from ``low`` to ``high`` of pieces, of one pair each."""

    pair: Indices
    piece: Indices
    low: Floats
    high: Floats


class Spans:
    """When the gaps of some pairs of a search are below a ``clearance``, m."""

    def __init__(self, search: Search, pairs: Indices, clearance: float) -> None:
        self._search, self._pairs = search, pairs
        self._clearance = max(clearance, 2.0 * search.tolerance)
        self._below: list[_Intervals] = []
        if len(pairs):
            self._find()

    def _find(self) -> None:
        paths, search = self._search.paths, self._search
        piece = np.tile(np.arange(paths.count), len(self._pairs))
        low = np.full(len(piece), -1.0)
        intervals = _Intervals(np.repeat(self._pairs, paths.count), piece, low, -low)
        chosen = np.zeros(search.count, dtype=np.bool_)
        chosen[self._pairs] = True
        over = search.within(chosen, self._clearance)
        first = np.zeros(search.count, dtype=np.intp)
        first[self._pairs] = paths.count * np.arange(len(self._pairs))
        owner = first[over.meetings.pair] + over.piece
        while len(intervals.pair):
            intervals, over, owner = self._halved(intervals, over, owner)

    def _halved(
        self, intervals: _Intervals, over: Approaches, owner: Indices
    ) -> tuple[_Intervals, Approaches, Indices]:
        """Takes intervals in which a gap is below the clearance all the time; halves of those of which that is not
        known yet, with what approaches in them."""
        count, search = len(intervals.pair), self._search
        bounds, radius = search.approaching.bounds(over), search.radius(over.meetings)
        near = bounds.least - radius < self._clearance - search.tolerance
        always = bounds.farthest - radius < self._clearance
        below = np.bincount(owner[always], minlength=count) > 0
        unknown = (np.bincount(owner[near], minlength=count) > 0) & ~below
        short = unknown & (
            search.paths.pieces.share(intervals.piece) * (intervals.high - intervals.low) <= 2.0 * SHORT
        )
        ends = np.minimum(bounds.first, bounds.last) - radius < self._clearance
        below |= short & (np.bincount(owner[ends], minlength=count) > 0)
        unknown &= ~short
        apart = np.flatnonzero(~(unknown | below))
        below[apart] = search.overlaps.at(intervals.pair[apart], intervals.piece[apart], _middle(intervals)[apart])
        self._below.append(intervals.taken(below))
        return self._halves(intervals, unknown, over, near & unknown[owner], owner)

    def _halves(
        self, intervals: _Intervals, chosen: Flags, over: Approaches, near: Flags, owner: Indices
    ) -> tuple[_Intervals, Approaches, Indices]:
        number, count = np.cumsum(chosen) - 1, int(chosen.sum())
        middle, left = _middle(intervals)[chosen], intervals.taken(chosen)
        halves = _Intervals(
            np.tile(left.pair, 2),
            np.tile(left.piece, 2),
            np.concatenate([left.low, middle]),
            np.concatenate([middle, left.high]),
        )
        own = number[owner[near]]
        found = over.taken(near)
        if np.isinf(found.curvatures.line).any():
            found = self._search.approaching.with_curvatures(found)
        return halves, self._search.approaching.halves(found), np.concatenate([own, own + count])

    def found(self) -> list[tuple[Span, ...]]:
        """The spans of every pair, s, one after the other."""
        if not self._below:
            return []
        every, pieces = _Intervals.joined(self._below), self._search.paths.pieces
        own = (every.taken(every.pair == pair) for pair in self._pairs)
        return [pieces.spans(below.piece, below.low, below.high, SHORT) for below in own]


def _middle(intervals: _Intervals) -> Floats:
    return 0.5 * (intervals.low + intervals.high)
