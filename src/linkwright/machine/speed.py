"""The true speed over the cycle, by the equation of motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field
from functools import cached_property, partial

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.core.piecewise import (
    POINTS,
    WEIGHTS,
    Extreme,
    Floats,
    Function,
    Integral,
    Piecewise,
    at_nodes,
    nodes,
)
from linkwright.errors import LinkwrightError
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.words.sentence import Sentence

#: A machine whose kinetic energy falls below this share of that at its mean speed stops.
STOPPED = 1e-9
#: Share of the smallest kinetic energy in which a Newton step is the last one: what is left is its square.
LAST = 1e-9
#: How often pieces are halved where the speed that was found is not smooth, and it is found again.
ROUNDS = 8


@dataclass(frozen=True)
class SpeedCurve:
    """Speed of the input over one period of steady running.

    ``angle`` (n,) rad turned and ``speed`` (n,) there, both ends of the period among them; ``mean`` the angle
    of the period over its time; ``slowest`` and ``fastest``: (angle, speed); ``motor_torque`` the constant one, N·m;
    ``acceleration(angle)`` rad/s².
    """

    angle: Floats
    mean: float
    slowest: tuple[float, float]
    fastest: tuple[float, float]
    motor_torque: float
    at: Function = field(repr=False)

    @cached_property
    def speed(self) -> Floats:
        """Speed at the angles, (n,) rad/s."""
        return self.at(self.angle)

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
    return SteadyCycle(given.minus(load).work, total, speed).curve(motor_torque=given.mean, steps=steps)


class SteadyCycle:
    """The speed over one period from the excess work, J, with more or less of a flywheel, kg·m².

    ``own``: inertia without it, over the angle.
    """

    def __init__(self, work: Integral, own: Function, speed: float) -> None:
        self.work, self.own, self.speed = work, own, speed
        self._done, self._inertia = work.at_nodes.ravel(), at_nodes(own, work.edges).ravel()
        self._shares = _shares(work.edges)
        self._least = Piecewise(work.edges, work.at_nodes).extreme("min").value
        self._known: dict[float, tuple[float, Extreme, Extreme]] = {}

    def curve(self, flywheel: float = 0.0, *, motor_torque: float, steps: int = 360) -> SpeedCurve:
        """The speed; raises LinkwrightError for a machine that would stop, or has no inertia somewhere."""
        energy, *extremes = self._solved(flywheel)
        start, end = self.work.edges[[0, -1]].tolist()
        angle = np.linspace(start, end, steps + 1)
        low, high = ((found.place, found.value) for found in extremes)
        return SpeedCurve(angle, self.speed, low, high, motor_torque, partial(self._at, flywheel, energy))

    def fluctuation(self, flywheel: float) -> float:
        """Coefficient of speed fluctuation; raises as ``curve``."""
        _, low, high = self._solved(flywheel)
        return (high.value - low.value) / self.speed

    def _solved(self, flywheel: float) -> tuple[float, Extreme, Extreme]:
        """Energy at the period's begin, J, the smallest and the largest speed."""
        if flywheel not in self._known:
            self._known[flywheel] = self._found(flywheel)
        return self._known[flywheel]

    def _found(self, flywheel: float) -> tuple[float, Extreme, Extreme]:
        edges, done, inertia, shares = self.work.edges, self._done, flywheel + self._inertia, self._shares
        for _ in range(ROUNDS):
            energy = _initial_energy(done, inertia, shares, self.speed, self._least)
            speed = np.sqrt(2.0 * (energy + done) / inertia).reshape(-1, POINTS)
            curve = Piecewise(edges, speed)
            if curve.smooth.all():
                break
            curve = Piecewise(edges, speed, partial(self._at, flywheel, energy), edges)
            if len(curve.edges) == len(edges):
                break
            edges = curve.edges
            at, shares = nodes(edges).ravel(), _shares(edges)
            done, inertia = self.work(at), flywheel + self.own(at)
        return energy, *curve.extremes()

    def _at(self, flywheel: float, energy: float, angle: Floats) -> Floats:
        return np.asarray(np.sqrt(2.0 * (energy + self.work(angle)) / (flywheel + self.own(angle))))


def _shares(edges: Floats) -> Floats:
    """Shares of all Gauss points in the way between the outer edges."""
    widths = np.diff(edges)[:, None]
    return np.asarray((0.5 * widths * WEIGHTS).ravel() / (edges[-1] - edges[0]))


def _constant(inertia: float) -> Function:
    if not inertia > 0:
        raise LinkwrightError(Sentence("running.bad_inertia", inertia=inertia))
    return partial(_same, float(inertia))


def _same(value: float, angle: Floats) -> Floats:
    return np.full(angle.shape, value)


def _initial_energy(work: Floats, inertia: Floats, weights: Floats, speed: float, least: float) -> float:
    """E0 with which the mean of 1/ω over the angle is 1/speed, by safeguarded Newton steps.

    ``weights`` of the mean over the angle at the places of ``work`` and ``inertia``; ``least``: smallest work, J.
    """
    if not (inertia > 0).all():
        raise LinkwrightError(Sentence("running.no_inertia"))
    low, scale = -least, 0.5 * speed * speed * float(inertia.max())
    high = low + scale
    energy = 0.5 * speed * speed * float(weights @ inertia) - float(weights @ work)
    energy = energy if low < energy < high else high
    half = 0.5 * inertia
    for _ in range(200):
        kinetic = energy + work
        slowness = np.sqrt(half / kinetic) * weights
        gap, slope = float(slowness.sum()) - 1.0 / speed, -0.5 * float((slowness / kinetic).sum())
        low, high = (energy, high) if gap > 0 else (low, energy)
        newton = energy - gap / slope
        before, energy = energy, newton if low < newton < high else 0.5 * (low + high)
        if abs(energy - before) <= max(1e-15 * scale, LAST * (energy + least) if energy == newton else 0.0):
            break
    if energy + least <= STOPPED * scale:
        raise LinkwrightError(Sentence("running.would_stop"))
    return energy
