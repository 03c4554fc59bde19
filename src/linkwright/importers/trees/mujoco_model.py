"""A compiled MuJoCo model as a planar tree: its bodies where they lie with the coordinates of its reference pose."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from linkwright.importers.foreign import Answers
from linkwright.importers.layout import Remarks
from linkwright.importers.trees.plane import Axis, Plane
from linkwright.importers.trees.tree import WORLD, Part, Tree, TreeJoint
from linkwright.importers.xml_tree import Lines
from linkwright.words import _

#: MuJoCo's colour of shapes that have none.
GREY = (0.5, 0.5, 0.5)
#: Masses (kg) and moments of inertia (kg·m²) below these were put in to make a model loadable.
NO_MASS, NO_INERTIA = 2e-9, 4e-15


def is_one_of(value: Any, *kinds: Any) -> bool:
    """Whether a number of an array is one of an enumeration's kinds, which ``in`` would not see."""
    return any(bool(value == each) for each in kinds)


class MujocoModel:
    """Reads one model; arrays of ``model`` are named as in MuJoCo."""

    def __init__(self, mujoco: Any, model: Any, lines: Lines, answers: Answers, remarks: Remarks) -> None:
        self.mujoco, self.model, self.lines = mujoco, model, lines
        self.answers, self.remarks = answers, remarks
        self.data = mujoco.MjData(model)
        self.data.qpos[:] = model.qpos0
        mujoco.mj_kinematics(model, self.data)
        self.names = self._names("body", model.nbody)
        self.names[0] = WORLD
        self.joint_names = self._names("joint", model.njnt)
        self.left_out: set[int] = set()
        #: The floating body that the user holds; -1: none.
        self.held = self._held()
        self.plane: Plane

    def _held(self) -> int:
        body = self.names.index(self.answers.fixed) if self.answers.fixed in self.names else 0
        first = int(self.model.body_jntadr[body])
        free = first >= 0 and bool(self.model.jnt_type[first] == self.mujoco.mjtJoint.mjJNT_FREE)
        return body if free else -1

    def name(self, kind: str, index: int) -> str:
        """The name that the model gives something, "" where it gives none."""
        return str(self.mujoco.mj_id2name(self.model, getattr(self.mujoco.mjtObj, f"mjOBJ_{kind}"), index) or "")

    def _names(self, kind: str, count: int) -> list[str]:
        """Names of all bodies or joints; those without one are counted."""
        given = [self.name(kind.upper(), index) for index in range(count)]
        found: list[str] = []
        for index, name in enumerate(given):
            made, number = name or f"{kind}{index}", index
            while not name and made in given + found:
                number += 1
                made = f"{kind}{number}"
            found.append(made)
        return found

    # -- the tree

    def title(self) -> str:
        title = self.model.names.split(b"\0", 1)[0].decode()
        return "" if title == "MuJoCo Model" else title

    def bodies(self) -> Iterator[int]:
        return (each for each in range(1, self.model.nbody) if each not in self.left_out)

    def joints_of(self, body: int) -> range:
        """The joints of a body; none of the one that is the frame."""
        first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
        return range(0) if body == self.held or not count else range(first, first + count)

    def leave_out(self) -> bool:
        """Leaves out bodies that float freely and belong to nothing.

        False, after an error, where the machine itself floats or has a ball joint.
        """
        kinds, model = self.mujoco.mjtJoint, self.model
        tied = self._tied()
        for body in range(1, model.nbody):
            if int(model.body_parentid[body]) in self.left_out:
                self.left_out.add(body)
                continue
            for joint in self.joints_of(body):
                kind, name = model.jnt_type[joint], self.joint_names[joint]
                line = self.lines.of(self.names[body], "body")
                if kind == kinds.mjJNT_BALL:
                    message = _(
                        "{joint} is a ball joint, so {body} moves in space", joint=name, body=self.names[body]
                    )
                    remedy = _("give the planar part of the model alone: parallel hinges, and slides across them")
                    self.remarks.remark("error", message, remedy, "import.spatial", line=line, key=name)
                    return False
                if kind == kinds.mjJNT_FREE and tied & self._below(body):
                    message = _("{body} floats freely, so nothing of its machine is fixed", body=self.names[body])
                    remedy = _("say what is the frame: --fixed {body}", body=self.names[body])
                    self.remarks.remark("error", message, remedy, "import.floating", line=line, key=self.names[body])
                    return False
                if kind == kinds.mjJNT_FREE:
                    message = _("{body} floats freely and is left out", body=self.names[body])
                    remedy = _("write what it does to the machine as a load")
                    self.remarks.remark("note", message, remedy, "import.loose", line=line, key=self.names[body])
                    self.left_out.add(body)
        return True

    def _tied(self) -> set[int]:
        """Bodies with hinges and slides, or with what closes loops."""
        kinds, model = self.mujoco.mjtJoint, self.model
        found = {
            int(model.jnt_bodyid[each])
            for each in range(model.njnt)
            if is_one_of(model.jnt_type[each], kinds.mjJNT_HINGE, kinds.mjJNT_SLIDE)
        }
        for index in range(model.neq):
            if is_one_of(model.eq_type[index], self.mujoco.mjtEq.mjEQ_CONNECT, self.mujoco.mjtEq.mjEQ_WELD):
                ids = (int(model.eq_obj1id[index]), int(model.eq_obj2id[index]))
                site = model.eq_objtype[index] == self.mujoco.mjtObj.mjOBJ_SITE
                found |= {int(model.site_bodyid[each]) if site else each for each in ids}
        return found

    def _below(self, body: int) -> set[int]:
        """A body and all that hangs on it."""
        found = {body}
        for each in range(body + 1, self.model.nbody):
            if int(self.model.body_parentid[each]) in found:
                found.add(each)
        return found

    def axes(self) -> Iterator[Axis]:
        for body in self.bodies():
            for joint in self.joints_of(body):
                slides = self.model.jnt_type[joint] == self.mujoco.mjtJoint.mjJNT_SLIDE
                name = self.joint_names[joint]
                yield Axis(name, slides, np.array(self.data.xaxis[joint]), self.lines.of(name, "joint"))

    def gravity(self) -> complex:
        if int(self.model.opt.disableflags) & int(self.mujoco.mjtDisableBit.mjDSBL_GRAVITY):
            return 0j
        return self.plane.place(np.array(self.model.opt.gravity))

    # -- bodies and their joints

    def part(self, tree: Tree, body: int) -> Iterator[TreeJoint]:
        """Adds a body, with a part without mass between each two of its joints; the joints are returned in order."""
        model, name = self.model, self.names[body]
        parent, joints = self.names[int(model.body_parentid[body])], self.joints_of(body)
        if not joints:
            tree.parts[name] = self._solid(body)
            yield TreeJoint(f"{name}.fixed", parent, name)
            return
        for joint in joints:
            last = joint == joints[-1]
            child = name if last else f"{name}_{self.joint_names[joint]}"
            tree.parts[child] = self._solid(body) if last else Part(child, centre=self._anchor(joint), between=True)
            yield self._joint(joint, parent, child)
            parent = child

    def _solid(self, body: int) -> Part:
        model, data = self.model, self.data
        mass = float(model.body_mass[body])
        turned = np.array(data.ximat[body]).reshape(3, 3)
        tensor = turned @ np.diag(model.body_inertia[body]) @ turned.T
        part = Part(self.names[body], line=self.lines.of(self.names[body], "body"), colour=self._colour(body))
        part.centre = self.plane.place(np.array(data.xipos[body]))
        if mass > NO_MASS:
            inertia = self.plane.inertia(tensor)
            part.mass, part.inertia = mass, inertia if inertia > NO_INERTIA else 0.0
        part.marks = self.marks(body)
        if len(part.marks) < 2:
            part.marks |= self._tip(body)
        return part

    def marks(self, body: int) -> dict[str, complex]:
        """The sites of a body."""
        sites = [each for each in range(self.model.nsite) if int(self.model.site_bodyid[each]) == body]
        return {self.site_name(each): self.plane.place(np.array(self.data.site_xpos[each])) for each in sites}

    def site_name(self, site: int) -> str:
        """The name of a site; one without is counted."""
        return self.name("SITE", site) or f"site{site}"

    def _tip(self, body: int) -> dict[str, complex]:
        """The far end of a long shape, as a point that shows how the body is turned."""
        model, data = self.model, self.data
        for geom in range(model.ngeom):
            kinds = self.mujoco.mjtGeom
            long = is_one_of(model.geom_type[geom], kinds.mjGEOM_CAPSULE, kinds.mjGEOM_CYLINDER)
            if int(model.geom_bodyid[geom]) != body or not long:
                continue
            axis = np.array(data.geom_xmat[geom]).reshape(3, 3)[:, 2] * float(model.geom_size[geom][1])
            ends = [self.plane.place(np.array(data.geom_xpos[geom]) + sign * axis) for sign in (-1.0, 1.0)]
            origin = self.plane.place(np.array(data.xpos[body]))
            far = max(ends, key=lambda each: abs(each - origin))
            if abs(ends[1] - ends[0]) > 1e-3 * float(model.geom_size[geom][1]):
                return {f"{self.names[body]}_tip": far}
        return {}

    def _colour(self, body: int) -> str:
        """The colour of the first coloured shape."""
        model = self.model
        for geom in range(model.ngeom):
            if int(model.geom_bodyid[geom]) != body:
                continue
            material = int(model.geom_matid[geom])
            rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
            if rgba[3] > 0 and not np.allclose(rgba[:3], GREY):
                return "#" + "".join(f"{round(255 * float(each)):02x}" for each in rgba[:3])
        return ""

    def _anchor(self, joint: int) -> complex:
        return self.plane.place(np.array(self.data.xanchor[joint]))

    def _joint(self, joint: int, parent: str, child: str) -> TreeJoint:
        model, name = self.model, self.joint_names[joint]
        axis = np.array(self.data.xaxis[joint])
        at, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        made = TreeJoint(name, parent, child, line=self.lines.of(name, "joint"))
        if model.jnt_type[joint] == self.mujoco.mjtJoint.mjJNT_SLIDE:
            made.slides = self.plane.along(axis)
        else:
            made.turns, made.sense = self._anchor(joint), self.plane.sense(axis)
        if model.jnt_limited[joint]:
            made.low, made.high = (float(each - model.qpos0[at]) for each in model.jnt_range[joint])
        made.stiffness, made.damping = float(model.jnt_stiffness[joint]), float(model.dof_damping[dof])
        made.rest = float(model.qpos_spring[at] - model.qpos0[at])
        return made

    def start(self, tree: Tree) -> None:
        """The first key frame is the start, where there is one."""
        if not self.model.nkey:
            return
        for joint, name in enumerate(self.joint_names):
            if name in tree.joints:
                at = int(self.model.jnt_qposadr[joint])
                tree.joints[name].moved = float(self.model.key_qpos[0][at] - self.model.qpos0[at])
