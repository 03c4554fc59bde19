"""Integrals of curves with kinks and jumps, to machine precision."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
#: A cell is halved while its two halves change its integral by more than this share of the whole.
FINE = 1e-13
HALVINGS = 44


class Antiderivative:
    """W(x), the integral of a function from ``start`` to x, for start ≤ x ≤ end.

    Gauss-Legendre of eight points in cells that are halved until the halves agree, so that a jump costs some forty
    halvings of its cell and no accuracy. ``knots``: places where the function may kink or jump, if they are known.
    """

    def __init__(self, function: Function, start: float, end: float, *, cells: int = 120, knots: Floats | None = None) -> None:
        self._function = function
        edges = np.linspace(start, end, cells + 1)
        if knots is not None:
            edges = np.unique(np.append(edges, knots[(knots > start) & (knots < end)]))
        self.low, parts = self._refined(edges[:-1], edges[1:])
        self.high = np.append(self.low[1:], end)
        self._before = np.concatenate([[0.0], np.cumsum(parts)])
        self.total = float(self._before[-1])

    def __call__(self, x: Floats) -> Floats:
        """W at places within the range, (n,)."""
        cell = np.clip(np.searchsorted(self.low, x, "right") - 1, 0, len(self.low) - 1)
        return np.asarray(self._before[cell] + self._gauss(self.low[cell], x))

    @property
    def edges(self) -> Floats:
        """Ends of all cells."""
        return np.append(self.low, self.high[-1])

    def _gauss(self, low: Floats, high: Floats) -> Floats:
        half, middle = 0.5 * (high - low), 0.5 * (high + low)
        values = self._function((middle[:, None] + half[:, None] * NODES).ravel()).reshape(len(low), -1)
        return np.asarray(half * (values @ WEIGHTS))

    def _refined(self, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        parts = self._gauss(low, high)
        done_low, done_parts = [], []
        scale = float(np.abs(parts).sum())
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            left, right = self._gauss(low, middle), self._gauss(middle, high)
            good = ~(np.abs(left + right - parts) > FINE * scale)
            done_low += [low[good], middle[good]]
            done_parts += [left[good], right[good]]
            low, high = np.append(low[~good], middle[~good]), np.append(middle[~good], high[~good])
            parts = np.append(left[~good], right[~good])
            if not len(low):
                break
        starts, values = np.concatenate([*done_low, low]), np.concatenate([*done_parts, parts])
        order = np.argsort(starts, kind="stable")
        return starts[order], values[order]


def extremes(function: Function, low: Floats, high: Floats) -> tuple[tuple[float, float], tuple[float, float]]:
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
