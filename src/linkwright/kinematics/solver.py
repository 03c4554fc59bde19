"""A mechanism made ready to be solved many times: structure, assembly, traced programs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np

from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.kinematics.assembly import Assembly, assemble
from linkwright.kinematics.continuation import Follower
from linkwright.kinematics.cycle import Floats, Positions
from linkwright.kinematics.design import Design
from linkwright.kinematics.outputs import MotionOutputs
from linkwright.kinematics.trace import MotionTrace, trace_motion
from linkwright.model.mechanism import Mechanism
from linkwright.structure import Structure


class MotionSolver:
    """Programs of one mechanism, traced when first needed."""

    def __init__(self, mechanism: Mechanism, free: frozenset[str] = frozenset()) -> None:
        self.mechanism = mechanism
        self.free = free
        self._programs: dict[tuple[str, ...], NumpyProgram] = {}
        self.point_keys: dict[str, str] = {}
        self.flipping: frozenset[str] = frozenset()
        self.iterations = 1

    @cached_property
    def structure(self) -> Structure:
        from linkwright.kinematics.rank import analysed

        return analysed(self.mechanism)

    @cached_property
    def assembly(self) -> Assembly:
        return assemble(self.mechanism, self.structure)

    @cached_property
    def motion(self) -> MotionTrace:
        return trace_motion(
            self.mechanism,
            self.structure,
            free=self.free,
            modes_vary=self.flipping,
            iterations=self.iterations,
        )

    @cached_property
    def outputs(self) -> MotionOutputs:
        return MotionOutputs(self.motion)

    @cached_property
    def nominal(self) -> Design:
        """The mechanism as it is."""
        return Design(self.mechanism, self.assembly.modes, {})

    def for_design(self, design: Design) -> MotionSolver:
        """The same structure and assembly for a design with its changes made."""
        if not design.changes:
            return self.with_flips(()) if self.flipping else self
        other = MotionSolver(design.mechanism, self.free)
        other.__dict__["structure"] = self.structure
        other.__dict__["assembly"] = self.assembly
        return other

    def with_flips(self, groups: Iterable[str]) -> MotionSolver:
        """The same mechanism, with assembly modes of some groups given per position."""
        other = MotionSolver(self.mechanism, self.free)
        other.flipping = frozenset(groups)
        other.__dict__["structure"] = self.structure
        other.__dict__["assembly"] = self.assembly
        return other

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs."""
        if names not in self._programs:
            values = {name: self.outputs.value(name) for name in names}
            self._programs[names] = NumpyProgram(Program.of(self.motion.trace, values))
        return self._programs[names]

    def states(self, positions: Positions, design: Design | None = None) -> dict[str, Floats]:
        """Chain coordinates of groups without closed form at every position."""
        if not self.motion.next_states:
            return {}
        parameters = (design or self.nominal).parameters
        return Follower(self.mechanism, self.structure, self.assembly, parameters, self.free).follow(
            positions
        )

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
        return np.asarray(program.run(values, arrays, None, states or None, length=positions.count))
