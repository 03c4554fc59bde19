"""Torque curves over the angle, with or without a mechanism."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin
from linkwright.core.expressions import Expression, parse
from linkwright.curves.curve import Curve, Integral
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
