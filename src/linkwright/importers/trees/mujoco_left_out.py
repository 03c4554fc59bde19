"""What a MuJoCo model says of forces that a machine of links and joints has no word for."""

from __future__ import annotations

from itertools import combinations

from linkwright.importers.trees.mujoco_model import MujocoModel
from linkwright.importers.trees.mujoco_motors import driven_joint
from linkwright.words import _


def tell_left_out(read: MujocoModel) -> None:
    """Notes the friction and armature of joints, each with its line, and that shapes may collide."""
    _tell_of_joints(read)
    _tell_of_shapes(read)


def _tell_of_joints(read: MujocoModel) -> None:
    model = read.model
    driven = {driven_joint(read, each) for each in range(model.nu)}
    for joint, name in enumerate(read.joint_names):
        if int(model.jnt_bodyid[joint]) in read.left_out:
            continue
        dof, line = int(model.jnt_dofadr[joint]), read.lines.of(name, "joint")
        if float(model.dof_frictionloss[dof]) > 0:
            message = _("the friction loss of {joint} is left out", joint=name)
            remedy = _("give the joint a coefficient of friction, or a load that opposes the motion")
            read.remarks.remark("note", message, remedy, "import.mjcf_friction", line=line, key=name)
        if float(model.dof_armature[dof]) > 0 and name not in driven:
            message = _("the armature of {joint}, the inertia of a rotor, is left out", joint=name)
            remedy = _("add it to the inertia of the link that turns")
            read.remarks.remark("note", message, remedy, "import.mjcf_armature", line=line, key=name)


def _tell_of_shapes(read: MujocoModel) -> None:
    """One note where shapes of two parts may touch: no contact is considered."""
    model = read.model
    shapes = {
        (int(model.geom_bodyid[each]), int(model.geom_contype[each]), int(model.geom_conaffinity[each]))
        for each in range(model.ngeom)
    }
    if any(a[0] != b[0] and (a[1] & b[2] or b[1] & a[2]) for a, b in combinations(shapes, 2)):
        message = _("shapes that may touch are links only: contacts and their forces are left out")
        remedy = _("write what touches as a load, a stop or a cam; look for collisions in the drawing")
        read.remarks.remark("note", message, remedy, "import.mjcf_contact")
