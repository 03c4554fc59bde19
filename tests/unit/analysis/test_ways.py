"""The pieces of a cycle: their polynomials meet the signals, and there are no more of them than bends ask for."""

import numpy as np
import pytest
from tests.invariants.rubbing import YOKE
from tests.invariants.turned_cams import UNEVEN
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import Analysis
from linkwright.curves.curve import Curve
from linkwright.cycle.summaries import Summary


@pytest.mark.parametrize("frame", [4.0, 4.9, 4.99, 4.999])
def test_polynomials_meet_the_motion_between_their_points(frame: float) -> None:
    """Crank 1 m, coupler 3.5 m and rocker 2.5 m fold with a frame of 5 m."""
    machine = stored("crank_rocker").with_dimensions({"frame.O2.x": frame})
    motion = lw.solve_motion(machine)
    cycle = Analysis.of(motion).cycle
    assert cycle is not None
    found = cycle.curve(lambda each: each.link("rocker").angular_velocity, "motion", 1)
    edges, values = found.edges, found.values
    curve = Curve(edges, values[0])
    assert edges[[0, -1]] == pytest.approx([0.0, motion.time[-1] * 360 / 359], rel=1e-12)
    time = np.random.default_rng(3).uniform(*edges[[0, -1]], 400)
    exact = lw.solve_motion(machine, times=time).link("rocker").angular_velocity
    assert np.abs(curve(time) - exact).max() < 1e-9 * np.abs(exact).max()


@pytest.mark.parametrize(("text", "most"), [(YOKE.replace("mass: 3 kg", "mass: 10 kg"), 40), (UNEVEN, 60)])
def test_a_cycle_is_cut_where_it_bends_and_nothing_is_halved(text: str, most: int) -> None:
    """Where friction or a lift bends the torque, few pieces meet everything."""
    machine = lw.loads(text.partition("  press:")[0])
    analysis = Analysis.of(lw.solve_forces(machine))
    assert np.isfinite([analysis.part(Summary.of(part)).value for part in ("driver.effort rms", "power mean")]).all()
    assert analysis.cycle is not None
    edges = analysis.cycle.curve(lambda forces: forces.input_torque, "forces", 1).edges
    assert len(edges) < most
