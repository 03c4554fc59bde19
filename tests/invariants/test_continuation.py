"""Groups without closed form: the same however many positions, in any order, and from either side."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import fsolve
from tests.invariants.output_driven import turning
from tests.refusals import refused
from tests.store import machine, motion, text
from tests.work import counted

import linkwright as lw

Floats = NDArray[np.float64]


@pytest.mark.rotating
def test_numbers_of_an_input_that_swings_often_take_no_more_work_at_few_positions() -> None:
    """Ten swings in 36 steps: no reading between two positions is sure, and each was followed by itself."""
    mechanism = lw.loads(
        text("stephenson_sixbar_triad").replace("t/(2 s)", "t/(0.2 s)").replace("cycle:", "cycle: {duration: 2 s}\n#")
    )
    found = []
    for steps in (36, 720):
        forces = lw.solve_forces(lw.solve_motion(mechanism, steps=steps))
        table, calls = counted(lambda forces=forces: lw.metrics(forces))
        found.append(({(row.metric, row.subject): row.value for row in table.rows}, calls))
    (few, work_of_few), (many, work_of_many) = found
    assert few.keys() == many.keys() and len(few) > 10
    for key, value in many.items():
        assert few[key] == pytest.approx(value, rel=1e-7, abs=1e-9), key
    assert work_of_few < 3.0 * work_of_many


def test_positions_in_any_order_are_reached_one_from_the_other() -> None:
    triad = motion("triad", 36)
    order = np.array([20, 3, 35, 0, 11, 12])
    there = lw.solve_motion(triad.mechanism, at=triad.input[order])
    assert there.ok.all()
    for link in triad.mechanism.links:
        assert there.link(link).direction == pytest.approx(triad.link(link).direction[order], abs=1e-11)


def test_a_drawing_far_from_every_assembly_is_refused_with_its_inputs() -> None:
    far = lw.loads(turning(1).replace("length: 190 mm", "length: 900 mm"))
    with refused("motion.not_near_drawing", name="six-bar", value="160.076°"):
        lw.solve_motion(far, steps=12)


PLATFORM = """
format: 1
name: Platform on three cylinders
frame: {points: {A: [0 m, 0 m], B: [2 m, 0 m], C: [1 m, 1.8 m]}}
links:
  base_a: {points: [A]}
  base_b: {points: [B]}
  base_c: {points: [C]}
  rod_a: {points: [D]}
  rod_b: {points: [E]}
  rod_c: {points: [F]}
  platform: {points: {D: [0 m, 0 m], E: [0.5 m, 0 m], F: [0.25 m, 0.45 m]}}
joints:
  leg_a: {kind: prismatic, guide: base_a, through: A, direction: WAY, block: rod_a, at: D, offset: 0.1 m}
  leg_b: {kind: prismatic, guide: base_b, through: B, direction: WAY, block: rod_b, at: E, offset: 0.1 m}
  leg_c: {kind: prismatic, guide: base_c, through: C, direction: WAY, block: rod_c, at: F, offset: 0.1 m}
drawing: {D: [0.7 m, 0.5 m], E: [1.2 m, 0.6 m], F: [0.86 m, 0.97 m]}
drivers:
  a: {slide: leg_a, position: "SIGN*(0.86 m + 0.02 m/s*t)"}
  b: {slide: leg_b, position: "SIGN*1.02 m"}
  c: {slide: leg_c, position: "SIGN*0.84 m"}
cycle: {duration: 1 s}
"""


@pytest.mark.parametrize(("way", "sign"), [("0 deg", "1"), ("120 deg", "-1")])
def test_cylinders_are_drawn_by_their_two_pins(way: str, sign: str) -> None:
    motion = lw.solve_motion(lw.loads(PLATFORM.replace("WAY", way).replace("SIGN", sign)), steps=4)
    base, corners = np.array([[0, 0], [2, 0], [1, 1.8]]), np.array([[0, 0], [0.5, 0], [0.25, 0.45]])
    for i, t in enumerate(motion.time):

        def closed(pose: Floats, lengths: Floats) -> Floats:
            c, s = np.cos(pose[2]), np.sin(pose[2])
            return np.hypot(*(pose[:2] + corners @ np.array([[c, s], [-s, c]]) - base).T) - lengths

        lengths = np.hypot([0.86 + 0.02 * t, 1.02, 0.84], 0.1)
        x, y, angle = fsolve(closed, [0.7, 0.5, 0.2], args=(lengths,), xtol=1e-13)
        np.testing.assert_allclose(motion.point("D").position[i], [x, y], atol=1e-9)
        assert motion.link("platform").angle[i] == pytest.approx(angle, abs=1e-9)


def test_on_a_line_of_two_drivers_what_is_reached_is_reached_from_either_side() -> None:
    """A block of its own is pushed as the crank turns, at no time of their laws: the last position, behind a stretch
    out of reach, is reached the other way round, as it is where the crank turns alone."""
    pair = turning(1).replace("driver: {", "drivers:\n  driver: {")
    pair = pair.replace("links:\n", "links:\n  block: {points: [Z]}\n", 1)
    joints = "joints: {bed: {kind: prismatic, guide: frame, through: O1, direction: 0 deg, block: block, at: Z}}\n"
    pushed = lw.loads(joints.lstrip() + pair.lstrip() + "  push: {slide: bed, speed: 0.1 m/s}\n")
    q = np.radians(160.0 + np.linspace(0.0, 350.0, 9))
    one = lw.solve_motion(lw.loads(turning(1)), at=q, failures="mark")
    two = lw.solve_motion(pushed, at={"driver": q, "push": 0.5 + 0.2 * np.arange(9)}, failures="mark")
    assert one.ok.tolist() == two.ok.tolist() == [True, *[False] * 7, True]
    for link in one.mechanism.links:
        assert two.link(link).direction == pytest.approx(one.link(link).direction, abs=1e-9, nan_ok=True)


def test_results_of_a_second_sweep_are_those_of_the_first() -> None:
    """What is kept of a mechanism serves every sweep of it, to the bit."""

    def swept(triad: lw.Mechanism) -> lw.Sweep:
        lengths = triad.dimension("bar_1.P.x") * np.linspace(0.999, 1.001, 4)
        return lw.sweep(triad, {"bar_1.P.x": lengths}, outputs=["input_torque rms"], steps=48)

    fresh = lw.load("gallery:triad")
    first, second, anew = swept(fresh), swept(fresh), swept(machine("triad"))
    assert np.isfinite(first["input_torque", "rms"]).all()
    for each in (second, anew):
        assert np.array_equal(each["input_torque", "rms"], first["input_torque", "rms"])
        assert each.branch_margin is not None and first.branch_margin is not None
        assert np.array_equal(each.branch_margin, first.branch_margin)
