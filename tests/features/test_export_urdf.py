"""URDF robots: read a second way they close and move as the machine; what mimics; the file of loops."""

import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yaml
from tests import store
from tests.importers.urdf_positions import UrdfPositions

import linkwright as lw
from linkwright.errors import LinkwrightError

STEPS = 24


def exported(name: str, folder: Path, **options: object) -> Path:
    return lw.export(store.machine(name), folder / f"{name}.urdf", steps=STEPS, **options)


def mimics(path: Path) -> dict[str, tuple[str, float]]:
    found = {}
    for joint in ET.parse(path).getroot().iter("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            found[joint.get("name")] = mimic.get("joint"), float(mimic.get("multiplier"))
    return found


ROTATING = [pytest.param(each, marks=pytest.mark.rotating) for each in ("shaper_quick_return", "parallelogram")]


@pytest.mark.parametrize("name", ["crank_rocker", "scotch_yoke", *ROTATING])
def test_matrices_along_the_tree_give_the_same_points(name: str, tmp_path: Path) -> None:
    robot = UrdfPositions(exported(name, tmp_path))
    motion = lw.solve_motion(store.machine(name), steps=STEPS)
    driver = next(iter(robot.beside["drivers"]))["joint"]
    moved = motion.inputs["driver"] - motion.inputs["driver"][0]
    up = 2 if any(motion.mechanism.gravity) else 1
    for row, poses in enumerate(robot.closed({}, [{driver: float(each)} for each in moved])):
        for link, points in ((each.name, each.points) for each in motion.mechanism.links.values()):
            for point in points:
                if f"{link}.{point}" in poses:
                    place = poses[f"{link}.{point}"][[0, up], 3]
                    assert place == pytest.approx(motion.point(f"{link}.{point}").position[row], abs=1e-9)


def test_gears_racks_and_parallelograms_mimic(tmp_path: Path) -> None:
    assert mimics(exported("parallelogram", tmp_path)) == {"A": ("O1", -1.0), "O2": ("O1", 1.0)}
    teeth = store.machine("external_gear_pair").joints["mesh"].transmission
    assert [each[1] for each in mimics(exported("external_gear_pair", tmp_path)).values()] == [teeth]
    racks = mimics(exported("rack_and_rocker", tmp_path))
    assert racks == {"slide": ("O2", pytest.approx(store.machine("rack_and_rocker").joints["mesh"].radius))}
    assert not mimics(exported("crank_rocker", tmp_path))


def test_mujoco_takes_mimics_as_couplings(tmp_path: Path) -> None:
    text = exported("external_gear_pair", tmp_path).read_text()
    model = mujoco.MjModel.from_xml_string(text)
    assert model.neq == 1 and model.eq_data[0][1] == store.machine("external_gear_pair").joints["mesh"].transmission


def test_the_file_beside_names_ends_that_meet(tmp_path: Path) -> None:
    path = exported("jaw_crusher_sixbar", tmp_path, loop_joints=True)
    written = yaml.safe_load(path.with_name("jaw_crusher_sixbar.loops.yaml").read_text())
    robot = UrdfPositions(path)
    assert np.abs(robot.gaps(dict.fromkeys(robot.free, 0.0))).max() < 1e-12
    elements = ET.parse(path).getroot().findall("loop_joint")
    assert len(elements) == len(written["loops"]) == 2 and written["mimic"] == "implied"
    for element, loop in zip(elements, written["loops"], strict=True):
        for key in ("link1", "link2"):
            assert [float(each) for each in element.find(key).get("xyz").split()] == loop[key]["xyz"]


def test_gravity_points_down_and_masses_stay(tmp_path: Path) -> None:
    machine = store.machine("rack_and_rocker")
    root = ET.parse(exported("rack_and_rocker", tmp_path)).getroot()
    assert root.find("link").get("name") == "world" and machine.gravity == (0, -9.81)
    masses = {each.get("name"): each.find("inertial/mass") for each in root.iter("link")}
    assert {key: float(each.get("value")) for key, each in masses.items() if each is not None} == {
        name: link.mass for name, link in machine.links.items() if link.mass
    }


def test_no_file_is_replaced_unasked(tmp_path: Path) -> None:
    (tmp_path / "crank_rocker.loops.yaml").write_text("mine")
    with pytest.raises(LinkwrightError):
        exported("crank_rocker", tmp_path)
    assert not (tmp_path / "crank_rocker.urdf").exists()
    exported("crank_rocker", tmp_path, force=True)
    assert (tmp_path / "crank_rocker.loops.yaml").read_text() != "mine"
