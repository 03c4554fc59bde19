"""States of groups without closed form at the positions of many designs, read from their tracked paths."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import pi

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.curves.pieces import HIGH, LOW
from linkwright.engine.program import Program
from linkwright.engine.trace import Mask, Trace
from linkwright.events.course import Course
from linkwright.events.following import ITERATIONS, Paths, path_states, stays_on_path
from linkwright.events.formula import ROW, Formula, Known
from linkwright.events.path_step import PathStep
from linkwright.events.path_tracker import PathTracker
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver


class TrackedStates:
    """States at the positions of a motion, of designs of its mechanism in which some dimensions are ``varied``."""

    def __init__(self, nominal: Motion, varied: Iterable[str]) -> None:
        names, positions = tuple(varied), nominal.positions
        solver = MotionSolver(
            nominal.mechanism, Manner(frozenset(names), iterations=ITERATIONS), nominal.solver.assembly
        )
        self.course = Course.of(nominal.mechanism, positions)
        self.known = Known(solver.nominal.parameters, compiled=True)
        first = int(np.argmin(positions.time))
        start = {name: float(row[first]) for name, row in nominal.states.items()}
        self.motion = solver.motion
        step = PathStep(self.motion, self.course, frozenset(names))
        self.tracker = PathTracker(step, self.course, self.known, start)
        self.shares = (positions.time - self.course.begin) / (self.course.duration or 1.0)
        t = Trace()
        self._formula = Formula(Program.of(t, path_states(step.coordinates, t)))

    @property
    def on_path(self) -> Mask:
        """Whether Newton's steps from these states end on the path, as a value of the motion's trace."""
        return stays_on_path(self.motion, self.tracker.signs_by_group)

    def of(self, designs: Mapping[str, Floats]) -> tuple[dict[str, Floats], Paths]:
        """The states, (designs, positions) by name, NaN where the path does not go; and the paths."""
        count = len(next(iter(designs.values())))
        begin, duration = np.full(count, self.course.begin), np.full(count, self.course.duration)
        speed = designs.get(f"{self.course.first.name}.speed")
        if self.course.turns and speed is not None:
            duration = 2.0 * pi * self.course.turns / np.abs(speed)
        paths = self.tracker.track(designs, begin, duration)
        columns = {ROW: np.arange(float(count)), LOW: begin, HIGH: begin + duration}
        fields = paths.fields(columns, self.shares)
        found = self._formula.run(self.known, columns, self.shares, fields)
        return {name: np.ascontiguousarray(found[:, k].T) for name, k in self._formula.place.items()}, paths
