"""Shaking force and moment on the frame."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

import numpy as np

from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue


class Shaking(Metric):
    """What the inertia of the moving links puts on the frame."""

    source = "Norton, Design of Machinery, ch. 11: minus the sum of m a_G, and its moment"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def suits(self, analysis: Analysis) -> bool:
        links = analysis.motion.mechanism.links.values()
        return super().suits(analysis) and any(link.mass or link.inertia for link in links)


@METRICS.register("peak_shaking_force")
class PeakShakingForce(Shaking):
    """Largest resultant of the inertia forces on the frame, N."""

    name = "peak_shaking_force"
    rank = 5
    dimension = "force"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        found = analysis.extreme(lambda f: np.hypot(*f.shaking_force.T), "max", of="forces")
        if found is not None:
            yield self.value(analysis, "frame", found.value, at=found.input, exact=found.exact)


@METRICS.register("peak_shaking_moment")
class PeakShakingMoment(Shaking):
    """Largest moment of the inertia forces about the frame's origin, N·m."""

    name = "peak_shaking_moment"
    rank = 5
    dimension = "torque"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        found = analysis.extreme(lambda f: np.abs(f.shaking_moment), "max", of="forces")
        if found is not None:
            yield self.value(analysis, "frame", found.value, at=found.input, exact=found.exact)
