"""Motion and forces at states of a mechanism under forces that were found: its inputs, their rates and accelerations.

They are read like those of a motion that drivers prescribe; every row comes from the equation of motion's own trace,
its comparisons held as they are there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Protocol

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.formula.program import Program
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


@dataclass
class FoundStates:
    """States at n times: ``held`` are switches by name, (n,) each, with their share in what acts: one alone where all
    that rubs slides, those of both senses where it sticks."""

    equation: EquationOfMotion
    positions: Positions
    held: Sequence[tuple[Floats | float, Given]]
    states: Mapping[str, Floats] = field(default_factory=dict)
    modes: Mapping[str, Floats] = field(default_factory=dict)
    _programs: dict[tuple[str, ...], Program] = field(default_factory=dict, init=False, repr=False)

    @property
    def given(self) -> dict[str, Floats | float]:
        """Inputs of the programs but for the switches."""
        found: dict[str, Floats | float] = {"time": self.positions.time, **self.states, **self.modes}
        for name, (q, rate, second) in self.positions.coordinates.items():
            found |= {f"q:{name}": q, f"qd:{name}": rate, Input("second", name).name: second}
        return found

    def rows(self, names: tuple[str, ...], *, forces: bool) -> Floats:
        """As :meth:`Found.rows`."""
        key = (*names, str(forces))
        if key not in self._programs:
            self._programs[key] = self.equation.row_program(names, forces=forces)
        return self._blended(self._programs[key])

    def values(self, outputs: Callable[[ForceSolver], dict[str, Scalar]]) -> Floats:
        """As :meth:`Found.values`."""
        return self._blended(self.equation.value_program(outputs(self.equation.forces)))

    def _blended(self, program: Program) -> Floats:
        found = [
            share * self.equation.run(program, {**self.given, **switches}, self.positions.count)
            for share, switches in self.held
        ]
        return np.asarray(sum(found))


def together(found: Sequence[FoundStates]) -> FoundStates:
    """States of one equation, one after the other."""
    first = found[0]
    coordinates = {
        name: tuple(np.concatenate([each.positions.coordinates[name][k] for each in found]) for k in range(3))
        for name in first.positions.coordinates
    }
    time = np.concatenate([each.positions.time for each in found])
    positions = Positions(time, coordinates, first.positions.rotary)  # type: ignore[arg-type]
    held = []
    for way in range(max(len(each.held) for each in found)):
        ways = [(each.held[way], 1.0) if way < len(each.held) else (each.held[0], 0.0) for each in found]
        shares = np.array([share * counts for (share, _switches), counts in ways])
        switches = {name: np.array([own[name] for (_share, own), _counts in ways]) for name in first.held[0][1]}
        held.append((shares, switches))
    states = {name: np.concatenate([each.states[name] for each in found]) for name in first.states}
    return FoundStates(first.equation, positions, held, states)


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
