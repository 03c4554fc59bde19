"""Where parts of a joint never move against each other only rounding would tell a direction, so nothing rubs."""

import math
import re

import numpy as np
import pytest
from tests.invariants.brackets import BRACKET

import linkwright as lw

#: A block on a guide of the crank, held in its place by a bar from the crank.
GUIDE = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: {O: [0 m, 0 m], P: [0.1 m, 0.2 m], G: [0 m, 0.07 m]}}
  bar: {points: [P, S], length: 0.23 m}
  block: {points: {S: [0 m, 0 m]}, mass: 3 kg, inertia: 0.02 kg·m²}
joints:
  guide: {kind: prismatic, guide: crank, through: G, direction: 20 deg, block: block, at: S, block_angle: 0 deg,
    friction: 0.2}
drawing: {S: [0.3 m, 0.179 m]}
driver: {turn: crank, about: O, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
"""


def smooth(text: str) -> lw.Mechanism:
    """The machine without friction."""
    return lw.loads(re.sub(r"(, pin_radius: 20 mm)?,\s+friction: 0\.\d", "", text))


def reactions(forces: lw.Forces) -> np.ndarray:
    joints = forces.mechanism.joints.values()
    return np.stack([forces.reaction(each.name, on=each.joined[-1]) for each in joints if each.coordinate])


@pytest.mark.parametrize("text", [BRACKET, GUIDE])
@pytest.mark.parametrize("steps", [1, 7, 36])
def test_a_joint_that_never_moves_has_no_friction(text: str, steps: int) -> None:
    rubbing = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=steps))
    free = lw.solve_forces(lw.solve_motion(smooth(text), steps=steps))
    assert reactions(rubbing) == pytest.approx(reactions(free), rel=1e-12, abs=1e-12)
    assert rubbing.input_torque == pytest.approx(free.input_torque, rel=1e-12, abs=1e-12)


def centre(long: float) -> np.ndarray:
    """Mass centre, m, of the bar between Q and T in the axes of the crank; T left of the ray from P to Q."""
    p, q = np.array([0.3, 0.0]), np.array([0.5, 0.1])
    apart = math.dist(p, q)
    along = (apart**2 + 0.3**2 - long**2) / (2.0 * apart)
    unit = (q - p) / apart
    t = p + along * unit + math.sqrt(0.3**2 - along**2) * np.array([-unit[1], unit[0]])
    return np.asarray(0.5 * (q + t))


def torque(long: float, steps: int) -> np.ndarray:
    """m g x of the bar's mass centre, N·m: turned steadily as one body it takes no other torque."""
    x, y = centre(long)
    turn = np.linspace(0.0, 2.0 * np.pi, steps, endpoint=False)
    return np.asarray(5.0 * 9.81 * (x * np.cos(turn) - y * np.sin(turn)))


def test_designs_side_by_side_and_their_gradients_rub_where_they_move_only() -> None:
    machine, lengths, steps = lw.loads(BRACKET), np.array([0.21, 0.25, 0.3]), 36
    swept = lw.sweep(machine, {"bar_2.length": lengths}, outputs=["driver.effort max"], steps=steps)
    assert swept["driver.effort max"] == pytest.approx([torque(a, steps).max() for a in lengths], rel=1e-12)
    prepared = lw.prepare(machine, vary=["bar_2.length"], steps=steps)
    for each in lengths:
        found = prepared.solve({"bar_2.length": each}).input_torque
        assert found == pytest.approx(torque(each, steps), rel=1e-12, abs=1e-11)
    metrics = ["peak_input_torque driver", "bearing_pv T"]
    study = lw.study(machine, {"bar_2.length": lengths.tolist()}, metrics=metrics, steps=steps)
    peaks = [5.0 * 9.81 * np.hypot(*centre(each)) for each in lengths]
    assert study[metrics[0]] == pytest.approx(peaks, rel=1e-12)
    assert study[metrics[1]] == pytest.approx(0.0, abs=1e-30)
    slope = lw.sensitivity(machine, of=["driver.effort rms"], by=["bar_2.length"], steps=steps)
    h = 1e-6
    rms = [np.hypot(*centre(0.25 + step)) * 5.0 * 9.81 / math.sqrt(2.0) for step in (-h, h)]
    assert slope.gradient("driver.effort rms") == pytest.approx((rms[1] - rms[0]) / (2.0 * h), rel=1e-8)


OPPOSED = """
format: 1
frame: {points: {A: [0 m, 0 m], B: [0.41 m, 0.13 m]}}
links:
  crank: {points: [A, C], length: 0.17 m}
  coupler: {points: {C: [0 m, 0 m], D: [0.41 m, 0.13 m]}, mass: 2 kg}
  rocker: {points: [B, D], length: 0.17 m}
drawing: {C: [0.12 m, 0.12041594578792295 m], D: [0.53 m, 0.25041594578792295 m]}
driver: {turn: crank, about: A, speed: 60 rpm}
cycle: {from: 30 deg, to: 120 deg}
loads: {drag: {kind: torque, on: coupler, opposes: velocity, magnitude: 7 N·m}}
"""


@pytest.mark.parametrize("steps", [1, 5, 36])
def test_nothing_opposes_a_link_that_never_turns(steps: int) -> None:
    machine = lw.loads(OPPOSED)
    forces = lw.solve_forces(lw.solve_motion(machine, steps=steps))
    assert forces.load("drag").moment == pytest.approx(0.0, abs=0.0)
    assert forces.input_torque == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("steps", [1, 4, 36])
def test_a_slider_in_its_dead_centre_has_no_friction(steps: int) -> None:
    """Its only force across the guide is its weight; along it, its inertia."""
    machine = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.3 m}
  slider: {points: {B: [0 m, 0 m]}, mass: 2 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B, friction: 0.4}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm, start: 180 deg}
gravity: [0, -9.81 m/s²]
""")
    forces = lw.solve_forces(lw.solve_motion(machine, steps=steps))
    second = forces.motion.joint("guide").acceleration[0]
    assert forces.reaction("B", on="slider")[0, 0] == pytest.approx(2.0 * second, rel=1e-12)
