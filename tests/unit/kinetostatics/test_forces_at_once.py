"""Motion and forces in one evaluation are those of one after the other."""

import numpy as np
import pytest
from tests.invariants.loaded_presses import LOADS, machine

import linkwright as lw
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.run import forces_at_once, run_forces

pytestmark = pytest.mark.rotating


@pytest.mark.parametrize("load", LOADS)
def test_loads_traced_with_the_motion_are_those_found_from_it(load: str) -> None:
    """One evaluation of motion, limits, loads and forces, beside magnitudes found from the motion on arrays."""
    mechanism = machine(load)
    run = MotionRun(MotionSolver(mechanism), over_cycle(mechanism, 360))
    together, apart = forces_at_once(run, False), run_forces(lw.solve_motion(mechanism), False)
    assert together is not None
    for name, expected in apart.fields.items():
        assert together.fields[name] == pytest.approx(expected, rel=1e-13, abs=1e-13 * np.abs(expected).max())
    torque = apart.input_torque
    assert np.abs(together.input_torque - torque).max() <= 1e-13 * np.abs(torque).max()
