"""Motors, brakes, flywheels, cylinders and end stops in drawings: at what they act on, at every position."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright.page.glyphs import glyphs
from linkwright.pictures.picture import Circle
from linkwright.pictures.symbols.actuators import AWAY, MOTOR
from linkwright.pictures.symbols.machine import LENGTH
from linkwright.plotting.drawing.actuators import actuators, flywheels, stops
from linkwright.plotting.drawing.loads import load_marks
from linkwright.plotting.drawing.scene import Scene, laid_out

PRESS = """format: 1
name: Press
frame: {points: {O: [0 m, 0 m], H: [0.4 m, -0.3 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.3 m}
  slide: {points: [B]}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
actuators:
  main: {kind: dc, on: crank, stall_torque: 20 N·m, no_load_speed: 90 rpm}
  shoe: {kind: brake, on: crank, torque: 5 N·m}
  wheel: {kind: flywheel, on: crank, inertia: 2 kg·m²}
  ram: {kind: cylinder, along: guide, force: 1 kN}
  lift: {kind: cylinder, between: [frame.H, rod.A], force: 1 kN}
stops:
  low: {of: B.y, at: -0.4 m, side: below}
  swing: {of: crank, at: 180 deg, side: above}
"""
PLACES = [0, 13, 40]


@pytest.fixture(scope="module")
def scene() -> Scene:
    return laid_out(lw.solve_motion(lw.loads(PRESS), steps=60), 0)


def test_motor_brake_and_flywheel_are_at_the_pin(scene: Scene) -> None:
    parts = dict(zip(("main", "shoe"), actuators(scene.machine, 0), strict=True))
    assert [pin for _part, pin in parts.values()] == ["O", "O"]
    (circle,) = (each for each in parts["main"][0].shape.elements if isinstance(each, Circle))
    assert math.dist(circle.at, (0.0, 0.0)) == pytest.approx(AWAY)
    assert circle.radius == MOTOR
    ((disc, pin),) = flywheels(scene.machine)
    assert (disc.carrier, pin) == ("crank", "O")


@pytest.mark.parametrize("index", PLACES)
def test_cylinders_reach_between_what_they_move(scene: Scene, index: int) -> None:
    """By the formula of the slider-crank: y = -(r cos a + sqrt(l² - r² sin² a)) with a from the guide."""
    scale = scene.machine.view.scale
    angle = 2 * math.pi * index / 60
    a = np.array([0.1 * math.cos(angle), 0.1 * math.sin(angle)])
    block = np.array([0.0, a[1] - math.sqrt(0.09 - a[0] ** 2)])
    ink = np.concatenate(load_marks(scene.machine, index).ink) / scale * (1.0, -1.0)
    for wanted in (a, (0.4, -0.3), block - (0.0, LENGTH / 2 / scale)):
        assert np.hypot(*(ink - wanted).T).min() < 1e-9


def test_stops_are_where_the_output_stops(scene: Scene) -> None:
    scale = scene.machine.view.scale
    low, swing = (np.concatenate(each.shape.ink) for each in stops(scene.machine))
    assert low[:, 1].min() == pytest.approx(0.4 * scale + LENGTH / 2)
    # Above 180°, counter-clockwise: below the crank that points to the left.
    assert 0.5 * (swing[:, 0].min() + swing[:, 0].max()) == pytest.approx(-0.06 * scale)
    assert swing[:, 1].min() == pytest.approx(2.0)


def test_living_pages_have_them(scene: Scene) -> None:
    found = glyphs(scene.machine, 0)
    (ram,) = (each for each in found if each["kind"] == "cylinder")
    assert (ram["through"], ram["at"]) == ("frame.H", "A")
    # From 0.4 m to 0.6 m: the rod reaches from the longest to where the piston stays in the barrel.
    assert ram["barrel"] + ram["piston"] > 0.6 > ram["barrel"]
    low, swing = (each["off"] for each in found if "off" in each)
    assert low == pytest.approx([0.0, 0.4], abs=1e-9)
    assert swing == pytest.approx([-0.06, 0.0], abs=1e-9)


def test_pictures_and_animations_have_them() -> None:
    bare = lw.loads(PRESS[: PRESS.index("actuators:")])
    for made in (lw.draw, lw.animate):
        assert len(str(made(lw.loads(PRESS)).svg)) > len(str(made(bare).svg))
