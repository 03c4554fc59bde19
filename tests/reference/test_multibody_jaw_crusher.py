"""The reference against the printed tables of the hinged jaw crusher.

The tables hold for the load exactly as the report coded it (see `coded_resistance`).
"""

from __future__ import annotations

from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest
from tests.reference.formulas import force_in_space, gravity
from tests.reference.meetings import circle_meeting, placed
from tests.reference.multibody import FRAME, Array, Body, Load, Motion, Multibody, Vec, Wrench, revolute, turn

PUBLISHED = Path(__file__).parents[2] / "src" / "linkwright" / "validation" / "data"
SPEED = -170 * 2 * pi / 60
O3, O5 = (0.94, -1.0), (-1.0, 0.85)


def table(name: str) -> Array:
    return np.loadtxt(PUBLISHED / name, delimiter=",", skiprows=1)


def six_bar(degrees: Array) -> Motion:
    bodies = [
        Body("crank"),
        Body("pitman", 500, 25.5, (0.625, 0)),
        Body("rocker", 200, 9, (0.5, 0)),
        Body("toggle", 200, 9, (0.575, 0)),
        Body("jaw", 900, 50, (0.98, 0)),
    ]
    joints = [
        *revolute("O1", [(FRAME, (0, 0)), ("crank", (0, 0))]),
        *revolute("A", [("crank", (0.1, 0)), ("pitman", (0, 0))]),
        *revolute("B", [("pitman", (1.25, 0)), ("rocker", (1.0, 0)), ("toggle", (0, 0))]),
        *revolute("O3", [(FRAME, O3), ("rocker", (0, 0))]),
        *revolute("C", [("toggle", (1.15, 0)), ("jaw", (1.96, 0))]),
        *revolute("O5", [(FRAME, O5), ("jaw", (0, 0))]),
        *turn("driver", FRAME, "crank", 0),
    ]
    a = (0.1, 0.0)
    b = circle_meeting(a, 1.25, O3, 1.0, left=False)
    c = circle_meeting(b, 1.15, O5, 1.96, left=True)
    start = np.array([(0, 0, 0), (0, 0, 0), placed(a, b), placed(O3, b), placed(b, c), placed(O5, c)])
    return _turned(Multibody(bodies, joints), start, degrees)


def four_bar(degrees: Array) -> Motion:
    pivot = (-0.95, 2.0)
    bodies = [Body("crank"), Body("pitman", 200, 9, (0.555, 0)), Body("jaw", 900, 50, (0.98, 0))]
    joints = [
        *revolute("O1", [(FRAME, (0, 0)), ("crank", (0, 0))]),
        *revolute("A", [("crank", (0.04, 0)), ("pitman", (0, 0))]),
        *revolute("B", [("pitman", (1.11, 0)), ("jaw", (1.96, 0))]),
        *revolute("O5", [(FRAME, pivot), ("jaw", (0, 0))]),
        *turn("driver", FRAME, "crank", 0),
    ]
    b = circle_meeting((0.04, 0.0), 1.11, pivot, 1.96, left=True)
    start = np.array([(0, 0, 0), (0, 0, 0), placed((0.04, 0.0), b), placed(pivot, b)])
    return _turned(Multibody(bodies, joints), start, degrees)


def _turned(system: Multibody, start: Array, degrees: Array) -> Motion:
    u = np.radians(degrees)[:, None]
    return system.motion(start, np.zeros(1), u, np.full_like(u, SPEED), np.zeros_like(u))


def coded_resistance(degrees: Array, at: Vec) -> Load:
    """While the jaw's angular velocity is negative: (-crank angle - 90) 85000/182 N at -theta5 - pi/2."""

    def load(motion: Motion) -> list[Wrench]:
        angle, velocity, _ = motion.angle("jaw")
        size = np.where(velocity < 0, (-degrees - 90) * 85000 / 182, 0.0)
        lean = -angle - pi / 2
        return force_in_space("jaw", at, size[:, None] * np.stack([np.cos(lean), np.sin(lean)], -1))(motion)

    return load


def test_six_bar_kinematics() -> None:
    printed = table("jaw_crusher_sixbar_kinematics.csv")
    motion = six_bar(printed[:, 0])
    for found, column in zip(motion.angle("jaw"), printed[:, 1:].T, strict=True):
        assert found == pytest.approx(column, abs=5.1e-4)


def test_six_bar_reaction_and_torque() -> None:
    printed = table("jaw_crusher_sixbar_forces.csv")
    motion = six_bar(printed[:, 0])
    forces = motion.forces([gravity((0.0, -9.81)), coded_resistance(printed[:, 0], (0.6, 0.0))])
    reaction, _ = forces.on("O5", "jaw")
    assert np.hypot(*reaction.T) == pytest.approx(printed[:, 1], abs=5.1e-4)
    assert np.degrees(np.arctan2(reaction[:, 1], reaction[:, 0])) == pytest.approx(printed[:, 2], abs=5.1e-4)
    assert forces.effort("driver") == pytest.approx(printed[:, 3], abs=5.1e-4)


def test_forces_at_a_pin_of_three_links_balance() -> None:
    motion = six_bar(np.array([0.0, -70.0, -200.0]))
    forces = motion.forces([gravity((0.0, -9.81))])
    total = sum(forces.on("B", link)[0] for link in ("pitman", "rocker", "toggle"))
    assert total == pytest.approx(0.0, abs=1e-8)


def test_four_bar_first_row() -> None:
    motion = four_bar(np.array([0.0]))
    forces = motion.forces([gravity((0.0, -9.81))])
    reaction = forces.on("O5", "jaw")[0][0]
    assert np.hypot(*reaction) == pytest.approx(10261.396, abs=5.1e-4)
    assert reaction / np.hypot(*reaction) == pytest.approx((cos(radians(102.685)), sin(radians(102.685))), abs=1e-5)
    assert forces.effort("driver")[0] == pytest.approx(47.546, abs=5.1e-4)
