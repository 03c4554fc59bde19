"""Torque curves over the angle, with or without a mechanism, and the fluctuation of energy between two of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin
from linkwright.core.expressions import Expression, parse
from linkwright.core.search import first_largest
from linkwright.curves.curve import Curve, Integral, increasing
from linkwright.errors import LinkwrightError
from linkwright.words import _

TURN = 2 * np.pi


@dataclass(frozen=True)
class TorqueCurve(PlotMixin):
    """Torque T(θ), N·m, periodic in θ with ``period`` rad; ``knots``: angles at which it may kink or jump.

    ``function`` takes angles (n,) within one period from ``start`` and gives torques (n,); ``known``: the same as
    polynomials over one period, where it comes as these.
    """

    function: Callable[[Floats], Floats] = field(repr=False)
    period: float = TURN
    start: float = 0.0
    knots: tuple[float, ...] = field(default=(), repr=False)
    known: Curve | None = field(default=None, repr=False)

    @classmethod
    def from_pieces(cls, pieces: Curve) -> TorqueCurve:
        """From polynomials over one period."""
        start, end = float(pieces.edges[0]), float(pieces.edges[-1])
        return cls(pieces, end - start, start, tuple(pieces.edges.tolist()), pieces)

    @classmethod
    def from_function(
        cls, torque: str | Callable[[Floats], ArrayLike] | ArrayLike, *, period: float = TURN
    ) -> TorqueCurve:
        """From an expression of ``theta`` (``"5000 + 600*sin(2*theta)"``, N·m and rad), a function, or an array.

        An array holds torques at equal steps over one period, the first at 0, straight lines between them.
        Raises LinkwrightError for a text that is no expression of theta, or a period that is not above zero.
        """
        if not period > 0:
            raise LinkwrightError(
                _(
                    "the period of a torque curve is {period:g} rad; give an angle above zero",
                    code="running.bad_period",
                    period=period,
                )
            )
        if isinstance(torque, str):
            return cls(partial(_expressed, parse(torque, ("theta",))), period)
        if callable(torque):
            return cls(partial(_evaluated, torque), period)
        values = np.asarray(torque, dtype=float)
        return cls.from_table(np.arange(values.size) * period / max(values.size, 1), values, period=period)

    @classmethod
    def from_table(cls, angle: ArrayLike, torque: ArrayLike, *, period: float = TURN) -> TorqueCurve:
        """Straight lines between torques (N·m) at increasing angles (rad) within one period, closed periodically.

        A jump is two equal angles. Raises LinkwrightError for angles that do not increase or exceed the period.
        """
        x, y = np.atleast_1d(np.asarray(angle, dtype=float)), np.atleast_1d(np.asarray(torque, dtype=float))
        if x.shape != y.shape or x.ndim != 1 or len(x) < 2:
            raise LinkwrightError(
                _("a torque table needs as many torques as angles, two or more of each", code="running.bad_table")
            )
        if not (np.isfinite(x).all() and np.isfinite(y).all()):
            raise LinkwrightError(
                _("a torque table holds a number that is not finite", code="running.table_not_finite")
            )
        if (np.diff(x) < 0).any() or x[-1] - x[0] > period * (1 + 1e-12):
            raise LinkwrightError(
                _("the angles of a torque table must increase and lie within one period", code="running.table_order")
            )
        if x[-1] - x[0] < period * (1 - 1e-12):
            x, y = np.append(x, x[0] + period), np.append(y, y[0])
        return cls(partial(_linear, x, y), period, float(x[0]), tuple(x.tolist()))

    @classmethod
    def constant(cls, torque: float, *, period: float = TURN) -> TorqueCurve:
        """The same torque at all angles."""
        return cls(partial(_constant, float(torque)), period)

    def __call__(self, theta: ArrayLike) -> Floats:
        """Torque at any angles, (n,) N·m."""
        x = np.atleast_1d(np.asarray(theta, dtype=float))
        return np.asarray(self.function(self.start + (x - self.start) % self.period), dtype=float)

    @cached_property
    def pieces(self) -> Curve:
        """The torque over one period as polynomials between its kinks and jumps."""
        if self.known is not None:
            return self.known
        return Curve.of(self.function, self.start, self.start + self.period, knots=np.array(self.knots))

    @cached_property
    def work(self) -> Integral:
        """Work W(θ) from ``start``, J; ``work.total`` that of one period."""
        return self.pieces.integral()

    @property
    def mean(self) -> float:
        """Mean torque over the angle, N·m."""
        return self.pieces.mean

    def minus(self, other: TorqueCurve) -> TorqueCurve:
        """This torque minus another one over their common period, from this one's start.

        Raises LinkwrightError where one period is no integer multiple of the other.
        """
        long, short = max(self.period, other.period), min(self.period, other.period)
        if abs(long / short - round(long / short)) > 1e-9:
            raise LinkwrightError(
                _(
                    "torque curves with periods of {period:g}° and {period2:g}° have no common cycle; "
                    "give both over the same angle",
                    code="running.no_common_period",
                    period=np.degrees(self.period),
                    period2=np.degrees(other.period),
                )
            )
        knots = sorted({k for curve in (self, other) for k in _repeated(curve, self.start, long)})
        return TorqueCurve(partial(_difference, self, other), long, self.start, tuple(knots))

    def extremes(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """(angle, torque) of the smallest and of the largest torque; at a jump one of its sides."""
        low, high = self.pieces.extremes()
        return (low.place, low.value), (high.place, high.value)


def _repeated(curve: TorqueCurve, start: float, length: float) -> list[float]:
    laps = np.arange(-1, round(length / curve.period) + 2) * curve.period
    found = [knot + lap for knot in curve.knots for lap in laps]
    return [float(knot) for knot in found if start <= knot <= start + length]


def _linear(x: Floats, y: Floats, theta: Floats) -> Floats:
    cell = np.clip(np.searchsorted(x, theta, "right") - 1, 0, len(x) - 2)
    width = x[cell + 1] - x[cell]
    with np.errstate(all="ignore"):
        share = np.where(width > 0, (theta - x[cell]) / width, 0.0)
    return np.asarray(y[cell] + share * (y[cell + 1] - y[cell]))


def _expressed(expression: Expression, theta: Floats) -> Floats:
    return _evaluated(lambda angle: expression.over({"theta": angle}), theta)


def _evaluated(function: Callable[[Floats], ArrayLike], theta: Floats) -> Floats:
    return np.broadcast_to(np.asarray(function(theta), dtype=float), theta.shape)


def _constant(torque: float, theta: Floats) -> Floats:
    return np.full(theta.shape, torque)


def _difference(first: TorqueCurve, second: TorqueCurve, theta: Floats) -> Floats:
    return first(theta) - second(theta)


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
