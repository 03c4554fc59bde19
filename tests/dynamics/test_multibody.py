"""The independent multibody integration itself: closed forms and energy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ellipk
from tests.dynamics import models
from tests.multibody import FreeMotion, FreeMultibody, motor

import linkwright as lw

G = 9.81


def free(text: str, times: list[float], rates: dict[str, float] | None = None, **options: object) -> FreeMotion:
    owner = FreeMultibody(lw.loads(text), **options)  # type: ignore[arg-type]
    return owner.run(owner.start(rates=rates), np.array(times))


def test_a_rod_swings_with_the_period_of_the_elliptic_integral() -> None:
    """T = 4 √(2 l / 3 g) K(sin² 30°) from 60° beside the lowest place; there the pin carries m g + m ω² l/2."""
    quarter = np.sqrt(2 / 3 / G) * ellipk(np.sin(np.pi / 6) ** 2)
    found = free(models.PENDULUM, [0.0, quarter, 2 * quarter])
    angle, rate, _ = found.motion.angle("rod")
    assert angle == pytest.approx(np.radians([-30, -90, -150]), abs=1e-11)
    speed = np.sqrt(3 * G * (1 - np.cos(np.pi / 3)))
    assert rate == pytest.approx([0.0, -speed, 0.0], abs=1e-10)
    force, _ = found.forces.on("O", "rod")
    assert force[1] == pytest.approx([0.0, 3 * G + 3 * speed**2 / 2], abs=1e-9)


def test_a_motor_whose_torque_falls_with_the_speed_runs_up_by_an_exponential() -> None:
    """(J + J_r) dω/dt = M₀ - k ω."""
    times = np.array([0.0, 0.3, 1.0])
    owner = FreeMultibody(
        lw.loads(models.FLYWHEEL),
        loading=[motor("wheel", lambda speed, _time: 12.0 - 0.6 * speed)],
        rotors=[("wheel", "frame", 0.4)],
    )
    found = owner.run(owner.start(), times)
    assert found.motion.angle("wheel")[1] == pytest.approx(20 * (1 - np.exp(-times / 2)), abs=1e-10)
    torque = found.forces.on("O", "wheel", np.zeros((3, 2)))[1]
    assert torque == pytest.approx(np.zeros(3), abs=1e-10)


def test_a_block_slides_down_and_presses_with_the_cosine_of_its_weight() -> None:
    found = free(models.INCLINE, [0.0, 0.5])
    place = found.motion.point("block", (0.0, 0.0))[0]
    assert np.hypot(*place[1]) == pytest.approx(0.5 * G / 2 * 0.5**2, rel=1e-12)
    force = found.forces.on("incline", "block")[0][1]
    assert force == pytest.approx(4 * G * np.cos(np.pi / 6) * np.array([-0.5, np.sqrt(0.75)]), rel=1e-12)


def test_gears_turn_the_inertia_of_both_wheels() -> None:
    """α of the wheel M / (J₂ + J₁ i²); the teeth give it what its own inertia does not take of the load."""
    owner = FreeMultibody(lw.load("gallery:external_gear_pair"))
    found = owner.run(owner.start(), np.array([0.0, 0.01]))
    assert found.motion.angle("wheel")[2] == pytest.approx([1e4, 1e4], rel=1e-12)
    forces, beside = found.pressed
    on_pinion = forces.on("mesh", "pinion")[0] + beside["mesh"][0].force
    tooth = (40 - 0.0032 * 1e4) / 0.04
    assert on_pinion[0] == pytest.approx([-tooth * np.tan(np.radians(20)), -tooth], rel=1e-11)


def test_a_parallelogram_with_three_cranks_and_without_mass_of_its_coupler() -> None:
    """Redundant pins and a massless link: three cranks swing like one, a load on the coupler hangs on all."""
    text = """
format: 1
name: Parallelogram
frame: {points: {O: [0 m, 0 m], P: [1 m, 0 m], Q: [2 m, 0 m]}}
links:
  a: {points: [O, A], length: 0.5 m, mass: 2 kg, inertia: 0.05 kg·m²}
  b: {points: [P, B], length: 0.5 m, mass: 2 kg, inertia: 0.05 kg·m²}
  c: {points: {Q: [0 m, 0 m], C: [0.5 m, 0 m]}, mass: 2 kg, inertia: 0.05 kg·m²}
  bar: {points: {A: [0 m, 0 m], B: [1 m, 0 m], C: [2 m, 0 m]}}
loads: {pull: {kind: force, on: bar, at: B, components: [0 N, -30 N]}}
assembly: {B: left}
driver: {turn: a, about: O, speed: 1 rad/s, start: -20 deg}
gravity: [0, -9.81 m/s²]
"""
    owner = FreeMultibody(lw.loads(text))
    start = owner.start()
    wanted = -(3 * 2 * G * 0.25 + 30 * 0.5) * np.cos(np.radians(20)) / (3 * (0.05 + 2 * 0.25**2))
    assert owner.acceleration(0.0, *start)[1:, 2] == pytest.approx([wanted, wanted, wanted, 0.0], abs=1e-10)


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("text", "end"),
    [(models.CRANK_ROCKER, 0.6), (models.TRIPLE_ROCKER, 1.4), (models.DOUBLE_PENDULUM, 0.8), (models.FIVE_BAR, 0.2)],
)
def test_energy_is_kept(text: str, end: float) -> None:
    found = free(text, [0.0, end])
    weight = [
        body.mass * G * found.motion.point(body.name, body.centre)[0][:, 1] for body in found.owner.system.bodies
    ]
    energy = found.kinetic + np.sum(weight, axis=0)
    assert abs(energy[1] - energy[0]) < 2e-12 * found.kinetic[1]
    assert found.gap < 1e-9
