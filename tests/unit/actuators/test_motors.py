"""Torques of motors against data sheets and hand computation, and what the gear makes of them."""

import math

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from tests.unit.actuators.bench import ARM, SLIDE, effort, found, inertia, machine

import linkwright as lw
from linkwright.actuators.motor import Motor

RPM = 2 * math.pi / 60
INDUCTION = "kind: induction, on: wheel, power: 4 kW, speed: 1455 rpm, synchronous: 1500 rpm, pull_out: 2.5"
DC = "kind: dc, on: wheel, voltage: 200 V, constant: 0.9 N·m/A, resistance: 0.8 ohm"
SERVO = (
    "kind: servo, on: wheel, continuous: 10 N·m, peak: 30 N·m, largest_speed: 300 rad/s, speed: 200 rad/s, "
    "gain: 2 N·m·s/rad"
)
CURVE = (
    "kind: curve, on: wheel, speed: [0 rad/s, 100 rad/s, 150 rad/s, 160 rad/s], torque: [40 N·m, 60 N·m, 30 N·m, 0]"
)


def motor(text: str) -> Motor:
    """The motor of the rotor's equation of motion."""
    actuator = machine(text).source.actuators["main"]
    assert isinstance(actuator, Motor)
    return actuator


def test_kloss_curve_goes_through_the_rated_point_and_has_its_largest_torque_at_the_breakdown_slip() -> None:
    """4 kW at 1455 rpm: Tn = 4000/(1455·2π/60) = 26.2524 N·m, sn = 0.03, sk = 0.03·(2.5 + √5.25) = 0.1437386."""
    own, rated = motor(INDUCTION), 4000.0 / (1455 * RPM)
    breakdown = 0.03 * (2.5 + math.sqrt(5.25))
    at = 1500 * RPM * (1.0 - breakdown)
    assert rated == pytest.approx(26.2523617, rel=1e-8) and breakdown == pytest.approx(0.14373863, rel=1e-7)
    speeds = np.array([1455 * RPM, at, 1500 * RPM, 0.0, 1545 * RPM])
    expected = [rated, 2.5 * rated, 0.0, 5 * rated * breakdown / (1 + breakdown**2), -rated]
    np.testing.assert_allclose(own.torque_at(speeds), expected, rtol=1e-12, atol=1e-12)
    near = own.torque_at(np.array([at - 1e-3, at + 1e-3]))
    assert (near < 2.5 * rated).all() and near[0] - near[1] == pytest.approx(0.0, abs=1e-6)


def test_a_deep_bar_rotor_has_its_own_torque_at_rest_and_the_same_one_about_the_rated_speed() -> None:
    plain, deep, rated = motor(INDUCTION), motor(f"{INDUCTION}, starting: 2.2"), 4000.0 / (1455 * RPM)
    breakdown = 1500 * RPM * (1.0 - 0.03 * (2.5 + math.sqrt(5.25)))
    above = np.linspace(breakdown, 1500 * RPM, 7)
    np.testing.assert_array_equal(deep.torque_at(above), plain.torque_at(above))
    assert deep.torque_at(np.array([0.0, -50.0]))[0] == pytest.approx(2.2 * rated, rel=1e-14)
    below = np.linspace(0.0, breakdown, 50)
    more = deep.torque_at(below) - plain.torque_at(below)
    assert (np.diff(more) < 0.0).all() and more[-1] == pytest.approx(0.0, abs=1e-12)


def test_a_star_delta_start_has_a_third_of_the_torque() -> None:
    equation = machine(f"{INDUCTION}, star_until: 3 s")
    assert effort(equation, 1455 * RPM, time=2.9) == pytest.approx(4000.0 / (1455 * RPM) / 3, rel=1e-12)
    assert effort(equation, 1455 * RPM, time=3.1) == pytest.approx(4000.0 / (1455 * RPM), rel=1e-12)


def test_a_direct_current_motor_has_its_stall_torque_and_its_no_load_speed() -> None:
    """k·U/R = 0.9·200/0.8 = 225 N·m and U/k = 222.2 rad/s; half the torque at half the speed."""
    equation = machine(DC)
    assert effort(equation) == pytest.approx(225.0, rel=1e-14)
    assert effort(equation, 200 / 0.9) == pytest.approx(0.0, abs=1e-12)
    assert effort(equation, 100 / 0.9) == pytest.approx(112.5, rel=1e-14)
    assert effort(equation, 300 / 0.9) == pytest.approx(-112.5, rel=1e-14)
    mechanical = machine(f"kind: dc, on: wheel, stall_torque: 225 N·m, no_load_speed: {200 / 0.9!r} rad/s")
    assert effort(mechanical, 37.0) == pytest.approx(effort(equation, 37.0), rel=1e-14)


