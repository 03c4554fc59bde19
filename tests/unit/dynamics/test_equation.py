"""The equation of motion against those of textbooks, written down by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright.dynamics.equation import EquationOfMotion

TWO_RODS = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 1 m, mass: 1.2 kg, inertia: 0.11 kg·m²}
  lower: {points: [A, T], length: 0.8 m, mass: 0.7 kg, inertia: 0.04 kg·m²}
drivers:
  one: {turn: upper, about: O, speed: 1 rad/s, start: 20 deg}
  two: {turn: lower, about: A, speed: 1 rad/s, start: 30 deg}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""


def test_two_rods_obey_lagranges_equations() -> None:
    """M q'' + h = 0 of the double pendulum in the absolute angle of the first rod and the relative one of the second
    (Spong, Robot Modeling and Control, the planar elbow manipulator)."""
    equation = EquationOfMotion(lw.loads(TWO_RODS))
    q, w = (0.4, 0.9), (1.3, -0.7)
    m1, m2, j1, j2, l1, r1, r2, g = 1.2, 0.7, 0.11, 0.04, 1.0, 0.5, 0.4, 9.81
    c2, s2 = math.cos(q[1]), math.sin(q[1])
    mass = np.array(
        [
            [m1 * r1**2 + j1 + m2 * (l1**2 + r2**2 + 2 * l1 * r2 * c2) + j2, m2 * (r2**2 + l1 * r2 * c2) + j2],
            [m2 * (r2**2 + l1 * r2 * c2) + j2, m2 * r2**2 + j2],
        ]
    )
    swing = m2 * l1 * r2 * s2
    rates = np.array([-swing * (2 * w[0] * w[1] + w[1] ** 2), swing * w[0] ** 2])
    weights = np.array(
        [
            (m1 * r1 + m2 * l1) * g * math.cos(q[0]) + m2 * r2 * g * math.cos(q[0] + q[1]),
            m2 * r2 * g * math.cos(q[0] + q[1]),
        ]
    )
    given = {"q:one": q[0], "q:two": q[1], "qd:one": w[0], "qd:two": w[1]}
    names = [
        "M:one:one",
        "M:one:two",
        "M:two:one",
        "M:two:two",
        "h:one",
        "h:two",
        "qdd:one",
        "qdd:two",
        "power",
        "kinetic",
    ]
    found = equation.evaluate(names, given, 1)[:, 0]
    assert found[:4] == pytest.approx(mass.ravel(), rel=1e-13)
    assert found[4:6] == pytest.approx(rates + weights, rel=1e-13)
    assert found[6:8] == pytest.approx(np.linalg.solve(mass, -(rates + weights)), rel=1e-12)
    assert found[8] == pytest.approx(-weights @ w, rel=1e-12)
    assert found[9] == pytest.approx(0.5 * np.array(w) @ mass @ w, rel=1e-13)


def test_a_prescribed_input_leaves_the_equation_of_the_other() -> None:
    """The first rod at constant speed: the second one swings as seen from a turning support."""
    equation = EquationOfMotion(lw.loads(TWO_RODS), prescribed=["one"])
    given = {"q:one": 0.4, "q:two": 0.9, "qd:one": 1.3, "qd:two": -0.7, "second:one": 2.0}
    j, m, r, l1 = 0.04 + 0.7 * 0.4**2, 0.7, 0.4, 1.0
    coupled = m * (r**2 + l1 * r * math.cos(0.9)) + 0.04
    expected = -(coupled * 2.0 + m * l1 * r * math.sin(0.9) * 1.3**2 + m * 9.81 * r * math.cos(1.3)) / j
    assert equation.evaluate(["qdd:two"], given, 1)[0, 0] == pytest.approx(expected, rel=1e-13)


def test_signs_of_rates_are_switches() -> None:
    """A block that rubs on its guide: the comparisons of its velocity are inputs, and friction has its sign."""
    text = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {block: {points: [B], mass: 2 kg}}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B, friction: 0.3}}
driver: {slide: guide, speed: 1 m/s}
cycle: {duration: 1 s}
gravity: [0, -10 m/s²]
"""
    equation = EquationOfMotion(lw.loads(text))
    gaps = equation.evaluate(["gap:0", "gap:1"], {"qd:driver": 2.0}, 1)[:, 0]
    assert sorted(gaps) == [-2.0, 2.0]
    falling = {name: float(gap > 0.0) for name, gap in zip(equation.switches.names, gaps, strict=True)}
    assert equation.evaluate(["qdd:driver"], {"qd:driver": 2.0, **falling}, 1)[0, 0] == pytest.approx(-3.0, rel=1e-13)
    rising = {name: 1.0 - each for name, each in falling.items()}
    assert equation.evaluate(["qdd:driver"], {"qd:driver": -2.0, **rising}, 1)[0, 0] == pytest.approx(3.0, rel=1e-13)
