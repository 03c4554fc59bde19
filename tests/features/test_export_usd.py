"""USD scenes opened by USD itself: bodies at their places, frames of joints that are one, drives, masses."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright.errors import LinkwrightError

pxr = pytest.importorskip("pxr")
from pxr import Usd, UsdGeom, UsdPhysics  # noqa: E402

ROOT = "/Machine"


def opened(name: str, folder: Path) -> Any:
    return Usd.Stage.Open(str(lw.export(store.machine(name), folder / f"{name}.usda", steps=24)))


def place(stage: Any, path: str) -> np.ndarray:
    """The matrix of a prim in the world; its last row is the place."""
    return np.array(UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath(path)))


def joints(stage: Any) -> Iterator[Any]:
    """Joints of two bodies."""
    for prim in stage.Traverse():
        if prim.IsA(UsdPhysics.Joint) and UsdPhysics.Joint(prim).GetBody0Rel().GetTargets():
            yield UsdPhysics.Joint(prim)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "oldham_coupling"])
def test_points_are_in_place_and_frames_of_joints_are_one(name: str, tmp_path: Path) -> None:
    stage = opened(name, tmp_path)
    motion = lw.solve_motion(store.machine(name), steps=24)
    for link in motion.mechanism.links.values():
        for point in link.points:
            found = place(stage, f"{ROOT}/{link.name}/{point}")
            assert found[3, :2] == pytest.approx(motion.point(f"{link.name}.{point}").position[0], abs=1e-12)
    for joint in joints(stage):
        a, b = (place(stage, each.GetTargets()[0]) for each in (joint.GetBody0Rel(), joint.GetBody1Rel()))
        assert np.abs(a - b).max() < 1e-9
        local = (joint.GetLocalPos0Attr(), joint.GetLocalPos1Attr())
        assert all(not each.HasAuthoredValue() for each in local)


def test_usd_finds_bodies_and_an_articulation(tmp_path: Path) -> None:
    stage = opened("jaw_crusher_sixbar", tmp_path)
    machine = store.machine("jaw_crusher_sixbar")
    found = UsdPhysics.UsdPhysicsLoadStageFromPrimRange(stage, [ROOT])
    _paths, bodies = found[UsdPhysics.ObjectType.RigidBody]
    assert len(bodies) == len(machine.links) + 1
    _paths, hinges = found[UsdPhysics.ObjectType.RevoluteJoint]
    assert len(hinges) == 7 and sum(each.excludeFromArticulation for each in hinges) == 2
    inside = {str(path).rpartition("/")[2] for each in hinges for path in (each.body0, each.body1)}
    assert inside == {"frame", *machine.links}
    assert UsdGeom.GetStageUpAxis(stage) == "Y" and UsdGeom.GetStageMetersPerUnit(stage) == 1


def test_masses_gravity_and_drives(tmp_path: Path) -> None:
    stage, machine = opened("jaw_crusher_sixbar", tmp_path), store.machine("jaw_crusher_sixbar")
    for link in machine.links.values():
        matter = UsdPhysics.MassAPI(stage.GetPrimAtPath(f"{ROOT}/{link.name}"))
        if link.mass:
            assert matter.GetMassAttr().Get() == pytest.approx(link.mass)
            assert matter.GetCenterOfMassAttr().Get()[:2] == pytest.approx(link.centre)
    scene = UsdPhysics.Scene(stage.GetPrimAtPath(f"{ROOT}/physics"))
    assert scene.GetGravityMagnitudeAttr().Get() == pytest.approx(np.hypot(*machine.gravity))
    speed = np.degrees(machine.drivers["driver"].law.constant_speed)
    drives = [UsdPhysics.DriveAPI(each.GetPrim(), "angular").GetTargetVelocityAttr() for each in joints(stage)]
    speeds = [each.Get() for each in drives if each.HasAuthoredValue()]
    assert speeds == [pytest.approx(speed)]


def test_laws_are_samples_over_the_time(tmp_path: Path) -> None:
    stage = opened("wedge", tmp_path)
    found = [UsdPhysics.DriveAPI(each.GetPrim(), "linear").GetTargetPositionAttr() for each in joints(stage)]
    target = next(each for each in found if each.GetNumTimeSamples())
    motion = lw.solve_motion(store.machine("wedge"), steps=24)
    for time, value in zip(motion.time, motion.inputs["driver"], strict=True):
        assert target.Get(float(time - motion.time[0])) == pytest.approx(value - motion.inputs["driver"][0], abs=1e-5)


def test_without_usd_the_way_to_it_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pxr.Gf", None)
    with pytest.raises(LinkwrightError) as caught:
        opened("crank_rocker", tmp_path)
    assert caught.value.code == "export.needs_package" and "pip install usd-core" in str(caught.value)


def test_wheels_are_refused(tmp_path: Path) -> None:
    with pytest.raises(LinkwrightError) as caught:
        opened("geared_fivebar", tmp_path)
    assert caught.value.code == "export.usd_pairs"


WHEELS = ("gear", "belt", "chain", "rack", "rolling", "cam")
PLAIN = [
    name for name in store.names() if not any(joint.kind in WHEELS for joint in store.machine(name).joints.values())
]


@pytest.mark.rotating
@pytest.mark.parametrize("name", PLAIN)
def test_every_machine_without_wheels_opens(name: str, tmp_path: Path) -> None:
    for joint in joints(opened(name, tmp_path)):
        stage = joint.GetPrim().GetStage()
        a, b = (place(stage, each.GetTargets()[0]) for each in (joint.GetBody0Rel(), joint.GetBody1Rel()))
        assert np.abs(a - b).max() < 1e-9
