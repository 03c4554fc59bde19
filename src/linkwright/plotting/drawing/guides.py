"""Guides, blocks, cylinders and welds of a mechanism's drawing; arrows at what is driven."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.drivers.base import Driver
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.kinematics.placement import Placement
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import SYMBOLS, points
from linkwright.pictures.symbols.machine import HEIGHT, LENGTH
from linkwright.plotting.drawing.machine import DrawnMechanism, Part, support_direction

STUB = 8.0


def guides(machine: DrawnMechanism) -> Iterator[Part]:
    """All prismatic joints."""
    for name, joint in machine.guides.items():
        if is_cylinder(machine, name):
            yield from _cylinder(machine, name, joint)
        else:
            yield from _block_on_guide(machine, name, joint)


def direction(machine: DrawnMechanism, joint: SlidingJoint) -> Vec:
    """Direction of a guide on its link's piece of paper."""
    angle = joint.direction
    return math.cos(angle), -math.sin(angle)


def block_direction(joint: SlidingJoint) -> Vec:
    """Direction of a guide on its block's piece of paper."""
    return math.cos(joint.block_angle), -math.sin(joint.block_angle)


def travel(machine: DrawnMechanism, name: str) -> tuple[float, float]:
    """Smallest and largest displacement of a block at all positions that are drawn, in units of the paper."""
    joint, link = machine.guides[name], machine.motion.mechanism.link
    guide, block = machine.placed[joint.guide], machine.placed[joint.block]
    way = block.world(link(joint.block).points[joint.at]) - guide.world(link(joint.guide).points[joint.through])
    angle = joint.direction
    axis = Placement(np.zeros_like(guide.origin), guide.direction).world((math.cos(angle), math.sin(angle)))
    s = (way * axis).sum(axis=1) * machine.view.scale
    return float(np.nanmin(s)), float(np.nanmax(s))


def line_start(machine: DrawnMechanism, joint: SlidingJoint) -> Vec:
    """Where the block's point is at displacement zero, on the piece of paper of the guide's link."""
    x, y = machine.local(joint.guide, joint.through)
    along = direction(machine, joint)
    left = joint.offset * machine.view.scale
    return x + left * along[1], y - left * along[0]


def is_cylinder(machine: DrawnMechanism, name: str) -> bool:
    """Whether a guide joins two links that have nothing but a pin each: a telescopic cylinder."""
    joint = machine.guides[name]
    ends = ((joint.guide, joint.through), (joint.block, joint.at))
    mechanism = machine.motion.mechanism
    bare = all(link != "frame" and len(mechanism.link(link).points) == 1 for link, _ in ends)
    pinned = all(point in machine.pins and link in machine.pins[point].links for link, point in ends)
    others = [j for j in machine.guides.values() if j is not joint]
    used = any(link in j.joined for j in others for link, _ in ends)
    return bare and pinned and not used and joint.offset == 0 and travel(machine, name)[0] > 40.0


def _cylinder(machine: DrawnMechanism, name: str, joint: SlidingJoint) -> Iterator[Part]:
    short, longest = travel(machine, name)
    length = max(0.8 * short, min(0.62 * longest, 0.94 * short))
    piston = max(longest - 0.92 * length, short - length + 10.0)
    at = machine.local(joint.guide, joint.through)
    rod = SYMBOLS["piston"](at=machine.local(joint.block, joint.at), along=block_direction(joint), length=piston)
    yield Part("bodies", joint.block, rod)
    yield Part("blocks", joint.guide, SYMBOLS["barrel"](at=at, along=direction(machine, joint), length=length))


