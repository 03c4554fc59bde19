"""Pressure angle: the complement of the transmission angle."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import pi, radians
from typing import ClassVar

from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue, Remark
from linkwright.metrics.closure import dyads, transmission_angle
from linkwright.metrics.quantities import shown


@METRICS.register("pressure_angle")
class PressureAngle(Metric):
    """Largest angle between the force on the driven point of a dyad and that point's velocity: α = π/2 - μ."""

    name = "pressure_angle"
    rank = 2
    dimension = "angle"
    source = "Volmer, Getriebetechnik: α = 90° - μ, not above about 50°"
    better: ClassVar[Better | None] = "lower"
    limit = radians(50)

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(dyads(analysis.motion))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for group in dyads(analysis.motion):
            found = analysis.extreme(partial(transmission_angle, group=group), "min")
            if found is None:
                continue
            angle = pi / 2 - found.value
            limits: dict[str, object] = {"value": shown(angle, "angle"), "limit": shown(self.limit, "angle")}
            remarks = (Remark("pressure_angle.high", limits, warning=True),) if angle > self.limit else ()
            yield self.value(analysis, group.name, angle, at=found.input, exact=found.exact, remarks=remarks)
