"""Runs of a wheel and a table that actuators move, against closed forms of elementary mechanics."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw

RPM = 2 * math.pi / 60
WHEEL = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  wheel: {points: [O, A], length: 1 m, mass: 3 kg, inertia: 2 kg·m², mass_centre: O}
driver: {turn: wheel, about: O, free: true}
actuators:
"""
TABLE = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  table: {points: [P], mass: 5 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: table, at: P}
driver: {slide: guide, free: true}
actuators:
"""
DC = "kind: dc, voltage: 200 V, constant: 0.9 N·m/A, resistance: 0.8 ohm, on: wheel"


def run(*actuators: str, text: str = WHEEL, duration: float = 1.0, **options: object) -> lw.Run:
    lines = [f"  a{number}: {{{each}}}\n" for number, each in enumerate(actuators)]
    found = lw.run(lw.loads(text + "".join(lines)), duration=duration, **options)  # type: ignore[arg-type]
    assert found.residual < 1e-8 * max(found.largest, 1.0)
    return found


def rates(found: lw.Run, steps: int = 20) -> tuple[np.ndarray, np.ndarray]:
    motion = found.motion(steps=steps)
    table = "table" in motion.mechanism.links
    return motion.time, motion.point("P").velocity[:, 0] if table else motion.link("wheel").angular_velocity


def test_a_direct_current_motor_runs_up_along_an_exponential() -> None:
    """J·ω' = k(U - kω)/R: ω = U/k·(1 - exp(-t/τ)), τ = J·R/k²."""
    time, omega = rates(run(f"{DC}, inertia: 0.5 kg·m²"))
    constant = 2.5 * 0.8 / 0.9**2
    np.testing.assert_allclose(omega, 200 / 0.9 * (1 - np.exp(-time / constant)), rtol=1e-9, atol=1e-9)


def test_an_induction_motor_runs_up_in_the_time_of_kloss_curve() -> None:
    """t = J·ω0/(2Tk)·[(1 - s²)/(2sk) + sk·ln(1/s)], from rest to the slip s (Kloss' curve integrated)."""
    found = run(
        "kind: induction, on: wheel, power: 4 kW, speed: 1455 rpm, synchronous: 1500 rpm, pull_out: 2.5", duration=6.0
    )
    time, omega = rates(found)
    slip, critical = 1 - omega / (1500 * RPM), 0.03 * (2.5 + math.sqrt(5.25))
    peak = 2.5 * 4000 / (1455 * RPM)
    of_slip = 2 * 1500 * RPM / (2 * peak) * ((1 - slip**2) / (2 * critical) + critical * np.log(1 / slip))
    np.testing.assert_allclose(of_slip, time, rtol=1e-8, atol=1e-8)


def test_a_star_delta_start_takes_three_times_as_long_at_first() -> None:
    data = "kind: induction, on: wheel, power: 4 kW, speed: 1455 rpm, synchronous: 1500 rpm, pull_out: 2.5"
    delta, star = run(data), run(f"{data}, star_until: 3 s", duration=3.0)
    assert rates(star)[1][-1] == pytest.approx(rates(delta)[1][-1], rel=1e-9)


def test_a_brake_stops_in_the_time_of_its_torque() -> None:
    """10 rad/s and 2 kg·m² against 50 N·m: 0.4 s, 2 rad."""
    found = run("kind: brake, on: wheel, torque: 50 N·m, from: 0.1 s", duration=5.0, until="rest", speed=10.0)
    assert found.end == pytest.approx(0.5, abs=1e-9)
    assert found.end_state["driver"] == pytest.approx((3.0, 0.0), abs=1e-8)


def test_a_cylinder_comes_to_the_speed_of_its_flow() -> None:
    """m·v' = F(1 - v/v0): v = v0·(1 - exp(-F·t/(m·v0)))."""
    time, speed = rates(run("kind: cylinder, along: guide, force: 40 N, largest_speed: 0.5 m/s", text=TABLE))
    np.testing.assert_allclose(speed, 0.5 * (1 - np.exp(-40 * time / 2.5)), rtol=1e-9, atol=1e-10)


