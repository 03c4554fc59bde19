"""Dimensions in drawings: their values stand over their lines, in their direction, and are read as they stand."""

import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from numpy.typing import NDArray
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import Drawing, draw

Floats = NDArray[np.float64]

ECCENTRIC = """
format: 1
name: eccentric
frame: {points: {O1: [0 mm, 0 mm], O2: [300 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 6 mm}
  rod: {points: [A, B], length: 300 mm}
  rocker: {points: [O2, B], length: 100 mm}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""
SVG = "{http://www.w3.org/2000/svg}"


def values(drawing: Drawing) -> list[tuple[str, Floats, float]]:
    """Text, middle and direction (degrees clockwise) of every value."""
    found = []
    root = ET.fromstring(drawing.svg)
    for group in root.iter():
        for text in group.findall(f"{SVG}text"):
            if text.get("class") != "lw-value":
                continue
            turn = re.findall(r"-?[\d.]+", group.get("transform", ""))
            middle = np.array([float(text.get("x", "nan")), float(text.get("y", "nan")) - 4.0])
            where = np.array(list(map(float, turn[1:]))) if turn else middle
            found.append(("".join(text.itertext()), where, float(turn[0]) if turn else 0.0))
    return found


def lines(drawing: Drawing) -> list[Floats]:
    """Ends of dimension and extension lines."""
    root = ET.fromstring(drawing.svg)
    paths = [e.get("d", "") for e in root.iter() if e.get("class") == "lw-dimension"]
    return [np.array(list(map(float, re.findall(r"-?[\d.]+", path)))).reshape(-1, 2) for path in paths]


def distance(place: Floats, line: Floats) -> float:
    """Distance of a place from a stretch."""
    way = line[1] - line[0]
    share = np.clip((place - line[0]) @ way / (way @ way), 0.0, 1.0)
    return float(np.hypot(*(line[0] + share * way - place)))


@pytest.mark.parametrize("name", ["fourbar_lecture", "jaw_crusher_sixbar", "crank_rocker", "kite"])
def test_values_stand_over_their_lines_in_their_direction(name: str) -> None:
    drawing = draw(store.machine(name), dimensions=True)
    for _, middle, turned in every(values(drawing)):
        nearest = min((line for line in lines(drawing) if len(line) == 2), key=lambda each: distance(middle, each))
        way = nearest[1] - nearest[0]
        direction = math.degrees(math.atan2(way[1], way[0]))
        assert math.isclose(math.sin(math.radians(direction - turned)), 0.0, abs_tol=0.01)
        assert 5.0 < distance(middle, nearest) < 12.0


@pytest.mark.parametrize("angle", [0, 30, 60, 90, 120, 150, 180, 250, 270, 300])
def test_values_are_read_from_below_or_from_the_right(angle: int) -> None:
    """Directions between straight up and nearly straight down; those that go straight up are read from the right."""
    model = lw.Model("bar")
    model.frame(O=(0, 0))
    model.link("bar", ["O", "A"], length=0.2)
    model.drive("bar", about="O", speed=1)
    drawing = draw(model.build(), at=math.radians(angle), dimensions=("bar",))
    ((text, _, turned),) = values(drawing)
    assert text == "200 mm"
    assert -90.01 <= turned < 89.9
    assert math.isclose(math.sin(math.radians(turned + angle)), 0.0, abs_tol=0.01)


def test_values_of_short_lengths_stand_behind_their_lines() -> None:
    """A crank of 6 mm in a machine of 300 mm: between the heads there is no room."""
    drawing = draw(lw.loads(ECCENTRIC), dimensions=("crank",))
    ((text, middle, turned),) = values(drawing)
    assert text == "6 mm"
    line = lines(drawing)[0]
    assert abs(turned) < 0.01
    assert abs(middle[1] - line[0, 1]) < 0.5
    assert abs(middle[0] - line[:, 0].mean()) > 0.5 * np.ptp(line[:, 0]) + 10.0
