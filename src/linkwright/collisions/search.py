"""The smallest gaps of pairs of shapes by branch and bound over intervals of time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.collisions.approaches import Approaches, Approaching, Bounds
from linkwright.collisions.features import Meetings, Outlines, PairsOfShapes, nearest_places
from linkwright.collisions.overlap import Overlaps
from linkwright.collisions.relative_paths import RelativePaths
from linkwright.core.arrays import Complexes, Flags, Floats, Indices
from linkwright.shapes.shape import Shape

#: To which share of the machine's size gaps are found, and within which two of them are equal.
TOLERANCE, EQUAL = 1e-9, 1e-12
#: Parabolas towards the place of a smallest gap.
PARABOLAS = 3
#: Bisections towards the place of a contact.
BISECTIONS = 40
#: Intervals are halved no more than so many times, and so many corners against sides are looked at together.
HALVINGS, TOGETHER = 48, 400_000

#: Takes those that are near enough to be looked at more closely.
Near = Callable[[Approaches], Approaches]


@dataclass(eq=False)
class Nearest:
    """Of every pair the smallest gap ``size``, m, found at ``x`` of a ``piece``, ``place`` the middle between the
    nearest places in the axes of the side's link, which is that of the second shape where ``pose`` is odd.
    ``crosses``: it is found that the corner passes over the side between ``x`` and ``width`` behind it."""

    size: Floats
    pose: Indices
    corner: Indices
    side: Indices
    piece: Indices
    x: Floats
    width: Floats
    crosses: Flags
    place: Complexes

    @classmethod
    def of(cls, count: int) -> Nearest:
        """Nothing found yet."""
        pose, corner, side, piece = np.zeros((4, count), dtype=np.intp)
        x, width = np.zeros((2, count))
        crosses = np.zeros(count, dtype=np.bool_)
        return cls(
            np.full(count, np.inf), pose, corner, side, piece, x, width, crosses, np.zeros(count, dtype=complex)
        )


class Search:
    """Pairs of shapes, the second of each in its ``pose`` in the axes of the first."""

    def __init__(self, paths: RelativePaths, shapes: Sequence[tuple[Shape, Shape]], poses: Sequence[int]) -> None:
        self.paths, self.tolerance = paths, TOLERANCE * paths.size
        self._equal = EQUAL * paths.size
        self.outlines = Outlines({id(each): each for pair in shapes for each in pair}.values())
        self.pairs = PairsOfShapes(self.outlines, shapes, poses)
        self.overlaps = Overlaps(self.pairs, shapes, paths)
        self.approaching = Approaching(self.outlines, paths)
        self.count = len(shapes)

    def nearest(self) -> Nearest:
        """The smallest gap of every pair."""
        found = Nearest.of(self.count)
        self._begin(found)
        where = (found.size > 0.0)[:, None] & self._pieces()

        def near(over: Approaches) -> Approaches:
            return self._nearer(self._within_reach(over, found), found)

        over = Approaches.joined([self._first(self.pairs.fine, near, where), self._expanded(near, where)])
        self._narrow(over, found)
        self._settle(found)
        return found

    def _begin(self, found: Nearest) -> None:
        """Finds pairs that overlap where pieces do not go on from the ones before."""
        fresh = np.flatnonzero(self.paths.fresh)
        pair, piece = np.tile(np.arange(self.count), len(fresh)), np.repeat(fresh, self.count)
        over = np.flatnonzero(self.overlaps.at(pair, piece, np.full(len(pair), -1.0)))[::-1]
        found.size[pair[over]], found.piece[pair[over]], found.x[pair[over]] = -np.inf, piece[over], -1.0

    def _pieces(self) -> Flags:
        """In which pieces the gap of each pair may be smallest, (pairs, pieces): by circles around the shapes, and
        of what does not move in the first one."""
        least, most = self.approaching.of_circles(self.overlaps.pose, *self.overlaps.circles)
        found: Flags = least <= most.min(axis=1, initial=np.inf, keepdims=True) + self.tolerance
        still = [self.paths.pairs[pose >> 1] for pose in self.overlaps.pose.tolist()]
        found[[one == other for one, other in still], 1:] = False
        return found

    def within(self, chosen: Flags, reach: float) -> Approaches:
        """Corners and sides of chosen pairs (pairs,) over pieces in which they may be nearer than ``reach``, m."""
        limits = np.where(chosen, reach, -np.inf)
        where = np.repeat(chosen[:, None], self.paths.count, axis=1)

        def near(over: Approaches) -> Approaches:
            bounds = self.approaching.bounds(over)
            return over.taken(bounds.least - self.radius(over.meetings) < limits[over.meetings.pair])

        parts = (self._first(self.pairs.fine, near, where), self._expanded(near, where))
        return Approaches.joined(parts)

    def radius(self, meetings: Meetings) -> Floats:
        """Radii of corners and sides together, with the slack of groups of these, m."""
        own, corner, side = self.outlines, meetings.corner, meetings.side
        slack = own.corner_slack[corner] + own.side_slack[side]
        return own.corner_radius[corner] + own.side_radius[side] + slack

    def _first(self, meetings: Meetings, near: Near, where: Flags) -> Approaches:
        """Meetings of pairs over pieces, (pairs, pieces), of which those are taken that are ``near``."""
        parts = []
        together = max(1, TOGETHER // max(1, self.paths.count))
        for begin in range(0, max(1, len(meetings.pair)), together):
            some = meetings.taken(slice(begin, begin + together))
            parts.append(near(self.approaching.over_pieces(some, where[some.pair])))
        return Approaches.joined(parts)

    def _expanded(self, near: Near, where: Flags) -> Approaches:
        """Corners and sides of groups over pieces, (pairs, pieces), of which those are taken that are ``near``."""
        parts = []
        over = self._first(self.pairs.coarse, near, where)
        for begin in range(0, max(1, len(over)), TOGETHER // 64):
            some = over.taken(slice(begin, begin + TOGETHER // 64))
            meetings, group = self.pairs.expanded(some.meetings)
            parts.append(near(self.approaching.expanded(meetings, some, group)))
        return Approaches.joined(parts)

    def _within_reach(self, over: Approaches, found: Nearest) -> Approaches:
        """Leaves out, by circles around paths and sides, what stays farther away than another corner comes."""
        least, most = self.approaching.circles(over)
        reach, pair = self.radius(over.meetings), over.meetings.pair
        limits = found.size.copy()
        np.minimum.at(limits, pair, most + reach)
        return over.taken(least - reach <= limits[pair] + self.tolerance)

    def _narrow(self, over: Approaches, found: Nearest) -> None:
        """Halves intervals until none can have a smaller gap than is found."""
        over = self._nearer(over, found)
        for turn in range(HALVINGS):
            if not len(over):
                return
            if not turn:
                over = self.approaching.with_curvatures(over)
                over = self._nearer(over, found)
            over = self._nearer(self.approaching.halves(over), found)

    def _nearer(self, over: Approaches, found: Nearest) -> Approaches:
        """Takes the gaps at the ends of intervals, and keeps the intervals in which there may be smaller ones."""
        if not len(over):
            return over
        bounds = self.approaching.bounds(over)
        own, meetings = self.outlines, over.meetings
        reach = self.radius(meetings)
        slack = own.corner_slack[meetings.corner] + own.side_slack[meetings.side]
        alone = bounds.crosses & (own.corner_members[meetings.corner] * own.side_members[meetings.side] == 1)
        self._take(over, bounds._replace(crosses=alone), 2.0 * slack - reach, found)
        best = found.size[meetings.pair]
        return over.taken((bounds.least - reach < best - self.tolerance) & (best > 0.0))

    def _take(self, over: Approaches, bounds: Bounds, more: Floats, found: Nearest) -> None:
        """Takes the gaps at the ends of intervals as the smallest ones where they are."""
        pair = over.meetings.pair
        size = np.minimum(bounds.first, bounds.last) + more
        size[bounds.crosses] = np.minimum(size[bounds.crosses], 0.0)
        better = np.flatnonzero(size < found.size[pair] - self._equal)
        if not len(better):
            return
        best = found.size.copy()
        np.minimum.at(best, pair[better], size[better])
        better = better[size[better] <= best[pair[better]] + self._equal]
        at_end = (bounds.last[better] < bounds.first[better]) & ~bounds.crosses[better]
        x = np.where(at_end, over.high[better], over.low[better])
        later_first = np.lexsort((-x, -over.piece[better]))
        better, x, taken = better[later_first], x[later_first], pair[better][later_first]
        found.size[taken], found.x[taken], found.piece[taken] = size[better], x, over.piece[better]
        found.pose[taken] = over.meetings.pose[better]
        found.corner[taken], found.side[taken] = over.meetings.corner[better], over.meetings.side[better]
        found.width[taken] = over.high[better] - over.low[better]
        found.crosses[taken] = bounds.crosses[better]

    def _settle(self, found: Nearest) -> None:
        """Moves places to where gaps are smallest within the tolerance, by parabolas."""
        own = self.outlines
        begin, end = own.corner_radius[found.corner], own.side_radius[found.side]
        away = 0.5 * found.width
        for _ in range(PARABOLAS):
            middle = np.clip(found.x, -1.0 + away, 1.0 - away)
            low, here, high = (self._apart(found, middle + k * away)[0] for k in (-1, 0, 1))
            bend = low - 2.0 * here + high
            with np.errstate(invalid="ignore", divide="ignore"):
                x = middle + away * np.clip(0.5 * (low - high) / bend, -1.0, 1.0)
            x = np.where((bend > 0.0) & (found.size > self.tolerance), x, found.x)
            better = self._apart(found, x)[0] < self._apart(found, found.x)[0]
            found.x, away = np.where(better, x, found.x), 0.125 * away
        self._cross(found)
        apart, corner, near = self._apart(found, found.x)
        begun = np.flatnonzero(np.isneginf(found.size))
        found.size = np.minimum(found.size, apart - begin - end)
        found.size[found.size <= self.tolerance] = 0.0
        with np.errstate(invalid="ignore", divide="ignore"):
            way = np.where(apart > 0.0, (near - corner) / apart, 0.0)
        found.place = 0.5 * (corner + near + (begin - end) * way)
        found.place[begun] = self.overlaps.places(begun, found.piece[begun], found.x[begun])

    def _cross(self, found: Nearest) -> None:
        """Moves to the contact where a corner passes over a side within the interval in which that was found."""
        own, passing = self.outlines, np.flatnonzero(found.crosses)
        low, high = found.x[passing], found.x[passing] + found.width[passing]
        pose, piece, corner, side = (each[passing] for each in (found.pose, found.piece, found.corner, found.side))

        def off(x: Floats) -> Floats:
            place, turn = self.paths.pose(pose, piece, x)
            return np.asarray((own.way[side].conj() * (place + turn * own.corner[corner] - own.begin[side])).imag)

        below = off(low) < 0.0
        for _ in range(BISECTIONS if len(passing) else 0):
            middle = 0.5 * (low + high)
            same = (off(middle) < 0.0) == below
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        found.x[passing] = low

    def _apart(self, found: Nearest, x: Floats) -> tuple[Floats, Complexes, Complexes]:
        """Distances of the corners from the sides at places of pieces, and both nearest places."""
        own = self.outlines
        place, turn = self.paths.pose(found.pose, found.piece, x)
        corner = place + turn * own.corner[found.corner]
        near = nearest_places(corner, own.begin[found.side], own.along[found.side])
        return np.abs(corner - near), corner, near
