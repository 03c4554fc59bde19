"""Symbols of kinematic drawings: each stands alone, is valid, and turns with its direction."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from linkwright.pictures.drawing import CSS
from linkwright.pictures.picture import Circle
from linkwright.pictures.svg import element, group, number
from linkwright.pictures.symbols.base import SYMBOLS, hatching, placed

NEEDED = {
    "fixed_pivot",
    "pin",
    "slider",
    "ground_guide",
    "moving_guide",
    "weld",
    "plate",
    "gear",
    "rack",
    "cam",
    "crank_arrow",
    "spring",
    "arrow",
    "moment",
    "mass_centre",
    "dimension_line",
}


def test_every_standard_symbol_is_there() -> None:
    assert set(SYMBOLS) >= NEEDED


@pytest.mark.parametrize("name", SYMBOLS)
def test_symbol_is_valid_xml_with_ink(name: str) -> None:
    shape = SYMBOLS[name]()
    ET.fromstring(str(group(shape.elements)))
    assert shape.elements and shape.ink
    assert all(line.shape[1] == 2 and np.isfinite(line).all() for line in shape.ink)


@pytest.mark.parametrize("name", ["fixed_pivot", "wall"])
def test_ground_lies_in_its_direction(name: str) -> None:
    for angle in (0.0, 0.5 * math.pi, 2.1):
        way = (math.cos(angle), math.sin(angle))
        ink = np.concatenate(SYMBOLS[name](toward=way).ink)
        along, across = ink @ way, ink @ (-way[1], way[0])
        assert along.min() >= -1e-9 and along.max() > 5
        assert abs(across.max() + across.min()) < 1e-9


def test_crank_arrow_turns_as_told() -> None:
    for turning in (1, -1):
        arc = SYMBOLS["crank_arrow"](turning=turning).ink[0]
        first, last = arc[0], arc[-1]
        counter_clockwise = -(first[0] * last[1] - first[1] * last[0])  # y is down on the paper
        assert np.sign(counter_clockwise) == turning


def test_arrow_ends_at_its_point() -> None:
    shape = SYMBOLS["arrow"](start=(0.0, 0.0), end=(30.0, 40.0))
    assert np.allclose(shape.ink[1][0], (30.0, 40.0))
    assert SYMBOLS["arrow"](start=(1.0, 1.0), end=(1.0, 1.0)).elements == ()


def test_hatching_stays_on_its_side() -> None:
    strokes = np.concatenate(hatching((0.0, 0.0), (60.0, 0.0), 1))
    assert strokes[:, 1].min() >= 0 and strokes[:, 1].max() > 0
    assert hatching((1.0, 1.0), (1.0, 1.0), 1) == []


def test_hull_of_a_quadrangle_leaves_out_the_inner_point() -> None:
    (ink,) = SYMBOLS["plate"](corners=[(0, 0), (4, 0), (4, 3), (0, 3), (2, 1), (2, 0)]).ink
    assert {tuple(row) for row in ink} == {(0, 0), (4, 0), (4, 3), (0, 3)}


def test_placed_is_a_rigid_motion() -> None:
    moved = placed([(0, 0), (3, 4)], (10.0, -2.0), (math.cos(1.0), math.sin(1.0)))
    assert math.isclose(float(np.hypot(*(moved[1] - moved[0]))), 5.0)


def test_text_is_escaped() -> None:
    made = str(element("text", {"class": 'a"b'}, "<ω & ü>\x00"))
    found = ET.fromstring(made)
    assert found.text == "<ω & ü>" and found.get("class") == 'a"b'


def test_numbers_are_short() -> None:
    assert [number(x) for x in (1.0, -0.001, 2.346, 1e3)] == ["1", "0", "2.35", "1000"]


def test_a_ring_is_filled_between_its_teeth_and_its_rim_alone() -> None:
    shape = SYMBOLS["gear"](radius=100.0, inside=True, teeth=40)
    rim, teeth, pitch = shape.elements
    assert isinstance(rim, Circle) and isinstance(pitch, Circle)
    assert rim.radius > 100.0 == pitch.radius
    assert (rim.style, teeth.style) == ("lw-gear", "lw-rim")


def test_a_plate_lets_what_lies_beneath_it_be_seen() -> None:
    (rule,) = [each for each in CSS.split("}") if ".lw-plate{" in each]
    (opacity,) = [each for each in rule.split(";") if each.startswith("fill-opacity:")]
    assert 0.3 < float(opacity.removeprefix("fill-opacity:")) < 0.8
