"""Programs of motion and forces together, for one mechanism."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.friction import FrictionTerms
from linkwright.kinetostatics.outputs import ForceOutputs
from linkwright.kinetostatics.trace import ForceTrace, trace_forces


class ForceSolver:
    """Traces the forces of a motion solver's mechanism."""

    def __init__(self, motion: MotionSolver, *, inertia: bool = True) -> None:
        self.motion = motion
        self.inertia = inertia
        self._programs: dict[tuple[str, ...], NumpyProgram] = {}

    @cached_property
    def friction(self) -> FrictionTerms:
        return FrictionTerms.of(self.motion.motion)

    @cached_property
    def forces(self) -> ForceTrace:
        return trace_forces(self.motion.motion, inertia=self.inertia, extra=self.friction.wrenches())

    @cached_property
    def outputs(self) -> ForceOutputs:
        return ForceOutputs(self.forces)

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs, of the forces or of the motion."""
        if names not in self._programs:
            values = {name: self._value(name) for name in names}
            self._programs[names] = NumpyProgram(Program.of(self.motion.motion.trace, values))
        return self._programs[names]

    def _value(self, name: str):  # type: ignore[no-untyped-def]
        if name.split(":", maxsplit=1)[0] in {"p", "v", "a", "e", "w", "g", "s", "sv", "sa"}:
            return self.motion.outputs.value(name)
        return self.outputs.value(name)

    def fields_needed(self) -> tuple[str, ...]:
        """Inputs per position that are found from the motion: load magnitudes, angles, friction."""
        names = tuple(self.outputs.standard())
        return self.program(names).program.fields

    def evaluate(
        self,
        names: tuple[str, ...],
        motion: Motion,
        fields: Mapping[str, Floats],
    ) -> Floats:
        """Outputs by name, shape (names, n)."""
        program = self.program(names)
        values = [motion.design.parameters[name] for name in program.program.parameters]
        positions, states = motion.positions, motion.states
        arrays = {**positions.arrays, **motion.modes}
        given = {name: fields[name] for name in program.program.fields}
        return np.asarray(program.run(values, arrays, given, states or None, length=positions.count))
