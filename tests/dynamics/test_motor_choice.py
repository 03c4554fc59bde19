"""The smallest motor of a catalogue: reasons by hand, and the catalogue's own mistakes."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import trapezoid

import linkwright as lw

#: A drum of 2 kg·m² that lifts 60 N·m at 10 rad/s.
HOIST = """
format: 1
name: Hoist
frame: {points: {O: [0 mm, 0 mm]}}
links: {drum: {points: [O, P], length: 100 mm, inertia: 2 kg·m²}}
driver: {turn: drum, about: O, speed: 10 rad/s}
loads: {rope: {kind: torque, on: drum, magnitude: -60 N·m}}
"""
MOTORS = """
motors:
  large: {kind: servo, continuous: 9 N·m, peak: 27 N·m, largest_speed: 3000 rpm, mass: 9 kg}
  hot: {kind: servo, continuous: 2 N·m, peak: 12 N·m, largest_speed: 3000 rpm, mass: 2 kg}
  weak: {kind: servo, continuous: 1 N·m, peak: 3 N·m, largest_speed: 3000 rpm, mass: 1 kg}
  slow: {kind: dc, stall_torque: 30 N·m, no_load_speed: 150 rad/s, largest_speed: 90 rad/s, mass: 3 kg}
  fits: {kind: induction, power: 1.1 kW, speed: 1420 rpm, synchronous: 1500 rpm, pull_out: 2.5, inertia: 0.002 kg·m²,
         mass: 5 kg}
gears:
  i14: {ratio: 14, efficiency: 0.9}
