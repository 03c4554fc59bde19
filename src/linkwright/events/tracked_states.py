"""States of groups without closed form at the positions of many designs, read from their tracked paths."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.curves.pieces import HIGH, LOW
from linkwright.events.course import Course
from linkwright.events.following import path_states, stays_on_path
from linkwright.events.formula import ROW, Formula, Known
from linkwright.events.path_step import PathStep
from linkwright.events.path_tracker import PathTracker
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.threads import spread_over
from linkwright.formula.trace import Mask, Trace
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.mechanism import Mechanism

#: Designs that are tracked together.
BLOCK = 512


class TrackedStates:
    """States at the positions of a motion, of designs of its mechanism.

    ``solver``: traced with the dimensions that vary free and Newton's steps as formulas on paths have them;
    ``compiled``: see :class:`Known`.
    """

    def __init__(self, nominal: Motion, solver: MotionSolver, compiled: bool | None = None) -> None:
        self.programs, self.motion, positions = solver.programs, solver.motion, nominal.positions
        self.course = Course.of(nominal.mechanism, positions)
        self.known = Known(solver.nominal.parameters, compiled=compiled)
        step = PathStep(self.motion, self.course, solver.manner.free)
        first = int(np.argmin(positions.time))
        start = {name: row[first] for name, row in nominal.states.items()}
        self.tracker = PathTracker(step, self.course, self.known, start)
        self.shares = (positions.time - self.course.begin) / (self.course.duration or 1.0)
        t = Trace()
        self._formula = Formula(Program.of(t, path_states(step.coordinates, t)))

    @property
    def on_path(self) -> Mask:
        """Whether Newton's steps from these states end on the path, as a value of the motion's trace."""
        return stays_on_path(self.motion, self.tracker.signs_by_group)

    def of(self, designs: Mapping[str, Floats], threads: int = 1) -> tuple[dict[str, Floats], Floats]:
        """The states, (designs, positions) by name, NaN where the path of a design does not go; and how far its most
        doubtful step was from being refused, (designs,), 1 far, 0 at the edge."""
        count = len(next(iter(designs.values())))
        found = {name: np.empty((count, len(self.shares))) for name in self._formula.outputs}
        margin = np.empty(count)

        def work(first: int, last: int) -> None:
            some = {name: column[first:last] for name, column in designs.items()}
            self._some(some, {name: rows[first:last] for name, rows in found.items()}, margin[first:last])

        spread_over(count, BLOCK, threads, work)
        return found, margin

    def _some(self, designs: Mapping[str, Floats], into: Mapping[str, Floats], margin: Floats) -> None:
        count = len(margin)
        begin, duration = np.full(count, self.course.begin), np.full(count, self.course.duration)
        speed = designs.get(f"{self.course.first.name}.speed")
        if self.course.turns and speed is not None:
            duration = 2.0 * pi * self.course.turns / np.abs(speed)
        paths = self.tracker.track(designs, begin, duration)
        columns = {ROW: np.arange(float(count)), LOW: begin, HIGH: begin + duration}
        found = self._formula.run(self.known, columns, self.shares, paths.fields(columns, self.shares))
        for name, place in self._formula.place.items():
            into[name][...] = found[:, place].T
        margin[...] = paths.margin


def tracked_states(nominal: Motion, solver: MotionSolver, compiled: bool | None) -> TrackedStates:
    """What tracks the designs of a mechanism over some positions; what was made lately serves again."""
    key = (id(solver.programs), nominal.positions.key, compiled)  # which lives as long as what was made
    return _tracked.get(nominal.mechanism, key, lambda: TrackedStates(nominal, solver, compiled))


_tracked: Recent[Mechanism, TrackedStates] = Recent(8)
