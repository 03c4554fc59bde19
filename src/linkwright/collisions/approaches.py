"""Corners that move against sides over intervals of time, and how near they may come to them.

Over an interval of width h a path leaves the chord between its ends by no more than h²/8 of its largest second
derivative. So a corner stays at least as far from a side as its chord is, less that. The same holds for the distance
from the side's line, where the corner stays abreast of the side, and for the square of the distance from one of its
ends, where it stays beyond that: these are exact for what keeps its distance, as two pins of one link do.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from linkwright.collisions.columns import Columns
from linkwright.collisions.features import Meetings, Outlines, distances
from linkwright.collisions.relative_paths import RelativePaths
from linkwright.core.arrays import Complexes, Flags, Floats, Indices


@dataclass(frozen=True, eq=False)
class Curvatures(Columns):
    """The largest second derivatives by the place in a piece: of the corner's path, of its distance from the side's
    line, and of the squares of its distances from the ends of the side, (n,) each."""

    path: Floats
    line: Floats
    begin: Floats
    end: Floats


class Bounds(NamedTuple):
    """Distances (n,) of corners from sides: at ``first`` and ``last`` of an interval, and ``least`` what they are at
    least in between; ``crosses``: where the corner passes over the side for sure."""

    first: Floats
    last: Floats
    least: Floats
    farthest: Floats
    crosses: Flags


@dataclass(frozen=True, eq=False)
class Approaches(Columns):
    """Meetings over intervals from ``low`` to ``high`` of pieces, with the corner's places there; all (n,)."""

    meetings: Meetings
    piece: Indices
    low: Floats
    high: Floats
    begin: Complexes
    end: Complexes
    curvatures: Curvatures

    def __len__(self) -> int:
        return len(self.piece)


