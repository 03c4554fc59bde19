"""A motion between its positions: evaluated in the same assembly, and the ends of its reachable intervals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import row_name
from linkwright.core.search import ends
from linkwright.errors import LinkwrightError
from linkwright.kinematics.change_points import closes, crossings, signs
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.passing import ChangePointCrossing, modal
from linkwright.kinematics.positions import Positions, at_one_time, at_times, off_law
from linkwright.kinematics.rank_of_motion import fold
from linkwright.kinematics.solve import marked, reached_modes
from linkwright.words import _


class Between:
    """A motion evaluated at times between its positions, in the same assembly, through its change points."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self._plain: dict[tuple[str, ...], Callable[[float], list[float]] | None] = {}
        if motion.positions.cycle:
            return
        if (name := off_law(motion.mechanism, motion.positions)) is not None:
            raise LinkwrightError(
                _(
                    "the positions of this motion do not follow the law of driver {name!r} in time, so "
                    "there is no way between them; find limit positions in a motion over a cycle or at "
                    "times",
                    code="motion.no_way_between",
                    name=name,
                )
            )

    @cached_property
    def passing(self) -> list[ChangePointCrossing]:
        """Change points of the motion."""
        motion = self.motion
        if not motion.modes:
            return []
        return [p for p in crossings(motion.solver, motion.positions, motion.tracked) if p.touches]

    @cached_property
    def bars(self) -> list[ChangePointCrossing]:
        """Where a group cannot be assembled, or tracked, though it can be at the adjacent positions."""
        motion = self.motion
        found = crossings(motion.solver, motion.positions, motion.tracked)
        return [p for p in found if p.barred or p.kind == "end"]

    @property
    def closes(self) -> bool:
        """Whether the first position comes after the last one, in the same assembly."""
        return self.motion.positions.closed and closes(self.passing)

    def evaluate(self, names: tuple[str, ...], before: Indices, time: Floats) -> Floats:
        """Outputs of the program (names, m) at times a little after the positions ``before``; NaN out of reach."""
        positions = self.positions(time)
        states, modes = self.assembly(before, positions)
        return self.motion.solver.evaluate(names, positions, states, modes, self.motion.design)

    def assembly(self, before: Indices, positions: Positions) -> tuple[dict[str, Floats], Mapping[str, Floats]]:
        """States of the tracked groups, NaN out of reach, and signs of the groups that pass change points, of the
        drivers' positions a little after those ``before``."""
        return self._states(positions, before), self.motion.modes and self._modes(positions)

    def positions(self, time: Floats) -> Positions:
        """The drivers at some times, s; where a table ends with the cycle, behind it those at its beginning."""
        mechanism, positions = self.motion.mechanism, self.motion.positions
        try:
            return at_times(mechanism, time)
        except LinkwrightError:
            if positions.period is None:
                raise
            start, period = positions.time[0], positions.period
            outside = (time < start) | (time > start + period)
            return at_times(mechanism, np.where(outside, start + (time - start) % period, time))

    def assembled(self, before: Indices, time: Floats, reference: Indices) -> Flags:
        """Which of some times, s, a little after the positions ``before`` are reached, to where a dyad is stretched
        or folded; groups are tracked from the position ``reference``, or from both where that is negative."""
        motion, positions = self.motion, self.positions(time)
        states, modes = self.assembly(before, positions)
        for k in np.flatnonzero(reference >= 0) if states else ():
            for name, row in self._moved(int(reference[k]), positions.time[k : k + 1]).items():
                states[name][k] = row[0]
        squares = tuple(row_name("quality", group) for group in modal(motion.solver.motion))
        found = motion.solver.evaluate((*squares, "outcome"), positions, states, modes, motion.design)
        good = (found[-1] <= 0.0) & (found[:-1] >= 0.0).all(axis=0)
        for row in states.values():
            good &= np.isfinite(row)
        return np.asarray(good)

    def on_plain_numbers(self, names: tuple[str, ...]) -> Callable[[float], list[float]] | None:
        """The same at one time; None where more than constant speeds and closed forms decides."""
        if names not in self._plain:
            self._plain[names] = self._on_plain_numbers(names)
        return self._plain[names]

    def _on_plain_numbers(self, names: tuple[str, ...]) -> Callable[[float], list[float]] | None:
        motion = self.motion
        mechanism = motion.mechanism
        constant = all(driver.law.constant_speed is not None for driver in mechanism.drivers.values())
        if motion.states or motion.modes or not constant:
            return None
        scalar = motion.solver.programs.scalar_program(names)
        inputs, parameters = scalar.program.positions, motion.design.parameters
        outputs = scalar.of_design([parameters[name] for name in scalar.program.parameters])

        def at(time: float) -> list[float]:
            known = at_one_time(mechanism, time)
            return outputs([known[name] for name in inputs])

        return at

    @cached_property
    def _one_way(self) -> bool:
        """Whether the motion's modes are those of its own way, not of times that were each asked for by itself."""
        along = signs(self.passing, self.motion.solver.assembly.modes, self.motion.steps)
        modes = self.motion.modes
        return along.keys() == modes.keys() and all((along[name] == modes[name]).all() for name in modes)

    def _modes(self, positions: Positions) -> Mapping[str, Floats]:
        """Signs of the groups that pass change points."""
        if not self._one_way and (by_time := reached_modes(self.motion.solver, positions)[0]):
            return by_time
        return signs(self.passing, self.motion.solver.assembly.modes, self.place(positions.time))

    def quality(self, before: Indices, time: Floats) -> Floats:
        """Minimum quality (square of the sine of the transmission angle) of the groups that pass change points."""
        names = tuple(dict.fromkeys(row_name("quality", p.group) for p in self.passing))
        rows = self.evaluate(names, before, time) if names else np.ones((1, len(time)))
        return np.asarray(rows.min(axis=0))

    def place(self, time: Floats) -> Floats:
        """Number of the position at these times, counted on in between."""
        known = self.motion.positions.around
        direction = 1.0 if known[-1] >= known[0] else -1.0
        return np.asarray(np.interp(direction * time, direction * known, np.arange(float(len(known)))))

    def _states(self, positions: Positions, before: Indices) -> dict[str, Floats]:
        if not self.motion.states:
            return {}
        tracked = self.motion.tracked
        assert tracked is not None
        inputs = [positions.coordinates[name][0] for name in tracked.tracker.drivers]
        found = tracked.between(self._place(positions.time), np.stack(inputs, axis=1))
        for reference in (before, (before + 1) % self.motion.steps):
            lost = np.flatnonzero(~np.isfinite(next(iter(found.values()))))
            for index in np.unique(reference[lost]):
                these = lost[reference[lost] == index]
                moved = self._moved(int(index), positions.time[these])
                for name, row in found.items():
                    row[these] = moved[name]
        return found

    def _place(self, time: Floats) -> Floats:
        """The same for times of any turn of a closed cycle."""
        start, period = self.motion.time[0], self.motion.positions.period
        return self.place(time if period is None else start + (time - start) % period)

    def _moved(self, index: int, time: Floats) -> dict[str, Floats]:
        """States of groups without closed form at times (m,) near a position, tracked from there."""
        motion, start, period = self.motion, float(self.motion.time[index]), self.motion.positions.period
        assert motion.tracked is not None
        away = time - start
        if period is not None:
            away = away - period * np.round(away / period)
        return motion.solver.tracker(motion.design).moved(motion.tracked.coordinates[index], start, start + away)


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
