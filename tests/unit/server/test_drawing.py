"""Loads, masses and what is removed, as the studio writes them: read back by the package, and computed by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import yaml
from tests import store
from tests.refusals import refused
from tests.ui.texts import FOURBAR

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.files.model_file import read_text
from linkwright.server.draft import picture
from linkwright.server.edits import edited
from linkwright.words.message import code_of, values_of

#: Codes of findings about names that are not there, and texts that are no YAML.
GONE = ("unknown-name", "duplicate", "yaml")
#: Of a point that gives a link its length, or that something else needs, and of one that no drawing has.
REFUSED = {"studio.end_of_link", "studio.point_of"}
REMOVED = ("chain_drive", "dyad_rpr", "geneva_wheel", "pinion_between_racks", "toggle_press")


def after(text: str, **action: Any) -> str:
    """The text after an action."""
    return edited(text, [action]).text


def told(text: str, **action: Any) -> tuple[str, dict[str, Any]]:
    """What the user is told about an action: the key of the sentence and its values."""
    note = edited(text, [action]).notes[0]
    return code_of(note), values_of(note)


@pytest.mark.parametrize(("link", "angle"), [("coupler", 180.0), ("rocker", 30.0), ("coupler", -45.0)])
def test_a_force_acts_on_the_link_in_the_direction_asked_for(link: str, angle: float) -> None:
    """The drive's torque times its speed is minus the power of the force, F · v of the point (virtual work)."""
    load = {"do": "load", "link": link, "at": "B", "force": "250 N", "angle": angle}
    mechanism = lw.loads(after(FOURBAR, **load))
    (force,) = mechanism.loads.values()
    assert (force.on, force.at) == (link, "B")
    motion = lw.solve_motion(mechanism, steps=24)
    way = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    power = motion.point("B").velocity @ way * 250
    assert lw.solve_forces(motion).input_torque * 2 * math.pi == pytest.approx(-power, abs=1e-9)
    shown = picture(after(FOURBAR, **load))["loads"]["load1"]
    assert [shown[key] for key in ("kind", "on", "at", "ends", "size")] == ["force", link, "B", [], "250 N"]
    assert (shown["angle"], shown["magnitude"]) == (pytest.approx(math.radians(angle)), 250.0)
    key, values = told(FOURBAR, **load)
    assert (key, values["force"], values["link"], values["at"]) == ("studio.load_put", "250 N", link, "B")


def test_loads_of_all_kinds_are_shown_and_can_be_removed() -> None:
    loads = """loads:
  weight: {kind: force, on: rocker, at: B, components: [3 N, -4 N]}
  turned: {kind: force, on: rocker, at: B, in_link: 10 deg, ramp: [0 N, 5 N]}
  couple: {kind: torque, on: rocker, magnitude: 5 N·m}
  pull: {kind: spring, between: [frame.O2, coupler.A], stiffness: 1 N/mm, free_length: 10 mm}
"""
    shown = picture(FOURBAR + loads)["loads"]
    assert [each["kind"] for each in shown.values()] == ["force", "force", "torque", "spring"]
    assert shown["weight"]["angle"] == pytest.approx(math.atan2(-4, 3))
    assert shown["weight"]["size"] == "3 N, -4 N"
    assert shown["turned"]["angle"] is None
    assert shown["pull"]["ends"] == ["O2", "A"]
    text = FOURBAR + loads
    for name in shown:
        text = after(text, do="remove", what="load", name=name)
    assert text.rstrip() == FOURBAR.rstrip()


def test_a_mass_brings_the_inertia_of_an_even_bar() -> None:
    """m l²/12 about the middle, where the format has the mass centre; an inertia of the user's own stays."""
    text = after(FOURBAR, do="mass", link="rocker", mass="2 kg")
    rocker = lw.loads(text).link("rocker")
    length = math.dist((160e-3, 120e-3), (200e-3, 0.0))
    assert (rocker.mass, rocker.inertia) == (2.0, pytest.approx(2 * length**2 / 12, rel=1e-3))
    assert rocker.centre == pytest.approx((length / 2, 0.0))
    assert "# of steel" in text
    key, values = told(FOURBAR, do="mass", link="rocker", mass="2 kg")
    assert (key, values["length"]) == ("studio.bar_inertia", f"{1e3 * length:.4g} mm")
    assert lw.loads(after(text, do="mass", link="rocker", mass="500 g")).link("rocker").inertia == pytest.approx(
        length**2 / 24, rel=1e-3
    )
    own = text.replace(text.split("inertia: ")[1].split("}")[0], "0.5 kg·m²")
    heavier = lw.loads(after(own, do="mass", link="rocker", mass="3 kg")).link("rocker")
    assert (heavier.mass, heavier.inertia) == (3.0, 0.5)
    assert told(own, do="mass", link="rocker", mass="3 kg")[0] == "studio.inertia_stays"
    lengths = FOURBAR.replace("coupler: {points: [A, B]", "coupler: {points: [A, B], length: 3.5 m")
    lengths = lengths.replace("drawing:", "# drawing:")
    placed = {"A": [0.0, 0.0], "B": [3.5, 0.0]}
    heavy = after(lengths, do="mass", link="coupler", mass="12 kg", places=placed)
    assert "coupler: {points: [A, B], length: 3.5 m, mass: 12 kg, inertia: 12.25 kg·m²}" in heavy


