"""MuJoCo models read as model files: positions over a cycle against MuJoCo's own kinematics, loads, findings."""

import sys
from pathlib import Path

import numpy as np
import pytest
from tests.importers.mujoco_positions import MujocoPositions

import linkwright as lw
from linkwright.errors import LinkwrightError

FILES = Path(__file__).parent / "mjcf"
AXES = dict(zip("xyz", np.eye(3), strict=True))
#: Files with their driven joint, how far it goes, and the plane in which one looks at the machine.
CASES = {
    "four_bar": ("O", 2 * np.pi, "xy"),
    "slider_crank_upright": ("turn", 2 * np.pi, "xz"),
    "watt_defaults": ("O", 2 * np.pi, "xy"),
    "open_sites": ("O", 2 * np.pi, "xy"),
    "gears_and_belt": ("ja", 2 * np.pi, "xy"),
    "rack": ("turn", 1.5, "xy"),
    "pin_in_slot": ("O", 2 * np.pi, "xy"),
    "welded_halves": ("O", 2 * np.pi, "xy"),
    "planetary_tendons": ("js", 2 * np.pi, "xy"),
    "gripper": ("rd", 0.7, "yz"),
    "springs": ("O", 1.5, "xy"),
    "closed_by_curves": ("O", 2 * np.pi, "xy"),
}


#: These run every day.
CORE = ("four_bar", "slider_crank_upright", "pin_in_slot", "planetary_tendons")
DAILY = [pytest.param(file, marks=() if file in CORE else pytest.mark.rotating) for file in CASES]


@pytest.mark.parametrize("file", DAILY)
def test_moves_as_in_mujoco(file: str) -> None:
    joint, far, axes = CASES[file]
    moved = np.linspace(0, far, 19)
    machine = lw.loads(lw.read_foreign(FILES / f"{file}.xml", driver=joint, speed=1.0).text)
    motion = lw.solve_motion(machine, times=moved)
    there = MujocoPositions(FILES / f"{file}.xml", joint, *(AXES[each] for each in axes))
    if file == "closed_by_curves":
        there.by_pins()
    before: dict[str, complex] = {}
    names = [name for name in machine.links if name in there.bodies()]
    assert len(names) > 1 or file == "springs"
    for row, _unused in enumerate(there.at_each(moved)):
        for name in names:
            link = motion.link(name)
            if file != "welded_halves":
                assert link.centre.position[row] == pytest.approx(there.centre(name), abs=1e-9), (name, row)
            turned = np.exp(1j * (link.angle[row] - link.angle[0]))
            now = there.direction(name)
            assert turned * before.setdefault(name, now) == pytest.approx(now, abs=1e-9), (name, row)


def codes(found: lw.Foreign) -> list[str]:
    return [each.code for each in found.findings]


def test_names_masses_colours_and_places_are_kept() -> None:
    found = lw.read_foreign(FILES / "four_bar.xml")
    machine = found.mechanism
    assert machine.name == "four bar" and list(machine.links) == ["crank", "coupler", "rocker"]
    assert machine.links["coupler"].points.keys() == {"A", "B", "C"}
    assert machine.links["crank"].colour == "#cc3300" and not machine.links["rocker"].colour
    # a capsule of 100 mm between its ends, 10 mm thick, of density 1000 kg/m³: cylinder and sphere
    assert machine.links["crank"].mass == pytest.approx(np.pi * 25e-6 * (0.1 + 4 / 3 * 0.005) * 1000)
    assert machine.gravity == (0, -9.81)
    assert codes(found) == ["import.no_speed"] and found.findings[0].where == "<file>".replace(
        "<file>", "four_bar.xml:7:1"
    )


def test_gravity_and_places_of_an_upright_plane() -> None:
    machine = lw.read_foreign(FILES / "slider_crank_upright.xml", speed=2.0).mechanism
    assert machine.gravity == (0, -9.81)
    assert machine.frame.points["turn"] == pytest.approx((0.02, 0.5))
    assert next(iter(machine.drivers.values())).law.constant_speed == pytest.approx(
        -2.0
    )  # about +y is clockwise where z is up


def test_a_spring_of_a_hinge_and_one_between_sites() -> None:
    machine = lw.read_foreign(FILES / "springs.xml", driver="O", speed=1.0).mechanism
    motion = lw.solve_motion(machine, times=[0.0, 0.4])
    forces = lw.solve_forces(motion)
    for row, angle in enumerate((np.radians(30), np.radians(30) - 0.4)):
        # about -z: the spring's torque -4 (q - 20°), the damper's -0.5 q', with q' = 1 rad/s
        turning = 4 * ((np.radians(30) - angle) - np.radians(20)) + 0.5
        end = 0.25 * np.array([np.cos(angle), np.sin(angle)])
        away = np.array([0.2, 0.3]) - end
        length = np.hypot(*away)
        rate = 0.25 * (-away / length) @ np.array([np.sin(angle), -np.cos(angle)])
        pull = (300 * (length - 0.12) + 7 * rate) * away / length
        weight = -9.81 * 2 * 0.1 * np.cos(angle)
        balance = turning + end[0] * pull[1] - end[1] * pull[0] + weight
        assert motion.point("end").position[row] == pytest.approx(end, abs=1e-12)
        assert forces.driver_effort("driver")[row] == pytest.approx(-balance, rel=1e-9)


