"""URDF: planar trees of links, joints that mimic others, and loops that stand beside the tree."""

from __future__ import annotations

from pathlib import Path

from linkwright.files.source import read_bytes
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.json_tree import Json, parse_json
from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.trees.loop_file import (
    add_loops,
    couplings_of_file,
    loops_of_file,
    loops_of_robot,
    motors_of_file,
)
from linkwright.importers.trees.mimic_loops import add_pins, drop_implied, mimics
from linkwright.importers.trees.motors import add_driver
from linkwright.importers.trees.plane import plane_of
from linkwright.importers.trees.rebased import held_at
from linkwright.importers.trees.tree import Motor, Tree
from linkwright.importers.trees.tree_layout import tree_layout
from linkwright.importers.trees.urdf_model import UrdfModel
from linkwright.importers.xml_tree import Element, parse_xml
from linkwright.words import _

#: Ending of the file of loops beside a robot.
BESIDE = ".loops.yaml"


def read(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    """The layout of a robot; loops are read from its ``loop_joint`` elements and from the file beside it."""
    root = parse_xml(source.text, remarks)
    if root is None or not _is_robot(root, source, remarks):
        return None
    model = UrdfModel(root, remarks)
    if not model.read():
        return None
    plane = plane_of(list(model.axes()), remarks)
    if plane is None:
        return None
    tree = model.tree(plane)
    motors = _motors(root, tree)
    add_loops(model, tree, plane, loops_of_robot(model), remarks)
    beside = _beside(source, remarks)
    if beside is not None:
        add_loops(model, tree, plane, loops_of_file(beside), beside.remarks)
        motors = motors_of_file(beside) or motors
    _close(tree, beside, remarks)
    if remarks.failed:
        return None
    add_driver(tree, motors, answers, remarks)
    tree = held_at(tree, answers.fixed, model.base, remarks)
    return None if remarks.failed else tree_layout(tree, remarks)


def recognises(source: ForeignText) -> bool:
    """Whether a text is of a robot."""
    return "<robot" in source.text


READERS.register("urdf")(ForeignFormat(_("URDF robot"), (".urdf", ".xacro"), recognises, read))


def _is_robot(root: Element, source: ForeignText, remarks: Remarks) -> bool:
    """Whether the root is a robot without macros; False after an error."""
    if root.tag != "robot":
        message = _("the root element is <{tag}>, not <robot>", tag=root.tag)
        remarks.remark("error", message, _("give a URDF file"), "import.urdf_root", line=root.line)
        return False
    for element in root.below():
        if element.tag.startswith("xacro:") or "${" in "".join(element.attributes.values()):
            stem = source.name.split(".")[0]
            message = _("the robot is written with xacro macros, which are not expanded here")
            remedy = _("expand them: xacro {name} > {stem}.urdf", name=source.name, stem=stem)
            remarks.remark("error", message, remedy, "import.xacro", line=element.line, key=element.tag)
            return False
    return True


def _beside(source: ForeignText, remarks: Remarks) -> Json | None:
    """The file of loops beside a robot; None where there is none, or it is no mapping."""
    path = None if source.folder is None else source.folder / f"{Path(source.name).stem}{BESIDE}"
    if path is None or not path.is_file():
        return None
    own = Remarks(path.name)
    found = parse_json(read_bytes(path).decode("utf-8", errors="replace"), own)
    remarks.found += own.found
    return found


def _close(tree: Tree, beside: Json | None, remarks: Remarks) -> None:
    """What mimics others is left out where pins, or the file beside the robot, say the same.

    Without that file pins are looked for.
    """
    if beside is not None:
        remarks.found += [each for each in beside.remarks.found if each not in remarks.found]
        written = couplings_of_file(beside)
        known = {joint for each in written for joint in each.factors}
        tree.couplings = [each for each in tree.couplings if not each.factors.keys() <= known]
        if beside.text("mimic") == "implied":
            tree.couplings = []
        drop_implied(tree)
        tree.couplings += [each for each in written if each.factors.keys() <= tree.joints.keys()]
        return
    drop_implied(tree)
    found = add_pins(tree)
    if found:
        message = _(
            "points of links stay together as their joints mimic others, and are read as pins: {names}",
            names=tuple(found),
        )
        remedy = _("check that there are such pins")
        remarks.remark("note", message, remedy, "import.urdf_pins", key=found[0])


def _motors(root: Element, tree: Tree) -> list[Motor]:
    """Joints of transmissions; without any the one joint that follows no other."""
    found: dict[str, Motor] = {}
    for transmission in root.all("transmission"):
        for joint in transmission.all("joint"):
            if joint.get("name") in tree.joints:
                found.setdefault(joint.get("name"), Motor(transmission.get("name", "driver"), joint.get("name")))
    for control in root.all("ros2_control"):
        for joint in control.all("joint"):
            if joint.first("command_interface") is not None and joint.get("name") in tree.joints:
                found.setdefault(joint.get("name"), Motor("driver", joint.get("name")))
    if found:
        return list(found.values())
    followers = mimics(tree)
    free = [each.name for each in tree.joints.values() if each.name not in followers and each.moves]
    return [Motor("driver", free[0])] if len(free) == 1 else []
