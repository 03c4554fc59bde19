"""Cubic splines through points: three times continuous at the ends, or periodic."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats


@dataclass(frozen=True)
class Spline:
    """The cubics between knots x (n,): y = Σ coefficients[k] (x - x_i)^k, coefficients (4, n - 1).

    Continuous up to the second derivative. de Boor, A Practical Guide to Splines, ch. IV.
    """

    knots: Floats
    coefficients: Floats
    period: float | None = None

    @classmethod
    def not_a_knot(cls, x: ArrayLike, y: ArrayLike) -> Spline:
        """The third derivative is continuous at the second and the last but one knot as well.

        Two points give a line, three a parabola. ``x`` increases.
        """
        knots, values = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        width = np.diff(knots)
        rise = np.diff(values) / width
        if len(knots) == 2:
            return cls(knots, _cubics(width, values, np.repeat(rise, 2)))
        if len(knots) == 3:
            bend = (rise[1] - rise[0]) / (width[0] + width[1])
            slopes = np.array(
                [rise[0] - bend * width[0], rise[0] + bend * width[0], rise[1] + bend * width[1]]
            )
            return cls(knots, _cubics(width, values, slopes))
        below, above = np.append(width[1:], width[-2] + width[-1]), np.append(width[0] + width[1], width[:-1])
        middle = np.concatenate([width[1:2], 2.0 * (width[:-1] + width[1:]), width[-2:-1]])
        right = np.concatenate([[0.0], 3.0 * (width[1:] * rise[:-1] + width[:-1] * rise[1:]), [0.0]])
        right[0] = _end(width[0], width[1], rise[0], rise[1])
        right[-1] = _end(width[-1], width[-2], rise[-1], rise[-2])
        return cls(knots, _cubics(width, values, _tridiagonal(below, middle, above, right)))

    @classmethod
    def periodic(cls, x: ArrayLike, y: ArrayLike) -> Spline:
        """The end goes on as the beginning, up to the second derivative; the last y counts as the first."""
        knots, values = np.asarray(x, dtype=float), np.array(y, dtype=float)
        values[-1] = values[0]
        width = np.diff(knots)
        rise = np.diff(values) / width
        before = np.roll(width, 1)
        right = 3.0 * (width * np.roll(rise, 1) + before * rise)
        slopes = _cyclic(width, 2.0 * (before + width), before, right)
        return cls(knots, _cubics(width, values, np.append(slopes, slopes[0])), float(knots[-1] - knots[0]))

    def __call__(self, x: Floats) -> tuple[Floats, Floats, Floats]:
        """Value, first and second derivative at x (m,); beyond the ends the last cubics, or the next period."""
        place = x
        if self.period is not None:
            place = self.knots[0] + (x - self.knots[0]) % self.period
        part = np.clip(np.searchsorted(self.knots, place, side="right") - 1, 0, len(self.knots) - 2)
        h, (a, b, c, d) = place - self.knots[part], self.coefficients[:, part]
        return a + h * (b + h * (c + h * d)), b + h * (2.0 * c + 3.0 * h * d), 2.0 * c + 6.0 * h * d


def _end(near: float, far: float, rise: float, following: float) -> float:
    """Right side of the row at an end."""
    both = near + far
    return ((near + 2.0 * both) * far * rise + near * near * following) / both


def _cubics(width: Floats, values: Floats, slopes: Floats) -> Floats:
    """Coefficients from the values and slopes at the knots."""
    rise = np.diff(values) / width
    bend = (slopes[:-1] + slopes[1:] - 2.0 * rise) / width
    return np.stack([values[:-1], slopes[:-1], (rise - slopes[:-1]) / width - bend, bend / width])


def _tridiagonal(below: Floats, middle: Floats, above: Floats, right: Floats) -> Floats:
    """Solution of the rows below[i-1] s[i-1] + middle[i] s[i] + above[i] s[i+1] = right[i], by elimination."""
    pivots, sides = middle.tolist(), right.tolist()
    lower, upper = below.tolist(), above.tolist()
    for i in range(1, len(pivots)):
        factor = lower[i - 1] / pivots[i - 1]
        pivots[i] -= factor * upper[i - 1]
        sides[i] -= factor * sides[i - 1]
    sides[-1] /= pivots[-1]
    for i in range(len(pivots) - 2, -1, -1):
        sides[i] = (sides[i] - upper[i] * sides[i + 1]) / pivots[i]
    return np.array(sides)


def _cyclic(below: Floats, middle: Floats, above: Floats, right: Floats) -> Floats:
    """The same for rows that close to a ring: row 0 has below[0] s[-1], the last row above[-1] s[0]."""
    count = len(middle)
    if count < 3:
        matrix = np.diag(middle)
        for i in range(count):
            matrix[i, i - 1] += below[i]
            matrix[i, (i + 1) % count] += above[i]
        return np.asarray(np.linalg.solve(matrix, right))
    shift = -middle[
        0
    ]  # Sherman and Morrison: a ring is a row without the corners, and a product of two vectors
    plain = middle.copy()
    plain[0] -= shift
    plain[-1] -= below[0] * above[-1] / shift
    corner = np.zeros(count)
    corner[0], corner[-1] = shift, above[-1]
    first, second = (_tridiagonal(below[1:], plain, above[:-1], side) for side in (right, corner))
    share = below[0] / shift
    factor = (first[0] + share * first[-1]) / (1.0 + second[0] + share * second[-1])
    return np.asarray(first - factor * second)
