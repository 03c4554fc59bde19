"""Input torque (force) and power: peak, root mean square, mean."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number
from linkwright.cycle.summaries import Summary
from linkwright.formula.trace import Scalar, absolute, select
from linkwright.words import Message, _

#: A mean power of this share of the largest one is zero but for rounding.
IDLE = 1e-9
MEAN, PEAK = Summary("power", "mean"), Summary("power", "peak")


class EffortMetric(Metric):
    """What every driver must supply, by one ``kind`` of summary of its ``output`` over the cycle."""

    dimension = "torque"
    source = "kinetostatics: effort of the driver from the joint forces"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True
    rank = 3
    output: ClassVar[str] = "effort"
    kind: ClassVar[str]

    def suits(self, analysis: Analysis) -> bool:
        return super().suits(analysis) and analysis.loaded

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        for name, turns in analysis.motion.positions.rotary.items():
            summary = Summary(f"{name}.{self.output}", self.kind)
            yield Number(name, (summary,), dimension="torque" if turns else "force")


@METRICS.register("peak_input_torque")
class PeakInputTorque(EffortMetric):
    """Largest size of the effort of every driver: N·m where it turns, N where it slides."""

    label = _("peak input torque")
    labels: ClassVar[Mapping[str, Message]] = {"force": _("peak input force")}
    meaning = _("Largest torque (force) that a driver must supply.")

    kind = "peak"


@METRICS.register("rms_input_torque")
class RmsInputTorque(EffortMetric):
    """Root mean square over time of the effort of every driver: what heats a motor."""

    label = _("RMS input torque")
    labels: ClassVar[Mapping[str, Message]] = {"force": _("RMS input force")}
    meaning = _("Root mean square over time of a driver's torque (force).")

    kind = "rms"


class PowerMetric(EffortMetric):
    """The same of the power of all drivers together."""

    dimension = "power"

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        yield Number(analysis.motion.mechanism.name, (Summary("power", self.kind),))


@METRICS.register("peak_power")
class PeakPower(PowerMetric):
    """Largest power that the drivers supply together at any moment."""

    label = _("peak power")
    meaning = _("Largest power that the drivers supply together.")

    kind = "max"


@METRICS.register("mean_power")
class MeanPower(PowerMetric):
    """Mean over time of the power of all drivers: work per cycle over the time of the cycle."""

    label = _("mean power")
    meaning = _("Work of the drivers per cycle over the time of the cycle.")

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        yield Number(analysis.motion.mechanism.name, (MEAN, PEAK), _work)


@METRICS.register("efficiency")
class Efficiency(PowerMetric):
    """Share of the drivers' work that friction of joints leaves: 1 - W_f/W; not positive where loads drive."""

    label = _("efficiency")
    meaning = _("Share of the drivers' work that the friction of joints leaves.")

    dimension = "dimensionless"
    source = "Sun Huan, Theory of Machines and Mechanisms, ch. 5: η = W_r/W_d = 1 - W_f/W_d"
    better: ClassVar[Better | None] = "higher"
    judged_last = True

    def suits(self, analysis: Analysis) -> bool:
        """For machines with friction whose drivers do work."""
        rubbing = any(joint.friction_arm for joint in analysis.motion.mechanism.joints.values())
        if not (rubbing and super().suits(analysis)):
            return False
        mean, peak = (float(analysis.part(each).value) for each in (MEAN, PEAK))
        return mean > IDLE * peak

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        parts = (Summary("friction_power", "mean"), MEAN, PEAK)
        yield Number(analysis.motion.mechanism.name, parts, _efficiency)


def _efficiency(lost: Scalar, mean: Scalar, peak: Scalar) -> Scalar:
    """NaN where the drivers do no work."""
    return select(mean > IDLE * peak, 1.0 - lost / mean, float("nan"))


def _work(mean: Scalar, peak: Scalar) -> Scalar:
    """The mean, zero where it is but rounding."""
    return select(absolute(mean) <= IDLE * peak, 0.0, mean)
