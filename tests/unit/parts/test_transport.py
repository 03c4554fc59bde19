"""Loads on a trough that swings, against closed forms and a plain integration in tiny steps."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright.parts.trajectories.conveyor import Conveyor
from linkwright.parts.trajectories.transport import Trough, transport

G = 9.81


def harmonic(along: float, across: float, mu: float, n: int = 3600, second: float = 0.0) -> Trough:
    """A trough with the motion x = −A sin ωt (ω = 2π rad/s), accelerations given by their amplitudes."""
    t = np.arange(n) / n
    wave = np.sin(2 * math.pi * t)
    return Trough(along * wave + second * np.cos(4 * math.pi * t), across * wave, 1.0, (0.0, -G), mu, mu)


def test_rest_up_to_the_friction() -> None:
    assert transport(harmonic(0.399 * G, 0.0, 0.4)).phases[0].mode == "rest"
    stays = transport(harmonic(0.399 * G, 0.0, 0.4))
    assert stays.displacement == 0.0 and len(stays.phases) == 1
    assert {p.mode for p in transport(harmonic(0.401 * G, 0.0, 0.4)).phases} == {"rest", "forward", "backward"}


def test_slipping_begins_where_the_acceleration_reaches_friction() -> None:
    found = transport(harmonic(0.5 * G, 0.0, 0.4))
    first = next(p for p in found.phases if p.mode == "backward")
    assert first.start == pytest.approx(math.asin(0.8) / (2 * math.pi), abs=1e-6)
    assert abs(found.displacement) < 1e-9 and found.repeats


def test_slipping_stops_where_the_velocities_are_equal_again() -> None:
    """v = ∫ (−a + μ g) dt from the slip on becomes zero: cos φ0 − cos φ = sin φ0 (φ − φ0)."""
    from scipy.optimize import brentq

    found = transport(harmonic(0.5 * G, 0.0, 0.4))
    first = next(p for p in found.phases if p.mode == "backward")
    begin = math.asin(0.8)
    end = brentq(lambda x: math.cos(begin) - math.cos(x) - 0.8 * (x - begin), begin + 0.1, 2 * math.pi)
    assert first.end == pytest.approx(end / (2 * math.pi), abs=1e-6)


@pytest.mark.parametrize("fraction", [0.3, 0.6, 0.9])
def test_throw_lasts_as_long_as_the_throw_number_says(fraction: float) -> None:
    """Γ = √(((cos 2πn + 2π²n² − 1)/(2πn − sin 2πn))² + 1) for a flight over the fraction n of the cycle."""
    n = 2 * math.pi * fraction
    number = math.sqrt(((math.cos(n) + n * n / 2 - 1) / (n - math.sin(n))) ** 2 + 1)
    found = transport(harmonic(0.0, number * G, 0.4))
    flight = sum(p.end - p.start for p in found.phases if p.mode == "flight")
    assert flight == pytest.approx(fraction, abs=2e-5)


def tiny_steps(trough: Trough, cycles: int, parts_of_step: int) -> float:
    """Displacement in the last cycle, by Euler's steps with the same laws and no events."""
    n = len(trough.along) * parts_of_step
    t = np.arange(n) / parts_of_step
    index = np.append(np.arange(len(trough.along)), 0)
    f = np.interp(t, np.arange(len(index)), trough.along[index]) - trough.gravity[0]
    normal = np.interp(t, np.arange(len(index)), trough.across[index]) - trough.gravity[1]
    h, v, s, last = trough.period / n, 0.0, 0.0, 0.0
    for _ in range(cycles):
        last = s
        for a, force in zip(f.tolist(), normal.tolist(), strict=True):
            if v == 0.0 and abs(a) <= trough.static * force:
                continue
            rub = trough.kinetic * force
            sense = math.copysign(1.0, v) if v else -math.copysign(1.0, a)
            new = v + h * (-a - sense * rub)
            v = 0.0 if v * new < 0 else new
            s += h * v
    return s - last


def test_uneven_swing_carries_the_load_as_plain_integration_says() -> None:
    trough = harmonic(0.8 * G, 0.2 * G, 0.35, n=360, second=0.5 * G)
    found = transport(trough)
    assert found.repeats and abs(found.displacement) > 0.01
    assert found.displacement == pytest.approx(tiny_steps(trough, 4, 60), rel=3e-3)


SLIDER = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 40 mm}, rod: {points: [A, B], length: 100 mm}, trough: {points: [B]}}
joints: {bed: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: trough, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 10 rad/s}
gravity: [0, -9.81 m/s²]
"""


def test_throw_number_and_friction_are_those_between_positions() -> None:
    """Of a slider-crank, whose largest accelerations lie beside the inner dead point, in closed form."""
    found = Conveyor(lw.loads(SLIDER), "trough", friction=0.3, incline=math.radians(20.0), steps=37).solve()
    phi, r, rod = np.linspace(0.0, 2.0 * math.pi, 1_000_001), 0.04, 0.1
    root = np.sqrt(rod**2 - (r * np.sin(phi)) ** 2)
    second = -r * np.cos(phi) - r**2 * np.cos(2 * phi) / root - (r**2 * np.sin(2 * phi) / 2) ** 2 / root**3
    along, across = (100.0 * second * math.cos(math.radians(20.0)), -100.0 * second * math.sin(math.radians(20.0)))
    fall = G * math.cos(math.radians(20.0))
    assert found.throw_number == pytest.approx((-across).max() / fall, rel=1e-9)
    friction = np.abs(along + G * math.sin(math.radians(20.0))) / (across + fall)
    assert found.needed_friction == pytest.approx(friction.max(), rel=1e-9)
