"""Motion and forces at states of a mechanism under forces that were found: its inputs, their rates and accelerations.

They are read like those of a motion that drivers prescribe; every row comes from the equation of motion's own trace,
its comparisons held as they are there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Protocol

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.positions import Positions
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import contacts_lost
from linkwright.kinetostatics.solver import ForceSolver, in_words

#: Inputs of the equation's programs by name, (n,) each or one number.
Given = Mapping[str, Floats | float]


class Found(Protocol):
    """States at n times, as what motions and forces over them are read from."""

    @property
    def equation(self) -> EquationOfMotion: ...
    @property
    def positions(self) -> Positions: ...
    @property
    def states(self) -> Mapping[str, Floats]: ...
    @property
    def modes(self) -> Mapping[str, Floats]: ...

    def rows(self, names: tuple[str, ...], *, forces: bool) -> Floats:
        """Rows of the motion, or of it and its forces, by name (see ``core.outputs``), (names, n)."""
        ...

    def values(self, outputs: Callable[[ForceSolver], dict[str, Scalar]]) -> Floats:
        """Values of the trace of motion and forces by any names, (outputs, n), that it names of a solver."""
        ...


@dataclass(eq=False, repr=False)
class FoundMotion(Motion):
    """The motion at states that were found; see :class:`linkwright.Motion`."""

    by_law: ClassVar[bool] = False
    found: Found = field(kw_only=True)

    def evaluate(self, names: tuple[str, ...]) -> Floats:
        """Outputs by name, (names, n), in the user's words as well; NaN where a position was not reached."""
        values = self.found.rows(names, forces=any(map(in_words, names)))
        if not self.ok.all():
            values[:, ~self.ok] = np.nan
        return values


@dataclass(eq=False, repr=False)
class FoundForces(Forces):
    """The forces at states that were found; see :class:`linkwright.Forces`. The effort of a driver that is free is
    zero but for rounding."""

    found: Found = field(kw_only=True)

    def evaluate(self, names: tuple[str, ...]) -> Floats:
        """Outputs by name, (names, n); NaN where a position was not reached."""
        values = self.found.rows(names, forces=True)
        if not self.motion.ok.all():
            values[:, ~self.motion.ok] = np.nan
        return values

    def evaluate_traced(self, outputs: Callable[[ForceSolver], dict[str, Scalar]]) -> Floats:
        """Values of the trace of motion and forces, (outputs, n)."""
        return self.found.values(outputs)


def motion_at(found: Found) -> FoundMotion:
    """The motion at states that were found."""
    solver = found.equation.solver
    names = solver.outputs.standard
    values = found.rows(names, forces=False)
    values[:-1, values[-1] != 0.0] = np.nan
    rows = Rows(values, solver.programs.places(names))
    return FoundMotion(solver, solver.nominal, found.positions, rows, found.states, found.modes, found=found)


def forces_at(motion: FoundMotion) -> FoundForces:
    """The forces at the states of a motion.

    Raises SelfCheckError where they do not balance, or their powers are not those of the drivers.
    """
    solver = motion.found.equation.forces
    names = solver.programs.checks.names
    values = motion.found.rows(names, forces=True)
    values[:, ~motion.ok] = np.nan
    rows = Rows(values, {name: place for place, name in enumerate(names)})
    solver.programs.checks.require(rows, motion)
    forces = FoundForces(motion, solver, {}, False, rows, found=motion.found)
    forces.notes = tuple(contacts_lost(forces))
    return forces
