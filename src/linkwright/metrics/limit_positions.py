"""Limit positions: where an output reverses."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.outputs import Output
from linkwright.loads.phases import outermost
from linkwright.loads.signals import Limit
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue, Number


@METRICS.register("limit_position")
class LimitPosition(Metric):
    """Every position in which an output reverses: its angle or displacement there, and the input."""

    dimension = "angle"
    source = "IFToMM terminology: the output's velocity is zero"
    own_values = True

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(analysis.limits(output) for output in analysis.outputs)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        """The outermost ones of a closed cycle."""
        for output, limits in outermost_limits(analysis):
            for limit in limits:
                part = f"{output.owner}.{output.kind} {limit.kind}"
                yield Number(f"{output} {limit.kind}", (part,), dimension=output.dimension)

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in analysis.outputs:
            for limit in analysis.limits(output):
                yield self.value(
                    analysis,
                    f"{output} {limit.kind}",
                    limit.value,
                    dimension=output.dimension,
                    at=limit.input,
                )


def outermost_limits(analysis: Analysis) -> Iterator[tuple[Output, list[Limit]]]:
    """Outputs with limits in a closed cycle, with their outermost ones by increasing time."""
    for output in analysis.outputs if analysis.whole else ():
        if limits := analysis.limits(output):
            yield output, outermost(limits)
