"""What a motion reaches, on pieces on which signals are solved again: the full cycle, or reachable intervals of it.

Places on a full cycle are times. An interval that ends where the mechanism gets out of reach runs by the cosine of
the place in it, as points come to the ends of their range with infinite rates; stretches are then for pieces what
designs are elsewhere. Next to a change point, or an end of range, pieces are polynomials through places a little away
from it.

At a distance δ from the point the digits of a position are good for ε/δ only, those of an acceleration or a force
for ε/δ³, so nothing is solved in the middle. What is smooth on a side of the point goes on to it as the polynomial
through the values on that side; forces that the change point cannot carry grow as 1/δ.

At an end of its range a mechanism turns back on another branch, so that what it does is smooth in √δ, of which rates
grow as the first power of the inverse, accelerations and what they cause as the third, jerks as the fifth. Where two
guides become parallel, what slides on them goes away as 1/δ², its acceleration as the third power of that, and the
torque that this takes, whose work it is, as the fifth.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from linkwright.analysis.solved_again import Resolver
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.curve import increasing
from linkwright.curves.pieces import HIGH, LOW, Columns, Layout, Pieces, Wanted
from linkwright.curves.polynomials import NODES, POINTS
from linkwright.cycle.solved import PIECES
from linkwright.events.course import Course, Span, Stretches

#: A piece next to a change point reaches this share of the cycle. Nearer to it than the first of its places no
#: position is asked for: places are exact to the machine's digits over the distance, second derivatives to these over
#: its cube.
AROUND = 1.0 / 36.0
#: The columns that tell on which side of a piece a change point, or an end, is, and the number of its way.
SIDE, WAY = "side of an end", "way"
#: Cuts nearer to an end than this share of the way are there.
SAME = 1e-11
#: Results at so many sets of times are cached.
CACHED_RESULTS = 8
_NONE: Floats = np.empty(0)
_HALF_TURN = Course((), np.pi, np.pi, False, 0)
Signal = Callable[[Any], Floats]
#: Signals (k, n) of the motion or of the forces.
Read = Callable[[Any], Floats]


class Ways:
    """A ``course`` of places with ``cuts``, and change points, or ends, next to which pieces go so far, (k,) each.

    ``reached`` (ways, 2): begins and ends of stretches, s, of what is reached in part.
    """

    def __init__(
        self, resolver: Resolver, course: Course, cuts: Floats, ends: Floats, reach_of_ends: Floats, reached: Floats
    ) -> None:
        self.resolver, self.course, self._cuts = resolver, course, cuts
        self.ends, self._reach_of_ends, self._reached = ends, reach_of_ends, reached
        self._solved: dict[tuple[str, bytes], Any] = {}

    @classmethod
    def of_cycle(cls, resolver: Resolver, course: Course, cuts: Floats) -> Ways:
        """The full cycle, or path."""
        length, changes = course.duration, np.sort(resolver.changes)
        around = changes
        if course.closed:
            changes = increasing(course.begin + (changes - course.begin) % length)
            around = np.concatenate([changes - length, changes, changes + length])
        distances = np.abs(changes[:, None] - around)
        nearest = np.where(distances > 0.0, distances, np.inf).min(axis=1, initial=np.inf)
        return cls(resolver, course, cuts, changes, np.minimum(AROUND * length, 0.5 * nearest), _NONE)

    @classmethod
    def in_part(cls, resolver: Resolver, reached: Sequence[tuple[float, float]]) -> Ways:
        """All stretches of time, s, that are reached."""
        ends, reach_of_ends = np.array([np.pi, 2.0 * np.pi]), np.full(2, SLOWED[0])
        return cls(resolver, _HALF_TURN, _NONE, ends, reach_of_ends, np.array(reached))

    @property
    def complete(self) -> bool:
        """Whether it is the full cycle, or path."""
        return not len(self._reached)

    @property
    def durations(self) -> Floats:
        """How long the ways take, (ways,) s."""
        return np.array([self.course.duration]) if self.complete else np.diff(self._reached).ravel()

    @property
    def looks(self) -> Floats:
        """Some times away from the ends, s."""
        place = np.linspace(np.pi, 2.0 * np.pi, 11)[1:-1]
        return np.concatenate([self.time(place, np.intp(k)) for k in range(len(self.durations))])

    def time(self, place: Floats, way: Indices | np.intp) -> Floats:
        """When it comes to places of some ways, s."""
        if self.complete:
            return place
        begin, end = self._reached[way].T
        return np.asarray(0.5 * (begin + end) + 0.5 * (end - begin) * np.cos(place))

    def pace(self, place: Floats) -> Floats | float:
        """Share of the way's time by share of its places."""
        return 1.0 if self.complete else -0.5 * np.pi * np.sin(place)

    def stretches(self, more: Floats, nearer: float) -> Stretches:
        """What lies between the cuts, ``more`` of them, and ends of the pieces next to change points, ``nearer`` to
        these by a factor."""
        around = self.ends[:, None] + nearer * self._reach_of_ends[:, None] * np.array([-1.0, 0.0, 1.0])
        cuts, course = np.concatenate([self._cuts, around.ravel(), more]), self.course
        if not course.closed:
            near, gone = SAME * course.duration, cuts - course.begin
            cuts = cuts[(gone > near) & (gone < course.duration - near)]
        span = Span(course, np.full(len(self.durations), course.duration), np.zeros(len(self.durations)))
        return Stretches(span, [], cuts)

    def at(self, time: Floats, of: str) -> Any:
        """The motion or the forces at some times, s."""
        key = of, time.tobytes()
        if key not in self._solved:
            if len(self._solved) >= CACHED_RESULTS:
                del self._solved[next(iter(self._solved))]
            self._solved[key] = self.resolver.at(time, of)
        return self._solved[key]

    @cached_property
    def solved(self) -> bool:
        """Whether something is solved at all of its first places."""
        found: list[Flags] = []

        def ok(motion: Any) -> Floats:
            found.append(motion.ok)
            return np.asarray(motion.ok[None].astype(float))

        SignalsOnWays(self, ok, "motion", Wanted())
        return all(each.all() for each in found)

    def curve(self, read: Read, of: str, count: int, pieces: int = PIECES) -> SolvedCurves:
        """``count`` signals on pieces, so many of a lap to begin with, that meet them everywhere."""
        signals = SignalsOnWays.resolved(self, read, of, Wanted(even=tuple(range(count))), first=pieces)
        found, limits = signals.pieces, np.array([end.limits for end in signals.ends]).reshape(-1, count)
        values = np.stack([found.values(k) for k in range(count)])
        edges = np.append(found.columns[LOW], found.columns[HIGH][-1])
        unresolved = np.isnan(limits).any(axis=0) & (not self.complete)
        return SolvedCurves(edges, values, np.isinf(limits).any(axis=0), unresolved)


