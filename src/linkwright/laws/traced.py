"""Periodic curves as polynomials between edges: the same numbers in NumPy and in traced programs."""

from __future__ import annotations

import itertools
import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.laws.program import TURN, Program

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from scipy.interpolate import PPoly

    from linkwright.formula.trace import Scalar

#: Order of the polynomials; how near they come to lift and acceleration, as shares of the largest.
_ORDER, _FINE, _BENT = 15, 1e-13, 1e-9
#: Where polynomials meet the lift of a piece; at its ends they meet its rate as well.
_PLACES = np.array([0.1059, 0.3132, 0.5068, 0.6783, 0.8201, 0.9264, 1.0])
_PLACES = np.append(-_PLACES[::-1], _PLACES)
_MOST = 240
#: Equal lifts in a row that make a rest of a table.
RESTING = 4


@dataclass(frozen=True)
class LiftCurve:
    """f over an angle from 0 to a turn: Σ c[i, k] t^k between edges (m + 1,), t from -1 to 1 on every piece."""

    edges: Floats
    coefficients: Floats

    @classmethod
    def of(cls, program: Program) -> LiftCurve:
        """The curve of a program over a turn, its pieces halved until they meet it."""
        powers = np.vander(_PLACES, _ORDER + 1, increasing=True)
        slopes = np.arange(1.0, _ORDER + 1) * powers[[0, -1], :-1]
        met = np.concatenate([powers, np.pad(slopes, ((0, 0), (1, 0)))])
        to_powers = np.linalg.inv(met)
        low, high = program.lifts
        size = max(high - low, 1e-12)
        bend = max(abs(program.extreme(2, kind).value) for kind in ("min", "max")) or 1.0
        waiting = list(zip(program.breaks[:-1].tolist(), program.breaks[1:].tolist(), strict=True))
        found: list[tuple[float, list[float]]] = []
        looks = np.linspace(-1.0, 1.0, 23)[1:-1]
        while waiting:
            a, b = waiting.pop()
            half, middle = 0.5 * (b - a), 0.5 * (a + b)
            places = np.clip(middle + half * _PLACES, a, np.nextafter(b, a))
            lift, rate, *_ = program.curves(places)
            asked = np.append(lift, half * rate[[0, -1]])
            row = to_powers @ asked
            row += to_powers @ (asked - met @ row)  # what rounding leaves
            exact = program.curves(middle + half * looks)
            off = np.abs(_powers(row, looks, 0) - exact[0]).max()
            bent = np.abs(_powers(row, looks, 2) / half**2 - exact[2]).max()
            fits = off <= _FINE * size and bent <= _BENT * bend
            if fits or len(waiting) + len(found) > _MOST or half < 1e-4:
                found.append((a, row.tolist()))
            else:
                waiting += [(a, middle), (middle, b)]
        found.sort()
        return cls(np.array([*(a for a, _ in found), TURN]), np.array([row for _, row in found]))

    @classmethod
    def through(cls, angles: Sequence[float], lifts: Sequence[float]) -> LiftCurve:
        """The periodic spline of order 5 through points of a turn, the angles increasing within it.

        Four equal lifts or more in a row are a rest: the lift does not change there at all, and the spline next to it
        begins and ends without velocity and acceleration. (A spline through them would swing by what the table's
        last digit leaves open, and every swing would count as a reversal.)
        """
        x, y = np.array([*angles, angles[0] + TURN]), np.array([*lifts, lifts[0]])
        first = _start_of_rest(y)
        if first is not None:
            x = np.concatenate([x[first:-1], x[: first + 1] + TURN])
            y = np.concatenate([y[first:-1], y[: first + 1]])
        splines = list(_stretches(x, y, resting=first is not None))
        edges = np.array([0.0, *(each for each in angles if 0.0 < each < TURN), TURN])
        rows = []
        for a, b in itertools.pairwise(edges):
            half, middle = 0.5 * (b - a), 0.5 * (a + b)
            place = middle if middle >= x[0] else middle + TURN
            spline = next(each for end, each in splines if place <= end)
            rows.append([spline(place, nu=k) * half**k / math.factorial(k) for k in range(6)])
        return cls(edges, np.array(rows, dtype=float))

    @property
    def text(self) -> str:
        """All numbers as a text, from which :meth:`read` makes the same curve."""
        return json.dumps([self.edges.tolist(), self.coefficients.tolist()])

    @classmethod
    def read(cls, text: str) -> LiftCurve:
        """The curve of a text."""
        edges, rows = json.loads(text)
        return cls(np.array(edges), np.array(rows))

    def curves(self, x: Any) -> tuple[Any, Any, Any]:
        """f and its first two derivatives at angles x (n,), of any turn."""
        lift, rate, second = self.derivatives(x, 2)
        return lift, rate, second

    def derivatives(self, x: Any, most: int) -> list[Any]:
        """f and its derivatives up to the order ``most`` at angles x (n,), of any turn."""
        x = np.asarray(x)
        x = x - TURN * np.floor(x.real / TURN)
        piece = np.clip(np.searchsorted(self.edges, x.real, side="right") - 1, 0, len(self.coefficients) - 1)
        low, high = self.edges[piece], self.edges[piece + 1]
        half = 0.5 * (high - low)
        t, rows = (x - 0.5 * (low + high)) / half, self.coefficients
        found = []
        for order in range(most + 1):
            value = 0.0 * t
            for column in rows.T[::-1]:
                value = value * t + column[piece]
            found.append(value / half**order)
            rows = rows[:, 1:] * np.arange(1, rows.shape[1])
        return found

    def traced(self, x: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        """The same for a traced angle from 0 to a turn."""
        low, high = self.edges[:-1], self.edges[1:]
        scale, shift = 2.0 / (high - low), (low + high) / (low - high)
        table = np.column_stack([scale, shift, self.coefficients])

        slope, start, *row = row_at(x, self.edges, table)
        row += [0.0] * (3 - len(row))
        t = slope * x + start
        first: list[Scalar] = [float(k) * row[k] for k in range(1, len(row))]
        second: list[Scalar] = [float(k) * first[k] for k in range(1, len(first))]
        return horner(row, t), horner(first, t) * slope, horner(second, t) * (slope * slope)


def row_at(x: Scalar, edges: Floats, rows: Floats) -> list[Scalar]:
    """The row of the piece between edges (m + 1,) that holds a traced place, of rows (m, k), by halving; beyond the
    ends that of the first or the last piece."""
    from linkwright.formula.trace import select

    def chosen(first: int, last: int) -> list[Scalar]:
        if last - first == 1:
            return [float(each) for each in rows[first]]
        middle = (first + last) // 2
        left, right = chosen(first, middle), chosen(middle, last)
        below = x < float(edges[middle])
        return [a if a is b or a == b else select(below, a, b) for a, b in zip(left, right, strict=True)]

    return chosen(0, len(rows))


def traced_spline(spline: PPoly, x: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """Value and first two derivatives of a cubic spline at a traced place; beyond the ends the first or last cubic.

    For the equations of joints (:meth:`linkwright.joints.ends.Ends.function`).
    """
    start, *row = row_at(x, spline.x, np.column_stack([spline.x[:-1], spline.c[::-1].T]))
    first = [row[1], 2.0 * row[2], 3.0 * row[3]]
    h = x - start
    return horner(row, h), horner(first, h), horner([first[1], 2.0 * first[2]], h)


def horner(row: Sequence[Scalar], t: Scalar) -> Scalar:
    """Σ row[k] t^k."""
    value = row[-1]
    for each in row[-2::-1]:
        value = value * t + each
    return value


def _start_of_rest(lifts: Floats) -> int | None:
    """Where a rest begins that begins within the turn; None where there is none, or nothing but rest."""
    still = np.diff(lifts) == 0.0
    runs = [
        k
        for k in range(len(still))
        if still[k] and not still[k - 1] and np.take(still, range(k, k + RESTING - 1), mode="wrap").all()
    ]
    return runs[0] if runs else None


def _stretches(x: Floats, y: Floats, *, resting: bool) -> Iterator[tuple[float, PPoly]]:
    """Splines one after the other, each with the place where it ends; the first a rest, where there is one."""
    from scipy.interpolate import PPoly, make_interp_spline

    if not resting:
        yield float(x[-1]), PPoly.from_spline(make_interp_spline(x, y, k=5, bc_type="periodic"))
        return
    at_rest = [(1, 0.0), (2, 0.0)]
    here = 0
    while here < len(x) - 1:
        end = here
        while end < len(x) - 1 and y[end + 1] == y[here]:
            end += 1
        if end - here + 1 >= RESTING:
            yield float(x[end]), PPoly([[y[here]]], [x[here], x[end]])
            here = end
            continue
        end = next(
            (k for k in range(here + 1, len(x) - 1) if (y[k : k + RESTING] == y[k]).all() and k + RESTING <= len(x)),
            len(x) - 1,
        )
        spline = make_interp_spline(x[here : end + 1], y[here : end + 1], k=5, bc_type=(at_rest, at_rest))
        yield float(x[end]), PPoly.from_spline(spline)
        here = end


def _powers(row: Floats, t: Floats, order: int) -> Floats:
    for _ in range(order):
        row = row[1:] * np.arange(1, len(row))
    return np.asarray(np.polynomial.polynomial.polyval(t, row))