def _block_on_guide(machine: DrawnMechanism, name: str, joint: SlidingJoint) -> Iterator[Part]:
    at, along = machine.local(joint.block, joint.at), block_direction(joint)
    shift = clear_shift(machine, name, joint)
    place = (at[0] + shift * along[0], at[1] + shift * along[1])
    low, high = travel(machine, name)
    start, way = line_start(machine, joint), direction(machine, joint)
    if joint.guide == "frame":
        ends = (low + shift - LENGTH / 2 - STUB, high + shift + LENGTH / 2 + STUB)
        rail = SYMBOLS["ground_guide"](
            at=start, along=way, start=ends[0], end=ends[1], side=ground_side(machine, joint)
        )
        yield Part("ground", "frame", rail)
    else:
        yield from _rod(machine, joint, low, high)
    if shift:
        yield Part("bodies", joint.block, SYMBOLS["bar"](through=[at, place]))
    yield Part("blocks", joint.block, SYMBOLS["slider"](at=place, along=along))


def _rod(machine: DrawnMechanism, joint: SlidingJoint, low: float, high: float) -> Iterator[Part]:
    """The line of a guide on a moving link, long enough for the full travel, and its tie to the link."""
    start, way = line_start(machine, joint), direction(machine, joint)
    through = machine.local(joint.guide, joint.through)
    named = (machine.local(joint.guide, point) for point in joint.direction_points or ())
    reach = [(x - through[0]) * way[0] + (y - through[1]) * way[1] for x, y in named]
    ends = (low - LENGTH / 2 - STUB, high + LENGTH / 2 + STUB)
    if joint.offset or len(machine.motion.mechanism.link(joint.guide).points) > 1:
        reach.append(0.0)
    rod = SYMBOLS["moving_guide"](at=start, along=way, start=min(*ends, *reach), end=max(*ends, *reach))
    yield Part("bodies", joint.guide, rod)
    if joint.offset:
        yield Part("bodies", joint.guide, SYMBOLS["bar"](through=[through, start]))


def ground_side(machine: DrawnMechanism, joint: SlidingJoint) -> int:
    """The side of a fixed guide that faces away from the rest of the machine; below where there is none."""
    x, y = line_start(machine, joint)
    way = direction(machine, joint)
    right = np.array([-way[1], way[0]])
    clouds = [
        machine.view.paper(machine.placed[link].world(p))
        for link in machine.motion.mechanism.links
        if link != joint.block
        for p in machine.motion.mechanism.links[link].points.values()
    ]
    everything = np.concatenate(clouds) if clouds else np.zeros((1, 2))
    mean = float(np.nanmean((everything - (x, y)) @ right))
    if abs(mean) < 4.0:
        return 1 if right[1] > 1e-9 or (abs(right[1]) <= 1e-9 and right[0] > 0) else -1
    return -1 if mean > 0 else 1


def clear_shift(machine: DrawnMechanism, name: str, joint: SlidingJoint) -> float:
    """How far along its guide a block is drawn from its point, clear of fixed pivots and other blocks."""
    if joint.guide != "frame":
        return 0.0
    low, high = travel(machine, name)
    start, way = np.array(line_start(machine, joint)), np.array(direction(machine, joint))
    across = np.array([-way[1], way[0]])

    def on_line(cloud: Floats) -> Floats:
        relative = cloud - start
        near: Floats = relative[np.abs(relative @ across) < HEIGHT] @ way
        return near

    mechanism = machine.motion.mechanism
    own = {joint.at, *mechanism.link(joint.block).points}
    pins = {p: j.links for p, j in machine.pins.items() if p not in own}
    fixed = on_line(points([machine.local("frame", p) for p, links in pins.items() if "frame" in links]))
    if not ((fixed > low - LENGTH / 2) & (fixed < high + LENGTH / 2)).any():
        return 2.2 * LENGTH if _on_other_block(machine, joint) else 0.0
    moving = [
        machine.view.paper(machine.placed[links[0]].world(mechanism.link(links[0]).points[p]))
        for p, links in pins.items()
    ]
    return float(np.nanmax(on_line(np.concatenate(moving)))) - low + 0.9 * LENGTH


def _on_other_block(machine: DrawnMechanism, joint: SlidingJoint) -> bool:
    """Whether the block of another guide is drawn at the same place."""
    pin = machine.pins.get(joint.at)
    together = {joint.block} if pin is None or joint.block not in pin.links else set(pin.links)
    others = (each for each in machine.guides.values() if each is not joint and each.guide != "frame")
    return any(each.at == joint.at and each.block in together for each in others)


