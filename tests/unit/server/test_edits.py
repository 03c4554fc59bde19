"""What drawing in the studio writes: points, links, slides, slots, gears, cams, racks; values that are refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.refusals import refused
from tests.ui.texts import FOURBAR

import linkwright as lw
from linkwright.designs.varied_dimensions import changed_text
from linkwright.files.model_file import read_text
from linkwright.files.write import Document
from linkwright.server import edits
from linkwright.server.work import new_text

NEW = new_text()


def edited(text: str, action: dict[str, Any]) -> str:
    """The text after an action of drawing."""
    return edits.edited(text, [action]).text


DRAWN: tuple[dict[str, Any], ...] = (
    {"do": "point", "name": "O1", "at": [0.0, 0.0], "fixed": True},
    {"do": "point", "name": "O2", "at": [0.2, 0.0], "fixed": True},
    {"do": "point", "name": "A", "at": [0.03, 0.04]},
    {"do": "link", "name": "crank", "points": ["O1", "A"]},
    {"do": "point", "name": "B", "at": [0.16, 0.12]},
    {"do": "link", "name": "coupler", "points": ["A", "B"]},
    {"do": "link", "name": "rocker", "points": ["B", "O2"]},
    {"do": "driver", "link": "crank", "about": "O1"},
    {"do": "mass", "link": "rocker", "mass": "2 kg"},
    {"do": "load", "link": "rocker", "at": "B", "force": "100 N", "angle": -90},
)


def drawn() -> str:
    text = NEW
    for action in DRAWN:
        text = edited(text, action)
    return text


def test_drawing_writes_what_a_person_would() -> None:
    text = drawn()
    assert "  points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm]}\n" in text
    inertia = 2 * ((0.2 - 0.16) ** 2 + 0.12**2) / 12
    assert f"  rocker: {{points: [B, O2], length: 126.5 mm, mass: 2 kg, inertia: {inertia:.4g} kg·m²}}\n" in text
    mechanism = lw.loads(text)
    assert mechanism.dimension("crank.length") == pytest.approx(0.05)
    assert lw.structure(mechanism).mobility == 1
    moved = lw.loads(changed_text(Document(text, "drawn", read_text), {"crank.length": 0.045}))
    assert moved.dimension("crank.length") == pytest.approx(0.045, rel=1e-13)
    assert moved.dimension("coupler.length") == mechanism.dimension("coupler.length")
    bare = edited(text, {"do": "remove", "what": "link", "name": "crank"})
    assert "crank" not in bare
    assert "rocker" in bare
    guided = edited(text, {"do": "link", "name": "slider1", "points": ["B"]})
    guided = edited(guided, {"do": "guide", "link": "slider1", "at": "B", "angle": 0})
    assert "kind: prismatic, guide: frame, through: G1, direction: 0 deg, block: slider1, at: B" in guided


PRESS = """format: 1
frame: {points: {O: [0 mm, 0 mm], P: [100 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 20 mm, mass: 1 kg}
  rod: {points: [A, K], length: 80 mm}
  lever: {points: [P, K], length: 60 mm}
  wheel: {points: [O, B], length: 30 mm}
joints:
  K: {kind: revolute, pin_radius: 5 mm, friction: 0.1}
  mesh: {kind: gear, links: [lever, wheel], teeth: [20, 40]}
assembly: {K: left}
drivers:
  input: {turn: crank, about: O, speed: 60 rpm}
loads:
  pull: {kind: spring, between: [frame.P, rod.K], stiffness: 1 N/mm, free_length: 10 mm}
  twist: {kind: torsion_spring, links: [frame, lever], stiffness: 1 N·m/rad, free_angle: 0 deg}
"""


#: Beginnings of the lines that a link takes along.
TAKEN_ALONG = (
    ("rod", ("  rod:", "  K:", "assembly:", "  pull:")),
    ("lever", ("  lever:", "joints:", "  K:", "  mesh:", "assembly:", "  twist:")),
    ("crank", ("  crank:", "drivers:", "  input:")),
)


@pytest.mark.parametrize(("link", "lines"), TAKEN_ALONG)
def test_a_link_that_is_removed_takes_along_what_stands_on_it(link: str, lines: tuple[str, ...]) -> None:
    """Joints and loads that name it in lists or by its points, drivers, words about pins of no two links."""
    left = [line for line in PRESS.splitlines(keepends=True) if not line.startswith(lines)]
    assert edited(PRESS, {"do": "remove", "what": "link", "name": link}) == "".join(left)
    with refused("studio.no_link", name=link):
        edited("".join(left), {"do": "remove", "what": "link", "name": link})


def test_a_slide_is_drawn_on_a_point_that_no_drawing_gives() -> None:
    """The guide goes through where the machine has the point."""
    slider = {"do": "link", "name": "slider1", "points": ["K"]}
    guide = {"do": "guide", "link": "slider1", "at": "K", "angle": 30}
    text = edited(edited(PRESS, slider), guide)
    assert f"G1: [77.5 mm, {math.sqrt(80**2 - 57.5**2):.1f} mm]" in text  # the crank along x, triangle A K P
    assert "through: G1, direction: 30 deg, block: slider1, at: K" in text


def test_comments_stay_where_they_are() -> None:
    text = drawn().replace("kg·m²}\n", "kg·m²}  # of steel\n").replace("links:\n", "links:  # three of them\n")
    again = edited(text, {"do": "mass", "link": "rocker", "mass": "3 kg"})
    assert again == text.replace("2 kg", "3 kg").replace("0.002667 kg·m²", "0.004 kg·m²")


SLOTTED: tuple[dict[str, Any], ...] = (
    {"do": "point", "name": "O1", "at": [0.0, 0.0], "fixed": True},
    {"do": "point", "name": "O2", "at": [0.0, -0.2], "fixed": True},
    {"do": "point", "name": "A", "at": [0.05, 0.02]},
    {"do": "link", "name": "crank", "points": ["O1", "A"]},
    {"do": "point", "name": "B", "at": [0.04, 0.1]},
    {"do": "link", "name": "lever", "points": ["O2", "B"]},
    {"do": "slot", "along": "lever", "at": "A"},
    {"do": "driver", "link": "crank", "about": "O1"},
)


def test_slots_and_gears_are_drawn() -> None:
    """A block beside its slot keeps its distance; the lever then turns as its closed form says. Gears by teeth."""
    text = NEW
    for action in SLOTTED:
        text = edited(text, action)
    mechanism = lw.loads(text)
    assert lw.structure(mechanism).mobility == 1
    motion = lw.solve_motion(mechanism, steps=24)
    off = mechanism.dimension("slot1.offset")
    gap = motion.point("A").position - np.array([0.0, -0.2])
    line = motion.link("lever").angle + np.arctan2(0, 1)
    across = gap[:, 1] * np.cos(line) - gap[:, 0] * np.sin(line)
    assert np.ptp(across) < 1e-12
    assert abs(off) == pytest.approx(abs((0.04 * 0.22 - 0.3 * 0.05) / np.hypot(0.04, 0.3)), abs=1e-4)
    geared = NEW
    for action in (
        *SLOTTED[:6],
        {"do": "driver", "link": "crank", "about": "O1"},
        {"do": "gear", "links": ["crank", "lever"], "teeth": "20 : 40"},
    ):
        geared = edited(geared, action)
    turned = lw.solve_motion(lw.loads(geared), steps=12)
    assert turned.link("lever").angular_velocity == pytest.approx(-0.5 * turned.link("crank").angular_velocity)
    with refused("studio.no_teeth", text="x"):
        edited(geared, {"do": "gear", "links": ["a", "b"], "teeth": "x"})
    with refused("studio.no_slot", name="no"):
        edited(geared, {"do": "slot", "along": "no", "at": "A"})


def drawn_with(*actions: dict[str, Any]) -> str:
    """A new file after these actions, beginning with a crank about O1."""
    text = NEW
    for action in (DRAWN[0], DRAWN[2], DRAWN[3], DRAWN[7], *actions):
        text = edited(text, action)
    return text


def test_a_cam_lifts_what_slides_or_turns_on_the_frame() -> None:
    """The roller stands where it is drawn and is lifted by what is asked; a guide that leads inwards is turned."""
    roller = {"do": "point", "name": "B", "at": [0.01, 0.06]}
    slider = {"do": "link", "name": "slider1", "points": ["B"]}
    guide = {"do": "guide", "link": "slider1", "at": "B", "angle": -90}
    cam = {"do": "cam", "cam": "crank", "at": "B", "lift": "20 mm"}
    text = drawn_with(roller, slider, guide, cam)
    assert "base_radius: 50.8 mm, roller_radius: 10 mm" in text
    mechanism = lw.loads(text)
    assert lw.structure(mechanism).mobility == 1
    y = lw.solve_motion(mechanism, steps=36).point("B").position[:, 1]
    low = math.sqrt(0.0608**2 - 0.01**2)
    assert y[0] == pytest.approx(low, rel=1e-12)
    assert (y.min(), y.max()) == pytest.approx((low, low + 0.02), rel=1e-12)
    pivot = {"do": "point", "name": "O2", "at": [0.1, 0.0], "fixed": True}
    arm = {"do": "link", "name": "arm", "points": ["O2", "B"]}
    turned = lw.solve_motion(lw.loads(drawn_with(roller, pivot, arm, cam)), steps=36)
    reach = math.dist((0.1, 0.0), (0.01, 0.06))
    assert np.ptp(turned.link("arm").angle) == pytest.approx(2 * math.asin(0.01 / reach), abs=1e-3)
    away = np.hypot(*turned.point("B").position.T)
    assert (away.min(), away[0]) == pytest.approx((0.0608, 0.0608), rel=1e-12)
    with refused("studio.no_cam", cam="crank", at="A"):
        drawn_with(roller, slider, guide, {**cam, "at": "A"})
    with refused("studio.no_cam", cam="slider1", at="B"):
        drawn_with(roller, slider, guide, {**cam, "cam": "slider1"})
    with refused("wrong-dimension", text="9 kg"):
        drawn_with(roller, slider, guide, {**cam, "lift": "9 kg"})


def test_a_rack_meshes_with_a_pinion_as_large_as_it_is_drawn() -> None:
    """The rack's travel is the drawn distance times the angle that the pinion swings."""
    more = (
        DRAWN[1],
        DRAWN[4],
        DRAWN[5],
        DRAWN[6],
        {"do": "point", "name": "C", "at": [0.25, -0.05]},
        {"do": "link", "name": "slider1", "points": ["C"]},
    )
    guide = {"do": "guide", "link": "slider1", "at": "C", "angle": 30}
    mesh = {"do": "rack", "pinion": "rocker", "rack": "slider1"}
    mechanism = lw.loads(drawn_with(*more, guide, mesh))
    assert lw.structure(mechanism).mobility == 1
    motion = lw.solve_motion(mechanism, steps=72)
    place = motion.point("C").position
    as_drawn = lw.solve_motion(mechanism, at={"driver": math.atan2(0.04, 0.03)})
    assert as_drawn.point("C").position[0] == pytest.approx([0.25, -0.05], abs=1e-4)
    radius = abs(0.05 * math.sin(math.radians(30)) + 0.05 * math.cos(math.radians(30)))
    swing = np.ptp(motion.link("rocker").angle)
    assert math.dist(place.min(axis=0), place.max(axis=0)) == pytest.approx(radius * swing, rel=1e-8)
    for wrong in ({"pinion": "coupler"}, {"rack": "rocker"}):
        with refused("studio.no_rack", **{"pinion": "rocker", "rack": "slider1", **wrong}):
            drawn_with(*more, guide, {**mesh, **wrong})


WISH = {
    "vary": {"coupler.length": "3.2..4.2 m", "rocker.length": "2.5..3.5 m"},
    "maximize": "transmission_angle",
    "keep": {"swing_angle": "same within 5 %"},
    "evaluations": 400,
}


def test_the_section_of_an_optimisation_is_written_into_its_place() -> None:
    """Line by line, comments around it stay, and the file reads back as what was asked; braces are refused."""
    text = "# mine\n" + store.text("crank_rocker") + "# the end\n"
    asked = edited(text, {"do": "optimize", "section": WISH})
    assert asked.startswith("# mine\n")
    assert "\n  vary:\n    coupler.length: 3.2..4.2 m\n" in asked
    assert lw.loads(asked).optimize == WISH
    again = edited(asked, {"do": "optimize", "section": {**WISH, "evaluations": 300}})
    assert again == asked.replace("400", "300")
    assert edited(again, {"do": "optimize", "section": {}}).rstrip() == text.rstrip()
    with refused("studio.braces"):
        edited('{"format": 1}', {"do": "optimize", "section": WISH})


@pytest.mark.parametrize(
    ("action", "code", "values"),
    [
        (
            {"do": "load", "link": "rocker", "at": "B", "force": "250 N, 180 deg", "angle": 0},
            "unknown-unit",
            {"text": "N, 180 deg"},
        ),
        (
            {"do": "load", "link": "rocker", "at": "B", "force": "10 kg", "angle": 0},
            "wrong-dimension",
            {"text": "10 kg"},
        ),
        (
            {"do": "load", "link": "coupler", "at": "O2", "force": "10 N", "angle": 0},
            "studio.no_point_on",
            {"name": "O2", "link": "coupler"},
        ),
        ({"do": "mass", "link": "rocker", "mass": "2"}, "missing-unit", {"text": "2"}),
        ({"do": "mass", "link": "rocker", "mass": "-2 kg"}, "studio.negative_mass", {"text": "-2 kg"}),
        ({"do": "gear", "links": ["crank", "rocker"], "teeth": "²:3"}, "studio.no_teeth", {"text": "²:3"}),
        ({"do": "remove", "what": "load", "name": "x"}, "studio.no_load", {"name": "x"}),
        ({"do": "mass", "link": 3}, "studio.bad_value", {"name": "link"}),
    ],
)
def test_values_are_checked_before_they_are_written(
    action: dict[str, Any], code: str, values: dict[str, str]
) -> None:
    with refused(code, **values):
        edited(FOURBAR, action)