class SolvedCurves(NamedTuple):
    """Signals ``values`` (k, nodes, pieces) on pieces between ``edges``, ways behind each other; those that grow
    without bound at a change point or an end, and those of which nothing tells the limit at an end, (k,)."""

    edges: Floats
    values: Floats
    unbounded: Flags
    unresolved: Flags


@dataclass(frozen=True)
class End:
    """A change point, or an end, of a ``way``, at a ``time``, s: the ``limits`` of the signals there, and the values
    nearby, ``nearby_values``, nearest first."""

    way: int
    time: float
    limits: Floats
    nearby_values: Floats

    @property
    def limit(self) -> float:
        """That of the first signal."""
        return float(self.limits[0])


class SignalsOnWays:
    """Signals on ``pieces`` of ways, ``paced`` ones by the time; ``ends``: what they do at change points and ends."""

    def __init__(
        self,
        ways: Ways,
        read: Read,
        of: str,
        wanted: Wanted,
        more: Floats = _NONE,
        nearer: float = 1.0,
        first: int = PIECES,
        paced: tuple[int, ...] = (),
    ) -> None:
        self._ways, self._read, self._of, self._paced = ways, read, of, [*paced]
        self.ends: list[End] = []
        self.stretches = stretches = ways.stretches(more, nearer)
        edges, near = ways.ends[:, None], 1e-9 * ways.course.duration
        begin, end = stretches.begin, stretches.begin + stretches.length
        lap = ways.course.duration if ways.course.closed else 0.0
        behind, before = (np.abs(each - edges) < near for each in (begin, np.stack([end, end - lap])[:, None]))
        self._side = behind.any(axis=0) - before.any(axis=(0, 1)).astype(float)
        stretch, low, high = stretches.first_pieces(first)
        own = (self._side[stretch] == 0.0) | (low == 0.0)
        high = np.where(self._side[stretch] == 0.0, high, 1.0)
        layout = Layout(stretches.design, stretches.span.count, self._columns)
        self.pieces = Pieces(self._values, layout, stretch[own], low[own], high[own], wanted)

    @classmethod
    def resolved(
        cls,
        ways: Ways,
        read: Read,
        of: str,
        wanted: Wanted,
        more: Floats = _NONE,
        first: int = PIECES,
        paced: tuple[int, ...] = (),
    ) -> SignalsOnWays:
        """With pieces next to ends short enough to determine limits there, if possible."""
        found = cls(ways, read, of, wanted, more, 1.0, first, paced)
        if ways.complete or not any(np.isnan(each.limits).any() for each in found.ends):
            return found
        return cls(ways, read, of, wanted, more, SLOWED[1] / SLOWED[0], first, paced)

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        low, high = self.stretches.ends(stretch, first, last)
        return {LOW: low, HIGH: high, SIDE: self._side[stretch], WAY: self.stretches.design[stretch].astype(float)}

    def _solved(self, time: Floats) -> Floats:
        """The signals (nodes, signals, pieces) at times of one way, s, in which angles go on from the first one."""
        rows = np.asarray(self._read(self._ways.at(time.ravel(), self._of)), dtype=float)
        return np.moveaxis(rows.reshape(-1, *time.shape), 0, 1)

    def _values(self, columns: Columns, nodes: Floats) -> Floats:
        low, width, side, ways = columns[LOW], columns[HIGH] - columns[LOW], columns[SIDE], self._ways
        way = columns[WAY].astype(np.intp)
        own = low + width * nodes[:, None]
        place, near, count = own.copy(), np.flatnonzero(side), len(AWAY)
        ends = np.where(side > 0.0, low, columns[HIGH])[near]
        place[:count, near] = ends + (side * width)[near] * AWAY[:, None]
        place[count:, near] = place[count - 1, near]
        parts = [self._solved(ways.time(place[:, way == each], each)) for each in np.unique(way)]
        found = np.concatenate(parts, axis=2)
        times = ways.time(ends, way[near])
        for k, time in zip(near, times, strict=True):
            values = found[:count, :, k]
            limits = np.array([limit(row, 2 if ways.complete else STEEPEST) for row in values.T])
            self.ends.append(End(int(way[k]), float(time), limits, values[:, 0].copy()))
            between = weights(AWAY, nodes if side[k] > 0.0 else 1.0 - nodes) @ values
            steep = np.isinf(limits) | (np.isnan(limits) & (not ways.complete))
            found[:, :, k] = np.where(steep, values[-1], between)
        found[:, self._paced] *= np.broadcast_to(ways.pace(own), own.shape)[:, None]
        return found