def welds(machine: DrawnMechanism) -> Iterator[Part]:
    """Welds between links, and of links to the ground."""
    for joint in machine.motion.mechanism.welds.values():
        a, b = joint.links
        at = machine.local(b, joint.at)
        second = _towards(machine, b, joint.at)
        c, s = math.cos(joint.angle), math.sin(joint.angle)
        x, y = _towards(machine, a, joint.at)
        first = (c * x - s * y, s * x + c * y)
        if "frame" in joint.links:
            moving = b if a == "frame" else a
            away = _towards(machine, moving, joint.at)
            place = machine.local(moving, joint.at)
            yield Part("ground", moving, SYMBOLS["wall"](at=place, toward=(-away[0], -away[1])))
        else:
            yield Part("tops", b, SYMBOLS["weld"](at=at, first=first, second=second))


def _towards(machine: DrawnMechanism, link: str, point: str) -> Vec:
    """Direction from a point to the rest of its link."""
    ways = machine.directions(link, point)
    x, y = sum(w[0] for w in ways), sum(w[1] for w in ways)
    length = math.hypot(x, y)
    return (x / length, y / length) if length > 1e-9 else (1.0, 0.0)


RADIUS = 21.0


def input_arrows(machine: DrawnMechanism, index: int) -> Iterator[Part]:
    """An arrow for every driver, for the position ``index``."""
    for driver in machine.motion.mechanism.drivers.values():
        if machine.motion.mechanism.joints[driver.joint].coordinate == "slide":
            yield _slide(machine, driver, index)
        else:
            yield _turn(machine, driver, index)


def sense(machine: DrawnMechanism, driver: Driver) -> int:
    """+1 or -1 where the driver keeps its sense over the motion, 0 where it goes to and fro."""
    rate = machine.motion.positions.coordinates[driver.name][1]
    largest = float(np.max(np.abs(rate), initial=0.0))
    signs = {int(np.sign(r)) for r in rate if abs(r) > 1e-6 * largest}
    return signs.pop() if len(signs) == 1 else 0


def _turn(machine: DrawnMechanism, driver: Driver, index: int) -> Part:
    base = driver.relative_to
    at = machine.local(base, driver.joint)
    turn = turned(machine.placed[base], index)
    middle = free_angle(machine, driver.joint, index) - turn
    on_block = any(
        driver.joint == j.at and j.block in machine.pins[driver.joint].links for j in machine.guides.values()
    )
    arrow = SYMBOLS["crank_arrow"](
        at=at, radius=RADIUS + 6.0 * on_block, middle=middle, sweep=1.9, turning=sense(machine, driver)
    )
    return Part("marks", base, arrow)


def _slide(machine: DrawnMechanism, driver: Driver, index: int) -> Part:
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


def free_angle(machine: DrawnMechanism, pin: str, index: int, used: Sequence[float] = ()) -> float:
    """The direction on the paper in which an arc about a pin is farthest from the links, the support and directions
    that are ``used``."""
    joint = machine.pins[pin]
    taken = [
        *used,
        *(
            math.atan2(way[1], way[0]) + turned(machine.placed[link], index)
            for link in joint.links
            if link != "frame"
            for way in machine.directions(link, pin)
        ),
    ]
    if "frame" in joint.links:
        x, y = support_direction(machine, pin, joint)
        taken.append(math.atan2(y, x))
    angles = np.radians(np.arange(0, 360, 15) - 45.0)
    if not taken:
        return float(angles[0])
    gaps = np.abs((angles[:, None] - np.array(taken)[None, :] + np.pi) % (2 * np.pi) - np.pi)
    return float(angles[int(np.argmax(gaps.min(axis=1)))])


def turned(placement: Placement, index: int) -> float:
    """How far a link's piece of paper is turned at a position, clockwise, rad."""
    c, s = placement.direction[index]
    return -math.atan2(s, c)
