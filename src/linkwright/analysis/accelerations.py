"""Largest acceleration and jerk of outputs and free points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number
from linkwright.analysis.outputs import free_points
from linkwright.cycle.summaries import Summary
from linkwright.words import _


@METRICS.register("peak_acceleration")
class PeakAcceleration(Metric):
    """Largest size of the acceleration of every output and free point: m/s², or rad/s² of a swinging link."""

    label = _("peak acceleration")
    meaning = _("Largest acceleration of an output or a free point.")

    rank: ClassVar[float] = 1.5
    dimension = "acceleration"
    source = "kinematics: exact second derivatives"
    better: ClassVar[Better | None] = "lower"
    word: ClassVar[str] = "acceleration"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(self.numbers(analysis))

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for output in analysis.outputs:
            rate = output.course[2] if self.word == "acceleration" else output.course[2].rate
            yield Number(str(output), (Summary(rate.name, "peak"),), dimension=rate.dimension)
        for point in free_points(analysis.motion.mechanism):
            yield Number(point, (Summary(f"{point}.{self.word}", "max"),), dimension=self.word)


@METRICS.register("peak_jerk")
class PeakJerk(PeakAcceleration):
    """Largest size of the exact time derivative of the acceleration of every output and free point.

    For drivers of constant speed; other laws have no third derivative here.
    """

    label = _("peak jerk")
    meaning = _("Largest time derivative of the acceleration of an output or a free point, exact.")

    rank = 9.0
    dimension = "jerk"
    source = "kinematics: exact derivative of the acceleration program"
    word = "jerk"

    def suits(self, analysis: Analysis) -> bool:
        drivers = analysis.motion.mechanism.drivers.values()
        return super().suits(analysis) and all(driver.law.constant_speed is not None for driver in drivers)
