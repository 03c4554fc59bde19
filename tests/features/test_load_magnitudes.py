"""Magnitudes over real motions: against published limit positions and against closed formulas of simple machines."""

from __future__ import annotations

import re

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright import Mechanism, loads

Floats = NDArray[np.float64]

SLIDER = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m], P: [1 m, 0 m], R: [-2 m, 0.5 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  piston: {points: [B]}
joints: {cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: SPEED}
loads:
  work: LOAD
"""
CRANK_ROCKER = """
format: 1
name: crank-rocker
frame: {points: {O: [0 m, 0 m], Q: [-4 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [B, Q], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  work: LOAD
"""


def slider(load: str, speed: str = "10 rad/s") -> Mechanism:
    return loads(SLIDER.replace("SPEED", speed).replace("LOAD", f"{{{load}}}"))


def crank_rocker(load: str) -> Mechanism:
    return loads(CRANK_ROCKER.replace("LOAD", f"{{{load}}}"))


THETA = 2 * np.pi * np.arange(60) / 60
STROKE = np.cos(THETA) + np.sqrt(9 - np.sin(THETA) ** 2)


def stroke_rate(angle: Floats) -> Floats:
    """dB.x/dθ."""
    return np.asarray(-np.sin(angle) - np.sin(angle) * np.cos(angle) / np.sqrt(9 - np.sin(angle) ** 2))


STROKE_RATE = stroke_rate(THETA)


def torque(mechanism: Mechanism) -> np.ndarray:  # type: ignore[type-arg]
    """Effort of the crank at THETA; the links have no mass."""
    forces = lw.solve_forces(lw.solve_motion(mechanism, steps=60))
    np.testing.assert_allclose(forces.input_torque_from_power, forces.input_torque, atol=1e-9)
    return forces.input_torque


@pytest.mark.parametrize(("pushes", "sign"), [("", 1), ("pushes: forward,", 1), ("pushes: backward,", -1)])
@pytest.mark.parametrize(("size", "area"), [("area: 0.02 m²", 0.02), ("bore: 0.2 m", np.pi * 0.01)])
def test_gas_on_a_piston(pushes: str, sign: int, size: str, area: float) -> None:
    got = torque(slider(f"kind: pressure, joint: cylinder, {pushes} {size}, magnitude: 3 bar"))
    np.testing.assert_allclose(got, -sign * 3e5 * area * STROKE_RATE, rtol=1e-9, atol=1e-9)


def test_an_indicator_table_over_the_displacement() -> None:
    table = "table: {over: cylinder, x: [2 m, 3 m, 4 m], y: [1 bar, 2 bar, 6 bar]}"
    got = torque(slider(f"kind: pressure, joint: cylinder, area: 1 m², {table}"))
    pressure = 1e5 * np.interp(STROKE, [2, 3, 4], [1, 2, 6])
    np.testing.assert_allclose(got, -pressure * STROKE_RATE, rtol=1e-9, atol=1e-7)


def test_a_smooth_indicator_table_over_the_displacement() -> None:
    x, y = [1.9, 2.6, 3.2, 4.1], [1.0, 2.0, 6.0, 3.0]
    points = f"x: {[f'{at} m' for at in x]}, y: {[f'{p} bar' for p in y]}"
    table = f"table: {{over: cylinder, {points}, interpolation: cubic}}"
    got = torque(slider(f"kind: pressure, joint: cylinder, area: 1 m², {table}"))
    pressure = 1e5 * CubicSpline(x, y)(STROKE)
    np.testing.assert_allclose(got, -pressure * STROKE_RATE, rtol=1e-9, atol=1e-7)


def test_a_periodic_table_goes_on_smoothly_from_turn_to_turn() -> None:
    x, y = [0, 50, 140, 250, 360], [1, 5, 2, 7, 1]
    points = f"x: {[f'{at} deg' for at in x]}, y: {[f'{f} N' for f in y]}"
    table = f"table: {{over: input, {points}, interpolation: periodic}}"
    mechanism = slider(f"kind: force, on: piston, at: B, direction: 0 deg, {table}")
    curve = CubicSpline(np.radians(x), y, bc_type="periodic")
    np.testing.assert_allclose(torque(mechanism), -curve(THETA) * STROKE_RATE, rtol=1e-9, atol=1e-9)
    fine = np.linspace(0, 2 * np.pi, 200_001)
    effort = curve(fine) * stroke_rate(fine)
    numbers = ["peak_input_torque", "rms_input_torque"]
    peak, rms = lw.metrics(lw.solve_forces(lw.solve_motion(mechanism)), numbers).rows
    assert (peak.value, rms.value) == pytest.approx(
        (np.abs(effort).max(), np.sqrt(np.mean(effort[1:] ** 2))), rel=1e-8
    )
    of_many = lw.study(mechanism, {"rod.length": [2.9, 3.0]}, metrics=numbers)
    assert [of_many[name][1] for name in numbers] == pytest.approx([peak.value, rms.value], rel=1e-12)


def test_a_table_over_time() -> None:
    table = "table: {over: time, x: [0 s, 1 s], y: [0 bar, 1 bar]}"
    got = torque(slider(f"kind: pressure, joint: cylinder, area: 1 m², {table}"))
    np.testing.assert_allclose(got, -1e5 * THETA / 10 * STROKE_RATE, rtol=1e-9, atol=1e-7)


def test_an_expression_of_input_time_output_and_parameter() -> None:
    text = SLIDER.replace("SPEED", "10 rad/s").replace("frame:", "parameters: {f: 3 N}\nframe:", 1)
    magnitude = '"f*sin(input)*B.x/(1 m) + f*t/(1 s) - f*cos(crank)"'
    load = f"{{kind: force, on: piston, at: B, direction: 0 deg, magnitude: {magnitude}}}"
    mechanism = loads(text.replace("LOAD", load))
    force = 3 * (np.sin(THETA) * STROKE + THETA / 10 - np.cos(THETA))
    np.testing.assert_allclose(torque(mechanism), -force * STROKE_RATE, rtol=1e-9, atol=1e-9)
    twice = torque(mechanism.with_dimensions({"f": 6.0}))
    np.testing.assert_allclose(twice, -2 * force * STROKE_RATE, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("direction", ["increasing", "decreasing"])
def test_a_force_on_one_stroke(direction: str) -> None:
    phase = f"phase: {{moving: cylinder, direction: {direction}}}"
    got = torque(slider(f"kind: force, on: piston, at: B, components: [8 N, 3 N], {phase}"))
    acts = STROKE_RATE > 1e-12 if direction == "increasing" else STROKE_RATE < -1e-12
    assert 28 <= acts.sum() <= 30
    np.testing.assert_allclose(got, np.where(acts, -8 * STROKE_RATE, 0), atol=1e-9)


@pytest.mark.parametrize("speed", ["10 rad/s", "-10 rad/s"])
def test_a_ramp_over_a_stroke(speed: str) -> None:
    """The piston goes out from 180° to 360° of a counter-clockwise crank, and from -180° to -360° otherwise."""
    phase = "ramp: [0 N, 18 N], phase: {of: cylinder, from: min, to: max}"
    mechanism = slider(f"kind: force, on: piston, at: B, direction: 0 deg, {phase}", speed)
    at = np.radians([170.0, 180, 190, 270, 350, 360, 370, 541]) * (1 if speed[0] == "1" else -1)
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=at))
    np.testing.assert_allclose(forces.load("work").force[:, 0], [0, 0, 1, 9, 17, 18, 0, 0.1], rtol=1e-9, atol=1e-9)


def test_a_spring_from_crank_to_frame() -> None:
    """T = dE/dθ with E = k (L - L0)²/2 + F0 (L - L0) and the distance L from A to R."""
    got = torque(slider("kind: spring, between: [crank.A, R], stiffness: 40 N/m, free_length: 1.5 m, preload: 7 N"))
    distance = np.hypot(np.cos(THETA) + 2, np.sin(THETA) - 0.5)
    rate = (-2 * np.sin(THETA) - 0.5 * np.cos(THETA)) / distance
    np.testing.assert_allclose(got, (40 * (distance - 1.5) + 7) * rate, rtol=1e-9, atol=1e-9)


def test_a_damper_from_crank_to_frame() -> None:
    got = torque(slider("kind: damper, between: [crank.A, R], damping: 5 N·s/m"))
    distance = np.hypot(np.cos(THETA) + 2, np.sin(THETA) - 0.5)
    rate = (-2 * np.sin(THETA) - 0.5 * np.cos(THETA)) / distance
    np.testing.assert_allclose(got, 5 * 10 * rate**2, rtol=1e-9, atol=1e-9)


def test_ends_that_meet_give_finite_forces() -> None:
    """A meets the frame's point P at 0°."""
    spring = slider("kind: spring, between: [crank.A, P], stiffness: 40 N/m, free_length: 1 m, preload: 7 N")
    assert torque(spring)[0] == 0.0
    damper = slider("kind: damper, between: [crank.A, P], damping: 5 N·s/m")
    assert torque(damper)[0] == pytest.approx(5 * 10)
    soft = slider("kind: spring, between: [crank.A, P], stiffness: 40 N/m")
    np.testing.assert_allclose(torque(soft), 40 * np.sin(THETA), rtol=1e-9, atol=1e-12)


def test_torsion_damper_and_torque_between_links() -> None:
    rod_rate = -np.cos(THETA) / np.sqrt(9 - np.sin(THETA) ** 2)
    damper = torque(slider("kind: torsion_damper, links: [crank, rod], damping: 3 N·m·s/rad"))
    np.testing.assert_allclose(damper, 3 * 10 * (rod_rate - 1) ** 2, rtol=1e-9)
    between = torque(slider("kind: torque, on: crank, against: rod, magnitude: 9 N·m"))
    np.testing.assert_allclose(between, -9 * (1 - rod_rate), rtol=1e-9)
    alone = torque(slider("kind: torque, on: rod, magnitude: 9 N·m"))
    np.testing.assert_allclose(alone, -9 * rod_rate, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("free", [-300.0, 60.0, 420.0])
@pytest.mark.parametrize("links", ["[frame, rod]", "[rod, frame]"])
def test_a_torsion_spring_takes_the_free_angle_nearest_to_its_own(free: float, links: str) -> None:
    """Whole turns of the free angle do not matter; T = dE/dθ with the rod's angle -asin(sin θ / 3)."""
    sign = 1 if links.startswith("[f") else -1
    load = f"kind: torsion_spring, links: {links}, stiffness: 20 N·m/rad, free_angle: {sign * free} deg"
    rod = -np.arcsin(np.sin(THETA) / 3)
    rate = -np.cos(THETA) / np.sqrt(9 - np.sin(THETA) ** 2)
    got = torque(slider(load + ", preload: 2 N·m"))
    np.testing.assert_allclose(got, (20 * (rod - np.radians(60)) + sign * 2) * rate, rtol=1e-9, atol=1e-9)


def test_a_torsion_spring_winds_up() -> None:
    load = "kind: torsion_spring, links: [frame, crank], stiffness: 2 N·m/rad"
    text = SLIDER.replace("SPEED", "10 rad/s").replace("LOAD", f"{{{load}}}")
    mechanism = loads(text.replace("loads:", "cycle: {turns: 3}\nloads:"))
    motion = lw.solve_motion(mechanism, steps=90, endpoint=True)
    got = lw.solve_forces(motion).input_torque
    np.testing.assert_allclose(got, 2 * 6 * np.pi * np.arange(91) / 90, rtol=1e-12)
    some = lw.solve_forces(lw.solve_motion(mechanism, at=[5.0, 17.0])).input_torque
    np.testing.assert_allclose(some, [10.0, 34.0])


@pytest.mark.parametrize(
    "load",
    [
        'kind: torque, on: crank, magnitude: "3 N·m*rocker/rad + 2 N·m*crank/rad"',
        "kind: torsion_spring, links: [coupler, rocker], stiffness: 2 N·m/rad, free_angle: 100 deg",
        "kind: torque, on: crank, ramp: [1 N·m, 5 N·m], phase: {of: rocker, from: max, to: min}",
        "kind: torque, on: crank, magnitude: 2 N·m, phase: {moving: rocker, direction: increasing}",
    ],
)
def test_a_load_does_not_depend_on_the_other_positions_asked(load: str) -> None:
    """The rocker's angle goes through ±180°; alone, in any order or in the cycle, the torque is the same."""
    mechanism = crank_rocker(load)
    cycle = lw.solve_motion(mechanism, steps=72)
    rocker = cycle.link("rocker").direction[:, 1]
    assert (rocker > 0).any() and (cycle.link("coupler").direction[:, 0] < 0).any()
    whole = lw.solve_forces(cycle).input_torque
    assert np.ptp(whole) > 0.1
    for chosen in ([5], [60, 3, 33], [71, 40, 10, 0]):
        some = lw.solve_forces(lw.solve_motion(mechanism, at=cycle.input[chosen])).input_torque
        np.testing.assert_allclose(some, whole[chosen], rtol=1e-9, atol=1e-9)
    many = np.linspace(0.5, 2.5, 401)
    together = lw.solve_forces(lw.solve_motion(mechanism, at=many)).input_torque
    alone = lw.solve_forces(lw.solve_motion(mechanism, at=many[[0, 200, 400]])).input_torque
    np.testing.assert_allclose(together[[0, 200, 400]], alone, rtol=1e-9, atol=1e-9)


def test_limits_are_those_of_the_whole_turn() -> None:
    load = "kind: torque, on: crank, ramp: [1 N·m, 5 N·m], phase: {of: rocker, from: max, to: min}"
    whole = lw.solve_forces(lw.solve_motion(crank_rocker(load), steps=72)).input_torque
    part = loads(
        CRANK_ROCKER.replace("LOAD", f"{{{load}}}").replace("loads:", "cycle: {from: 0 deg, to: 60 deg}\nloads:")
    )
    some = lw.solve_forces(lw.solve_motion(part, steps=12)).input_torque
    np.testing.assert_allclose(some, whole[:13], rtol=1e-9, atol=1e-9)


def test_a_structure_carries_loads_without_a_driver() -> None:
    """Two bars at 45° under a spring that is 1 m long and free at 0.5 m."""
    text = """
format: 1
name: two bars
frame: {points: {O: [0 m, 0 m], Q: [2 m, 0 m], R: [1 m, 0 m]}}
links:
  left: {points: [O, C], length: 1.4142135623730951 m}
  right: {points: [Q, C], length: 1.4142135623730951 m}
assembly: {C: left}
loads:
  spring: {kind: spring, between: [left.C, R], stiffness: 40 N/m, free_length: 0.5 m}
  hinge: {kind: torsion_spring, links: [left, right], stiffness: 1 N·m/rad, free_angle: -270 deg}
"""
    forces = lw.solve_forces(lw.solve_motion(loads(text)))
    np.testing.assert_allclose(forces.reaction("O", on="left"), [[10, 10]], rtol=1e-9)
    np.testing.assert_allclose(forces.reaction("Q", on="right"), [[-10, 10]], rtol=1e-9)


def test_the_crusher_ramps_between_its_published_limit_positions() -> None:
    """Largest jaw angle at -89.862115°, smallest at -272.43420°: an independent solution."""
    got = store.forces("jaw_crusher_sixbar").load("crushing").magnitude
    share = (np.arange(360) - 89.862115) / (272.43420 - 89.862115)
    expected = np.where((share >= 0) & (share <= 1), 85000 * share, 0.0)
    np.testing.assert_allclose(got, expected, rtol=1e-7, atol=0.01)


def conveyor(phase: str) -> Mechanism:
    """The swinging conveyor with its resistance in another phase."""
    text, count = re.subn(r"phase: \{input: [^}]*\}", f"phase: {{{phase}}}", store.text("swing_conveyor"))
    assert count == 1
    return loads(text)


def test_the_conveyor_advances_between_its_printed_limit_positions() -> None:
    """The rocker swings forward from 231.6500775° to 348.743° of the crank, as printed in the report."""
    at = np.radians([231.649, 231.651, 290.0, 348.742, 348.744])
    forces = lw.solve_forces(lw.solve_motion(conveyor("of: rocker, from: max, to: min"), at=at))
    expected = [0, -2200, -2200, -2200, 0]
    assert forces.load("resistance").force[:, 0] == pytest.approx(expected, abs=1e-9)


def test_a_stroke_ends_at_the_first_of_two_equal_limits() -> None:
    """The conveyor's slider has its largest displacement twice, where the rod lies along the rocker's arm.

    Going out from its smallest displacement it stops at the first, before the rocker's own limit position.
    """
    motion = lw.solve_motion(conveyor("of: guide, from: min, to: max"), steps=720)
    acts = lw.solve_forces(motion).load("resistance").magnitude > 0
    out = motion.joint("guide").displacement
    first, last = np.flatnonzero(acts)[[0, -1]]
    assert acts[first : last + 1].all()
    assert abs(first - int(out.argmin())) <= 1 and out[last] == pytest.approx(out.max(), abs=1e-5)
    assert (np.diff(out[first : last + 1]) > 0).all()


@pytest.mark.parametrize(
    "load",
    [
        'kind: torque, on: crank, magnitude: "5 N·m/(2 + sin(coupler))"',
        "kind: torsion_spring, links: [frame, rocker], stiffness: 2 N·m/rad, free_angle: 180 deg",
        "kind: torque, on: crank, magnitude: 2 N·m, phase: {moving: rocker, direction: increasing}",
    ],
)
def test_positions_out_of_reach_do_not_disturb_the_others(load: str) -> None:
    text = CRANK_ROCKER.replace("[O, A], length: 1 m", "[O, A], length: 3.2 m").replace("LOAD", f"{{{load}}}")
    motion = lw.solve_motion(loads(text), steps=72, failures="mark")
    assert 10 < motion.ok.sum() < 62
    torques = lw.solve_forces(motion).input_torque
    assert (np.isfinite(torques) == motion.ok).all()


@pytest.mark.parametrize("axis", ["x", "y"])
def test_loads_that_follow_a_point(axis: str) -> None:
    """By its place in a formula, by a table over it, and while it goes one way."""
    place = "B.x" if axis == "x" else "B.y"
    own = 0 if axis == "x" else 1
    force = "kind: force, on: rocker, at: B, direction: 0 deg"
    machine = crank_rocker(f'{force}, magnitude: "5 N/m*{place}"')
    motion = lw.solve_motion(machine, steps=48)
    at, rate = motion.point("B").position[:, own], motion.point("B").velocity[:, own]
    assert np.ptp(at) > 0.5

    def size(load: str) -> np.ndarray:  # type: ignore[type-arg]
        return lw.solve_forces(lw.solve_motion(crank_rocker(load), steps=48)).load("work").force[:, 0]

    assert size(f'{force}, magnitude: "5 N/m*{place}"') == pytest.approx(5 * at, abs=1e-12)
    table = f"table: {{over: {place}, x: [-6 m, 6 m], y: [-12 N, 36 N]}}"
    assert size(f"{force}, {table}") == pytest.approx(4 * at + 12, abs=1e-12)
    moving = f"magnitude: 7 N, phase: {{moving: {place}, direction: increasing}}"
    assert size(f"{force}, {moving}").tolist() == np.where(rate > 0, 7.0, 0.0).tolist()


@pytest.mark.parametrize(
    "function", ["min(2, sqrt(sin(input)))", "max(sqrt(sin(input)), 1)", "step(log(sin(input)))"]
)
def test_an_expression_is_refused_where_a_part_of_it_has_no_value(function: str) -> None:
    with refused("loads.formula_fails", name="work", input="186°"):
        torque(slider(f'kind: torque, on: crank, magnitude: "1 N·m*{function}"'))


def test_a_machine_whose_load_goes_by_its_motion_alone_is_prepared() -> None:
    """A torque of 5 N·m/(2 + sin x), which divides by what varies, on a crank without masses."""
    prepared = lw.prepare(slider('kind: torque, on: crank, magnitude: "5 N·m/(2 + sin(crank))"'), steps=60)
    np.testing.assert_allclose(prepared.solve({}).input_torque, -5 / (2 + np.sin(THETA)), rtol=1e-12)
