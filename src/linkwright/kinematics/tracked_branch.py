"""Tracked branches of the groups without closed form: their paths through all positions, and between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.data import Frozen
from linkwright.kinematics.branch import Branch, follow
from linkwright.kinematics.continuation import SAME, BranchTracker
from linkwright.kinematics.positions import Positions, off_law
from linkwright.kinematics.tracking_formula import TURN


@dataclass(frozen=True)
class Stop:
    """Where a way ends: the drivers' coordinates, and the name of the group that becomes singular."""

    inputs: Floats
    group: str


@dataclass(frozen=True)
class Stretch:
    """A branch through positions: their ``places`` (n,) on its way; what their coordinates have ``gained`` on its."""

    branch: Branch
    places: Floats
    gained: Floats | float = 0.0

    def at(self, numbers: Floats) -> Floats:
        """Places on the way at numbers of positions, counted on in between; behind the last one as before it."""
        n = len(self.places)
        step = self.places[-1] - self.places[-2]
        return np.asarray(np.interp(numbers, np.arange(n + 1), np.append(self.places, self.places[-1] + step)))

    def read(self, tracker: BranchTracker, x: Floats, q: Floats) -> Floats:
        """Coordinates (m, n) at places x (m,) with the drivers at q (m, d); NaN where it does not go."""
        return np.asarray(tracker.read(self.branch, x, q - self.branch.way.lap) + self.gained)


@dataclass(frozen=True)
class TrackedBranch(Frozen):
    """The way of the groups without closed form through n positions.

    ``inputs`` (n, d): coordinates of the drivers; ``states``: their chain coordinates (n,) by name, NaN where the
    way is barred; ``coordinates`` (n, unknowns): the same with angles as such; ``stops`` and ``stop_of`` (n,): where
    the way to a position ends, -1 for none; ``breaks``: positions after which it ends before the next one;
    ``closed``: whether the first position comes after the last one; ``returns``: whether such a cycle comes back to
    its first assembly (None: it was not passed); ``stretches``: the branches on which the drivers move from each
    position to the next.
    """

    tracker: BranchTracker
    inputs: Floats
    states: Mapping[str, Floats]
    coordinates: Floats
    stops: tuple[Stop, ...]
    stop_of: Indices
    breaks: frozenset[int]
    closed: bool
    returns: bool | None
    stretches: tuple[Stretch, ...] = ()

    def taken(self, order: Indices) -> TrackedBranch:
        """Some of the positions in another order, each for itself."""
        return replace(
            self,
            inputs=self.inputs[order],
            states={name: row[order] for name, row in self.states.items()},
            coordinates=self.coordinates[order],
            stop_of=self.stop_of[order],
            breaks=frozenset(),
            closed=False,
            returns=None,
            stretches=(),
        )

    def between(self, places: Floats, inputs: Floats) -> dict[str, Floats]:
        """States (m,) at places (fractional numbers of positions) with the drivers at ``inputs`` (m, d).

        NaN where one of the two neighbours is not reached.
        """
        n = len(self.inputs)
        a = np.minimum(np.floor(places).astype(int), n - 1)
        around = self.closed and self.returns is not False
        b = (a + 1) % n if around else np.minimum(a + 1, n - 1)
        found = np.full((len(places), self.coordinates.shape[1]), math.nan)
        known = np.flatnonzero(
            np.isfinite(self.coordinates[a]).all(axis=1)
            & np.isfinite(self.coordinates[b]).all(axis=1)
            & ((a != b) | (places == a))
            & ((places == a) | ~np.isin(a, list(self.breaks)))
        )
        for stretch in self.stretches:
            left = known[~np.isfinite(found[known]).all(axis=1)]
            if len(left):
                found[left] = stretch.read(self.tracker, stretch.at(places[left]), inputs[left])
        for i in known[~np.isfinite(found[known]).all(axis=1)]:
            here = self.inputs[a[i]]
            goal = here + self.tracker.nearest_drive(inputs[i] - here)
            own = self.tracker.between(here, goal, self.coordinates[a[i]])
            if own.complete and own.last is not None:
                found[i] = own.last
        return self.tracker.states(found)


def track_branch(tracker: BranchTracker, positions: Positions, separate: bool = False) -> TrackedBranch:
    """The way through all positions, from the drawing on; ``separate``: they are no cycle, but each for itself."""
    return _Journey(tracker, positions, separate).track_branch()


