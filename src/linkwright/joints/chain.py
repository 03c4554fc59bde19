"""Chain drives: two sprockets on one carrier."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import ClassVar

from linkwright.elements import Sizes
from linkwright.fields.base import Field, Quantity
from linkwright.formula.trace import Scalar
from linkwright.joints.base import JOINTS, Entry, Joint
from linkwright.joints.belt import BeltPair
from linkwright.joints.toothed import Numbers
from linkwright.words import _


@JOINTS.register("chain")
@dataclass(frozen=True)
class ChainPair(BeltPair):
    """A chain of ``pitch`` p (m) around two sprockets by their numbers of ``teeth``; or by their ``radii``.

    As a belt on the radii r = z p / 2π, that is, without the unevenness of the chain's polygon; the slack strand
    carries nothing.
    """

    toothed: ClassVar[bool] = True
    pitch: float | None = None

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        shared = {key: field for key, field in super().fields().items() if key not in ("run", "pretension")}
        return {
            **shared,
            "teeth": Numbers(doc=_("their numbers of teeth [a, b]")),
            "pitch": Quantity("length", above=0, doc=_("pitch of the chain, with teeth")),
        }

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        teeth, pitch, radii = (entry.values.get(key) for key in ("teeth", "pitch", "radii"))
        if teeth is not None and pitch is None:
            entry.finding(
                "",
                _("the chain's pitch is missing", code="joints.no_pitch"),
                _("give pitch: 12.7 mm with teeth, or radii instead"),
                "missing-key",
            )
            return None
        if pitch is not None and radii is not None:
            entry.finding(
                "radii",
                _("pitch with teeth already gives the radii", code="joints.radii_and_pitch"),
                _("leave one of them out"),
                "choice",
            )
            return None
        return super().read(entry)

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        return ("teeth", "radii")

    def pitch_radii(self) -> tuple[float, float]:
        if self.teeth is None or self.pitch is None:
            return super().pitch_radii()
        a, b = self.teeth
        return a * self.pitch / (2 * pi), b * self.pitch / (2 * pi)

    def dimensions(self) -> Mapping[str, float]:
        own = {} if self.pitch is None else {f"{self.name}.pitch": self.pitch}
        return {**super().dimensions(), **own}

    def traced_radii(self, dimensions: Sizes) -> tuple[Scalar, Scalar]:
        if self.teeth is None or self.pitch is None:
            return super().traced_radii(dimensions)
        part = dimensions(f"{self.name}.pitch") * (0.5 / pi)
        return dimensions(f"{self.name}.teeth.0") * part, dimensions(f"{self.name}.teeth.1") * part
