"""What the programs of forces take per design and position: load magnitudes, angles, friction."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.errors import LinkwrightError
from linkwright.kinematics.design import Design
from linkwright.kinematics.explain import refusal
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.rows import Rows
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.signals import STEPS
from linkwright.study.traced import Traced

Floats = NDArray[np.float64]


class DesignFields:
    """Inputs per position, found design by design from its own motion."""

    def __init__(self, traced: Traced) -> None:
        self.traced = traced
        closed = traced.positions.closed and traced.positions.count >= STEPS
        self.shared = closed and not traced.solver.motion.next_states

    def of(self, names: tuple[str, ...], changes: Mapping[str, float]) -> dict[str, Floats]:
        """The inputs (n,) by name; raises LinkwrightError where a load or the motion fails for this design."""
        forces = run_forces(self.motion(changes), False)
        return {name: forces.fields[name] for name in names}

    def motion(self, changes: Mapping[str, float]) -> Motion:
        """The motion of a design; positions that are not reached are marked."""
        traced = self.traced
        if self.shared:
            solver = traced.solver
            design = Design(traced.mechanism, solver.assembly.modes, changes)
        else:
            solver = MotionSolver(traced.mechanism.with_dimensions(changes))
            design = solver.nominal
        return evaluated(solver, design, traced)


def evaluated(solver: MotionSolver, design: Design, traced: Traced) -> Motion:
    """The motion of one design over the study's positions."""
    positions = traced.positions
    states = solver.states(positions, design)
    names = tuple(solver.outputs.standard())
    values = solver.evaluate(names, positions, states, {}, design)
    barred = np.zeros(positions.count)
    for row in states.values():
        barred = np.where(np.isfinite(row), barred, 1.0)
    values[:-1, (values[-1] != 0.0) | (barred != 0.0)] = np.nan
    index = {name: i for i, name in enumerate(names)}
    return Motion(solver, design, positions, states, {}, Rows(values, index), (), barred)


def fields_of_designs(
    traced: Traced, names: tuple[str, ...], columns: Mapping[str, Floats]
) -> tuple[dict[str, Floats], dict[int, str]]:
    """Inputs (designs, n) by name, and the sentences of the designs for which they cannot be found."""
    designs, n = len(next(iter(columns.values()))), traced.positions.count
    rows = {name: np.zeros((designs, n)) for name in names}
    failed: dict[int, str] = {}
    source = DesignFields(traced)
    for index in range(designs):
        changes = {address: float(column[index]) for address, column in columns.items()}
        try:
            for name, row in source.of(names, changes).items():
                rows[name][index] = row
        except LinkwrightError as error:
            failed[index] = str(error)
    return rows, failed


def sentence_of(traced: Traced, changes: Mapping[str, float]) -> str:
    """Why a design cannot pass its cycle."""
    try:
        motion = DesignFields(traced).motion(changes)
        return "" if motion.ok.all() else str(refusal(motion))
    except LinkwrightError as error:
        return str(error)