def test_a_limit_of_the_current_limits_the_torque_both_ways() -> None:
    limited = motor(f"{DC}, current: 100 A")
    np.testing.assert_allclose(limited.torque_at(np.array([0.0, 200.0, 400.0])), [90.0, 22.5, -90.0], rtol=1e-13)


def test_a_servo_holds_its_speed_within_its_limits() -> None:
    own = motor(SERVO)
    np.testing.assert_allclose(own.torque_at(np.array([0.0, 190.0, 200.0, 205.0, 290.0])), [30, 20, 0, -10, -30])
    falling = motor(f"{SERVO}, knee: 100 rad/s")
    np.testing.assert_allclose(falling.torque_at(np.array([50.0, 150.0])), [30.0, 25.0])
    slow = SERVO.replace("speed: 200 rad/s, gain", "speed: -200 rad/s, gain")
    np.testing.assert_allclose(motor(slow).torque_at(np.array([-310.0, -195.0, 310.0])), [30.0, -10.0, -30.0])


def test_a_servo_does_not_drive_beyond_its_largest_speed() -> None:
    quick = motor(SERVO.replace("speed: 200 rad/s, gain", "speed: 300 rad/s, gain"))
    assert quick.torque_at(np.array([299.0, 301.0])) == pytest.approx([2.0, -2.0])
    back = quick.torque_at(np.array([-301.0]))
    assert back == pytest.approx([30.0])  # against its motion it brakes


def test_the_wanted_speed_rises_along_a_ramp_from_the_beginning() -> None:
    equation = machine(f"{SERVO}, ramp: 0.5 s, from: 1 s")
    assert effort(equation, 0.0, time=0.9) == 0.0
    assert effort(equation, 95.0, time=1.25) == pytest.approx(10.0, rel=1e-12)
    assert effort(equation, 195.0, time=2.0) == pytest.approx(10.0, rel=1e-12)


@pytest.mark.parametrize(
    ("beyond", "low", "high"), [("hold", 40.0, 0.0), ("zero", 0.0, 0.0), ("straight", 38.0, -30.0)]
)
def test_a_curve_of_points(beyond: str, low: float, high: float) -> None:
    own = motor(f"{CURVE}, beyond: {beyond}")
    speeds = np.array([-10.0, 0.0, 50.0, 100.0, 125.0, 155.0, 160.0, 170.0])
    np.testing.assert_allclose(own.torque_at(speeds), [low, 40, 50, 60, 45, 15, 0, high], rtol=1e-13, atol=1e-13)


def test_a_smooth_curve_is_the_monotone_cubic_through_the_points() -> None:
    own = motor(f"{CURVE}, interpolation: cubic, beyond: straight")
    cubic = PchipInterpolator([0.0, 100.0, 150.0, 160.0], [40.0, 60.0, 30.0, 0.0])
    speeds = np.linspace(0.0, 160.0, 301)
    np.testing.assert_allclose(own.torque_at(speeds), cubic(speeds), rtol=1e-12, atol=1e-12)
    slope = cubic.derivative()
    ends = own.torque_at(np.array([-1.0, 161.0]))
    assert ends == pytest.approx([40.0 - float(slope(0.0)), float(slope(160.0))], rel=1e-12)


def test_a_gear_multiplies_torque_and_divides_speed_and_takes_its_part_of_the_power() -> None:
    """i = 10, η = 0.8: 2250·0.8 N·m at rest when driving; 225/2 N·m of braking cost 1125/0.8 N·m."""
    equation = machine(f"{DC}, ratio: 10, efficiency: 0.8")
    assert effort(equation, 1e-9) == pytest.approx(1800.0, rel=1e-9)
    assert effort(equation, 30 / 0.9) == pytest.approx(-1125.0 / 0.8, rel=1e-13)
    assert effort(equation, -10.0) == pytest.approx(10 * 0.9 * (200 + 0.9 * 100) / 0.8 / 0.8, rel=1e-13)
    assert inertia(equation) == pytest.approx(2.0, rel=1e-14)


