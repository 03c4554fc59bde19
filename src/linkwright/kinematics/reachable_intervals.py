"""The reachable intervals of the cycle or path of a motion, with their ends between the positions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.search import ends
from linkwright.kinematics.between_positions import Between
from linkwright.kinematics.change_point_crossing import ChangePointCrossing
from linkwright.kinematics.fold import fold
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import marked

#: How far, rad or share of the size, before an end that is searched Newton's method for its fold begins, how far from
#: it that is found at most, and how many times better it is known then; steps from its place to its time.
AHEAD, COARSE, SURER, NEWTON = 1e-5, 1e-6, 1e3, 4

#: Places of a cycle at which it is looked whether it is reached, on the way from a position to one that is not.
LOOKS = 1440


class Reach:
    """What a motion reaches; ``between``: None where its positions follow no law in time."""

    def __init__(self, motion: Motion, between: Between | None) -> None:
        self._motion, self._between = motion, between
        self._times = motion.positions.around

    @cached_property
    def changes(self) -> Floats:
        """Times of the change points that the motion passes, s."""
        passing = [] if self._between is None else self._between.passing
        return np.array([self._time_at(p) for p in passing])

    def _time_at(self, crossing: ChangePointCrossing) -> float:
        """When it is passed, s."""
        return float(np.interp(crossing.place, np.arange(float(len(self._times))), self._times))

    @cached_property
    def passed(self) -> Flags:
        """Which positions are reached, or lie on change points that the motion passes, (n,)."""
        if not len(self.changes):
            return self._motion.ok
        time = self._motion.time
        distance = np.abs(time[:, None] - self.changes).min(axis=1, initial=np.inf)
        return np.asarray(self._motion.ok | (distance < 1e-9 * (np.ptp(time) or 1.0)))

    @cached_property
    def complete(self) -> bool:
        """Whether all positions are passed, one after the other."""
        return not self._motion.breaks and bool(self.passed.all())

    @cached_property
    def edges(self) -> tuple[tuple[float, int], ...]:
        """Times, s, at which the mechanism comes into (+1) or gets out of (-1) reach."""
        return () if self.complete else self._motion.cached("edges of reach", self._found_edges)

    def _found_edges(self) -> tuple[tuple[float, int], ...]:
        time, found = self._times, list[tuple[int, int]]()
        passed = np.resize(self.passed, len(time)).tolist()
        for k, (here, there) in enumerate(pairwise(passed)):
            if here and (not there or k in self._motion.breaks):
                found.append((k, -1))
            if there and (not here or k in self._motion.breaks):
                found.append((k, 1))
        if self._between is None or not found:
            return tuple((float(time[k if sense < 0 else k + 1]), sense) for k, sense in found)
        at = self._ends(found)
        return tuple((self._folded(each, sense), sense) for each, (_, sense) in zip(at, found, strict=True))

    def _ends(self, found: Sequence[tuple[int, int]]) -> list[float]:
        """Times, s, of ends between positions with these numbers and the next ones."""
        between = self._between
        assert between is not None
        before = np.array([k for k, _ in found], dtype=np.intp)
        neighbours = np.array([(k + (sense > 0)) % self._motion.steps for k, sense in found], dtype=np.intp)
        brackets = [self._bracket(k, sense < 0) for k, sense in found]
        inside, outside = np.array([each[:2] for each in brackets]).T
        hidden, pole = np.array([each[2:] for each in brackets], dtype=np.bool_).T
        count, which = max(1, LOOKS // self._motion.steps), np.arange(len(found))
        share = np.arange(count + 1.0)[:, None] / count
        looks, good = inside + share * (outside - inside), np.tile(hidden, (count, 1))
        good[-1] = False
        if count > 1 and not hidden.all():
            places = looks[1:-1, ~hidden]
            rows = np.broadcast_to(before[~hidden], places.shape).ravel()
            good[:-1, ~hidden] = between.assembled(rows, places.ravel(), rows * 0 - 1).reshape(places.shape)
        first = np.argmin(good, axis=0)
        at = ends(
            lambda time: between.assembled(before, time, np.where(hidden, neighbours, -1)),
            np.where(hidden, inside, looks[first, which]),
            np.where(hidden, outside, looks[first + 1, which]),
        )
        return np.where(pole & (first == count - 1), outside, at).tolist()  # type: ignore[no-any-return]

    def _folded(self, time: float, sense: int) -> float:
        """An end of a tracked branch, s, as the fold next to which the search finds it; itself where none is
        found."""
        drivers = list(self._motion.mechanism.drivers.items())
        if not self._motion.states or len(drivers) > 1:
            return time
        ((name, driver),) = drivers
        unit = 1.0 if driver.law.rotary else self._motion.mechanism.size

        def course(time: float) -> list[float]:
            return [float(row[0]) for row in driver.law.coordinate(np.array([time]))]

        value, rate, _ = course(time)
        if not abs(rate) * abs(self._times[-1] - self._times[0]) > AHEAD * unit:
            return time
        known = fold(self.solved(np.array([time + sense * AHEAD * unit / abs(rate)])), name)
        if known is None or max(abs(known[0] - value), SURER * known[1]) > COARSE * unit:
            return time
        for _ in range(NEWTON):
            value, rate, _ = course(time)
            time += (known[0] - value) / rate if rate else 0.0
        return time

    def _bracket(self, before: int, leaves: bool) -> tuple[float, float, bool, bool]:
        """Times, s, in and out of reach around an end of it between a position and the next, of which the first is in
        reach if it ``leaves``; whether both are in reach, but the branch tracked from the one does not come to the
        other; and whether guides become parallel there, very near which nothing is solved."""
        assert self._between is not None
        time = self._times
        bars = [p for p in self._between.bars if before <= p.place <= before + 1]
        inside, outside = (before, before + 1) if leaves else (before + 1, before)
        if not bars:
            hidden = bool(self.passed[before] and self.passed[(before + 1) % len(self.passed)])
            return float(time[inside]), float(time[outside]), hidden, False
        bar = bars[0 if leaves else -1]
        return float(time[inside]), self._time_at(bar), False, bar.kind == "pole"

    @cached_property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """Stretches of time, s, in which all positions are reached; across the end of a closed cycle in one piece."""
        period = self._motion.positions.period
        start, end = self._times[[0, -1]].tolist()
        if not self.edges:
            return ((start, end),) if self.complete else ()
        times = [t for t, _ in self.edges]
        if self.edges[0][1] < 0:
            times.insert(0, start)
        if len(times) % 2:
            times.append(end)
        pieces = list(zip(times[::2], times[1::2], strict=True))
        if period is not None and len(pieces) > 1 and pieces[0][0] == start and pieces[-1][1] == end:
            first = pieces.pop(0)
            pieces[-1] = (pieces[-1][0], first[1] + end - start)
        return tuple(pieces)

    def reached(self, time: Floats) -> Flags:
        """Which times, s, of any turn lie within the stretches that are reached."""
        if self.complete:
            return np.ones(len(time), dtype=np.bool_)
        start, period = self._motion.time[0], self._motion.positions.period
        laps = [time] if period is None else [start + (time - start) % period + k * period for k in (0, 1)]
        found = np.zeros(len(time), dtype=np.bool_)
        for begin, end in self.stretches:
            for lap in laps:
                found |= (lap >= begin) & (lap <= end)
        return found

    def solved(self, time: Floats, reached: Flags | None = None) -> Motion:
        """Motion at some times; NaN where it cannot be assembled or is not ``reached``."""
        assert self._between is not None
        known = self._motion
        positions = self._between.positions(time)
        states, modes = self._between.assembly(self.before(positions.time), positions)
        names = known.solver.outputs.standard
        values = known.solver.evaluate(names, positions, states, modes, known.design)
        barred = np.zeros(positions.count) if reached is None else np.where(reached, 0.0, 1.0)
        return marked(known.solver, known.design, positions, names, values, states, modes, barred)

    def before(self, time: Floats) -> Indices:
        """The position at or before each time, s, through the end of a closed cycle."""
        known, period = self._motion.time, self._motion.positions.period
        if len(known) < 2:
            return np.zeros(len(time), dtype=np.intp)
        share = (time - known[0]) / (known[1] - known[0])
        if period is not None:
            share = share % (period / (known[1] - known[0]))
        if np.ptp(np.diff(known)) > 1e-9 * abs(known[1] - known[0]):
            order = np.argsort(known)
            return np.asarray(order[np.clip(np.searchsorted(known[order], time, "right") - 1, 0, len(known) - 1)])
        return np.asarray(np.clip(np.floor(share + 1e-9).astype(np.intp), 0, len(known) - 1))
