"""Linkage files written by hand: positions over the motion against a second reading, drivers, names, findings."""

import math
from pathlib import Path

import numpy as np
import pytest
from tests.importers.linkage_by_hand import by_hand

import linkwright as lw

FOLDER = Path(__file__).with_name("linkage")
FILES = sorted(each.stem for each in FOLDER.glob("*.linkage2"))
#: These run in every run, the others on one day of seven each.
ALWAYS = ("gears_on_an_arm", "inverted_slider_crank", "two_pins_on_one_guide")
#: The file has six decimals of 1/96 inch, 1.3e-10 m; eight bars in a row make it ten times as much.
TOLERANCES = {"jansen_leg": 3e-9}
NAMES = [pytest.param(each, marks=() if each in ALWAYS else pytest.mark.rotating) for each in FILES]


def read(name: str) -> lw.Foreign:
    """A file of these, read."""
    return lw.read_foreign(FOLDER / f"{name}.linkage2")


@pytest.mark.parametrize("name", NAMES)
def test_positions_against_a_second_reading(name: str) -> None:
    found, expected = read(name), by_hand((FOLDER / f"{name}.linkage2").read_text())
    assert found.ok and found.format == "linkage", [str(each) for each in found.findings]
    whole = expected.period or max(math.tau / abs(each) for each in expected.rates)
    times = list(np.linspace(0.0, whole, 8)[:-1])
    motion = lw.solve_motion(found.mechanism, times=times)
    assert motion.complete
    moving = {number: each for number, each in expected.connectors.items() if each.on != "frame"}
    places = expected.machine.positions(
        times, {number: (each.on, each.place) for number, each in moving.items()}, steps=4
    )
    keys = list(motion.point_names())
    for number, place in places.items():
        near = [each for each in keys if np.allclose(motion.point(each).position[0], place[0], atol=1e-9)]
        assert near, f"no point is where connector {number} is at the start"
        wrong = min(np.abs(motion.point(each).position - place).max() for each in near)
        assert wrong < TOLERANCES.get(name, 1e-9), f"connector {number} is {wrong:.3g} m off"
    assert len(places) >= 1


def test_the_other_side_of_an_arc_has_the_other_sign() -> None:
    text = (FOLDER / "curved_slot.linkage2").read_text()
    for radius in ('slideradius="250"', 'slideradius="-250"'):
        assert lw.read_foreign(text.replace('slideradius="250"', radius)).mechanism.frame.points["centre_C"] == (
            pytest.approx((200 * 0.0254 / 96, 0.0), abs=1e-8)
        )


def test_names_colours_and_sense() -> None:
    found = read("four_bar")
    mechanism = found.mechanism
    assert set(mechanism.frame.points) == {"O", "D"}  # a name of its own, and the letter of the fourth
    assert mechanism.links["crank"].colour == "#aa3300" and found.traced == ("link_12.coupler_point",)
    assert "speed: -15 rpm" in found.text  # a positive rpm is clockwise
    assert "speed: 30 rpm" in read("slider_between_anchors").text
    inputs = read("two_inputs").mechanism
    assert sorted(each.law.speed * 30 / math.pi for each in inputs.drivers.values()) == pytest.approx([-10.0, 20.0])


def test_units_are_only_shown() -> None:
    inches, millimetres = read("slider_between_anchors"), read("inverted_slider_crank")
    assert " in]" in inches.text and " mm]" in millimetres.text
    assert inches.mechanism.frame.points["D"][0] == pytest.approx(200 * 0.0254 / 96, abs=1e-9)


def test_findings_have_lines() -> None:
    lines = {each.code: each.where for each in read("drawing_and_measurement").findings}
    assert all(where.startswith("drawing_and_measurement.linkage2:") for where in lines.values()) and len(lines) == 3
    (limits,) = [each for each in read("moving_guide").findings if "no ends" in str(each)]
    assert limits.where == "moving_guide.linkage2:6:1" and limits.key == "D"
    (blank,) = read("repeated_ids").findings
    assert blank.where == "repeated_ids.linkage2:2:1" and blank.severity == "note"


def test_what_is_no_file_of_linkage() -> None:
    cut = (FOLDER / "four_bar.linkage2").read_text()[:-30]
    broken = lw.read_foreign(cut, format="linkage")
    assert not broken.ok and [each.code for each in broken.findings] == ["import.xml"]
    declared = lw.read_foreign("<!DOCTYPE linkage2 [<!ENTITY a 'b'>]>\n<linkage2/>", format="linkage")
    assert not declared.ok
