"""Input torque (force) and power: peak, root mean square, mean."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import ClassVar

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.kinetostatics.forces import Forces
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue


class EffortMetric(Metric):
    """What drivers must supply."""

    dimension = "torque"
    source = "kinetostatics: effort of the driver from the joint forces"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.loaded

    @staticmethod
    def effort_dimension(analysis: Analysis, name: str) -> str:
        """Torque of a turning driver, force of a sliding one."""
        return "torque" if analysis.motion.positions.rotary[name] else "force"


def _size(forces: Forces, name: str) -> Floats:
    return np.asarray(np.abs(forces.driver_effort(name)))


@METRICS.register("peak_input_torque")
class PeakInputTorque(EffortMetric):
    """Largest size of the effort of every driver: N·m where it turns, N where it slides."""

    name = "peak_input_torque"
    rank = 3

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for name in analysis.motion.mechanism.drivers:
            found = analysis.extreme(partial(_size, name=name), "max", of="forces")
            if found is not None:
                kind = self.effort_dimension(analysis, name)
                yield self.value(
                    analysis, name, found.value, dimension=kind, at=found.input, exact=found.exact
                )


@METRICS.register("rms_input_torque")
class RmsInputTorque(EffortMetric):
    """Root mean square over time of the effort of every driver: what heats a motor."""

    name = "rms_input_torque"
    rank = 3

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for name in analysis.motion.mechanism.drivers:
            root = analysis.rms_of(partial(_size, name=name))
            yield self.value(analysis, name, root, dimension=self.effort_dimension(analysis, name))


def power(forces: Forces) -> Floats:
    """Power of all drivers together, (n,) W."""
    return forces.power


@METRICS.register("peak_power")
class PeakPower(EffortMetric):
    """Largest power that the drivers supply together at any moment."""

    name = "peak_power"
    rank = 3
    dimension = "power"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        found = analysis.extreme(power, "max", of="forces")
        if found is not None:
            subject = analysis.motion.mechanism.name
            yield self.value(analysis, subject, found.value, at=found.input, exact=found.exact)


@METRICS.register("mean_power")
class MeanPower(EffortMetric):
    """Mean over time of the power of all drivers: work per cycle over the time of the cycle."""

    name = "mean_power"
    rank = 3
    dimension = "power"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        yield self.value(analysis, analysis.motion.mechanism.name, analysis.mean_of(power))
