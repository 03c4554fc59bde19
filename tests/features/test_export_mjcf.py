"""The MuJoCo model, simulated by MuJoCo over a whole cycle, moves as the mechanism does, and its loops stay closed.

Every gallery machine with one input: `python -m tests.mujoco_cycles`.
"""

import json
import xml.etree.ElementTree as ET
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.cli.commands import run
from tests.every import every
from tests.refusals import refused

import linkwright as lw

mujoco = pytest.importorskip("mujoco")


def exported(mechanism: lw.Mechanism, **options: Any) -> Any:
    """MuJoCo's model of the exported file."""
    with TemporaryDirectory() as folder:
        path = lw.export(mechanism, Path(folder, "a.xml"), **options)
        return mujoco.MjModel.from_xml_string(path.read_text("utf-8"))


def loaded(mechanism: lw.Mechanism, **options: Any) -> tuple[Any, Any]:
    model = exported(mechanism, steps=72, **options)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def controls(mechanism: lw.Mechanism, time: float) -> list[float]:
    """Position (rate for constant speed) and rate of every driver."""
    found: list[float] = []
    for driver in mechanism.drivers.values():
        position, rate, _ = (float(values[0]) for values in driver.law.coordinate(np.array([time])))
        found += [position if driver.law.constant_speed is None else rate, rate]
    return found


def largest_gap(name: str, steps: int, every: int) -> float:
    """Largest distance between MuJoCo's and Linkwright's points over a cycle, relative to the largest travel."""
    mechanism = store.machine(name)
    motion = store.motion(name)
    model, data = loaded(mechanism, timestep=(motion.positions.period or float(np.ptp(motion.time))) / steps)
    times, places = [], []
    for step in range(steps):
        data.ctrl[:] = controls(mechanism, data.time)
        if step % every == 0:
            mujoco.mj_kinematics(model, data)
            times.append(data.time)
            places.append(data.site_xpos[:, :2].copy())
        mujoco.mj_step(model, data)
    motion = lw.solve_motion(mechanism, times=times)
    names = [model.site(index).name for index in range(model.nsite)]
    moving = [(index, motion.point(name).position) for index, name in enumerate(names) if "frame." not in name]
    travel = max(float(np.ptp(place, axis=0).max()) for _, place in moving)
    return max(float(np.abs(np.array(places)[:, index] - place).max()) for index, place in moving) / travel


@pytest.mark.parametrize(("name", "bound"), [("swing_conveyor", 2e-4), ("jaw_crusher_sixbar", 3e-8)])
def test_a_cycle_agrees(name: str, bound: float) -> None:
    assert largest_gap(name, 3_000, 50) < bound


@pytest.mark.parametrize("name", ["double_slider", "wedge", "shaper_quick_return", "oldham_coupling"])
def test_guides_and_other_laws_agree(name: str) -> None:
    assert largest_gap(name, 3_000, 50) < 1e-4


@pytest.mark.parametrize("name", ["parallelogram", "crank_rocker", "double_slider", "pinion_between_racks"])
def test_a_thousand_steps_keep_loops_closed(name: str) -> None:
    motion = store.motion(name)
    period = motion.positions.period or float(np.ptp(motion.time))
    cycle = lw.mujoco_loops(motion, timestep=period / 1000, simulate=True).cycle
    assert cycle.steps == 1000
    assert cycle.gap.distance < 2e-5
    assert cycle.off.distance < (5e-5 if name == "double_slider" else 1e-6)


def test_constant_speed_runs_by_itself() -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    model, data = loaded(mechanism)
    for _ in range(2_000):
        mujoco.mj_step(model, data)
    joint = model.joint("O1").qposadr[0]
    expected = float(mechanism.drivers["driver"].law.coordinate(np.array([data.time]))[0][0])
    assert data.qpos[joint] == pytest.approx(expected, rel=1e-6)


