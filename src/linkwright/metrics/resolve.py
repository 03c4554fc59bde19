"""A motion and its forces solved again at other times of the same cycle."""

from __future__ import annotations

from typing import Any

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import Floats, at_times
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.rows import Rows
from linkwright.kinetostatics.forces import Forces


class Resolver:
    """Solves the design of a motion at further times, with the programs that are there already."""

    def __init__(self, motion: Motion, forces: Forces | None) -> None:
        self._motion = motion
        self._forces = forces
        self.in_time = _follows_laws(motion)
        self.possible = self.in_time and not motion.modes

    def at(self, time: Floats, of: str = "motion") -> Any:
        """Motion, or Forces with ``of="forces"``, at some times, s."""
        motion = self.motion(time)
        return self.forces(motion) if of == "forces" else motion

    def motion(self, time: Floats) -> Motion:
        """Motion at some times; positions out of reach are NaN."""
        known = self._motion
        positions = at_times(known.mechanism, time)
        states = known.solver.states(positions, known.design)
        names = tuple(known.solver.outputs.standard())
        values = known.solver.evaluate(names, positions, states, {}, known.design)
        barred = np.zeros(positions.count)
        for row in states.values():
            barred = np.where(np.isfinite(row), barred, 1.0)
        rows = Rows(values, {name: i for i, name in enumerate(names)})
        motion = Motion(known.solver, known.design, positions, states, {}, rows, (), barred)
        values[:-1, ~motion.ok] = np.nan
        return motion

    def forces(self, motion: Motion) -> Forces:
        """Forces of such a motion."""
        from linkwright.kinetostatics import run

        assert self._forces is not None
        solver = self._forces.solver
        fields = run._load_fields(motion, solver)
        if solver.friction.terms:
            fields = run._with_friction(motion, solver, fields)
        return run._evaluated(motion, solver, fields, self._forces.static)

    def input_at(self, time: float) -> float:
        """Coordinate of the first driver at a time."""
        law = next(iter(self._motion.mechanism.drivers.values())).law
        return float(law.coordinate(np.array([time]))[0][0])


def _follows_laws(motion: Motion) -> bool:
    """Whether the positions are those of the drivers' laws at their times."""
    if not motion.mechanism.drivers:
        return False
    try:
        expected = at_times(motion.mechanism, motion.time)
    except LinkwrightError:
        return False
    return all(
        np.allclose(expected.coordinates[name][0], rows[0], rtol=0, atol=1e-9 * (1 + np.abs(rows[0]).max()))
        for name, rows in motion.positions.coordinates.items()
    )
