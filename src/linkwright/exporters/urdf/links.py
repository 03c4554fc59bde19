"""The XML elements of a robot: links whose axes lie in their joints, joints, transmissions of the drivers."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping

import numpy as np

from linkwright.exporters.mjcf.bodies import Body, Chains, Coordinate, Vec
from linkwright.exporters.mjcf.elements import numbers, size
from linkwright.exporters.results import Results
from linkwright.exporters.urdf.mimics import Mimic
from linkwright.fields.colour import as_rgb
from linkwright.mechanism.link import Link

#: The base of a robot that stands upright.
WORLD = "world"
#: Limits of effort and speed that say nothing.
UNLIMITED = 1e9
#: Radius of drawn links as a share of the largest one.
THICK = 0.012
GREY = "#4d7399"


class Robot:
    """The elements of one robot; ``origin``: where the axes of its links lie on Linkwright's, in their joints, m."""

    def __init__(self, results: Results, chains: Chains, follow: Mapping[str, Mimic]) -> None:
        self.results, self.chains, self.follow = results, chains, follow
        self.large = size(chains)
        self.origin: dict[str, Vec] = {"frame": (0.0, 0.0)}
        self.hung = [body for body in chains.bodies if body.link is not None]
        for body in self.hung:
            each = body.coordinate
            self.origin[body.name] = (0.0, 0.0) if each is None or each.slides else each.at

    def inside(self, link: str, place: Vec) -> Vec:
        """A place on a link in the axes that it has in the file."""
        x, y = self.origin[link]
        return place[0] - x, place[1] - y

    def element(self) -> ET.Element:
        """The whole robot."""
        root = ET.Element("robot", name=self.chains.mechanism.name)
        self._base(root)
        self._link(root, self.chains.mechanism.frame)
        for body in self.hung:
            assert body.link is not None
            self._link(root, body.link)
            self._joint(root, body)
        for driver, joint in self.chains.joint_of.items():
            transmission = ET.SubElement(root, "transmission", name=driver)
            ET.SubElement(transmission, "type").text = "transmission_interface/SimpleTransmission"
            ET.SubElement(transmission, "joint", name=joint)
            ET.SubElement(transmission, "actuator", name=f"{driver}.motor")
        return root

    def _base(self, root: ET.Element) -> None:
        """Upright, with the machine's gravity along -z of the world; flat, where it has none."""
        x, y = self.chains.mechanism.gravity
        if x or y:
            ET.SubElement(root, "link", name=WORLD)
            down = math.atan2(x, -y)
            self._fixed(root, WORLD, "frame", (0.0, 0.0), (math.pi / 2, -down + 0.0, 0.0))

    # -- links

    def _link(self, root: ET.Element, link: Link) -> None:
        element = ET.SubElement(root, "link", name=link.name)
        if link.mass:
            inertial = ET.SubElement(element, "inertial")
            self._origin(inertial, self.inside(link.name, link.centre))
            ET.SubElement(inertial, "mass", value=numbers([link.mass]))
            inertia = numbers([link.inertia])
            zero = {"ixy": "0", "ixz": "0", "iyz": "0"}
            ET.SubElement(inertial, "inertia", {"ixx": inertia, "iyy": inertia, "izz": inertia, **zero})
        self._shape(element, link)
        joints = {body.coordinate.name for body in self.hung if body.coordinate is not None}
        for point, place in link.points.items():
            if point not in joints:
                name = f"{link.name}.{point}"
                ET.SubElement(root, "link", name=name)
                self._fixed(root, link.name, name, self.inside(link.name, place))

    def _shape(self, element: ET.Element, link: Link) -> None:
        """A cylinder between each two points, or a box at the only one."""
        places = [self.inside(link.name, each) for each in link.points.values()]
        pairs = list(zip(places, places[1:] + (places[:1] if len(places) > 2 else []), strict=False))
        apart = [(a, b) for a, b in pairs if math.dist(a, b) > 1e-3 * self.large]
        for a, b in apart if link.name != "frame" else ():
            middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
            turn = (0.0, math.pi / 2, math.atan2(b[1] - a[1], b[0] - a[0]))
            length, radius = numbers([math.dist(a, b)]), numbers([THICK * self.large])
            shape = ET.Element("cylinder", length=length, radius=radius)
            self._visual(element, link, middle, turn, shape)
        if not apart and link.name != "frame":
            box = numbers((0.08 * self.large, 0.05 * self.large, 2 * THICK * self.large))
            self._visual(element, link, places[0] if places else (0.0, 0.0), (0, 0, 0), ET.Element("box", size=box))

    def _visual(
        self, element: ET.Element, link: Link, place: Vec, turn: tuple[float, float, float], shape: ET.Element
    ) -> None:
        visual = ET.SubElement(element, "visual")
        self._origin(visual, place, turn)
        ET.SubElement(visual, "geometry").append(shape)
        colour = as_rgb(link.colour) or GREY
        material = ET.SubElement(visual, "material", name=f"{link.name}.colour")
        shares = (*(round(each / 255, 4) for each in bytes.fromhex(colour[1:])), 1.0)
        ET.SubElement(material, "color", rgba=numbers(shares))

    # -- joints

    def _joint(self, root: ET.Element, body: Body) -> None:
        each = body.coordinate
        x, y = self.origin[body.name]
        c, s = math.cos(body.turn), math.sin(body.turn)
        place = self.inside(body.parent, (body.place[0] + c * x - s * y, body.place[1] + s * x + c * y))
        if each is None:
            self._fixed(root, body.parent, body.name, place, (0.0, 0.0, body.turn), f"{body.name}.fixed")
            return
        limits = self._limits(each)
        kind = "prismatic" if each.slides else "continuous" if limits is None else "revolute"
        joint = ET.SubElement(root, "joint", name=each.name, type=kind)
        self._ends(joint, body.parent, body.name, place, (0.0, 0.0, body.turn))
        ET.SubElement(joint, "axis", xyz=numbers((*each.axis, 0.0) if each.slides else (0.0, 0.0, each.axis[0])))
        bounds = {} if limits is None else {"lower": numbers([limits[0]]), "upper": numbers([limits[1]])}
        ET.SubElement(joint, "limit", {**bounds, "effort": self._effort(each), "velocity": numbers([UNLIMITED])})
        mimic = self.follow.get(each.name)
        if mimic is not None:
            factor = numbers([mimic.multiplier])
            ET.SubElement(joint, "mimic", joint=mimic.leader, multiplier=factor, offset="0")

    def _limits(self, each: Coordinate) -> tuple[float, float] | None:
        """The range over the motion from the start; None: a hinge that turns on."""
        reached = each.values[self.chains.motion.ok] - each.values[self.chains.index]
        low, high = float(np.min(reached)), float(np.max(reached))
        closed = self.chains.motion.positions.closed
        if not each.slides and ((closed and each.driver is not None) or high - low > 2 * math.pi * 0.9):
            return None
        return low, high

    def _effort(self, each: Coordinate) -> str:
        """The largest effort of a driver, where forces are known; a passive joint has none."""
        if each.driver is None:
            return "0"
        if self.results.forces is None:
            return numbers([UNLIMITED])
        return numbers([float(np.nanmax(np.abs(self.results.forces.driver_effort(each.driver)), initial=0.0))])

    def _fixed(
        self,
        root: ET.Element,
        parent: str,
        child: str,
        place: Vec,
        turn: tuple[float, float, float] = (0.0, 0.0, 0.0),
        name: str = "",
    ) -> None:
        joint = ET.SubElement(root, "joint", name=name or f"{child}.fixed", type="fixed")
        self._ends(joint, parent, child, place, turn)

    def _ends(self, joint: ET.Element, parent: str, child: str, place: Vec, turn: tuple[float, float, float]) -> None:
        ET.SubElement(joint, "parent", link=parent)
        ET.SubElement(joint, "child", link=child)
        self._origin(joint, place, turn)

    @staticmethod
    def _origin(element: ET.Element, place: Vec, turn: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        ET.SubElement(element, "origin", xyz=numbers((*place, 0.0)), rpy=numbers(turn))
