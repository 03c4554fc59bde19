"""All outputs of a traced motion, by name, traced only when somebody asks."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import Any

from linkwright.core.outputs import KINDS, POINT, SLIDE, Output, row_name, row_names
from linkwright.formula.trace import Scalar
from linkwright.formula.vector import ZERO, Vec
from linkwright.kinematics.names import canonical, find_point
from linkwright.kinematics.trace import MotionTrace


class MotionOutputs:
    """Looks outputs up by name in a :class:`MotionTrace`."""

    def __init__(self, motion: MotionTrace) -> None:
        self.motion = motion
        self.mechanism = motion.mechanism
        self._points: dict[str, tuple[Vec, Vec, Vec]] = {}

    def value(self, name: str) -> Scalar:
        """The traced value of an output, by its row; raises KeyError for one that is not of the motion."""
        output = Output.of_row(name)
        found = self.of(output)
        return found if not isinstance(found, Vec) else found.x if output.component == "x" else found.y

    def of(self, output: Output) -> Scalar | Vec:
        """The traced value of an output, of a vector with all components."""
        kind, owner, motion = output.kind, output.owner, self.motion
        match KINDS[kind].of:
            case "point":
                if owner not in self._points:
                    self._points[owner] = self.point(owner)
                return self._points[owner][POINT.index(kind)]
            case "guide":
                return self.slide(owner)[SLIDE.index(kind)]
            case "joint" if kind == "reaction_place":
                return motion.reaction_place(owner)
            case "link" if kind == "direction":
                return motion.poses[owner].direction
            case "link" if kind == "turned_angle":
                return motion.angles(owner)
            case "link":
                state = motion.states[owner]
                return state.omega if kind == "angular_velocity" else state.alpha
            case "group":
                placed = motion.placed[owner]
                return placed.quality if kind == "quality" else placed.facts[output.on]
        return motion.outcome

    def point(self, key: str) -> tuple[Vec, Vec, Vec]:
        """Position, velocity, acceleration of ``C``, ``jaw.D`` or ``jaw.centre`` (the mass centre)."""
        if key.endswith(".@centre"):
            link = key.removesuffix(".@centre")
            return self.motion.point(link, self.motion.dimensions.centre(link))
        link, point = find_point(self.mechanism, key)
        link = self._cheapest(link, point)
        return self.motion.point(link, self.motion.dimensions.point(link, point))

    def _cheapest(self, link: str, point: str) -> str:
        """For a pin, the link that turns about a point at rest, if there is one."""
        links = self.mechanism.pin_links(point)
        if link not in links:
            return link
        if "frame" in links:
            return "frame"
        for name in links:
            if self.motion.states and self.motion.states.get(name) and self.motion.states[name].velocity == ZERO:
                return name
        order = list(self.motion.states)
        return min(links, key=order.index) if set(links) <= set(order) else link

    def slide(self, joint_name: str) -> tuple[Scalar, Scalar, Scalar]:
        """Displacement of a guide's block with its rates."""
        joint: Any = self.mechanism.joints[joint_name]
        dimensions, states = self.motion.dimensions, self.motion.states
        guide, block = states[joint.guide], states[joint.block]
        n = guide.pose.spin(joint.slide_direction(dimensions))
        start = guide.arm(dimensions.point(joint.guide, joint.through))
        at = dimensions.point(joint.block, joint.at)
        gap = block.pose.place + block.arm(at) - guide.pose.place
        rate = n.dot(block.velocity_of(at) - guide.velocity_at(gap))
        second = n.dot(block.acceleration_of(at) - guide.acceleration_at(gap))
        return n.dot(gap - start), rate, second

    @cached_property
    def standard(self) -> tuple[str, ...]:
        """What every motion result stores: pins and points with rates, rotation rates, the outcome."""
        names: list[str] = []
        for key in self.point_keys():
            names += (name for kind in POINT for name in row_names(kind, key))
        for link in self.mechanism.links:
            names += (row_name("angular_velocity", link), row_name("angular_acceleration", link))
        return (*names, row_name("outcome"))

    def point_keys(self) -> Iterable[str]:
        """Canonical names of all points of the moving links that the frame does not carry."""
        keys: dict[str, None] = {}
        for name, link in self.mechanism.links.items():
            for point in link.points:
                key = canonical(self.mechanism, name, point)
                if "frame" not in self.mechanism.pin_links(key):
                    keys[key] = None
        return keys
