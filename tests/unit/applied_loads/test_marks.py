"""Arrows of loads in drawings: against the force that is computed, and along the direction where its sign is open."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.plotting.drawing.machine import mark_of

MODEL = """format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {arm: {points: [O, A], length: 1 m}}
driver: {turn: arm, about: O, speed: 1 rad/s}
parameters: {F: 5 N}
loads:
  push: {kind: force, on: arm, at: A, direction: 30 deg, GIVEN}
"""


@pytest.mark.parametrize(
    ("given", "turned"),
    [
        ("magnitude: 5 N", False),
        ("magnitude: -5 N", True),
        ("magnitude: 0 N", False),
        ("magnitude: F*sin(arm)", False),
        ("'ramp: [1 N, 5 N], phase: {input: [0 deg, 90 deg]}'", False),
        ("'ramp: [-1 N, -5 N], phase: {input: [0 deg, 90 deg]}'", True),
    ],
)
def test_an_arrow_points_as_the_force_does(given: str, turned: bool) -> None:
    machine = lw.loads(MODEL.replace("GIVEN", given.strip("'")))
    motion = lw.solve_motion(machine, steps=8)
    mark = mark_of(machine.loads["push"], motion, 1)
    expected = np.deg2rad(210.0 if turned else 30.0)
    assert (mark.link, mark.at) == ("arm", "A")
    assert np.exp(1j * mark.angle) == pytest.approx(np.exp(1j * expected), rel=1e-12)
    force = lw.solve_forces(motion).load("push").force[1]
    size = np.hypot(*force)
    if size > 0.0:
        assert force / size == pytest.approx([np.cos(expected), np.sin(expected)], abs=1e-12)


EVERY = """format: 1
frame: {points: {O: [0 m, 0 m], G: [0 m, 0.3 m]}}
parameters: {k: 2}
links:
  crank: {points: [O, A], length: 0.2 m}
  rod: {points: [A, B], length: 0.7 m, also: {P: [0.3 m, 0.2 m]}}
  ram: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: G, direction: 15 deg, block: ram, at: B}}
driver: {turn: crank, about: O, LAW}
cycle: {duration: 1 s}
loads: {push: {LOAD}}
"""
FORCE = "kind: force, on: rod, at: P"
TURNING = "speed: 360 deg/s"
TO_AND_FRO = 'position: "90 deg*cos(2*pi*t/(1 s))"'


@pytest.mark.parametrize("size", [4.0, -4.0])
@pytest.mark.parametrize(
    "load", ["direction: 200 deg", "in_link: -35 deg", "normal_to: [B, P]", "along: [B, P]", "opposes: velocity"]
)
def test_arrows_of_forces_in_every_way_of_giving_a_direction(load: str, size: float) -> None:
    text = EVERY.replace("LAW", TURNING).replace("LOAD", f"{FORCE}, {load}, magnitude: {size} N")
    motion = lw.solve_motion(lw.loads(text), steps=7)
    force = lw.solve_forces(motion).load("push").force
    for k in range(7):
        angle = mark_of(motion.mechanism.loads["push"], motion, k).angle
        assert 4.0 * np.array([np.cos(angle), np.sin(angle)]) == pytest.approx(force[k], abs=1e-9)


def test_an_arrow_of_components_and_one_against_a_motion_that_only_begins() -> None:
    text = EVERY.replace("LAW", TURNING).replace("LOAD", f"{FORCE}, components: [-3 N, 4 N]")
    motion = lw.solve_motion(lw.loads(text), steps=3)
    assert mark_of(motion.mechanism.loads["push"], motion, 1).angle == pytest.approx(np.arctan2(4, -3))
    load = "kind: force, on: crank, at: A, opposes: velocity, magnitude: 1 N"
    resting = lw.solve_motion(lw.loads(EVERY.replace("LAW", TO_AND_FRO).replace("LOAD", load)), times=[0.0, 0.01])
    acceleration = resting.point("A").acceleration[0]
    assert np.hypot(*resting.point("A").velocity[0]) < 1e-12
    for k in (0, 1):
        angle = mark_of(resting.mechanism.loads["push"], resting, k).angle
        assert [np.cos(angle), np.sin(angle)] @ acceleration == pytest.approx(-np.hypot(*acceleration), rel=1e-2)


@pytest.mark.parametrize(
    ("load", "sense"),
    [
        ("magnitude: 5 N·m", 1),
        ("magnitude: -5 N·m", -1),
        ("ramp: [1 N·m, -5 N·m], phase: {input: [0 deg, 90 deg]}", -1),
        ("magnitude: k*(1 N·m)*sin(rod)", 0),
    ],
)
def test_turning_arrows_show_the_sign_of_the_torque(load: str, sense: int) -> None:
    text = EVERY.replace("LAW", TURNING).replace("LOAD", f"kind: torque, on: rod, {load}")
    motion = lw.solve_motion(lw.loads(text), steps=3)
    mark = mark_of(motion.mechanism.loads["push"], motion, 0)
    assert (mark.link, mark.sense) == ("rod", sense)


@pytest.mark.parametrize("against", ["", ", against: crank"])
@pytest.mark.parametrize("size", [5.0, -5.0])
def test_turning_arrows_against_a_rotation(size: float, against: str) -> None:
    """Against the rotation relative to the other link; none at rest."""
    load = f"kind: torque, on: rod, opposes: velocity, magnitude: {size} N·m{against}"
    motion = lw.solve_motion(lw.loads(EVERY.replace("LAW", TO_AND_FRO).replace("LOAD", load)), steps=8)
    rod, crank = (motion.link(name).angular_velocity for name in ("rod", "crank"))
    against_it = -np.sign(size) * np.sign(np.round(rod - (crank if against else 0.0), 9))
    senses = [mark_of(motion.mechanism.loads["push"], motion, k).sense for k in range(motion.steps)]
    assert senses == against_it.tolist()
    if not against:
        assert senses == np.sign(lw.solve_forces(motion).load("push").moment).tolist()
    assert senses[0] == senses[4] == 0 and {1, -1} <= set(senses)


@pytest.mark.parametrize(
    ("load", "sense"),
    [
        ("magnitude: 1 bar", 1),
        ("magnitude: -1 bar", -1),
        ("pushes: backward, magnitude: 1 bar", -1),
        ("pushes: backward, magnitude: -1 bar", 1),
        ("pushes: backward, magnitude: k*(1 bar)*sin(rod)", -1),
    ],
)
def test_arrows_of_a_pressure_lie_along_its_guide(load: str, sense: int) -> None:
    text = EVERY.replace("LAW", TURNING).replace("LOAD", f"kind: pressure, joint: guide, area: 1 m², {load}")
    motion = lw.solve_motion(lw.loads(text), steps=3)
    mark = mark_of(motion.mechanism.loads["push"], motion, 0)
    assert (mark.joint, mark.sense) == ("guide", sense)
