"""The vibration that a rise leaves behind in an elastic follower."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.laws.base import MotionLaw

#: Gauss points of a piece, pieces of the rise at least, swings of the follower in a piece, pieces at once.
_GAUSS = np.polynomial.legendre.leggauss(20)
_PIECES, _SWINGS, _AT_ONCE = 24, 2.0, 100_000
#: Swings in a rise above which only jumps leave anything; distance from a break at which a curve is of its side.
_MOST, _EDGE = 2e4, 1e-13


def residual(law: MotionLaw, ratio: Floats) -> Floats:
    """Amplitude (n,) left after a rise of 1, without damping, at ratios n of its time and the natural period.

    |v(0) - v(1) e^(2πin) + ∫ a e^(2πinu) du|/(2πn), steps of the velocity at the ends included.
    """
    n = np.atleast_1d(np.asarray(ratio, dtype=float))
    if (n > _MOST).any():
        return np.where(n > _MOST, _of_jumps(law, np.maximum(n, _MOST)), residual(law, np.minimum(n, _MOST)))
    pieces = np.maximum(_PIECES, np.exp2(np.ceil(np.log2(np.maximum(np.abs(n), 1.0) / _SWINGS)))).astype(int)
    found = np.empty(len(n))
    for count in np.unique(pieces).tolist():
        here = np.flatnonzero(pieces == count)
        for part in np.array_split(here, math.ceil(len(here) * count / _AT_ONCE)):
            found[part] = _residual(law, n[part], count)
    return found


def _residual(law: MotionLaw, n: Floats, pieces: int) -> Floats:
    """The same with so many pieces of the rise."""
    edges = np.unique(np.concatenate([np.linspace(0.0, 1.0, pieces + 1), np.array(law.breaks, dtype=float)]))
    low, width = edges[:-1, None], np.diff(edges)[:, None]
    u = (low + 0.5 * width * (1.0 + _GAUSS[0])).ravel()
    weights = (0.5 * width * _GAUSS[1]).ravel()
    turn = np.exp(2j * np.pi * np.outer(n, u))
    first, last = np.asarray(law.curves(np.array([0.0, 1.0]))[1], dtype=float).tolist()
    transform = turn @ (weights * np.asarray(law.curves(u)[2])) + first - last * np.exp(2j * np.pi * n)
    return np.asarray(np.abs(transform) / (2 * np.pi * n))


def _of_jumps(law: MotionLaw, n: Floats) -> Floats:
    """What very many swings in a rise leave: the first terms by parts, jumps of velocity, acceleration and jerk."""
    edges, w = np.array([0.0, *law.breaks, 1.0]), 2j * np.pi * n
    left = [np.asarray(each, dtype=float) for each in law.curves(edges - _EDGE)[1:]]
    right = [np.asarray(each, dtype=float) for each in law.curves(edges + _EDGE)[1:]]
    total = np.zeros(len(n), dtype=complex)
    for order, (before, after) in enumerate(zip(left, right, strict=True)):
        before[0], after[-1] = 0.0, 0.0
        total += (np.exp(np.outer(w, edges)) @ (after - before)) / (-w) ** order
    return np.asarray(np.abs(total) / (2 * np.pi * n))
