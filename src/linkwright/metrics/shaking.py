"""Shaking force and moment on the frame."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, Number


class Shaking(Metric):
    """What the inertia of the moving links puts on the frame."""

    source = "Norton, Design of Machinery, ch. 11: minus the sum of m a_G, and its moment"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True
    rank = 5
    summary: ClassVar[str]

    def suits(self, analysis: Analysis) -> bool:
        links = analysis.motion.mechanism.links.values()
        return super().suits(analysis) and any(link.mass or link.inertia for link in links)

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        yield Number("frame", (self.summary,))


@METRICS.register("peak_shaking_force")
class PeakShakingForce(Shaking):
    """Largest resultant of the inertia forces on the frame, N."""

    dimension = "force"
    summary = "shaking_force max"


@METRICS.register("peak_shaking_moment")
class PeakShakingMoment(Shaking):
    """Largest moment of the inertia forces about the frame's origin, N·m."""

    dimension = "torque"
    summary = "shaking_moment peak"
