"""Stroke of a block, swing of a link."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Metric, MetricValue, Number
from linkwright.analysis.outputs import turns_fully
from linkwright.analysis.range_of_motion import between, reached_inputs
from linkwright.core.outputs import Output
from linkwright.cycle.summaries import Summary
from linkwright.words import _


@METRICS.register("stroke")
class Stroke(Metric):
    """Travel of every block on the frame between its outermost positions, m."""

    label = _("stroke")
    meaning = _("Travel of a block between its outermost positions.")

    rank = 1
    dimension = "length"
    source = "IFToMM terminology: travel between limit positions"
    kind = "displacement"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and bool(self._swinging(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for output in self._swinging(analysis):
            yield Number(str(output), (Summary(output.name, "range"),))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        """Those of a machine that reaches several stretches are of each of them."""
        stretches = analysis.resolver.stretches if analysis.partial else ()
        if len(stretches) < 2 or analysis.ways is None:
            yield from super().values(analysis)
            return
        for output in self._swinging(analysis):
            for (way, exact), stretch in zip(analysis.ranges(output), stretches, strict=True):
                remarks = (between(*reached_inputs(analysis, *stretch), analysis.input_dimension),)
                yield self.value(analysis, str(output), way, exact=exact, remarks=remarks)

    def _swinging(self, analysis: Analysis) -> list[Output]:
        motion = analysis.motion
        return [o for o in analysis.outputs if o.kind == self.kind and motion.ok.any() and not turns_fully(motion, o)]


@METRICS.register("swing_angle")
class SwingAngle(Stroke):
    """Angle between the outermost positions of every link that swings about the frame, rad."""

    label = _("swing angle")
    meaning = _("Angle of a link between its outermost positions.")

    dimension = "angle"
    kind = "angle"
