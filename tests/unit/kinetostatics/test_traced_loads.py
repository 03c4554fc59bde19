"""Loads that are traced with the forces are those found from the motion on arrays."""

import numpy as np
import pytest
from tests.invariants.loaded_presses import LOADS, machine

import linkwright as lw
from linkwright.applied_loads.over_cycle import evaluate
from linkwright.core.outputs import row_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.solver import ForceSolver

pytestmark = pytest.mark.rotating


@pytest.mark.parametrize("load", LOADS)
def test_loads_traced_with_the_forces_are_those_found_from_the_motion(load: str) -> None:
    forces = lw.solve_forces(machine(load))
    motion, signals = forces.motion, MotionSignals(forces.motion)
    fields = {row_name("magnitude", name): evaluate(each, signals) for name, each in motion.mechanism.loads.items()}
    for name, found in forces.fields.items():
        assert found == pytest.approx(fields[name], rel=1e-13, abs=1e-13 * np.abs(fields[name]).max())
    want = ForceSolver(motion.solver).evaluate(tuple(forces.rows.index), motion, fields)
    for found, expected in zip(forces.rows.values, want, strict=True):
        assert np.abs(found - expected).max() <= 1e-13 * np.abs(want).max()
