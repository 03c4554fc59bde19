"""Runs under forces against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw

BLOCK = """
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{block: {{points: [B], mass: 2 kg}}}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: {direction}, block: block, at: B{friction}}}
driver: {{slide: guide, speed: 1 m/s}}
cycle: {{duration: 1 s}}
gravity: [0, -10 m/s²]
"""


def block(direction: str, friction: str = "", more: str = "") -> lw.Mechanism:
    """A block of 2 kg on a straight guide."""
    return lw.loads(BLOCK.format(direction=direction, friction=friction) + more)


def test_a_falling_block_obeys_galileo() -> None:
    run = lw.run(block("90 deg"), duration=2.0, at=30.0, speed=3.0)
    assert run.end_state["driver"] == pytest.approx((30.0 + 6.0 - 20.0, -17.0), rel=1e-12)
    assert run.energy_residual < 1e-12


def test_a_block_that_rubs_comes_to_rest_and_stays() -> None:
    """On a level guide v²/(2 μ g), after v/(μ g)."""
    run = lw.run(block("0 deg", ", friction: 0.3"), until="rest", speed=6.0)
    assert run.end == pytest.approx(6.0 / 3.0, rel=1e-10)
    assert run.end_state["driver"][0] == pytest.approx(36.0 / 6.0, rel=1e-10)
    assert run.end_state["driver"][1] == pytest.approx(0.0, abs=1e-12)
    assert [each.kind for each in run.events][-1] == "rest"


@pytest.mark.parametrize(("slope", "stays"), [(16.0, True), (17.5, False)])
def test_friction_holds_a_block_on_a_slope_up_to_its_angle(slope: float, stays: bool) -> None:
    """atan 0.3 = 16.7°: below it the block comes to rest, above it slides back at g (sin - μ cos)."""
    angle = math.radians(slope)
    run = lw.run(block(f"{slope} deg", ", friction: 0.3"), duration=3.0, speed=2.0)
    up = 2.0 / (10.0 * (math.sin(angle) + 0.3 * math.cos(angle)))
    down = 10.0 * (math.sin(angle) - 0.3 * math.cos(angle))
    q, w = run.end_state["driver"]
    assert w == pytest.approx(0.0 if stays else -down * (3.0 - up), abs=1e-9)
    assert q == pytest.approx(1.0 * up - (0.0 if stays else 0.5 * down * (3.0 - up) ** 2), rel=1e-9)
    pressed = run.joint_forces(times=[0.1, 2.9]).reaction("guide", on="block")
    assert np.hypot(*pressed.T) == pytest.approx([20.0 * math.cos(angle)] * 2, rel=1e-9)


def test_a_bouncing_ball_loses_the_square_of_the_restitution() -> None:
    """Flights of e^k √(8 h/g), together √(2 h/g) (1 + e)/(1 - e); then it lies still and presses with its weight."""
    stops = "stops: {floor: {of: B.y, at: 0 m, side: below, restitution: 0.5}}\n"
    run = lw.run(block("90 deg", more=stops), duration=2.0, at=0.8)
    impacts = [each.time for each in run.events if each.kind == "impact"]
    first = math.sqrt(2.0 * 0.8 / 10.0)
    assert impacts[0] == pytest.approx(first, rel=1e-12)
    assert np.diff(impacts)[:6] == pytest.approx([2.0 * first * 0.5**k for k in range(1, 7)], rel=1e-9)
    assert impacts[-1] == pytest.approx(first * 3.0, rel=1e-5)
    assert run.end_state["driver"] == pytest.approx((0.0, 0.0), abs=1e-9)
    assert run.events[0].value == pytest.approx(1.5 * 2.0 * math.sqrt(2.0 * 10.0 * 0.8), rel=1e-10)
    assert run.energy_residual < 1e-9


def test_a_rod_swings_with_the_period_of_the_elliptic_integral() -> None:
    """T = 4 √(J/(m g r)) K(sin² φ/2)."""
    from scipy.special import ellipk

    text = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {rod: {points: [O, A], length: 1 m, mass: 3 kg, inertia: 0.25 kg·m²}}
driver: {turn: rod, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
"""
    amplitude, quarter = math.radians(120.0), math.sqrt((0.25 + 3.0 * 0.25) / (3.0 * 9.81 * 0.5))
    period = 4.0 * quarter * ellipk(math.sin(amplitude / 2.0) ** 2)
    start = -math.pi / 2.0 + amplitude
    run = lw.run(lw.loads(text), duration=3.0 * period, at=start, tolerance=1e-13)
    assert run.end_state["driver"] == pytest.approx((start, 0.0), abs=1e-10)
    assert run.energy_residual < 1e-11


