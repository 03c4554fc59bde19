"""A machine that is driven elsewhere stays put together as it is, though its groups are others then."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright.server.edits import edited

#: A crank and a ram; the crank is above the line of the guide at 60 degrees.
PRESS = """format: 1
frame:
  points: {O1: [0 mm, 0 mm], G: [100 mm, 0 mm]}
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 150 mm}
  ram: {points: [B]}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: ram, at: B}
assembly: {B: SIDE}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""


@pytest.mark.parametrize("angle", [60.0, -60.0])
def test_a_ram_is_driven_and_its_crank_stays_on_its_side(angle: float) -> None:
    """By hand: B is to the right of A by the cosine law."""
    turn = math.radians(angle)
    a = (0.05 * math.cos(turn), 0.05 * math.sin(turn))
    b = (a[0] + math.sqrt(0.15**2 - a[1] ** 2), 0.0)
    text = PRESS.replace("SIDE", "forward")
    places = {"A": list(a), "B": list(b)}
    found = edited(text, [{"do": "driver", "slide": "guide", "places": places}]).text
    mechanism = lw.loads(found)
    assert not mechanism.assembly
    motion = lw.solve_motion(mechanism, at={"driver": b[0] - 0.1})
    assert motion.point("A").position[0] == pytest.approx(np.array(a), abs=1e-4)


def test_words_that_still_hold_stay() -> None:
    text = PRESS.replace("SIDE", "forward")
    found = edited(text, [{"do": "driver", "link": "crank", "about": "O1"}]).text
    assert "assembly: {B: forward}" in found
    assert "drawing" not in found
