"""A signal at a change point that the motion passes, or at an end of its range, from values a little away from it.

At a distance δ from the point the digits of a position are good for ε/δ only, those of an acceleration or a force
for ε/δ³, so nothing is solved in the middle. What is smooth on a side of the point goes on to it as the polynomial
through the values on that side; forces that the change point cannot carry grow as 1/δ.

At an end of its range a mechanism turns back on another branch, so that what it does is smooth in √δ, of which rates
grow as the first power of the inverse, accelerations and what they cause as the third, jerks as the fifth. Where two
guides become parallel, what slides on them goes away as 1/δ², its acceleration as the third power of that, and the
torque that this takes, whose work it is, as the fifth.
"""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.curves.polynomials import NODES, POINTS

#: Two polynomials, through all values of a side and through all but the outermost, agree to this share of the values.
AGREE = 1e-6
#: What grows does so over the nearest places, and its product with a power of δ has a limit that is this many times
#: what is not sure of it.
_GROWING, _SURE = 4, 100.0
#: Steepest growth towards an end of range: where guides become parallel, of the torque that moves what slides away.
STEEPEST = 10
#: Places near an end of range lie within one of these parts, rad, of the half turn whose cosine runs through the
#: stretch: the nearer ones where a size has a kink among the others, such as that of a force that passes zero.
SLOWED = (0.2, 0.02)
_HALF = POINTS // 2
#: Distances of a side's places from the middle, the nearest first, as shares of the half width.
AWAY = 2.0 * NODES[_HALF:] - 1.0


def weights(away: Floats, x: Floats) -> Floats:
    """Weights (m, k) of values at distances (k,) in their polynomial's values at x (m,)."""
    others = away[:, None] - away
    np.fill_diagonal(others, 1.0)
    differences = np.repeat((x[:, None] - away)[:, None, :], len(away), axis=1)
    differences[:, np.arange(len(away)), np.arange(len(away))] = 1.0
    return np.asarray(differences.prod(axis=2) / others.prod(axis=1))


_MIDDLE = np.zeros(1)
_ALL = weights(AWAY, _MIDDLE)[0]
_BUT_ONE = np.append(weights(AWAY[:-1], _MIDDLE)[0], 0.0)


def limit(values: Floats, steepest: int = 2) -> float:
    """The limit of a signal at a change point from the values (k,) of one side; infinite where it grows as the
    inverse of the distance or of a power of it up to ``steepest``, NaN where no polynomial tells."""
    found = float(_ALL @ values)
    nothing = AGREE * float(np.abs(values).max())
    if abs(found - float(_BUT_ONE @ values)) <= nothing:
        return found if abs(found) > nothing else 0.0
    if (np.diff(np.abs(values[:_GROWING])) < 0.0).all():
        for order in range(1, steepest + 1):
            scaled = values * np.sign(values[0]) * AWAY**order
            found = float(_ALL @ scaled)
            unsure = max(abs(found - float(_BUT_ONE @ scaled)), AGREE * float(np.abs(scaled).max()))
            if found > _SURE * unsure:
                return float(np.copysign(np.inf, values[0]))
    return float("nan")
