"""A motion and its forces solved again at other times of the same cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.once import cached_property
from linkwright.core.outputs import Output
from linkwright.core.search import ends
from linkwright.errors import LinkwrightError
from linkwright.kinematics.between import Between
from linkwright.kinematics.change_points import Passage
from linkwright.kinematics.cycle import Positions, at_times
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.base import Load
from linkwright.loads.over_cycle import activity
from linkwright.loads.signals import Limit, Whole


class _SameCycle(MotionSignals):
    """Signals of a motion within a cycle that is known."""

    def __init__(self, motion: Motion, known: MotionSignals) -> None:
        super().__init__(motion)
        self._known = known

    @property
    def cycle(self) -> Motion:
        return self._known.cycle

    @property
    def whole(self) -> Whole:
        return self._known.whole

    def limits(self, output: Output) -> Sequence[Limit]:
        return self._known.limits(output)

    def limit_inputs(self, output: Output) -> list[tuple[float, str]]:
        return self._known.limit_inputs(output)


class Resolver:
    """Solves the design of a motion at further times, with the programs that are there already."""

    def __init__(self, motion: Motion, forces: Forces | None) -> None:
        self._motion = motion
        self._forces = forces
        self._between = _between(motion)

    @property
    def possible(self) -> bool:
        """Whether the positions are those of the drivers' laws at their times, so that others lie between them."""
        return self._between is not None

    @cached_property
    def changes(self) -> Floats:
        """Times of the change points that the motion passes, s."""
        passing = [] if self._between is None else self._between.passing
        return np.array([self._time_at(p) for p in passing])

    @cached_property
    def _times(self) -> Floats:
        """Times of the positions, s, with that at which the first one of a closed cycle comes again."""
        time, positions = self._motion.time, self._motion.positions
        if not (positions.closed and positions.period):
            return time
        sense = 1.0 if time[-1] >= time[0] else -1.0
        return np.append(time, time[0] + sense * positions.period)

    def _time_at(self, passage: Passage) -> float:
        """When it is passed, s."""
        return float(np.interp(passage.place, np.arange(float(len(self._times))), self._times))

    @cached_property
    def passed(self) -> Flags:
        """Which positions are reached, or lie on change points that the motion passes, (n,)."""
        if not len(self.changes):
            return self._motion.ok
        time = self._motion.time
        apart = np.abs(time[:, None] - self.changes).min(axis=1, initial=np.inf)
        return np.asarray(self._motion.ok | (apart < 1e-9 * (np.ptp(time) or 1.0)))

    @cached_property
    def edges(self) -> tuple[tuple[float, int], ...]:
        """Times, s, at which the mechanism comes into (+1) or gets out of (-1) reach, found by halving."""
        passed = self.passed
        if passed.all():
            return ()
        time = self._motion.time if self._between is None or self._between.bars else self._times
        change = np.diff(np.resize(passed, len(time)).astype(int))
        where = np.flatnonzero(change)
        inside = np.where(change[where] < 0, time[where], time[where + 1])
        if self.possible and len(where):
            brackets = [self._bracket(int(k), bool(change[k] < 0)) for k in where]
            inside = ends(lambda time: self._solved(time).ok, *np.transpose(brackets))
        return tuple((float(t), int(s)) for t, s in zip(inside, change[where], strict=True))

    def _bracket(self, before: int, leaves: bool) -> tuple[float, float]:
        """Times, s, in and out of reach around an end of it between a position and the next, of which the first is in
        reach if it ``leaves``; the same twice where guides become parallel, as nothing is solved very near that."""
        assert self._between is not None
        time = self._times
        bars = [p for p in self._between.bars if before <= p.place <= before + 1]
        inside, outside = (before, before + 1) if leaves else (before + 1, before)
        if not bars:
            return float(time[inside]), float(time[outside])
        bar = bars[0 if leaves else -1]
        at = self._time_at(bar)
        return at if bar.kind == "pole" else float(time[inside]), at

    @cached_property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """Stretches of time, s, in which all positions are reached; across the end of a closed cycle in one piece."""
        time, positions = self._motion.time, self._motion.positions
        period = positions.period if positions.closed else None
        start, end = float(time[0]), float(time[-1] if period is None else time[0] + period)
        if not self.edges:
            return ((start, end),) if self.passed.all() else ()
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

    def at(self, time: Floats, of: str = "motion", asked: tuple[str, ...] = ()) -> Any:
        """Motion, or Forces with ``of="forces"``, at some times, s; ``asked``: outputs beside the stored ones."""
        if of != "forces":
            return self.motion(time)
        return self._at_once(time, asked) or self.forces(self.motion(time))

    def _at_once(self, time: Floats, asked: tuple[str, ...]) -> Forces | None:
        """Forces with their motion in one evaluation, where all positions are reached and no mode changes."""
        from linkwright.kinetostatics.run import solved_at_once

        known = self._motion
        assert self._forces is not None
        if known.modes or not self.passed.all():
            return None
        positions = self._positions(time)

        def motion(rows: Rows) -> Motion | None:
            found = Motion(known.solver, known.design, positions, {}, {}, rows)
            return found if found.ok.all() else None

        return solved_at_once(
            self._forces.solver,
            known.design,
            positions,
            motion,
            asked=asked,
            signals_of=lambda each: _SameCycle(each, self._signals),
        )

    def _positions(self, time: Floats) -> Positions:
        """The drivers at some times, s; where a table ends with the cycle, behind it those at its beginning."""
        mechanism, positions = self._motion.mechanism, self._motion.positions
        try:
            return at_times(mechanism, time)
        except LinkwrightError:
            if not (positions.closed and positions.period):
                raise
            start = min(float(self._times[0]), float(self._times[-1]))
            outside = (time < start) | (time > start + positions.period)
            return at_times(mechanism, np.where(outside, start + (time - start) % positions.period, time))

    def motion(self, time: Floats) -> Motion:
        """Motion at some times; positions out of reach are NaN, also those that could be assembled behind a gap."""
        return self._solved(time, None if self.passed.all() else self._reached(time))

    def _reached(self, time: Floats) -> Flags:
        """Which times, s, of any turn lie within the stretches that are reached."""
        start, positions = float(self._motion.time[0]), self._motion.positions
        period = positions.period if positions.closed else None
        laps = [time] if period is None else [start + (time - start) % period + k * period for k in (0, 1)]
        found = np.zeros(len(time), dtype=np.bool_)
        for begin, end in self.stretches:
            for lap in laps:
                found |= (lap >= begin) & (lap <= end)
        return found

    def _solved(self, time: Floats, reached: Flags | None = None) -> Motion:
        """Motion at some times; NaN where it cannot be assembled or is not ``reached``."""
        assert self._between is not None
        known = self._motion
        positions = self._positions(time)
        before = self._before(positions.time)
        states = self._between._states(positions, before)
        modes = known.modes and self._between._modes(positions)
        names = known.solver.outputs.standard
        values = known.solver.evaluate(names, positions, states, modes, known.design)
        barred = np.zeros(positions.count) if reached is None else np.where(reached, 0.0, 1.0)
        for row in states.values():
            barred = np.where(np.isfinite(row), barred, 1.0)
        rows = Rows(values, {name: i for i, name in enumerate(names)})
        motion = Motion(known.solver, known.design, positions, states, modes, rows, (), barred)
        values[:-1, ~motion.ok] = np.nan
        return motion

    def forces(self, motion: Motion) -> Forces:
        """Forces of such a motion."""
        from linkwright.kinetostatics.run import run_forces

        known = self._forces
        assert known is not None
        return run_forces(motion, known.static, known.solver, _SameCycle(motion, self._signals))

    def active(self, load: Load, time: Floats) -> Flags:
        """Whether a load acts at some times, (n,)."""
        return activity(load, _SameCycle(self.motion(time), self._signals)).where

    @cached_property
    def _signals(self) -> MotionSignals:
        return MotionSignals(self._motion)

    def _before(self, time: Floats) -> Indices:
        """The known position at or before each time, through the end of a closed cycle."""
        known, positions = self._motion.time, self._motion.positions
        if len(known) < 2:
            return np.zeros(len(time), dtype=np.intp)
        share = (time - known[0]) / (known[1] - known[0])
        if positions.closed and positions.period is not None:
            share = share % (positions.period / abs(known[1] - known[0]))
        if np.ptp(np.diff(known)) > 1e-9 * abs(known[1] - known[0]):
            order = np.argsort(known)
            return np.asarray(
                order[np.clip(np.searchsorted(known[order], time, "right") - 1, 0, len(known) - 1)]
            )
        return np.asarray(np.clip(np.floor(share + 1e-9).astype(np.intp), 0, len(known) - 1))

    def input_at(self, time: float) -> float:
        """Coordinate of the first driver at a time."""
        name, driver = next(iter(self._motion.mechanism.drivers.items()))
        try:
            return driver.law.at(time)
        except LinkwrightError:
            return float(self._positions(np.array([time])).coordinates[name][0][0])


def _between(motion: Motion) -> Between | None:
    if not motion.mechanism.drivers:
        return None
    try:
        return Between(motion)
    except LinkwrightError:
        return None
