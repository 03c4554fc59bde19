"""The true speed over the cycle, by the equation of motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from linkwright.core.piecewise import POINTS, Floats, Function, Integral, Piecewise
from linkwright.errors import LinkwrightError
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.words.sentence import Sentence

#: A machine whose kinetic energy falls below this share of that at its mean speed stops.
STOPPED = 1e-9


@dataclass(frozen=True)
class SpeedCurve:
    """Speed of the input over one period of steady running.

    ``angle`` (n,) rad turned and ``speed`` (n,) rad/s there, both ends of the period among them; ``mean`` the angle
    of the period over its time; ``slowest`` and ``fastest``: (angle, speed); ``motor_torque`` the constant one, N·m;
    ``acceleration(angle)`` rad/s².
    """

    angle: Floats
    speed: Floats
    mean: float
    slowest: tuple[float, float]
    fastest: tuple[float, float]
    motor_torque: float
    at: Function = field(repr=False)

    @property
    def fluctuation(self) -> float:
        """Coefficient of speed fluctuation really reached, (ω_max - ω_min)/ω_mean."""
        return (self.fastest[1] - self.slowest[1]) / self.mean

    @property
    def periodicity(self) -> float:
        """Speed at the end of the period over the speed at its begin, less 1."""
        return float(self.speed[-1] / self.speed[0] - 1.0)


def true_speed(
    load: TorqueCurve,
    inertia: Callable[[Floats], Floats] | float,
    speed: float,
    *,
    driver: TorqueCurve | None = None,
    steps: int = 360,
) -> SpeedCurve:
    """Speed over the cycle from d(½ J ω²)/dφ = T_driver - T_load, periodic, with the mean speed ``speed``.

    ½ J(φ) ω² = E0 + ∫ (T_driver - T_load) dφ, torques depending on the angle only; E0 follows from the mean speed,
    period over ∮ dφ/ω. Exact for these torques: no small fluctuation is assumed.

    Args:
        load: resisting torque, N·m, over the angle turned.
        inertia: total J, kg·m², constant or a function of the angle (n,) -> (n,).
        speed: mean speed, rad/s, above zero.
        driver: driving torque; a constant one that balances the load where left out.

    Raises:
        LinkwrightError: torques that do not balance, or a machine that would stop within its cycle.
    """
    from linkwright.machine.energy import energy_fluctuation

    if not speed > 0:
        raise LinkwrightError(Sentence("running.bad_speed", speed=speed))
    given = TorqueCurve.constant(load.mean, period=load.period) if driver is None else driver
    if driver is not None:
        energy_fluctuation(driver, load)
    total = inertia if callable(inertia) else _constant(inertia)
    return speed_of(given.minus(load).work, total, speed, motor_torque=given.mean, steps=steps)


def speed_of(
    work: Integral, total: Function, speed: float, *, motor_torque: float, steps: int = 360
) -> SpeedCurve:
    """The same from the excess work over one period, J."""
    edges = work.edges
    start, period = float(edges[0]), float(edges[-1] - edges[0])
    places, weights = work.quadrature
    done, inertia = work(places), total(places)
    least = Piecewise(edges, done.reshape(-1, POINTS)).extreme("min").value
    energy = _initial_energy(done, inertia, weights / period, speed, least)

    at = partial(_speed, energy, work, total)
    curve = Piecewise(edges, np.sqrt(2.0 * (energy + done) / inertia).reshape(-1, POINTS))
    if not curve.smooth.all():
        curve = Piecewise(edges, curve.values, at, edges)
    low, high = curve.extreme("min"), curve.extreme("max")
    angle = np.linspace(start, start + period, steps + 1)
    ends = (low.place, low.value), (high.place, high.value)
    return SpeedCurve(angle, at(angle), speed, *ends, motor_torque, at)


def _constant(inertia: float) -> Function:
    if not inertia > 0:
        raise LinkwrightError(Sentence("running.bad_inertia", inertia=inertia))
    return partial(_same, float(inertia))


def _same(value: float, angle: Floats) -> Floats:
    return np.full(angle.shape, value)


def _speed(energy: float, work: Integral, total: Function, angle: Floats) -> Floats:
    return np.asarray(np.sqrt(2.0 * (energy + work(angle)) / total(angle)))


def _initial_energy(work: Floats, inertia: Floats, weights: Floats, speed: float, least: float) -> float:
    """E0 with which the mean of 1/ω over the angle is 1/speed, by safeguarded Newton steps.

    ``weights`` of the mean over the angle at the places of ``work`` and ``inertia``; ``least``: smallest work, J.
    """
    if not (inertia > 0).all():
        raise LinkwrightError(Sentence("running.no_inertia"))
    low, scale = -least, 0.5 * speed * speed * float(inertia.max())
    high = low + scale
    energy = high

    def slowness(value: float) -> tuple[float, float]:
        root = np.sqrt(0.5 * inertia / (value + work))
        return float(weights @ root) - 1.0 / speed, float(weights @ (-0.5 * root / (value + work)))

    for _ in range(200):
        gap, slope = slowness(energy)
        low, high = (energy, high) if gap > 0 else (low, energy)
        newton = energy - gap / slope
        following = newton if low < newton < high else 0.5 * (low + high)
        if abs(following - energy) <= 1e-15 * scale:
            break
        energy = following
    if energy + least <= STOPPED * scale:
        raise LinkwrightError(Sentence("running.would_stop"))
    return energy