"""


def catalogue(tmp_path: Path, text: str = MOTORS, name: str = "motors.yaml") -> str:
    path = tmp_path / name
    path.write_text(text, "utf-8")
    return str(path)


def test_each_motor_and_why_it_does_not_do(tmp_path: Path) -> None:
    """60/(14·0.9) = 4.76 N·m all the time: 3 N·m do not start it, 2 N·m get too hot, 90 rad/s is too slow."""
    choice = lw.choose_motor(lw.loads(HOIST), catalogue(tmp_path))
    assert [each.motor.name for each in choice.candidates] == ["weak", "hot", "slow", "fits", "large"]
    weak, hot, slow, fits, large = choice.candidates
    assert weak.margin == pytest.approx(3 * 14 * 0.9 / 60)
    assert "does not start: 37.8 N·m of 60 N·m" in str(weak.refused)
    assert "RMS torque 4.762 N·m is more than its continuous torque 2 N·m" in str(hot.refused)
    assert "must turn at 1337 rpm, its limit is 859.4 rpm" in str(slow.refused)
    assert choice.best is fits and fits.suffices
    assert not large.tried and not large.suffices
    every = lw.choose_motor(lw.loads(HOIST), catalogue(tmp_path), every=True)
    assert every.candidates[-1].suffices and every.best is not None and every.best.motor.name == "fits"


def test_the_chosen_motor_runs_where_its_curve_meets_the_load(tmp_path: Path) -> None:
    """Kloss: T(s) = 2 m Tn s sk/(s² + sk²) = 60/(14·0.9) with Tn = 1100 W/148.7 rad/s; energy per turn 2π·60/0.9."""
    choice = lw.choose_motor(lw.loads(HOIST), catalogue(tmp_path))
    assert choice.best is not None and choice.best.duty is not None
    duty = choice.best.duty
    rated = 1100.0 / (1420 * math.pi / 30)
    breakdown = (80 / 1500) * (2.5 + math.sqrt(2.5**2 - 1))
    torque = 60 / (14 * 0.9)
    ratio = 2.5 * rated / torque
    slip = breakdown * (ratio - math.sqrt(ratio**2 - 1))
    assert duty.speed == pytest.approx(1500 * math.pi / 30 * (1 - slip), rel=1e-6)
    assert duty.rms == pytest.approx(torque, rel=1e-5)
    assert duty.energy == pytest.approx(2 * math.pi * 60 / 0.9, rel=1e-5)
    at_rest = 2 * 2.5 * rated * breakdown / (1 + breakdown**2)
    assert choice.best.margin == pytest.approx(at_rest * 14 * 0.9 / 60, rel=1e-9)
    assert "fits" in choice.mechanism.actuators
    assert lw.loads(lw.dump(choice.mechanism)).actuators["fits"] == choice.mechanism.actuators["fits"]


def test_run_up_of_a_servo_at_its_limit(tmp_path: Path) -> None:
    """A flywheel of 2 kg·m² by 14·27 N·m: t = J·0.95 ω/T."""
    wheel = lw.loads(HOIST.replace("magnitude: -60 N·m", "magnitude: 0 N·m"))
    servo = "{kind: servo, continuous: 9 N·m, peak: 27 N·m, largest_speed: 3000 rpm}"
    text = f"motors: {{s: {servo}}}\ngears: {{g: {{ratio: 14}}}}"
    choice = lw.choose_motor(wheel, catalogue(tmp_path, text))
    assert choice.best is not None and choice.best.duty is not None
    assert choice.best.duty.run_up == pytest.approx(2.0 * 9.5 / (14 * 27), rel=2e-2)


def test_a_longest_run_up(tmp_path: Path) -> None:
    choice = lw.choose_motor(lw.loads(HOIST), catalogue(tmp_path), longest_run_up=1e-3)
    assert choice.best is None
    assert "runs up in" in str(choice.candidates[3].refused)
    with pytest.raises(lw.LinkwrightError, match="no motor of"):
        choice.mechanism  # noqa: B018


def test_the_example_is_a_catalogue() -> None:
    listed: lw.Catalogue = lw.read_catalogue()
    assert {each.motor.kind for each in listed.motors.values()} == {"induction", "servo", "dc"}
    assert all(each.rating.continuous and each.mass for each in listed.motors.values())
    assert lw.choose_motor(lw.loads(HOIST)).best is not None


def test_mistakes_of_catalogues(tmp_path: Path) -> None:
    for text, message in (
        ("motors: {A: {kind: brake, torque: 2 N·m}}", "is no motor"),
        ("motors: {A: {kind: servo, continuous: 2 N·m}}", "peak"),
        (
            "motors: {A: {kind: servo, continuous: 2 N·m, peak: 1 N·m, largest_speed: 3000 rpm}}",
            "below the continuous",
        ),
        ("gears: {g: {ratio: 3}}", "has no motors"),
        ("motor: {}", "unknown key"),
        (MOTORS.replace("ratio: 14", "ratio: -14"), "ratio"),
    ):
        with pytest.raises(lw.LinkwrightError, match=message):
            lw.read_catalogue(catalogue(tmp_path, text))
    with pytest.raises(lw.LinkwrightError, match="no column name"):
        lw.read_catalogue(catalogue(tmp_path, "kind,peak\nservo,3 N·m\n", "m.csv"))


def test_a_machine_that_no_motor_can_drive(tmp_path: Path) -> None:
    free = lw.loads(HOIST.replace("speed: 10 rad/s", "free: true"))
    with pytest.raises(lw.LinkwrightError, match="how fast"):
        lw.choose_motor(free, catalogue(tmp_path))


def test_a_crusher_gets_the_motor_that_starts_it_in_its_stroke() -> None:
    """Its load begins and ends at limit positions, where a lap of the crank ends too: the run passes them, and gives
    the machine the work of its load, as a motor's efficiency is lost on what flows back as well."""
    crusher = lw.load("gallery:jaw_crusher_fourbar")
    choice = lw.choose_motor(crusher, steps=72)
    assert choice.best is not None and choice.best.duty is not None
    assert (choice.best.motor.name, choice.best.motor.ratio) == ("A-7.5", 8.0)
    found = lw.run(choice.mechanism, until="steady")
    assert found.energy_residual < 1e-9
    duty, eta = choice.best.duty, choice.best.motor.efficiency or 1.0
    driving = np.where(duty.torque > 0.0, eta, 1.0 / eta)
    given = trapezoid(duty.torque * duty.speed * driving, duty.time)
    load = lw.solve_forces(crusher, static=True, steps=2000)
    assert given == pytest.approx(2 * math.pi * abs(float(np.mean(load.input_torque))), rel=2e-3)
