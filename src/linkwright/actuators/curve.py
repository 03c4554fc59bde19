"""A motor by points of its torque over its speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

from linkwright.actuators.base import ACTUATORS, Report
from linkwright.actuators.motor import Motor
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site
from linkwright.fields.base import Quantities
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.formula.trace import Scalar, select
from linkwright.words import _


@dataclass(frozen=True)
class Points(Quantities):
    """Quantities of a measured curve, which are no dimensions."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> tuple[float, ...] | None:
        with reader.plain_numbers(_("a table")):
            return super().read(reader, node, place, siblings)

    def flatten(self, value: Any) -> dict[str, float]:
        return {}

    def rebuild(self, value: Any, lookup: Any) -> Any:
        return value


points = base.declares(Points)


@ACTUATORS.register("curve")
@dataclass(frozen=True, kw_only=True)
class CurveMotor(Motor):
    """A motor, an engine or a turbine by points of its ``torque`` (N·m) over its ``speed`` (rad/s).

    Between the points straight lines, or, ``cubic``, a curve with continuous slope that does not overshoot. Beyond
    the first and the last one (``beyond``): ``hold``, the torque of the end stays; ``zero``, there is none;
    ``straight``, the curve goes on along its tangent, so that a motor that is driven faster brakes.

    Source: Fritsch, Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer. Anal. 17 (1980), 238–246.
    """

    speed: tuple[float, ...] = points("angular_velocity", doc=_("increasing speeds of the motor"))
    torque_points: tuple[float, ...] = points("torque", key="torque", doc=_("torque of the motor at each speed"))
    interpolation: str = base.word("linear", "cubic", default="linear", doc=_("between the points (default linear)"))
    beyond: str = base.word(
        "hold", "zero", "straight", default="hold", doc=_("torque beyond the first and the last speed (default hold)")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        speeds, torques = values["speed"], values["torque_points"]
        if len(speeds) != len(torques) or len(speeds) < 2:
            problem = _(
                "{speeds} speeds and {torques} torques are no curve",
                code="actuators.curve_lengths",
                speeds=len(speeds),
                torques=len(torques),
            )
            report("torque", problem, _("give as many torques as speeds, two or more"))
        elif any(b <= a for a, b in pairwise(speeds)):
            problem = _("the speeds of the curve do not increase", code="actuators.curve_falls")
            report("speed", problem, _("order the points by their speed"))

    def torque(self, site: Site, speed: Scalar) -> Scalar:
        first, last = self.speed[0], self.speed[-1]
        *pieces, found = self._pieces(speed)
        for end, piece in zip(reversed(self.speed[1:-1]), reversed(pieces), strict=True):
            found = select(speed < end, piece, found)
        low, high = self._beyond(speed)
        return select(speed < first, low, select(speed > last, high, found))

    def _pieces(self, speed: Scalar) -> Iterator[Scalar]:
        """The polynomial of each piece between two points, by Horner's rule."""
        for start, coefficients in zip(self.speed, self._coefficients, strict=False):
            value: Scalar = 0.0
            for each in coefficients:
                value = value * (speed - start) + each
            yield value

    def _beyond(self, speed: Scalar) -> tuple[Scalar, Scalar]:
        """The torque below the first and above the last point."""
        if self.beyond == "zero":
            return 0.0, 0.0
        low, high = self.torque_points[0], self.torque_points[-1]
        if self.beyond == "hold":
            return low, high
        slope_low = self._coefficients[0][-2]
        width = self.speed[-1] - self.speed[-2]
        a, b, c, _unused = self._coefficients[-1]
        slope_high = (3.0 * a * width + 2.0 * b) * width + c
        return low + slope_low * (speed - self.speed[0]), high + slope_high * (speed - self.speed[-1])

    @cached_property
    def _coefficients(self) -> list[list[float]]:
        """Of each piece, highest power first."""
        if self.interpolation == "linear":
            pairs = zip(pairwise(self.speed), pairwise(self.torque_points), strict=True)
            return [[0.0, 0.0, (f - e) / (b - a), e] for (a, b), (e, f) in pairs]
        from scipy.interpolate import PchipInterpolator

        found: list[list[float]] = PchipInterpolator(self.speed, self.torque_points).c.T.tolist()
        return found
