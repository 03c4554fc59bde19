"""What the sheet is told of loads, masses, guides and drives before the text is a model."""

from __future__ import annotations

import math

import pytest
from tests.ui.texts import FOURBAR

from linkwright.server.draft import picture

PRESS = """format: 1
frame: {points: {O: [0 mm, 0 mm], G: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], mass: 0.5 kg}
  rod: {points: [A, B], mass: 2 kg/4, mass_centre: [30 mm, 4 mm]}
  ram: {points: [B], mass: 300 N/(9.81 m/s²), mass_centre: B}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 30 deg, block: ram, at: B}
  A: {kind: revolute, friction: 0.1}
driver: {slide: guide, speed: 0.2 m/s}
gravity: [0, -9.81 m/s²]
"""
LOADS = """loads:
  held: {kind: force, on: ram, at: B, in_link: 180 deg, magnitude: 250 N}
  spread: {kind: force, on: rod, at: B, normal_to: [A, B], ramp: [10 N, -2 kN], phase: {input: [0 deg, 90 deg]}}
  drag: {kind: force, on: ram, at: B, opposes: velocity, magnitude: k*2 N}
  gas: {kind: spring, between: [frame.O, rod.B], stiffness: 0.4 N/mm, free_length: 90 mm, preload: -200 N}
  twist: {kind: torsion_spring, links: [crank, rod], stiffness: 2 N·m/rad}
  turn: {kind: torque, on: crank, magnitude: -3 N·m}
"""


def test_the_direction_of_a_force_comes_with_what_holds_it() -> None:
    loads = picture(PRESS + LOADS)["loads"]
    held, spread, drag = loads["held"], loads["spread"], loads["drag"]
    assert (held["held"], held["turn"], held["angle"]) == ("link", pytest.approx(math.pi), None)
    assert (spread["held"], spread["ray"], spread["normal"], spread["magnitude"]) == (
        "ray",
        ["A", "B"],
        True,
        -2000.0,
    )
    assert (held["always"], spread["always"]) == (True, False)
    assert (drag["held"], drag["magnitude"]) == ("velocity", None)


def test_springs_and_torques_come_with_their_ends_and_numbers() -> None:
    loads = picture(PRESS + LOADS)["loads"]
    gas, twist, turn = loads["gas"], loads["twist"], loads["turn"]
    assert (gas["between"], gas["ends"], gas["size"]) == ([["frame", "O"], ["rod", "B"]], ["O", "B"], "0.4 N/mm")
    assert (gas["stiffness"], gas["preload"]) == (pytest.approx(400.0), -200.0)
    assert (twist["links"], twist["between"]) == (["crank", "rod"], [])
    assert turn["magnitude"] == -3.0


def test_masses_guides_and_drives_of_a_text() -> None:
    shown = picture(PRESS)
    assert shown["gravity"] == [0.0, -9.81]
    assert {name: (each["mass"], each["centre"]) for name, each in shown["masses"].items()} == {
        "crank": (0.5, None),
        "rod": (0.5, [0.03, 0.004]),
        "ram": (pytest.approx(300 / 9.81), "B"),
    }
    assert list(shown["guides"]) == ["guide"]
    assert (shown["guides"]["guide"]["block"], shown["guides"]["guide"]["direction"]) == (
        "ram",
        pytest.approx(math.pi / 6),
    )
    assert shown["drives"] == {"driver": {"turn": "", "about": "", "slide": "guide", "speed": "0.2 m/s", "rate": 0.2}}


def test_a_text_without_loads_has_none() -> None:
    shown = picture(FOURBAR)
    assert (shown["loads"], shown["gravity"], shown["masses"], shown["guides"]) == ({}, None, {}, {})
    assert (shown["drives"]["driver"]["turn"], shown["drives"]["driver"]["about"]) == ("crank", "O1")
