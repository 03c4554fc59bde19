"""Motors, brakes, flywheels and end stops as parts of a drawing; cylinders between two points are in ``loads``."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from linkwright.actuators.base import AlongCoordinate
from linkwright.actuators.flywheel import Flywheel
from linkwright.actuators.motor import Motor
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.mechanism.stops import Stop
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import PIN, SYMBOLS, Shape
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


class Touch(NamedTuple):
    """Where an output is stopped, in frame axes (m); how far from there it is touched, and in which
    direction it lies, on the paper."""

    place: Vec
    gap: Vec
    toward: Vec


def stops(machine: DrawnMechanism) -> Iterator[Part]:
    """The end stops of points, of links on the frame and of guides on it."""
    for place, gap, toward in touches(machine):
        x, y = machine.view.local(place)
        yield Part("ground", "frame", end_stop((x + gap[0], y + gap[1]), toward))


def end_stop(at: Vec, toward: Vec) -> Shape:
    """The symbol of a stop that is touched at a place."""
    return SYMBOLS["end_stop"](at=at, toward=toward, size=7.0)


def touches(machine: DrawnMechanism) -> Iterator[Touch]:
    """Where the stops are that can be drawn."""
    for stop in machine.motion.mechanism.stops.values():
        row = machine.motion.read(stop.of)
        if not np.isfinite(row).any():
            continue
        found = _touch(machine, stop, int(np.nanargmin(np.abs(row - stop.at))), 1.0 if stop.side == "above" else -1.0)
        if found is not None:
            yield found


def _touch(machine: DrawnMechanism, stop: Stop, near: int, sign: float) -> Touch | None:
    """``near``: the position that comes nearest to the stop; ``sign``: of the side on which it lies."""
    match stop.of.kind:
        case "position":
            return _of_point(machine, stop, near, sign)
        case "displacement":
            return _of_guide(machine, stop, near, sign)
        case "angle" | "turned_angle":
            return _of_link(machine, stop, sign)
    return None


def _of_point(machine: DrawnMechanism, stop: Stop, near: int, sign: float) -> Touch:
    """Across the axis along which the point is stopped, at the place that it comes nearest to."""
    x, y = machine.motion.point(stop.of.owner).position[near]
    across = stop.of.component == "x"
    place = (stop.at, float(y)) if across else (float(x), stop.at)
    toward = (sign, 0.0) if across else (0.0, -sign)
    guides = (joint for joint in machine.guides.values() if joint.guide == "frame")
    guide = next((joint for joint in guides if joint.at == stop.of.owner.split(".")[-1]), None)
    gap = (PIN * toward[0], PIN * toward[1]) if guide is None else _beside(machine, guide, toward)
    return Touch(place, gap, toward)


def _of_guide(machine: DrawnMechanism, stop: Stop, near: int, sign: float) -> Touch | None:
    joint = machine.guides.get(stop.of.owner)
    if joint is None or joint.guide != "frame":
        return None
    c, s = math.cos(joint.direction), math.sin(joint.direction)
    left = stop.at - float(machine.motion.read(stop.of)[near])
    point = machine.motion.mechanism.link(joint.block).points[joint.at]
    x, y = machine.placed[joint.block].world(point)[near]
    toward = (sign * c, -sign * s)
    return Touch((float(x) + left * c, float(y) + left * s), _beside(machine, joint, toward), toward)


def _of_link(machine: DrawnMechanism, stop: Stop, sign: float) -> Touch | None:
    """Beside the place of the link where it is stopped."""
    pin = _pin(machine, stop.of.owner, "frame")
    ways = [] if pin is None else machine.directions(stop.of.owner, pin)
    if pin is None or not ways:
        return None
    here = machine.local(stop.of.owner, pin)
    reach = max(math.dist(here, (x, y)) for x, y in machine.cloud(stop.of.owner))
    angle = stop.at - math.atan2(ways[0][1], ways[0][0])
    c, s, far = math.cos(angle), math.sin(angle), max(OUTWARDS * reach, min(LEAST, reach)) / machine.view.scale
    x, y = machine.motion.mechanism.link("frame").points[pin]
    toward = (-sign * s, -sign * c)
    return Touch((x + far * c, y + far * s), (2.0 * toward[0], 2.0 * toward[1]), toward)


def _beside(machine: DrawnMechanism, joint: SlidingJoint, toward: Vec) -> Vec:
    """From a block's point to its end, next to the ground and clear of what is pinned to the block."""
    x, y = direction(machine, joint)
    off = ground_side(machine, joint) * (HEIGHT / 2 - ABOVE)
    return LENGTH / 2 * toward[0] - off * y, LENGTH / 2 * toward[1] + off * x
