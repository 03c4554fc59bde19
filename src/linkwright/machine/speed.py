"""The true speed over the cycle, by the equation of motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np

from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Floats
from linkwright.curves.curve import Curve, Extreme, Function, Integral, at_nodes, extremes_of
from linkwright.curves.polynomials import WEIGHTS
from linkwright.errors import LinkwrightError
from linkwright.machine.speeds import Speeds, SteadyCycles
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.words import _

#: A machine whose kinetic energy falls below this share of that at its mean speed stops, and one whose inertia falls
#: below this share of the largest has none.
STOPPED, NO_INERTIA = 1e-8, 1e-9
#: Widths, as shares of the period, of pieces next to the place of minimum energy, where a machine almost stops.
NEAR_SHARES = 0.25 * 0.25 ** np.arange(12)
#: A coefficient of speed fluctuation below this is rounding.
ROUNDING = 1e-12
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
        found = (self.fastest[1] - self.slowest[1]) / self.mean
        return found if found > ROUNDING else 0.0

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
    steps: int = STEPS,
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
    from linkwright.machine.torque_curve import energy_fluctuation

    if not speed > 0:
        raise LinkwrightError(
            _("the mean speed is {speed:g} rad/s; give a value above zero", code="running.bad_speed", speed=speed)
        )
    driving = TorqueCurve.constant(load.mean, period=load.period) if driver is None else driver
    if driver is not None:
        energy_fluctuation(driver, load)
    total = inertia if callable(inertia) else _constant(inertia)
    return SteadyCycle(driving.minus(load).work, total, speed).curve(motor_torque=driving.mean, steps=steps)


class SteadyCycle:
    """The speed over one period from the excess work, J, with more or less of a flywheel, kg·m².

    ``own``: inertia without it, over the angle.
    """

    def __init__(self, work: Integral, own: Function, speed: float) -> None:
        self.work, self.own, self.speed = work, own, speed
        inertia = at_nodes(own, work.edges)
        curves = (work, Curve(work.edges, inertia))
        lowest, lightest = extremes_of([(curve, "min") for curve in curves])
        self._minimum, self._slowest_place, self._lightest = lowest.value, lowest.place, lightest.value
        self._first = self._cycles(work.edges, work.values, inertia)
        self._known: dict[float, _Solved] = {}

    def curve(self, flywheel: float = 0.0, *, motor_torque: float, steps: int = STEPS) -> SpeedCurve:
        """The speed; raises LinkwrightError for a machine that would stop, or has no inertia somewhere."""
        found = self._solved(flywheel)
        start, end = self.work.edges[[0, -1]].tolist()
        angle = np.linspace(start, end, steps + 1)
        low, high = ((each.place, each.value) for each in (found.slowest, found.fastest))
        return SpeedCurve(angle, self.speed, low, high, motor_torque, partial(self._at, flywheel, found.energy))

    def fluctuation(self, flywheel: float) -> float:
        """Coefficient of speed fluctuation; raises as ``curve``."""
        found = self._solved(flywheel)
        return (found.fastest.value - found.slowest.value) / self.speed

    def flywheel(self, fluctuation: float, first: float) -> float:
        """The flywheel with which the speed fluctuates by just this share of its mean; zero where none is needed.

        ``first``: one to begin with. Raises as ``curve``, and where none is found.
        """
        edges, cycles = self.work.edges, self._first
        for _unused in range(ROUNDS):
            size = float(cycles.flywheel(fluctuation, np.array([first]))[0])
            if np.isnan(size):
                raise LinkwrightError(
                    _(
                        "no flywheel was found with which the speed fluctuates by just {fluctuation:g}; ask "
                        "for another coefficient",
                        code="running.no_flywheel",
                        fluctuation=fluctuation,
                    )
                )
            finer = self._solved(size).edges
            if len(finer) == len(edges):
                break
            edges, cycles = finer, self._at_edges(finer)
        return size

    def _solved(self, flywheel: float) -> _Solved:
        if flywheel not in self._known:
            self._known[flywheel] = self._found(flywheel)
        return self._known[flywheel]

    def _found(self, flywheel: float) -> _Solved:
        edges, cycles, graded = self.work.edges, self._first, False
        for _unused in range(ROUNDS):
            found = cycles.at(np.array([flywheel]))
            energy = self._energy(found, flywheel)
            if self._stops(energy, found):
                if graded:
                    raise LinkwrightError(
                        _(
                            "the kinetic energy does not suffice to carry the machine over its cycle at this "
                            "mean speed: it would stop; add a flywheel or raise the speed",
                            code="running.would_stop",
                        )
                    )
                edges, graded = self._graded(edges), True
                cycles = self._at_edges(edges)
                continue
            curve = Curve(edges, self.speed * found.values)
            if curve.smooth.all():
                break
            start, end = edges[[0, -1]].tolist()
            curve = Curve.of(partial(self._at, flywheel, energy), start, end, pieces=1, knots=edges)
            if len(curve.edges) == len(edges):
                break
            edges = curve.edges
            cycles = self._at_edges(edges)
        return _Solved(edges, energy, *curve.extremes())

    def _energy(self, found: Speeds, flywheel: float) -> float:
        """The energy at the period's begin, J."""
        most, unit = float(found.inertia.max()), 0.5 * self.speed * self.speed
        if not min(float(found.inertia.min()), flywheel + self._lightest) > NO_INERTIA * most:
            raise LinkwrightError(
                _(
                    "the total moment of inertia is zero somewhere in the cycle; give masses or a flywheel",
                    code="running.no_inertia",
                )
            )
        return unit * float(found.energy[0])

    def _stops(self, energy: float, found: Speeds) -> bool:
        """Whether next to nothing is left of the energy somewhere."""
        most = 0.5 * self.speed * self.speed * float(found.inertia.max())
        return not energy + self._minimum > STOPPED * most

    def _graded(self, edges: Floats) -> Floats:
        """Edges with those of pieces that are the shorter the nearer they are to the place of minimum energy."""
        start, end = edges[[0, -1]].tolist()
        more = self._slowest_place + np.concatenate([[0.0], NEAR_SHARES, -NEAR_SHARES]) * (end - start)
        return np.unique(np.concatenate([edges, more[(more > start) & (more < end)]]))

    def _at_edges(self, edges: Floats) -> SteadyCycles:
        return self._cycles(edges, at_nodes(self.work, edges), at_nodes(self.own, edges))

    def _cycles(self, edges: Floats, work: Floats, inertia: Floats) -> SteadyCycles:
        share = WEIGHTS[:, None] * (np.diff(edges) / (edges[-1] - edges[0]))
        return SteadyCycles(
            np.zeros(len(edges) - 1, dtype=np.intp), share, work / (0.5 * self.speed * self.speed), inertia
        )

    def _at(self, flywheel: float, energy: float, angle: Floats) -> Floats:
        return np.asarray(np.sqrt(2.0 * (energy + self.work(angle)) / (flywheel + self.own(angle))))


@dataclass(frozen=True)
class _Solved:
    """Edges of the pieces, energy at the period's begin, J, the smallest and the largest speed."""

    edges: Floats
    energy: float
    slowest: Extreme
    fastest: Extreme


def _constant(inertia: float) -> Function:
    if not inertia > 0:
        raise LinkwrightError(
            _(
                "the moment of inertia is {inertia:g} kg·m²; give a value above zero",
                code="running.bad_inertia",
                inertia=inertia,
            )
        )
    return partial(_same, float(inertia))


def _same(value: float, angle: Floats) -> Floats:
    return np.full(angle.shape, value)
