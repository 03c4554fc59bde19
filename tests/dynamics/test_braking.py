"""Braking: constant torque by the formulas, a slider-crank by work and energy, what does not stop."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw

WHEEL = """
format: 1
name: Wheel
frame: {points: {O: [0 mm, 0 mm]}}
links: {wheel: {points: [O, P], length: 100 mm, inertia: 2 kg·m²}}
driver: {turn: wheel, about: O, speed: -30 rad/s}
"""
BRAKE = """
actuators:
  disc: {kind: brake, on: wheel, torque: 5 N·m, from: 3 s}
  motor: {kind: constant, on: wheel, torque: -1 N·m}
"""


@pytest.mark.parametrize(("text", "torque"), [(WHEEL + BRAKE, None), (WHEEL, 5.0)])
def test_constant_torque_brakes_as_the_formulas_say(text: str, torque: float | None) -> None:
    """t = J ω/T = 12 s, φ = J ω²/(2 T) = 180 rad; the motor is off, the brake acts at once."""
    found = lw.braking(lw.loads(text), torque=torque, positions=2)
    assert found.time == pytest.approx(12.0, rel=1e-9)
    assert found.way == pytest.approx(180.0, rel=1e-9)
    assert found.energy == pytest.approx(900.0, rel=1e-12)
    assert (found.formula_time, found.formula_way) == pytest.approx((12.0, 180.0), rel=1e-12)


def test_a_slider_crank_stops_where_the_brake_has_taken_its_energy() -> None:
    """Brake torque times angle is the kinetic energy where the brake alone works, whatever the inertia on the way."""
    crank = lw.loads("""
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm, inertia: 0.1 kg·m²}
  rod: {points: [A, B], length: 300 mm}
  slider: {points: [B], mass: 40 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 20 rad/s}
""")
    found = lw.braking(crank, torque=15.0, positions=6)
    theta = found.begin
    beta = np.arcsin(np.sin(theta) / 3.0)
    speed = 0.1 * np.sin(theta + beta) / np.cos(beta)
    assert found.energy == pytest.approx(0.5 * (0.1 + 40.0 * speed**2) * 400.0, rel=1e-9)
    assert found.way == pytest.approx(found.energy / 15.0, rel=1e-8)
    assert found.longest > found.time.min()
    assert "largest braking angle" in found.text()


def test_what_does_not_stop() -> None:
    with pytest.raises(lw.LinkwrightError, match="nothing brakes 'Wheel'"):
        lw.braking(lw.loads(WHEEL))
    driven = WHEEL + "loads: {hand: {kind: torque, on: wheel, magnitude: -10 N·m}}"
    with pytest.raises(lw.LinkwrightError, match="does not come to rest within 2 s"):
        lw.braking(lw.loads(driven), torque=5.0, at_most=2.0, positions=1)
    with pytest.raises(lw.LinkwrightError, match="how fast"):
        lw.braking(lw.loads(WHEEL.replace("speed: -30 rad/s", "free: true")), torque=5.0)
    assert math.isclose(
        lw.braking(lw.loads(WHEEL.replace("speed: -30 rad/s", "free: true")), torque=5.0, speed=30.0).longest, 12.0
    )
