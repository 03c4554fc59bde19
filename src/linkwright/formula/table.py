"""Tables of piecewise cubic polynomials: data of a call, looked up by a program."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from linkwright.formula.late_import import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from linkwright.core.arrays import Floats

#: Numbers before the breaks in :attr:`Table.numbers`: pieces, start, span, whether periodic, drift.
HEAD = 5


@dataclass(frozen=True, eq=False)
class Table:
    """c0 + c1 u + c2 u² + c3 u³ with u = x − ``breaks[piece]`` on every piece.

    ``breaks``: (pieces + 1,) increasing; ``coefficients``: (pieces, 4), lowest power first. Outside the
    breaks the end pieces go on; ``periodic``: the table repeats instead, ``drift`` higher each time.
    Raises ValueError for breaks that do not increase, numbers that are not finite, other shapes.
    """

    breaks: Floats
    coefficients: Floats
    periodic: bool = False
    drift: float = 0.0

    def __post_init__(self) -> None:
        breaks = np.array(self.breaks, dtype=np.float64)
        coefficients = np.array(self.coefficients, dtype=np.float64)
        if breaks.ndim != 1 or len(breaks) < 2 or coefficients.shape != (len(breaks) - 1, 4):
            raise ValueError(
                "a table needs breaks (pieces + 1,) and coefficients (pieces, 4), "
                f"not {breaks.shape} and {coefficients.shape}"
            )
        if not (np.isfinite(breaks).all() and np.isfinite(coefficients).all() and np.isfinite(self.drift)):
            raise ValueError("a table's breaks, coefficients and drift must be finite numbers")
        if not (np.diff(breaks) > 0.0).all():
            raise ValueError("a table's breaks must increase")
        object.__setattr__(self, "breaks", breaks)
        object.__setattr__(self, "coefficients", coefficients)

    @classmethod
    def linear(cls, x: ArrayLike, y: ArrayLike, *, periodic: bool = False, drift: float | None = None) -> Table:
        """Straight lines between the points; beyond the ends the end values (not periodic) stay.

        ``periodic``: the drift is by default y's change over the table.
        """
        xs, ys = _points(x, y)
        slopes = np.diff(ys) / np.diff(xs)
        coefficients = np.zeros((len(slopes), 4))
        coefficients[:, 0], coefficients[:, 1] = ys[:-1], slopes
        if periodic:
            return cls(xs, coefficients, True, float(ys[-1] - ys[0]) if drift is None else drift)
        level = [[ys[0], 0.0, 0.0, 0.0]], [[ys[-1], 0.0, 0.0, 0.0]]
        reach = xs[-1] - xs[0]
        breaks = np.concatenate([[xs[0] - reach], xs, [xs[-1] + reach]])
        return cls(breaks, np.concatenate([level[0], coefficients, level[1]]))

    @classmethod
    def spline(cls, x: ArrayLike, y: ArrayLike, *, periodic: bool = False) -> Table:
        """The cubic through the points with continuous second derivative.

        The third derivative is continuous at the first and last inner points as well (two points: a line, three: a
        parabola). ``periodic``: slope and curvature repeat instead, and y may rise from turn to turn, which is the
        table's drift.
        """
        from scipy.interpolate import CubicSpline

        xs, ys = _points(x, y)
        if not periodic:
            return cls(xs, CubicSpline(xs, ys).c[::-1].T)
        drift = float(ys[-1] - ys[0])
        slope = drift / (xs[-1] - xs[0])
        level = ys - slope * (xs - xs[0])
        level[-1] = level[0]
        coefficients = CubicSpline(xs, level, bc_type="periodic").c[::-1].T.copy()
        coefficients[:, 0], coefficients[:, 1] = ys[:-1], coefficients[:, 1] + slope
        return cls(xs, coefficients, True, drift)

    @cached_property
    def numbers(self) -> Floats:
        """Everything in one array, as compiled code reads it."""
        head = [len(self.coefficients), self.breaks[0], self.span, float(self.periodic), self.drift]
        return np.concatenate([head, self.breaks, self.coefficients.ravel()])

    @property
    def span(self) -> float:
        """Length of one turn of a periodic table."""
        return float(self.breaks[-1] - self.breaks[0])

    @cached_property
    def _columns(self) -> tuple[Floats, ...]:
        return tuple(np.ascontiguousarray(column) for column in self.coefficients.T)

    def __call__(self, x: ArrayLike, order: int = 0) -> Floats:
        """The value, or its derivative of ``order`` 1 to 3, at x; NaN for NaN."""
        at, turns = np.asarray(x, dtype=np.float64), None
        with np.errstate(invalid="ignore", over="ignore"):
            if self.periodic:
                turns = np.floor((at - self.breaks[0]) / self.span)
                at = at - turns * self.span
            piece = np.searchsorted(self.breaks[1:-1], at, side="right")
            u = at - self.breaks[piece]
            c0, c1, c2, c3 = (column[piece] for column in self._columns)
            if order == 0:
                value = c0 + u * (c1 + u * (c2 + u * c3))
                return np.asarray(value if turns is None else value + turns * self.drift)
            if order == 1:
                return np.asarray(c1 + u * (2.0 * c2 + u * (3.0 * c3)))
            return np.asarray(2.0 * c2 + u * (6.0 * c3) if order == 2 else 6.0 * c3 + 0.0 * u)


Tables = Mapping[str, Table]


def tables_in_order(names: tuple[str, ...], tables: Tables | None) -> list[Table]:
    """The tables that a program looks up, in its order. Raises ValueError for one that is missing."""
    if not names:
        return []
    missing = [name for name in names if name not in (tables or {})]
    if missing:
        raise ValueError(f"the program looks up the tables {', '.join(missing)}: give them")
    return [(tables or {})[name] for name in names]


def _points(x: ArrayLike, y: ArrayLike) -> tuple[Floats, Floats]:
    xs, ys = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    if xs.ndim != 1 or xs.shape != ys.shape or len(xs) < 2 or not (np.diff(xs) > 0.0).all():
        raise ValueError("a table needs two or more points, x increasing, one y for each")
    return xs, ys
