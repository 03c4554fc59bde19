"""Closeness to a singular position."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import ClassVar

from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue, Remark
from linkwright.metrics.closure import closable, conditioning
from linkwright.metrics.quantities import shown

#: Below this a dyad is nearer than 10° to a dead point.
NEAR = 0.17


@METRICS.register("singularity")
class Singularity(Metric):
    """Smallest determinant of a group's closure equations with unit columns: 0 singular, 1 best; sin μ of a dyad.

    A larger group has its limit lowered to the power of half its equations.
    """

    name = "singularity"
    dimension = "dimensionless"
    source = "determinant of the closure Jacobian; Gosselin and Angeles, IEEE Trans. Robotics 6(3), 1990"
    better: ClassVar[Better | None] = "higher"
    limit = NEAR

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(closable(analysis.motion))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for group in closable(analysis.motion):
            found = analysis.extreme(partial(conditioning, group=group), "min")
            if found is None:
                continue
            near = found.value < NEAR ** len(group.cuts)
            place: dict[str, object] = {
                "group": group.name,
                "at": shown(found.input, analysis.input_dimension),
            }
            remarks = (Remark("singularity.near", place, warning=True),) if near else ()
            yield self.value(
                analysis, group.name, found.value, at=found.input, exact=found.exact, remarks=remarks
            )
