"""Energy fluctuation of a cycle, and the energy indicator diagram."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.piecewise import POINTS, Floats, Function, Piecewise, increasing, nodes
from linkwright.errors import LinkwrightError
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.words.sentence import Sentence

#: Driver and load must do equal work over a cycle to this share of the work done.
BALANCE = 1e-9


@dataclass(frozen=True)
class EnergyFluctuation:
    """Largest energy excess of a cycle: ``value`` = E(``high``) - E(``low``), J.

    ``low``, ``high``: angles (rad) of slowest and fastest running, or for areas the numbers of the areas after
    which they occur (0: before the first). ``angle``, ``energy``: the indicator diagram, (n,) rad and J from its
    first angle. ``balance``: energy left over a whole cycle, J.
    """

    value: float
    low: float
    high: float
    angle: Floats
    energy: Floats
    balance: float


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
            Sentence(
                "running.speeds_up" if work.total > 0 else "running.slows_down",
                total=work.total,
                mean=driver.mean,
                load=load.mean,
            )
        )
    return of_energy(work, work.edges, balance=work.total)


def of_energy(energy: Function, edges: Floats, *, balance: float) -> EnergyFluctuation:
    """The fluctuation of an excess energy E(θ), smooth between ``edges``, which span one period."""
    pieces = Piecewise(edges, energy(nodes(edges).ravel()).reshape(-1, POINTS))
    low, high = pieces.extremes()
    angle = increasing(np.append(np.linspace(edges[0], edges[-1], 361), [low.place, high.place]))
    return EnergyFluctuation(high.value - low.value, low.place, high.place, angle, pieces(angle), balance)


def fluctuation_from_areas(
    areas: Sequence[float], *, torque_scale: float, angle_scale: float
) -> EnergyFluctuation:
    """From the areas between torque curve and mean line, in turn, positive above it.

    ``areas`` in mm²; ``torque_scale`` N·m per mm; ``angle_scale`` rad per mm. E after each area is the running sum.
    Raises LinkwrightError for no areas, scales that are not above zero, or areas whose sum is not zero.
    """
    given = np.asarray(areas, dtype=float)
    if given.ndim != 1 or not given.size or not np.isfinite(given).all():
        raise LinkwrightError(Sentence("running.areas_list"))
    if not (torque_scale > 0 and angle_scale > 0):
        raise LinkwrightError(Sentence("running.scales"))
    energy = np.concatenate([[0.0], np.cumsum(given)]) * torque_scale * angle_scale
    if abs(given.sum()) > BALANCE * np.abs(given).sum():
        raise LinkwrightError(Sentence("running.areas_sum", total=given.sum()))
    low, high = int(energy.argmin()), int(energy.argmax())
    number = np.arange(len(energy), dtype=float)
    value = float(energy[high] - energy[low])
    return EnergyFluctuation(value, float(low), float(high), number, energy, float(energy[-1]))
