"""Stroke of a block, swing of a link."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue
from linkwright.metrics.outputs import turns_fully, value
from linkwright.model.signal_fields import Output


def travel(analysis: Analysis, output: Output) -> float:
    """Largest minus smallest value of an output over the cycle, limit positions and ends counted."""
    values = value(analysis.motion, output)
    reached = [float(v) for v in values[np.isfinite(values)]]
    reached += [limit.value for limit in analysis.limits(output)]
    return max(reached) - min(reached)


@METRICS.register("stroke")
class Stroke(Metric):
    """Travel of every block on the frame between its outermost positions, m."""

    name = "stroke"
    rank = 1
    dimension = "length"
    source = "IFToMM terminology: travel between limit positions"
    kind = "displacement"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(self._swinging(analysis))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in self._swinging(analysis):
            yield self.value(
                analysis, str(output), travel(analysis, output), exact=analysis.resolver.possible
            )

    def _swinging(self, analysis: Analysis) -> list[Output]:
        motion = analysis.motion
        return [
            o
            for o in analysis.outputs
            if o.kind == self.kind and motion.ok.any() and not turns_fully(motion, o)
        ]


@METRICS.register("swing_angle")
class SwingAngle(Stroke):
    """Angle between the outermost positions of every link that swings about the frame, rad."""

    name = "swing_angle"
    rank = 1
    dimension = "angle"
    kind = "angle"
