"""The weld: two links made one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.elements import Sizes
from linkwright.fields.base import Field, Quantity, Text
from linkwright.fields.references import LinkNames
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar
from linkwright.joints.base import JOINTS, Entry, Joint
from linkwright.joints.ends import Ends, Hung
from linkwright.joints.lower_pair import RigidJoint
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.elements import TreeJoint


@JOINTS.register("weld")
@dataclass(frozen=True)
class WeldJoint(RigidJoint):
    """Two links made one; :class:`RigidJoint` says what its fields mean."""

    letter: ClassVar[str] = "W"

    def dimensions(self) -> Mapping[str, float]:
        return {f"{self.name}.angle": self.angle}

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            "links": LinkNames(required=True, doc=_("the two links [a, b]")),
            "at": Text(required=True, doc=_("their common point")),
            "angle": Quantity("angle", doc=_("angle of b's x axis to a's (default 0)")),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        held, place, at = entry.node.get("at") or entry.node, entry.place.child("at"), entry.values["at"]
        found = [entry.reader.point_of(held, place, at, each) for each in entry.values["links"]]
        return cls(entry.name, **entry.values) if all(found) else None

    @classmethod
    def unpinned(cls, values: Mapping[str, Any]) -> tuple[str, Sequence[str]] | None:
        at, links = values.get("at"), values.get("links")
        if not at or not isinstance(links, list) or len(links) != 2:
            return None
        return at, sorted(links, key=lambda link: link != "frame")

    # motion -----------------------------------------------------------------------------------

    def residual(self, at: Ends) -> list[Scalar]:
        """The common point; :attr:`ties` fixes the rotation."""
        gap = self.place(at, at.a) - self.place(at, at.b)
        return [gap.x, gap.y]

    def place(self, at: Ends, link: str) -> Vec:
        return at.point(link, self.at)

    def hang(self, at: Ends, step: TreeJoint, coordinate: Scalar) -> Hung:
        turn = at.unit(f"{self.name}.angle")
        turned = turn.conjugate if step.child == self.links[1] else turn
        return Hung(at.local(step.child, self.at), at.point(step.parent, self.at), turned)

    def turned(self, step: TreeJoint, dimensions: Sizes) -> Scalar:
        turn = dimensions(f"{self.name}.angle")
        return turn if step.child == self.links[1] else -turn
