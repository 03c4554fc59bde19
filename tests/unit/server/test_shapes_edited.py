"""Edits of the studio leave shapes of links and layers of plates right."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

import linkwright as lw
from linkwright.server import edits

TEXT = """\
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m], G: [300 mm, 0 m]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod:
    points: [A, B]
    length: 300 mm
    also: {P: [150 mm, 40 mm]}
    shape: {through: [A, P, [200 mm, 30 mm], B], width: 20 mm}
  slider: {points: [B]}
joints:
  slide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slider, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
construction: {width: 30 mm, layers: {crank: 1, guide slide: 2, rod: 3}}
"""


def edited(action: dict[str, Any]) -> dict[str, Any]:
    text = edits.edited(TEXT, [action]).text
    lw.loads(text)
    found: dict[str, Any] = yaml.load(text, yaml.BaseLoader)
    return found


@pytest.mark.parametrize(
    ("what", "old", "new", "layers"),
    [
        ("link", "rod", "coupler", ["crank", "guide slide", "coupler"]),
        ("pair", "slide", "rail", ["crank", "guide rail", "rod"]),
    ],
)
def test_layers_follow_another_name(what: str, old: str, new: str, layers: list[str]) -> None:
    found = edited({"do": "rename", "what": what, "from": old, "to": new})
    assert list(found["construction"]["layers"]) == layers


def test_a_path_follows_another_name_of_a_point() -> None:
    found = edited({"do": "rename", "what": "point", "from": "P", "to": "S"})
    assert found["links"]["rod"]["shape"]["through"] == ["A", "S", ["200 mm", "30 mm"], "B"]


def test_a_path_goes_on_without_a_point_that_is_taken_off() -> None:
    found = edited({"do": "remove", "what": "joint", "name": "P"})
    assert found["links"]["rod"]["shape"] == {"through": ["A", ["200 mm", "30 mm"], "B"], "width": "20 mm"}


def test_layers_of_what_is_removed_go_with_it() -> None:
    text = edits.edited(TEXT, [{"do": "remove", "what": "link", "name": "slider"}]).text
    found = yaml.load(text, yaml.BaseLoader)
    assert list(found["construction"]["layers"]) == ["crank", "rod"]
