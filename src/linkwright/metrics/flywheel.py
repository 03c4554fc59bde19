"""Energy fluctuation of a cycle at constant speed, and the flywheel that it asks for."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import pi
from typing import ClassVar

import numpy as np

from linkwright.engine.trace import Scalar, maximum, select
from linkwright.metrics.analysis import Analysis
from linkwright.metrics.base import METRICS, Better, Metric, Number

#: A mean torque below this share of the largest one is zero.
NOTHING = 1e-9


@METRICS.register("energy_fluctuation")
class EnergyFluctuation(Metric):
    """Largest excess ΔE of the energy that a constant torque supplies over the energy that the machine takes, J."""

    name = "energy_fluctuation"
    rank = 3
    dimension = "energy"
    source = "Shigley, Theory of Machines; Norton, Design of Machinery, sec. 11.11: ∫ (mean - T) dφ"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True

    def suits(self, analysis: Analysis) -> bool:
        """For one driver that turns at constant speed through whole turns, and does work."""
        if not (
            super().suits(analysis) and analysis.whole and analysis.loaded and analysis.forces is not None
        ):
            return False
        rate, period = analysis.input_rate, analysis.motion.positions.period or 0.0
        if len(analysis.motion.mechanism.drivers) != 1 or analysis.input_dimension != "angle" or not rate[0]:
            return False
        turns = abs(rate[0]) * period / (2 * pi)
        steady = np.ptp(rate) <= 1e-9 * abs(rate[0]) and abs(turns - round(turns)) <= 1e-9
        torque = np.sign(rate[0]) * analysis.forces.input_torque
        return bool(steady and torque.mean() > NOTHING * np.abs(torque).max())

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        yield Number(next(iter(analysis.motion.mechanism.drivers)), ("input_torque excess",))


@METRICS.register("flywheel")
class Flywheel(EnergyFluctuation):
    """Inertia ΔE/(δ ω²) less the machine's own mean one that keeps the speed even to δ = 0.02, kg·m² on the crank."""

    name = "flywheel"
    dimension = "inertia"

    def __init__(self, fluctuation: float = 0.02) -> None:
        self.fluctuation = fluctuation

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        parts = ("input_torque excess", "equivalent_inertia mean", "input_torque mean", "input_torque peak")
        formula = partial(_inertia, self.fluctuation, float(analysis.input_rate[0]))
        yield Number(next(iter(analysis.motion.mechanism.drivers)), parts, formula)


def _inertia(
    fluctuation: float, speed: float, energy: Scalar, own: Scalar, mean: Scalar, peak: Scalar
) -> Scalar:
    """The flywheel; NaN where the drivers do no work."""
    needed = maximum(energy / (fluctuation * speed * speed) - own, 0.0)
    return select((mean if speed > 0.0 else -mean) > NOTHING * peak, needed, float("nan"))
