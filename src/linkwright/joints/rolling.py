"""Wheels that roll on each other without slipping, and what gears share with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import dist
from typing import Any, ClassVar

from linkwright.elements import Model, Sizes
from linkwright.fields.base import Field, Quantity, Word
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.trace import Mask, Scalar, absolute, reciprocal, sqrt
from linkwright.joints.base import JOINTS, Entry, Joint, Size
from linkwright.joints.ends import Ends
from linkwright.joints.toothed import FITS, WheelPair, length
from linkwright.words import Message, _


@JOINTS.register("rolling")
@dataclass(frozen=True)
class RollingPair(WheelPair):
    """Two wheels that roll on each other; ``mesh`` is external or internal (the larger one is the ring).

    With d = |AB| and the ratio i, negative for an external pair, the pitch point C lies at ρ_a = d i / (i - 1) from A
    and at ρ_b = d / (i - 1) from B on the ray A→B, and the row is ρ_a (θ_a - θ_c) - ρ_b (θ_b - θ_c) = const. Its
    multiplier is the tangential force on a along AB turned left, which friction must supply; what presses the wheels
    together is a matter of the carrier and of its loads (Norton, Design of Machinery, ch. 9).
    """

    letter: ClassVar[str] = "O"
    mesh: str = "external"

    @property
    def sense(self) -> float:
        return 1.0 if self.mesh == "internal" else -1.0

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            **super().fields(),
            "ratio": Quantity(
                "dimensionless",
                nonzero=True,
                doc=_("ratio of b's speed to a's on the carrier: negative external, positive internal"),
            ),
            "mesh": Word(("external", "internal"), doc=_("default external; internal: the larger one is the ring")),
        }

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        return ("radii", "ratio")

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        values = entry.values
        ratio = values.get("ratio")
        if ratio is not None and not (values.get("teeth") or values.get("radii")):
            values["mesh"] = "internal" if ratio > 0 else "external"
        return super().read(entry)

    def check(self, entry: Entry, distance: float) -> None:
        i = self.transmission
        numbers = self.teeth or self.radii
        if self.ratio is not None and numbers is not None:
            own = self.sense * numbers[0] / numbers[1]
            if abs(self.ratio - own) > FITS * abs(own):
                key = "teeth" if self.teeth else "radii"
                problem = _(
                    "the ratio {ratio:g} does not fit {key_}, which give {own:g}",
                    code="joints.ratio_misfit",
                    ratio=self.ratio,
                    key_=key,
                    own=own,
                )
                entry.finding("ratio", problem, _("leave the ratio out, or change it"), "choice")
                return
        if i == 1.0:
            entry.finding(
                "",
                _("a wheel cannot run in a ring of its own size", code="joints.equal_internal"),
                _("give different sizes; equal wheels that turn the same way need a belt or a chain"),
                "range",
            )
            return
        if distance == 0.0:
            problem = _("the centres {centres} lie in one place", code="joints.same_centre", centres=self.centres)
            entry.finding("links", problem, _("put the centres at a distance"), "range")
            return
        misfit = self._misfit(distance)
        if misfit is not None:
            loose = self._misfit(distance, self._slack(distance)) is None
            key, remedy = (
                "radii" if self.radii else "module",
                _("change the distance of the centres, or the sizes of the wheels"),
            )
            entry.finding(key, misfit, remedy, "range", "warning" if loose else "error")

    @property
    def asked(self) -> float:
        """The distance of the centres that the sizes ask for, m; 0 where they take any."""
        a, b = self.radii or (0.0, 0.0)
        return abs(a - self.sense * b)

    def _slack(self, distance: float) -> float:
        """By how much the centres may be off the distance that the sizes ask for, m."""
        return 0.0

    def _misfit(self, distance: float, slack: float = 0.0) -> Message | None:
        """What is wrong where the sizes ask for another distance of the centres, by more than the slack, m."""
        wanted = self.asked
        if not wanted or abs(wanted - distance) <= max(FITS * distance, slack):
            return None
        return _(
            "the distance of the centres {centres} on {carrier!r} is {distance}, but the {mesh} pair needs {wanted}",
            code="joints.distance_misfit",
            centres=self.centres,
            carrier=self.carrier,
            distance=length(distance),
            wanted=length(wanted),
            mesh=_("internal", code="joints.internal") if self.sense > 0 else _("external", code="joints.external"),
        )

    def misfit(self, mechanism: Model) -> Message | None:
        distance = abs(self.line(mechanism))
        return self._misfit(distance, self._slack(distance))

    def fits(self, dimensions: Sizes) -> Mask:
        """Radii ask for their distance of the centres; a ratio or teeth alone take any."""
        if self.radii is None:
            return True
        first, second = (dimensions(f"{self.name}.radii.{k}") for k in (0, 1))
        wanted, square = first - self.sense * second, self.traced_line(dimensions).square
        return absolute(wanted * wanted - square) <= 2.0 * FITS * square

    def written(self) -> dict[str, Any]:
        """A ratio tells the mesh by its sign."""
        redundant = "" if self.ratio is None else "mesh"
        return {key: value for key, value in super().written().items() if key != redundant}

    def arms(self, mechanism: Model) -> tuple[float, float]:
        points, i = mechanism.link(self.carrier).points, self.transmission
        d = dist(*(points[each] for each in self.centres))
        return d * i / (i - 1.0), -d / (i - 1.0)

    def traced_arms(self, at: Ends) -> tuple[Scalar, Scalar, Scalar]:
        distance, i = sqrt(self.traced_line(at.dimensions).square), self.traced_ratio(at.dimensions)
        part = distance * reciprocal(i - 1.0)
        return part * i, -part, -distance

    def held(self, at: Ends, force: Scalar, size: Size) -> list[tuple[Scalar, Scalar]]:
        """The tangential force keeps the centres on the carrier's line."""
        return [(-self.centre_offset(at)[1], force)]

    def place(self, at: Ends, link: str) -> Vec:
        """The pitch point."""
        arm, *_unused = self.traced_arms(at)
        return at.point(self.carrier, self.centres[0]) + at.vector(self.carrier, self.axis(at)) * arm
