"""Energy fluctuation of a cycle, and the energy indicator diagram."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.search import first_largest
from linkwright.curves.curve import Curve, increasing
from linkwright.errors import LinkwrightError
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.words import _

#: Driver and load must do equal work over a cycle to this share of the work done.
BALANCE = 1e-9
#: An energy below this share of the work of a cycle is rounding.
ROUNDING = 1e-13


@dataclass(frozen=True)
class EnergyFluctuation:
    """Largest energy excess of a cycle: ``value`` = E(``high``) - E(``low``), J.

    ``low``, ``high``: angles (rad) of slowest and fastest running, or for areas the numbers of the areas after
    which they occur (0: before the first). ``balance``: energy left over a full cycle, J. ``diagram`` gives
    ``angle`` and ``energy``, the indicator diagram, rad and J from its first angle, when it is asked for.
    """

    value: float
    low: float
    high: float
    balance: float
    diagram: Callable[[], tuple[Floats, Floats]] = field(repr=False)

    @property
    def angle(self) -> Floats:
        """Places of the indicator diagram, (n,)."""
        return self._shown[0]

    @property
    def energy(self) -> Floats:
        """Energy there, (n,) J."""
        return self._shown[1]

    def without_rounding(self, work: float) -> EnergyFluctuation:
        """The same with energies set to zero that are mere rounding of the work of a cycle, J."""
        value = self.value if self.value >= ROUNDING * work else 0.0
        return replace(self, value=value, diagram=partial(_without_rounding, self, ROUNDING * work))

    @cached_property
    def _shown(self) -> tuple[Floats, Floats]:
        return self.diagram()


def energy_fluctuation(driver: TorqueCurve, load: TorqueCurve | None = None) -> EnergyFluctuation:
    """Largest excess of the driver's work over the load's: ΔE = max W - min W, W(θ) = ∫ (T_driver - T_load) dθ.

    Without ``load`` a constant load of the driver's mean torque. Raises LinkwrightError where driver and load do not
    do the same work over a cycle, since then the speed does not return.
    """
    if load is None:
        load = TorqueCurve.constant(driver.mean, period=driver.period)
    excess = driver.minus(load)
    work = excess.work
    done = max(abs(driver.mean), abs(load.mean)) * excess.period
    if abs(work.total) > BALANCE * max(done, float(np.abs(work(work.edges)).max())):
        raise LinkwrightError(
            (
                _(
                    "driver and load do not balance: over a cycle {total:.6g} J are left, so the speed "
                    "would rise from cycle to cycle; make their mean torques equal ({mean:.6g} N·m and "
                    "{load:.6g} N·m)",
                    code="running.speeds_up",
                )
                if work.total > 0
                else _(
                    "driver and load do not balance: over a cycle {total:.6g} J are left, so the speed "
                    "would fall from cycle to cycle; make their mean torques equal ({mean:.6g} N·m and "
                    "{load:.6g} N·m)",
                    code="running.slows_down",
                )
            ).format(total=work.total, mean=driver.mean, load=load.mean)
        )
    return of_energy(work, balance=work.total)


def of_energy(energy: Curve, *, balance: float) -> EnergyFluctuation:
    """The fluctuation of an excess energy E(θ) over one period."""
    low, high = energy.extremes()
    diagram = partial(_diagram, energy, low.place, high.place)
    return EnergyFluctuation(high.value - low.value, low.place, high.place, balance, diagram)


def _without_rounding(found: EnergyFluctuation, negligible: float) -> tuple[Floats, Floats]:
    return found.angle, np.where(np.abs(found.energy) < negligible, 0.0, found.energy)


def _diagram(energy: Curve, low: float, high: float) -> tuple[Floats, Floats]:
    begin, end = energy.edges[[0, -1]]
    angle = increasing(np.append(np.linspace(begin, end, 361), [low, high]))
    return angle, energy(angle)


def fluctuation_from_areas(areas: Sequence[float], *, torque_scale: float, angle_scale: float) -> EnergyFluctuation:
    """From the areas between torque curve and mean line, in turn, positive above it.

    ``areas`` in mm²; ``torque_scale`` N·m per mm; ``angle_scale`` rad per mm. E after each area is the running sum.
    Raises LinkwrightError for no areas, scales that are not above zero, or areas whose sum is not zero.
    """
    values = np.asarray(areas, dtype=float)
    if values.ndim != 1 or not values.size or not np.isfinite(values).all():
        raise LinkwrightError(
            _("give the areas as a list of numbers in mm², in the order of the diagram", code="running.areas_list")
        )
    if not (torque_scale > 0 and angle_scale > 0):
        raise LinkwrightError(
            _("the scales of the torque diagram must be above zero: N·m per mm, rad per mm", code="running.scales")
        )
    energy = np.concatenate([[0.0], np.cumsum(values)]) * torque_scale * angle_scale
    if abs(values.sum()) > BALANCE * np.abs(values).sum():
        raise LinkwrightError(
            _(
                "the areas add up to {total:g} mm², not to zero: the mean line is misplaced or an area is missing",
                code="running.areas_sum",
                total=values.sum(),
            )
        )
    low, high = first_largest(-energy), first_largest(energy)
    value = float(energy[high] - energy[low])
    diagram = partial(_areas, energy)
    return EnergyFluctuation(value, float(low), float(high), float(energy[-1]), diagram)


def _areas(energy: Floats) -> tuple[Floats, Floats]:
    return np.arange(len(energy), dtype=float), energy
