"""Links of a machine as links of a file of Linkage: which points are which connectors."""

from __future__ import annotations

import math

from linkwright.drivers.base import Driver
from linkwright.errors import RequestError
from linkwright.exporters.left_out import dynamics_left_out
from linkwright.exporters.linkage.elements import Elements, LinkElement
from linkwright.exporters.results import Results
from linkwright.fields.colour import as_rgb
from linkwright.joints.lower_pair import RigidJoint, SlidingJoint, TurningJoint
from linkwright.joints.toothed import WheelPair
from linkwright.kinematics.placement import placements
from linkwright.mechanism.link import Vec
from linkwright.words import _

#: The fixed link.
FRAME = "frame"


class Links:
    """Connectors and links of a machine.

    ``numbers``: the connector of each point of a link; ``of_link``: elements of links; ``notes``: what is left out.
    """

    def __init__(self, results: Results) -> None:
        self.motion, self.mechanism = results.motion, results.mechanism
        self.index = results.first_ok()
        self.placed = placements(self.motion)
        self.found = Elements()
        self.notes = dynamics_left_out(self.mechanism)
        self.cylinders = [each for each in self.mechanism.drivers.values() if each.cylinder is not None]
        inside = self.mechanism.cylinder_parts
        self.links = {name: each for name, each in self.mechanism.links.items() if name not in inside}
        every = [*self.mechanism.joints.values()]
        guides = self.mechanism.guides
        self.guides = [each for name, each in guides.items() if name not in self.mechanism.drivers]
        self.wheels = [each for each in every if isinstance(each, WheelPair)]
        self.welds = list(self.mechanism.welds.values())
        known = (SlidingJoint, WheelPair, RigidJoint, TurningJoint)
        for joint in every:
            if not isinstance(joint, known):
                raise RequestError(
                    _(
                        "{joint}: Linkage has no joint of the kind {kind}; it has pins, slots, gears and chains",
                        code="export.linkage_joint",
                        joint=joint.name,
                        kind=joint.kind,
                    )
                )
        self.numbers: dict[tuple[str, str], int] = {}
        self.of_link: dict[str, LinkElement] = {}
        places = [self.place(name, each) for name, link in self.links.items() for each in link.points]
        places += list(self.mechanism.frame.points.values())
        self.size = max(math.dist(places[0], each) for each in places) or 1.0

    def add(self) -> None:
        """Adds connectors and links."""
        inputs = self.inputs()
        self.connectors(inputs)
        self.bodies()

    # -- places

    def place(self, link: str, point: str) -> Vec:
        """Where a point of a link is, m."""
        return self.world(link, self.mechanism.link(link).points[point])

    def world(self, link: str, local: Vec) -> Vec:
        """A place in a link's axes in frame axes; rounding errors are 0."""
        x, y = map(float, self.placed[link].world(local)[self.index])
        size = getattr(self, "size", 0.0)
        return (x, y) if not size else (self._rounded(x), self._rounded(y))

    def _rounded(self, value: float) -> float:
        return 0.0 if abs(value) < 1e-15 * self.size else value

    # -- connectors and links

    def inputs(self) -> dict[str, Driver]:
        """Drivers by the point of the frame about which they turn a link."""
        found: dict[str, Driver] = {}
        for driver in self.mechanism.drivers.values():
            if driver.cylinder is not None:
                continue
            joint, speed = self.mechanism.joints[driver.joint], driver.law.constant_speed
            turning = isinstance(joint, TurningJoint) and driver.relative_to == FRAME
            if not turning or speed is None or driver.joint in found:
                raise RequestError(
                    _(
                        "{driver}: in Linkage an input turns a link about a fixed point at constant speed; change "
                        "the driver",
                        code="export.linkage_driver",
                        driver=driver.name,
                    )
                )
            found[driver.joint] = driver
        return found

    def connectors(self, inputs: dict[str, Driver]) -> None:
        """One connector for each point; at an input one for the links that it does not turn as well."""
        for point in self.mechanism.frame.points:
            self.numbers[FRAME, point] = self.found.connector(point, self.place(FRAME, point), anchor=True).number
        for name, link in self.links.items():
            for point in link.points:
                known = next((index for (_link, each), index in self.numbers.items() if each == point), None)
                if known is None:
                    known = self.found.connector(point, self.place(name, point), anchor=False).number
                self.numbers[name, point] = known
        for point, driver in inputs.items():
            speed = driver.law.constant_speed or 0.0
            self.found.connectors[self.numbers[FRAME, point]].rpm = -speed * 30 / math.pi
            others = [name for name, link in self.links.items() if point in link.points and name != driver.link]
            if others:
                second = self.found.connector(point, self.place(FRAME, point), anchor=True)
                self.numbers |= {(name, point): second.number for name in others}
                self.notes.append(
                    _(
                        "At {point} the input turns all links; {links} have a connector of their own there, {name}.",
                        point=point,
                        links=tuple(others),
                        name=second.name,
                    )
                )

    def bodies(self) -> None:
        """A link for each that is more than a pin."""
        for name, link in self.links.items():
            connectors = [self.numbers[name, point] for point in link.points]
            if len(connectors) == 1 and self.is_pin(name) and self.holders(name):
                continue
            element = self.found.link(name, connectors)
            element.colour = as_rgb(link.colour)
            self.of_link[name] = element

    def is_pin(self, name: str) -> bool:
        """Whether a link is a block of one point, of which it does not matter how it lies."""
        slides = sum(name in (each.guide, each.block) for each in self.guides)
        leading = any(name == each.guide for each in self.guides)
        used = {link for each in self.wheels for link in (*each.links, each.carrier)}
        used |= {link for each in self.welds for link in each.links}
        used |= {each.link for each in self.mechanism.drivers.values()}
        used |= {each.relative_to for each in self.mechanism.drivers.values()}
        return len(self.links[name].points) == 1 and slides == 1 and not leading and name not in used - {FRAME}

    def holders(self, name: str) -> list[str]:
        """Other links that are pinned at a block's only point, and that are more than a pin themselves."""
        (point,) = self.links[name].points
        found = [FRAME] if point in self.mechanism.frame.points else []
        return found + [
            each
            for each, link in self.links.items()
            if each != name and point in link.points and not self.is_pin(each)
        ]

    def extra(self, link: str, name: str, place: Vec) -> int:
        """A further connector of a link."""
        index = self.found.connector(name, place, anchor=link == FRAME).number
        if link != FRAME:
            self.of_link[link].connectors.append(index)
        return index