class _Journey:
    """The ways from the drawing through all positions, and what was found on them."""

    def __init__(self, tracker: BranchTracker, positions: Positions, separate: bool) -> None:
        self.tracker, self.positions, self.separate = tracker, positions, separate
        n = positions.count
        rows = [positions.coordinates[name][0] for name in tracker.drivers]
        self.q = np.stack(rows, axis=1) if rows else np.zeros((n, 0))
        self.coordinates = np.full((n, len(tracker.groups.scale)), math.nan)
        self.stops: list[Stop] = []
        self.stop_of = np.full(n, -1)
        self.returns: bool | None = None
        self.breaks: list[int] = []
        self.stretches: list[Stretch] = []

    def track_branch(self) -> TrackedBranch:
        self._all()
        return TrackedBranch(
            self.tracker,
            self.q,
            self.tracker.states(self.coordinates),
            self.coordinates,
            tuple(self.stops),
            self.stop_of,
            frozenset(self.breaks),
            self.positions.closed,
            self.returns,
            tuple(self.stretches),
        )

    def _all(self) -> None:
        tracker = self.tracker
        start = self._leg(tracker.drawn_inputs, tracker.drawn, 0)
        if start is not None and self.positions.count > 1 and self.lawful:
            self._along_laws(start)
        elif start is not None and self._in_line():
            self._along_line(start)
        elif start is not None or self.separate:
            self._each_separately(start, 1)

    @cached_property
    def lawful(self) -> bool:
        """Whether the positions follow each other in time by the drivers' laws."""
        steps = np.diff(self.positions.time)
        if not ((steps > 0.0).all() or (steps < 0.0).all()):
            return False
        return off_law(self.tracker.mechanism, self.positions) is None

    def _in_line(self) -> bool:
        """Whether the drivers' coordinates follow each other on one straight line."""
        if self.positions.count < 3 or self.positions.closed:
            return False
        share = self._shares()
        on_line = self.q[0] + share[:, None] * (self.q[-1] - self.q[0])
        return bool((np.diff(share) > 0.0).all() and np.allclose(on_line, self.q, rtol=1e-14, atol=1e-14))

    def _shares(self) -> Floats:
        way = self.q[-1] - self.q[0]
        lead = int(np.argmax(np.abs(way / self.tracker.groups.unit)))
        return np.asarray((self.q[:, lead] - self.q[0, lead]) / (way[lead] or 1.0))

    def _along_line(self, start: Floats) -> None:
        share = self._shares()
        branch = self.tracker.between(self.q[0], self.q[-1], start)
        reached = self._read(branch, share, np.arange(self.positions.count))
        if not branch.complete and reached < self.positions.count:
            self._stopped(branch, np.arange(reached, self.positions.count))
            if self.separate:
                self._each_separately(self.coordinates[reached - 1], reached)

    def _read(self, branch: Branch, places: Floats, order: Indices, gained: Floats | float = 0.0) -> int:
        """The positions in ``order`` that a branch reaches, at their ``places`` (n,) on its way; how many."""
        stretch = Stretch(branch, places, gained)
        found = stretch.read(self.tracker, places[order], self.q[order])
        good = np.isfinite(found).all(axis=1)
        count = len(order) if good.all() else int(np.argmin(good))
        self.coordinates[order[:count]] = found[:count]
        self.stretches.append(stretch)
        return count

    # one leg ------------------------------------------------------------------------------------
    def _leg(self, begin: Floats, start: Floats, index: int) -> Floats | None:
        """The straight way to one position; turning drivers go the shorter way, or else the other way round."""
        tracker, goal = self.tracker, self.q[index]
        goal = begin + tracker.nearest_drive(goal - begin)
        ways = [goal]
        if tracker.rotary.sum() == 1:
            ways.append(goal - np.where(tracker.rotary, TURN * np.where(goal < begin, -1.0, 1.0), 0.0))
        first: Branch | None = None
        for end in ways:
            branch = tracker.between(begin, end, start)
            first = first or branch
            if branch.complete and branch.last is not None:
                self.coordinates[index] = branch.last
                return branch.last
        assert first is not None
        self._stopped(first, np.array([index]))
        return None

    def _each_separately(self, here: Floats | None, first: int) -> None:
        """Positions one after the other, each from the last one that was reached."""
        tracker = self.tracker
        begin = self.q[first - 1] if here is not None else tracker.drawn_inputs
        here = tracker.drawn if here is None else here
        for i in range(first, self.positions.count):
            moved = self._leg(begin, here, i)
            if moved is not None:
                begin, here = self.q[i], moved

    def _stopped(self, branch: Branch, index: Indices) -> None:
        end, way = branch.end, branch.way
        inputs = way.drive(np.array([way.start]))[0] if end is None else end.q
        self.stops.append(Stop(inputs, self.tracker.weakest_group(branch)))
        self.stop_of[index] = len(self.stops) - 1

    # a way by the laws -----------------------------------------------------------------------------
    def _along_laws(self, start: Floats) -> None:
        positions, tracker = self.positions, self.tracker
        time, n, around = positions.time, positions.count, positions.period
        begin, end = float(time[0]), float(time[0] + around if around else time[-1])
        sense = 1.0 if end >= begin else -1.0
        branch = follow(tracker.groups, tracker.lawful(begin, end), start.tolist())
        reached = self._read(branch, sense * time, np.arange(n))
        if branch.complete and reached == n:
            if around and branch.last is not None:
                gap = tracker.nearest_way(branch.last - start) / tracker.groups.scale
                self.returns = bool(np.abs(gap).max() < SAME)
            return
        rest = np.arange(reached, n)
        self._stopped(branch, rest)
        self.breaks.append(reached - 1)
        if self.separate and not positions.is_way:
            self._each_separately(self.coordinates[reached - 1], reached)
        elif around and len(rest):
            self._backwards(start, rest)

    def _backwards(self, start: Floats, rest: Indices) -> None:
        """From the first position of a closed cycle back to what was not reached."""
        positions, tracker = self.positions, self.tracker
        around = positions.period
        assert around is not None
        begin, places = float(positions.time[0]), around - positions.time
        way = tracker.lawful(begin, float(positions.time[rest[0]]) - around, around)
        back = follow(tracker.groups, way, start.tolist())
        reached = self._read(back, places, rest[::-1], tracker.gains(way.lap))
        behind = rest[: len(rest) - reached]
        if not back.complete and len(behind):
            self._stopped(back, behind[-1:])
