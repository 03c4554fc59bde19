"""Where two guides become parallel, what slides on them goes through infinity: x = -h / tan φ in both models."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.refusals import noted

import linkwright as lw
from linkwright.analysis import MetricValue

HEAD = """
format: 1
frame: {points: {O: [0 m, 0 m], Q: [0 m, HEIGHT m]}}
"""
#: The outer guide lies on the frame, the inner one on the driven link; the block is pinned to the frame.
RPP = """
links:
  slide: {points: [A]}
  arm: {points: [A]}
  block: {points: [Q]}
joints:
  outer: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: A}
  inner: {kind: prismatic, guide: arm, through: A, direction: 0 deg, block: block, at: Q}
driver: {turn: arm, about: A, relative_to: slide, LAW}
"""
#: One guide lies on the frame, one on the crank; the pin joins their blocks.
PRP = """
links:
  crank: {points: [Q]}
  slide: {points: [A]}
  block: {points: [A]}
joints:
  outer: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: A}
  inner: {kind: prismatic, guide: crank, through: Q, direction: 0 deg, block: block, at: A}
driver: {turn: crank, about: Q, LAW}
"""
TURN = "speed: 1 rad/s, start: -40 deg"


def model(body: str, law: str, cycle: str, height: float = 0.2) -> lw.Mechanism:
    return lw.loads(HEAD.replace("HEIGHT", str(height)) + body.replace("LAW", law) + f"cycle: {{{cycle}}}")


@pytest.mark.parametrize("body", [RPP, PRP], ids=["RPP", "PRP"])
@pytest.mark.parametrize("steps", [1, 3, 12, 41])
def test_positions_beyond_infinity_are_not_reached(body: str, steps: int) -> None:
    motion = lw.solve_motion(model(body, TURN, "from: -40 deg, to: 41 deg"), steps=steps, failures="mark")
    assert motion.ok.tolist() == (motion.input < 0).tolist()
    (note,) = motion.notes
    noted([note], "cycle.pole", where="driver = 0°")
    x = motion.point("A").position[motion.ok, 0]
    np.testing.assert_allclose(x, -0.2 / np.tan(motion.input[motion.ok]), rtol=1e-13)


@pytest.mark.parametrize("body", [RPP, PRP], ids=["RPP", "PRP"])
@pytest.mark.parametrize(("beyond", "reached"), [(1e-5, False), (-1e-5, True)])
def test_infinity_is_noticed_between_two_positions_on_the_same_side(body: str, beyond: float, reached: bool) -> None:
    """The arm swings to a place just before or just beyond the parallel position, between two positions."""
    law = f'position: "-0.5 rad + (0.5 + {beyond!r}) * sin(2*pi*t/(1 s))"'
    motion = lw.solve_motion(model(body, law, "duration: 1 s"), steps=5, failures="mark")
    assert (motion.input < 0).all()
    assert motion.ok.tolist() == [True, True, *[reached] * 4]
    assert len(motion.notes) == (0 if reached else 1)


@pytest.mark.parametrize("body", [RPP, PRP], ids=["RPP", "PRP"])
def test_guides_whose_crossing_stands_still_do_not_go_to_infinity(body: str) -> None:
    motion = lw.solve_motion(model(body, TURN, "from: -40 deg, to: 41 deg", height=0.0), steps=27, failures="mark")
    assert motion.ok.all() and not motion.notes
    assert math.isclose(float(np.abs(motion.point("A").position).max()), 0.0, abs_tol=1e-12)


@pytest.mark.parametrize("body", [RPP, PRP], ids=["RPP", "PRP"])
def test_the_room_of_what_goes_to_infinity_has_no_bounds(body: str) -> None:
    """Before, it is the triangle of both pins on the frame and the farthest place, 0.2 m / tan 5° away."""

    def room(end: str) -> MetricValue:
        machine = model(body, TURN, f"from: -40 deg, to: {end} deg")
        (found,) = lw.metrics(lw.solve_motion(machine, steps=12, failures="mark"), ["swept_area"]).rows
        return found

    assert room("-5").value == pytest.approx(0.5 * 0.2 * 0.2 / math.tan(math.radians(5.0)), rel=1e-12)
    unbounded = room("41")
    assert unbounded.value == math.inf and unbounded.exact and "∞" in unbounded.sentence
