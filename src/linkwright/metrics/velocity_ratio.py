"""Velocity ratio and mechanical advantage from the input to an output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import ClassVar

import numpy as np

from linkwright.kinematics.cycle import Floats
from linkwright.kinematics.motion import Motion
from linkwright.metrics.analysis import Analysis, Extreme
from linkwright.metrics.base import METRICS, Better, Metric, MetricValue
from linkwright.metrics.outputs import rate
from linkwright.model.signal_fields import Output

#: Dimension of output rate over input rate, by the kinds of output and input.
RATIO = {
    ("angle", "angle"): "dimensionless",
    ("length", "length"): "dimensionless",
    ("length", "angle"): "length_per_angle",
    ("angle", "length"): "angle_per_length",
}


def ratio(output: Output) -> Callable[[Motion], Floats]:
    """Output rate over input rate, (n,)."""

    def signal(motion: Motion) -> Floats:
        with np.errstate(all="ignore"):
            return np.asarray(rate(motion, output) / next(iter(motion.positions.coordinates.values()))[1])

    return signal


def largest(analysis: Analysis, output: Output) -> Extreme | None:
    """The velocity ratio of largest size."""
    signal = ratio(output)
    high, low = analysis.extreme(signal, "max"), analysis.extreme(signal, "min")
    if high is None or low is None:
        return None
    return high if abs(high.value) >= abs(low.value) else low


@METRICS.register("velocity_ratio")
class VelocityRatio(Metric):
    """The output's rate over the input's where it is largest in size; negative where they turn against each other."""

    name = "velocity_ratio"
    rank = 3.5
    dimension = "dimensionless"
    source = "Norton, Design of Machinery, sec. 6.4"

    def suits(self, analysis: Analysis) -> bool:
        if len(analysis.motion.mechanism.drivers) != 1 or not analysis.outputs:
            return False
        return bool((np.abs(analysis.input_rate) > 0).all())

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in analysis.outputs:
            found = largest(analysis, output)
            if found is not None:
                kind = RATIO[output.dimension, analysis.input_dimension]
                subject = str(output)
                yield self.value(
                    analysis, subject, found.value, dimension=kind, at=found.input, exact=found.exact
                )


@METRICS.register("mechanical_advantage")
class MechanicalAdvantage(VelocityRatio):
    """Smallest output force (torque) per input torque (force) without losses: 1/|velocity ratio|."""

    name = "mechanical_advantage"
    rank = 3.5
    source = "Norton, Design of Machinery, sec. 6.4: power in equals power out"
    better: ClassVar[Better | None] = "higher"

    def values(self, analysis: Analysis) -> Iterator[MetricValue]:
        for output in analysis.outputs:
            found = largest(analysis, output)
            if found is not None and found.value != 0.0:
                kind = RATIO[analysis.input_dimension, output.dimension]
                advantage = 1.0 / abs(found.value)
                yield self.value(
                    analysis, str(output), advantage, dimension=kind, at=found.input, exact=found.exact
                )
