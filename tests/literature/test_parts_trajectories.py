"""Flights and conveyors against closed forms and a plain integration in tiny steps."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts

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


def test_dust_sinks_at_its_final_speed() -> None:
    """v∞ = √(mg/k): after some v∞/g it falls no faster, T = h/v∞ + v∞ ln 2/g."""
    found = parts.Particle(0.0, 0.0, 1.8, mass=1.45e-9, quadratic=1e-3, gravity=G).solve()
    end = math.sqrt(1.45e-9 * G / 1e-3)
    assert found.impact[0] == pytest.approx(end, rel=1e-9)
    assert found.duration == pytest.approx(1.8 / end + end * math.log(2) / G, rel=1e-9)


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


@pytest.mark.parametrize("drag", [1e-3, 1e-6, 1e-9, 1e-12])
def test_faint_linear_drag_shortens_a_throw_by_its_first_order(drag: float) -> None:
    """To first order in b/m: T = 2v/g (1 − bv/(3mg)), x = uT (1 − bT/(2m))."""
    found = parts.Particle(20.0, math.radians(50), mass=2.0, linear=drag, gravity=G).solve()
    u, v, rate = 20 * math.cos(math.radians(50)), 20 * math.sin(math.radians(50)), drag / 2.0
    time = 2 * v / G * (1 - rate * v / (3 * G))
    assert found.duration == pytest.approx(time, rel=2 * rate**2 + 1e-13)
    assert found.range == pytest.approx(u * time * (1 - rate * time / 2), rel=5 * rate**2 + 1e-13)


@pytest.mark.parametrize(("speed", "angle", "height"), [(800, 80, 0), (800, 2, 0), (800, 0, 1.5), (50, -30, 900)])
def test_a_fast_light_particle_against_an_integration_in_equal_steps(
    speed: float, angle: float, height: float
) -> None:
    """Runge and Kutta's fourth order in 4000 steps: at the end of the flight it is at the ground."""
    mass, drag = 0.01, 1e-5
    found = parts.Particle(speed, math.radians(angle), height, mass=mass, quadratic=drag, gravity=G).solve()

    def rate(s: np.ndarray) -> np.ndarray:
        pull = drag / mass * math.hypot(s[2], s[3])
        return np.array([s[2], s[3], -pull * s[2], -G - pull * s[3]])

    at = math.radians(angle)
    state = np.array([0.0, float(height), speed * math.cos(at), speed * math.sin(at)])
    time, h = 0.0, found.duration / 4000
    for _ in range(4000):
        a = rate(state)
        b = rate(state + h / 2 * a)
        c = rate(state + h / 2 * b)
        d = rate(state + h * c)
        state, time = state + h / 6 * (a + 2 * b + 2 * c + d), time + h
    assert time == pytest.approx(found.duration)
    assert state[1] == pytest.approx(0.0, abs=1e-6 * max(found.top, 1.0))
    assert state[0] == pytest.approx(found.range, rel=1e-7)
    assert math.hypot(*state[2:]) == pytest.approx(found.impact[0], rel=1e-7)


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


def test_fast_trough_lets_its_load_slide_both_ways_equally_long() -> None:
    """Without rest, friction's impulse over a cycle is nothing on a level trough."""
    shares = parts.load("gallery:conveyor_load").solve().shares
    assert shares["forward"] == pytest.approx(0.5, abs=1e-6) and shares["rest"] == 0.0
