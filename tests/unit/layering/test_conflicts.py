"""What is reported where there are no layers: what contradicts, and changes that are enough."""

from math import inf
from random import Random

import pytest
from tests.unit.layering.random_problems import random_problem

import linkwright as lw
from linkwright.layering.conflicts import contradiction
from linkwright.layering.orders import any_layers

#: Crank and rocker in one layer: at 0° the crank's end is 0.3 m from the rocker's pin in the frame.
TWO_BARS = """
format: 1
name: two bars
frame: {{points: {{O: [0 m, 0 m], Q: [0.5 m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: 0.2 m, shape: {{kind: bar, width: {crank}}}}}
  coupler: {{points: [A, B], length: 0.5 m}}
  rocker: {{points: [Q, B], length: 0.22 m, shape: {{kind: bar, width: 320 mm}}}}
assembly: {{B: left}}
driver: {{turn: crank, about: O, speed: 1 rad/s}}
cycle: {{rock: limits}}
construction:
  {{width: 50 mm, pin_radius: 10 mm, thickness: 5 mm, ends: flush, clearance: {clearance},
   layers: {{crank: 1, rocker: 1}}}}
"""


def two_bars(crank: str, clearance: str = "0 mm") -> lw.Layers:
    return lw.layers(lw.loads(TWO_BARS.format(crank=crank, clearance=clearance)))


@pytest.mark.parametrize("seed", range(15))
def test_nothing_can_be_left_out(seed: int) -> None:
    problem = random_problem(Random(seed))
    if any_layers(problem, inf) is not None:
        return
    found = contradiction(problem, ())
    assert any_layers(problem.only(found), inf) is None
    for each in found:
        assert any_layers(problem.only(other for other in found if other is not each), inf) is not None


def test_coupler_over_the_pin_of_a_crank_below_a_cover() -> None:
    """The coupler's line passes over O1 where crank and coupler are in line, twice in a turn: only the base holds
    it."""
    found = lw.layers(lw.load("gallery:crank_rocker"), supports="both")
    assert found.layer["cover"] > found.layer["coupler"] > found.layer["crank"]
    assert found.solids.by_name["pin O1"].plates == ("frame", "crank")
    assert any("on one side only" in each and "O1" in each for each in found.solids.notes)


def test_less_width_is_enough_as_reported() -> None:
    """0.3 m from line to line, less half of 320 mm, leave 140 mm for half the crank."""
    found = two_bars("320 mm")
    assert [(each.first, each.second) for each in found.conflicts] == [
        ("crank", "rocker"),
        ("crank", ""),
        ("rocker", ""),
    ]
    assert "Enough alone: make crank less than 280 mm wide, clear of rocker." in found.remedies
    assert "Enough alone: do not fix the layer of rocker." in found.remedies
    assert two_bars("279 mm").layer and not two_bars("281 mm").layer


def test_less_clearance_is_enough_as_reported() -> None:
    found = two_bars("240 mm", "40 mm")
    assert found.conflicts[0].sentence.startswith("crank comes to 20 mm from rocker")
    assert "Enough alone: allow a clearance of 20 mm." in found.remedies
    assert "Enough alone: make crank less than 200 mm wide, clear of rocker." in found.remedies
    enough = two_bars("240 mm", "20 mm")
    assert enough.layer and enough.min_gap == pytest.approx(0.02)


def test_pins_too_thick_for_the_crank_between_them() -> None:
    """Pins of 50 mm at the ends of a crank of 40 mm."""
    found = lw.layers(
        lw.loads(
            TWO_BARS.format(crank="50 mm", clearance="0 mm").replace("0.2 m", "0.04 m").replace("10 mm", "25 mm")
        )
    )
    assert {found.conflicts[0].first, found.conflicts[0].second} == {"pin O", "pin A"}
    assert "Enough alone: make the radii of pin O and pin A together less than 40 mm." in found.remedies


def test_a_wheel_cannot_be_made_narrower() -> None:
    """The pinion, 44 mm across, reaches over the pin A on the wheel that it drives: no width of it would help."""
    text = """
format: 1
name: pinion over a crank pin
frame: {points: {G: [-60 mm, 0 mm], O: [0 mm, 0 mm], P: [150 mm, 0 mm]}}
links:
  pinion: {points: [G], also: {H: [15 mm, 0 mm]}}
  wheel: {points: [O, A], length: 36 mm}
  bar: {points: [A, B], length: 150 mm}
  arm: {points: [P, B], length: 100 mm}
joints: {mesh: {kind: gear, links: [pinion, wheel], teeth: [20, 40], module: 2 mm}}
assembly: {B: left}
driver: {turn: pinion, about: G, speed: 1 rad/s}
construction: {width: 14 mm, pin_radius: 3 mm, thickness: 6 mm}
"""
    found = lw.layers(lw.loads(text))
    assert not found.layer
    assert "Enough alone: keep pinion clear of pin A by other dimensions." in found.remedies
