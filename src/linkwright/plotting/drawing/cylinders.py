"""Actuators along a line in a drawing: cylinders and linear motors between two points or on a guide."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from linkwright.actuators.base import AlongLine
from linkwright.actuators.cylinder import Cylinder
from linkwright.actuators.motor import Motor
from linkwright.applied_loads.base import LinkPoint
from linkwright.core.arrays import Floats
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import EMPTY, SYMBOLS, Shape, way
from linkwright.pictures.symbols.machine import LENGTH
from linkwright.plotting.drawing.guides import clear_shift, is_cylinder, travel
from linkwright.plotting.drawing.machine import DrawnMechanism

#: What a cylinder on a guide is longer than its stroke, and its barrel than that, in units of the paper.
ROOM, HEAD = 34.0, 8.0


class Reach(NamedTuple):
    """Where the ends of a cylinder are on the paper at a position; lengths of its barrel and its rod there."""

    start: Vec
    end: Vec
    barrel: float
    rod: float


def linear(machine: DrawnMechanism, actuator: AlongLine, index: int) -> Shape:
    """The symbol of an actuator along a line at a position: a cylinder, or the general one between its ends."""
    if not isinstance(actuator, Cylinder | Motor):
        if actuator.between is None:
            return EMPTY
        ends = [machine.paper(each.link, each.point, index) for each in actuator.between]
        return SYMBOLS["general_load"](ends=tuple(ends))
    found = (
        _between(machine, actuator, index) if actuator.along is None else _on_guide(machine, actuator.along, index)
    )
    if found is None:
        return EMPTY
    wall = EMPTY if actuator.along is None else _held(machine, actuator.along, found)
    return SYMBOLS["cylinder"](**found._asdict()) + wall


def _between(machine: DrawnMechanism, actuator: AlongLine, index: int) -> Reach | None:
    if actuator.between is None:
        return None
    a, b = actuator.between
    start, end = (machine.paper(each.link, each.point, index) for each in (a, b))
    return Reach(start, end, *lengths(machine, a, b))


def lengths(machine: DrawnMechanism, a: LinkPoint, b: LinkPoint) -> tuple[float, float]:
    """Of the barrel and the rod of a cylinder between two points, on the paper, for all its positions."""
    first, second = (_everywhere(machine, each) for each in (a, b))
    apart = machine.view.scale * np.hypot(*(second - first).T)
    short, longest = float(np.nanmin(apart)), float(np.nanmax(apart))
    barrel = max(0.6 * short, min(0.62 * longest, 0.92 * short))
    return barrel, longest - 0.9 * barrel


def _everywhere(machine: DrawnMechanism, point: LinkPoint) -> Floats:
    """A point at all positions, m."""
    return machine.placed[point.link].world(machine.motion.mechanism.link(point.link).points[point.point])


def _on_guide(machine: DrawnMechanism, name: str, index: int) -> Reach | None:
    """On the side of the block where the machine is not; none where the joint itself is drawn as a cylinder."""
    if is_cylinder(machine, name):
        return None
    joint = machine.guides[name]
    c, s = machine.placed[joint.guide].direction[index]
    angle = math.atan2(s, c) + joint.direction
    along = np.array([math.cos(angle), -math.sin(angle)])
    block = np.array(machine.paper(joint.block, joint.at, index))
    pins = np.array([machine.paper(each.links[0], pin, index) for pin, each in machine.pins.items()]).reshape(-1, 2)
    sign = -1.0 if len(pins) == 0 or float((pins.mean(axis=0) - block) @ along) > 0.0 else 1.0
    low, high = travel(machine, name)
    here = float((block - machine.paper(joint.guide, joint.through, index)) @ along)
    left = here - low if sign < 0.0 else high - here
    end = block + clear_shift(machine, name, joint) * along + sign * LENGTH / 2 * along
    start = end + sign * (left + high - low + ROOM) * along
    barrel = high - low + ROOM - HEAD
    return Reach((float(start[0]), float(start[1])), (float(end[0]), float(end[1])), barrel, high - low + HEAD)


def _held(machine: DrawnMechanism, name: str, reach: Reach) -> Shape:
    """The wall that holds a cylinder of a guide on the frame."""
    if machine.guides[name].guide != "frame":
        return EMPTY
    _length, (x, y) = way(reach.start, reach.end)
    return SYMBOLS["wall"](at=reach.start, toward=(-x, -y), size=12.0)