def test_limits_of_the_driven_joint_are_its_cycle() -> None:
    found = lw.read_foreign(FILES / "gripper.xml", speed=0.1)
    assert "cycle: {from: 45 deg, to: 90.836" in found.text
    assert codes(found).count("import.limits") == 1 and "import.loose" in codes(found)


def test_without_mujoco_the_way_to_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(LinkwrightError) as caught:
        lw.read_foreign(FILES / "four_bar.xml")
    assert caught.value.code == "export.needs_package" and "pip install mujoco" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("<mujoco><worldbody/></mujoco>", "import.no_plane"),
        ("<robot/>", "import.mjcf_root"),
        ("<mujoco><worldbody>", "import.xml"),
        ('<!DOCTYPE a [<!ENTITY b "c">]><mujoco/>', "import.document_type"),
        ('<mujoco><worldbody><body name="a" shape="b"/></worldbody></mujoco>', "import.mjcf_refused"),
        ("{}<joint type='ball'/>{}", "import.spatial"),
        ("{}<joint axis='0 0 1'/><joint axis='0 1 1'/>{}", "import.spatial"),
        ("{}<freejoint/><body pos='1 0 0'><joint/><geom size='.1'/></body>{}", "import.floating"),
    ],
)
def test_refuses(text: str, code: str) -> None:
    body = text.format("<mujoco><worldbody><body name='a'>", "<geom size='.1'/></body></worldbody></mujoco>")
    found = lw.read_foreign(body, format="mjcf")
    assert code in codes(found) and not found.ok and not found.text


def test_a_floating_base_is_the_frame_where_one_says_so() -> None:
    text = """<mujoco><worldbody><body name="base" pos="0 0 1"><freejoint/><geom size=".1"/>
      <body name="arm" pos=".1 0 0"><joint name="J" axis="0 1 0"/>
      <geom type="capsule" size=".01" fromto="0 0 0 .2 0 0"/></body></body></worldbody></mujoco>"""
    assert lw.read_foreign(text, fixed="base", driver="J", speed=1.0).mechanism.frame.points["J"] == (0.1, 1.0)


def test_another_body_can_be_the_frame() -> None:
    found = lw.read_foreign(FILES / "four_bar.xml", fixed="rocker", speed=1.0)
    machine = lw.loads(found.text)
    assert set(machine.links) == {"base", "crank", "coupler"} and set(machine.frame.points) == {"Q", "B"}
    assert codes(lw.read_foreign(FILES / "four_bar.xml", fixed="bed")) == ["import.no_speed", "import.no_such_frame"]


def test_what_hangs_on_a_loose_body_is_left_out() -> None:
    text = """<mujoco><worldbody><site name="s" pos="0 0 1"/>
      <body name="box"><freejoint/><geom size=".1"/><site name="t"/></body>
      <body name="door" pos="1 0 0"><joint name="door" axis="0 0 1"/>
      <geom type="box" size=".1 .1 .1" pos=".2 0 0"/></body></worldbody>
      <tendon><spatial name="rope" stiffness="1"><site site="s"/><site site="t"/></spatial>
      </tendon></mujoco>"""
    found = lw.read_foreign(text, driver="door", speed=1.0)
    assert found.ok and "spring" not in found.text
    # a link and its hinge of one name, and a second point that shows how the link is turned
    machine = found.mechanism
    assert list(machine.links["door"].points) == ["door", "door_tip"]
    assert lw.solve_motion(machine, times=[np.pi / 2]).point("door_tip").position[0] == pytest.approx([1, 0.2])


def test_the_spring_of_a_slide_is_linear_along_it() -> None:
    text = """<mujoco><option gravity="0 0 0"/><worldbody><body name="cart" euler="0 0 30">
      <joint name="way" type="slide" axis="1 0 0" stiffness="50" springref=".02" damping="3"/>
      <inertial pos="0 0 0" mass="2" diaginertia="1e-3 1e-3 1e-3"/><site name="c"/></body>
      <body name="arm" pos="1 0 0"><joint name="J" axis="0 0 1"/><geom size=".1" pos=".2 0 0"/></body>
      </worldbody><actuator><motor name="push" joint="way"/><motor name="turn" joint="J"/></actuator></mujoco>"""
    motion = lw.solve_motion(lw.read_foreign(text, speed=0.25).mechanism, times=[0.0, 0.3])
    pushed = 50 * (np.array([0.0, 0.075]) - 0.02) + 3 * 0.25
    assert lw.solve_forces(motion).driver_effort("push") == pytest.approx(pushed)


def test_forces_without_a_word_for_them_are_told() -> None:
    text = """
    <mujoco><worldbody><geom type="plane" size="1 1 1"/>
      <body name="crank"><joint name="j" axis="0 0 1" frictionloss="0.3" armature="0.01"/>
        <geom type="capsule" size="0.01" fromto="0 0 0 0.1 0 0"/></body></worldbody></mujoco>"""
    found = {each.code: each for each in lw.read_foreign(text).remarks}
    assert {"import.mjcf_friction", "import.mjcf_armature", "import.mjcf_contact"} <= found.keys()
    assert found["import.mjcf_friction"].where == "<text>:3:1" and found["import.mjcf_friction"].key == "j"
