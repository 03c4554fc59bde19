"""Integrals of curves with kinks and jumps, to machine precision."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]

POINTS = 8
NODES, WEIGHTS = np.polynomial.legendre.leggauss(POINTS)
ORDERS = np.arange(POINTS)
#: From values at the nodes to coefficients of Legendre polynomials, (orders, nodes).
TO_LEGENDRE = (ORDERS[:, None] + 0.5) * np.polynomial.legendre.legvander(NODES, POINTS - 1).T * WEIGHTS
#: A cell is halved while that changes its integral, or while its last two orders have more than their share, of the
#: whole.
FINE, TAIL = 1e-13, 1e-11
HALVINGS = 44
#: More cells than this that want halving mean rounding noise, which no halving smooths.
NOISE = 3000


class Antiderivative:
    """W(x), the integral of a function from ``start`` to x, for start ≤ x ≤ end.

    Gauss-Legendre of eight points in cells that are halved until the halves agree, so that a jump costs some forty
    halvings of its cell and no accuracy; between, the polynomials through the same points.
    ``knots``: places where the function may kink or jump, if they are known.
    """

    def __init__(
        self, function: Function, start: float, end: float, *, cells: int = 120, knots: Floats | None = None
    ) -> None:
        self._function = function
        edges = np.linspace(start, end, cells + 1)
        if knots is not None:
            edges = np.unique(np.append(edges, knots[(knots > start) & (knots < end)]))
        self.low, self._orders = self._refined(edges[:-1], edges[1:])
        self.high = np.append(self.low[1:], end)
        parts = (self.high - self.low) * self._orders[:, 0]
        self._before = np.concatenate([[0.0], np.cumsum(parts)])
        self.total = float(self._before[-1])

    def __call__(self, x: Floats) -> Floats:
        """W at places within the range, (n,)."""
        cell = np.clip(np.searchsorted(self.low, x, "right") - 1, 0, len(self.low) - 1)
        half = 0.5 * (self.high[cell] - self.low[cell])
        place = np.clip((x - self.low[cell]) / half - 1.0, -1.0, 1.0)
        known = np.polynomial.legendre.legvander(place, POINTS)
        gained = np.concatenate(
            [place[:, None] + 1.0, (known[:, 2:] - known[:, :-2]) / (2 * ORDERS[1:] + 1)], axis=1
        )
        return np.asarray(self._before[cell] + half * (gained * self._orders[cell]).sum(axis=1))

    @property
    def edges(self) -> Floats:
        """Ends of all cells."""
        return np.append(self.low, self.high[-1])

    @property
    def quadrature(self) -> tuple[Floats, Floats]:
        """Gauss points of all cells and their weights, (m,) each, for integrals of what is smooth where W is."""
        half, middle = 0.5 * (self.high - self.low), 0.5 * (self.high + self.low)
        return (middle[:, None] + half[:, None] * NODES).ravel(), (half[:, None] * WEIGHTS).ravel()

    def _legendre(self, low: Floats, high: Floats) -> Floats:
        """Coefficients of the function in cells, (cells, orders)."""
        half, middle = 0.5 * (high - low), 0.5 * (high + low)
        values = self._function((middle[:, None] + half[:, None] * NODES).ravel()).reshape(len(low), -1)
        return np.asarray(values @ TO_LEGENDRE.T)

    def _refined(self, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        orders = self._legendre(low, high)
        scale = float(((high - low) * np.abs(orders[:, 0])).sum())
        kept_low, kept = [], []
        for _ in range(HALVINGS):
            middle, width = 0.5 * (low + high), high - low
            halves = self._legendre(np.append(low, middle), np.append(middle, high))
            left, right = np.split(halves, 2)
            change = width * np.abs(0.5 * (left[:, 0] + right[:, 0]) - orders[:, 0])
            tail = width * np.abs(halves[:, -2:]).sum(axis=1).reshape(2, -1).max(axis=0)
            good = ~((change > FINE * scale) | (tail > TAIL * scale))
            kept_low += [low[good], middle[good]]
            kept += [left[good], right[good]]
            again = ~good
            low, high = np.append(low[again], middle[again]), np.append(middle[again], high[again])
            orders = np.concatenate([left[again], right[again]])
            if not 0 < len(low) <= NOISE:
                break
        starts, coefficients = np.concatenate([*kept_low, low]), np.concatenate([*kept, orders])
        by_place = np.argsort(starts, kind="stable")
        return starts[by_place], coefficients[by_place]


def extremes(
    function: Function, low: Floats, high: Floats
) -> tuple[tuple[float, float], tuple[float, float]]:
    """(place, value) of the smallest and of the largest value of a function in brackets around its samples' best.

    ``low`` and ``high``: ends (n,) of stretches that together cover the range; the best three are searched.
    """
    middle = 0.5 * (low + high)
    values = np.stack([function(low), function(middle), function(high)])
    found = []
    for sign in (-1.0, 1.0):
        ranked = np.argsort(-(sign * values).max(axis=0), kind="stable")[:4]
        around = np.clip(np.concatenate([ranked - 1, ranked, ranked + 1]), 0, len(low) - 1)
        found.append(_narrowed(function, low[np.unique(around)], high[np.unique(around)], sign))
    return found[0], found[1]


def _narrowed(function: Function, low: Floats, high: Floats, sign: float) -> tuple[float, float]:
    shares = np.linspace(0.0, 1.0, 33)
    place, value = float(low[0]), -np.inf
    for _ in range(5):
        grid = low[:, None] + (high - low)[:, None] * shares
        values = sign * function(grid.ravel()).reshape(grid.shape)
        best = values.argmax(axis=1)
        rows = np.arange(len(low))
        top = int(values[rows, best].argmax())
        if values[top, best[top]] > value:
            place, value = float(grid[top, best[top]]), float(values[top, best[top]])
        step = (high - low) / 32
        low, high = np.maximum(grid[rows, best] - step, low), np.minimum(grid[rows, best] + step, high)
    return place, sign * value
