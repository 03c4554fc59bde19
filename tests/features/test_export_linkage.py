"""Machines written as files of Linkage and read back: the same positions over the cycle; what it cannot hold."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.cli.commands import run

import linkwright as lw

#: Gallery models that Linkage cannot hold, each with the code of the reason.
REFUSED = {
    "double_slider": "export.linkage_driver",
    "dyad_prp": "export.linkage_driver",
    "elliptic_trammel": "export.linkage_driver",
    "excavator": "export.linkage_actuator",
    "five_bar_robot": "export.linkage_driver",
    "gear_differential": "export.linkage_driver",
    "pantograph": "export.linkage_driver",
    "pinion_between_racks": "export.linkage_joint",
    "planetary_two_inputs": "export.linkage_driver",
    "printing_press": "export.linkage_joint",
    "rack_and_rocker": "export.linkage_joint",
    "robot_arm": "export.linkage_driver",
    "stephenson_sixbar_triad": "export.linkage_driver",
    "truss": "export.linkage_no_driver",
    "two_bars_equilibrium": "export.linkage_no_driver",
    "wedge": "export.linkage_driver",
}
HELD = [name for name in store.names() if name not in REFUSED]
#: A slot in a moving link, a block that must not turn, a block in two slots, gears, a chain.
ALWAYS = ["whitworth", "scotch_yoke", "oldham_coupling", "geared_fivebar_double", "chain_drive", "tangent_mechanism"]


def off(name: str, folder: Path) -> float:
    """The largest distance of a point of the machine that was read back from that of the machine, m."""
    motion = store.motion(name, 24)
    path = lw.export(motion, folder / f"{name}.linkage2")
    again = lw.loads(lw.read_foreign(path).text.replace("cycle: rock\n", ""))  # which begins at the end of the range
    reached, start = motion.ok, motion.time[motion.ok][0]
    found = lw.solve_motion(again, times=motion.time[reached] - start)
    points = {point for link in motion.mechanism.links.values() for point in link.points}
    return max(
        float(np.abs(found.point(each).position - motion.point(each).position[reached]).max()) for each in points
    )


@pytest.mark.parametrize("name", ALWAYS)
def test_reads_back_as_it_moves(name: str, tmp_path: Path) -> None:
    assert off(name, tmp_path) <= 1e-9


@pytest.mark.rotating
@pytest.mark.parametrize("name", [each for each in HELD if each not in ALWAYS])
def test_every_machine_reads_back_as_it_moves(name: str, tmp_path: Path) -> None:
    assert off(name, tmp_path) <= 1e-9


@pytest.mark.parametrize("name", REFUSED)
def test_says_what_it_cannot_hold(name: str, tmp_path: Path) -> None:
    with pytest.raises(lw.LinkwrightError) as failure:
        lw.export(store.motion(name, 24), tmp_path / "x.linkage2")
    assert failure.value.code == REFUSED[name]


def test_inputs_are_clockwise_and_lengths_exact(tmp_path: Path) -> None:
    text = lw.export(store.machine("crank_rocker"), tmp_path / "x.linkage2", steps=8).read_text()
    speed = store.machine("crank_rocker").drivers["driver"].law.constant_speed
    assert float(re.search(r'rpm="([^"]+)"', text)[1]) == pytest.approx(-speed * 30 / np.pi, rel=1e-15)
    assert 'units="Millimeters"' in text and 'name="crank"' in text and "slider" not in text


def test_a_cylinder_that_runs_to_and_fro(tmp_path: Path) -> None:
    machine = lw.loads("""format: 1
name: Lift
frame: {points: {O: [0 mm, 0 mm], U: [300 mm, -50 mm]}}
links: {arm: {points: [O, K, H], colour: red}}
drawing: {K: [200 mm, 250 mm], H: [400 mm, 480 mm]}
driver:
  between: [frame.U, arm.K]
  table: {time: [0 s, 3 s, 6 s], position: [320 mm, 260 mm, 320 mm], interpolation: linear}
cycle: {duration: 6 s}
""")
    motion = lw.solve_motion(machine, steps=12)
    found = lw.read_foreign(lw.export(motion, tmp_path / "lift.linkage2"))
    again = lw.solve_motion(found.mechanism, times=motion.time)
    assert again.point("H").position == pytest.approx(motion.point("H").position, abs=1e-12)
    assert found.mechanism.links["arm"].colour == "#a8503f"


def test_a_cylinder_at_rest_is_a_link(tmp_path: Path) -> None:
    machine = lw.loads("""format: 1
name: Lift and crank
frame: {points: {O: [0 mm, 0 mm], U: [300 mm, -50 mm], V: [-90 mm, 0 mm]}}
links: {arm: {points: [O, K, H]}, crank: {points: [V, W]}}
drawing: {K: [200 mm, 250 mm], H: [400 mm, 480 mm], W: [-90 mm, 40 mm]}
drivers:
  motor: {turn: crank, about: V, speed: 30 rpm}
  jack: {between: [frame.U, arm.K], speed: 0 mm/s, start: 320 mm}
""")
    motion = lw.solve_motion(machine, steps=8)
    found = lw.read_foreign(lw.export(motion, tmp_path / "rest.linkage2"))
    again = lw.solve_motion(lw.loads(found.text), times=motion.time)
    assert again.point("W").position == pytest.approx(motion.point("W").position, abs=1e-12)
    assert again.mechanism.frame.points["H"] == pytest.approx(motion.point("H").position[0], abs=1e-12)


def test_the_command_says_what_is_left_out(tmp_path: Path) -> None:
    said = run("export", "gallery:whitworth", "--to", str(tmp_path / "x.linkage2"), "--steps", "8")
    assert said.code == 0 and "Masses, loads" in said.out
    data = json.loads(run("export", "gallery:parallelogram", "--to", str(tmp_path / "y.linkage2"), "--json").out)
    assert any("cycle" in each for each in data["left_out"])
    told = run("export", "gallery:internal_gear_pair", "--to", str(tmp_path / "z.linkage2"), "--steps", "8").out
    assert "mesh turns as in the machine" in told
