"""Worked solutions of cams: every line reckoned again, against the solver, and against the cam checked by itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests import store
from tests.reference.cam_models import GUIDED, SPEED, SWINGING, follower, model
from tests.worked_reading import against_solver, reckon_lines

import linkwright as lw

SENSES = ("counterclockwise", "clockwise")
#: One position in each segment of the program but its dwells, degrees of the cam's program, and one in a dwell.
PLACES = (35.0, 140.0, 225.0)


def page_of(forces: lw.Forces, index: int) -> tuple[lw.Worked, dict[str, float]]:
    """The worked position and its numbers; every line comes out, every column is the solver's."""
    page = lw.worked(forces, index)
    assert reckon_lines(page) == []
    wrong, seen = against_solver(page, forces)
    assert wrong == []
    moving = {
        name
        for name, row in forces.motion.columns().items()
        if abs(row[index]) > 1e-9 and not any(word in name for word in ("time", "residual", "shaking"))
    }
    assert moving <= seen
    return page, {line.symbol: line.value for line in page.equations}


def checked(forces: lw.Forces, index: int, cam: lw.Cam, phi: float, turned: float) -> None:
    """Pressure angle, profile and radius of curvature against the cam's own closed forms."""
    _, found = page_of(forces, index)
    contact = cam.walls[0].contact(np.array([phi]))
    place = complex(contact.point[0]) * np.exp(1j * turned)
    assert complex(found["x_n"], found["y_n"]) == pytest.approx(place, abs=1e-9)
    if cam.follower.kind != "flat":
        size = math.radians(abs(found["α"]))
        assert size == pytest.approx(abs(float(contact.pressure_angle[0])), abs=1e-9)
    if contact.curvature[0] and "ρ" in found:
        assert 1.0 / found["ρ"] == pytest.approx(float(contact.curvature[0]), rel=1e-6)


@pytest.mark.parametrize("touch", ["roller", "knife", "flat"])
@pytest.mark.parametrize(("sense", "offset"), [(SENSES[0], 0.006), (SENSES[1], -0.004)])
def test_a_guided_follower_is_worked_out(touch: str, sense: str, offset: float) -> None:
    turn = 1.0 if sense == SENSES[0] else -1.0
    mechanism = lw.loads(model(GUIDED, sense, touch, "18 mm", OFFSET=f"{1e3 * offset} mm"))
    inputs = [turn * math.radians(place) + math.radians(20) for place in PLACES]
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=np.array(inputs)))
    cam = lw.Cam(mechanism.joints["lobe"].program, follower(touch, offset=offset), 0.05, turn)
    for index, place in enumerate(PLACES):
        phi = math.radians(place)
        checked(forces, index, cam, phi, turn * phi - inputs[index])


@pytest.mark.rotating
@pytest.mark.parametrize("touch", ["roller", "knife", "flat"])
@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("sense", SENSES)
def test_an_oscillating_follower_is_worked_out(touch: str, side: str, sense: str) -> None:
    turn, away = (1.0 if sense == SENSES[0] else -1.0), (-1.0 if side == "right" else 1.0)
    text = model(SWINGING, sense, touch, "15 deg", SIDE=side, MOMENT=f"{-3.0 * away} N·m")
    mechanism = lw.loads(text)
    inputs = [turn * math.radians(place) for place in PLACES]
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=np.array(inputs)))
    rides = follower(touch, motion="oscillating", pivot_distance=0.16, arm=0.13, below=side == "left")
    cam = lw.Cam(mechanism.joints["lobe"].program, rides, 0.07, turn)
    for index, place in enumerate(PLACES):
        checked(forces, index, cam, math.radians(place), 0.0)


def test_the_press_cam_is_worked_out_between_the_points_of_its_table() -> None:
    forces = store.forces("printing_press", 7)
    for index in (1, 2, 4):
        page, found = page_of(forces, index)
        assert any("compensating_cam" in step.title for step in page.steps)
        assert found["s_rack_guide"] == pytest.approx(found["d"] + found["S"], abs=1e-12)


def test_two_cams_have_symbols_of_their_own() -> None:
    text = model(GUIDED, SENSES[0], "knife", "18 mm", OFFSET="0 mm")
    lobe = text[text.index("  lobe:") : text.index("driver:")]
    slide = "  slide: {points: {P: [0 mm, 0 mm], Q: [0 mm, 40 mm]}, mass: 0.5 kg, inertia: 0.001 kg·m²}\n"
    guide = next(line for line in text.splitlines(keepends=True) if line.startswith("  guide:"))
    other = guide.replace("guide:", "guide_2:", 1).replace("block: slide, at: P", "block: slide_2, at: R")
    other = other.replace("direction: 90 deg", "direction: -90 deg")
    more = lobe.replace("lobe:", "lobe_2:").replace("follower: slide", "follower: slide_2").replace("at: P", "at: R")
    text = text.replace(lobe, lobe + more).replace(guide, guide + other)
    text = text.replace(slide, slide + slide.replace("slide:", "slide_2:").replace("P:", "R:").replace("Q:", "T:"))
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), at=np.array([1.3])))
    _, found = page_of(forces, 0)
    assert found["S_lobe"] == pytest.approx(found["S_lobe_2"])
    assert found["θ_lobe"] == pytest.approx(found["θ_lobe_2"])
    assert abs(forces.motion.point("P").velocity[0, 1]) > 0.1 * SPEED * 0.01
