"""Plates of links, pins through them, guides with their blocks."""

import pytest

import linkwright as lw
from linkwright.shapes.shape import Shape
from linkwright.solids.solids_of import solids

SLIDER_CRANK = """
format: 1
name: slider-crank
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 60 mm}
  rod: {points: [A, B], length: 240 mm}
  piston: {points: [B]}
joints:
  way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""


def extent(shape: Shape) -> tuple[complex, complex]:
    """Lower left and upper right corner of what a shape of bars, discs and polygons takes."""
    low = [
        complex(each.corners.real.min(), each.corners.imag.min()) - each.radius * (1 + 1j) for each in shape.pieces
    ]
    high = [
        complex(each.corners.real.max(), each.corners.imag.max()) + each.radius * (1 + 1j) for each in shape.pieces
    ]
    return (
        complex(min(each.real for each in low), min(each.imag for each in low)),
        complex(max(each.real for each in high), max(each.imag for each in high)),
    )


def test_a_four_bar_linkage_is_four_plates_and_four_pins() -> None:
    found = solids(lw.load("gallery:crank_rocker"))
    plates = [name for name, each in found.by_name.items() if each.is_plate]
    assert plates == ["frame", "crank", "coupler", "rocker"]
    assert found.by_name["pin O1"].plates == ("frame", "crank")
    assert found.by_name["pin A"].plates == ("crank", "coupler")
    assert ("crank", "pin A") in found.joined
    assert ("coupler", "crank") not in found.joined


def test_a_guide_is_as_long_as_the_stroke_and_the_block() -> None:
    """Lengths 60 and 240 mm: their median 150 mm, a twelfth of it 12.5, so the width is 12 mm; the block is 18 by 12
    mm. B goes from 180 to 300 mm, so the slot from 9 mm and a play of 1.2 mm before to as much behind."""
    found = solids(lw.loads(SLIDER_CRANK))
    assert found.level == (("guide way", "piston"),)
    low, high = extent(found.by_name["piston"].shape)
    assert high - low == pytest.approx(0.018 + 0.012j)
    ring = found.by_name["guide way"].shape.pieces[0]
    inner = complex(ring.corners.real.max() - ring.radius, ring.corners.imag.max() - ring.radius)
    assert inner == pytest.approx(0.300 + 0.0102 + 0.006j)
    assert ring.corners.real.min() + ring.radius == pytest.approx(0.180 - 0.0102)
    assert found.by_name["post way.1"].plates == ("frame", "guide way")
    assert found.by_name["pin B"].plates == ("rod", "piston")
    assert ("guide way", "pin B") in found.joined


def test_the_slot_of_a_moving_guide_is_in_its_plate() -> None:
    found = solids(lw.load("gallery:whitworth"))
    assert ("lever", "die") in found.level
    assert "guide slot" not in found.by_name
    assert found.by_name["die"].sort == "block"


def test_an_outline_around_the_posts_of_its_block_stays_as_it_is() -> None:
    """A ram of 200 mm by 100 mm about B holds the two posts of its block and its pin: nothing sticks out."""
    corners = "[[-100 mm, -50 mm], [100 mm, -50 mm], [100 mm, 50 mm], [-100 mm, 50 mm]]"
    ram = f"piston: {{points: [B], also: {{T: [90 mm, 0 mm]}}, shape: {{outline: {corners}}}}}"
    found = solids(lw.loads(SLIDER_CRANK.replace("piston: {points: [B]}", ram)))
    low, high = extent(found.by_name["piston"].shape)
    assert (low, high) == (pytest.approx(-0.1 - 0.05j), pytest.approx(0.1 + 0.05j))
    assert len(found.by_name["piston"].shape.holes) == 3
