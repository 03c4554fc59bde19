"""Laws through points: exactly, or smoothed."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.fields.base import Quantities, Quantity, file_key
from linkwright.laws.base import MOTION_LAWS, Ends, MotionLaw
from linkwright.laws.spline_space import Pieces
from linkwright.words import _

#: Share of u that the shortest way between two points may be, and how many points there may be.
_NEAR, _MOST = 1e-6, 5000


def _checked(places: tuple[float, ...], values: tuple[float, ...]) -> tuple[Floats, Floats]:
    """Places and values with both ends."""
    u = np.array([0.0, *(each for each in places if 0.0 < each < 1.0), 1.0])
    inside = len(u) == len(places) + 2 or (len(places) and (places[0] == 0.0 or places[-1] == 1.0))
    if len(places) != len(values) or not inside or np.diff(u).min() < _NEAR or len(u) > _MOST:
        raise RequestError(
            _(
                "{places} places and {values} values; give as many of both, places increasing from 0 to 1",
                code="laws.points",
                places=len(places),
                values=len(values),
            )
        )
    inner = [s for x, s in zip(places, values, strict=True) if 0.0 < x < 1.0]
    ends = [s for x, s in zip(places, values, strict=True) if x in (0.0, 1.0) and s != x]
    if ends:
        raise RequestError(
            _(
                "a rise goes from 0 at u = 0 to 1 at u = 1, but an end has the value {value:.6g}; leave the ends out",
                code="laws.points_ends",
                value=ends[0],
            )
        )
    return u, np.array([0.0, *inner, 1.0])


@dataclass(frozen=True)
class Through(MotionLaw):
    """What laws through points have in common."""

    places: tuple[float, ...] = file_key(Quantities("dimensionless", doc="places u between 0 and 1, increasing"))
    values: tuple[float, ...] = file_key(
        Quantities("dimensionless", doc="displacements there, as shares of the lift")
    )

    def __post_init__(self) -> None:
        _checked(self.places, self.values)

    @property
    @abstractmethod
    def _pieces(self) -> Pieces:
        """The polynomials between the breaks."""

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple(self._pieces.edges[1:-1].tolist())

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        return self._pieces.curves(u)


@MOTION_LAWS.register("spline")
@dataclass(frozen=True)
class SplineThrough(Through):
    """The spline of order 5 through points, from 0 to 1 with set velocity and acceleration at the ends.

    Continuous up to the fourth derivative (de Boor, A Practical Guide to Splines).
    """

    source: ClassVar[str] = "de Boor, A Practical Guide to Splines; Norton, ch. 5"
    demanded: Ends = field(default_factory=Ends)

    @cached_property
    def _pieces(self) -> Pieces:
        from scipy.interpolate import make_interp_spline

        u, s = _checked(self.places, self.values)
        v, a = self.demanded.velocity, self.demanded.acceleration
        bounds = ([(1, v[0]), (2, a[0])], [(1, v[1]), (2, a[1])])
        found = make_interp_spline(u, s, k=5, bc_type=bounds)
        return Pieces.of_spline(found.t, found.c, 5)


@MOTION_LAWS.register("smoothed_table")
@dataclass(frozen=True)
class SmoothedTable(Through):
    """The smoothest rise from rest to rest that stays within ``tolerance`` (a share of the lift) of measured points.

    A spline of order 5 with the minimum ∫ j² du for the weight that just meets the tolerance (Reinsch 1967).
    """

    source: ClassVar[str] = "C. H. Reinsch, Smoothing by spline functions, Numer. Math. 10, 1967"
    tolerance: float = file_key(
        Quantity("dimensionless", above=0.0, doc="largest distance to the points, as a share of the lift")
    )

    @cached_property
    def _pieces(self) -> Pieces:
        from linkwright.laws.spline_space import SplineSpace

        u, s = _checked(self.places, self.values)
        space = SplineSpace(np.linspace(0.0, 1.0, min(max(2 * len(u), 12), 160) + 1))
        held, free = space.resting, slice(3, -3)
        rows, (bend, weights) = space.at(u), space.energy(3)
        bend = np.sqrt(weights)[:, None] * bend
        bend *= np.sqrt(len(u) / np.square(bend).sum())
        bend = np.asarray(np.linalg.qr(np.column_stack([bend[:, free], bend @ held]), mode="r"))
        gap = s - rows @ held

        def fitted(log_weight: float) -> Floats:
            scale = 10.0**log_weight
            matrix = np.concatenate([rows[:, free], scale * bend[:, :-1]])
            right = np.concatenate([gap, -scale * bend[:, -1]])
            found = held.copy()
            found[free] += np.linalg.lstsq(matrix, right, rcond=None)[0]
            return found

        def far(values: Floats) -> float:
            return float(np.abs(space.at(u) @ values - s).max())

        low, high = -7.0, 5.0
        if far(fitted(low)) > self.tolerance:
            raise RequestError(
                _(
                    "no smooth rise comes within {tolerance:.3g} of the points, the nearest within "
                    "{minimum:.3g}; give a larger tolerance",
                    code="laws.not_smoothed",
                    tolerance=self.tolerance,
                    minimum=far(fitted(low)),
                )
            )
        for _unused in range(30):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if far(fitted(middle)) <= self.tolerance else (low, middle)
        return space.pieces(fitted(low))
