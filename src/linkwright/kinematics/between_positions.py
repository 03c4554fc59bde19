"""A motion evaluated at times between its positions, in the same assembly."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import row_name
from linkwright.errors import LinkwrightError
from linkwright.kinematics.change_point_crossing import ChangePointCrossing
from linkwright.kinematics.change_points import closes, crossings, signs
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.passing_proof import modal
from linkwright.kinematics.positions import Positions, at_one_time, at_times, off_law
from linkwright.kinematics.solve import reached_modes
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
