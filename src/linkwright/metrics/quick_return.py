"""Quick-return ratio, and the crank angle between the limit positions."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np

from linkwright.loads.phases import outermost
from linkwright.loads.signals import Limit
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Metric, MetricValue
from linkwright.model.signal_fields import Output


def slow_and_fast(analysis: Analysis, output: Output) -> tuple[float, float, Limit] | None:
    """Times of the slow and of the fast stroke, s, and where the slow one begins.

    None where the output has no two outermost positions in a closed cycle.
    """
    ends = outermost(analysis.limits(output)) if analysis.limits(output) else []
    period = analysis.motion.positions.period
    if len(ends) != 2 or ends[0].kind == ends[1].kind or period is None:
        return None
    first, last = ends
    share = (last.time - first.time) % period
    return (share, period - share, first) if share >= period / 2 else (period - share, share, last)


@METRICS.register("quick_return_ratio")
class QuickReturnRatio(Metric):
    """K = time of the slow stroke / time of the fast one = (π + θ)/(π - θ) ≥ 1 at uniform crank speed."""

    name = "quick_return_ratio"
    rank = 1
    dimension = "dimensionless"
    source = "IFToMM terminology, time ratio; Norton, Design of Machinery, ch. 3"

    def suits(self, analysis: Analysis) -> bool:
        steady = analysis.whole and bool(np.ptp(analysis.input_rate) <= 1e-9 * abs(analysis.input_rate[0]))
        return (
            super().suits(analysis) and steady and any(slow_and_fast(analysis, o) for o in analysis.outputs)
        )

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in analysis.outputs:
            found = slow_and_fast(analysis, output)
            if found is not None:
                slow, fast, begin = found
                yield self.value(analysis, str(output), self._number(slow, fast), at=begin.input)

    def _number(self, slow: float, fast: float) -> float:
        return slow / fast


@METRICS.register("crank_angle_between_limits")
class CrankAngleBetweenLimits(QuickReturnRatio):
    """Acute angle θ between the crank's directions in the limit positions: π (K - 1)/(K + 1)."""

    name = "crank_angle_between_limits"
    rank = 1
    dimension = "angle"

    def _number(self, slow: float, fast: float) -> float:
        return pi * (slow - fast) / (slow + fast)
