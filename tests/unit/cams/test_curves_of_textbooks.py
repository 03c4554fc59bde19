"""Cusps and undercuts of a roller's profile, and Hertz's pressure, where they are reckoned."""

import math
from math import radians

import numpy as np
import pytest

import linkwright as lw
from linkwright.cams.curves import RollerCurve, cusps, undercuts
from linkwright.cams.loading import CamMaterial, contact_pressure


def program(rise: float = 0.024, law: str = "cycloidal", beta: float = 90.0) -> lw.MotionProgram:
    over = radians(beta)
    rest = (2 * math.pi - 2 * over) / 2
    return lw.MotionProgram(
        (lw.Segment(over, rise, law=law), lw.Segment(rest), lw.Segment(over, -rise, law=law), lw.Segment(rest))
    )


def test_a_roller_as_large_as_the_radius_of_curvature_makes_a_cusp() -> None:
    wall = RollerCurve(program(), lw.Follower(roller_radius=0.008), 0.03)
    sharp = 0.008 + 1 / max(wall.contact(np.linspace(0, 2 * np.pi, 200_001)).curvature)
    base = 0.038 - sharp
    for share, cut in ((0.999, False), (1.001, True)):
        roller = share * sharp
        there = RollerCurve(wall.program, lw.Follower(roller_radius=roller), base + sharp - roller)
        assert bool(undercuts(there)) is cut
        assert bool(cusps(there.program, there)) is cut


def test_hertz_pressure_is_that_of_the_textbook() -> None:
    """Two cylinders of 20 and 30 mm radius, 10 mm wide, steel (206 GPa, 0.3), 1 kN: p = 0.418 √(F E/(b R))."""
    still = lw.MotionProgram((lw.Segment(2 * math.pi),))
    cam = lw.Cam(still, lw.Follower(roller_radius=0.03), 0.02, width=0.01, material=CamMaterial(206e9))
    contact = cam.walls[0].contact(np.array([1.0]))
    pressure = contact_pressure(np.array([1000.0]), contact, cam.follower, 0.01, cam.material)
    assert pressure[0] == pytest.approx(0.418 * math.sqrt(1000 * 206e9 / (0.01 * 0.012)), rel=2e-3)