def test_masses_are_those_of_the_links() -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    model, _ = loaded(mechanism)
    for name, link in every((n, each) for n, each in mechanism.links.items() if each.mass):
        body = model.body(name)
        assert body.mass[0] == pytest.approx(link.mass, rel=1e-12)
        assert body.inertia[2] == pytest.approx(link.inertia, rel=1e-12)
        assert body.ipos[:2] == pytest.approx(link.centre, abs=1e-12)
    assert model.opt.gravity == pytest.approx([0.0, -9.81, 0.0])


def test_time_step_is_an_option() -> None:
    model = exported(store.machine("crank_rocker"), steps=12, timestep=1e-4)
    assert model.opt.timestep == 1e-4
    assert model.eq_solref[0, 0] == pytest.approx(2e-4)


def test_links_without_mass_stay_so_in_the_file_and_move() -> None:
    mechanism = store.machine("swing_conveyor")
    root = elements(mechanism)
    masses = {each.get("name"): float(each.find("inertial").get("mass")) for each in root.iter("body")}
    assert masses == {name: mechanism.links[name].mass for name in masses}
    assert exported(store.machine("oldham_coupling"), steps=12).body_mass[1:].min() > 0.0


def test_colours_are_those_of_the_links() -> None:
    text = store.text("crank_rocker").replace("rocker: {", 'rocker: {colour: "#336699", ')
    mechanism = lw.loads(text)
    assert mechanism.links["rocker"].colour == "#336699"
    model = exported(mechanism, steps=12)
    bodies = [model.body(model.geom_bodyid[index]).name for index in range(model.ngeom)]
    colours = {name: 255 * model.geom_rgba[index] for index, name in enumerate(bodies)}
    assert colours["rocker"] == pytest.approx([0x33, 0x66, 0x99, 255], abs=0.1)
    assert not np.allclose(colours["crank"], colours["rocker"])


def elements(mechanism: lw.Mechanism, **options: Any) -> ET.Element:
    """The exported file as it is."""
    with TemporaryDirectory() as folder:
        return ET.parse(lw.export(mechanism, Path(folder, "a.xml"), **options)).getroot()


def coefficients(root: ET.Element) -> dict[str, list[float]]:
    return {
        each.get("name"): [float(factor) for factor in each.get("polycoef").split()]
        for each in root.find("equality").iter("joint")
    }


def test_a_parallelogram_is_closed_by_ratios() -> None:
    """Its rocker turns with the crank, and its coupler against it; the pin that was cut is there, but off."""
    root = elements(store.machine("parallelogram"))
    assert coefficients(root) == {
        "O2(O1)": pytest.approx([0, 1, 0, 0, 0], abs=1e-14),
        "A(O1)": pytest.approx([0, -1, 0, 0, 0], abs=1e-14),
    }
    (pin,) = root.find("equality").iter("connect")
    assert (pin.get("name"), pin.get("site1"), pin.get("site2")) == ("B.rocker", "coupler.B", "rocker.B")
    assert pin.get("active") == "false"


def test_a_wedge_is_closed_by_ratios() -> None:
    """An incline of 15° that moves by x along the floor lifts the block by x tan 15°, which slides x / cos 15°."""
    found = coefficients(elements(store.machine("wedge")))
    angle = np.radians(15.0)
    assert found["column(floor)"] == pytest.approx([0, np.tan(angle), 0, 0, 0], abs=1e-12)
    assert found["incline(floor)"] == pytest.approx([0, 1 / np.cos(angle), 0, 0, 0], abs=1e-12)


def test_the_ends_of_an_open_cycle_are_in_the_file() -> None:
    """The parallelogram turns from 10° to 170°; a crank-rocker turns on."""
    numbers = {
        each.get("name"): each.get("data") for each in elements(store.machine("parallelogram")).iter("numeric")
    }
    ends = [float(each) for each in numbers["driver.range"].split()]
    assert ends == pytest.approx(np.radians([10.0, 170.0]), abs=1e-12)
    assert elements(store.machine("crank_rocker")).find("custom") is None


