"""A function of one variable as polynomials between edges: its integral and its extremes.

Every piece goes through the function's values at sixteen Gauss points (Legendre series of degree 15), so that smooth
functions are met to rounding; a piece that is not met, because the function jumps or kinks in it, is halved until it
no longer matters. Extremes are those of the polynomials, to 1e-13 of a piece's width where the function is
smooth (Trefethen, Approximation Theory and Approximation Practice, ch. 8 and 18).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import EQUAL, Flags, Floats, Indices
from linkwright.core.dataclass import dataclass

Function = Callable[[Floats], Floats]

POINTS = 16
NODES, WEIGHTS = np.polynomial.legendre.leggauss(POINTS)
_ORDERS = np.arange(POINTS)
#: From values at the nodes to coefficients of Legendre polynomials, (nodes, orders); to the slope at the nodes.
TO_LEGENDRE = ((_ORDERS[:, None] + 0.5) * np.polynomial.legendre.legvander(NODES, POINTS - 1).T * WEIGHTS).T
TO_SLOPE = TO_LEGENDRE @ np.polynomial.legendre.legval(NODES, np.polynomial.legendre.legder(np.eye(POINTS)))
#: To the last three of these coefficients, and to the values at both ends.
TO_LAST = TO_LEGENDRE[:, -3:]
TO_ENDS = TO_LEGENDRE @ np.polynomial.legendre.legvander(np.array([-1.0, 1.0]), POINTS - 1).T
#: Weights of the barycentric formula (Berrut and Trefethen, SIAM Review 46(3), 2004).
_BARYCENTRIC = (-1.0) ** _ORDERS * np.sqrt((1.0 - NODES**2) * WEIGHTS)
#: Added to distances from nodes, so that none is zero; it changes no other.
_NEXT_TO_NOTHING = 1e-300
#: Places of a piece where it is looked at for extremes, both ends among them.
LOOKS = 49
PLACES = -np.cos(np.pi * np.arange(LOOKS) / (LOOKS - 1))
TO_PLACES = TO_LEGENDRE @ np.polynomial.legendre.legvander(PLACES, POINTS - 1).T
#: A Newton step of this size towards an extreme is the last one, as what is left is its square; a halving's size.
LAST, HALVED = 3e-7, 1e-9
#: A piece is met where the last orders have less than this share of the function's size.
SMOOTH = 1e-11
#: Halving ends where it changes the integral by less than this share, or after so many times.
_FINE, _HALVINGS = 1e-14, 48
_NONE: Floats = np.empty(0)
#: More pieces than this that want halving mean noise, which no halving smooths; so do more pieces than before where
#: they miss less than this share of the function's size.
_NOISE, _LOUDEST = 2000, 1e-9
#: How many times the size of its last orders a piece that is not met may rise between its Gauss points, and the width
#: of a piece that is halved no more. So many pieces to be halved at once are no noise.
_HIDDEN, _LEAST, _MANY = 8.0, 1e-13, 8
#: How much higher than its nodes, as share of the span of these, a function may be in a piece that meets it: half of
#: the gap between two nodes, squared, is 0.009 of it, and up to the ends it may rise by 0.025.
SLACK = 0.03


def nodes(edges: Floats) -> Floats:
    """Gauss points of all pieces between edges (m + 1,), (m, POINTS)."""
    low, high = edges[:-1, None], edges[1:, None]
    return np.asarray(0.5 * (low + high) + 0.5 * (high - low) * NODES)


def edges_between(start: float, end: float, pieces: int, knots: Floats) -> Floats:
    """Edges of equal pieces, with the knots that lie inside."""
    edges = np.linspace(start, end, pieces + 1)
    return increasing(np.append(edges, knots[(knots > start) & (knots < end)]))


def increasing(places: Floats) -> Floats:
    """Places in increasing order, each once; ``np.unique`` would bring masked arrays along at start."""
    ordered = np.sort(places)
    return np.asarray(ordered[np.append(True, np.diff(ordered) != 0.0)[: len(ordered)]])


@dataclass(frozen=True)
class Extreme:
    """The largest or smallest value of a function; ``smooth``: whether its piece is met by the polynomial."""

    place: float
    value: float
    smooth: bool


class Piecewise:
    """Polynomials between ``edges`` (m + 1,) through ``values`` (m, POINTS) at the Gauss points of the pieces.

    ``function``: the function itself, asked where pieces are not met, or do not meet each other at other edges than
    the ``knots``; without it they stay as they are. ``tolerance``: share of the function's size that is its noise.
    """

    def __init__(
        self,
        edges: Floats,
        values: Floats,
        function: Function | None = None,
        knots: Floats = _NONE,
        tolerance: float = SMOOTH,
    ) -> None:
        self.edges, self.values, self.tolerance = edges, values, tolerance
        if function is not None:
            self.edges, self.values = _halved(edges, values, function, knots, tolerance)

    @classmethod
    def of(
        cls,
        function: Function,
        start: float,
        end: float,
        *,
        pieces: int = 60,
        knots: Floats = _NONE,
    ) -> Piecewise:
        """A function between two places; ``knots``: where it may kink or jump, as far as that is known."""
        edges = edges_between(start, end, pieces, knots)
        return cls(edges, function(nodes(edges).ravel()).reshape(-1, POINTS), function, knots)

    @property
    def width(self) -> Floats:
        """Widths of the pieces, (m,)."""
        return np.diff(self.edges)

    @cached_property
    def smooth(self) -> Flags:
        """Which pieces are met by their polynomials, (m,)."""
        return np.asarray(tails(self.values) <= self.tolerance * np.abs(self.values).max(initial=0.0))

    def __call__(self, x: Floats) -> Floats:
        """The function at places between the outer edges, (n,)."""
        piece, share = self._place(x)
        return _at(self.values[piece], share)

    def _place(self, x: Floats) -> tuple[Indices, Floats]:
        piece = np.searchsorted(self.edges[1:-1], x, "right")
        low, high = self.edges[piece], self.edges[piece + 1]
        return piece, np.minimum(np.maximum((2.0 * x - low - high) / (high - low), -1.0), 1.0)

    def part(self, low: float, high: float) -> Piecewise:
        """The same function between two places inside the outer edges."""
        first = int(np.searchsorted(self.edges, low, "right")) - 1
        last = int(np.searchsorted(self.edges, high, "left"))
        edges, values = self.edges[first : last + 1].copy(), self.values[first:last].copy()
        edges[0], edges[-1] = low, high
        cut = np.concatenate([nodes(edges[:2]), nodes(edges[-2:])])
        values[[0, -1]] = self(cut.ravel()).reshape(2, POINTS)
        return Piecewise(edges, values, tolerance=self.tolerance)

    # integral -----------------------------------------------------------------------------
    @property
    def total(self) -> float:
        """Integral over all pieces."""
        return float(0.5 * self.width @ (self.values @ WEIGHTS))

    def integral(self) -> Integral:
        """The integral from the first edge to any place."""
        return Integral(self)

    # extremes ----------------------------------------------------------------------------
    def extreme(self, kind: str) -> Extreme:
        """The ``max`` or ``min``; at a jump the larger (smaller) of both sides counts."""
        return extremes_of([(self, kind)])[0]

    def extremes(self) -> tuple[Extreme, Extreme]:
        """The smallest and the largest value."""
        least, most = extremes_of([(self, "min"), (self, "max")])
        return least, most


def extremes_of(wanted: Sequence[tuple[Piecewise, str]]) -> list[Extreme]:
    """The ``max`` or ``min`` of some functions, looked for together."""
    count = max(len(each.values) for each, _ in wanted)
    signs = [1.0 if kind == "max" else -1.0 for _, kind in wanted]
    values, tops = np.empty((len(wanted), POINTS, count)), np.full((len(wanted), count), -np.inf)
    for k, (each, _) in enumerate(wanted):
        own = len(each.values)
        values[k, :, :own] = signs[k] * each.values.T
        values[k, :, own:] = values[k, :, :1]
        tops[k, :own] = values[k, :, :own].max(axis=0)
    piece, share, top, rough = largest(values, tops)
    bound = np.abs(values).max(axis=(1, 2), initial=0.0) * [each.tolerance for each, _ in wanted]
    found = []
    for k, (each, _) in enumerate(wanted):
        at = int(piece[k]) if piece[k] < len(each.values) else 0  # what fills up is the first piece again
        low, high = each.edges[at : at + 2]
        place = float(low + 0.5 * (share[k] + 1.0) * (high - low))
        found.append(Extreme(place, signs[k] * float(top[k]), bool(rough[k] <= bound[k])))
    return found


class Integral:
    """W(x) = ∫ from the first edge to x of piecewise polynomials, to rounding."""

    def __init__(self, of: Piecewise) -> None:
        self.of = of
        self._before = np.concatenate([[0.0], np.cumsum(0.5 * of.width * (of.values @ WEIGHTS))])
        self.total = float(self._before[-1])

    @cached_property
    def _series(self) -> Floats:
        return self.of.values @ TO_LEGENDRE

    @property
    def edges(self) -> Floats:
        """Ends of all pieces."""
        return self.of.edges

    def __call__(self, x: Floats) -> Floats:
        """W at places between the outer edges, (n,)."""
        piece, share = self.of._place(x)
        known = np.polynomial.legendre.legvander(share, POINTS)
        gained = np.concatenate(
            [share[:, None] + 1.0, (known[:, 2:] - known[:, :-2]) / (2 * _ORDERS[1:] + 1)], axis=1
        )
        half = 0.5 * self.of.width[piece]
        return np.asarray(self._before[piece] + half * (gained * self._series[piece]).sum(axis=1))

    @cached_property
    def at_nodes(self) -> Floats:
        """W at the Gauss points of all pieces, (m, POINTS)."""
        gained = 0.5 * self.of.width[:, None] * (self.of.values @ _UP_TO_NODES)
        return np.asarray(self._before[:-1, None] + gained)


def tails(values: Floats) -> Floats:
    """Size of the last orders (...,) of polynomials through values (..., POINTS): zero but for rounding if smooth."""
    last = np.abs(TO_LAST.T @ values.reshape(-1, POINTS).T)
    return np.asarray(last.max(axis=0).reshape(values.shape[:-1]))


def joined(edges: Floats, knots: Floats) -> Flags:
    """At which of the inner edges a function meets itself, as it may jump or kink at ``knots`` alone."""
    return np.asarray(~np.isin(edges[1:-1], knots))


def misses(values: Floats, meeting: Flags) -> Floats:
    """How far polynomials through values (..., m, POINTS) are from meeting a function, (..., m): the last orders, and
    how far neighbours are apart at the inner edges (m - 1,) where they are ``meeting``."""
    found, sides = tails(values), values @ TO_ENDS
    gap = np.abs(sides[..., 1:, 0] - sides[..., :-1, 1]) * meeting
    for side in (found[..., 1:], found[..., :-1]):
        np.maximum(side, gap, out=side)
    return found


def reach(values: Floats, tops: Floats, bounds: Floats) -> Floats:
    """How high functions (k, m, POINTS), and their negatives, may rise in pieces that are not met to ``bounds`` (k,),
    (2 k,); ``tops``: their largest values in each piece, (2, k, m)."""
    off = tails(values)
    rise = SLACK * tops.sum(axis=0) + _HIDDEN * off
    return np.asarray(np.where(off > bounds[:, None], tops + rise, -np.inf).max(axis=2).ravel())


def sought(curve: Piecewise, kind: str, function: Function) -> Extreme:
    """The ``max`` or ``min`` of a function that a curve may not meet everywhere: pieces that may hold it are halved
    until they are met, or halving changes no more; of jumps the values at the Gauss points beside them count."""
    sign = 1.0 if kind == "max" else -1.0
    low, high, values = curve.edges[:-1], curve.edges[1:], sign * curve.values
    bound, least = curve.tolerance * float(np.abs(values).max()), _LEAST * float(high[-1] - low[0])
    before, many = np.inf, _MANY
    for _ in range(_HALVINGS):
        off, tops = tails(values), values.max(axis=1)
        rough = off > bound
        rise = SLACK * (tops - values.min(axis=1)) + rough * _HIDDEN * off
        kept = tops + rise >= tops.max() - bound
        low, high, values, rough = low[kept], high[kept], values[kept], rough[kept]
        level, count = float(np.median(off[kept][rough])) if rough.any() else 0.0, int(rough.sum())
        if not count or (high - low)[rough].max() < least or (count > many and level > 0.25 * before):
            break
        before, many = level, max(count, _MANY)
        middle = 0.5 * (low + high)[rough]
        starts, ends = np.append(low[rough], middle), np.append(middle, high[rough])
        places = 0.5 * (starts + ends)[:, None] + 0.5 * (ends - starts)[:, None] * NODES
        new = sign * function(places.ravel()).reshape(-1, POINTS)
        low, high = np.append(low[~rough], starts), np.append(high[~rough], ends)
        values = np.concatenate([values[~rough], new])
    jumps = rough & (high - low < 2.0 * least)
    values[jumps] = values[jumps].max(axis=1, keepdims=True)
    order = np.argsort(low)
    low, high, values, rough = low[order], high[order], values[order], rough[order]
    found = largest(values.T[None], values.max(axis=1)[None])
    piece, share, value, _ = (each[0] for each in found)
    place = 0.5 * (low[piece] + high[piece]) + 0.5 * share * (high[piece] - low[piece])
    return Extreme(float(place), sign * float(value), not rough[piece])


Peak = tuple[Indices, Floats, Floats, Floats]


def largest(values: Floats, tops: Floats) -> Peak:
    """The largest values of many functions (k, POINTS, pieces) at the Gauss points of their pieces.

    ``tops``: the largest of the values in each piece, (k, pieces); the polynomials of all pieces that may be higher
    than the largest of these are climbed, as two of one height may differ between the points. Of equal ones the first
    counts, of a constant piece its beginning.
    Returns the piece, the place in it (-1 to 1), the value, and the size of the last orders there, (k,) each.
    """
    tops = np.where(np.isnan(tops), -np.inf, tops)
    highest, least = tops.argmax(axis=1), values.min(axis=1)
    with np.errstate(invalid="ignore"):
        equal = EQUAL * np.maximum(tops.max(axis=1), -least.min(axis=1))
        may = tops + SLACK * (tops - least) > (tops.max(axis=1) - equal)[:, None]
        flat = tops - least <= equal[:, None]
    may[np.arange(len(may)), highest] = True
    rows, pieces = np.nonzero(may)
    series, equal = values[rows, :, pieces], equal[rows]
    seen = series @ TO_PLACES
    look, top = (seen >= (seen.max(axis=1) - equal)[:, None]).argmax(axis=1), seen.max(axis=1)
    low, high = PLACES[np.maximum(look - 1, 0)], PLACES[np.minimum(look + 1, LOOKS - 1)]
    place = _summits(series @ TO_SLOPE, low, high, PLACES[look])
    found = _at(series, place)
    place, found = np.where(found > top, place, PLACES[look]), np.maximum(found, top)
    place = np.where(flat[rows, pieces], -1.0, place)
    begins = np.flatnonzero(np.diff(rows, prepend=-1))
    peak = np.maximum.reduceat(found, begins)[rows]
    good = np.flatnonzero(~(found < peak - equal))
    best = good[np.diff(rows[good], prepend=-1) != 0]
    return pieces[best], place[best], found[best], tails(series[best])


def weights_at(place: Floats) -> Floats:
    """Weights (k, POINTS) of the values at the Gauss points in the polynomials' values at places (k,) of a piece."""
    share = _shares(place)
    return np.asarray(share / share.sum(axis=-1, keepdims=True))


