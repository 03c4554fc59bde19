"""A cycle on pieces with values that are solved again: means and extremes of what no formula gives.

The signals are functions of the motion or of the forces, those also of machines whose cycle is no formula of one
position: what passes change points or is reached in part, and loads without a formula. Pieces are cut where something
jumps or bends. Beside a change point, or an end of what is reached, they are polynomials through places a little away
from it. A stretch that is reached in part runs by the cosine of the place in it, as points come to the ends of their
range with infinite rates.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from linkwright.core.arrays import EQUAL, Floats, Indices
from linkwright.core.cached_property import cached_property
from linkwright.curves.curve import increasing
from linkwright.curves.pieces import HIGH, LOW, Columns, Layout, Pieces, Wanted
from linkwright.curves.polynomials import NODES, WEIGHTS, best_of, climbed, largest
from linkwright.cycle.solved import PIECES
from linkwright.cycle.summary import SummaryValue
from linkwright.events.course import Course
from linkwright.kinematics.motion import Motion
from linkwright.metrics.one_sided_limits import AWAY, SLOWED, STEEPEST, limit, weights
from linkwright.metrics.solved_again import Resolver

#: A piece beside a change point reaches this share of the cycle. Nearer to it than the first of its places no
#: position is asked for: places are exact to the machine's digits over the distance, second derivatives to these over
#: its cube. To this share polynomials meet what is smooth there.
AROUND, PASSED = 1.0 / 36.0, 1e-8
#: The column that tells on which side of a piece a change point, or an end, is.
SIDE = "side of an end"
#: Cuts nearer to each other, as share of the way, are one.
SAME = 1e-11
#: Results at so many sets of times are kept.
KEPT = 8
_NONE: Floats = np.empty(0)
Signal = Callable[[Any], Floats]
#: Signals (k, n) of the motion or of the forces.
Read = Callable[[Any], Floats]


class SolvedPieces:
    """What is reached from ``begin`` to ``end``, cut at some places; ``beside``: change points and ends, with how far
    the pieces beside them go, (k, 2). Places are times, s, or angles, rad, whose cosine runs through a stretch."""

    def __init__(
        self, resolver: Resolver, ends: tuple[float, float], cuts: Floats, beside: Floats, laps: float = 1.0
    ) -> None:
        self.resolver, self._cuts, self.beside, self.laps = resolver, cuts, beside, laps
        self.begin, self.end = ends
        self._solved: dict[tuple[str, bytes], Any] = {}

    @classmethod
    def of_cycle(cls, motion: Motion, resolver: Resolver, cuts: Floats) -> SolvedPieces:
        """The whole cycle, or way, of a motion."""
        course, changes = Course.of(motion.mechanism, motion.positions, seam=True), np.sort(resolver.changes)
        begin, length = course.begin, course.duration
        if course.closed:
            changes = np.concatenate([changes - length, changes, changes + length])
            cuts = begin + (cuts - begin) % length
        apart = np.minimum(np.diff(changes, prepend=-np.inf), np.diff(changes, append=np.inf))
        beside = np.stack([changes, np.minimum(AROUND * length, 0.5 * apart)], axis=1)
        return cls(resolver, (begin, begin + length), cuts, beside, course.laps)

    @property
    def duration(self) -> float:
        """How long it takes, s."""
        return self.end - self.begin

    def time(self, place: Floats) -> Floats:
        """When it comes to places, s."""
        return place

    def pace(self, place: Floats) -> Floats:
        """Time in which a unit of the way is passed, s."""
        return np.ones_like(place)

    def edges(self, more: Floats, share: float) -> Floats:
        """Ends of stretches between the cuts, and ``more`` of them; ``share``: of the pieces beside ends."""
        around = self.beside[:, :1] + share * self.beside[:, 1:] * np.array([-1.0, 0.0, 1.0])
        inner, near = np.concatenate([self._cuts, around.ravel(), more]), SAME * (self.end - self.begin)
        inner = increasing(inner[(inner > self.begin + near) & (inner < self.end - near)])
        inner = inner[np.diff(inner, prepend=self.begin) > near]
        return np.concatenate([[self.begin], inner, [self.end]])

    def at(self, time: Floats, of: str) -> Any:
        """The motion or the forces at some times, s."""
        key = of, time.tobytes()
        if key not in self._solved:
            if len(self._solved) >= KEPT:
                del self._solved[next(iter(self._solved))]
            self._solved[key] = self.resolver.at(time, of)
        return self._solved[key]

    @cached_property
    def reached(self) -> bool:
        """Whether something is solved at all of its first places."""
        solved: list[Motion] = []

        def ok(motion: Motion) -> Floats:
            solved.append(motion)
            return motion.ok[None].astype(float)

        _Solved(self, ok, "motion", Wanted())
        return all(each.ok.all() for each in solved)

    def curve(self, read: Read, of: str, pieces: int = PIECES) -> tuple[Floats, Floats]:
        """Edges of pieces, so many of a lap to begin with, and signals on them that these meet everywhere, (k, nodes,
        pieces)."""
        count = len(read(self.at(self.time(np.array([0.5 * (self.begin + self.end)])), of)))
        found = _Solved(self, read, of, Wanted(even=tuple(range(count))), pieces=pieces).pieces
        values = np.stack([found.values(k) for k in range(count)])
        return np.append(found.columns[LOW], self.end), values

    def _near_enough(self, read: Read, of: str, wanted: Wanted, more: Floats = _NONE) -> _Solved:
        """Signals on pieces, those beside ends short enough that limits there are known, if they can be."""
        found = _Solved(self, read, of, wanted, more)
        if found.unknown and isinstance(self, SolvedStretch):
            return _Solved(self, read, of, wanted, more, share=SLOWED[1] / SLOWED[0])
        return found

    def integral(self, signal: Signal, of: str, *, square: bool = False) -> float:
        """The integral over the time of a signal, or of its square; infinite, or undefined where it grows to both
        sides, beside what it cannot pass."""

        def read(solved: Any) -> Floats:
            values = np.asarray(signal(solved), dtype=float)
            return np.atleast_2d(values * values if square else values)

        found = self._near_enough(read, of, Wanted(even=(0,)))
        ends = [each for _, each, _ in found.limits if not np.isfinite(each)]
        if any(np.isinf(each) for each in ends) or (ends and isinstance(self, SolvedStretch)):
            return float(np.sum(ends))
        pieces = found.pieces
        pace = self.pace(pieces.columns[LOW] + pieces.width * NODES[:, None])
        return float((WEIGHTS @ (pieces.values(0) * pace) * pieces.width).sum())

    def excess(self, signal: Signal, of: str) -> float:
        """Largest difference of the integral over the time of a signal's lack of its mean."""
        pieces = _Solved(self, _one(signal), of, Wanted(even=(0,))).pieces
        lack = pieces.excess(0, pieces.mean(0))
        found = sum(float(largest(sign * lack, pieces.design)[2][0]) for sign in (1.0, -1.0))
        return found if found > EQUAL * float(pieces.size[0, 0]) * self.duration else 0.0

    def extreme(
        self, signal: Signal, sign: float, of: str, spans: Sequence[tuple[float, float]] = ()
    ) -> SummaryValue | None:
        """The largest (``sign`` 1) or smallest value of a signal; ``spans``: in these times, s, alone, of which the
        second may lie in the next cycle. NaN where nothing tells it, None where something is not solved."""
        found = self._near_enough(_one(signal), of, Wanted(sides=((0, sign),)), np.ravel(spans))
        for end, most, _ in found.limits:
            if most == sign * np.inf:
                return SummaryValue(most, end, self.resolver.input_at(end), True)
        pieces = found.pieces
        if not pieces.passed[0]:
            return None
        low, width, part = pieces.columns[LOW], pieces.width, None
        if spans:
            middle = low + 0.5 * width
            laps = (0.0, self.duration)
            part = np.any([(middle + lap > a) & (middle + lap < b) for a, b in spans for lap in laps], axis=0)
        rows, _, piece = pieces.contenders([(0, sign)], [part])
        if part is not None:
            rows, piece = rows[:, part[piece]], piece[part[piece]]
        place, value = climbed(rows)
        alike = EQUAL * pieces.size[0, :1]
        place = np.where((pieces.top - pieces.bottom)[0, piece] <= alike, -1.0, place)
        places = low[piece] + 0.5 * (1.0 + place) * width[piece]
        (best,) = best_of(value, np.zeros(len(piece), dtype=np.intp), alike, places)
        most, time = float(value[best]), float(self.time(places[best : best + 1])[0])
        if len(self.resolver.changes) and abs(most) <= PASSED * float(pieces.size[0, 0]):
            most = 0.0
        if isinstance(self, SolvedStretch) and found.untold(sign, most, int(piece[best])):
            most = float("nan")
        return SummaryValue(sign * most, time, self.resolver.input_at(time), True)


