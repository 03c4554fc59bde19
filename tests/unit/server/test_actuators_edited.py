"""Edits of the studio leave actuators, end stops and runs right: renamed with what they name, taken out with it."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

import linkwright as lw
from linkwright.server import edits

TEXT = """format: 1
frame: {points: {O: [0 mm, 0 mm], S: [300 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod: {points: [A, B], length: 450 mm}
  slide: {points: [B]}
  arm: {points: [A, T], length: 200 mm}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}
assembly: {B: forward}
drawing: {A: [0 mm, 100 mm], B: [0 mm, -350 mm], T: [200 mm, 100 mm]}
drivers:
  one: {turn: crank, about: O, speed: 60 rpm, start: 90 deg}
  two: {turn: arm, about: A, relative_to: crank, free: true}
cycle: {duration: 1 s}
actuators:
  main: {kind: dc, on: crank, stall_torque: 20 N·m, no_load_speed: 30 rad/s}
  hand: {kind: constant, on: arm, against: crank, torque: 2 N·m}
  ram: {kind: cylinder, between: [frame.S, slide.B], force: 30 N}
  push: {kind: brake, along: guide, force: 3 N}
stops:
  buffer: {of: B.y, at: -500 mm, side: below}
  tip: {of: arm.T.x, at: 400 mm, side: above}
  peg: {of: crank, at: 300 deg, side: above}
  end: {of: guide, at: 600 mm, side: above}
run: {at: {one: 30 deg, two: 10 deg}, speed: {two: 1 rad/s}, prescribed: [one], for: 2 s}
"""


def edited(*actions: dict[str, Any]) -> str:
    return edits.edited(TEXT, list(actions)).text


def sections(text: str) -> dict[str, Any]:
    return {key: yaml.load(text, yaml.BaseLoader).get(key) for key in ("actuators", "stops", "run")}


def test_the_text_is_a_model() -> None:
    lw.loads(TEXT.replace("prescribed: [one], ", "").replace("one: 30 deg, ", ""))


@pytest.mark.parametrize(
    ("what", "old", "new", "expected"),
    [
        ("link", "crank", "eccentric", ["on: eccentric,", "against: eccentric,", "of: eccentric,"]),
        ("link", "slide", "ram_slide", ["[frame.S, ram_slide.B]"]),
        ("link", "arm", "tool", ["on: tool,", "of: tool.T.x"]),
        ("pair", "guide", "way", ["along: way,", "of: way,"]),
        ("point", "B", "K", ["[frame.S, slide.K]", "of: K.y"]),
        ("point", "S", "U", ["[frame.U, slide.B]"]),
        ("point", "T", "V", ["of: arm.V.x"]),
        ("actuator", "ram", "jack", ["  jack: {kind: cylinder"]),
        ("stop", "peg", "bolt", ["  bolt: {of: crank"]),
        ("driver", "two", "second", ["second: 10 deg", "speed: {second: 1 rad/s}"]),
        ("driver", "one", "first", ["first: 30 deg", "prescribed: [first]"]),
    ],
)
def test_a_new_name_reaches_them(what: str, old: str, new: str, expected: list[str]) -> None:
    text = edited({"do": "rename", "what": what, "from": old, "to": new})
    assert all(each in text for each in expected), text
    assert sections(text).keys() == sections(TEXT).keys()
    again = edits.edited(text, [{"do": "rename", "what": what, "from": new, "to": old}]).text
    assert again == TEXT


def test_what_acts_on_a_link_goes_with_it() -> None:
    left = sections(edited({"do": "remove", "what": "link", "name": "arm"}))
    assert list(left["actuators"]) == ["main", "ram", "push"]
    assert list(left["stops"]) == ["buffer", "peg", "end"]
    assert left["run"] == {"at": {"one": "30 deg"}, "prescribed": ["one"], "for": "2 s"}


def test_what_acts_along_a_guide_goes_with_it() -> None:
    left = sections(edited({"do": "remove", "items": [{"kind": "pair", "name": "guide"}]}))
    assert list(left["actuators"]) == ["main", "hand"]
    assert list(left["stops"]) == ["buffer", "tip", "peg"]


def test_a_run_ends_with_the_last_driver_and_actuators_are_taken_out_alone() -> None:
    drivers = [{"kind": "driver", "name": name} for name in ("one", "two")]
    assert sections(edited({"do": "remove", "items": drivers}))["run"] is None
    left = sections(
        edited({"do": "remove", "items": [{"kind": "actuator", "name": "ram"}, {"kind": "stop", "name": "tip"}]})
    )
    assert list(left["actuators"]) == ["main", "hand", "push"]
    assert list(left["stops"]) == ["buffer", "peg", "end"]


def test_a_pin_that_comes_apart_renames_the_end_of_a_cylinder() -> None:
    text = TEXT.replace("[frame.S, slide.B]", "[frame.S, rod.A]")
    apart = edits.edited(text, [{"do": "remove", "what": "joint", "name": "A"}]).text
    (end,) = [each for each in sections(apart)["actuators"]["ram"]["between"] if each != "frame.S"]
    link, _, point = end.partition(".")
    assert link == "rod" and point in yaml.load(apart, yaml.BaseLoader)["links"]["rod"]["points"]


def test_copies_of_links_have_copies_of_what_acts_on_them() -> None:
    items = [{"kind": "link", "name": name} for name in ("crank", "arm")]
    text = edited({"do": "paste", "items": items, "shift": [0.5, 0.0], "mirror": "x"})
    found = sections(text)["actuators"]
    copies = [each for name, each in found.items() if name not in sections(TEXT)["actuators"]]
    assert {each["kind"] for each in copies} == {"dc", "constant"}
    (hand,) = [each for each in copies if each["kind"] == "constant"]
    assert hand["torque"] == "-2 N·m" and hand["on"] != "arm" and hand["against"] != "crank"