def weights_up_to(place: Floats) -> Floats:
    """The same in the integrals of the polynomials from the beginning of the piece, of width 2, to places (k,)."""
    known = np.polynomial.legendre.legvander(place, POINTS)
    gained = (known[:, 2:] - known[:, :-2]) / (2 * _ORDERS[1:] + 1)
    return np.asarray(np.concatenate([place[:, None] + 1.0, gained], axis=1) @ TO_LEGENDRE.T)


#: From values at the nodes to integrals up to each of them.
_UP_TO_NODES = weights_up_to(NODES).T


def at_nodes(function: Function, edges: Floats) -> Floats:
    """A function at the Gauss points between edges, (m, POINTS): its own values where it is polynomials there."""
    if isinstance(function, Piecewise) and function.edges is edges:
        return function.values
    return function(nodes(edges).ravel()).reshape(-1, POINTS)


def _at(values: Floats, x: Floats) -> Floats:
    """Polynomials (..., k) through values (..., k, POINTS) at places (k,) of the reference piece; k any shape."""
    share = _shares(x)
    return np.asarray(np.einsum("...i,...i->...", share, values) / share.sum(axis=-1))


def _shares(x: Floats) -> Floats:
    return np.asarray(_BARYCENTRIC / (x[..., None] - NODES + _NEXT_TO_NOTHING))


