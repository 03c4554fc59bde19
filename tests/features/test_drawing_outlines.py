"""Drawings of the parts as they are made."""

import re

import pytest
from tests.store import machine

from linkwright.plotting.animation import animate
from linkwright.plotting.drawing import draw


def test_bars_are_drawn_with_round_ends_and_holes_to_scale() -> None:
    """The crank of 1 m is 0.2 m wide by rule: its ends are half circles whose radius is a tenth of its length."""
    svg = draw(machine("crank_rocker"), outlines=True, labels=False).svg
    bars = re.findall(r'<path class="lw-plate" fill-rule="evenodd" d="(.*?)"', svg)
    (straight,) = {line for bar in bars[-1:] for line in re.findall(r"M(\S+) (\S+)L(\S+) (\S+)A(\S+) ", bar)}
    x, y, to_x, to_y, radius = map(float, straight)
    length = ((to_x - x) ** 2 + (to_y - y) ** 2) ** 0.5
    assert radius == pytest.approx(0.1 * length, abs=0.01)
    assert svg.count("lw-pin") > 4
    assert "lw-support" not in svg.partition("</style>")[2]


def test_notes_say_what_is_drawn_by_rule() -> None:
    (first, *_others) = draw(machine("chain_drive"), outlines=True).notes
    assert "Sizes that the file does not give" in first
    assert any("chain" in each.lower() for each in _others)


def test_wheels_have_pitch_circles() -> None:
    svg = draw(machine("external_gear_pair"), outlines=True).svg.partition("</style>")[2]
    assert svg.count('class="lw-pitch"') == 2
    assert svg.count('class="lw-gear"') == 2


def test_outlines_move_with_their_links() -> None:
    moving = animate(machine("crank_rocker"), outlines=True, frames=8)
    assert moving.svg.count("lw-plate") >= 3
    assert 'class="lw-base"' in moving.frame(3)
