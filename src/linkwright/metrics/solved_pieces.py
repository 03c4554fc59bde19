"""A whole cycle on pieces with values that are solved again: means and extremes of what no formula gives.

The signals are functions of the motion or of the forces, those also of machines whose cycle is no formula of one
position: what passes change points, and loads without a formula. Pieces are cut where something jumps or bends.
Beside a change point they are polynomials through places a little away from it, on each side.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from linkwright.core.arrays import EQUAL, Floats, Indices
from linkwright.core.cached_property import cached_property
from linkwright.curves.pieces import HIGH, LOW, Columns, Layout, Pieces, Wanted
from linkwright.curves.polynomials import NODES, best_of, climbed, largest
from linkwright.cycle.cycle import PIECES
from linkwright.cycle.summary import Extreme
from linkwright.events.course import Course
from linkwright.events.stretches import Span, Stretches
from linkwright.kinematics.motion import Motion
from linkwright.metrics.one_sided_limits import AWAY, limit, weights
from linkwright.metrics.solved_again import Resolver

#: A piece beside a change point reaches this share of the cycle. Nearer to it than the first of its places no
#: position is asked for: places are exact to the machine's digits over the distance, second derivatives to these over
#: its cube. To this share polynomials meet what is smooth there.
AROUND, PASSED = 1.0 / 36.0, 1e-8
#: The column that tells on which side of a piece a change point is.
SIDE = "side of a change point"
#: Results at so many sets of times are kept.
KEPT = 8
Signal = Callable[[Any], Floats]


class SolvedPieces:
    """The cycle of a motion from ``begin`` to ``end``, s, cut at some times."""

    def __init__(self, motion: Motion, resolver: Resolver, cuts: Floats) -> None:
        self.motion, self.resolver, self._cuts = motion, resolver, cuts
        course = Course.of(motion.mechanism, motion.positions, seam=True)
        self.span = Span(course, np.array([course.duration]), np.zeros(1))
        self.begin, self.end = course.begin, course.begin + course.duration
        self._solved: dict[tuple[str, bytes], Any] = {}

    @cached_property
    def changes(self) -> Floats:
        """Change points that are passed, and how far the pieces beside them go, (changes, 2) s."""
        length, places = self.span.course.duration, np.sort(self.resolver.changes)
        if self.span.course.closed:
            places = np.concatenate([places - length, places, places + length])
        apart = np.minimum(np.diff(places, prepend=-np.inf), np.diff(places, append=np.inf))
        found = np.stack([places, np.minimum(AROUND * length, 0.5 * apart)], axis=1)
        return np.asarray(found[(places >= self.begin) & (places <= self.end)])

    def stretches(self, more: Floats) -> Stretches:
        """What lies between the cuts, and ``more`` of them, s."""
        around = self.changes[:, :1] + self.changes[:, 1:] * np.array([-1.0, 0.0, 1.0])
        times = np.concatenate([self._cuts, around.ravel(), more])
        if self.span.course.closed:
            times = self.begin + (times - self.begin) % self.span.course.duration
        apart = np.abs(times[:, None] - np.array([self.begin, self.end])).min(axis=1)
        inner = (times > self.begin) & (times < self.end) & (apart > 1e-11 * self.span.course.duration)
        return Stretches(self.span, (), np.unique(times[inner]))

    def reached(self, of: str) -> bool:
        """Whether something is solved at all of its first places."""
        stretch, first, last = self.stretches(np.empty(0)).first_pieces(PIECES)
        low, high = self.stretches(np.empty(0)).ends(stretch, first, last)
        solved = self.resolver.motion((low + (high - low) * NODES[:, None]).ravel())
        return bool(solved.ok.all())

    def pieces(self, read: Callable[[Any], Floats], of: str, wanted: Wanted, more: Floats) -> _Read:
        """Signals (k, n) that ``read`` gives of the motion, or of the forces (``of="forces"``)."""
        return _Read(self, read, of, wanted, self.stretches(more))

    def at(self, time: Floats, of: str) -> Any:
        """The motion or the forces at some times, s."""
        key = of, time.tobytes()
        if key not in self._solved:
            if len(self._solved) >= KEPT:
                del self._solved[next(iter(self._solved))]
            self._solved[key] = self.resolver.at(time, of)
        return self._solved[key]

    def curve(self, read: Callable[[Any], Floats], of: str) -> tuple[Floats, Floats]:
        """Edges of pieces, s, and signals (k, n) on them that these meet everywhere, (k, nodes, pieces)."""
        count = len(np.atleast_2d(read(self.at(np.array([self.begin]), of))))
        found = self.pieces(read, of, Wanted(even=tuple(range(count))), np.empty(0)).pieces
        values = np.stack([found.values(k) for k in range(count)])
        return np.append(found.columns[LOW], self.end), values

    def mean(self, signal: Signal, of: str, *, square: bool = False) -> float:
        """The mean over the time of a signal, or of its square."""

        def read(solved: Any) -> Floats:
            values = np.asarray(signal(solved), dtype=float)
            return np.atleast_2d(values * values if square else values)

        found = self.pieces(read, of, Wanted(even=(0,)), np.empty(0))
        ends = [each for _, values in found.beside for each in [limit(values[0])] if np.isinf(each)]
        if ends:
            return float(np.sum(ends))  # infinite, or undefined where it grows to both sides
        return float(found.pieces.mean(0)[0])

    def excess(self, signal: Signal, of: str) -> float:
        """Largest difference of the integral over the time of a signal's lack of its mean."""
        read = lambda solved: np.atleast_2d(signal(solved))  # noqa: E731
        pieces = self.pieces(read, of, Wanted(even=(0,)), np.empty(0)).pieces
        lack = pieces.excess(0, pieces.mean(0))
        found = sum(float(largest(sign * lack, pieces.design)[2][0]) for sign in (1.0, -1.0))
        return found if found > EQUAL * float(pieces.size[0, 0]) * (self.end - self.begin) else 0.0

    def extreme(
        self, signal: Signal, sign: float, of: str, spans: Sequence[tuple[float, float]] = ()
    ) -> Extreme:
        """The largest (``sign`` 1) or smallest value of a signal; ``spans``: in these times, s, alone, of which the
        second may lie in the next cycle."""
        read = lambda solved: np.atleast_2d(signal(solved))  # noqa: E731
        found = self.pieces(read, of, Wanted(sides=((0, sign),)), np.ravel(spans))
        for time, values in found.beside:
            if limit(values[0]) == sign * np.inf:
                return Extreme(sign * np.inf, time, self.resolver.input_at(time), True)
        pieces = found.pieces
        low, width = pieces.columns[LOW], pieces.width
        part = None
        if spans:
            middle, lap = low + 0.5 * width, self.span.course.duration
            inside = [(middle + gone > a) & (middle + gone < b) for a, b in spans for gone in (0.0, lap)]
            part = np.any(inside, axis=0)
        rows, _, piece = pieces.contenders([(0, sign)], [part])
        if part is not None:
            rows, piece = rows[:, part[piece]], piece[part[piece]]
        place, value = climbed(rows)
        alike = EQUAL * pieces.size[0, :1]
        place = np.where((pieces.top - pieces.bottom)[0, piece] <= alike, -1.0, place)
        times = low[piece] + 0.5 * (1.0 + place) * width[piece]
        (best,) = best_of(value, np.zeros(len(piece), dtype=np.intp), alike, times)
        best_value = sign * float(value[best])
        if len(self.changes) and abs(best_value) <= PASSED * float(pieces.size[0, 0]):
            best_value = 0.0
        at = float(times[best])
        return Extreme(best_value, at, self.resolver.input_at(at), True)


