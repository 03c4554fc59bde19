"""Motion under forces where a formula tells it: swings, falls, friction, impacts, run-ups, braking."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.special import ellipk
from tests.dynamics import models

import linkwright as lw

G = 9.81


@pytest.mark.parametrize("amplitude", [5.0, 60.0, 150.0])
def test_a_rod_swings_with_the_period_of_the_elliptic_integral(amplitude: float) -> None:
    """T = 4 √(2 l/3 g) K(sin²(φ/2)), φ from the lowest place; the pin carries m g + m ω² l/2 there."""
    half = np.radians(amplitude) / 2
    quarter = np.sqrt(2 / 3 / G) * ellipk(np.sin(half) ** 2)
    begin = 2 * half - np.pi / 2
    found = lw.run(lw.loads(models.PENDULUM), at=begin, duration=8.5 * quarter, tolerance=1e-13)
    rod = found.motion(times=quarter * np.arange(9)).link("rod")
    swing = 2 * half * np.array([1, 0, -1, 0, 1, 0, -1, 0, 1])
    assert rod.angle + np.pi / 2 == pytest.approx(swing, abs=1e-10)
    speed = np.sqrt(6 * G) * np.sin(half)
    assert rod.angular_velocity[[1, 3]] == pytest.approx([-speed, speed], rel=1e-10)
    force = found.joint_forces(times=[quarter]).reaction("O", on="rod")[0]
    assert force == pytest.approx([0.0, 3 * G + 3 * speed**2 / 2], abs=1e-8)


def test_a_block_falls() -> None:
    found = lw.run(lw.loads(models.FALL), duration=2.0)
    assert found.end_state["driver"] == pytest.approx((-2 * G, -2 * G), rel=1e-12)


def incline(friction: float) -> lw.Mechanism:
    return lw.loads(models.INCLINE.replace("at: B}", f"at: B, friction: {friction}}}"))


def test_a_block_comes_to_rest_on_a_rough_incline_and_stays() -> None:
    """Up with v, it is slowed by g (sin β + μ cos β); μ > tan β holds it. What presses on it is m g cos β."""
    v, beta, mu = 3.0, np.radians(30), 0.7
    slowed = G * (np.sin(beta) + mu * np.cos(beta))
    found = lw.run(incline(mu), speed=v, duration=1.0)
    assert found.events[0].time == pytest.approx(v / slowed, rel=1e-10)
    place, rate = found.end_state["driver"]
    assert (place, rate) == (pytest.approx(v**2 / slowed / 2, rel=1e-10), 0.0)
    press = 4 * G * np.cos(beta) * np.array([-np.sin(beta), np.cos(beta)])
    assert found.joint_forces(times=[0.9]).reaction("incline", on="block")[0] == pytest.approx(press, abs=1e-9)


def test_a_block_comes_back_down_a_smoother_incline() -> None:
    v, beta, mu = 3.0, np.radians(30), 0.2
    up, down = (G * (np.sin(beta) + sign * mu * np.cos(beta)) for sign in (1, -1))
    turn = v / up
    found = lw.run(incline(mu), speed=v, duration=2.0)
    assert found.events[0].time == pytest.approx(turn, rel=1e-10)
    rate = -down * (2.0 - turn)
    assert found.end_state["driver"] == pytest.approx((v * turn / 2 + rate * (2.0 - turn) / 2, rate), rel=1e-10)


def test_a_rod_bounces_off_a_stop() -> None:
    """From level onto a stop at the lowest place: ω = √(3 g/l), then e ω, e² ω …; between impacts the half period of
    a swing of this speed, the impulse J (1 + e) times the speed before it."""
    e, inertia = 0.6, 1.0
    text = models.PENDULUM + "stops: {buffer: {of: rod.angle, at: -90 deg, side: below, restitution: 0.6}}\n"
    found = lw.run(lw.loads(text), at=0.0, duration=3.0, tolerance=1e-12)
    impacts = [event for event in found.events if event.kind == "impact"]
    speed = np.sqrt(3 * G)
    assert impacts[0].time == pytest.approx(np.sqrt(2 / 3 / G) * ellipk(0.5), rel=1e-10)
    assert len(impacts) >= 4
    for before, after in pairwise(impacts):
        assert before.value == pytest.approx(inertia * (1 + e) * speed, rel=1e-9)
        speed *= e
        height = speed**2 / (6 * G)
        assert after.time - before.time == pytest.approx(2 * np.sqrt(2 / 3 / G) * ellipk(height), rel=1e-9)
    assert found.energy_residual < 1e-10


def test_a_block_comes_to_rest_on_a_stop_after_endless_bounces() -> None:
    """From h onto a stop with e: at rest on it after √(2 h/g) (1 + e)/(1 - e), whose force then is the weight."""
    h, e = 0.8, 0.5
    text = models.FALL + f"stops: {{floor: {{of: guide, at: 0 m, side: below, restitution: {e}}}}}\n"
    found = lw.run(lw.loads(text), at=h, until="rest", at_most=5.0, tolerance=1e-12)
    assert found.end == pytest.approx(np.sqrt(2 * h / G) * (1 + e) / (1 - e), rel=1e-4)
    assert found.end_state["driver"] == pytest.approx((0.0, 0.0), abs=1e-9)
    flights = np.diff([event.time for event in found.events if event.kind == "impact"])[:8]
    assert flights[1:] / flights[:-1] == pytest.approx([e] * 7, rel=1e-7)


def test_a_flywheel_is_braked_by_a_constant_torque() -> None:
    """t = J ω/M, φ = J ω²/2 M."""
    text = models.FLYWHEEL + "actuators: {brake: {kind: brake, on: wheel, torque: 5 N·m}}\n"
    found = lw.run(lw.loads(text), speed=30.0, until="rest", at_most=60.0)
    assert found.end == pytest.approx(0.8 * 30 / 5, rel=1e-10)
    assert found.end_state["driver"] == pytest.approx((0.8 * 30**2 / 10, 0.0), rel=1e-10)


def test_a_dc_motor_runs_a_flywheel_up_by_an_exponential() -> None:
    """k = 0.5 N·m/A, R = 0.8 Ω, U = 24 V through a gear of i = 3 and η = 0.9, rotor 0.02 kg·m²:
    (J + i² J_r) dω/dt = η i k (U - k i ω)/R."""
    text = models.FLYWHEEL + (
        "actuators:\n  motor: {kind: dc, on: wheel, voltage: 24 V, constant: 0.5 N·m/A, resistance: 0.8 ohm, "
        "ratio: 3, efficiency: 0.9, inertia: 0.02 kg·m²}\n"
    )
    times = np.array([0.0, 0.3, 1.0, 3.0])
    found = lw.run(lw.loads(text), duration=3.0, tolerance=1e-12)
    slope = 0.9 * 3 * 0.5 * (0.5 * 3) / 0.8
    rate = slope / (0.8 + 9 * 0.02)
    speed = found.motion(times=times).link("wheel").angular_velocity
    assert speed == pytest.approx(24 / 1.5 * (1 - np.exp(-rate * times)), rel=1e-10, abs=1e-10)
