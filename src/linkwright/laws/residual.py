"""The vibration that a rise leaves behind in an elastic follower."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.laws.base import MotionLaw

#: Gauss points of a piece, pieces of the rise at least.
_GAUSS = np.polynomial.legendre.leggauss(20)
_PIECES = 24


def residual(law: MotionLaw, ratio: Floats) -> Floats:
    """Amplitude (n,) left after a rise of 1, without damping, at ratios n of its time and the natural period.

    |v(0) - v(1) e^(2πin) + ∫ a e^(2πinu) du|/(2πn), steps of the velocity at the ends included.
    """
    n = np.atleast_1d(np.asarray(ratio, dtype=float))
    edges = np.unique(np.concatenate([np.linspace(0.0, 1.0, _PIECES + 1), np.array(law.breaks, dtype=float)]))
    low, width = edges[:-1, None], np.diff(edges)[:, None]
    u = (low + 0.5 * width * (1.0 + _GAUSS[0])).ravel()
    weights = (0.5 * width * _GAUSS[1]).ravel()
    turn = np.exp(2j * np.pi * np.outer(n, u))
    first, last = np.asarray(law.curves(np.array([0.0, 1.0]))[1], dtype=float).tolist()
    whole = turn @ (weights * np.asarray(law.curves(u)[2])) + first - last * np.exp(2j * np.pi * n)
    return np.asarray(np.abs(whole) / (2 * np.pi * n))
