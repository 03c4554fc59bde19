"""MuJoCo models (MJCF): planar machines with their loops, as MuJoCo itself resolves defaults, includes and frames."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from linkwright.exporters.export import package
from linkwright.filesystem import is_confined
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.trees.mujoco_closures import Closures
from linkwright.importers.trees.mujoco_left_out import tell_left_out
from linkwright.importers.trees.mujoco_model import NO_INERTIA, NO_MASS, MujocoModel
from linkwright.importers.trees.mujoco_motors import add_motors
from linkwright.importers.trees.plane import plane_of
from linkwright.importers.trees.rebased import held_at
from linkwright.importers.trees.tree import WORLD, Tree
from linkwright.importers.trees.tree_layout import tree_layout
from linkwright.importers.xml_tree import Lines, parse_xml
from linkwright.words import _

#: Mass (kg) and moment of inertia (kg·m²) of bodies without any, as MuJoCo demands some.
MASSLESS, INERTIALESS = 0.5 * NO_MASS, 0.5 * NO_INERTIA


def read(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    """The layout of a model; see :class:`MujocoModel`."""
    root = parse_xml(source.text, remarks)
    if root is None:
        return None
    if root.tag != "mujoco":
        message = _("the root element is <{tag}>, not <mujoco>", tag=root.tag)
        remarks.remark("error", message, _("give a file of MuJoCo"), "import.mjcf_root", line=root.line)
        return None
    files = {each.get("file") for each in (root, *root.below())} - {""}
    if is_confined() and (named := sorted(files)):
        message = _("the model names other files, which are not read here: {names}", names=tuple(named))
        remarks.remark("error", message, _("put the model into one file, without meshes"), "import.mjcf_files")
        return None
    mujoco = package("mujoco", _("models of MuJoCo"))
    compiled = _compiled(mujoco, source, remarks)
    if compiled is None:
        return None
    read_model = MujocoModel(mujoco, compiled, Lines(root), answers, remarks)
    tree = _tree(read_model)
    if tree is None:
        return None
    tree = held_at(tree, answers.fixed if read_model.held < 0 else None, WORLD, remarks)
    return None if remarks.failed else tree_layout(tree, remarks)


def recognises(source: ForeignText) -> bool:
    """Whether a text is of a MuJoCo model."""
    return "<mujoco" in source.text


READERS.register("mjcf")(ForeignFormat(_("MuJoCo model"), (".xml", ".mjcf"), recognises, read))


def _tree(read: MujocoModel) -> Tree | None:
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
    tell_left_out(read)
    return tree


def _compiled(mujoco: Any, source: ForeignText, remarks: Remarks) -> Any:
    """The compiled model; meshes whose files are missing are left out. None, with an error: MuJoCo refuses it."""
    path = None if source.folder is None else source.folder / source.name
    try:
        spec = _parsed(mujoco, source.text, path)
        try:
            return spec.compile()
        except ValueError as error:
            reason = " ".join(str(error).split())
            spec = _without_meshes(_parsed(mujoco, source.text, path))
            spec.compiler.boundmass, spec.compiler.boundinertia = MASSLESS, INERTIALESS
            found = spec.compile()
    except (ValueError, FileNotFoundError) as error:
        reason = " ".join(str(error).split())
        message = _("MuJoCo does not take the model ({reason})", reason=reason)
        remarks.remark("error", message, _("mend the file until MuJoCo loads it"), "import.mjcf_refused")
        return None
    message = _(
        "the model is read without its meshes and missing masses, as MuJoCo does not take it ({reason})",
        reason=reason,
    )
    remedy = _("give masses and mass centres, or the mesh files beside the model")
    remarks.remark("warning", message, remedy, "import.mjcf_meshes")
    return found


def _parsed(mujoco: Any, text: str, path: Path | None) -> Any:
    spec = mujoco.MjSpec.from_string(text) if path is None else mujoco.MjSpec.from_file(str(path))
    spec.compiler.fusestatic = False
    # a model with larger bounds has bodies without mass, which they are here as well
    spec.compiler.boundmass = min(spec.compiler.boundmass, MASSLESS)
    spec.compiler.boundinertia = min(spec.compiler.boundinertia, INERTIALESS)
    return spec


def _without_meshes(spec: Any) -> Any:
    """The model without what needs files: meshes, height fields, textures, skins."""
    for each in [shape for shape in spec.geoms if shape.meshname or shape.hfieldname]:
        spec.delete(each)
    for each in (*spec.meshes, *spec.hfields, *spec.skins):
        spec.delete(each)
    for material in spec.materials:
        material.textures = [""] * len(material.textures)
    for each in list(spec.textures):
        spec.delete(each)
    return spec
