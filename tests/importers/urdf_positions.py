"""Positions of a URDF robot read a second way: 4x4 matrices along its tree, loops closed by Newton's method."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import yaml
from scipy.spatial.transform import Rotation


def matrix(element: ET.Element | dict | None) -> np.ndarray:
    """The pose that xyz and rpy say, about fixed axes."""
    found = np.eye(4)
    if element is None:
        return found

    def three(key: str) -> list[float]:
        value = element.get(key) or [0, 0, 0]
        return [float(each) for each in (value.split() if isinstance(value, str) else value)]

    found[:3, :3] = Rotation.from_euler("xyz", three("rpy")).as_matrix()
    found[:3, 3] = three("xyz")
    return found


class UrdfPositions:
    """A robot; poses of its links follow from values of the joints that mimic no other."""

    def __init__(self, path: Path) -> None:
        self.robot = ET.parse(path).getroot()
        beside = path.with_name(path.stem + ".loops.yaml")
        self.beside = yaml.safe_load(beside.read_text()) if beside.exists() else {}
        self.joints = {each.get("name"): each for each in self.robot.findall("joint") if each.get("type") != "fixed"}
        self.free = [name for name, each in self.joints.items() if each.find("mimic") is None]
        if self.beside.get("mimic") == "implied":
            self.free = list(self.joints)
        self.loops = [self._of_robot(each) for each in self.robot.findall("loop_joint")]
        self.loops += self.beside.get("loops", [])

    @staticmethod
    def _of_robot(element: ET.Element) -> dict:
        return {"type": element.get("type"), **{key: dict(element.find(key).attrib) for key in ("link1", "link2")}}

    def value(self, name: str, free: dict[str, float]) -> float:
        """The value of a joint."""
        mimic = self.joints[name].find("mimic")
        if name in free or mimic is None:
            return free[name]
        factor, offset = float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0))
        return factor * self.value(mimic.get("joint"), free) + offset

    def poses(self, free: dict[str, float]) -> dict[str, np.ndarray]:
        """The pose of each link."""
        above = {each.find("child").get("link"): each for each in self.robot.findall("joint")}
        found: dict[str, np.ndarray] = {}

        def pose(link: str) -> np.ndarray:
            if link in found or link not in above:
                return found.setdefault(link, np.eye(4))
            joint = above[link]
            base = pose(joint.find("parent").get("link")) @ matrix(joint.find("origin"))
            if joint.get("type") != "fixed":
                axis = joint.find("axis")
                along = np.array([float(each) for each in (axis.get("xyz") if axis is not None else "1 0 0").split()])
                moved, value = np.eye(4), self.value(joint.get("name"), free)
                if joint.get("type") == "prismatic":
                    moved[:3, 3] = value * along / np.linalg.norm(along)
                else:
                    moved[:3, :3] = Rotation.from_rotvec(value * along / np.linalg.norm(along)).as_matrix()
                base = base @ moved
            return found.setdefault(link, base)

        return {each.get("name"): pose(each.get("name")) for each in self.robot.findall("link")}

    def gaps(self, free: dict[str, float]) -> np.ndarray:
        """By how much all loops are open."""
        poses, found = self.poses(free), [0.0]
        for loop in self.loops:
            if loop["type"] == "coupled":
                found.append(sum(factor * self.value(name, free) for name, factor in loop["joints"].items()))
                continue
            a, b = (poses[loop[key]["link"]] @ matrix(loop[key]) for key in ("link1", "link2"))
            away = np.linalg.inv(a) @ b
            if loop["type"] in ("revolute", "spherical", "continuous"):
                found += list(away[:3, 3])
                continue
            across = np.eye(3)
            if loop["type"] == "prismatic":
                axis = np.array(loop.get("axis", [1, 0, 0]), dtype=float)
                across -= np.outer(axis, axis) / (axis @ axis)
            found += [*(across @ away[:3, 3]), *Rotation.from_matrix(away[:3, :3]).as_rotvec()]
        return np.array(found)

    def closed(self, start: dict[str, float], driven: Sequence[dict[str, float]]) -> Iterator[dict[str, np.ndarray]]:
        """Poses of all links with driven joints at each of these values, the others from their last ones on."""
        others = [name for name in self.free if name not in driven[0]]
        values = np.array([start.get(name, 0.0) for name in others])
        for given in driven:
            for _attempt in range(60):
                wrong = self.gaps({**dict(zip(others, values, strict=True)), **given})
                if np.abs(wrong).max() < 1e-13:
                    break
                slope = np.empty((len(wrong), len(others)))
                for k in range(len(others)):
                    step = 1e-6 * np.eye(len(others))[k]
                    ahead, behind = (dict(zip(others, values + sign * step, strict=True)) for sign in (1, -1))
                    slope[:, k] = (self.gaps({**ahead, **given}) - self.gaps({**behind, **given})) / 2e-6
                values = values + np.linalg.lstsq(slope, -wrong, rcond=1e-9)[0]
            assert np.abs(wrong).max() < 1e-10, f"the robot does not close: {np.abs(wrong).max():.2g}"
            yield self.poses({**dict(zip(others, values, strict=True)), **given})