def test_gears_and_racks_tie_their_joints() -> None:
    """20 and 40 teeth outside each other; a pinion of 40 mm on a rack."""
    mechanism = store.machine("external_gear_pair")
    a, b = mechanism.joints["mesh"].teeth
    (found,) = coefficients(elements(mechanism)).values()
    assert found in ([0, pytest.approx(-a / b), 0, 0, 0], [0, pytest.approx(-b / a), 0, 0, 0])
    rack = coefficients(elements(store.machine("pinion_between_racks")))["below.frame"]
    assert [abs(each) for each in rack] == pytest.approx([0, 1 / 0.04, 0, 0, 0])


SCOTCH = """\
format: 1
name: rocking yoke
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  die: {points: [A]}
  yoke: {points: {A0: [0 mm, 0 mm]}}
joints:
  slot: {kind: prismatic, guide: yoke, through: A0, direction: 90 deg, block: die, at: A}
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: yoke, at: A0}
driver: {turn: crank, about: O, position: "90 deg + 8 deg*sin(2*pi*t/(1 s))"}
cycle: {duration: 1 s}
"""


def test_a_quartic_leaves_the_gap_of_its_series() -> None:
    """The yoke is at x = -r sin u: behind the fourth power comes r u⁵/120, of which polynomials of lower degree leave
    a 16th on [-a, a] (Chebyshev). The die, at r cos u, misses by r a⁶/720/32, which is nothing beside it."""
    mechanism = lw.loads(SCOTCH)
    found = lw.mujoco_loops(mechanism, loops="joint", closure=1e-8)
    a, r = np.radians(8.0), 0.1
    (joint,) = found.joints
    assert (joint.closed_by, joint.degree) == ("joint", 4)
    assert found.coupling_gap == pytest.approx(r * a**5 / 120 / 16, rel=0.05)


def test_couplings_open_in_mujoco_as_far_as_reckoned() -> None:
    mechanism = store.machine("lid_on_gas_strut")
    found = lw.mujoco_loops(mechanism, loops="joint", closure=1e-4, timestep=7.5 / 2000, simulate=True)
    assert 1e-5 < found.coupling_gap < 1e-4
    assert found.cycle.gap.distance == pytest.approx(found.coupling_gap, rel=0.01)
    assert found.cycle.off.distance < 1e-4


def test_the_way_of_closing_is_an_option() -> None:
    machine = store.machine("parallelogram")
    root = elements(machine, loops="connect")
    assert coefficients(root) == {}
    (pin,) = root.find("equality").iter("connect")
    assert pin.get("active") is None
    assert [each.closed_by for each in lw.mujoco_loops(machine, loops="connect").joints] == ["connect"]
    with refused("export.open_coupling"):
        lw.mujoco_loops(store.machine("crank_rocker"), loops="joint")
    with refused("export.no_coupling"):
        lw.mujoco_loops(store.machine("five_bar_robot"), loops="joint")
    with refused("given_instead.no_choice"):
        lw.mujoco_loops(machine, loops="soft")
    for wrong in ({"closure": 0.0}, {"timestep": -1e-3, "simulate": True}):
        with refused("given_instead.not_positive"):
            lw.mujoco_loops(machine, **wrong)


def test_the_command_prints_gaps(tmp_path: Path) -> None:
    path = str(tmp_path / "a.xml")
    ended = run("export", "gallery:parallelogram", "--to", path, "--simulate", "--timestep", "2e-4")
    assert ended.code == 0
    assert "B.rocker" in ended.out and "joint, degree 1" in ended.out and "One cycle of" in ended.out
    again = run("--json", "export", "gallery:kite", "--to", path, "--force", "--loops", "connect", "--steps", "24")
    assert json.loads(again.out)["loops"][0]["closed_by"] == "connect"
    with refused("export.no_option"):
        raise run("export", "gallery:kite", "--to", str(tmp_path / "a.csv"), "--simulate").told


def test_only_what_moves_can_be_simulated() -> None:
    with refused("export.nothing_driven"):
        lw.mujoco_loops(store.machine("truss"), simulate=True)


def test_mujoco_warns_of_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    for name in ("geared_fivebar", "wedge", "peaucellier"):
        model, data = loaded(store.machine(name))
        for _ in range(50):
            mujoco.mj_step(model, data)
        assert data.warning.number.sum() == 0
    assert capfd.readouterr() == ("", "")
