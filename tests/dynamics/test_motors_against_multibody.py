"""Machines that motors, cylinders and brakes move, against an independent integration with torques written anew."""

from __future__ import annotations

import numpy as np
import pytest
from tests.dynamics import models
from tests.dynamics.agreement import by_multibody, disagreements
from tests.multibody import Loading, motor
from tests.reference.multibody import Array, Motion, Wrench

import linkwright as lw


def geared(torque: Array, speed: Array, ratio: float, efficiency: float) -> Array:
    """A motor's torque on the link behind a gear: less where it drives, more where it is driven."""
    return np.asarray(ratio * torque * np.where(torque * speed > 0.0, efficiency, 1.0 / efficiency))


def dc(speed: Array, _time: Array) -> Array:
    """24 V, 0.12 N·m/A, 0.9 Ω, through i = 6, η = 0.85."""
    turned = 6.0 * speed
    return geared(0.12 * (24.0 - 0.12 * turned) / 0.9, turned, 6.0, 0.85)


def kloss(speed: Array, _time: Array) -> Array:
    """120 W at 1380 of 1500 turns a minute, pull-out 2.2, through i = -8, η = 0.9: it turns the link clockwise."""
    turned, synchronous, rated = -8.0 * speed, 50 * np.pi, 46 * np.pi
    slip, breakdown = 1 - turned / synchronous, (1 - 46 / 50) * (2.2 + np.sqrt(2.2**2 - 1))
    return geared(2 * 2.2 * 120 / rated / (slip / breakdown + breakdown / slip), turned, -8.0, 0.9)


MOTORS = """
actuators:
  one: {kind: dc, on: crank_1, voltage: 24 V, constant: 0.12 N·m/A, resistance: 0.9 ohm, ratio: 6, efficiency: 0.85,
        inertia: 2e-5 kg·m²}
  two: {kind: induction, on: crank_2, power: 120 W, speed: 1380 rpm, synchronous: 1500 rpm, pull_out: 2.2, ratio: -8,
        efficiency: 0.9, inertia: 1e-5 kg·m²}
"""


@pytest.mark.rotating
def test_two_motors_run_a_five_bar_up() -> None:
    """One forwards, one backwards, with the inertia of their rotors."""
    mechanism = lw.loads(models.FIVE_BAR + MOTORS)
    speed = {"one": 2.0, "two": -2.0}
    found = lw.run(mechanism, speed=speed, duration=0.12, tolerance=1e-12)
    rotors = [("crank_1", "frame", 36 * 2e-5), ("crank_2", "frame", 64 * 1e-5)]
    loading = [motor("crank_1", dc), motor("crank_2", kloss)]
    plain = lw.loads(models.FIVE_BAR)
    expected = by_multibody(plain, [0.0, 0.06, 0.12], speed=speed, loading=loading, rotors=rotors)
    assert abs(expected.motion.angle("crank_2")[1][-1]) > 10.0
    assert not disagreements(found, expected)
    assert found.energy_residual < 1e-10


def pushed(force: float, largest: float) -> Loading:
    """A cylinder from S on the frame to the coupler's end B, whose force falls with its speed outwards."""

    def load(motion: Motion, time: Array) -> list[Wrench]:
        place, rate, _ = motion.point("coupler", (0.35, 0.0))
        out = place - np.array([0.1, 0.4])
        out = out / np.hypot(*out.T)[:, None]
        ahead = (out * rate).sum(1)
        size = force * np.where(ahead > 0.0, 1 - ahead / largest, 1.0)
        none = np.zeros(len(time))
        fixed = np.broadcast_to([0.1, 0.4], place.shape)
        push = out * size[:, None]
        return [Wrench("coupler", place, push, none), Wrench("frame", fixed, -push, none)]

    return load


@pytest.mark.parametrize(
    ("line", "speed", "loading"),
    [
        (
            "ram: {kind: cylinder, between: [frame.S, coupler.B], force: 120 N, largest_speed: 1.5 m/s}",
            0.0,
            pushed(120.0, 1.5),
        ),
        (
            "disc: {kind: brake, on: crank, torque: 1.4 N·m}",
            25.0,
            motor("crank", lambda speed, _time: -1.4 * np.sign(speed)),
        ),
    ],
    ids=["cylinder", "brake"],
)
def test_a_crank_rocker_is_pushed_and_braked(line: str, speed: float, loading: Loading) -> None:
    text = models.CRANK_ROCKER.replace("O2: [0.4 m, 0 m]", "O2: [0.4 m, 0 m], S: [0.1 m, 0.4 m]")
    found = lw.run(lw.loads(text + f"actuators: {{{line}}}\n"), speed=speed, duration=0.1, tolerance=1e-12)
    expected = by_multibody(lw.loads(text), [0.0, 0.1], speed={"driver": speed}, loading=[loading])
    assert not disagreements(found, expected)
