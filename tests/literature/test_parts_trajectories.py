"""Flights and conveyors against closed forms and a plain integration in tiny steps."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts
from linkwright.parts.trajectories.transport import Trough, transport

G = 9.81


def test_throw_without_drag() -> None:
    found = parts.Particle(20.0, math.radians(40), 3.0, gravity=G).solve()
    u, v = 20 * math.cos(math.radians(40)), 20 * math.sin(math.radians(40))
    time = (v + math.sqrt(v * v + 6 * G)) / G
    assert found.duration == pytest.approx(time, rel=1e-12)
    assert found.range == pytest.approx(u * time, rel=1e-12)
    assert found.top == pytest.approx(3 + v * v / (2 * G), rel=1e-12)
    assert found.impact[0] == pytest.approx(math.sqrt(400 + 6 * G), rel=1e-12)


def test_fall_with_quadratic_drag() -> None:
    """y = h − v∞²/g ln cosh(g t/v∞)."""
    found = parts.Particle(0.0, 0.0, 50.0, mass=2.0, quadratic=0.01, gravity=G).solve()
    end = math.sqrt(2.0 * G / 0.01)
    time = end / G * math.acosh(math.exp(50 * G / end**2))
    assert found.duration == pytest.approx(time, rel=1e-9)
    assert found.impact[0] == pytest.approx(end * math.tanh(G * time / end), rel=1e-9)


def test_rise_with_quadratic_drag() -> None:
    """h = m/(2k) ln(1 + k v²/(m g))."""
    found = parts.Particle(30.0, math.pi / 2, mass=2.0, quadratic=0.01, gravity=G).solve()
    assert found.top == pytest.approx(100 * math.log(1 + 0.01 * 900 / (2 * G)), rel=1e-9)


def test_linear_drag_keeps_the_equation_of_motion() -> None:
    found = parts.Particle(30.0, 0.7, 2.0, mass=0.5, linear=0.2, gravity=G).solve()
    t, h = np.linspace(0.1, 0.9 * found.duration, 7), 1e-4
    before, now, after = (found.state(t + d) for d in (-h, 0.0, h))
    assert (after[:2] - before[:2]) / (2 * h) == pytest.approx(now[2:], rel=1e-6)
    force = np.array([[0.0], [-G]]) - 0.4 * now[2:]
    assert (after[2:] - before[2:]) / (2 * h) == pytest.approx(force, rel=1e-6)
    assert found.state(np.array([found.duration]))[1, 0] == pytest.approx(0, abs=1e-9)


def test_thrown_by_a_mechanism() -> None:
    text = (
        "format: 1\nframe: {points: {O: [0 m, 1 m]}}\nlinks: {arm: {points: [O, P], length: 2 m}}\n"
        "driver: {turn: arm, about: O, speed: 5 rad/s}\n"
    )
    thrower = {"point": "arm.P", "at": math.radians(120), "ground": 0.0}
    found = parts.Particle.thrown(lw.loads(text), thrower, {"gravity": G}).solve()
    assert found.particle.speed == pytest.approx(10)
    assert math.degrees(found.particle.angle or 0) == pytest.approx(-150)
    assert found.particle.height == pytest.approx(1 + 2 * math.sin(math.radians(120)))


def harmonic(along: float, across: float, mu: float, n: int = 3600, second: float = 0.0) -> Trough:
    """A trough with the motion x = −A sin ωt (ω = 2π rad/s), accelerations given by their amplitudes."""
    t = np.arange(n) / n
    wave = np.sin(2 * math.pi * t)
    return Trough(along * wave + second * np.cos(4 * math.pi * t), across * wave, 1.0, (0.0, -G), mu, mu)


def test_rest_up_to_the_friction() -> None:
    assert transport(harmonic(0.399 * G, 0.0, 0.4)).phases[0].mode == "rest"
    stays = transport(harmonic(0.399 * G, 0.0, 0.4))
    assert stays.displacement == 0.0 and len(stays.phases) == 1
    assert {p.mode for p in transport(harmonic(0.401 * G, 0.0, 0.4)).phases} == {
        "rest",
        "forward",
        "backward",
    }


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


def test_fast_trough_lets_its_load_slide_both_ways_equally_long() -> None:
    """Without rest, friction's impulse over a cycle is nothing on a level trough."""
    shares = parts.load("gallery:conveyor_load").solve().shares
    assert shares["forward"] == pytest.approx(0.5, abs=1e-6) and shares["rest"] == 0.0
