"""URDF robots read as model files: positions over a range against matrices along the tree, loops, findings."""

from pathlib import Path

import numpy as np
import pytest
from tests.importers.urdf_positions import UrdfPositions

import linkwright as lw

FILES = Path(__file__).parent / "urdf"
AXES = dict(zip("xyz", np.eye(3), strict=True))
#: Files with their driven joints, where these begin, how far the first goes, and the plane.
CASES = {
    "parallel": (("m",), 0.0, 1.0, "xy"),
    "offset_mimic": (("drive",), 0.0, 6.2, "xy"),
    "rack": (("turn",), 0.0, 2.0, "xz"),
    "parallelogram": (("q",), 0.0, 1.4, "xy"),
    "scissor_gripper": (("finger_joint",), 0.0, 0.7, "yz"),
    "arm": (("shoulder",), 0.0, 1.0, "xz"),
    "four_bar_loop": (("O",), 0.0, 6.2, "xy"),
    "slider_crank": (("O",), 0.0, 6.2, "xy"),
    "coupled": (("s",), 0.0, 6.2, "xy"),
    "press": (("O",), 0.5, 0.6, "xy"),
    "two_free": (("left", "right"), 0.0, 0.9, "xy"),
}


#: These run every day.
CORE = ("parallelogram", "rack", "slider_crank", "coupled")
DAILY = [pytest.param(file, marks=() if file in CORE else pytest.mark.rotating) for file in CASES]


@pytest.mark.parametrize("file", DAILY)
def test_moves_as_matrices_say(file: str) -> None:
    joints, begun, far, axes = CASES[file]
    moved = np.linspace(0, far, 9)
    machine = lw.loads(lw.read_foreign(FILES / f"{file}.urdf", speed=1.0).text)
    motion = lw.solve_motion(machine, times=moved)
    right, up = (AXES[each] for each in axes)
    robot = UrdfPositions(FILES / f"{file}.urdf")
    driven = [dict.fromkeys(joints, begun + float(each)) for each in moved]
    first: dict[str, complex] = {}
    for row, poses in enumerate(robot.closed({}, driven)):
        for name, link in machine.links.items():
            pose = poses[name]
            turned = pose[:3, :3] @ np.linalg.inv(robot.poses(dict.fromkeys(robot.free, 0.0))[name][:3, :3])
            direction = complex(right @ turned @ right, up @ turned @ right)
            own = np.exp(1j * motion.link(name).angle[row])
            assert own * first.setdefault(name, direction / own) == pytest.approx(direction, abs=1e-9), (name, row)
            for point in link.points:
                joint = robot.joints.get(point)
                if joint is not None and joint.find("child").get("link") == name and joint.get("type") != "prismatic":
                    wanted = [right @ pose[:3, 3], up @ pose[:3, 3]]
                elif point in poses:
                    wanted = [right @ poses[point][:3, 3], up @ poses[point][:3, 3]]
                else:
                    continue
                assert motion.point(f"{name}.{point}").position[row] == pytest.approx(wanted, abs=1e-9), (point, row)


def codes(found: lw.Foreign) -> list[str]:
    return [each.code for each in found.findings]


def test_masses_colours_limits_and_lines() -> None:
    found = lw.read_foreign(FILES / "parallel.urdf", speed=0.5)
    machine = found.mechanism
    assert machine.links["a"].colour == "#ff8000" and machine.links["a"].mass == 0.4
    assert machine.links["b"].inertia == 1e-4
    # b has no other point than its hinge, so that its mass centre shows how it is turned
    assert machine.links["b"].mass_centre == "b_tip"
    assert lw.solve_motion(machine, times=[0.0]).point("b_tip").position[0] == pytest.approx((0.12, 0.04))
    assert "cycle: {from: 32.70422" in found.text  # 90° less 1 rad
    assert [(each.code, each.where) for each in found.findings] == [("import.limits", "parallel.urdf:12:1")]


