"""Energy fluctuation of a cycle, the flywheel that it asks for, and the true speed under a constant motor torque."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from math import pi
from typing import ClassVar

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.base import METRICS, Better, Metric, Number
from linkwright.analysis.true_speed import TrueSpeedSummary, steady_cycle
from linkwright.cycle.summaries import Summary
from linkwright.errors import LinkwrightError
from linkwright.formula.trace import Scalar, maximum, select
from linkwright.kinetostatics.forces import Forces
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.words import _

#: A mean torque below this share of the largest one is zero.
ZERO_TOLERANCE = 1e-9
#: What a flywheel follows from.
EXCESS, MEAN, PEAK = (Summary("input_torque", kind) for kind in ("excess", "mean", "peak"))
INERTIA = Summary("equivalent_inertia", "mean")


@METRICS.register("energy_fluctuation")
class EnergyFluctuation(Metric):
    """Largest excess ΔE of the energy that a constant torque supplies over the energy that the machine takes, J."""

    label = _("energy fluctuation")
    meaning = _("Largest excess of the energy that a constant torque supplies over what the machine takes.")

    rank = 3
    dimension = "energy"
    source = "Shigley, Theory of Machines; Norton, Design of Machinery, sec. 11.11: ∫ (mean - T) dφ"
    better: ClassVar[Better | None] = "lower"
    needs_forces = True
    judged_last = True

    def suits(self, analysis: Analysis) -> bool:
        """For one driver that turns at constant speed through full turns, and does work."""
        if not (super().suits(analysis) and analysis.complete and analysis.loaded and analysis.forces is not None):
            return False
        rate, period = analysis.input_rate, analysis.motion.positions.period or 0.0
        if len(analysis.motion.mechanism.drivers) != 1 or analysis.input_dimension != "angle" or not rate[0]:
            return False
        turns = abs(rate[0]) * period / (2 * pi)
        steady = np.ptp(rate) <= 1e-9 * abs(rate[0]) and abs(turns - round(turns)) <= 1e-9
        if not steady:
            return False
        analysis.ask((INERTIA, EXCESS, PEAK))  # found together
        mean = float(analysis.part(MEAN).value)
        return abs(mean) > ZERO_TOLERANCE * float(np.abs(analysis.forces.input_torque).max())

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        yield Number(next(iter(analysis.motion.mechanism.drivers)), (EXCESS,))


@METRICS.register("flywheel")
class Flywheel(EnergyFluctuation):
    """Inertia ΔE/(δ ω²) less the machine's own mean one that keeps the speed even to δ = 0.02, kg·m² on the crank."""

    label = _("flywheel inertia (δ = 0.02)")
    meaning = _("Inertia on the crank, beyond the machine's own, that keeps the speed even to δ = 0.02.")

    dimension = "inertia"

    def __init__(self, fluctuation: float = FLUCTUATION) -> None:
        self.fluctuation = fluctuation

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        formula = partial(_inertia, self.fluctuation, float(analysis.input_rate[0]))
        yield Number(next(iter(analysis.motion.mechanism.drivers)), (EXCESS, INERTIA, MEAN, PEAK), formula)


def _inertia(fluctuation: float, speed: float, energy: Scalar, own: Scalar, mean: Scalar, peak: Scalar) -> Scalar:
    """The flywheel; NaN where the drivers do no work."""
    needed = maximum(energy / (fluctuation * speed * speed) - own, 0.0)
    return select(maximum(mean, -mean) > ZERO_TOLERANCE * peak, needed, float("nan"))


class TrueSpeed(EnergyFluctuation):
    """A number of the speed that a constant motor torque gives, with a flywheel for δ (``sized``) or as the machine
    is."""

    source = "½ J ω² = E0 + ∫ (mean - T) dφ with the mean speed; Wittenbauer, Graphische Dynamik"
    on_request = True
    rank = 9
    kind: ClassVar[str]
    sized: ClassVar[bool] = True

    def __init__(self, fluctuation: float = FLUCTUATION) -> None:
        self.fluctuation = fluctuation

    def numbers(self, analysis: Analysis) -> Iterator[Number]:
        part = TrueSpeedSummary("true speed", self.kind, self.fluctuation if self.sized else None)
        yield Number(next(iter(analysis.motion.mechanism.drivers)), (part,))

    def obstacle(self, analysis: Analysis) -> str | None:
        """What ``steady_running`` says of a machine that does not run steadily, takes no work, or would stop."""
        if analysis.forces is None:
            return None
        try:
            self.require(analysis.forces)
        except LinkwrightError as error:
            return error.sentence
        return None

    def require(self, forces: Forces) -> None:
        """Raises LinkwrightError for a machine without the number."""
        from linkwright.machine.running import require_steady

        require_steady(forces)


@METRICS.register("exact_flywheel")
class ExactFlywheel(TrueSpeed):
    """Inertia beyond the machine's own with which the true speed fluctuates by just δ = 0.02, kg·m² on the crank."""

    label = _("exact flywheel inertia (δ = 0.02)")
    meaning = _(
        "Inertia on the crank, beyond the machine's own, with which the true speed under a "
        "constant motor torque fluctuates by just δ = 0.02."
    )

    dimension = "inertia"
    kind = "size"


@METRICS.register("reached_fluctuation")
class ReachedFluctuation(TrueSpeed):
    """δ = (ω_max - ω_min)/ω_mean of the true speed with the flywheel that the formula gives for δ = 0.02."""

    label = _("speed fluctuation reached (δ = 0.02 by the formula)")
    meaning = _(
        "Fluctuation of the true speed, as share of the mean, with the flywheel that the formula gives for δ = 0.02."
    )

    dimension = "dimensionless"
    better = None
    kind = "fluctuation"


@METRICS.register("speed_fluctuation")
class SpeedFluctuation(TrueSpeed):
    """δ = (ω_max - ω_min)/ω_mean of the true speed with the inertia that the machine has, a flywheel the crank's."""

    label = _("speed fluctuation")
    meaning = _(
        "Fluctuation of the true speed under a constant motor torque, as share of the mean, "
        "with the inertia that the machine has."
    )

    dimension = "dimensionless"
    kind = "fluctuation"
    sized = False

    def require(self, forces: Forces) -> None:
        super().require(forces)
        steady_cycle(forces)[1].fluctuation(0.0)


@METRICS.register("slowest_speed")
class SlowestSpeed(SpeedFluctuation):
    """Smallest true speed of the driver with the inertia that the machine has, rad/s."""

    label = _("slowest speed")
    meaning = _(
        "Smallest true speed of the driver under a constant motor torque, with the inertia that the machine has."
    )

    dimension = "angular_velocity"
    better = "higher"
    kind = "slowest"


@METRICS.register("fastest_speed")
class FastestSpeed(SpeedFluctuation):
    """Largest true speed of the driver with the inertia that the machine has, rad/s."""

    label = _("fastest speed")
    meaning = _(
        "Largest true speed of the driver under a constant motor torque, with the inertia that the machine has."
    )

    dimension = "angular_velocity"
    kind = "fastest"


#: Numbers that depend on δ.
SIZED: Mapping[str, type[Flywheel | ExactFlywheel | ReachedFluctuation]] = {
    each.name: each for each in (Flywheel, ExactFlywheel, ReachedFluctuation)
}
