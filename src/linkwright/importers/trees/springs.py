"""Springs and dampers of joints and of tendons as loads."""

from __future__ import annotations

import math

from linkwright.core.data import Plain
from linkwright.importers.model_text import DEGREE, Writer, shortest
from linkwright.importers.trees.placed import Placed
from linkwright.importers.trees.points import Point
from linkwright.importers.trees.tree import Tether, TreeJoint
from linkwright.units import number

#: A point of a tether on each of its two parts.
Ends = tuple[Tether, Point, Point]
#: How far behind a slide the anchor of its spring is, as a share of the machine's size.
BEHIND = 1.5


def anchored(made: Placed, joint: TreeJoint, at: Point) -> Ends:
    """The spring and damper of a slide: between the block's point and an anchor of the guide far behind it, where a
    spring along the guide is linear in the displacement as the slide's own one."""
    guide, block = made.group(joint.parent), made.group(joint.child)
    inside = made.groups.inside[joint.parent]
    length = BEHIND * made.size + max(0.0, joint.rest - (joint.low or 0.0), joint.rest)
    place = inside(made.groups.inside[joint.child].back(at.places[block]))
    anchor = place + inside.turn * (joint.slides or 1) * (joint.rest - length)
    name = f"{joint.name}_spring" if joint.stiffness else f"{joint.name}_damper"
    tether = Tether(name, joint.parent, joint.child, 0j, 0j, joint.stiffness, length, joint.damping)
    return tether, made.points.alone(f"{joint.name}_anchor", guide, anchor), at


def add_springs(made: Placed, tethers: list[Ends]) -> None:
    """Loads for the springs and dampers of hinges, and for those between points."""
    writer = Writer(made.layout)
    for joint in made.moving:
        if joint.turns is not None and (joint.stiffness or joint.damping):
            made.layout.loads |= _torsion(made, joint, writer)
    for tether, a, b in tethers:
        ends = [f"{made.body(part)}.{made.named[id(point)]}" for part, point in ((tether.a, a), (tether.b, b))]
        if tether.stiffness:
            length = writer.length(tether.free_length)
            spring = {"kind": "spring", "between": ends, "stiffness": f"{number(tether.stiffness)} N/m"}
            made.layout.loads[tether.name] = {**spring, "free_length": length}
        if tether.damping:
            damper = {"kind": "damper", "between": ends, "damping": f"{number(tether.damping)} N·s/m"}
            made.layout.loads[f"{tether.name}_damper" if tether.stiffness else tether.name] = damper


def _torsion(made: Placed, joint: TreeJoint, writer: Writer) -> Plain:
    """Loads of a hinge's spring and damper."""
    links = [made.body(joint.parent), made.body(joint.child)]
    found: Plain = {}
    if joint.stiffness:
        start = math.remainder(writer.axis(links[1]) - writer.axis(links[0]), 2 * math.pi)
        free = start + joint.sense * (joint.rest - joint.moved)
        spring = {"kind": "torsion_spring", "links": links, "stiffness": f"{number(joint.stiffness)} N·m/rad"}
        found[f"{joint.name}_spring"] = {**spring, "free_angle": f"{shortest(free / DEGREE, 1e-12)} deg"}
    if joint.damping:
        damper = {"kind": "torsion_damper", "links": links, "damping": f"{number(joint.damping)} N·m·s/rad"}
        found[f"{joint.name}_damper"] = damper
    return found
