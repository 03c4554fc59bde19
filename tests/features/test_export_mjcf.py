"""The MuJoCo model, simulated by MuJoCo over a whole cycle, moves as the mechanism does."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw

mujoco = pytest.importorskip("mujoco")


def exported(mechanism: lw.Mechanism, **options: Any) -> Any:
    """MuJoCo's model of the exported file."""
    with TemporaryDirectory() as folder:
        path = lw.export(mechanism, Path(folder, "a.xml"), **options)
        return mujoco.MjModel.from_xml_string(path.read_text("utf-8"))


def loaded(mechanism: lw.Mechanism) -> tuple[Any, Any]:
    model = exported(mechanism, steps=72)
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
    """Largest distance between MuJoCo's and Linkwright's points, relative to the largest travel."""
    mechanism = store.machine(name)
    model, data = loaded(mechanism)
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


@pytest.mark.parametrize(("name", "bound"), [("swing_conveyor", 5e-6), ("jaw_crusher_sixbar", 5e-7)])
def test_a_cycle_agrees(name: str, bound: float) -> None:
    assert largest_gap(name, 20_000, 100) < bound


@pytest.mark.parametrize("name", ["double_slider", "wedge", "shaper_quick_return", "oldham_coupling"])
def test_guides_and_other_laws_agree(name: str) -> None:
    assert largest_gap(name, 4_000, 100) < 1e-5


def test_constant_speed_runs_by_itself() -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    model, data = loaded(mechanism)
    for _ in range(5_000):
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
