"""Polynomials through sixteen Gauss points: series, integrals, places and values of their extremes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.polynomial import chebyshev, legendre
from numpy.typing import NDArray

from linkwright.core.arrays import EQUAL, Floats, Indices, begins

#: Of every design: the piece of an extreme, its place in it (-1 to 1), and its value, (designs,) each.
Peak = tuple[Indices, Floats, Floats]
POINTS = 16
_X, _W = legendre.leggauss(POINTS)
#: Gauss points and their weights in a piece from 0 to 1.
NODES, WEIGHTS = 0.5 * (1.0 + _X), 0.5 * _W
#: The same points in a piece from -1 to 1.
PLACES: Floats = _X
#: From values at the nodes to Chebyshev coefficients, (orders, nodes); to the last three of Legendre's series.
SERIES = np.linalg.inv(chebyshev.chebvander(_X, POINTS - 1))
LAST = SERIES[-3:]
#: Places, -1 to 1, at which a piece is looked at, both ends among them, and from values at the nodes to these.
LOOKS = -np.cos(np.pi * np.arange(33) / 32)
TO_LOOKS = chebyshev.chebvander(LOOKS, POINTS - 1) @ SERIES
TO_ENDS = TO_LOOKS[[0, -1]]
#: From coefficients to those of the slope; from values to the slope at every node, the piece 2 long, and to the
#: integral from the beginning up to it, the piece 1 long.
SLOPE = np.vstack([chebyshev.chebder(np.eye(POINTS)), np.zeros((1, POINTS))])
TO_SLOPE = chebyshev.chebvander(_X, POINTS - 1) @ SLOPE @ SERIES
UP_TO = chebyshev.chebvander(_X, POINTS) @ (0.5 * chebyshev.chebint(np.eye(POINTS), lbnd=-1) @ SERIES)
#: How much higher than at its nodes a signal may rise in a piece that is met, as share of its span there: half of
#: the gap between two nodes, squared, is 0.009 of it, and up to the ends it may rise by 0.025; where it is not met,
#: in multiples of the size of its last orders.
SLACK, HIDDEN = 0.03, 8.0
#: So many polynomials, or more, are climbed by machine code.
COMPILED = 1000
#: Multiplications up to which BLAS keeps to one core.
_ON_ONE_CORE = 1 << 18
#: A Newton step of this size towards an extreme is the last one, as what is left is its square; a halving's size.
LAST_STEP, HALVED = 3e-7, 1e-9
_STEPS, _MOST = 4, 60


def product(matrix: NDArray[np.floating[Any]], rows: Floats) -> Floats:
    """A small matrix times (POINTS, k) values: in parts that stay in the cache, and on one core, as designs go on
    several. NaN where values are infinite."""
    size = _ON_ONE_CORE // matrix.size
    with np.errstate(invalid="ignore"):
        if rows.shape[1] <= size:
            return np.asarray(matrix @ rows)
        found = np.empty((len(matrix), rows.shape[1]))
        for k in range(0, rows.shape[1], size):
            found[:, k : k + size] = matrix @ rows[:, k : k + size]
    return found


def value_at(series: Floats, x: Floats) -> Floats:
    """Chebyshev series (s, POINTS, k) at places (k,), (s, k)."""
    found: Floats = (series * np.cos(np.arange(POINTS)[:, None] * np.arccos(x))).sum(axis=1)
    return found


def weights_at(place: Floats) -> Floats:
    """Weights (POINTS, k) of the values at the nodes in the value at places (k,), -1 to 1."""
    return np.asarray((chebyshev.chebvander(place, POINTS - 1) @ SERIES).T)


def climbed(rows: Floats) -> tuple[Floats, Floats]:
    """Place (-1 to 1) and value (k,) of the largest of polynomials through ``rows`` (POINTS, k).

    From the highest look by Newton's steps between its neighbours, halvings where these leave the bracket.
    """
    if rows.shape[1] >= COMPILED:
        from linkwright.curves import peak_kernel  # slow to load, for many of them alone

        if peak_kernel.possible():
            return peak_kernel.climbed(rows)
    looks = product(TO_LOOKS, rows)
    best = looks.argmax(axis=0)
    top, x = looks[best, np.arange(rows.shape[1])], LOOKS[best]
    low, high = LOOKS[np.maximum(best - 1, 0)], LOOKS[np.minimum(best + 1, len(LOOKS) - 1)]
    series = product(SERIES, rows)
    slope = product(SLOPE, series)
    both = np.stack([slope, product(SLOPE, slope)])
    for _ in range(_MOST):
        first, second = value_at(both, x)
        low, high = np.where(first > 0.0, x, low), np.where(first > 0.0, high, x)
        with np.errstate(all="ignore"):
            step = x - first / second
        inside = (step >= low) & (step <= high)
        before, x = x, np.where(inside, step, 0.5 * (low + high))
        if not (np.abs(x - before) > np.where(inside, LAST_STEP, HALVED)).any():
            break
    value = value_at(series[None], x)[0]
    return np.where(value > top, x, LOOKS[best]), np.maximum(value, top)


def turning_points(rows: Floats, low: Floats, high: Floats, start: Floats) -> Floats:
    """Places (k,) in brackets at which polynomials through ``rows`` (POINTS, k) turn, by Newton's steps."""
    slope = product(SLOPE, product(SERIES, rows))
    both, x = np.stack([slope, product(SLOPE, slope)]), start
    for _ in range(_STEPS):
        first, second = value_at(both, x)
        with np.errstate(all="ignore"):
            x = np.clip(np.nan_to_num(x - first / second), low, high)
    return x


def best_of(value: Floats, owner: Indices, slack: Floats | None = None, time: Floats | None = None) -> Indices:
    """Of values (k,) in the order of their owners the number of the largest one of every owner: of such as are as
    large but for ``slack`` (rounding where left out) the first, in ``time``."""
    starts = begins(owner)
    best = np.repeat(np.maximum.reduceat(value, starts), np.diff(np.append(starts, len(owner))))
    if slack is None:
        slack = EQUAL * np.where(np.isfinite(best), np.abs(best), 0.0)
    first = np.flatnonzero(~(value < best - slack))
    if time is not None:
        first = first[np.lexsort((time[first], owner[first]))]
    return np.asarray(first[begins(owner[first])])


def largest(values: Floats, design: Indices) -> Peak:
    """The largest of polynomials through ``values`` (POINTS, pieces) of every design, whose pieces lie in order."""
    top, bottom = values.max(axis=0), values.min(axis=0)
    starts = begins(design)
    highest = np.repeat(np.maximum.reduceat(top, starts), np.diff(np.append(starts, len(design))))
    piece = np.flatnonzero(~(top + SLACK * (top - bottom) < highest))
    place, value = climbed(values[:, piece])
    best = best_of(value, design[piece])
    return piece[best], place[best], value[best]
