"""Parts of a tree as bodies of a layout: which part belongs to which body, and where its places lie."""

from __future__ import annotations

from functools import cached_property

from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.trees.points import Point, Points
from linkwright.importers.trees.rigid_groups import Groups
from linkwright.importers.trees.tree import Tree, TreeJoint
from linkwright.mechanism.link import Vec
from linkwright.words import _


class Placed:
    """A tree with the layout that is made of it; ``bodies``: names of bodies by their groups.

    ``pin_of``: the point of each hinge. ``named``: names of points by their ids, once all are known.
    """

    def __init__(self, tree: Tree, remarks: Remarks) -> None:
        self.tree, self.remarks = tree, remarks
        self.groups = Groups(tree)
        places = [joint.turns for joint in tree.joints.values() if joint.turns is not None]
        places += [place for pin in tree.pins for place in (pin.at_a, pin.at_b)]
        places += [place for part in tree.parts.values() for place in (part.centre, *part.marks.values())]
        self.size = max([abs(each - places[0]) for each in places], default=0.0) or 1.0
        self.points = Points(self.size)
        self.layout = Layout(tree.name or "Mechanism", unit="mm", gravity=vec(tree.gravity))
        self.bodies: dict[str, str] = {}
        self.pin_of: dict[str, Point] = {}
        self.named: dict[int, str] = {}

    # -- from parts to groups

    def group(self, part: str) -> str:
        """The group of a part."""
        return self.groups.of[part]

    def on(self, part: str, place: complex) -> tuple[str, complex]:
        """A place of a part as one of its group."""
        return self.group(part), self.groups.inside[part](place)

    def start(self, group: str, place: complex) -> complex:
        """Where a place of a group lies at the start."""
        return self.groups.start[group](place)

    def body(self, part: str) -> str:
        """The name of the body to which a part belongs."""
        return self.bodies[self.group(part)]

    @cached_property
    def moving(self) -> list[TreeJoint]:
        """Joints between two groups."""
        found = []
        for joint in self.tree.joints.values():
            if not joint.moves:
                continue
            if self.group(joint.parent) == self.group(joint.child):
                message = _("the joint cannot move: what it joins is one body")
                self.remarks.remark(
                    "note",
                    message,
                    _("leave the joint or the weld out"),
                    "import.locked",
                    line=joint.line,
                    key=joint.name,
                )
                continue
            found.append(joint)
        return found


def vec(place: complex) -> Vec:
    """A place as coordinates."""
    return place.real + 0.0, place.imag + 0.0
