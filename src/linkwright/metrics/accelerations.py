"""Largest acceleration and jerk of outputs and free points."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical, find_point
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue
from linkwright.metrics.jerk import TimeDerivative, has_rates_in_time
from linkwright.metrics.outputs import free_points

Traced = tuple[str, str, tuple[str, ...]]


def traced(analysis: Analysis) -> Iterator[Traced]:
    """Name, dimension (of a length or an angle) and acceleration outputs of what a designer looks at."""
    for output in analysis.outputs:
        prefix = "g" if output.kind == "angle" else "sa"
        yield str(output), output.dimension, (f"{prefix}:{output.owner}",)
    mechanism = analysis.motion.mechanism
    for name in free_points(mechanism):
        key = canonical(mechanism, *find_point(mechanism, name))
        yield name, "length", (f"a:{key}.x", f"a:{key}.y")


@METRICS.register("peak_acceleration")
class PeakAcceleration(Metric):
    """Largest size of the acceleration of every output and free point: m/s², or rad/s² of a swinging link."""

    name = "peak_acceleration"
    rank = 1.5
    dimension = "acceleration"
    source = "kinematics: exact second derivatives"
    better: ClassVar[Better | None] = "lower"

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and any(traced(analysis))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for subject, kind, names in traced(analysis):
            found = analysis.extreme(_acceleration(names), "max")
            if found is not None:
                dimension = "acceleration" if kind == "length" else "angular_acceleration"
                where: dict[str, Any] = {"at": found.input, "exact": found.exact}
                yield self.value(analysis, subject, found.value, dimension=dimension, **where)


@METRICS.register("peak_jerk")
class PeakJerk(Metric):
    """Largest size of the exact time derivative of the acceleration of every output and free point.

    For drivers of constant speed; other laws have no third derivative here.
    """

    name = "peak_jerk"
    dimension = "jerk"
    source = "kinematics: exact derivative of the acceleration program"
    better: ClassVar[Better | None] = "lower"

    def suits(self, analysis: Analysis) -> bool:
        return has_rates_in_time(analysis.motion) and any(traced(analysis))

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for subject, kind, names in traced(analysis):
            found = analysis.extreme(_jerk(TimeDerivative(analysis.motion, names)), "max")
            if found is not None:
                dimension = "jerk" if kind == "length" else "angular_jerk"
                where: dict[str, Any] = {"at": found.input, "exact": found.exact}
                yield self.value(analysis, subject, found.value, dimension=dimension, **where)


def _acceleration(names: tuple[str, ...]) -> Callable[[Motion], Floats]:
    return lambda motion: _size(np.stack(motion.rows.fetch(names, motion.evaluate)))


def _jerk(derivative: TimeDerivative) -> Callable[[Motion], Floats]:
    return lambda motion: _size(derivative.of(motion))


def _size(rows: Floats) -> Floats:
    return np.asarray(np.abs(rows[0]) if len(rows) == 1 else np.hypot(rows[0], rows[1]))
