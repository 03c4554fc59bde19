"""Motors, brakes, flywheels and end stops as parts of a drawing; cylinders between two points are in ``loads``."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from linkwright.actuators.base import AlongCoordinate
from linkwright.actuators.flywheel import Flywheel
from linkwright.actuators.motor import Motor
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.mechanism.stops import Stop
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import PIN, SYMBOLS
from linkwright.pictures.symbols.machine import HEIGHT, LENGTH
from linkwright.plotting.drawing.guides import direction, free_angle, ground_side, turned
from linkwright.plotting.drawing.machine import DrawnMechanism, Part, support_direction

#: Half the angles that an input's arrow, a symbol and a support take, rad.
ARROW, BESIDE, WIDE = 1.2, 0.4, 0.7
#: The part of a link at which its stop stands, and its least way; how far a stop is from the face of a guide.
OUTWARDS, LEAST, ABOVE = 0.6, 28.0, 4.0


def flywheels(machine: DrawnMechanism) -> Iterator[tuple[Part, str]]:
    """The discs of flywheels behind the machine, with the points at which they are."""
    for each in machine.motion.mechanism.actuators.values():
        pin = _pin(machine, each.on, "frame") if isinstance(each, Flywheel) else None
        if isinstance(each, Flywheel) and pin is not None:
            yield Part("ground", each.on, SYMBOLS["flywheel"](at=machine.local(each.on, pin))), pin


def actuators(machine: DrawnMechanism, index: int) -> Iterator[tuple[Part, str]]:
    """Motors, brakes and hands that turn links, with their pins, clear of the machine at a position."""
    taken: dict[str, list[float]] = {}
    for driver in machine.motion.mechanism.drivers.values():
        if driver.joint in machine.pins:
            middle = free_angle(machine, driver.joint, index)
            taken[driver.joint] = [middle - ARROW, middle, middle + ARROW]
    for each in machine.motion.mechanism.actuators.values():
        if not isinstance(each, AlongCoordinate) or each.on is None:
            continue
        pin = _pin(machine, each.on, each.against)
        if pin is None:
            continue
        before = taken.setdefault(pin, [])
        found = free_angle(machine, pin, index, [*before, *_support(machine, pin)])
        before += [found - BESIDE, found + BESIDE]
        part = _turning(machine, each, pin, found - turned(machine.placed[each.against], index))
        if part is not None:
            yield part, pin


def _support(machine: DrawnMechanism, pin: str) -> list[float]:
    """The edges of the support under a pin of the frame."""
    joint = machine.pins[pin]
    if "frame" not in joint.links:
        return []
    x, y = support_direction(machine, pin, joint)
    return [math.atan2(y, x) - WIDE, math.atan2(y, x) + WIDE]


def _turning(machine: DrawnMechanism, actuator: AlongCoordinate, pin: str, angle: float) -> Part | None:
    """What turns a link about a pin, in a direction on the paper of the link that it turns it against."""
    at, toward = machine.local(actuator.against, pin), (math.cos(angle), math.sin(angle))
    if isinstance(actuator, Motor):
        return Part("ground", actuator.against, SYMBOLS["motor"](at=at, toward=toward))
    if actuator.brakes:
        return Part("ground", actuator.against, SYMBOLS["brake"](at=at, toward=toward))
    torque = getattr(actuator, "torque", None)
    if not torque:
        return None
    shape = SYMBOLS["moment"](at=at, turning=int(np.sign(torque)), style="lw-load")
    return Part("marks", actuator.against, shape)


def _pin(machine: DrawnMechanism, link: str, against: str) -> str | None:
    """The pin of two links."""
    return next((name for name, joint in machine.pins.items() if {link, against} <= set(joint.links)), None)


def stops(machine: DrawnMechanism) -> Iterator[Part]:
    """The end stops of points, of links on the frame and of guides on it."""
    for each in machine.motion.mechanism.stops.values():
        found = _place(machine, each)
        if found is not None:
            at, toward = found
            yield Part("ground", "frame", SYMBOLS["end_stop"](at=at, toward=toward, size=7.0))


def _place(machine: DrawnMechanism, stop: Stop) -> tuple[Vec, Vec] | None:
    """Where a stop is touched, and in which direction it lies from there, on the paper."""
    sign = 1.0 if stop.side == "above" else -1.0
    row = machine.motion.read(stop.of)
    near = int(np.nanargmin(np.abs(row - stop.at))) if np.isfinite(row).any() else None
    if near is None:
        return None
    match stop.of.kind:
        case "position":
            return _of_point(machine, stop, near, sign)
        case "displacement":
            return _of_guide(machine, stop, near, float(row[near]), sign)
        case "angle" | "turned_angle":
            return _of_link(machine, stop, sign)
    return None


def _of_point(machine: DrawnMechanism, stop: Stop, near: int, sign: float) -> tuple[Vec, Vec]:
    """Across the axis along which the point is stopped, at the place that it comes nearest to."""
    x, y = machine.motion.point(stop.of.owner).position[near]
    along = (sign, 0.0) if stop.of.component == "x" else (0.0, -sign)
    world = (stop.at, y) if stop.of.component == "x" else (x, stop.at)
    place = machine.view.local((float(world[0]), float(world[1])))
    guides = (joint for joint in machine.guides.values() if joint.guide == "frame")
    guide = next((joint for joint in guides if joint.at == stop.of.owner.split(".")[-1]), None)
    if guide is None:
        return _before(place, along, PIN), along
    return _beside(machine, guide, _before(place, along, LENGTH / 2)), along


def _of_guide(machine: DrawnMechanism, stop: Stop, near: int, there: float, sign: float) -> tuple[Vec, Vec] | None:
    joint = machine.guides.get(stop.of.owner)
    if joint is None or joint.guide != "frame":
        return None
    along = (sign * math.cos(joint.direction), -sign * math.sin(joint.direction))
    x, y = machine.paper(joint.block, joint.at, near)
    way = sign * (stop.at - there) * machine.view.scale
    return _beside(machine, joint, _before((x, y), along, way + LENGTH / 2)), along


def _of_link(machine: DrawnMechanism, stop: Stop, sign: float) -> tuple[Vec, Vec] | None:
    """Beside the place of the link where it is stopped."""
    pin = _pin(machine, stop.of.owner, "frame")
    if pin is None:
        return None
    here = machine.local(stop.of.owner, pin)
    reach = max((math.dist(here, (x, y)) for x, y in machine.cloud(stop.of.owner)), default=0.0)
    ways = machine.directions(stop.of.owner, pin)
    if not ways:
        return None
    angle = math.atan2(ways[0][1], ways[0][0]) - stop.at
    c, s, far = math.cos(angle), math.sin(angle), max(OUTWARDS * reach, min(LEAST, reach))
    x, y = machine.local("frame", pin)
    along = (sign * s, -sign * c)
    return _before((x + far * c, y + far * s), along, 2.0), along


def _beside(machine: DrawnMechanism, joint: SlidingJoint, at: Vec) -> Vec:
    """Next to the ground of a guide, clear of what is pinned to the block."""
    x, y = direction(machine, joint)
    off = ground_side(machine, joint) * (HEIGHT / 2 - ABOVE)
    return at[0] - off * y, at[1] + off * x


def _before(at: Vec, along: Vec, gap: float) -> Vec:
    return at[0] + gap * along[0], at[1] + gap * along[1]
