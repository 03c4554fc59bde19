"""Vectors of drawings and what they are drawn from: tracks of names, rails of guides, loads of other packages."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import Drawing, draw
from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, LinkPoint, Load
from linkwright.applied_loads.site import Site, Wrench
from linkwright.plotting.animation import animate
from linkwright.plotting.drawing.machine import Mark, Push, mark_of

SVG = "{http://www.w3.org/2000/svg}"

TWISTED = """
format: 1
name: turned crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m}
driver: {turn: crank, about: O, speed: 1 rad/s}
loads:
  brake: {kind: torque, on: crank, magnitude: -7 N·m}
"""


def texts(drawing: Drawing, style: str | None = None) -> list[str]:
    found = ET.fromstring(drawing.svg).iter(f"{SVG}text")
    return ["".join(e.itertext()) for e in found if style in (None, e.get("class"))]


def test_moving_arrows_keep_their_names() -> None:
    animation = animate(store.motion("jaw_crusher_sixbar", 36), forces=True, frames=12, labels=False)
    for svg in (animation.svg, animation.frame(6)):
        names = {t for t in texts(Drawing(svg)) if t.startswith(("F", "T")) and " " not in t}
        assert {"F01", "F12", "F05", "T"} <= names
    shifts = {}
    for index in (0, 9, 18):
        (group,) = [
            e
            for e in ET.fromstring(animation.frame(index)).iter(f"{SVG}g")
            if e.find(f"{SVG}text") is not None and "".join(e.find(f"{SVG}text").itertext()) == "F12"  # type: ignore[union-attr]
        ]
        shifts[index] = np.array(re.findall(r"-?[\d.]+", group.get("transform", "")), dtype=float)
    arrows, scale = animation.arrows[0]
    track = arrows.vectors[0].track("pitman.A", animation.scene.machine.view, scale)
    for index in (9, 18):
        assert shifts[index] - shifts[0] == pytest.approx(track[index] - track[0], abs=0.02)


@pytest.mark.parametrize("name", ["crank_rocker", "shaper_quick_return", "slider_crank_inline", "toggle_press"])
def test_both_limit_positions_lie_inside_the_picture(name: str) -> None:
    motion = store.motion(name, 5)
    root = ET.fromstring(draw(motion, overlay="limits").svg)
    left, top, wide, tall = map(float, root.get("viewBox", "").split())
    scale = _paper_scale(motion)
    limits = lw.limit_positions(motion, _output(name))
    assert len(limits) >= 2
    there = lw.solve_motion(motion.mechanism, times=[each.time for each in limits])
    for key in every(there.point_names()):
        for x, y in there.point_of(key).position * (scale, -scale):
            assert left < x < left + wide and top < y < top + tall


def _output(name: str) -> str:
    return {
        "crank_rocker": "rocker",
        "shaper_quick_return": "guide",
        "slider_crank_inline": "cylinder",
        "toggle_press": "guide",
    }[name]


def _paper_scale(motion: lw.Motion) -> float:
    from linkwright.kinematics.placement import placements
    from linkwright.plotting.drawing.machine import fitted

    return fitted(motion, placements(motion)).scale


@pytest.mark.parametrize("steps", [3, 7])
def test_rails_reach_to_the_limit_positions_that_are_drawn(steps: int) -> None:
    from linkwright.events.limit_positions import limits_of
    from linkwright.plotting.drawing.draw import laid_out_with_ghosts
    from linkwright.plotting.drawing.guides import travel
    from linkwright.plotting.drawing.scene import Shown, with_limits

    motion = store.motion("slider_crank_inline", steps)
    denser, indices = with_limits(motion, limits_of(motion))
    ghosts = [Shown(denser, index) for index in indices]
    scene, _, _ = laid_out_with_ghosts(motion, Shown(motion, 0), ghosts, inputs=False, centres=False)
    crank, rod = 0.05, 0.2
    low, high = (each / scene.machine.view.scale for each in travel(scene.machine, "cylinder"))
    assert (low, high) == pytest.approx((rod - crank, rod + crank), abs=1e-9)


@dataclass(frozen=True, kw_only=True)
class Magnet(Load):
    """A kind of load as another package brings it, without a symbol."""

    kind: ClassVar[str] = "outside_magnet"
    between: tuple[LinkPoint, LinkPoint] = base.points(doc="its two ends")

    def wrenches(self, site: Site) -> list[Wrench]:
        return []


@dataclass(frozen=True, kw_only=True)
class Wind(Load):
    """A kind of load as another package brings it, that names a link only."""

    kind: ClassVar[str] = "outside_wind"
    on: str = base.link(moving=True, doc="the link")

    def wrenches(self, site: Site) -> list[Wrench]:
        return []


@dataclass(frozen=True, kw_only=True)
class Field(Load):
    """A kind of load as another package brings it, that names no place."""

    kind: ClassVar[str] = "outside_field"

    def wrenches(self, site: Site) -> list[Wrench]:
        return []


@pytest.fixture
def outside_kinds() -> Iterator[None]:
    kinds = (Magnet, Wind, Draught, Field)
    for each in kinds:
        LOADS.register(each.kind)(each)
    yield
    for each in kinds:
        del LOADS._elements[each.kind]


@dataclass(frozen=True, kw_only=True)
class Draught(Wind):
    """The same with a mark that the package registers."""

    kind: ClassVar[str] = "outside_draught"


@mark_of.register
def _draught(load: Draught, motion: lw.Motion, index: int) -> Mark:
    return Push(load.on, "A", 0.0)


@pytest.mark.usefixtures("outside_kinds")
def test_a_load_of_another_package_has_the_mark_that_it_registers() -> None:
    machine = lw.loads(TWISTED + "  gust: {kind: outside_draught, on: crank}\n")
    assert mark_of(machine.loads["gust"], lw.solve_motion(machine, steps=4), 1) == Push("crank", "A", 0.0)
    drawing = draw(machine)
    assert drawing.notes == () and "gust" in texts(drawing, "lw-load-name")


@pytest.mark.usefixtures("outside_kinds")
def test_a_load_of_another_package_has_the_general_symbol_or_a_sentence() -> None:
    drawing = draw(
        lw.loads(
            TWISTED + "  pull: {kind: outside_magnet, between: [frame.O, crank.A]}\n"
            "  gust: {kind: outside_wind, on: crank}\n  haze: {kind: outside_field}\n"
        )
    )
    rings = [e for e in ET.fromstring(drawing.svg).iter(f"{SVG}circle") if e.get("class") == "lw-load-ring"]
    assert len(rings) == 2
    assert {"pull", "gust"} <= set(texts(drawing, "lw-load-name"))
    (note,) = drawing.notes
    assert "haze" in note and "pull" not in note and "gust" not in note
    assert note in " ".join(each.strip() for each in texts(drawing))
