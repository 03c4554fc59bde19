"""Limit positions: where an output reverses."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue


@METRICS.register("limit_position")
class LimitPosition(Metric):
    """Every position in which an output reverses: its angle or displacement there, and the input."""

    name = "limit_position"
    dimension = "angle"
    source = "IFToMM terminology: the output's velocity is zero"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(analysis.limits(output) for output in analysis.outputs)

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in analysis.outputs:
            for limit in analysis.limits(output):
                subject = f"{output} {limit.kind}"
                yield self.value(analysis, subject, limit.value, dimension=output.dimension, at=limit.input)
