"""Drawings that do not close, as their coordinates are rounded or sketched: the assembly that they show."""

from __future__ import annotations

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw


def test_a_machine_that_is_singular_everywhere_is_not_blamed_on_its_drawing() -> None:
    """Two straight-line linkages of 200 mm with a platform pinned on both, drawn to 0.1 mm: at one input the platform
    may be anywhere along its line (jgerstmayr/EXUDYN, issue 39)."""
    text = """format: 1
frame: {points: {OL: [0 mm, 0 mm], OR: [1000 mm, 0 mm]}}
links:
  crankL: {points: [OL, AL], length: 200 mm}
  barL: {points: [CL, AL, BL], lengths: [200 mm, 400 mm], angle: 0 deg}
  shoeL: {points: [CL]}
  crankR: {points: [OR, AR], length: 200 mm}
  barR: {points: [CR, AR, BR], lengths: [200 mm, 400 mm], angle: 0 deg}
  shoeR: {points: [CR]}
  platform: {points: [BL, BR], length: 1000 mm}
joints:
  floorL: {kind: prismatic, guide: frame, through: OL, direction: 0 deg, block: shoeL, at: CL}
  floorR: {kind: prismatic, guide: frame, through: OR, direction: 0 deg, block: shoeR, at: CR}
drawing: {AL: [-173.2 mm, 100 mm], CL: [-346.4 mm, 0 mm], BL: [0 mm, 200 mm], AR: [1173.2 mm, 100 mm],
  CR: [1346.4 mm, 0 mm], BR: [1000 mm, 200 mm]}
driver: {slide: floorL, position: "-346.4 mm + 10 mm/s*t"}
cycle: {duration: 5 s}
"""
    with refused("motion.refused", lw.PositionError, failed=6, steps=6):
        lw.solve_motion(lw.loads(text), steps=5)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_dyad_drawn_just_out_of_reach_is_on_the_side_on_which_it_is_drawn(side: float) -> None:
    """|A O2| ≤ 0.5 m up to cos θ = (0.3² + 0.7² - 0.5²) / (2 · 0.3 · 0.7), θ = 38.21°; drawn at 38.3°."""
    a = complex(0.3 * np.exp(1j * np.radians(38.3)))
    way = (0.7 - a) / abs(0.7 - a)
    b = complex(a + 0.3 * way * np.exp(0.1j * side))
    text = f"""format: 1
frame: {{points: {{O1: [0 m, 0 m], O2: [0.7 m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: 0.3 m}}
  coupler: {{points: [A, B], length: 0.3 m}}
  rocker: {{points: [O2, B], length: 0.2 m}}
drawing: {{A: [{a.real!r} m, {a.imag!r} m], B: [{b.real!r} m, {b.imag!r} m]}}
driver: {{turn: crank, about: O1, speed: 1 rad/s}}
cycle: {{from: -30 deg, to: 30 deg}}
"""
    motion = lw.solve_motion(lw.loads(text), steps=12)
    arm = motion.point("B").position - motion.point("A").position
    ray = np.array([0.7, 0.0]) - motion.point("A").position
    assert (side * (ray[:, 0] * arm[:, 1] - ray[:, 1] * arm[:, 0]) > 0.0).all()
