"""Static torque of a four-bar with a change point (frame 4, crank 1, coupler 3, rocker 2 m), crank at 30°."""

import numpy as np
import pytest

import linkwright as lw


def test_static_torque() -> None:
    motion = lw.solve_motion(lw.load("gallery:change_point_fourbar"), at=np.radians(30.0))
    forces = lw.solve_forces(motion, static=True)
    assert forces.input_torque[0] == pytest.approx(21.085597076442, abs=1e-11)


def test_dynamic_torque_agrees_with_the_powers() -> None:
    motion = lw.solve_motion(lw.load("gallery:change_point_fourbar"), at=np.radians(30.0))
    forces = lw.solve_forces(motion)
    assert forces.input_torque[0] != pytest.approx(21.085597076442, abs=1e-3)
    assert forces.input_torque_from_power == pytest.approx(forces.input_torque, rel=1e-12)
