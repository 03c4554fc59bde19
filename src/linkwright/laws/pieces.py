"""Piecewise polynomials with all their derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats


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
