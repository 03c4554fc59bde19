"""Pressure angle: the complement of the transmission angle."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number, Remark
from linkwright.analysis.transmission_angle import LIMIT, smallest
from linkwright.core.quantity import shown
from linkwright.formula.trace import Scalar
from linkwright.kinetostatics.closure import dyads
from linkwright.words import _


def _complement(angle: Scalar) -> Scalar:
    return 0.5 * pi - angle


@METRICS.register("pressure_angle")
class PressureAngle(Metric):
    """Largest angle between the force on the driven point of a dyad and that point's velocity: α = π/2 - μ."""

    label = _("largest pressure angle")
    meaning = _("Angle between the force on the driven point and its velocity: 90° minus the transmission angle.")

    rank = 2
    dimension = "angle"
    source = "Volmer, Getriebetechnik: α = 90° - μ, not above about 50°"
    better: ClassVar[Better | None] = "lower"
    limit = 0.5 * pi - LIMIT

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(dyads(analysis.motion.structure))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for group in dyads(analysis.motion.structure):
            yield Number(group.name, (smallest(group),), _complement)

    def remarks(self, value: float, at: float, analysis: Analysis) -> tuple[Remark, ...]:
        if not value > self.limit:
            return ()
        sentence = _(
            "the pressure angle rises to {value}, above the recommended {limit}",
            value=shown(value, "angle"),
            limit=shown(self.limit, "angle"),
        )
        return (Remark("pressure_angle.high", sentence, warning=True),)
