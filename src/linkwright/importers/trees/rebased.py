"""The tree of the same robot with another part as its frame."""

from __future__ import annotations

from dataclasses import replace

from linkwright.importers.layout import Remarks
from linkwright.importers.trees.tree import WORLD, Part, Tree
from linkwright.words import _


def held_at(tree: Tree, fixed: str | None, base: str, remarks: Remarks) -> Tree:
    """A tree with the link as its frame that the user names; ``base``: the name of the link that is the frame now.

    An error among the remarks where there is no such link.
    """
    if fixed is None or fixed == base:
        return tree
    if fixed not in tree.parts:
        message = _("there is no link {name} that could be the frame", name=fixed)
        remedy = _("name one of {names}", names=tuple(each for each, part in tree.parts.items() if not part.between))
        remarks.remark("error", message, remedy, "import.no_such_frame")
        return tree
    return rebased(tree, fixed)


def rebased(tree: Tree, base: str) -> Tree:
    """A tree that is held at a part, with the joints from there to the world turned round."""
    above = {joint.child: joint for joint in tree.joints.values()}
    path, part = [], base
    while part != WORLD:
        path.append(above[part])
        part = above[part].parent
    old = "base"
    while old in tree.parts:
        old += "_link"

    def named(part: str) -> str:
        return old if part == WORLD else WORLD if part == base else part

    turned = {joint.name for joint in path}
    joints = {}
    for joint in path:
        slides = None if joint.slides is None else -joint.slides
        parent, child = named(joint.child), named(joint.parent)
        joints[joint.name] = replace(joint, parent=parent, child=child, sense=-joint.sense, slides=slides)
    left = [joint for joint in tree.joints.values() if joint.name not in turned]
    placed = {WORLD, *(joint.child for joint in joints.values())}
    while left:
        following = [joint for joint in left if named(joint.parent) in placed]
        for joint in following:
            joints[joint.name] = replace(joint, parent=named(joint.parent), child=named(joint.child))
            placed.add(named(joint.child))
        left = [joint for joint in left if joint not in following]
    parts = {named(name): part for name, part in tree.parts.items() if name != base}
    parts = {old: Part(old, marks=tree.marks), **parts}
    pins = [replace(pin, a=named(pin.a), b=named(pin.b)) for pin in tree.pins]
    welds = [replace(weld, a=named(weld.a), b=named(weld.b)) for weld in tree.welds]
    tethers = [replace(each, a=named(each.a), b=named(each.b)) for each in tree.tethers]
    return replace(
        tree, parts=parts, joints=joints, pins=pins, welds=welds, tethers=tethers, marks=tree.parts[base].marks
    )
