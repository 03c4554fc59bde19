"""Springs, dampers, torques and forces of the model as symbols, without scale."""

from __future__ import annotations

import math
from collections.abc import Sequence

from linkwright.actuators.base import AlongLine
from linkwright.applied_loads.base import LinkPoint, Load
from linkwright.joints.base import JointName
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import SvgNode, Vec
from linkwright.pictures.symbols.base import EMPTY, SYMBOLS, Shape, joined
from linkwright.pictures.symbols.machine import HEIGHT, LENGTH
from linkwright.plotting.drawing.cylinders import linear
from linkwright.plotting.drawing.guides import clear_shift, is_cylinder
from linkwright.plotting.drawing.machine import DrawnMechanism, Press, Push, Turn, mark_of
from linkwright.plotting.drawing.moving import moving_lines
from linkwright.plotting.drawing.scene import LINK_SIZE, Scene

PUSH = 52.0
GAP, BLOCK_GAP = 7.0, 19.0


def load_marks(machine: DrawnMechanism, index: int, *, forces: bool = True) -> Shape:
    """The symbols of all loads at one position, on the paper, and of actuators along a line; ``forces``: forces and
    torques among them."""
    loads = [mark(machine, load, index, forces) for load in machine.motion.mechanism.loads.values()]
    return joined(
        [*loads, *(linear(machine, each, index) + anchors(machine, each, index) for each in _linear(machine))]
    )


def _linear(machine: DrawnMechanism) -> list[AlongLine]:
    """The actuators along a line."""
    found = (each for each in machine.motion.mechanism.actuators.values() if isinstance(each, AlongLine))
    return [each for each in found if each.between is not None or each.along is not None]


def mark(machine: DrawnMechanism, load: Load, index: int, forces: bool = True) -> Shape:
    """The symbol of one load: of forces and torques an arrow, else the one of its kind or the general one."""
    shown = machine.mark(load, index)
    if shown is not None and not forces:
        return EMPTY
    match shown:
        case Turn():
            at = _middle(machine, shown.link, index)
            return SYMBOLS["moment"](at=at, turning=shown.sense, style="lw-load")
        case Push():
            return _push(machine, shown, index)
        case Press():
            return _pressed(machine, shown, index)
    return _held(machine, load, index) + anchors(machine, load, index)


def _held(machine: DrawnMechanism, load: Load, index: int) -> Shape:
    """The symbol of a load that lies between points, about a pin or at a place, by what the load names."""
    ends = [machine.paper(each.link, each.point, index) for each in named_points(machine, load)]
    links = load.pair or ((load.acts_on,) if load.acts_on else ())
    pin = None if ends or len(links) != 2 else _common_pin(machine, (links[0], links[1]), index)
    if load.kind in SYMBOLS and len(ends) == 2:
        return SYMBOLS[load.kind](start=ends[0], end=ends[1])
    place = ends[0] if ends else pin or (_middle(machine, links[0], index) if links else None)
    if place is None:
        return EMPTY
    if load.kind in SYMBOLS:
        return SYMBOLS[load.kind](at=place)
    return SYMBOLS["general_load"](at=place, ends=tuple(ends[:2]))


def named_points(machine: DrawnMechanism, load: Load) -> list[LinkPoint]:
    """The points that a load of any kind names in its fields, and those of the joints that it names."""
    joints = [
        value for _, each, value in load.fields_with_values() if isinstance(each, JointName) and value is not None
    ]
    return [*load.named_points, *(_joint_point(machine, name) for name in joints)]


def _joint_point(machine: DrawnMechanism, name: str) -> LinkPoint:
    joint = machine.motion.mechanism.joints[name]
    return LinkPoint(joint.joined[-1], getattr(joint, "at", name))


