"""Which joints of a MuJoCo model are driven, and how fast."""

from __future__ import annotations

import numpy as np

from linkwright.importers.trees.motors import add_driver
from linkwright.importers.trees.mujoco_model import MujocoModel, is_one_of
from linkwright.importers.trees.tree import Motor, Tree, TreeJoint
from linkwright.words import _


def add_motors(read: MujocoModel, tree: Tree) -> None:
    """A motor for each joint on which an actuator acts, of a tendon for its first; speeds of the first key frame, or
    the samples of a law as Linkwright writes them, in ``numeric`` elements."""
    found: dict[str, Motor] = {}
    for actuator in range(read.model.nu):
        name = read.name("ACTUATOR", actuator) or f"actuator{actuator}"
        joint = driven_joint(read, actuator)
        if joint is None or joint not in tree.joints:
            message = _("the actuator {name} acts on no joint and is left out", name=name)
            remedy = _("write what it does as a load")
            read.remarks.remark("warning", message, remedy, "import.mjcf_actuator", key=name)
        else:
            found.setdefault(joint, Motor(name, joint, _rate(read, joint), _law(read, name, joint)))
            _range(read, name, tree.joints[joint])
    add_driver(tree, list(found.values()), read.answers, read.remarks)


def driven_joint(read: MujocoModel, actuator: int) -> str | None:
    """The joint on which an actuator acts."""
    kinds, model = read.mujoco.mjtTrn, read.model
    kind, target = model.actuator_trntype[actuator], int(model.actuator_trnid[actuator][0])
    if is_one_of(kind, kinds.mjTRN_JOINT, kinds.mjTRN_JOINTINPARENT):
        return read.joint_names[target]
    if kind == kinds.mjTRN_TENDON:
        wrap = int(model.tendon_adr[target])
        if model.wrap_type[wrap] == read.mujoco.mjtWrap.mjWRAP_JOINT:
            return read.joint_names[int(model.wrap_objid[wrap])]
    return None


def _rate(read: MujocoModel, joint: str) -> float | None:
    """The rate of a joint in the first key frame; None where it rests."""
    if not read.model.nkey:
        return None
    rate = float(read.model.key_qvel[0][int(read.model.jnt_dofadr[read.joint_names.index(joint)])])
    return rate or None


def _law(read: MujocoModel, driver: str, joint: str) -> tuple[list[float], list[float]] | None:
    """Times from the start and coordinates, less that of the reference pose, of a law that Linkwright wrote."""
    samples = [_numbers(read, f"{driver}.{each}") for each in ("time", "position")]
    if not samples[0] or len(samples[0]) != len(samples[1]):
        return None
    at = int(read.model.jnt_qposadr[read.joint_names.index(joint)])
    began = float(read.model.key_time[0]) if read.model.nkey else 0.0
    return [each - began for each in samples[0]], [each - float(read.model.qpos0[at]) for each in samples[1]]


def _range(read: MujocoModel, driver: str, joint: TreeJoint) -> None:
    """Sets the ends between which a driver's cycle runs, where Linkwright wrote them."""
    ends = _numbers(read, f"{driver}.range")
    if len(ends) == 2:
        at = int(read.model.jnt_qposadr[read.joint_names.index(joint.name)])
        joint.low, joint.high = (each - float(read.model.qpos0[at]) for each in ends)


def _numbers(read: MujocoModel, name: str) -> list[float]:
    index = int(read.mujoco.mj_name2id(read.model, read.mujoco.mjtObj.mjOBJ_NUMERIC, name))
    if index < 0:
        return []
    first, count = int(read.model.numeric_adr[index]), int(read.model.numeric_size[index])
    return [float(each) for each in np.array(read.model.numeric_data[first : first + count])]