class SolvedStretch(SolvedPieces):
    """A stretch of time, s, that is reached, by the cosine of the place in it."""

    def __init__(self, resolver: Resolver, start: float, end: float) -> None:
        self._middle, self._half = 0.5 * (start + end), 0.5 * (end - start)
        beside = np.array([[np.pi, SLOWED[0]], [2.0 * np.pi, SLOWED[0]]])
        super().__init__(resolver, (np.pi, 2.0 * np.pi), _NONE, beside)

    @property
    def duration(self) -> float:
        return 2.0 * self._half

    @property
    def looks(self) -> Floats:
        """Some times away from the ends, s."""
        return self.time(np.linspace(self.begin, self.end, 11)[1:-1])

    def time(self, place: Floats) -> Floats:
        return np.asarray(self._middle + self._half * np.cos(place))

    def pace(self, place: Floats) -> Floats:
        return np.asarray(-self._half * np.sin(place))


def _one(signal: Signal) -> Read:
    return lambda solved: np.atleast_2d(np.asarray(signal(solved), dtype=float))


class _Solved:
    """Signals on pieces; ``limits``: times of change points and ends, s, with the limit of the first signal on a side
    of them and its values there, nearest first."""

    def __init__(
        self,
        way: SolvedPieces,
        read: Read,
        of: str,
        wanted: Wanted,
        more: Floats = _NONE,
        share: float = 1.0,
        pieces: int = PIECES,
    ) -> None:
        self._way, self._read, self._of = way, read, of
        self.limits: list[tuple[float, float, Floats]] = []
        self._edges = way.edges(more, share)
        low, high, near = self._edges[:-1], self._edges[1:], 1e-9 * (way.end - way.begin)
        places = way.beside[:, 0]
        self._side = (np.abs(low - places[:, None]) < near).any(axis=0).astype(float)
        self._side -= (np.abs(high - places[:, None]) < near).any(axis=0)
        count = np.ceil(pieces * way.laps * (high - low) / (way.end - way.begin)).astype(np.intp)
        count = np.where(self._side != 0.0, 1, np.maximum(count, 1))
        stretch = np.repeat(np.arange(len(count)), count)
        k = np.arange(len(stretch)) - np.repeat(np.cumsum(count) - count, count)
        layout = Layout(np.zeros(len(count), dtype=np.intp), 1, self._columns)
        self.pieces = Pieces(
            self._values, layout, stretch, k / count[stretch], (k + 1) / count[stretch], wanted
        )

    @property
    def unknown(self) -> bool:
        """Whether a limit is not known."""
        return any(np.isnan(value) for _, value, _ in self.limits)

    def untold(self, sign: float, most: float, piece: int) -> bool:
        """Whether the largest of sign times the signal is not told: it lies where a limit is not known, or is less
        than a value beside that."""
        columns, beside = self.pieces.columns, [each for _, value, each in self.limits if np.isnan(value)]
        return bool(beside) and (
            columns[SIDE][piece] != 0.0 or any((sign * each > most).any() for each in beside)
        )

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        begin, length = self._edges[stretch], np.diff(self._edges)[stretch]
        return {LOW: begin + first * length, HIGH: begin + last * length, SIDE: self._side[stretch]}

    def _values(self, columns: Columns, nodes: Floats) -> Floats:
        low, width, side = columns[LOW], columns[HIGH] - columns[LOW], columns[SIDE]
        place = low + width * nodes[:, None]
        near, count = np.flatnonzero(side), len(AWAY)
        ends = np.where(side > 0.0, low, columns[HIGH])[near]
        place[:count, near] = ends + (side * width)[near] * AWAY[:, None]
        place[count:, near] = place[count - 1, near]
        solved = self._way.at(self._way.time(place).ravel(), self._of)
        found = np.asarray(self._read(solved), dtype=float)
        found = np.moveaxis(found.reshape(-1, *place.shape), 0, 1).copy()
        stretch = isinstance(self._way, SolvedStretch)
        for k, end in zip(near, ends, strict=True):
            values = found[:count, :, k]
            limits = [limit(row, STEEPEST if stretch else 2) for row in values.T]
            time = float(self._way.time(np.array([end]))[0])
            self.limits.append((time, limits[0], values[:, 0].copy()))
            between = weights(AWAY, nodes if side[k] > 0.0 else 1.0 - nodes) @ values
            steep = np.isinf(limits) | (np.isnan(limits) & stretch)
            found[:, :, k] = np.where(steep, values[-1], between)
        return found
