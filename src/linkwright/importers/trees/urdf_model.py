"""Links and joints of a URDF robot as a planar tree, with all joints at 0."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.importers.layout import Remarks
from linkwright.importers.trees.mimic_loops import follow, mimics
from linkwright.importers.trees.plane import Axis, Frame, Plane
from linkwright.importers.trees.tree import WORLD, Coupling, Part, Tree, TreeJoint
from linkwright.importers.xml_tree import Element
from linkwright.words import _

#: Joints of a plane.
HINGES, SLIDES = ("revolute", "continuous"), ("prismatic",)
ZERO = (0.0, 0.0, 0.0)


@dataclass
class UrdfJoint:
    """A joint element with its axis and the axes of its child in space."""

    element: Element
    name: str
    kind: str
    parent: str
    child: str
    axis: Floats = field(default_factory=lambda: np.zeros(3))
    frame: Frame = field(default_factory=Frame)


class UrdfModel:
    """Reads one robot."""

    def __init__(self, root: Element, remarks: Remarks) -> None:
        self.root, self.remarks = root, remarks
        self.links = {each.get("name"): each for each in root.all("link")}
        self.joints: dict[str, UrdfJoint] = {}
        self.frames: dict[str, Frame] = {}
        self.base = ""
        self.colours = {each.get("name"): self._rgba(each) for each in root.all("material")}

    def numbers(self, element: Element | None, key: str, default: Sequence[float], count: int = 3) -> list[float]:
        """Numbers of an attribute; an error among the remarks where they are none."""
        text = "" if element is None else element.get(key)
        if element is None or not text.strip():
            return list(default)
        try:
            found = [float(each) for each in text.split()]
        except ValueError:
            found = []
        if len(found) != count or not all(map(math.isfinite, found)):
            message = _('{key}="{text}" should be {count} numbers', key=key, text=text, count=count)
            self.remarks.remark(
                "error", message, _("write numbers"), "import.urdf_numbers", line=element.line, key=key
            )
            return list(default)
        return found

    def number(self, element: Element | None, key: str, default: float = 0.0) -> float:
        """A number of an attribute."""
        return self.numbers(element, key, (default,), 1)[0]

    def origin(self, element: Element | None) -> tuple[list[float], list[float]]:
        """xyz and rpy of the ``origin`` of an element."""
        found = None if element is None else element.first("origin")
        return self.numbers(found, "xyz", ZERO), self.numbers(found, "rpy", ZERO)

    # -- the chains

    def read(self) -> bool:
        """Reads joints, the base and the axes of all links; False after an error."""
        for element in self.root.all("joint"):
            self._joint(element)
        if self.remarks.failed:
            return False
        children = {each.child for each in self.joints.values()}
        bases = [name for name in self.links if name not in children]
        if len(bases) != 1:
            message = _("a robot has one link that is nobody's child; here these are {names}", names=tuple(bases))
            remedy = _("join the links to one tree")
            self.remarks.remark("error", message, remedy, "import.urdf_tree", line=self.root.line)
            return False
        self.base = bases[0]
        self.frames[self.base] = Frame()
        pending = [self.base]
        ordered: dict[str, UrdfJoint] = {}
        while pending:
            link = pending.pop(0)
            for joint in self.joints.values():
                if joint.parent == link and joint.child not in self.frames:
                    joint.frame = self.frames[link].then(*self.origin(joint.element))
                    self.frames[joint.child] = joint.frame
                    joint.axis = self._axis(joint)
                    ordered[joint.name] = joint
                    pending.append(joint.child)
        self.joints = ordered
        return not self.remarks.failed

    def _joint(self, element: Element) -> None:
        name, kind = element.get("name"), element.get("type")
        ends = [element.first(each) for each in ("parent", "child")]
        parent, child = ("" if each is None else each.get("link") for each in ends)
        for link in (parent, child):
            if link not in self.links:
                message = _('the joint {name} names a link "{link}" that there is not', name=name, link=link)
                remedy = _("name one of {names}", names=tuple(self.links))
                self.remarks.remark("error", message, remedy, "import.urdf_link", line=element.line, key=name)
                return
        if kind not in (*HINGES, *SLIDES, "fixed"):
            message = _("the type {kind} of the joint {name} is not of a plane", name=name, kind=kind)
            remedy = _("give the planar part of the model alone: parallel hinges, and slides across them")
            self.remarks.remark("error", message, remedy, "import.spatial", line=element.line, key=name)
            return
        self.joints[name] = UrdfJoint(element, name, kind, parent, child)

    def _axis(self, joint: UrdfJoint) -> Floats:
        axis = np.array(self.numbers(joint.element.first("axis"), "xyz", (1.0, 0.0, 0.0)))
        length = float(np.sqrt(axis @ axis))
        if joint.kind != "fixed" and length == 0.0:
            message = _("the axis of {name} has no direction", name=joint.name)
            remedy = _('write it, such as axis xyz="0 0 1"')
            self.remarks.remark("error", message, remedy, "import.urdf_axis", line=joint.element.line, key=joint.name)
        return np.asarray(joint.frame.turn @ (axis / (length or 1.0)))

    def axes(self) -> Iterator[Axis]:
        """The axes of all joints that move."""
        for joint in self.joints.values():
            if joint.kind != "fixed":
                yield Axis(joint.name, joint.kind in SLIDES, joint.axis, joint.element.line)

    # -- the tree

    def tree(self, plane: Plane) -> Tree:
        """Parts, joints and couplings in the plane."""
        tree = Tree(self.root.get("name"))
        for joint in self.joints.values():
            tree.parts[joint.child] = self._part(joint.child, plane)
            tree.joints[joint.name] = self._moving(joint, plane)
        tree.couplings = list(self._couplings(tree))
        self._start(tree)
        return tree

    def part_name(self, link: str) -> str:
        """The name of a link's part: the base is the frame."""
        return WORLD if link == self.base else link

    def _moving(self, joint: UrdfJoint, plane: Plane) -> TreeJoint:
        element = joint.element
        made = TreeJoint(joint.name, self.part_name(joint.parent), joint.child, line=element.line)
        if joint.kind == "fixed":
            return made
        if joint.kind in SLIDES:
            made.slides = plane.along(joint.axis)
        else:
            made.turns, made.sense = plane.place(joint.frame.origin), plane.sense(joint.axis)
        limit = element.first("limit")
        if limit is not None and joint.kind != "continuous" and (limit.get("lower") or limit.get("upper")):
            low, high = self.number(limit, "lower"), self.number(limit, "upper")
            made.low, made.high = (low, high) if low < high else (None, None)
        made.damping = self.number(element.first("dynamics"), "damping")
        if self.number(element.first("dynamics"), "friction"):
            message = _("friction of the joint {name} is left out", name=joint.name)
            remedy = _("write it as friction of the pin with its radius")
            self.remarks.remark("note", message, remedy, "import.urdf_friction", line=element.line, key=joint.name)
        return made

    def _couplings(self, tree: Tree) -> Iterator[Coupling]:
        """value = multiplier · value of the other + offset."""
        for joint in self.joints.values():
            mimic = joint.element.first("mimic")
            if mimic is None:
                continue
            other = mimic.get("joint")
            if other not in tree.joints or other == joint.name:
                message = _('{name} mimics a joint "{other}" that there is not', name=joint.name, other=other)
                remedy = _("name one of {names}", names=tuple(tree.joints))
                self.remarks.remark("error", message, remedy, "import.urdf_mimic", line=mimic.line, key=joint.name)
                continue
            factors = {joint.name: 1.0, other: -self.number(mimic, "multiplier", 1.0)}
            yield Coupling(f"{joint.name}_mimic", factors, self.number(mimic, "offset"), mimic.line)

    def _start(self, tree: Tree) -> None:
        """Joints at 0, or at the limit next to it; those that mimic others follow."""
        followers = mimics(tree)
        moved = dict.fromkeys(tree.joints, 0.0)
        for joint in tree.joints.values():
            if joint.name not in followers and joint.low is not None and joint.high is not None:
                moved[joint.name] = min(max(0.0, joint.low), joint.high)
        follow(moved, followers)
        for joint in tree.joints.values():
            joint.moved = moved[joint.name]

    # -- links

    def _part(self, link: str, plane: Plane) -> Part:
        element, frame = self.links[link], self.frames[link]
        part = Part(link, line=element.line, centre=plane.place(frame.origin), colour=self._colour(element))
        inertial = element.first("inertial")
        if inertial is not None:
            own = frame.then(*self.origin(inertial))
            part.mass = self.number(inertial.first("mass"), "value")
            part.centre = plane.place(own.origin)
            xx, xy, xz, yy, yz, zz = (
                self.number(inertial.first("inertia"), each) for each in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
            )
            tensor = own.turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ own.turn.T
            part.inertia = plane.inertia(tensor)
        part.marks = self._marks(link, plane) or self._tip(link, plane)
        return part

    def _marks(self, link: str, plane: Plane) -> dict[str, complex]:
        """Links without mass and shape that are fixed to a link are points of it."""
        found = {}
        for joint in self.joints.values():
            plain = not any(self.links[joint.child].all("inertial", "visual", "collision"))
            if joint.parent == link and joint.kind == "fixed" and plain:
                found[joint.child] = plane.place(joint.frame.origin)
        return found

    def _tip(self, link: str, plane: Plane) -> dict[str, complex]:
        """The far end of a long shape, as a point that shows how the link is turned."""
        frame = self.frames[link]
        for visual in self.links[link].all("visual"):
            shape = visual.first("geometry")
            box, cylinder = (None if shape is None else shape.first(each) for each in ("box", "cylinder"))
            half = np.array(self.numbers(box, "size", ZERO)) / 2
            if cylinder is not None:
                half = np.array([0.0, 0.0, self.number(cylinder, "length") / 2])
            half = np.where(half == half.max(), half, 0.0)
            own = frame.then(*self.origin(visual))
            ends = [plane.place(own.place(sign * half)) for sign in (-1.0, 1.0)]
            if abs(ends[1] - ends[0]) > 1e-6:
                return {f"{link}_tip": max(ends, key=lambda each: abs(each - plane.place(frame.origin)))}
        return {}

    def _colour(self, link: Element) -> str:
        for visual in link.all("visual"):
            for material in visual.all("material"):
                found = self._rgba(material) or self.colours.get(material.get("name"), "")
                if found:
                    return found
        return ""

    def _rgba(self, material: Element) -> str:
        """The colour of a material as #rrggbb; empty: it has none."""
        colour = material.first("color")
        if colour is None:
            return ""
        shares = self.numbers(colour, "rgba", (0.0, 0.0, 0.0, 1.0), 4)[:3]
        return "#" + "".join(f"{round(255 * min(max(each, 0.0), 1.0)):02x}" for each in shares)
