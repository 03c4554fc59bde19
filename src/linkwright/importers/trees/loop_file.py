"""What closes the loops of a URDF robot: ``loop_joint`` elements, and the file NAME.loops.yaml beside the robot.

The file is ``{format: 1, loops: […], drivers: […]}``. Each loop has a ``name``, a ``type`` (revolute, prismatic,
fixed), the ends ``link1`` and ``link2`` as ``{link, xyz, rpy}`` and, prismatic, an ``axis`` in the axes of the first
end; or it is ``coupled`` with ``joints``, factors by names: Σ factor · coordinate stays what it is with all joints
at 0. A driver has a ``joint`` with its ``speed`` (rad/s or m/s), or with ``time`` (s) and ``position``.
``mimic: implied``: what mimics others in the robot follows from these loops.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from linkwright.importers.json_tree import Json
from linkwright.importers.layout import Remarks
from linkwright.importers.trees.plane import INCLINED, Frame, Plane
from linkwright.importers.trees.tree import Coupling, Motor, Part, Pin, Tree, TreeJoint, Weld
from linkwright.importers.trees.urdf_model import ZERO, UrdfModel
from linkwright.importers.xml_tree import Element
from linkwright.words import _

#: Types of loop closures that a plane has.
PINNED = ("revolute", "continuous", "spherical")
TYPES = (*PINNED, "prismatic", "fixed")


@dataclass
class LoopEnd:
    """An end of a loop's joint on a link."""

    link: str
    xyz: list[float]
    rpy: list[float]


@dataclass
class LoopJoint:
    """A joint that closes a loop; ``line`` in its file."""

    name: str
    kind: str
    ends: tuple[LoopEnd, LoopEnd]
    axis: list[float] = field(default_factory=lambda: [1.0, 0.0, 0.0])
    line: int = 0


def loops_of_robot(model: UrdfModel) -> list[LoopJoint]:
    """The ``loop_joint`` elements of the robot itself, as Isaac Sim reads them."""
    found = []
    for element in model.root.all("loop_joint"):
        ends = [_end(model, element.first(each)) for each in ("link1", "link2")]
        found.append(LoopJoint(element.get("name"), element.get("type"), (ends[0], ends[1]), line=element.line))
    return found


def _end(model: UrdfModel, element: Element | None) -> LoopEnd:
    link = "" if element is None else element.get("link")
    return LoopEnd(link, model.numbers(element, "xyz", ZERO), model.numbers(element, "rpy", ZERO))


def loops_of_file(root: Json) -> list[LoopJoint]:
    """The loops of a file beside the robot but those that are coupled."""
    found = []
    for each in root.each("loops"):
        if each.text("type") != "coupled":
            ends = [_written_end(each.get(key)) for key in ("link1", "link2")]
            axis = [one.value for one in each.each("axis")] or [1.0, 0.0, 0.0]
            line = each.node.line + 1
            found.append(LoopJoint(each.text("name"), each.text("type"), (ends[0], ends[1]), axis, line))
    return found


def _written_end(end: Json | None) -> LoopEnd:
    if end is None:
        return LoopEnd("", list(ZERO), list(ZERO))
    xyz, rpy = ([each.value for each in end.each(key)] or list(ZERO) for key in ("xyz", "rpy"))
    return LoopEnd(end.text("link"), xyz, rpy)


def couplings_of_file(root: Json) -> list[Coupling]:
    """The coupled joints of a file beside the robot."""
    return [
        Coupling(each.text("name"), {name: one.value for name, one in each.entries("joints").items()})
        for each in root.each("loops")
        if each.text("type") == "coupled"
    ]


def motors_of_file(root: Json) -> list[Motor]:
    """The drivers of a file beside the robot."""
    found = []
    for each in root.each("drivers"):
        name, joint = each.text("name", "driver"), each.text("joint")
        times, values = ([one.value for one in each.each(key)] for key in ("time", "position"))
        table = (times, values) if times and len(times) == len(values) else None
        speed = each.number("speed") if "speed" in each else None
        found.append(Motor(name, joint, speed, table))
    return found


def add_loops(model: UrdfModel, tree: Tree, plane: Plane, loops: list[LoopJoint], remarks: Remarks) -> None:
    """Adds loop joints to a tree; errors are among the remarks of their file."""
    for loop in loops:
        known = all(end.link in model.links for end in loop.ends)
        if loop.kind not in TYPES or not known or any(len(end.xyz) != 3 or len(end.rpy) != 3 for end in loop.ends):
            message = _("the loop {name} names a link or a type that there is not", name=loop.name)
            remedy = _("give type as one of {names}, and two links with xyz and rpy", names=TYPES)
            remarks.remark("error", message, remedy, "import.urdf_loop", line=loop.line, key=loop.name)
            continue
        frames = [model.frames[end.link].then(end.xyz, end.rpy) for end in loop.ends]
        if not _planar(plane, loop, (frames[0], frames[1])):
            message = _("the loop {name} turns or slides out of the plane", name=loop.name)
            remedy = _("turn the axes of its ends about the normal of the plane alone")
            remarks.remark("error", message, remedy, "import.urdf_loop_plane", line=loop.line, key=loop.name)
            continue
        _add(model, tree, plane, loop, (frames[0], frames[1]))


def _planar(plane: Plane, loop: LoopJoint, frames: tuple[Frame, Frame]) -> bool:
    """Whether a weld or a slide stays in the plane; a pin does, whatever its axes are."""
    if loop.kind in PINNED:
        return True
    turned = abs(plane.place(frames[0].turn @ frames[1].turn.T @ plane.right))
    along = abs(plane.place(frames[0].turn @ loop.axis)) if len(loop.axis) == 3 else 0.0
    length = math.hypot(*loop.axis)
    return abs(turned - 1.0) < INCLINED and (loop.kind == "fixed" or abs(along - length) < INCLINED * length)


def _add(model: UrdfModel, tree: Tree, plane: Plane, loop: LoopJoint, frames: tuple[Frame, Frame]) -> None:
    a, b = (model.part_name(end.link) for end in loop.ends)
    places = [plane.place(frame.origin) for frame in frames]
    if loop.kind in PINNED:
        tree.pins.append(Pin(loop.name, a, b, places[0], places[1], loop.line))
        return
    step = frames[0].turn @ frames[1].turn.T
    turn = plane.place(step @ plane.right)
    turn /= abs(turn)
    if loop.kind == "prismatic":
        rider = f"{loop.name}.rider"
        along = plane.along(frames[0].turn @ loop.axis)
        tree.parts[rider] = Part(rider, centre=places[0], between=True)
        name = rider if loop.name in tree.joints else loop.name
        tree.joints[name] = TreeJoint(name, a, rider, slides=along, line=loop.line)
        a = rider
    tree.welds.append(Weld(a, b, turn, places[0] - turn * places[1]))
