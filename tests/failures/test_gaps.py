"""Stretches out of reach between two positions are noticed, however far apart the positions are."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import linkwright as lw

MODEL = Path(__file__).parents[1] / "reference" / "faults" / "gap_between_samples.yaml"
#: The pins come as close as 0.9 m - 0.695 m where cos φ = (0.8² + 1² - 0.205²) / (2 · 0.8 · 1).
EDGE = -math.acos((0.8**2 + 1.0 - 0.205**2) / 1.6)


@pytest.mark.parametrize("steps", [1, 2, 3, 5, 9, 40, 360])
def test_positions_behind_a_folded_dyad_are_not_reached(steps: int) -> None:
    motion = lw.solve_motion(lw.load(MODEL), steps=steps, failures="mark")
    assert motion.ok.tolist() == (motion.input < EDGE).tolist()


@pytest.mark.parametrize("steps", [1, 3, 5])
def test_a_note_says_where_the_stretch_begins(steps: int) -> None:
    (note,) = lw.solve_motion(lw.load(MODEL), steps=steps, failures="mark").notes
    assert "group (coupler, rocker) cannot be assembled" in note
    assert f"driver = {math.degrees(EDGE):.6g}°" in note


def test_a_law_that_goes_and_comes_back_between_two_positions_is_looked_through() -> None:
    """The crank swings from -40° over the folded position and back again within one step."""
    text = MODEL.read_text(encoding="utf-8")
    swing = text.replace(
        "speed: 1 rad/s, start: -40 deg", 'position: "-40 deg + 40 deg*sin(2*pi*t/(1 s))"'
    ).replace("cycle: {from: -40 deg, to: 40 deg}", "cycle: {duration: 1 s}")
    motion = lw.solve_motion(lw.loads(swing), steps=2, failures="mark")
    assert motion.ok.tolist() == [True, False, False]
