"""Springs and dampers of joints and of tendons as loads."""

from __future__ import annotations

import math

from linkwright.core.data import Plain
from linkwright.importers.model_text import DEGREE, Writer, shortest
from linkwright.importers.trees.placed import Placed
from linkwright.importers.trees.points import Point
from linkwright.importers.trees.tree import TreeJoint
from linkwright.units import number
from linkwright.words import _


def add_springs(made: Placed, tethers: list[tuple[Point, Point]]) -> None:
    """Loads for the springs and dampers of hinges, and for those between points; slides' ones are left out."""
    writer = Writer(made.layout)
    for joint in made.moving:
        if not (joint.stiffness or joint.damping):
            continue
        if joint.turns is None:
            message = _("the spring or damper of a slide is left out")
            remedy = _("write a spring between a point of the guide and one of the block")
            made.remarks.remark("warning", message, remedy, "import.slide_spring", line=joint.line, key=joint.name)
            continue
        made.layout.loads |= _torsion(made, joint, writer)
    for tether, (a, b) in zip(made.tree.tethers, tethers, strict=True):
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
