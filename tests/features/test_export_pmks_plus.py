"""Machines written as share links of PMKS+ and read back: the same positions over the cycle; what it cannot hold."""

from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.cli.commands import shown
from tests.importers.share_by_hand import by_hand, stamped

import linkwright as lw

#: Gallery models that PMKS+ cannot hold, each with the code of the reason.
REFUSED = {
    "chain_drive": "export.pmks_joint",
    "double_slider": "export.pmks_driver",
    "dyad_prp": "export.pmks_drivers",
    "dyad_rrr": "export.pmks_drivers",
    "excavator": "export.pmks_drivers",
    "external_gear_pair": "export.pmks_joint",
    "five_bar_robot": "export.pmks_drivers",
    "gear_differential": "export.pmks_joint",
    "geared_fivebar": "export.pmks_joint",
    "geared_fivebar_double": "export.pmks_joint",
    "geared_fivebar_third": "export.pmks_joint",
    "internal_gear_pair": "export.pmks_joint",
    "pantograph": "export.pmks_drivers",
    "pinion_between_racks": "export.pmks_joint",
    "planetary_two_inputs": "export.pmks_joint",
    "printing_press": "export.pmks_joint",
    "rack_and_rocker": "export.pmks_joint",
    "robot_arm": "export.pmks_drivers",
    "stephenson_sixbar_triad": "export.pmks_driver",
    "truss": "export.pmks_no_driver",
    "two_bars_equilibrium": "export.pmks_no_driver",
    "wedge": "export.pmks_driver",
}
#: One for each reason runs in every run.
ONE_EACH = ("chain_drive", "dyad_prp", "truss", "wedge")
HELD = [name for name in store.names() if name not in REFUSED]
#: A slot in a moving link, welded blocks, a block in two slots.
ALWAYS = ["whitworth", "scotch_yoke", "oldham_coupling"]


def off(name: str, folder: Path) -> float:
    """The largest distance of a point of the machine that was read back from that of the machine, m."""
    motion = store.motion(name, 24)
    found = lw.read_foreign(lw.export(motion, folder / f"{name}.pmksplus"))
    again, reached = lw.loads(found.text.replace("cycle: rock\n", "")), motion.ok
    times = motion.time[reached] - motion.time[reached][0]
    law = next(iter(motion.mechanism.drivers.values())).law
    if law.constant_speed is None:  # it rocks gently: the times at which constant speed is at its coordinates
        times = (motion.input[reached] - motion.input[reached][0]) / law.own.constant_speed
    solved = lw.solve_motion(again, times=times)
    points = {point for link in motion.mechanism.links.values() for point in link.points}
    return max(
        float(np.abs(solved.point(each).position - motion.point(each).position[reached]).max()) for each in points
    )


@pytest.mark.parametrize("name", ALWAYS)
def test_reads_back_as_it_moves(name: str, tmp_path: Path) -> None:
    assert off(name, tmp_path) <= 1e-9


@pytest.mark.rotating
@pytest.mark.parametrize("name", [each for each in HELD if each not in ALWAYS])
def test_every_machine_reads_back_as_it_moves(name: str, tmp_path: Path) -> None:
    assert off(name, tmp_path) <= 1e-9


@pytest.mark.parametrize(
    "name", [each if each in ONE_EACH else pytest.param(each, marks=pytest.mark.rotating) for each in REFUSED]
)
def test_says_what_it_cannot_hold(name: str, tmp_path: Path) -> None:
    with pytest.raises(lw.LinkwrightError) as failure:
        lw.export(store.motion(name, 24), tmp_path / "x.pmksplus")
    assert failure.value.code == REFUSED[name]


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["crank_rocker", "scotch_yoke", "tangent_mechanism"])
def test_a_second_reading_of_the_link_moves_alike(name: str, tmp_path: Path) -> None:
    motion = store.motion(name, 24)
    link = lw.export(motion, tmp_path / "x.pmksplus").read_text().strip()
    body = link.partition("?")[2].partition("*")[0][:-1]
    assert stamped(body, digest=True) == link  # check character and digest
    records = [each.split(",") for each in body.split("..")[0].split(".")[4:]]
    expected, names = by_hand(link), {each[1]: each[0][1:] for each in records}
    driver = next(iter(motion.mechanism.drivers.values()))
    assert expected.rates == pytest.approx([driver.law.constant_speed], rel=1e-12)
    points = {point for link in motion.mechanism.links.values() for point in link.points if point in names}
    moving = {point: names[point] for point in points if expected.body_at[names[point]] != "frame"}
    asked = {point: (expected.body_at[each], expected.at[each]) for point, each in moving.items()}
    times = motion.time[:8] - motion.time[0]
    for point, place in expected.machine.positions(list(times), asked, steps=2).items():
        assert motion.point(point).position[:8] == pytest.approx(place, abs=1e-9), point