def test_a_pin_that_is_removed_leaves_its_links_apart() -> None:
    """The links stay with their loads, each with a point of its own there; what was about the pin goes."""
    text = FOURBAR + "assembly: {B: left}\njoints: {B: {kind: revolute, pin_radius: 5 mm, friction: 0.1}}\n"
    text += "loads:\n  push: {kind: force, on: rocker, at: B, normal_to: [B, O2], magnitude: 5 N}\n"
    apart = after(text, do="remove", what="joint", name="B")
    tree = yaml.safe_load(apart)
    assert tree["links"] == {
        "crank": {"points": ["O1", "A"]},
        "coupler": {"points": ["A", "B"]},
        "rocker": {"points": ["P1", "O2"]},
    }
    assert tree["drawing"] == {"A": ["30 mm", "40 mm"], "B": ["160 mm", "120 mm"], "P1": ["160 mm", "120 mm"]}
    assert "push: {kind: force, on: rocker, at: P1, normal_to: [P1, O2], magnitude: 5 N}" in apart
    assert not {"joints", "assembly"} & set(tree)
    assert "# on the base" in apart and "# of steel" in apart
    key, values = told(text, do="remove", what="joint", name="B")
    assert (key, values["point"], values["links"]) == ("studio.pin_gone", "B", ("coupler", "rocker"))
    joined = apart.replace(", P1: [160 mm, 120 mm]", "").replace("P1", "B")
    whole = after(joined, do="remove", what="load", name="push")
    assert lw.loads(whole).dimensions() == lw.loads(FOURBAR).dimensions()


def test_a_pivot_that_is_removed_frees_its_link_and_takes_its_drive_along() -> None:
    free = after(FOURBAR, do="remove", what="joint", name="O1")
    tree = yaml.safe_load(free)
    assert tree["links"]["crank"] == {"points": ["P1", "A"]}
    assert "driver" not in tree
    key, values = told(FOURBAR, do="remove", what="joint", name="O1")
    assert key == "studio.both"
    assert [code_of(values[each]) for each in ("first", "second")] == ["studio.pin_gone", "studio.drive_gone"]
    gone = yaml.safe_load(after(free, do="remove", what="joint", name="O1"))
    assert list(gone["frame"]["points"]) == ["O2"]


def test_a_point_that_joins_nothing_goes_out_of_its_link_alone() -> None:
    text = FOURBAR.replace("[A, B]}", "[A, B, C]}").replace("drawing: {", "drawing: {C: [90 mm, 150 mm], ")
    text = after(text, do="load", link="coupler", at="C", force="5 N", angle=0.0)
    assert after(text, do="remove", what="joint", name="C").rstrip() == FOURBAR.rstrip()
    loose = after(FOURBAR, do="remove", what="link", name="rocker")
    with refused("studio.end_of_link", point="B", link="coupler"):
        after(loose, do="remove", what="joint", name="B")


def test_a_block_goes_with_its_guide_and_the_guide_s_point() -> None:
    text = after(FOURBAR, do="remove", what="link", name="rocker")
    slid = after(text, do="link", name="slider1", points=["B"])
    slid = after(slid, do="guide", link="slider1", at="B", angle=0.0)
    assert lw.structure(lw.loads(slid)).mobility == 1
    assert after(slid, do="remove", what="joint", name="B").rstrip() == text.rstrip()


@pytest.mark.rotating
@pytest.mark.parametrize("name", REMOVED)
def test_whatever_is_removed_leaves_no_name_behind(name: str) -> None:
    """Of every link, point and load of models of the gallery: the text names nothing that is gone."""
    text = store.text(name)
    shown = picture(text)
    points = dict.fromkeys([*shown["fixed"], *(point for ends in shown["links"].values() for point in ends)])
    parts = {"link": list(shown["links"]), "joint": list(points), "load": list(shown["loads"])}
    removed, refusals = 0, set[str]()
    for what, names in parts.items():
        for each in names:
            try:
                found = after(text, do="remove", what=what, name=each)
            except LinkwrightError as error:
                refusals.add(error.code)
                continue
            removed += 1
            left = [str(finding) for finding in read_text(found, name)[1] if finding.code in GONE]
            assert left == [], (what, each)
    assert refusals <= REFUSED
    assert removed >= 0.5 * sum(map(len, parts.values()))


def test_new_points_come_with_the_link_that_has_them() -> None:
    """One action, so one step back: points and link together."""
    bar = {"do": "link", "name": "bar1", "points": ["B", "C"], "places": {"C": [0.1, 0.2]}}
    assert yaml.safe_load(after(FOURBAR, **bar))["drawing"]["C"] == ["100 mm", "200 mm"]


def test_drawing_keeps_a_byte_order_mark_out_of_the_way() -> None:
    text = "\ufeff" + FOURBAR
    assert after(text, do="remove", what="link", name="rocker") == after(
        FOURBAR, do="remove", what="link", name="rocker"
    )