class _Read:
    """Signals on pieces; ``beside``: change points, s, with the signals (k, places) on one side, nearest first."""

    def __init__(
        self, cycle: SolvedPieces, read: Callable[[Any], Floats], of: str, wanted: Wanted, cut: Stretches
    ) -> None:
        self._cycle, self._read, self._of, self._cut = cycle, read, of, cut
        self.beside: list[tuple[float, Floats]] = []
        self._side = np.zeros(len(cut.begin))
        near = 1e-9 * cycle.span.course.duration
        for change in cycle.changes[:, 0]:
            self._side[np.abs(cut.begin - change) < near] = 1.0
            self._side[np.abs(cut.begin + cut.length - change) < near] = -1.0
        layout = Layout(cut.design, 1, self._columns)
        stretch, first, last = cut.first_pieces(PIECES)
        self.pieces = Pieces(self._values, layout, stretch, first, last, wanted)

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        low, high = self._cut.ends(stretch, first, last)
        side = self._side[stretch]
        beside = np.where(side > 0.0, first == 0.0, last == 1.0)
        return {LOW: low, HIGH: high, SIDE: np.where(beside, side, 0.0)}

    def _values(self, columns: Columns, nodes: Floats) -> Floats:
        low, width, side = columns[LOW], columns[HIGH] - columns[LOW], columns[SIDE]
        time = low + width * nodes[:, None]
        near, count = np.flatnonzero(side), len(AWAY)
        starts = np.where(side > 0.0, low, columns[HIGH])[near]
        time[:count, near] = starts + (side * width)[near] * AWAY[:, None]
        time[count:, near] = time[count - 1, near]
        solved = self._cycle.at(time.ravel(), self._of)
        found = np.moveaxis(np.asarray(self._read(solved), dtype=float).reshape(-1, *time.shape), 0, 1).copy()
        for k, start in zip(near, starts, strict=True):
            values = found[:count, :, k]
            self.beside.append((float(start), values.T.copy()))
            found[:, :, k] = weights(AWAY, nodes if side[k] > 0.0 else 1.0 - nodes) @ values
        return found
