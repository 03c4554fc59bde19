"""The lift of a compensating cam: what another part of the machine leaves to be made good, from a solved motion."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.laws.polynomial import from_conditions, powers
from linkwright.words import _

_TURN = 2 * math.pi
#: Angle by which the lift is carried on beyond its zone before it leaves it, rad; places of a table.
BEYOND, _PLACES = math.radians(8.0), 180


BEYOND_ANGLES = _(
    "the zone with what lies beyond it on both sides is not within the angles, or "
    "nearly a full turn; give a smaller zone",
    code="cams.compensation_zone",
)


def compensating_lift(
    angles: ArrayLike, wanted: ArrayLike, zone: tuple[float, float], *, places: int = _PLACES, beyond: float = BEYOND
) -> tuple[Floats, Floats]:
    """Angles (k,) of a turn of the cam (rad) and lifts (k,) that are as wanted in the zone and return smoothly.

    ``angles`` (n,) rad, increasing, and ``wanted`` (n,) m (or rad): what the follower should do, from a solved
    motion; they must reach ``beyond`` the ``zone`` (from, to) on both sides. Outside, polynomials of order 7 lead to
    a dwell and back with continuous velocity, acceleration and jerk. The smallest lift is zero. Use them as
    ``angles`` and ``lifts`` of a cam in a model file, through which a periodic spline of order 5 goes.

    Raises RequestError.
    """
    from scipy.interpolate import make_interp_spline

    x, y = np.asarray(angles, dtype=float), np.asarray(wanted, dtype=float)
    low, high = zone[0] - beyond, zone[1] + beyond
    if x.ndim != 1 or x.shape != y.shape or len(x) < 12 or not (np.diff(x) > 0).all():
        raise RequestError(
            _(
                "angles and wanted lifts do not fit: give as many of both, twelve or more, the angles increasing",
                code="cams.compensation_points",
            )
        )
    if not low < high < low + 0.95 * _TURN or x[0] > low or x[-1] < high:
        raise RequestError(BEYOND_ANGLES)
    near = slice(max(int(np.searchsorted(x, low)) - 8, 0), int(np.searchsorted(x, high)) + 8)
    spline = make_interp_spline(x[near], y[near], k=7 if len(x[near]) > 16 else 5)
    away = _Return(
        [float(spline(high, nu=k)) for k in range(4)], [float(spline(low, nu=k)) for k in range(4)], high, low + _TURN
    )
    at = low + _TURN * np.arange(places) / places
    lift = np.where(at <= high, spline(np.minimum(at, high)), away(at))
    at = at % _TURN
    order = np.argsort(at)
    return at[order], (lift - lift.min())[order]


class _Return:
    """From the derivatives at ``start`` to rest, a dwell, and from rest to those at ``end``: polynomials of order 7.

    Level of the dwell and length of the passages are those with the smallest acceleration.
    """

    def __init__(self, first: list[float], last: list[float], start: float, end: float) -> None:
        self.start, self.end = start, end
        levels = np.linspace(min(first[0], last[0]), max(first[0], last[0]), 5)
        spread = max(float(np.ptp(levels)), abs(first[1]), abs(last[1]))
        levels = np.unique(np.concatenate([levels, levels.mean() + spread * np.linspace(-1.0, 1.0, 21)]))
        best = np.inf
        u = np.linspace(0.0, 1.0, 65)
        for width in np.linspace(0.15, 0.5, 8) * (end - start):
            for level in levels.tolist():
                ways = [_passage(each, level, width, back) for each, back in ((first, False), (last, True))]
                curvature = max(float(np.abs(powers(u, way)[2]).max()) for way in ways) / width**2
                if curvature < best:
                    best, self.level, self.width, self.ways = curvature, level, float(width), ways

    def __call__(self, x: Floats) -> Floats:
        """Lift (n,) at angles between start and end, elsewhere the nearest end."""
        left = np.clip((x - self.start) / self.width, 0.0, 1.0)
        right = np.clip((x - self.end) / self.width + 1.0, 0.0, 1.0)
        falls, rises = powers(left, self.ways[0])[0], powers(right, self.ways[1])[0]
        return np.asarray(falls + rises - self.level)


def _passage(ends: list[float], level: float, width: float, back: bool) -> tuple[float, ...]:
    """Coefficients over u from 0 to 1 between the derivatives ``ends`` and rest at a level."""
    moving = [each * width**k for k, each in enumerate(ends)]
    resting = [level, 0.0, 0.0, 0.0]
    return from_conditions(resting, moving) if back else from_conditions(moving, resting)
