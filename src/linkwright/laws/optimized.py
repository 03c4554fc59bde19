"""The optimal spline: minimum peak of acceleration, jerk or velocity, or minimum residual vibration, within
limits."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.fields.base import Quantities, Quantity, Word, file_key
from linkwright.laws.base import MOTION_LAWS, MotionLaw
from linkwright.laws.spline_space import Pieces
from linkwright.words import _

AIMS = {"velocity": 1, "acceleration": 2, "jerk": 3, "residual": 0}
#: Pieces of the spline, places of the residual spectrum, directions in which its size is bounded.
_PIECES, _RATIOS, _DIRECTIONS = 64, 25, 16


_TWO_RATIOS = _(
    "ratios belong to minimize: residual, and need two numbers above zero, such as [1, 3]", code="laws.ratios"
)


def _limited(what: str) -> Quantity:
    return Quantity("dimensionless", above=0.0, doc=f"largest {what} allowed, for a rise of 1 over 1")


@MOTION_LAWS.register("optimized_spline")
@dataclass(frozen=True)
class OptimizedSpline(MotionLaw):
    """The rise from rest to rest of a spline of order 5 with the minimum peak of ``minimize``, within limits.

    ``residual`` is the largest amplitude |∫ a e^(2πinu) du|/(2πn) over ``ratios`` n of rise time and natural period.
    Peaks are bounded by the control values of the derivatives, so that the limits hold everywhere. A linear program,
    solved by HiGHS. Without limits of one's own the jerk is at most 200, for ``residual`` the acceleration at most 8.
    """

    source: ClassVar[str] = "linear program over B-splines; bounds: de Boor, A Practical Guide to Splines"
    minimize: str = file_key(Word(tuple(AIMS), doc="what is minimized"))
    velocity: float | None = file_key(_limited("velocity"), None)
    acceleration: float | None = file_key(_limited("acceleration"), None)
    jerk: float | None = file_key(_limited("jerk"), None)
    ratios: tuple[float, float] | None = file_key(
        Quantities("dimensionless", count=2, doc="rise time over natural period, from and to"), None
    )

    def __post_init__(self) -> None:
        if self.minimize not in AIMS:
            raise RequestError(
                _(
                    '"{aim}" cannot be minimized; give one of {known}',
                    code="laws.aim",
                    aim=self.minimize,
                    known=tuple(AIMS),
                )
            )
        if (self.minimize == "residual") != (self.ratios is not None):
            raise RequestError(_TWO_RATIOS)
        if self.ratios is not None and not 0 < self.ratios[0] <= self.ratios[1]:
            raise RequestError(_TWO_RATIOS)

    @property
    def limits(self) -> dict[int, float]:
        """Limits by order of the derivative, defaults included."""
        own = {1: self.velocity, 2: self.acceleration, 3: self.jerk}
        usual = {2: 8.0, 3: 200.0} if self.minimize == "residual" else {3: 200.0}
        found = {order: value for order, value in own.items() if value is not None}
        return {**{k: v for k, v in usual.items() if k != AIMS[self.minimize]}, **found}

    @cached_property
    def _pieces(self) -> Pieces:
        from scipy.optimize import linprog

        from linkwright.laws.spline_space import SplineSpace

        space = SplineSpace(np.linspace(0.0, 1.0, _PIECES + 1))
        rows, right = self._rows(space)
        held = space.resting
        free = np.r_[3 : space.size - 3, space.size]
        right = right - rows[:, : space.size] @ np.where(np.isin(np.arange(space.size), free), 0.0, held)
        cost = np.zeros(len(free))
        cost[-1] = 1.0
        bounds = [(None, None)] * len(free)
        found = linprog(cost, A_ub=rows[:, free], b_ub=right, bounds=bounds, method="highs")
        if not found.success:
            limits = ", ".join(f"{name} ≤ {self.limits[k]:g}" for name, k in AIMS.items() if k in self.limits)
            raise RequestError(
                _(
                    "no rise of 1 keeps these limits: {limits}; give larger ones",
                    code="laws.limits_too_tight",
                    limits=limits,
                )
            )
        held[free[:-1]] = found.x[:-1]
        return space.pieces(held)

    def _rows(self, space: Any) -> tuple[Floats, Floats]:
        """Rows A and right sides of A (control values, peak) <= b."""
        blocks, right = [], []
        for order, limit in self.limits.items():
            bound = space.bounds(order)
            blocks += [np.column_stack([sign * bound, np.zeros(len(bound))]) for sign in (1.0, -1.0)]
            right += [np.full(2 * len(bound), limit)]
        if self.minimize == "residual":
            bound = self._residual(space)
        else:
            one_side = space.bounds(AIMS[self.minimize])
            bound = np.concatenate([one_side, -one_side])
        blocks.append(np.column_stack([bound, np.full(len(bound), -1.0)]))
        right.append(np.zeros(len(bound)))
        return np.concatenate(blocks), np.concatenate(right)

    def _residual(self, space: Any) -> Floats:
        """The residual amplitudes over the ratios, in all directions."""
        assert self.ratios is not None
        places, weights = space.gauss
        n = np.linspace(*self.ratios, _RATIOS)
        turn = np.exp(2j * pi * np.outer(n, places)) * weights / (2 * pi * n[:, None])
        amplitudes = turn @ space.at(places, 2)
        sides = np.exp(-2j * pi * np.arange(_DIRECTIONS) / _DIRECTIONS)
        return np.asarray((sides[:, None, None] * amplitudes).real.reshape(-1, space.size))

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple((np.arange(1, _PIECES) / _PIECES).tolist())

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return self._pieces.curves(u)