def test_drivers_that_move_as_in_a_run_supply_what_its_actuators_did() -> None:
    """The force analysis of the motion that was found gives back the torques that made it, of motor and brake."""
    motor = "{kind: dc, on: crank, voltage: 200 V, constant: 0.9 N·m/A, resistance: 0.8 ohm, ratio: 12, until: 2 s}"
    text = f"""
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: 0.1 m, mass: 10 kg, inertia: 2 kg·m²}}
  rod: {{points: [A, B], length: 0.45 m, mass: 12 kg, inertia: 0.25 kg·m²}}
  slide: {{points: [B], mass: 60 kg}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}}
assembly: {{B: forward}}
driver: {{turn: crank, about: O, speed: 170 rpm, start: 90 deg}}
gravity: [0, -9.81 m/s²]
actuators:
  main: {motor}
  disc: {{kind: brake, on: crank, torque: 900 N·m, from: 2 s}}
run: {{until: rest}}
"""
    run = lw.run(lw.loads(text))
    forces = lw.solve_forces(run.as_driven(), steps=60)
    time, speed = forces.motion.time, forces.motion.link("crank").angular_velocity
    expected = np.where(time < 2.0, 12 * 0.9 * (200.0 - 0.9 * 12 * speed) / 0.8, -900.0)
    moves = speed > 1e-9
    assert forces.input_torque[moves] == pytest.approx(expected[moves], rel=1e-10, abs=1e-8)
    assert run.events[-1].kind == "rest"
    assert "held" in [str(each)[:4] for each in run.events]


def test_a_load_of_a_working_stroke_holds_a_press_that_is_too_weak() -> None:
    """A slide of 60 kg falls against a force that grows over its stroke: it stops where both have done the same work,
    and stays there, as nothing pushes it up but on the way down."""
    from scipy.integrate import quad
    from scipy.optimize import brentq

    text = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.45 m}
  slide: {points: [B], mass: 60 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 170 rpm, start: 95 deg}
gravity: [0, -9.81 m/s²]
loads:
  pressing:
    {kind: force, on: slide, at: B, direction: 90 deg, ramp: [0 N, 10 kN], phase: {of: B.y, from: max, to: min}}
run: {until: rest}
"""
    run = lw.run(lw.loads(text))

    def gained(end: float) -> float:
        def slope(q: float) -> float:
            way = 0.1 * math.cos(q) - 0.005 * math.sin(2.0 * q) / math.sqrt(0.45**2 - 0.01 * math.cos(q) ** 2)
            return (10_000.0 * (q - 0.5 * math.pi) / math.pi - 60.0 * 9.81) * way

        return float(quad(slope, math.radians(95.0), end, epsabs=1e-13)[0])

    expected = brentq(gained, math.radians(101.0), math.radians(150.0), xtol=1e-13)
    assert run.end_state["driver"] == pytest.approx((expected, 0.0), abs=1e-8)
    assert [each.name for each in run.events if each.kind == "sticks"] == ["pressing"]


def test_a_machine_that_forces_hold_from_the_beginning_is_at_rest() -> None:
    run = lw.run(block("10 deg", ", friction: 0.3"), until="rest")
    assert (run.end, run.events[-1].kind) == (0.0, "rest")


def test_a_run_that_begins_beyond_a_stop_names_it() -> None:
    stops = "stops: {floor: {of: B.y, at: 2 m, side: below}}\n"
    with refused("dynamics.beyond_stop", stop="floor"):
        lw.run(block("90 deg", more=stops), at=1.0)


def test_a_run_tells_where_a_cam_loses_its_follower() -> None:
    """At 600 rpm the follower of 2 kg would have to be pulled where m (a + g) is below zero; at 60 rpm nowhere."""
    text = """
format: 1
frame: {points: {C: [0 mm, 0 mm]}}
links:
  cam: {points: [C], inertia: 5 kg·m²}
  rod: {points: [P], mass: 2 kg}
joints:
  way: {kind: prismatic, guide: frame, through: C, direction: 90 deg, block: rod, at: P}
  lift: {kind: cam, cam: cam, follower: rod, at: P, touch: roller, base_radius: 40 mm, roller_radius: 10 mm,
    program: [{rise: 30 mm, over: 100 deg, law: cycloidal}, {dwell: 80 deg}, {fall: 30 mm, over: 100 deg},
      {dwell: 80 deg}]}
driver: {turn: cam, about: C, speed: 600 rpm}
gravity: [0, -9.81 m/s²]
"""
    for rpm, lost in ((600.0, True), (60.0, False)):
        run = lw.run(lw.loads(text), turns=1.0, speed=rpm * math.pi / 30.0)
        forces = run.joint_forces(180)
        assert bool(forces.notes) == lost
        assert (forces.motion.point("P").acceleration[:, 1].min() < -9.81) == lost
