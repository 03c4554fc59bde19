"""A function of one variable as polynomials between edges: its integral and its extremes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats, Indices, largest
from linkwright.curves.pieces import HIGH, LOW, NARROW, Columns, Layout, Pieces, Wanted
from linkwright.curves.polynomials import (
    LAST,
    NODES,
    PLACES,
    POINTS,
    SERIES,
    SLACK,
    UP_TO,
    WEIGHTS,
    climbed,
    product,
    value_at,
)

Function = Callable[[Floats], Floats]

#: A piece is met where its last orders are below this share of the function's size.
MET = 3e-12
#: More pieces than these that are unmet at once are noise; narrower pieces count by their width.
CROWD, WIDE = 2000, 1e-3
_WANTED = Wanted((0,), ((0, 1.0), (0, -1.0)), met=MET, crowd=CROWD, wide=WIDE, joined=True)
_NONE: Floats = np.empty(0)


@dataclass(frozen=True)
class Extreme:
    """The largest or smallest value of a function; ``smooth``: whether its piece is met by the polynomial."""

    place: float
    value: float
    smooth: bool = True


class Curve:
    """Polynomials between ``edges`` (m + 1,) through ``values`` (POINTS, m) at the Gauss points of the pieces, which
    are met to a share ``met`` of the function's size."""

    def __init__(self, edges: Floats, values: Floats, met: float = MET) -> None:
        self.edges, self.values, self.met = edges, values, met

    @classmethod
    def of(cls, function: Function, start: float, end: float, *, pieces: int = 60, knots: Floats = _NONE) -> Curve:
        """A function (n,) -> (n,) between two places, in pieces that are halved until their polynomials meet it, and
        each other where it may neither kink nor jump: but at ``knots``, as far as these are known."""
        inner = increasing(knots[(knots > start) & (knots < end)])
        cuts = np.concatenate([[start], inner, [end]])
        count = np.maximum(1, np.ceil(pieces * np.diff(cuts) / (end - start) - 1e-9).astype(np.intp))
        stretch = np.repeat(np.arange(len(count)), count)
        place = np.arange(len(stretch)) - np.repeat(np.cumsum(count) - count, count)

        def columns(stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
            low, high = cuts[stretch], cuts[stretch + 1]
            return {LOW: low * (1.0 - first) + high * first, HIGH: low * (1.0 - last) + high * last}

        def signals(columns: Columns, nodes: Floats) -> Floats:
            low, width = columns[LOW], columns[HIGH] - columns[LOW]
            return function((low + width * nodes[:, None]).ravel()).reshape(POINTS, 1, -1)

        layout, share = Layout(np.zeros(len(count), dtype=np.intp), 1, columns), 1.0 / count[stretch]
        found = Pieces(signals, layout, stretch, place * share, (place + 1) * share, _WANTED)
        return cls(np.append(found.columns[LOW], end), found.values(0))

    @cached_property
    def width(self) -> Floats:
        """Widths of the pieces, (m,)."""
        return np.diff(self.edges)

    @cached_property
    def smooth(self) -> Flags:
        """Which pieces are met by their polynomials, (m,)."""
        rough = np.abs(product(LAST, self.values)).max(axis=0)
        return np.asarray(rough <= self.met * np.abs(self.values).max(initial=0.0))

    @cached_property
    def _series(self) -> Floats:
        return product(SERIES, self.values)

    def __call__(self, x: Floats) -> Floats:
        """The function at places between the outer edges, (n,)."""
        piece = np.searchsorted(self.edges[1:-1], x, "right")
        place = (2.0 * x - self.edges[piece] - self.edges[piece + 1]) / self.width[piece]
        return self._value(piece, np.clip(place, -1.0, 1.0))

    def _value(self, piece: Indices, place: Floats) -> Floats:
        return np.asarray(value_at(self._series[None, :, piece], place)[0])

    @property
    def mean(self) -> float:
        """The mean between the outer edges."""
        return float(self.width @ (WEIGHTS @ self.values)) / float(self.edges[-1] - self.edges[0])

    def integral(self) -> Integral:
        """The integral from the first edge to any place."""
        return Integral(self)

    def extremes(self) -> tuple[Extreme, Extreme]:
        """The smallest and the largest value."""
        lowest, highest = extremes_of([(self, "min"), (self, "max")])
        return lowest, highest

    def extreme(self, kind: str) -> Extreme:
        """The ``max`` or ``min``, of equal ones the first; at a jump the larger (smaller) of both sides counts."""
        return extremes_of([(self, kind)])[0]

    def _candidates(self, kind: str) -> _Candidates:
        """Candidates for the ``max`` or ``min`` at the nodes."""
        sign = 1.0 if kind == "max" else -1.0
        values = sign * self.values
        top, bottom, best = values.max(axis=0), values.min(axis=0), values.argmax(axis=0)
        value, equal = np.where(np.isnan(top), -np.inf, top), EQUAL * largest(values)
        jumps = ~self.smooth & (self.width <= 2.0 * NARROW * (self.edges[-1] - self.edges[0]))
        with np.errstate(invalid="ignore"):
            may = value + SLACK * (top - bottom) >= value.max() - equal
            place = np.where(top - bottom <= equal, -1.0, PLACES[best])
            may &= (top - bottom > equal) & np.isfinite(top - bottom) & ~jumps
        return _Candidates(sign, equal, place, value, np.flatnonzero(may), values[:, may])


@dataclass(frozen=True)
class _Candidates:
    """The largest value, times ``sign``, at the nodes of every piece, with its place, -1 to 1; the numbers of those
    that are climbed, and their ``rows``; below ``equal`` two values are the same."""

    sign: float
    equal: float
    place: Floats
    value: Floats
    climbed: Indices
    rows: Floats


def extremes_of(wanted: Sequence[tuple[Curve, str]]) -> list[Extreme]:
    """The ``max`` or ``min`` of some functions, climbed together."""
    candidates = [curve._candidates(kind) for curve, kind in wanted]
    places, values = climbed(np.concatenate([each.rows for each in candidates], axis=1))
    found, first = [], 0
    for (curve, _), each in zip(wanted, candidates, strict=True):
        end = first + len(each.climbed)
        each.place[each.climbed], each.value[each.climbed] = places[first:end], values[first:end]
        first = end
        at = int((each.value >= each.value.max() - each.equal).argmax())
        x = curve.edges[at] + 0.5 * (1.0 + each.place[at]) * curve.width[at]
        found.append(Extreme(float(x), each.sign * float(each.value[at]), bool(curve.smooth[at])))
    return found


class Integral(Curve):
    """W(x) = ∫ from the first edge to x; ``total``: up to the last one."""

    def __init__(self, of: Curve) -> None:
        gained = of.width * (UP_TO @ of.values)
        self._before = np.cumsum(np.append(0.0, of.width * (WEIGHTS @ of.values)))
        super().__init__(of.edges, self._before[:-1] + gained)
        self._series, self.total = SERIES @ gained, float(self._before[-1])

    def _value(self, piece: Indices, place: Floats) -> Floats:
        return self._before[piece] + super()._value(piece, place)


def nodes(edges: Floats) -> Floats:
    """Gauss points of the pieces between edges (m + 1,), (POINTS, m)."""
    return np.asarray(edges[:-1] + NODES[:, None] * np.diff(edges))


def at_nodes(function: Function, edges: Floats) -> Floats:
    """A function at the Gauss points between edges, (POINTS, m): its own values where it is polynomials there."""
    if isinstance(function, Curve) and function.edges is edges:
        return function.values
    return function(nodes(edges).ravel()).reshape(POINTS, -1)


def increasing(places: Floats) -> Floats:
    """Places in increasing order, each once; ``np.unique`` would bring masked arrays along at start."""
    ordered = np.sort(places)
    return np.asarray(ordered[np.append(True, np.diff(ordered) != 0.0)[: len(ordered)]])
