"""Limit positions: where an output reverses."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.outputs import Output
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue, Number


@METRICS.register("limit_position")
class LimitPosition(Metric):
    """Every position in which an output reverses: its angle or displacement there, and the input."""

    name = "limit_position"
    dimension = "angle"
    source = "IFToMM terminology: the output's velocity is zero"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(analysis.limits(output) for output in analysis.outputs)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        """The outermost ones of a closed cycle."""
        for output, subject, kind in outermost_limits(analysis):
            yield Number(subject, (f"{output.owner}.{output.kind} {kind}",), dimension=output.dimension)

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


def outermost_limits(analysis: Analysis) -> Iterator[tuple[Output, str, str]]:
    """Outputs with limits in a closed cycle, with subject and kind of the outermost ones, the first in time first."""
    for output in analysis.outputs if analysis.whole else ():
        for kind in dict.fromkeys(limit.kind for limit in analysis.limits(output)):
            yield output, f"{output} {kind}", kind
