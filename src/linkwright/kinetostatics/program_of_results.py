"""The straight-line program of everything that a result holds."""

from __future__ import annotations

from linkwright.formula.program import Program
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism


def program_of_results(mechanism: Mechanism, *, forces: bool) -> Program:
    """The program of a motion, or of a motion with its joint forces."""
    solver = MotionSolver(mechanism)
    names = solver.outputs.standard
    if not forces:
        return solver.program(names).program
    with_forces = ForceSolver(solver)
    return with_forces.program((*names[:-1], *with_forces.outputs.standard)).program