#: Two polynomials, through all values of a side and through all but the outermost, agree to this share of the values.
AGREE = 1e-6
#: What grows does so over the nearest places, and its product with a power of δ has a limit that is this many times
#: what is not sure of it.
_GROWING, _SURE = 4, 100.0
#: Steepest growth towards an end of range: where guides become parallel, of the torque that moves what slides away.
STEEPEST = 10
#: Places near an end of range lie within one of these parts, rad, of the half turn whose cosine runs through the
#: stretch: the nearer ones where a size has a kink among the others, such as that of a force that passes zero.
SLOWED = (0.2, 0.02)
_HALF = POINTS // 2
#: Distances of a side's places from the middle, the nearest first, as shares of the half width.
AWAY = 2.0 * NODES[_HALF:] - 1.0


def weights(away: Floats, x: Floats) -> Floats:
    """Weights (m, k) of values at distances (k,) in their polynomial's values at x (m,)."""
    others = away[:, None] - away
    np.fill_diagonal(others, 1.0)
    differences = np.repeat((x[:, None] - away)[:, None, :], len(away), axis=1)
    differences[:, np.arange(len(away)), np.arange(len(away))] = 1.0
    return np.asarray(differences.prod(axis=2) / others.prod(axis=1))


_MIDDLE = np.zeros(1)
_ALL = weights(AWAY, _MIDDLE)[0]
_BUT_ONE = np.append(weights(AWAY[:-1], _MIDDLE)[0], 0.0)


def limit(values: Floats, steepest: int = 2) -> float:
    """The limit of a signal at a change point from the values (k,) of one side; infinite where it grows as the
    inverse of the distance or of a power of it up to ``steepest``, NaN where no polynomial tells."""
    found = float(_ALL @ values)
    nothing = AGREE * float(np.abs(values).max())
    if abs(found - float(_BUT_ONE @ values)) <= nothing:
        return found if abs(found) > nothing else 0.0
    if (np.diff(np.abs(values[:_GROWING])) < 0.0).all():
        for order in range(1, steepest + 1):
            scaled = values * np.sign(values[0]) * AWAY**order
            found = float(_ALL @ scaled)
            unsure = max(abs(found - float(_BUT_ONE @ scaled)), AGREE * float(np.abs(scaled).max()))
            if found > _SURE * unsure:
                return float(np.copysign(np.inf, values[0]))
    return float("nan")
