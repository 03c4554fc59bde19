"""The page of a worked solution: order, languages, data, refusals."""

from __future__ import annotations

import json
import math
import re

import pytest
from tests import store
from tests.cli.commands import is_refused
from tests.every import every
from tests.refusals import refused
from tests.worked_reading import against_solver, reckon_lines

import linkwright as lw
from linkwright.cli import main
from linkwright.errors import RequestError

CONVEYOR = "gallery:swing_conveyor"


@pytest.fixture(scope="module")
def conveyor() -> lw.Forces:
    return lw.solve_forces(
        lw.solve_motion(store.machine("swing_conveyor"), at=[math.radians(40.0), math.radians(300.0)])
    )


def test_groups_come_in_solving_order_and_forces_in_reverse(conveyor: lw.Forces) -> None:
    groups = [step.group for step in lw.worked(conveyor).steps if "." not in step.number and step.group]
    solving = [group.name for group in conveyor.motion.structure.groups]
    assert groups == [*solving, *reversed(solving)]


def test_motion_alone_has_no_forces(conveyor: lw.Forces) -> None:
    symbols = {line.symbol for line in lw.worked(conveyor.motion).equations}
    assert "a_Fx" in symbols
    assert not any(name.startswith("F_") for name in symbols)


def test_static_forces_have_no_inertia(conveyor: lw.Forces) -> None:
    still = lw.solve_forces(conveyor.motion, static=True)
    lines = {line.symbol: line for line in lw.worked(still).equations}
    assert lines["K_4y"].formula == "m4·g_y"
    assert "M_J4" not in lines


def test_an_input_can_be_named_instead_of_a_position(conveyor: lw.Forces) -> None:
    named, counted = lw.worked(conveyor, at=math.radians(300.0)), lw.worked(conveyor, 1)
    assert named.text() == counted.text()


def test_both_languages_say_the_same_equations(conveyor: lw.Forces) -> None:
    english, chinese = (lw.worked(conveyor, 1, language=language) for language in ("en", "zh"))
    assert [line.result for line in english.equations] == [line.result for line in chinese.equations]
    titles = zip((step.title for step in english.steps), (step.title for step in chinese.steps), strict=True)
    assert not [one for one, other in titles if one == other and one.isascii()]


@pytest.mark.rotating
@pytest.mark.parametrize("name", [name for name in lw.gallery_names() if name != "printing_press"])
def test_every_page_keeps_its_width_and_its_braces(name: str) -> None:
    motion = lw.solve_motion(store.machine(name), steps=4, failures="mark")
    good, forces = int(motion.ok.argmax()), lw.solve_forces(motion)
    for language in ("en", "zh"):
        page = lw.worked(forces, good, language=language)
        assert max(len(line) for line in page.text().splitlines()) <= 104
    for line in every(page.equations):  # the same in both languages
        for text in (line.latex_symbol, line.latex_formula, line.latex_numbers):
            assert text.count("{") == text.count("}"), text


def test_data_is_plain(conveyor: lw.Forces) -> None:
    data = lw.worked(conveyor).data()
    assert json.loads(json.dumps(data)) == data


def test_a_position_that_does_not_exist_is_refused(conveyor: lw.Forces) -> None:
    with refused("worked.no_position", RequestError, position=7, steps=2, last=1):
        lw.worked(conveyor, 7)
    with refused("names.no_language", language="de", languages=("en", "zh")):
        lw.worked(conveyor, language="de")