def test_a_servo_runs_up_with_its_peak_torque_and_then_settles() -> None:
    """Peak 30 N·m until 2·(20 - ω) = 30 at 5 rad/s, then exp(-t·2/2)."""
    data = "continuous: 10 N·m, peak: 30 N·m, largest_speed: 300 rad/s, speed: 20 rad/s, gain: 2 N·m·s/rad"
    time, omega = rates(run(f"kind: servo, on: wheel, {data}", duration=3.0), 30)
    reached = 5.0 / 15.0
    expected = np.where(time < reached, 15.0 * time, 20.0 - 15.0 * np.exp(reached - time))
    np.testing.assert_allclose(omega, expected, rtol=1e-8, atol=1e-8)


def test_a_motor_through_a_gear_finds_the_speed_at_which_its_torque_is_the_load() -> None:
    """i·T·η = L when it drives, i·T/η = -L when the load overruns it; T = 225·(1 - i·ω/222.2)."""
    for load, share in ((-900.0, 900 / (2250 * 0.8)), (900.0, -900 * 0.8 / 2250)):
        found = run(
            f"{DC}, ratio: 10, efficiency: 0.8", f"kind: constant, on: wheel, torque: {load} N·m", duration=2.0
        )
        assert rates(found)[1][-1] == pytest.approx(200 / 9.0 * (1 - share), rel=1e-8)


def test_a_gear_that_is_loaded_beyond_its_start_does_not_move() -> None:
    """The motor has 2250·0.8 = 1800 N·m at rest, and holds up to 2250/0.8 = 2812 N·m."""
    for load in (-1900.0, -2800.0):
        found = run(f"{DC}, ratio: 10, efficiency: 0.8", f"kind: constant, on: wheel, torque: {load} N·m")
        assert np.abs(rates(found)[1]).max() < 1e-12


def test_a_worm_holds_what_would_drive_it_and_lowers_it_at_the_speed_of_the_motor() -> None:
    worm = f"{DC}, ratio: 10, efficiency: 0.4, self_locking: true, holding: 9 kN·m"
    held = run(f"{worm}, until: 0 s", "kind: constant, on: wheel, torque: 500 N·m")
    assert np.abs(rates(held)[1]).max() == 0.0
    for way in (worm, worm.replace(", efficiency: 0.4", "")):
        lowered = run(way, "kind: constant, on: wheel, torque: 500 N·m")
        assert rates(lowered)[1][-1] == pytest.approx(200 / 9.0, rel=1e-9)


def test_a_flywheel_slows_the_start() -> None:
    """30 N·m on 2 + 3²·0.5 = 6.5 kg·m²."""
    found = run(
        "kind: constant, on: wheel, torque: 30 N·m", "kind: flywheel, on: wheel, inertia: 0.5 kg·m², ratio: 3"
    )
    time, omega = rates(found)
    np.testing.assert_allclose(omega, 30 / 6.5 * time, rtol=1e-10, atol=1e-12)


def test_a_curve_with_kinks_is_integrated_from_kink_to_kink() -> None:
    """40 to 60 N·m over 0 to 10 rad/s, then 60 to 0 over 10 to 20: each piece an exponential."""
    found = run("kind: curve, on: wheel, speed: [0 rad/s, 10 rad/s, 20 rad/s], torque: [40 N·m, 60 N·m, 0 N·m]")
    time, omega = rates(found)
    first = 2 / 2 * math.log(60 / 40)  # J·ω' = 40 + 2ω: ω = 20·(exp(t·2/2) - 1), 10 at ln 1.5
    expected = np.where(time < first, 20 * (np.exp(time) - 1), 20 - 10 * np.exp(-3 * (time - first)))
    np.testing.assert_allclose(omega, expected, rtol=1e-9, atol=1e-9)