MACHINE = """format: 1
name: Lever
frame: {points: {O: [0 mm, 0 mm], Q: [60 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 20 mm, colour: "#aa3300"}
  rod: {points: [A, B], length: 55 mm, mass: 0.35 kg, inertia: 2e-5 kg·m²}
  rocker: {points: [Q, B], length: 40 mm, mass: 1.23456789 kg, inertia: 1e-4 kg·m², mass_centre: [12 mm, 3 mm]}
joints: {B: {kind: revolute, pin_radius: 4 mm, friction: 0.1}}
drawing: {A: [0 mm, 20 mm], B: [50 mm, 39 mm]}
driver: {turn: crank, about: O, speed: -33.3333 rpm, start: 90 deg}
gravity: [0, -9.81 m/s²]
loads:
  push: {kind: force, on: rocker, at: B, components: [-3 N, 4 N]}
  pull: {kind: force, on: rod, at: B, in_link: 30 deg, magnitude: 2.5 N}
  drag: {kind: torque, on: rocker, magnitude: 1 N·m}
"""


def test_masses_loads_and_colours_come_back(tmp_path: Path) -> None:
    machine = lw.loads(MACHINE)
    found = lw.read_foreign(lw.export(machine, tmp_path / "x.pmksplus", steps=12)).mechanism
    rocker, forces = found.links["rocker"], found.loads
    assert found.links["crank"].colour == "#aa3300" and found.gravity == (0.0, -9.81)
    assert rocker.mass == pytest.approx(1.23456789, rel=1e-15) and rocker.inertia == pytest.approx(1e-4, rel=1e-12)
    assert rocker.centre == pytest.approx((0.012, 0.003), abs=1e-15)
    assert found.links["rod"].centre == pytest.approx((0.0275, 0.0), abs=1e-15)
    assert forces["push"].components == pytest.approx((-3.0, 4.0), abs=1e-12)
    assert np.degrees(forces["pull"].in_link) == pytest.approx(30.0, abs=1e-9) and "drag" not in forces


def test_tells_what_it_leaves_out(tmp_path: Path) -> None:
    model = tmp_path / "lever.yaml"
    model.write_text(MACHINE, encoding="utf-8")
    said = shown("export", str(model), "--output", str(tmp_path / "lever.pmksplus"), "--steps", "12")
    assert "left out: drag" in said and "Friction" in said and "Gravity" not in said
    again = shown("import", str(tmp_path / "lever.pmksplus"))
    assert "speed: -33.3333 rpm" in again and "link: rod" not in again


def test_names_of_every_script_come_back(tmp_path: Path) -> None:
    machine = lw.loads(MACHINE.replace("crank", "曲柄").replace("rocker", "Schwinge'ä"))
    path = lw.export(machine, tmp_path / "x.pmksplus", steps=12)
    assert path.read_text(encoding="ascii").startswith("https://app.pmksplus.com/?")
    assert list(lw.read_foreign(path).mechanism.links) == ["曲柄", "rod", "Schwinge'ä"]


@pytest.mark.parametrize("seam", ["B", "C"])
def test_welded_links_are_one_link(seam: str, tmp_path: Path) -> None:
    """With the parts of PMKS+ where only they meet at the seam; it would weld a third link there as well."""
    machine = lw.loads(f"""format: 1
name: Bent coupler
frame: {{points: {{O: [0 mm, 0 mm], Q: [60 mm, 0 mm]}}}}
links:
  crank: {{points: [O, A], length: 20 mm}}
  rod: {{points: [A, B, C], mass: 1 kg, inertia: 1e-4 kg·m²}}
  arm: {{points: [{seam}, T], length: 30 mm, mass: 1 kg, inertia: 2e-4 kg·m²}}
  rocker: {{points: [Q, B], length: 40 mm}}
joints: {{seam: {{kind: weld, links: [rod, arm], at: {seam}, angle: 40 deg}}}}
drawing: {{A: [0 mm, 20 mm], B: [50 mm, 39 mm], C: [30 mm, 50 mm]}}
driver: {{turn: crank, about: O, speed: 20 rpm, start: 90 deg}}
""")
    motion = lw.solve_motion(machine, steps=24)
    path = lw.export(motion, tmp_path / "x.pmksplus")
    found = lw.read_foreign(path)
    again = lw.solve_motion(found.mechanism, times=motion.time)
    assert again.point("T").position == pytest.approx(motion.point("T").position, abs=1e-12)
    whole, start = (
        found.mechanism.links["rod"],
        {each: motion.point(each).position[0] for each in ("A", "B", seam, "T")},
    )
    apart = np.hypot(*((start["A"] + start["B"] - start[seam] - start["T"]) / 2))
    assert set(whole.points) == {"A", "B", "C", "T"} and whole.mass == 2.0
    assert whole.inertia == pytest.approx(3e-4 + 2 * (apart / 2) ** 2, rel=1e-12)
    assert (".NR" in path.read_text()) == (seam == "C")
