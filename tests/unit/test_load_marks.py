"""Arrows of loads in drawings: against the force that is computed, and along the direction where its sign is open."""

import numpy as np
import pytest

import linkwright as lw

MODEL = """format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {arm: {points: [O, A], length: 1 m}}
driver: {turn: arm, about: O, speed: 1 rad/s}
parameters: {F: 5 N}
loads:
  push: {kind: force, on: arm, at: A, direction: 30 deg, GIVEN}
"""


@pytest.mark.parametrize(
    ("given", "turned"),
    [
        ("magnitude: 5 N", False),
        ("magnitude: -5 N", True),
        ("magnitude: 0 N", False),
        ("magnitude: F*sin(arm)", False),
        ("'ramp: [1 N, 5 N], phase: {input: [0 deg, 90 deg]}'", False),
        ("'ramp: [-1 N, -5 N], phase: {input: [0 deg, 90 deg]}'", True),
    ],
)
def test_an_arrow_points_as_the_force_does(given: str, turned: bool) -> None:
    machine = lw.loads(MODEL.replace("GIVEN", given.strip("'")))
    motion = lw.solve_motion(machine, steps=8)
    mark = machine.loads["push"].mark(motion, 1)
    expected = np.deg2rad(210.0 if turned else 30.0)
    assert (mark.link, mark.at) == ("arm", "A")
    assert np.exp(1j * mark.angle) == pytest.approx(np.exp(1j * expected), rel=1e-12)
    force = lw.solve_forces(motion).load("push").force[1]
    size = np.hypot(*force)
    if size > 0.0:
        assert force / size == pytest.approx([np.cos(expected), np.sin(expected)], abs=1e-12)
