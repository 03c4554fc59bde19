"""A motor's operating points against the formulas of a crank that lifts, a flywheel, and data sheets."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import trapezoid

import linkwright as lw

#: A flywheel of 2 kg·m² on an axle with 6 N·m against it, at 20 rad/s.
HOIST = """
format: 1
name: Hoist
frame: {points: {O: [0 mm, 0 mm]}}
links: {drum: {points: [O, P], length: 100 mm, inertia: 2 kg·m²}}
driver: {turn: drum, about: O, %s}
%s
loads: {rope: {kind: torque, on: drum, magnitude: -6 N·m}}
"""
SERVO = (
    "actuators: {motor: {kind: servo, on: drum, ratio: 10, efficiency: 0.8, inertia: 0.001 kg·m², continuous: 1 N·m, "
    "peak: 3 N·m, largest_speed: 3000 rpm, speed: 200 rad/s, gain: 5 N·m·s/rad}}"
)
DC = "actuators: {motor: {kind: dc, on: drum, ratio: 10, stall_torque: 3 N·m, no_load_speed: 250 rad/s}}"


def hoist(law: str = "speed: 20 rad/s", drive: str = "") -> lw.Mechanism:
    return lw.loads(HOIST % (law, drive))


def test_a_servo_lifts_with_the_torque_over_ratio_and_efficiency() -> None:
    """6 N·m on the drum are 6/(10·0.8) on the motor at 200 rad/s; per turn 2π·6/0.8 J."""
    duty = lw.motor_duty(hoist(drive=SERVO))
    assert duty.by == "law" and duty.suffices
    assert duty.torque == pytest.approx(0.75, rel=1e-12)
    assert duty.rms == duty.peak == pytest.approx(0.75, rel=1e-12)
    assert duty.speed == pytest.approx(200.0, rel=1e-12)
    assert duty.energy == pytest.approx(2 * math.pi * 6 / 0.8, rel=1e-12)
    assert duty.limit == pytest.approx(3.0)


def test_a_servo_rocks_its_flywheel() -> None:
    """q = sin t: T·i·η = 6 sign + (J + i² Jm)·q'' where it drives, back through the gear with η."""
    duty = lw.motor_duty(
        hoist('position: "sin(1 rad/s*t)*1 rad"', f"cycle: {{duration: 6.283185307179586 s}}\n{SERVO}"), steps=400
    )
    t = duty.time
    rate, second = np.cos(t), -np.sin(t)
    sense = np.sign(rate)
    load = sense * (6.0 + (2.0 + 0.1) * second)
    expected = np.where(load > 0.0, load / 8.0, load * 0.08)
    moving = np.abs(rate) > 1e-6
    assert duty.torque[moving] == pytest.approx(expected[moving], rel=1e-9)
    assert duty.rms == pytest.approx(math.sqrt(trapezoid(expected**2, t) / (2 * math.pi)), rel=1e-3)


def test_what_a_servo_is_too_small_for() -> None:
    small = SERVO.replace("continuous: 1 N·m, peak: 3 N·m", "continuous: 0.4 N·m, peak: 0.7 N·m")
    findings = lw.motor_duty(hoist(drive=small)).findings
    assert "more than the 0.7 N·m" in findings[0]
    assert "RMS torque 0.75 N·m is more than its continuous torque 0.4 N·m" in findings[1]
    fast = lw.motor_duty(hoist("speed: 40 rad/s", SERVO))
    assert "faster than its largest speed 3000 rpm" in fast.findings[0]


def test_a_motor_on_its_curve_runs_where_it_meets_the_load() -> None:
    """DC: 10·3·(1 - 10 ω/250) = 6 at ω = 20 rad/s; run-up exponential with J/c, c = 1.2 N·m·s: to 95 % ln 20·J/c."""
    duty = lw.motor_duty(hoist(drive=DC))
    assert duty.by == "run"
    assert duty.speed == pytest.approx(200.0, rel=1e-7)
    assert duty.torque == pytest.approx(0.6, rel=1e-6)
    assert duty.run_up == pytest.approx(math.log(20.0) * 2.0 / 1.2, rel=1e-3)


def test_a_diagram_of_operating_points() -> None:
    assert lw.motor_duty(hoist(drive=SERVO)).plot().kind == "operating_points"


def test_what_is_refused() -> None:
    with pytest.raises(lw.LinkwrightError, match="has no motor"):
        lw.motor_duty(hoist())
    with pytest.raises(lw.LinkwrightError, match="motor"):
        lw.motor_duty(hoist(drive=DC), "mtor")
    weak = DC.replace("3 N·m,", "0.5 N·m,")
    with pytest.raises(lw.LinkwrightError, match="does not come to run steadily"):
        lw.motor_duty(hoist(drive=weak))


def test_both_kinds_of_diagrams_of_a_machine() -> None:
    for kind in ("operating_points", "drive_margin"):
        assert lw.plot(hoist(drive=SERVO), kind).kind == kind
    with pytest.raises(lw.LinkwrightError, match="shows one machine"):
        lw.plot({"a": hoist(drive=SERVO), "b": hoist(drive=DC)}, "operating_points")