class Approaching:
    """Shapes with ``outlines`` on links that move along ``paths``."""

    def __init__(self, outlines: Outlines, paths: RelativePaths) -> None:
        self.outlines, self.paths = outlines, paths
        self._place_bound: Floats = np.abs(paths.place_curvature).sum(axis=-1)
        self._turn_bound: Floats = np.abs(paths.turn_curvature).sum(axis=-1)

    def over_pieces(self, meetings: Meetings, where: Flags) -> Approaches:
        """Meetings over those pieces of the paths where they matter, (meetings, pieces), one piece after the other,
        with bounds of curvatures that are quick to find."""
        paths = self.paths
        piece, number = np.nonzero(where.T)
        every = meetings.taken(number)
        corner = self.outlines.corner[every.corner]
        places, turns = (each[every.pose, piece] for each in paths.ends)
        ends = places + turns * corner[:, None]
        reach = np.abs(corner)
        bound = self._place_bound[every.pose, piece] + self._turn_bound[every.pose, piece] * reach
        unknown = np.full(len(piece), np.inf)
        low = np.full(len(piece), -1.0)
        return Approaches(
            every, piece, low, -low, ends[:, 0], ends[:, 1], Curvatures(bound, unknown, unknown, unknown)
        )

    def expanded(self, meetings: Meetings, over: Approaches, group: Indices) -> Approaches:
        """Members (n,) of groups that approach over intervals, each of the one with its number in ``group``."""
        pose, piece, corner = over.meetings.pose, over.piece, self.outlines.corner[meetings.corner]
        begin, end = (
            place[group] + turn[group] * corner
            for place, turn in (self.paths.pose(pose, piece, x) for x in (over.low, over.high))
        )
        bound = self._place_bound[pose, piece][group] + self._turn_bound[pose, piece][group] * np.abs(corner)
        unknown = np.full(len(bound), np.inf)
        curvatures = Curvatures(bound, unknown, unknown, unknown)
        return Approaches(meetings, piece[group], over.low[group], over.high[group], begin, end, curvatures)

    def _at(self, meetings: Meetings, piece: Indices, x: Floats) -> Complexes:
        place, turn = self.paths.pose(meetings.pose, piece, x)
        return place + turn * self.outlines.corner[meetings.corner]

    def with_curvatures(self, of: Approaches) -> Approaches:
        """The same with all curvatures from the paths of their own corners."""
        own, meetings, piece = self.outlines, of.meetings, of.piece
        pose, paths = meetings.pose, self.paths
        corner = own.corner[meetings.corner][:, None]
        begin, along = own.begin[meetings.side][:, None], own.along[meetings.side][:, None]
        place, turned = paths.place_curvature[pose, piece], paths.turn_curvature[pose, piece] * corner
        path = place + turned
        line = (own.way[meetings.side].conj()[:, None] * path).imag
        square = paths.square_curvature[pose >> 1, piece]
        square = square - 2.0 * (paths.place_curvature[pose ^ 1, piece].conj() * corner).real
        first = square - 2.0 * (path * begin.conj()).real
        last = first - 2.0 * (path * along.conj()).real
        found = (np.abs(each).sum(axis=1) for each in (path, line, first, last))
        return replace(of, curvatures=Curvatures(*found))

    def halves(self, of: Approaches) -> Approaches:
        """The halves of the intervals, the first ones before the second ones."""
        middle = 0.5 * (of.low + of.high)
        place = self._at(of.meetings, of.piece, middle)
        both = np.tile(np.arange(len(of)), 2)
        found = of.taken(both)
        return replace(
            found,
            low=np.concatenate([of.low, middle]),
            high=np.concatenate([middle, of.high]),
            begin=np.concatenate([of.begin, place]),
            end=np.concatenate([place, of.end]),
        )

    def of_circles(self, pose: Indices, centre: Complexes, reach: Floats) -> tuple[Floats, Floats]:
        """Between which two distances the gaps of shapes stay in each piece, (pairs, pieces), by the circles around
        both: their centres (pairs, 2), the second ones in the given poses, and both radii together."""
        places, turns = (each[pose] for each in self.paths.ends)
        first, last = np.moveaxis(places + turns * centre[:, 1, None, None] - centre[:, 0, None, None], -1, 0)
        apart, path = np.abs(0.5 * (first + last)), 0.5 * np.abs(last - first)
        bend = 0.5 * (self._place_bound[pose] + self._turn_bound[pose] * np.abs(centre[:, 1, None]))
        return apart - path - bend - reach[:, None], apart + path + reach[:, None]

    def circles(self, of: Approaches) -> tuple[Floats, Floats]:
        """Between which two distances (n,) corners stay from sides, by circles around the paths and the sides: wider
        than ``bounds``, but quicker to find."""
        own, side = self.outlines, of.meetings.side
        apart = np.abs(0.5 * (of.begin + of.end - own.along[side]) - own.begin[side])
        path = 0.5 * np.abs(of.end - of.begin)
        bend = 0.125 * (of.high - of.low) ** 2 * of.curvatures.path
        return apart - path - bend - 0.5 * own.length[side], apart + path

    def bounds(self, of: Approaches) -> Bounds:
        """How near the corners are, and may come, to the sides."""
        own, side = self.outlines, of.meetings.side
        v, along, length = own.begin[side], own.along[side], own.length[side]
        square = np.where(length > 0.0, length * length, 1.0)
        begin, end = of.begin - v, of.end - v
        (share_0, off_0), (share_1, off_1) = (_seen(each, along, square) for each in (begin, end))
        first = np.abs(begin - np.clip(share_0, 0.0, 1.0) * along)
        last = np.abs(end - np.clip(share_1, 0.0, 1.0) * along)
        chord = end - begin
        near = np.minimum(distances(0.0 * v, begin, chord), distances(along, begin, chord))
        near = np.minimum(near, np.minimum(first, last))
        opposite = off_0 * off_1 < 0.0
        over = opposite & ((chord.conj() * begin).imag * (chord.conj() * (begin - along)).imag < 0.0)
        near[over] = 0.0
        scale = 0.125 * (of.high - of.low) ** 2
        bend = scale * of.curvatures.path
        least = near - bend
        with np.errstate(invalid="ignore", divide="ignore"):
            slack = np.where(length > 0.0, bend / length, 0.0)
        lowest, highest = np.minimum(share_0, share_1), np.maximum(share_0, share_1)
        abreast = (lowest >= slack) & (highest <= 1.0 - slack) & (length > 0.0)
        off = np.minimum(np.abs(off_0), np.abs(off_1)) * np.where(length > 0.0, length, 1.0)
        with np.errstate(invalid="ignore"):
            clear = np.where(opposite, 0.0, off - scale * of.curvatures.line)
            for beyond, one, other, curvature in (
                ((highest <= -slack) | (length == 0.0), begin, end, of.curvatures.begin),
                ((lowest >= 1.0 + slack) & (length > 0.0), begin - along, end - along, of.curvatures.end),
            ):
                apart = np.minimum(np.abs(one), np.abs(other)) ** 2 - scale * curvature
                least = np.where(beyond, np.maximum(least, np.sqrt(np.maximum(apart, 0.0))), least)
        least = np.where(abreast, np.maximum(least, clear), least)
        return Bounds(first, last, least, np.maximum(first, last) + bend, abreast & opposite)


def _seen(point: Complexes, along: Complexes, square: Floats) -> tuple[Floats, Floats]:
    """Share of a segment at which points are abreast, and how far off its line, in its lengths."""
    seen = point * along.conj() / square
    return seen.real, seen.imag
