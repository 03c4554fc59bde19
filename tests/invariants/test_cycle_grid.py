"""The pieces of a cycle: their polynomials meet the signals, however near the machine comes to a change point."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.metrics import Analysis
from linkwright.metrics.cycle_grid import SMOOTH


@pytest.mark.parametrize("frame", [4.0, 4.9, 4.99, 4.999])
def test_polynomials_meet_the_motion_between_their_points(frame: float) -> None:
    """Crank 1 m, coupler 3.5 m and rocker 2.5 m fold with a frame of 5 m."""
    machine = lw.load("gallery:crank_rocker").with_dimensions({"frame.O2.x": frame})
    motion = lw.solve_motion(machine)
    grid = Analysis.of(motion).grid
    assert grid is not None
    curve = grid.curve(lambda each: each.link("rocker").angular_velocity, "motion")
    assert curve.smooth.all()
    assert grid.tolerance == SMOOTH
    assert grid.edges[[0, -1]] == pytest.approx([0.0, motion.time[-1] * 360 / 359], rel=1e-12)
    time = np.random.default_rng(3).uniform(grid.start, grid.end, 400)
    exact = lw.solve_motion(machine, times=time).link("rocker").angular_velocity
    assert np.abs(curve(time) - exact).max() < 1e-9 * np.abs(exact).max()