def test_pins_are_found_where_points_stay_together() -> None:
    found = lw.read_foreign(FILES / "scissor_gripper.urdf", speed=1.0)
    assert codes(found).count("import.urdf_pins") == 1 and found.text.count("kind: gear") == 1
    pins = {"inner_l_pad_l", "inner_r_pad_r"}
    assert pins <= found.mechanism.links["pad_l"].points.keys() | found.mechanism.links["pad_r"].points.keys()


def test_another_link_can_be_the_frame() -> None:
    found = lw.read_foreign(FILES / "hanging.urdf", fixed="hook", driver="up", speed=1.0)
    motion = lw.solve_motion(lw.loads(found.text), times=[0.0, 0.4])
    assert set(motion.mechanism.links) == {"base", "leg"}
    # the hook turns at 1 rad/s against the base, so the base at -1 rad/s against the hook, and the leg at +1 rad/s
    assert np.diff(motion.link("base").angle)[0] == pytest.approx(-0.4)
    assert np.diff(motion.link("leg").angle)[0] == pytest.approx(0.4)
    hung = motion.point("down").position[1] - [0.1, 0.2]
    turned = np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]]) @ [-0.2, -0.2]
    assert hung == pytest.approx(turned)


def robot(inside: str) -> str:
    return f"<robot name='r'><link name='a'/><link name='b'/>\n{inside}</robot>"


JOINT = "<joint name='j' type='revolute'><parent link='a'/><child link='b'/>{}</joint>"


@pytest.mark.parametrize(
    ("text", "code", "severity"),
    [
        ("<mujoco/>", "import.urdf_root", "error"),
        (robot(""), "import.urdf_tree", "error"),
        (robot("<xacro:macro name='m'/>"), "import.xacro", "error"),
        (robot(JOINT.replace("link='a'", "link='${p}'")), "import.xacro", "error"),
        (robot(JOINT.replace("link='a'", "link='c'")), "import.urdf_link", "error"),
        (robot(JOINT.replace("revolute", "floating")), "import.spatial", "error"),
        (robot(JOINT.format("<axis xyz='0 0 0'/>")), "import.urdf_axis", "error"),
        (robot(JOINT.format("<axis xyz='0 0'/>")), "import.urdf_numbers", "error"),
        (robot(JOINT.format("<axis xyz='0 0 1'/><mimic joint='k'/>")), "import.urdf_mimic", "error"),
        (robot(JOINT.format("<axis xyz='0 0 1'/><dynamics friction='1'/>")), "import.urdf_friction", "note"),
        (robot(JOINT.format("<axis xyz='0 0 1'/>") + "<loop_joint/>"), "import.urdf_loop", "error"),
    ],
)
def test_findings(text: str, code: str, severity: str) -> None:
    found = lw.read_foreign(text.replace("xacro:macro", "xacro:macro xmlns:xacro='x'"), format="urdf")
    assert (code, severity) in [(each.code, each.severity) for each in found.findings]
    assert bool(found.text) == (severity == "note")


SIDE = "loops: [{{name: l, type: {}, link1: {{link: bed}}, link2: {{link: piston, rpy: [{}]}}, axis: [{}]}}]"


@pytest.mark.parametrize(
    ("beside", "code"),
    [
        (SIDE.format("prismatic", "0, 0, 0", "0, 0, 1"), "import.urdf_loop_plane"),
        (SIDE.format("prismatic", "0, 0, 0", "0, 0, 0"), "import.urdf_loop_plane"),
        (SIDE.format("fixed", "0, 1.5, 0", "1, 0, 0"), "import.urdf_loop_plane"),
        (SIDE.format("screw", "0, 0, 0", "1, 0, 0"), "import.urdf_loop"),
        ("drivers: [{joint: nothing, speed: 1}]", "import.no_such_driver"),
        ("loops: [", "import.json"),
    ],
)
def test_findings_about_the_file_beside(beside: str, code: str, tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text((FILES / "slider_crank.urdf").read_text())
    (tmp_path / "r.loops.yaml").write_text(beside)
    found = lw.read_foreign(tmp_path / "r.urdf")
    assert code in codes(found) and not found.text
