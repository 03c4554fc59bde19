"""The gear pair: two toothed wheels on one carrier, outside each other or one in the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos as cos_of
from math import pi
from typing import ClassVar

from linkwright.elements import Model, Sizes
from linkwright.fields.base import Field, Quantity
from linkwright.formula.trace import Mask, Scalar, absolute, cos, maximum, reciprocal, select, sqrt, stop, tan
from linkwright.joints.base import JOINTS, Entry, Joint, Size
from linkwright.joints.ends import Ends
from linkwright.joints.rolling import RollingPair
from linkwright.joints.toothed import FITS, Numbers
from linkwright.words import _

#: The pressure angle of standard teeth, and the clearance at their bottom in modules (ISO 53): by so much the centres
#: of involute wheels may be off, as tolerances and sweeps have it, before teeth touch the bottom or let go.
STANDARD, CLEARANCE = pi / 9, 0.25


@JOINTS.register("gear")
@dataclass(frozen=True)
class GearPair(RollingPair):
    """Two gears, which move like wheels that roll on each other with their pitch circles.

    Their teeth press on the wheels with the separating force |F_t| tan α along AB, ``pressure_angle`` α (Norton,
    Design of Machinery, ch. 9 and 11).
    """

    letter: ClassVar[str] = "G"
    toothed: ClassVar[bool] = True
    module: float | None = None
    pressure_angle: float = STANDARD

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        rolling = super().fields()
        return {
            "links": rolling["links"],
            "teeth": Numbers(doc=_("their numbers of teeth [a, b]")),
            **rolling,
            "module": Quantity(
                "length", above=0, doc=_("module; with teeth it is checked against the centre distance")
            ),
            "pressure_angle": Quantity(
                "angle", minimum=0, below=0.5 * pi, doc=_("pressure angle in mesh (default 20 deg)")
            ),
        }

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        return ("teeth", *super().sizes())

    @classmethod
    def read(cls, entry: Entry) -> Joint | None:
        values = entry.values
        if values.get("module") and not values.get("teeth") and (values.get("ratio") or values.get("radii")):
            remedy = _("give teeth in place of the radii or the ratio, or leave the module out")
            entry.finding(
                "module",
                _("a module says nothing about wheels without numbers of teeth", code="joints.module_without_teeth"),
                remedy,
                "choice",
            )
            return None
        return super().read(entry)

    @property
    def asked(self) -> float:
        if self.radii or self.teeth is None:
            return super().asked
        a, b = self.teeth
        return 0.5 * (self.module or 0.0) * abs(a - self.sense * b)

    def _slack(self, distance: float) -> float:
        base = self.asked * cos_of(self.pressure_angle) if self.involute else 0.0
        return CLEARANCE * (self.module or 0.0) if distance >= base else 0.0

    @property
    def involute(self) -> bool:
        """Whether the teeth are known so well that their working pressure angle follows from the distance."""
        return self.radii is None and self.teeth is not None and self.module is not None

    def _asked(self, dimensions: Sizes) -> Scalar:
        """The distance that involute teeth ask for, traced, with the sign of the mesh; 0 without it."""
        if not self.involute:
            return 0.0
        first, second = (dimensions(f"{self.name}.teeth.{k}") for k in (0, 1))
        return 0.5 * dimensions(f"{self.name}.module") * (first - self.sense * second)

    def fits(self, dimensions: Sizes) -> Mask:
        if not self.involute:
            return super().fits(dimensions)
        wanted, line = self._asked(dimensions), self.traced_line(dimensions)
        base = wanted * cos(dimensions(f"{self.name}.pressure_angle"))
        off = absolute(absolute(wanted) - sqrt(line.square))
        near = off <= CLEARANCE * dimensions(f"{self.name}.module")
        return dimensions.trace.logic("and", near, base * base <= line.square * (1.0 + 2.0 * FITS))

    def _slope(self, angle: Scalar, wanted: Scalar, square: Scalar) -> Scalar:
        """tan of the pressure angle in mesh, traced or a number, at the square of the distance.

        A distance that fits, as a file rounds it, has the stated angle to the last digit.
        """
        if not self.involute or (isinstance(angle, float) and angle == 0.0):
            return tan(angle)
        root = cos(angle)
        off = square * reciprocal(wanted * wanted) - 1.0
        rounded = select(absolute(off) <= 2.0 * FITS * (1.0 + FITS), off, 0.0)
        return sqrt(maximum((1.0 + off - stop(rounded)) * reciprocal(root * root) - 1.0, 0.0))

    def dimensions(self) -> Mapping[str, float]:
        own = {f"{self.name}.pressure_angle": self.pressure_angle}
        return {**super().dimensions(), **own, **({f"{self.name}.module": self.module} if self.module else {})}

    def working_slope(self, mechanism: Model) -> float:
        """tan of the pressure angle in mesh."""
        slope = self._slope(self.pressure_angle, self.asked, abs(self.line(mechanism)) ** 2)
        assert isinstance(slope, float)
        return slope

    def held(self, at: Ends, force: Scalar, size: Size) -> list[tuple[Scalar, Scalar]]:
        """The separating force: on an external gear a towards its own centre, on a ring outwards."""
        square, alpha = self.traced_line(at.dimensions).square, at.dimension(f"{self.name}.pressure_angle")
        slope, teeth = self._slope(alpha, self._asked(at.dimensions), square), super().held(at, force, size)
        if isinstance(slope, float) and slope == 0.0:
            return teeth
        return [*teeth, (self.centre_offset(at)[0], -self.sense * slope * size(force))]