def test_a_position_out_of_reach_is_refused() -> None:
    text = """
format: 1
name: short coupler
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 1 m}
  rocker: {points: [O2, B], length: 3 m}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""
    motion = lw.solve_motion(lw.loads(text), at=[0.0, math.pi], failures="mark")
    assert motion.ok.tolist() == [True, False]
    with refused("worked.not_reached", position=1, links=("coupler", "rocker")):
        lw.worked(motion, 1)


def test_the_command_prints_every_named_position(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", CONVEYOR, "--worked", "--at", "0 deg, 120 deg"]) == 0
    out = capsys.readouterr().out
    assert re.findall(r"^ +q +=.* (\S+)$", out, re.M) == ["0°", "120°"]
    assert main(["solve", CONVEYOR, "--worked", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["worked"]) == 1


def test_worked_and_output_exclude_each_other() -> None:
    refused = is_refused(["solve", CONVEYOR, "--worked", "--output", "x.csv"], "cli.not_together")
    assert {refused.values["name"], refused.values["other"]} == {"--worked", "--output"}


LOADED = """
format: 1
name: loaded slider-crank
frame: {points: {O: [0 m, 0 m], S: [-0.2 m, 0.3 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 2 kg}
  rod: {points: [A, B], length: 0.4 m, mass: 3 kg, inertia: 0.04 kg·m²}
  piston: {points: [B], mass: 5 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B, friction: 0.05}
  A: {kind: revolute, pin_radius: 10 mm, friction: 0.1}
driver: {turn: crank, about: O, speed: 20 rad/s}
gravity: [0, -9.81 m/s²]
loads:
  coil: {kind: spring, between: [frame.S, crank.A], stiffness: 2 kN/m, free_length: 0.1 m, preload: 30 N}
  dash: {kind: damper, between: [frame.S, rod.A], damping: 40 N·s/m}
  twist: {kind: torsion_spring, links: [crank, rod], stiffness: 5 N·m/rad, free_angle: 10 deg, preload: 1 N·m}
  drag: {kind: torsion_damper, links: [crank, rod], damping: 0.3 N·m·s/rad}
  gas: {kind: pressure, joint: guide, bore: 80 mm, magnitude: 3 bar, pushes: backward}
  lift: {kind: torque, on: rod, magnitude: 7 N·m}
"""


def test_every_kind_of_load_is_put_in() -> None:
    forces = lw.solve_forces(lw.solve_motion(lw.loads(LOADED), at=[0.7]))
    page = lw.worked(forces)
    assert reckon_lines(page) == []
    assert against_solver(page, forces)[0] == []
    lines = {line.symbol: line for line in page.equations}
    assert float(lines["p_gas"].result) == pytest.approx(3e5)
    assert float(lines["F_gas"].result) == pytest.approx(3e5 * math.pi * 0.08**2 / 4, rel=1e-5)
    reach = math.hypot(0.1 * math.cos(0.7) + 0.2, 0.1 * math.sin(0.7) - 0.3)
    assert float(lines["T_coil"].result) == pytest.approx(30 + 2000 * (reach - 0.1), rel=1e-5)
    friction = 0.1 * 0.01 * float(lines["F_A,2"].result)
    assert abs(float(lines["M_fA2"].result)) == pytest.approx(friction, rel=1e-5)
    assert float(lines["M_lift"].result) == 7.0
    lean = math.asin(0.25 * math.sin(0.7))  # of the rod; its rate from 0.1 cos θ ω = -0.4 cos(lean) ω_rod
    slip = -20 * 0.25 * math.cos(0.7) / math.cos(lean) - 20
    assert lines["M_drag"].formula == "c_drag·(ω2 - ω1)"
    assert float(lines["M_drag"].result) == pytest.approx(0.3 * slip, rel=1e-5)


@pytest.mark.parametrize("name", ["double_slider", "wedge", "stephenson_sixbar_triad"])
def test_a_driver_at_rest_gives_the_balance_of_powers_instead_of_an_effort(name: str) -> None:
    forces = store.forces(name, 8)
    still = min(range(8), key=lambda i: abs(forces.motion.positions.coordinates["driver"][1][i]))
    page = lw.worked(forces, still)
    assert reckon_lines(page) == []
    assert page.equations[-1].symbol == "ΔP"
    assert page.equations[-1].result == "0"


def test_what_is_printed_as_zero_is_put_in_as_zero() -> None:
    """A force of some 1e-12 N beside 1667 N, and an angle of some 1e-12° after eleven turns."""
    forces = store.forces("planetary_two_inputs", 24)
    for index in (4, 11):
        page = lw.worked(forces, index)
        assert not any(re.search(r"e-1\d", line) for line in page.text().splitlines())
        assert reckon_lines(page) == [] and against_solver(page, forces)[0] == []
