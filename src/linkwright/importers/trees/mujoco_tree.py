"""The planar tree of a compiled MuJoCo model."""

from __future__ import annotations

from linkwright.importers.trees.mujoco_closures import Closures
from linkwright.importers.trees.mujoco_model import MujocoModel
from linkwright.importers.trees.mujoco_motors import add_motors
from linkwright.importers.trees.plane import plane_of
from linkwright.importers.trees.tree import Tree


def mujoco_tree(read: MujocoModel) -> Tree | None:
    """The tree with its closures and motors; None, with an error among the remarks, where the model is spatial."""
    if not read.leave_out():
        return None
    plane = plane_of(list(read.axes()), read.remarks)
    if plane is None:
        return None
    read.plane = plane
    tree = Tree(read.title(), gravity=read.gravity())
    for body in read.bodies():
        for joint in read.part(tree, body):
            tree.joints[joint.name] = joint
    tree.marks = read.marks(0)
    read.start(tree)
    Closures(read, tree).add()
    add_motors(read, tree)
    return tree
