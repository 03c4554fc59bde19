"""A mechanism made ready to be solved: the programs of its shape, its numbers, its assembly."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.assembly import Assembly, assemble
from linkwright.kinematics.continuation import BranchTracker
from linkwright.kinematics.dimensions import Design
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.programs import AS_IT_IS, Manner, MotionPrograms, motion_programs
from linkwright.kinematics.trace import MotionOutputs, MotionTrace
from linkwright.kinematics.tracked_branch import TrackedBranch, track_branch
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology import Structure


class MotionSolver:
    """Evaluates the motion of one mechanism; ``manner``: how it is traced."""

    def __init__(self, mechanism: Mechanism, manner: Manner = AS_IT_IS, assembly: Assembly | None = None) -> None:
        self.mechanism = mechanism
        self.manner = manner
        self._assembly = assembly

    def __getstate__(self) -> dict[str, Any]:
        """All but what every process makes for itself."""
        return {name: each for name, each in self.__dict__.items() if name not in ("programs", "_own_follower")}

    @cached_property
    def programs(self) -> MotionPrograms:
        """The programs of the mechanism's shape."""
        return motion_programs(self.mechanism, self.manner)

    @property
    def structure(self) -> Structure:
        """Its Assur groups."""
        return self.programs.structure

    @property
    def motion(self) -> MotionTrace:
        """Every link's state as traced values."""
        return self.programs.motion

    @property
    def outputs(self) -> MotionOutputs:
        """The motion's outputs by name."""
        return self.programs.outputs

    @property
    def point_keys(self) -> dict[str, str]:
        """Names of points that were looked up, with their canonical ones."""
        return self.programs.point_keys

    @cached_property
    def assembly(self) -> Assembly:
        """How its groups are put together."""
        return self._assembly or assemble(self.mechanism, self.structure)

    @cached_property
    def nominal(self) -> Design:
        """The mechanism as it is."""
        return Design(self.mechanism, self.assembly.modes, {})

    def for_design(self, design: Design) -> MotionSolver:
        """The same assembly for a design with its changes made."""
        if not design.changes:
            return self.with_flips(())
        return MotionSolver(design.mechanism, Manner(self.manner.free), self.assembly)

    def with_flips(self, groups: Iterable[str]) -> MotionSolver:
        """The same mechanism, with assembly modes of some groups set per position."""
        flipping = frozenset(groups)
        if flipping == self.manner.flipping:
            return self
        return MotionSolver(self.mechanism, Manner(self.manner.free, flipping), self.assembly)

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs."""
        return self.programs.program(names)

    @cached_property
    def _own_tracker(self) -> BranchTracker:
        return self._tracker_of(self.nominal)

    def _tracker_of(self, design: Design) -> BranchTracker:
        return BranchTracker(self.with_flips(()).programs, self.assembly, design)

    def tracker(self, design: Design | None = None) -> BranchTracker:
        """What follows the groups without closed form."""
        return self._own_tracker if design is None or design is self.nominal else self._tracker_of(design)

    def track(
        self, positions: Positions, design: Design | None = None, separate: bool = False
    ) -> TrackedBranch | None:
        """The way of the groups without closed form, None if there are none; ``separate``: each position for
        itself."""
        if not self.motion.next_states:
            return None
        if self._assembly is not None or not (design is None or design is self.nominal):
            return track_branch(self.tracker(design), positions, separate)
        key = (positions.key, separate)
        return _ways.get(self.mechanism, key, lambda: track_branch(self._own_tracker, positions, separate))

    def states(self, positions: Positions, design: Design | None = None) -> dict[str, Floats]:
        """Chain coordinates of groups without closed form at every position."""
        found = self.track(positions, design)
        return {} if found is None else dict(found.states)

    def evaluate(
        self,
        names: tuple[str, ...],
        positions: Positions,
        states: Mapping[str, Floats],
        modes: Mapping[str, Floats],
        design: Design | None = None,
    ) -> Floats:
        """Outputs by name, shape (names, n)."""
        program = self.program(names)
        parameters = (design or self.nominal).parameters
        values = [parameters[name] for name in program.program.parameters]
        arrays = {**positions.arrays, **modes}
        return np.asarray(program.run(values, arrays, states, length=positions.count))


#: Of mechanisms as they are.
_ways: Recent[Mechanism, TrackedBranch] = Recent(16)
