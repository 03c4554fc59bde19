"""What closes the loops of a MuJoCo model: connects, welds, couplings of joints and tendons of fixed factors."""

from __future__ import annotations

from typing import TypedDict

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.importers.trees.mujoco_model import MujocoModel, is_one_of
from linkwright.importers.trees.rigid_groups import joint_move
from linkwright.importers.trees.tree import Coupling, Pin, Tether, Tree, Weld
from linkwright.words import _

#: Coefficients of a coupling below this share of the linear one are none.
LINEAR = 1e-12
#: Depth (share of a pin's distance from the origin) by which two sites that are pulled together may be apart.
DEPTH = 1e-6


class _At(TypedDict):
    line: int
    key: str


class Closures:
    """Adds the closures of a model to its tree."""

    def __init__(self, read: MujocoModel, tree: Tree) -> None:
        self.read, self.tree, self.model = read, tree, read.model
        self.active = [index for index in range(self.model.neq) if self.model.eq_active0[index]]

    def add(self) -> None:
        """All of them, and springs of tendons."""
        kinds = self.read.mujoco.mjtEq
        replaced = self._closed_by_curves()
        for index in range(self.model.neq):
            kind = self.model.eq_type[index]
            if index in replaced or index not in self.active:
                if index not in replaced:
                    self._idle(index)
                continue
            if kind == kinds.mjEQ_CONNECT:
                self._connect(index)
            elif kind == kinds.mjEQ_WELD:
                self._weld(index)
            elif kind == kinds.mjEQ_JOINT:
                self._joint(index)
            elif kind == kinds.mjEQ_TENDON:
                self._tendon(index)
            else:
                self._refuse(index)
        self._springs()

    def name(self, index: int) -> str:
        """The name of an equality; one without is counted."""
        return self.read.name("EQUALITY", index) or f"loop{index}"

    def _line(self, index: int) -> int:
        return self.read.lines.of(self.name(index), "connect", "weld", "joint", "tendon")

    def _refuse(self, index: int) -> None:
        message = _("the constraint {name} has no counterpart and is left out", name=self.name(index))
        remedy = _("write what it does as a joint or a load of the model file")
        self.read.remarks.remark("warning", message, remedy, "import.mjcf_constraint", **self._at(index))

    def _at(self, index: int) -> _At:
        """Where findings about an equality belong."""
        return {"line": self._line(index), "key": self.name(index)}

    def _idle(self, index: int) -> None:
        message = _("the constraint {name} is not active at the start and is left out", name=self.name(index))
        remedy = _('set active="true" where it belongs to the machine')
        self.read.remarks.remark("note", message, remedy, "import.mjcf_inactive", **self._at(index))

    # -- loops that are written as curves

    def _closed_by_curves(self) -> set[int]:
        """Couplings that close the loop of an inactive constraint, which replaces them: those of higher order, and
        those which Linkwright's own files name after their two joints."""
        closing = [index for index in self.active if self._curved(index) or self._named_by_joints(index)]
        replaced: set[int] = set()
        for index in range(self.model.neq) if closing else ():
            if index in self.active:
                continue
            loop = self._loop(index)
            driven = {each for each in self.active if self._couples(each) and int(self.model.eq_obj1id[each]) in loop}
            if any(each in closing for each in driven):
                replaced |= driven if len(driven) == self._conditions(index) else driven & set(closing)
                self.active.append(index)
        return replaced

    def _named_by_joints(self, index: int) -> bool:
        joints = int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])
        if not self._couples(index) or min(joints) < 0:
            return False
        first, second = (self.read.joint_names[each] for each in joints)
        return self.name(index) == f"{first}({second})"

    def _conditions(self, index: int) -> int:
        """How many coordinates a constraint takes from a planar machine."""
        kinds = self.read.mujoco.mjtEq
        dimensions = {int(kinds.mjEQ_CONNECT): 2, int(kinds.mjEQ_WELD): 3}
        return dimensions.get(int(self.model.eq_type[index]), 1)

    def _couples(self, index: int) -> bool:
        return bool(self.model.eq_type[index] == self.read.mujoco.mjtEq.mjEQ_JOINT)

    def _curved(self, index: int) -> bool:
        factors = self.model.eq_data[index][:5]
        return self._couples(index) and bool(np.any(np.abs(factors[2:]) > LINEAR * max(1.0, abs(factors[1]))))

    def _loop(self, index: int) -> set[int]:
        """The joints between two bodies that a constraint holds together, or those that it couples."""
        kinds = self.read.mujoco.mjtEq
        if not is_one_of(self.model.eq_type[index], kinds.mjEQ_CONNECT, kinds.mjEQ_WELD):
            return self._coupled(index)
        chains = []
        for body in self._bodies(index):
            chain: set[int] = set()
            while body:
                chain |= set(self.read.joints_of(body))
                body = int(self.model.body_parentid[body])
            chains.append(chain)
        return chains[0] ^ chains[1]

    def _coupled(self, index: int) -> set[int]:
        """The joints of a coupling, or of the tendons that it ties."""
        ids = [each for each in (int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])) if each >= 0]
        if self._couples(index):
            return set(ids)
        names = [name for each in ids for name in self.fixed_factors(each) or ()]
        return {self.read.joint_names.index(each) for each in names}

    # -- pins and welds

    def _sites(self, index: int) -> bool:
        return bool(self.model.eq_objtype[index] == self.read.mujoco.mjtObj.mjOBJ_SITE)

    def _bodies(self, index: int) -> tuple[int, int]:
        ids = int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])
        if self._sites(index):
            return int(self.model.site_bodyid[ids[0]]), int(self.model.site_bodyid[ids[1]])
        return ids

    def _place(self, body: int, place: Floats) -> Floats:
        """A place of a body in space, in the reference pose."""
        turned = np.array(self.read.data.xmat[body]).reshape(3, 3)
        return np.asarray(np.array(self.read.data.xpos[body]) + turned @ place)

    def _connect(self, index: int) -> None:
        bodies, name = self._bodies(index), self.name(index)
        if self._sites(index):
            sites = int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])
            places = [np.array(self.read.data.site_xpos[each]) for each in sites]
            named = [self.read.site_name(each).rpartition(".")[2] for each in sites]
            name = named[0] if named[0] == named[1] else name
        else:
            data = self.model.eq_data[index]
            places = [self._place(bodies[0], data[:3]), self._place(bodies[1], data[3:6])]
        ends = [self.read.plane.place(each) for each in places]
        deep = abs(float(self.read.plane.normal @ (places[0] - places[1])))
        if deep > DEPTH * max(abs(ends[0]), abs(ends[1]), 1e-3):
            message = _("the ends of {name} are {depth:.3g} m apart across the plane", name=name, depth=deep)
            remedy = _("put both into one plane")
            self.read.remarks.remark("warning", message, remedy, "import.mjcf_depth", **self._at(index))
        names = self.read.names
        self.tree.pins.append(Pin(name, names[bodies[0]], names[bodies[1]], ends[0], ends[1], self._line(index)))

    def _weld(self, index: int) -> None:
        bodies, data = self._bodies(index), self.model.eq_data[index]
        plane, names = self.read.plane, self.read.names
        if self._sites(index):
            sites = int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])
            places = [np.array(self.read.data.site_xpos[each]) for each in sites]
            turned = [np.array(self.read.data.site_xmat[each]).reshape(3, 3) for each in sites]
            goal = turned[0]
        else:
            places = [self._place(bodies[0], data[3:6]), self._place(bodies[1], data[:3])]
            turned = [np.array(self.read.data.xmat[each]).reshape(3, 3) for each in bodies]
            relative = np.zeros(9)
            self.read.mujoco.mju_quat2Mat(relative, data[6:10])
            goal = turned[0] @ relative.reshape(3, 3)
        step = goal @ turned[1].T
        turn = complex(plane.right @ step @ plane.right, plane.up @ step @ plane.right)
        if abs(abs(turn) - 1) > 1e-6:
            self._refuse(index)
            return
        turn /= abs(turn)
        a, b = (plane.place(each) for each in places)
        self.tree.welds.append(Weld(names[bodies[0]], names[bodies[1]], turn, a - turn * b))

    # -- couplings

    def _joint(self, index: int) -> None:
        first, second = int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])
        data, names = self.model.eq_data[index], self.read.joint_names
        involved = [names[each] for each in (first, second) if each >= 0]
        if any(each not in self.tree.joints for each in involved):
            return
        if second < 0:
            joint = self.tree.joints[involved[0]]
            joint.moved = float(data[0])
            move = joint_move(joint)
            self.tree.welds.append(Weld(joint.parent, joint.child, move.turn, move.shift))
            return
        if self._curved(index):
            message = _("the coupling of {joints} is not linear and is left out", joints=tuple(involved))
            remedy = _("close the loop by the pin or guide that the curve stands for, or write a cam")
            self.read.remarks.remark("warning", message, remedy, "import.mjcf_curve", **self._at(index))
            return
        factors = {involved[0]: 1.0, involved[1]: -float(data[1])}
        self.tree.couplings.append(Coupling(self.name(index), factors, float(data[0]), self._line(index)))

    def fixed_factors(self, tendon: int) -> dict[str, float] | None:
        """Factors of a tendon's joints; None: it runs through space."""
        first, count = int(self.model.tendon_adr[tendon]), int(self.model.tendon_num[tendon])
        found: dict[str, float] = {}
        for each in range(first, first + count):
            if self.model.wrap_type[each] != self.read.mujoco.mjtWrap.mjWRAP_JOINT:
                return None
            name = self.read.joint_names[int(self.model.wrap_objid[each])]
            found[name] = found.get(name, 0.0) + float(self.model.wrap_prm[each])
        return found

    def _tendon(self, index: int) -> None:
        first, second = int(self.model.eq_obj1id[index]), int(self.model.eq_obj2id[index])
        data = self.model.eq_data[index]
        factors = self.fixed_factors(first)
        others = self.fixed_factors(second) if second >= 0 else {}
        straight = second < 0 or not np.any(np.abs(data[2:5]) > LINEAR * max(1.0, abs(data[1])))
        if factors is None or others is None or not straight:
            self._refuse(index)
            return
        for name, factor in others.items():
            factors[name] = factors.get(name, 0.0) - float(data[1]) * factor
        if all(each in self.tree.joints for each in factors):
            name = self.read.name("TENDON", first) if second < 0 else ""
            made = Coupling(name or self.name(index), factors, float(data[0]), self._line(index))
            self.tree.couplings.append(made)

    def _springs(self) -> None:
        """Tendons between two sites that are springs or dampers."""
        for tendon in range(self.model.ntendon):
            stiffness, damping = float(self.model.tendon_stiffness[tendon]), float(self.model.tendon_damping[tendon])
            if not (stiffness or damping):
                continue
            name = self.read.name("TENDON", tendon) or f"tendon{tendon}"
            first, count = int(self.model.tendon_adr[tendon]), int(self.model.tendon_num[tendon])
            kinds = self.model.wrap_type[first : first + count]
            rests = self.model.tendon_lengthspring[tendon]
            if (
                count != 2
                or any(each != self.read.mujoco.mjtWrap.mjWRAP_SITE for each in kinds)
                or rests[0] != rests[1]
            ):
                message = _("the spring or damper of the tendon {name} is left out", name=name)
                remedy = _("write it as springs between points, or as a load")
                line = self.read.lines.of(name, "spatial", "fixed")
                self.read.remarks.remark("warning", message, remedy, "import.mjcf_tendon", line=line, key=name)
                continue
            sites = [int(self.model.wrap_objid[each]) for each in (first, first + 1)]
            if any(int(self.model.site_bodyid[each]) in self.read.left_out for each in sites):
                continue
            bodies = [self.read.names[int(self.model.site_bodyid[each])] for each in sites]
            ends = [self.read.plane.place(np.array(self.read.data.site_xpos[each])) for each in sites]
            tether = Tether(name, bodies[0], bodies[1], ends[0], ends[1], stiffness, float(rests[0]), damping)
            self.tree.tethers.append(tether)
