"""Piecewise polynomials with all their derivatives, and splines of order 5 between knots as linear maps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats

DEGREE = 5
_GAUSS = np.polynomial.legendre.leggauss(6)


@dataclass(frozen=True)
class SplineSpace:
    """All splines of order 5 with these knots (m + 1,), increasing; ``periodic``: the end goes on as the beginning.

    Unknowns are control values (``size``,). The control values of a derivative bound it from both sides, since
    B-splines are not negative and add up to one.
    """

    knots: Floats
    periodic: bool = False

    @cached_property
    def full(self) -> Floats:
        """Knots with those beyond the ends."""
        k, p = self.knots, DEGREE
        if not self.periodic:
            return np.concatenate([np.full(p, k[0]), k, np.full(p, k[-1])])
        length = k[-1] - k[0]
        return np.concatenate([k[-p - 1 : -1] - length, k, k[1 : p + 1] + length])

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.knots) - 1 + (0 if self.periodic else DEGREE)

    @cached_property
    def _spread(self) -> Floats:
        """From the unknowns to all control values."""
        count = len(self.full) - DEGREE - 1
        rows = np.zeros((count, self.size))
        rows[np.arange(count), np.arange(count) % self.size] = 1.0
        return rows

    @property
    def resting(self) -> Floats:
        """Control values of some rise from rest at 0 to rest at 1: the first three are 0, the last three 1."""
        return np.concatenate([np.zeros(3), np.linspace(0.0, 1.0, self.size - 6), np.ones(3)])

    def bounds(self, order: int) -> Floats:
        """From the unknowns to the control values of a derivative, which bound it: (k, size)."""
        rows, knots, degree = self._spread, self.full, DEGREE
        for _ in range(order):
            width = knots[degree + 1 : -1] - knots[1 : -degree - 1]
            good = width > 0
            rows = np.diff(rows, axis=0) * np.where(good, degree / np.where(good, width, 1.0), 0.0)[:, None]
            knots, degree = knots[1:-1], degree - 1
        return np.asarray(rows)

    def at(self, places: Floats, order: int = 0) -> Floats:
        """From the unknowns to values of a derivative at places (n,): (n, size)."""
        from scipy.interpolate import BSpline

        inner = self.full[order : len(self.full) - order]
        low, high = self.knots[0], self.knots[-1]
        x = (places - low) % (high - low) + low if self.periodic else np.clip(places, low, high)
        basis = BSpline.design_matrix(x, inner, DEGREE - order)
        return np.asarray(basis @ self.bounds(order))

    def energy(self, order: int) -> tuple[Floats, Floats]:
        """Values of a derivative at Gauss points of all pieces, and the weights of an integral over them."""
        places, weights = self.gauss
        return self.at(places, order), weights

    @property
    def gauss(self) -> tuple[Floats, Floats]:
        """Places and weights of integrals over all pieces."""
        low, high = self.knots[:-1, None], self.knots[1:, None]
        places = (0.5 * (low + high) + 0.5 * (high - low) * _GAUSS[0]).ravel()
        return places, (0.5 * (high - low) * _GAUSS[1]).ravel()

    def pieces(self, values: Floats) -> Pieces:
        """The spline of these control values."""
        return Pieces.of_spline(self.full, self._spread @ values, DEGREE)


@dataclass(frozen=True)
class Pieces:
    """s(x) = Σ_k c[i, k] (x - edge_i)^k between edges (m + 1,); coefficients (m, order + 1)."""

    edges: Floats
    coefficients: Floats

    @classmethod
    def of_spline(cls, knots: Floats, values: Floats, degree: int) -> Pieces:
        """The pieces of a B-spline with full knots (n + degree + 1,) and control values (n,)."""
        from scipy.interpolate import PPoly

        found = PPoly.from_spline((knots, values, degree))
        inner = (np.diff(found.x) > 0) & (found.x[:-1] >= knots[degree]) & (found.x[1:] <= knots[len(values)])
        nonempty = np.flatnonzero(inner)
        return cls(np.append(found.x[nonempty], found.x[nonempty[-1] + 1]), found.c[::-1, nonempty].T)

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        """Value and first three derivatives at x (n,); beyond the ends the last pieces go on."""
        x = np.asarray(x)
        piece = np.clip(np.searchsorted(self.edges, x.real, side="right") - 1, 0, len(self.coefficients) - 1)
        y, rows = x - self.edges[piece], self.coefficients
        found = []
        for _ in range(4):
            value = 0.0 * y
            for column in rows.T[::-1]:
                value = value * y + column[piece]
            found.append(value)
            rows = rows[:, 1:] * np.arange(1, rows.shape[1])
        return found[0], found[1], found[2], found[3]
