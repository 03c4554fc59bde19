"""Smallest gaps between two shapes that move, over a whole cycle, exact between the positions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from linkwright.collisions.relative_paths import RelativePaths
from linkwright.collisions.search import Search
from linkwright.collisions.spans import Spans
from linkwright.core.table import Amount
from linkwright.kinematics.motion import Motion
from linkwright.shapes.shape import Shape

#: Coordinates below this share of the machine's size are zero in tables: places of contact are found to no more.
NOTHING = 1e-6


@dataclass(frozen=True)
class Gap:
    """The smallest gap of two shapes over a cycle.

    ``size``: m, 0 or less where they overlap (then no more than that they do is meant); ``time`` s and ``input``
    (rad or m, the first driver's) there, ``place``: the middle between the nearest places, m, in frame axes;
    ``spans``: intervals of time, s, in which the gap is below the clearance that was asked for; ``exact``: whether
    it holds between the solved positions, or in these alone.
    """

    size: float
    time: float
    input: float
    place: complex
    spans: tuple[tuple[float, float], ...] = ()
    exact: bool = True

    def cells(self, size: float) -> tuple[Amount, Amount]:
        """The coordinates of the place for tables, those that are zero but for rounding as zero; ``size``: m, of the
        machine."""
        x, y = (each if abs(each) > NOTHING * size else 0.0 for each in (self.place.real, self.place.imag))
        return Amount(x, "length", 4), Amount(y, "length", 4)


@dataclass(frozen=True, eq=False)
class Moving:
    """A shape on a link of the motion."""

    carrier: str
    shape: Shape


def smallest_gaps(
    motion: Motion, pairs: Iterable[tuple[Moving, Moving]], *, clearance: float = 0.0, spans: bool = False
) -> list[Gap]:
    """The smallest gap of every pair over the cycle of a motion, to 1e-9 of the machine's size.

    No contact between positions is missed: a gap over an interval of time is at least that between the chords of the
    paths, less how far paths leave their chords. ``spans``: whether to find the intervals of time in which gaps are
    below the ``clearance``, m.
    """
    asked = [*pairs]
    if not asked:
        return []
    carriers = list(dict.fromkeys((one.carrier, other.carrier) for one, other in asked))
    paths = RelativePaths(motion, carriers)
    poses = [2 * carriers.index((one.carrier, other.carrier)) for one, other in asked]
    search = Search(paths, [(one.shape, other.shape) for one, other in asked], poses)
    found = search.nearest()
    time = paths.pieces.time(found.piece, found.x)
    where = paths.pieces.input(found.piece, time)
    host = [(one, other)[pose & 1].carrier for (one, other), pose in zip(asked, found.pose.tolist(), strict=True)]
    place, turn = paths.in_frame(host, found.piece, found.x)
    middle = place + turn * found.place
    middle = np.where(np.abs(middle.real) > search.tolerance, middle.real, 0.0) + 1j * np.where(
        np.abs(middle.imag) > search.tolerance, middle.imag, 0.0
    )
    gaps = [
        Gap(size, at, value, each, exact=paths.exact)
        for size, at, value, each in zip(*(each.tolist() for each in (found.size, time, where, middle)), strict=True)
    ]
    if spans:
        close = np.flatnonzero((found.size < clearance) | (found.size == 0.0))
        for k, each in zip(close.tolist(), Spans(search, close, clearance).found(), strict=True):
            gaps[k] = replace(gaps[k], spans=each)
    return gaps
