"""What living pages draw, as data: where symbols stand and which lies over which."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

import linkwright as lw
from linkwright.kinematics.placement import placements
from linkwright.page.glyphs import glyphs
from linkwright.plotting.drawing.machine import DrawnMechanism, fitted

ENGINE = """
format: 1
name: Engine with a camshaft
frame: {points: {O: [0 mm, 0 mm], S: [110 mm, 60 mm], G: [110 mm, 150 mm]}}
links:
  crank: {points: [O, A], length: 40 mm}
  rod: {points: [A, B], length: 140 mm}
  piston: {points: [B]}
  shaft: {points: [S]}
  tappet: {points: [T]}
joints:
  bore: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: piston, at: B}
  way: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: tappet, at: T, block_angle: 90 deg}
  timing: {kind: chain, links: [crank, shaft], teeth: [19, 38], pitch: 8 mm}
  lobe:
    {kind: cam, cam: shaft, follower: tappet, at: T, touch: roller, roller_radius: 8 mm, base_radius: BASE,
     program: [{rise: 9 mm, over: 90 deg}, {fall: 9 mm, over: 90 deg}, {dwell: 180 deg}]}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 3000 rpm}
loads:
  gas: {kind: pressure, joint: bore, bore: 80 mm, pushes: WAY, magnitude: 1 MPa}
"""


def glyphs_of(motion: lw.Motion) -> list[dict[str, Any]]:
    placed = placements(motion)
    return glyphs(DrawnMechanism(motion, placed, fitted(motion, placed)), 0)


def drawn(base: str = "60 mm", way: str = "backward") -> list[dict[str, Any]]:
    motion = lw.solve_motion(lw.loads(ENGINE.replace("BASE", base).replace("WAY", way)), steps=36)
    return glyphs_of(motion)


@pytest.mark.parametrize(("way", "side"), [("backward", 1), ("forward", -1)])
def test_a_pressure_stands_on_the_face_that_it_pushes(way: str, side: int) -> None:
    """Along its guide, wherever that leads; its arrows lie ahead of the block where they push it back."""
    (gas,) = (each for each in drawn(way=way) if "lw-load" in each.get("svg", ""))
    assert (gas["at"], gas["along"]) == ("B", "d:bore")
    x = [float(each) for each in re.findall(r"[ML](-?[\d.]+)[ ,]", gas["svg"])]
    assert x and all(side * each > 5 for each in x)


@pytest.mark.parametrize(("base", "over"), [("60 mm", "wheel"), ("30 mm", "cam")])
def test_the_smaller_of_a_wheel_and_a_cam_on_a_shaft_lies_over_the_larger(base: str, over: str) -> None:
    """The sprocket of 38 teeth has a pitch radius of 4 mm/sin(180°/38) = 48.4 mm."""
    assert 4 / math.sin(math.pi / 38) == pytest.approx(48.4, abs=0.05)
    found = drawn(base)
    kinds = [each["kind"] for each in found if each["kind"] in ("wheel", "cam") and each["link"] == "shaft"]
    assert kinds[-1] == over


def test_wheels_that_mesh_are_found_by_their_place_with_cams_between() -> None:
    text = ENGINE.replace(
        "chain, links: [crank, shaft], teeth: [19, 38], pitch: 8 mm", "gear, links: [crank, shaft], ratio: -0.5"
    )
    motion = lw.solve_motion(lw.loads(text.replace("BASE", "60 mm").replace("WAY", "forward")), steps=36)
    found = glyphs_of(motion)
    meshing = [each for each in found if "mesh" in each]
    assert len(meshing) == 1 and found[meshing[0]["mesh"]]["kind"] == "wheel"
    assert {meshing[0]["link"], found[meshing[0]["mesh"]]["link"]} == {"crank", "shaft"}
