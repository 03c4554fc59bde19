"""Polynomials: the named ones from rest to rest, and those that meet any conditions at the ends."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import perm
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.fields.base import Quantities, Quantity, file_key
from linkwright.laws.base import MOTION_LAWS, MeetingLaw, MotionLaw
from linkwright.words import _

Coefficients = tuple[float, ...]
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def powers(u: Any, coefficients: Sequence[float]) -> tuple[Any, Any, Any, Any]:
    """Σ c_k u^k and its first three derivatives, by Horner's rule."""
    found = []
    row = np.asarray(coefficients, dtype=float)
    for _unused in range(4):
        value = 0.0 * u
        for each in row[::-1]:
            value = value * u + each
        found.append(value)
        row = row[1:] * np.arange(1, len(row))
    return found[0], found[1], found[2], found[3]


def from_conditions(start: Sequence[float], end: Sequence[float]) -> Coefficients:
    """Coefficients of the polynomial with these derivatives (displacement first) at u = 0 and at u = 1."""
    low, count = len(start), len(start) + len(end)
    known = [value / perm(k, k) for k, value in enumerate(start)]
    matrix = np.array([[perm(k, order) for k in range(low, count)] for order in range(len(end))], dtype=float)
    right = [value - sum(c * perm(k, order) for k, c in enumerate(known)) for order, value in enumerate(end)]
    return (*known, *np.linalg.solve(matrix, np.array(right, dtype=float)).tolist())


class Polynomial(MotionLaw):
    """s = Σ c_k u^k."""

    source: ClassVar[str] = "Norton, Cam Design and Manufacturing Handbook, ch. 4; VDI 2143-1"

    @property
    @abstractmethod
    def coefficients(self) -> Coefficients:
        """c_k, k from 0."""

    @property
    def formula(self) -> str:
        found = ""
        for k, factor in enumerate(self.coefficients):
            if abs(factor) > 1e-12:
                size = "" if abs(factor) == 1.0 and k else f"{abs(factor):.6g}"
                joint = "-" if factor < 0 else "+" if found else ""
                found += f"{joint}{size}{'u' if k else ''}{str(k).translate(_RAISED) if k > 1 else ''}"
        return found

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return powers(u, self.coefficients)


@MOTION_LAWS.register("polynomial_23")
@dataclass(frozen=True)
class Polynomial23(Polynomial):
    """s = 3u² - 2u³: the acceleration jumps next to dwells."""

    coefficients = (0.0, 0.0, 3.0, -2.0)


@MOTION_LAWS.register("polynomial_345")
@dataclass(frozen=True)
class Polynomial345(Polynomial):
    """s = 10u³ - 15u⁴ + 6u⁵."""

    coefficients = (0.0, 0.0, 0.0, 10.0, -15.0, 6.0)


@MOTION_LAWS.register("polynomial_4567")
@dataclass(frozen=True)
class Polynomial4567(Polynomial):
    """s = 35u⁴ - 84u⁵ + 70u⁶ - 20u⁷: the jerk has no jumps."""

    coefficients = (0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0)


@MOTION_LAWS.register("polynomial_5")
@dataclass(frozen=True)
class Polynomial5(MeetingLaw, Polynomial):
    """The polynomial of order 5 with any velocity and acceleration at both ends (all pairs of VDI 2143)."""

    @cached_property
    def coefficients(self) -> Coefficients:
        v, a = self.demanded.velocity, self.demanded.acceleration
        return from_conditions((0.0, v[0], a[0]), (self.rise, v[1], a[1]))


@MOTION_LAWS.register("polynomial_7")
@dataclass(frozen=True)
class Polynomial7(MeetingLaw, Polynomial):
    """The polynomial of order 7 with any velocity and acceleration at both ends, and no jerk there."""

    @cached_property
    def coefficients(self) -> Coefficients:
        v, a = self.demanded.velocity, self.demanded.acceleration
        return from_conditions((0.0, v[0], a[0], 0.0), (self.rise, v[1], a[1], 0.0))


@MOTION_LAWS.register("polynomial")
@dataclass(frozen=True)
class PolynomialOf(Polynomial):
    """The polynomial of lowest order with these derivatives at the ends: velocity, acceleration, jerk and so on.

    Without any it is s = u.
    """

    start: Coefficients = file_key(Quantities("dimensionless", doc="v, a, j, … at u = 0, as many as are wanted"), ())
    end: Coefficients = file_key(Quantities("dimensionless", doc="v, a, j, … at u = 1"), ())

    def __post_init__(self) -> None:
        if max(len(self.start), len(self.end)) > 8:
            raise RequestError(
                _("more than eight conditions at one end; give fewer", code="laws.too_many_conditions")
            )

    @cached_property
    def coefficients(self) -> Coefficients:
        return from_conditions((0.0, *self.start), (1.0, *self.end))


@MOTION_LAWS.register("polydyne")
@dataclass(frozen=True)
class Polydyne(Polynomial):
    """The cam's rise with which an elastic follower itself moves by the polynomial 5-6-7-8-9.

    y + 2ζ/(2πn) y' + y''/(2πn)² of that polynomial y, with n the time of the rise over the natural period and ζ the
    damping: at the speed it is made for nothing is left vibrating (Stoddart 1953).
    """

    source: ClassVar[str] = "D. A. Stoddart, Polydyne cam design, Machine Design 25, 1953"
    ratio: float = file_key(Quantity("dimensionless", above=0.0, doc="time of the rise over natural period"))
    damping_ratio: float = file_key(
        Quantity("dimensionless", minimum=0.0, doc="damping ratio ζ of the follower, 0"), 0.0
    )

    def __post_init__(self) -> None:
        if self.ratio <= 0 or not 0 <= self.damping_ratio < 1:
            raise RequestError(
                _(
                    "a polydyne law needs a ratio above zero and a damping ratio from 0 to below 1",
                    code="laws.polydyne",
                )
            )

    @cached_property
    def coefficients(self) -> Coefficients:
        y = np.zeros(10)
        y[5:] = 126.0, -420.0, 540.0, -315.0, 70.0
        w = 2 * np.pi * self.ratio
        first = np.append(y[1:] * np.arange(1, 10), 0.0)
        second = np.append(first[1:] * np.arange(1, 10), 0.0)
        total: Floats = y + 2 * self.damping_ratio / w * first + second / w**2
        return tuple(total.tolist())


@MOTION_LAWS.register("constant_velocity")
@dataclass(frozen=True)
class ConstantVelocity(MotionLaw):
    """s = u: for transitions between motions of the same velocity; next to a dwell the velocity jumps."""

    source: ClassVar[str] = "VDI 2143-1; Norton, Cam Design and Manufacturing Handbook, ch. 2"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        none = 0.0 * u
        return u + none, none + 1.0, none, none
