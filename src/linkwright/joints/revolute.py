"""The revolute joint: any number of links on one pin."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from linkwright.fields.base import Field, Quantity
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Scalar
from linkwright.joints.base import JOINTS, Entry, Joint
from linkwright.joints.ends import Ends, Hung
from linkwright.joints.lower_pair import TurningJoint
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.elements import TreeJoint

FRICTION = Quantity("dimensionless", minimum=0, doc=_("coefficient of Coulomb friction (default 0)"))


@JOINTS.register("revolute")
@dataclass(frozen=True)
class RevoluteJoint(TurningJoint):
    """A pin: the kind that points of one name imply."""

    letter: ClassVar[str] = "R"

    def dimensions(self) -> Mapping[str, float]:
        friction = {f"{self.name}.friction": self.friction} if self.friction else {}
        return friction if self.pin_radius is None else {f"{self.name}.pin_radius": self.pin_radius, **friction}

    # the model file ---------------------------------------------------------------------------
    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {"pin_radius": Quantity("length", above=0, doc=_("radius of the pin")), "friction": FRICTION}

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        pins = entry.reader.names.pins
        if entry.name not in pins:
            entry.reader.known(entry.node, entry.place, _("pin"), entry.name, list(pins))
            return None
        return cls(entry.name, pins[entry.name], **entry.values)

    # structure --------------------------------------------------------------------------------
    @property
    def pairs(self) -> int:
        """A pin of k links is k - 1 pairs."""
        return len(self.links) - 1

    # motion -----------------------------------------------------------------------------------

    def residual(self, at: Ends) -> list[Scalar]:
        """The pin's point on either link: both coincide."""
        gap = self.place(at, at.a) - self.place(at, at.b)
        return [gap.x, gap.y]

    def place(self, at: Ends, link: str) -> Vec:
        return at.point(link, self.name)

    def hang(self, at: Ends, step: TreeJoint, coordinate: Scalar) -> Hung:
        return Hung(at.local(step.child, self.name), at.point(step.parent, self.name))

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.links[-1], self.name),)
