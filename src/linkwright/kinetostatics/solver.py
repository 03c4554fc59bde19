"""Motion and forces of one mechanism evaluated together."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.friction import FrictionTerms
from linkwright.kinetostatics.outputs import ForceOutputs
from linkwright.kinetostatics.programs import ForcePrograms, force_programs
from linkwright.kinetostatics.trace import ForceTrace


class ForceSolver:
    """Evaluates the forces of a motion solver's mechanism."""

    def __init__(
        self,
        motion: MotionSolver,
        *,
        inertia: bool = True,
        along_input: frozenset[str] = frozenset(),
        rubbing: bool = False,
    ) -> None:
        self.motion = motion
        self.inertia = inertia
        self.along_input = along_input
        self.rubbing = rubbing

    def __getstate__(self) -> dict[str, Any]:
        """All but what every process makes for itself."""
        return {name: each for name, each in self.__dict__.items() if name not in ("programs", "friction")}

    @cached_property
    def programs(self) -> ForcePrograms:
        """The programs of the mechanism's shape."""
        return force_programs(
            self.motion.programs, inertia=self.inertia, along_input=self.along_input, rubbing=self.rubbing
        )

    @cached_property
    def friction(self) -> FrictionTerms:
        """Friction of the mechanism's joints."""
        return FrictionTerms.of(self.motion.mechanism, self.motion.motion)

    @property
    def forces(self) -> ForceTrace:
        """Reactions and efforts as traced values."""
        return self.programs.forces

    @property
    def outputs(self) -> ForceOutputs:
        """The forces' outputs by name."""
        return self.programs.outputs

    def program(self, names: tuple[str, ...]) -> NumpyProgram:
        """The program for some outputs, of the forces or of the motion."""
        return self.programs.program(names)

    def fields_needed(self) -> tuple[str, ...]:
        """Inputs per position that are found from the motion: load magnitudes, angles, friction."""
        carried = self.motion.motion.next_states
        return tuple(name for name in self.program(self.programs.checks.names).program.fields if name not in carried)

    def evaluate(self, names: tuple[str, ...], motion: Motion, fields: Mapping[str, Floats]) -> Floats:
        """Outputs by name, shape (names, n)."""
        program = self.program(names)
        values = [motion.design.parameters[name] for name in program.program.parameters]
        arrays = {**motion.positions.arrays, **motion.modes}
        states_and_fields = {**motion.states, **fields}
        return np.asarray(program.run(values, arrays, states_and_fields, length=motion.steps))
