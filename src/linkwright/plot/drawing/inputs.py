"""Arrows at what is driven."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from linkwright.drivers.base import Driver
from linkwright.kinematics.placement import Placement
from linkwright.pictures.symbols.base import SYMBOLS
from linkwright.pictures.symbols.joints import HEIGHT
from linkwright.plot.drawing.guides import block_direction, direction, ground_side, is_cylinder, travel
from linkwright.plot.drawing.machine import Machine, Part, support_direction

RADIUS = 21.0


def input_arrows(machine: Machine, index: int) -> Iterator[Part]:
    """An arrow for every driver, for the position ``index``."""
    for driver in machine.motion.mechanism.drivers.values():
        if machine.motion.mechanism.joints[driver.joint].coordinate == "slide":
            yield _slide(machine, driver, index)
        else:
            yield _turn(machine, driver, index)


def sense(machine: Machine, driver: Driver) -> int:
    """+1 or -1 where the driver keeps its sense over the motion, 0 where it goes to and fro."""
    rate = machine.motion.positions.coordinates[driver.name][1]
    largest = float(np.max(np.abs(rate), initial=0.0))
    signs = {int(np.sign(r)) for r in rate if abs(r) > 1e-6 * largest}
    return signs.pop() if len(signs) == 1 else 0


def _turn(machine: Machine, driver: Driver, index: int) -> Part:
    base = driver.relative_to
    at = machine.local(base, driver.joint)
    turn = _turned(machine.placed[base], index)
    middle = _free_angle(machine, driver.joint, index) - turn
    on_block = any(
        driver.joint == j.at and j.block in machine.pins[driver.joint].links for j in machine.guides.values()
    )
    arrow = SYMBOLS["crank_arrow"](
        at=at, radius=RADIUS + 6.0 * on_block, middle=middle, sweep=1.9, turning=sense(machine, driver)
    )
    return Part("marks", base, arrow)


def _slide(machine: Machine, driver: Driver, index: int) -> Part:
    joint = machine.guides[driver.joint]
    way = sense(machine, driver)
    if is_cylinder(machine, driver.joint):
        along, at = direction(machine, joint), machine.local(joint.guide, joint.through)
        middle, carrier, side = 0.45 * travel(machine, driver.joint)[0], joint.guide, -16.0
    else:
        along, at = block_direction(joint), machine.local(joint.block, joint.at)
        middle, carrier = 0.0, joint.block
        side = -(ground_side(machine, joint) if joint.guide == "frame" else 1) * (HEIGHT / 2 + 11.0)
    place = (at[0] + middle * along[0] - side * along[1], at[1] + middle * along[1] + side * along[0])
    forward = along if way >= 0 else (-along[0], -along[1])
    return Part("marks", carrier, SYMBOLS["slide_arrow"](at=place, along=forward, both=way == 0))


def _free_angle(machine: Machine, pin: str, index: int) -> float:
    """The direction on the paper in which an arc about a pin is farthest from the links and the support."""
    joint = machine.pins[pin]
    taken = [math.atan2(way[1], way[0]) + _turned(machine.placed[link], index)
             for link in joint.links if link != "frame" for way in machine.directions(link, pin)]  # fmt: skip
    if "frame" in joint.links:
        x, y = support_direction(machine, pin, joint)
        taken.append(math.atan2(y, x))
    angles = np.radians(np.arange(0, 360, 15) - 45.0)
    if not taken:
        return float(angles[0])
    gaps = np.abs((angles[:, None] - np.array(taken)[None, :] + np.pi) % (2 * np.pi) - np.pi)
    return float(angles[int(np.argmax(gaps.min(axis=1)))])


def _turned(placement: Placement, index: int) -> float:
    c, s = placement.direction[index]
    return -math.atan2(s, c)