def _summits(slopes: Floats, low: Floats, high: Floats, start: Floats) -> Floats:
    """Where polynomials (..., POINTS) pass from above to below zero between places of the reference piece, by
    safeguarded Newton steps from ``start``; the end of the stretch to which they point where they do not."""
    both, x = np.empty((2, *slopes.shape)), start
    both[0], both[1] = slopes, (slopes.reshape(-1, POINTS) @ TO_SLOPE).reshape(slopes.shape)
    for _ in range(60):
        value, slope = _at(both, x)
        rising = value > 0.0
        low, high = np.where(rising, x, low), np.where(rising, high, x)
        with np.errstate(all="ignore"):
            newton = x - value / slope
        inside = (newton >= low) & (newton <= high)
        before, x = x, np.where(inside, newton, 0.5 * (low + high))
        if not (np.abs(x - before) > np.where(inside, LAST, HALVED)).any():
            break
    return x


def _halved(
    edges: Floats, values: Floats, function: Function, knots: Floats, tolerance: float
) -> tuple[Floats, Floats]:
    """Pieces halved where they are not met, or where neighbours do not meet away from the knots, until that no longer
    changes the integral, or what is left is noise, which halving makes more and not less."""
    size = float(np.abs(values).max(initial=0.0))
    scale = float(np.diff(edges) @ np.abs(values).mean(axis=1))
    before, many = 0.0, _NOISE
    for _ in range(_HALVINGS):
        off = misses(values, joined(edges, knots))
        rough = (off > tolerance * size) & (np.diff(edges) * off > _FINE * scale)
        level, count = float(np.median(off[rough])) if rough.any() else 0.0, int(rough.sum())
        if not 0 < count <= _NOISE or (count > many and 0.25 * before < level < _LOUDEST * size):
            break
        before, many = level, count
        low, middle, high = edges[:-1][rough], (0.5 * (edges[:-1] + edges[1:]))[rough], edges[1:][rough]
        starts, ends = np.append(low, middle), np.append(middle, high)
        places = 0.5 * (starts + ends)[:, None] + 0.5 * (ends - starts)[:, None] * NODES
        new = function(places.ravel()).reshape(-1, POINTS)
        starts = np.concatenate([edges[:-1][~rough], starts])
        order = np.argsort(starts, kind="stable")
        edges = np.append(starts[order], edges[-1])
        values = np.concatenate([values[~rough], new])[order]
    return edges, values
