"""Cylinders, constant efforts, brakes and flywheels against hand computation."""

import math

import pytest
from tests.unit.actuators.bench import ROTOR, SLIDE, effort, found, inertia, machine

PISTON, RING = math.pi * 0.063**2 / 4, math.pi * (0.063**2 - 0.036**2) / 4


def test_a_cylinder_pushes_with_pressure_times_area_and_pulls_with_the_ring() -> None:
    """100 bar on a piston of 63 mm: 31.17 kN; on the ring of a rod of 36 mm: 20.99 kN."""
    push = machine("kind: cylinder, along: guide, bore: 63 mm, rod: 36 mm, pressure: 10 MPa", SLIDE)
    pull = machine("kind: cylinder, along: guide, bore: 63 mm, rod: 36 mm, rod_pressure: 10 MPa", SLIDE)
    both = "kind: cylinder, along: guide, bore: 63 mm, rod: 36 mm, pressure: 10 MPa, rod_pressure: 2 MPa"
    areas = [PISTON, RING]
    assert areas == pytest.approx([31172.45e-7, 20993.69e-7], rel=1e-6)
    assert effort(push) == pytest.approx(10e6 * PISTON, rel=1e-13)
    assert effort(pull) == pytest.approx(-10e6 * RING, rel=1e-13)
    assert effort(machine(both, SLIDE)) == pytest.approx(10e6 * PISTON - 2e6 * RING, rel=1e-13)


@pytest.mark.parametrize("force", [2000.0, -2000.0])
def test_the_flow_limits_the_speed_in_the_sense_of_the_force(force: float) -> None:
    equation = machine(f"kind: cylinder, along: guide, force: {force} N, largest_speed: 0.4 m/s", SLIDE)
    ahead = math.copysign(0.1, force)
    assert effort(equation, ahead) == pytest.approx(0.75 * force, rel=1e-13)
    assert effort(equation, 4 * ahead) == pytest.approx(0.0, abs=1e-9)
    assert effort(equation, 5 * ahead) == pytest.approx(-0.25 * force, rel=1e-12)
    assert effort(equation, -ahead) == pytest.approx(force, rel=1e-13)


def test_a_cylinder_between_two_points_pushes_along_their_line() -> None:
    """From S(0, 3) to P(4, 0), 5 m long: its force has 4/5 along the guide, its rate is 4/5 of the table's."""
    plain = machine("kind: cylinder, between: [frame.S, table.P], force: 100 N", SLIDE)
    assert effort(plain, q=4.0) == pytest.approx(80.0, rel=1e-13)
    slow = machine("kind: cylinder, between: [frame.S, table.P], force: 100 N, largest_speed: 0.5 m/s", SLIDE)
    assert effort(slow, 0.25, q=4.0) == pytest.approx(80.0 * (1 - 0.2 / 0.5), rel=1e-13)
    (power,) = found(plain, ["power"], {"q:driver": 4.0, "qd:driver": 0.5})
    assert power == pytest.approx(100.0 * 0.4, rel=1e-13)


def test_constant_efforts_act_within_their_times() -> None:
    hand = machine("kind: constant, on: wheel, torque: 30 N·m, from: 1 s, until: 2 s")
    assert [effort(hand, time=t) for t in (0.5, 1.5, 2.5)] == [0.0, 30.0, 0.0]
    push = machine("kind: constant, between: [table.P, frame.S], force: -100 N", SLIDE)
    assert effort(push, q=4.0) == pytest.approx(-80.0, rel=1e-13)


def test_a_brake_opposes_the_motion_and_gives_nothing_at_rest() -> None:
    brake = machine("kind: brake, on: wheel, torque: 900 N·m, from: 2 s")
    assert [effort(brake, w, time=3.0) for w in (4.0, -0.1, 0.0)] == [-900.0, 900.0, 0.0]
    assert effort(brake, 4.0, time=1.0) == 0.0
    rail = machine("kind: brake, along: guide, force: 60 N", SLIDE)
    assert [effort(rail, w) for w in (0.2, -0.2)] == [-60.0, 60.0]


def test_a_flywheel_behind_a_gear_counts_with_the_square_of_its_ratio() -> None:
    assert inertia(machine("kind: flywheel, on: wheel, inertia: 0.5 kg·m²")) == pytest.approx(2.5, rel=1e-14)
    fast = machine("kind: flywheel, on: wheel, inertia: 0.5 kg·m², ratio: -3")
    assert inertia(fast) == pytest.approx(2.0 + 9 * 0.5, rel=1e-14)
    (second,) = found(machine("kind: flywheel, on: wheel, inertia: 0.5 kg·m²", PUSHED), ["qdd:driver"], {})
    assert second == pytest.approx(30.0 / 2.5, rel=1e-13)


PUSHED = f"{ROTOR}  hand: {{kind: constant, on: wheel, torque: 30 N·m}}\n"