def load_labels(machine: DrawnMechanism, index: int, *, forces: bool = True) -> list[Label]:
    """Names of the loads that push, and of those that have the general symbol."""
    found = []
    for name, load in machine.motion.mechanism.loads.items():
        pushes = machine.mark(load, index) is not None
        shape = mark(machine, load, index, forces)
        if shape.ink and (pushes or load.kind not in SYMBOLS):
            line = shape.ink[0]
            places = tuple((float(x), float(y)) for x, y in (line[0], line[len(line) // 2]))
            found.append(Label(name, places, "lw-load-name", LINK_SIZE, 9.0))
    return found


def unmarked(machine: DrawnMechanism, index: int) -> list[str]:
    """Names of the loads of which there is nothing to draw, as they name neither a point nor a link."""
    loads = machine.motion.mechanism.loads
    return [name for name, load in loads.items() if mark(machine, load, index) == EMPTY]


def anchors(machine: DrawnMechanism, load: Load, index: int) -> Shape:
    """The walls that hold what lies between two points, at points of the frame where no pin is."""
    between = named_points(machine, load)
    if len(between) != 2:
        return EMPTY
    start, end = (machine.paper(each.link, each.point, index) for each in between)
    return joined(_anchor(machine, each, start, end, index) for each in between)


def _anchor(machine: DrawnMechanism, end: LinkPoint, first: Vec, last: Vec, index: int) -> Shape:
    if end.link != "frame" or end.point in machine.pins:
        return EMPTY
    at = machine.paper(end.link, end.point, index)
    other = last if math.dist(at, first) < math.dist(at, last) else first
    length = math.dist(at, other) or 1.0
    return SYMBOLS["wall"](at=at, toward=((at[0] - other[0]) / length, (at[1] - other[1]) / length), size=12.0)


def _push(machine: DrawnMechanism, push: Push, index: int) -> Shape:
    """An arrow whose point is where the force acts."""
    way = (math.cos(push.angle), -math.sin(push.angle))
    x, y = machine.paper(push.link, push.at, index)
    on_block = any(j.block == push.link and j.at == push.at for j in machine.guides.values())
    gap = BLOCK_GAP if on_block else GAP
    tip = (x - gap * way[0], y - gap * way[1])
    return SYMBOLS["arrow"](start=(tip[0] - PUSH * way[0], tip[1] - PUSH * way[1]), end=tip, style="lw-load")


def _pressed(machine: DrawnMechanism, press: Press, index: int) -> Shape:
    """Arrows on the face of the block on which a pressure pushes; one arrow at the end of a cylinder's rod."""
    joint = machine.guides[press.joint]
    c, s = machine.placed[joint.guide].direction[index]
    angle = math.atan2(s, c) + joint.direction
    at = machine.paper(joint.block, joint.at, index)
    return pressing(machine, press, at, (math.cos(angle), -math.sin(angle)))


def pressing(machine: DrawnMechanism, press: Press, at: Vec, along: Vec) -> Shape:
    """The symbol of a pressure on a block whose point is ``at`` and whose guide leads ``along``, on the paper."""
    joint, sign = machine.guides[press.joint], press.sense
    way = (sign * along[0], sign * along[1])
    x, y = at
    if is_cylinder(machine, press.joint):
        return SYMBOLS["arrow"](start=(x - PUSH * way[0], y - PUSH * way[1]), end=(x, y), style="lw-load")
    shift = clear_shift(machine, press.joint, joint) - sign * LENGTH / 2
    face = (x + shift * along[0], y + shift * along[1])
    return SYMBOLS["pressure"](at=face, along=way, height=HEIGHT)


def moving_springs(scene: Scene, run: Sequence[int], seconds: float) -> list[SvgNode]:
    """Springs, dampers and cylinders that follow their ends over the frames."""
    found: list[SvgNode] = []
    for load in scene.machine.motion.mechanism.loads.values():
        if mark_of(load, scene.machine.motion, run[0]) is not None:
            continue
        shapes = [_held(scene.machine, load, index).ink for index in run]
        found += anchors(scene.machine, load, run[0]).elements
        found += [moving_lines("lw-spring", lines, seconds) for lines in zip(*shapes, strict=True)]
    for each in _linear(scene.machine):
        shapes = [linear(scene.machine, each, index).ink for index in run]
        found += anchors(scene.machine, each, run[0]).elements
        found += [moving_lines("lw-spring", lines, seconds) for lines in zip(*shapes, strict=True)]
    return found


def _common_pin(machine: DrawnMechanism, links: tuple[str, str], index: int) -> Vec | None:
    for name, joint in machine.pins.items():
        if set(links) <= set(joint.links):
            return machine.paper(links[0], name, index)
    return None


def _middle(machine: DrawnMechanism, link: str, index: int) -> Vec:
    """A pin of the link on the frame, or its mass centre."""
    for name, joint in machine.pins.items():
        if {"frame", link} <= set(joint.links):
            return machine.paper("frame", name, index)
    at = machine.placed[link].world(machine.motion.mechanism.link(link).centre)[index]
    x, y = machine.view.paper(at)
    return float(x), float(y)