def test_a_rotor_counts_with_the_square_of_the_ratio() -> None:
    equation = machine(f"{DC}, ratio: -10, inertia: 0.05 kg·m²")
    assert inertia(equation) == pytest.approx(2.0 + 100 * 0.05, rel=1e-14)
    (second,) = found(equation, ["qdd:driver"], {})
    assert second == pytest.approx(-2250.0 / 7.0, rel=1e-13)


def test_a_motor_drives_in_the_sense_of_its_driver() -> None:
    assert effort(machine(DC, speed="speed: -20 rpm")) == pytest.approx(-225.0, rel=1e-13)
    assert effort(machine(DC, speed="speed: -20 rpm"), -200 / 0.9) == pytest.approx(0.0, abs=1e-12)
    assert effort(machine(f"{DC}, ratio: -1", speed="speed: -20 rpm")) == pytest.approx(225.0, rel=1e-13)


def test_a_rotor_on_a_moving_link_turns_with_it() -> None:
    """Kinetic energy ½J(ω1 + i·ω2)² of a rotor on the upper arm that turns the lower one: its mass matrix."""
    equation = machine("kind: dc, on: lower, against: upper, stall_torque: 1 N·m, no_load_speed: 9 rad/s", ARM)
    names = ["M:one:one", "M:one:two", "M:two:one", "M:two:two"]
    bare = np.array(found(equation, names, {"q:two": 0.7}))
    geared = machine(
        "kind: dc, on: lower, against: upper, stall_torque: 1 N·m, no_load_speed: 9 rad/s, ratio: 6, "
        "inertia: 0.03 kg·m²",
        ARM,
    )
    rotor = 0.03 * np.array([1.0, 6.0, 6.0, 36.0])
    np.testing.assert_allclose(np.array(found(geared, names, {"q:two": 0.7})) - bare, rotor, rtol=1e-12)
    torques = found(geared, ["h:one", "h:two"], {})
    assert torques == pytest.approx([0.0, -6.0], abs=1e-12)


def test_a_screw_turns_torque_into_force() -> None:
    """5 mm per turn: 2π/0.005 = 1256.6 rad/m; 2 N·m push with 2513.3 N, 1e-4 kg·m² count as 157.9 kg."""
    dc = (
        "kind: dc, along: guide, lead: 5 mm/rev, stall_torque: 2 N·m, no_load_speed: 300 rad/s, inertia: 0.0001 kg·m²"
    )
    equation, per_metre = machine(dc, SLIDE), 2 * math.pi / 0.005
    assert effort(equation) == pytest.approx(2 * per_metre, rel=1e-13)
    assert effort(equation, 150 / per_metre) == pytest.approx(per_metre, rel=1e-13)
    assert inertia(equation) == pytest.approx(5.0 + 1e-4 * per_metre**2, rel=1e-13)


def test_a_self_locking_gear_lets_only_the_motor_drive() -> None:
    worm = f"{DC}, ratio: 10, efficiency: 0.4, self_locking: true, holding: 9 kN·m, until: 2 s"
    equation = machine(worm)
    assert effort(equation, 10.0) == pytest.approx(10 * 0.9 * (200 - 90) / 0.8 * 0.4, rel=1e-12)
    assert effort(equation, 10.0, time=3.0) == pytest.approx(-9000.0)
    assert effort(equation, -10.0, time=3.0) == pytest.approx(9000.0)
    assert effort(equation, 25.0) == pytest.approx(10 * 0.9 * (200 - 225) / 0.8 / 0.4 - 9000.0, rel=1e-12)


def test_dimensions_of_a_motor_are_inputs_of_the_program_like_others() -> None:
    equation = machine(f"{INDUCTION}, ratio: 8, efficiency: 0.9, inertia: 0.02 kg·m²")
    own = {name for name in equation.source.dimensions() if name.startswith("actuators.main.")}
    short = {name.removeprefix("actuators.main.") for name in own}
    assert short == {"power", "speed", "synchronous", "pull_out", "ratio", "efficiency", "inertia"}
    assert own <= equation.numbers.keys()
    changed = equation.source.with_dimensions({"actuators.main.ratio": 4.0})
    assert isinstance(changed.actuators["main"], Motor) and changed.actuators["main"].ratio == 4.0


def test_motors_are_left_out_of_a_prescribed_motion() -> None:
    mechanism = machine(DC, speed="speed: 20 rpm").source
    forces = lw.solve_forces(lw.solve_motion(mechanism, steps=4))
    np.testing.assert_allclose(forces.input_torque, 0.0, atol=1e-12)
