"""Stretches out of reach between two positions are noticed, however far apart the positions are."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from tests.refusals import noted

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
    noted([note], "cycle.gap", links=("coupler", "rocker"), where=f"driver = {math.degrees(EDGE):.6g}°")


def test_a_law_that_goes_and_comes_back_between_two_positions_is_looked_through() -> None:
    """The crank swings from -40° over the folded position and back again within one step."""
    text = MODEL.read_text(encoding="utf-8")
    swing = text.replace("speed: 1 rad/s, start: -40 deg", 'position: "-40 deg + 40 deg*sin(2*pi*t/(1 s))"').replace(
        "cycle: {from: -40 deg, to: 40 deg}", "cycle: {duration: 1 s}"
    )
    motion = lw.solve_motion(lw.loads(swing), steps=2, failures="mark")
    assert motion.ok.tolist() == [True, False, False]


INVERTED = """
format: 1
frame: {points: {P: [0 m, 0 m]}}
links:
  slide: {points: [Q]}
  rocker: {points: {P: [0 m, 0 m], S: [0 m, OFFSET m]}}
  bar: {points: [Q]}
joints:
  way: {kind: prismatic, guide: frame, through: P, direction: 0 deg, block: slide, at: Q}
  inner: {kind: prismatic, guide: bar, through: Q, direction: 0 deg, block: rocker, at: S}
drawing: {Q: [-0.4 m, 0 m], S: [0 m, OFFSET m]}
driver: {slide: way, speed: 1 m/s, start: -0.4 m}
cycle: {from: -0.4 m, to: 0.37 m}
"""


@pytest.mark.parametrize("steps", [1, 2, 3, 8])
def test_a_small_group_in_a_large_machine_is_looked_through(steps: int) -> None:
    """A way of 0.77 m is short beside a frame of 40 m; the pins stand nearer than 0.1 m from s = -0.1 m on."""
    text = INVERTED.replace("OFFSET", "0.1")
    large = text.replace("frame: {points: {P: [0 m, 0 m]}}", "frame: {points: {P: [0 m, 0 m], F: [40 m, 0 m]}}")
    motion = lw.solve_motion(lw.loads(large), steps=steps, failures="mark")
    assert motion.ok.tolist() == (motion.input < -0.1).tolist()


@pytest.mark.parametrize("steps", [4, 17, 60])
@pytest.mark.parametrize("offset", ["0.0005", "0.00002"])
def test_pins_that_pass_each_other_closer_than_the_guides_offset_cannot(steps: int, offset: str) -> None:
    """The outer pins of an RPR meet at s = 0; nearer than the offset across the guide it cannot be assembled."""
    motion = lw.solve_motion(lw.loads(INVERTED.replace("OFFSET", offset)), steps=steps, failures="mark")
    assert motion.ok.tolist() == (motion.input < 0).tolist()
    (note,) = motion.notes
    noted([note], "cycle.gap", links=("rocker", "bar"))


def test_pins_that_meet_where_the_guide_has_no_offset_pass() -> None:
    motion = lw.solve_motion(lw.loads(INVERTED.replace("OFFSET", "0")), steps=17, failures="mark")
    assert motion.ok.all()
    noted(motion.notes, "cycle.meeting", links=("rocker", "bar"), where="driver = 0 mm")
