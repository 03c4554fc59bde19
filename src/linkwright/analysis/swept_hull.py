"""Convex hull of curves that are polynomials piece by piece: its area, and the derivatives of that by the curves.

The boundary consists of arcs of the curves and of lines that touch two curves. The hull of all nodes tells which
arcs follow each other; a side of it between two arcs is moved outwards until it touches both, and the arcs between
the places of contact are integrated, ½∮ p × dp. Places of contact may be held while the curves move: the area changes
by what is of second order in them (envelope theorem).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.plane import area, cross, hull_corners
from linkwright.curves.polynomials import PLACES, POINTS, TO_SLOPE, weights_at

#: Newton steps towards the places of contact at most, and the last one's size where they end before.
STEPS, CLOSE = 6, 1e-7
#: How far beyond a piece, and from a node, a curve is evaluated, in halves of the piece's width.
BEYOND, NEAR = 0.02, 0.6
#: Indices of contact nearer than this share of a side are one: a side of an arc, not one between two.
SAME = 0.1
#: Sides shorter than this share of the largest are none: the same place, passed twice.
SHORT = 1e-9
#: How much smaller than its hull the polygon of many places of curves may be, and larger by rounding.
CHORDS, ROUNDED = 1e-6, 1e-12
#: Nodes of a piece that are enough within an arc.
_ALWAYS_USED = np.isin(np.arange(POINTS), (0, 5, 10, POINTS - 1))
#: Along the boundary where it is farthest to the left, the right, down and up.
_ALONG = np.array([[0.0, -1.0], [0.0, 1.0], [1.0, 0.0], [-1.0, 0.0]])
#: Places of a piece at which what has no lines that touch is looked at.
_DENSE = np.linspace(-1.0, 1.0, 401)
_INNER, _SHARES = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True)
class Curves:
    """Curves as ``values`` (curves, 2, pieces, POINTS), m, at the Gauss points of pieces that follow each other;
    ``begins``, ``ends``: pieces (pieces,) with nothing before or behind them; ``spans`` (curves, 2): the first node
    and that behind the last one of what suffices of every curve, as of one that is run to and fro."""

    values: Floats
    begins: Flags
    ends: Flags
    spans: Indices


@dataclass(frozen=True)
class Contacts:
    """Places on curves: numbers of nodes (k,), places in their pieces (k,), -1 to 1, and points there (k, 2), m."""

    number: Indices
    place: Floats
    point: Floats


class SweptHull:
    """The convex hull of some of the curves, ``chosen`` by their numbers.

    ``area``: m², to 1e-6 of it, to 1e-9 where arcs are run once and none comes out between two nodes alone.
    """

    def __init__(self, curves: Curves, chosen: Sequence[int]) -> None:
        self._curves, self._pieces = curves, curves.values.shape[2]
        self._values = curves.values - curves.values[chosen[0], :, :1, :1]
        self._nodes = np.ascontiguousarray(self._values.transpose(0, 2, 3, 1)).reshape(-1, 2)
        numbers = np.arange(len(self._nodes)).reshape(len(self._values), -1)
        own = np.concatenate([numbers[k, slice(*curves.spans[k])] for k in chosen])
        self._corners = own[hull_corners(self._nodes.view(np.complex128)[own, 0])]
        self._polygon: Contacts | None = None
        self._first, self._last, self._outer = self._touched(self._thinned(self._corners))
        self.area = self._area()
        if not self._found or self.area < area(self._nodes.view(np.complex128)[self._corners, 0]):
            sampled = self._sampled()
            smallest = area(np.ascontiguousarray(sampled.point).view(np.complex128)[:, 0])
            if not smallest * (1.0 - ROUNDED) <= self.area <= smallest * (1.0 + CHORDS):
                self.area, self._polygon = smallest, sampled

    def _thinned(self, corners: Indices) -> Indices:
        """Corners at places of their own, without those between others of the same curve that are no farther than its
        next nodes: those amid arcs, which may have the nodes of several passages."""
        sides = _squares(self._nodes[corners] - self._nodes[np.roll(corners, 1)])
        corners = corners[sides >= SHORT * SHORT * sides.max()]
        curve, place = corners // POINTS // self._pieces, self._nodes[corners]
        neighbours = (self._nodes.take(corners + k, axis=0, mode="clip") - place for k in (-1, 1))
        near = 2.0 * np.maximum(*map(_squares, neighbours))
        arc, number = ~_ALWAYS_USED[corners % POINTS], np.arange(len(corners))
        for other in (number - 1, number + 1 - len(corners)):
            arc &= (curve[other] == curve) & (_squares(place[other] - place) <= near)
        return np.asarray(corners[~arc])

    def _touched(self, corners: Indices) -> list[Contacts]:
        """Where the curve at the beginning, and that at the end of every side touches a line along it, and where
        curves come farthest to the left, the right, down and up."""
        begin, end = corners, np.concatenate([corners[1:], corners[:1]])
        first, last = PLACES[begin % POINTS], PLACES[end % POINTS]
        arc = begin // POINTS == end // POINTS
        arc &= np.abs(last - first) <= 2.0 * NEAR
        first[arc] = last[arc] = 0.5 * (first + last)[arc]
        free = np.flatnonzero(~arc)
        along = self._nodes[end[free]] - self._nodes[begin[free]]
        near = np.concatenate([SAME * SAME * _squares(along), [np.inf] * 4])
        found = self._nodes[self._corners]
        low, high = found.argmin(axis=0), found.argmax(axis=0)
        outer = self._corners[[low[0], high[0], low[1], high[1]]]
        begins, ends = np.concatenate([begin[free], outer]), np.concatenate([end[free], outer])
        begun, ended = self._touching(begins, ends, np.concatenate([along, _ALONG]), near)
        first[free], last[free] = begun[:-4], ended[:-4]
        moved = np.maximum(np.abs(first - PLACES[begin % POINTS]), np.abs(last - PLACES[end % POINTS]))
        self._found = bool(moved.max(initial=0.0) < NEAR - CLOSE)
        number, place = np.concatenate([begin, end, outer]), np.concatenate([first, last, begun[-4:]])
        point = _at(self._pieces_of(number), _weights(place))
        groups = (slice(len(begin)), slice(len(begin), -4), slice(-4, None))
        return [Contacts(number[group], place[group], point[group]) for group in groups]

    def _touching(self, begin: Indices, end: Indices, along: Floats, near: Floats) -> tuple[Floats, Floats]:
        """Places near some nodes where lines touch the curves, by Newton's method: ``along`` a direction, or along
        the side between both places of contact where its square is larger than ``near``."""
        number, half = np.concatenate([begin, end]), len(begin)
        place, piece = PLACES[number % POINTS], number // POINTS % self._pieces
        low, high = np.maximum(place - NEAR, -1.0 - BEYOND), np.minimum(place + NEAR, 1.0 + BEYOND)
        low = np.where(self._curves.begins[piece], np.maximum(low, -1.0), low)
        high = np.where(self._curves.ends[piece], np.minimum(high, 1.0), high)
        # hollow curves touch in their ends alone
        bounded = (self._curves.begins | self._curves.ends)[piece].astype(float)
        values = self._pieces_of(number)
        rates = values @ TO_SLOPE.T
        every = np.concatenate([values, rates, rates @ TO_SLOPE.T], axis=1)
        found = _at(every, _weights(place))
        with np.errstate(over="ignore"):
            for _ in range(STEPS):
                both = np.concatenate([along, along])
                turn, speed = cross(both, found[:, 4:]), cross(both, found[:, 2:4])
                step = np.divide(-speed, turn, out=-np.sign(speed) * bounded, where=turn > 0.0)
                before, place = place, np.minimum(np.maximum(place + step, low), high)
                if np.abs(place - before).max(initial=0.0) <= CLOSE:
                    break
                found = _at(every, _weights(place))
                between = found[half:, :2] - found[:half, :2]
                along = np.where((_squares(between) > near)[:, None], between, along)
        return place[:half], place[half:]

    def _pieces_of(self, number: Indices) -> Floats:
        """Curves (k, 2, POINTS) from the origin, in the pieces of some nodes."""
        curve, piece = np.divmod(number // POINTS, self._pieces)
        return np.asarray(self._values[curve, :, piece])

    @property
    def _arcs(self) -> tuple[Indices, Floats, Floats]:
        """Nodes' numbers, places (k,) and widths of the parts of arcs behind the sides, in halves of pieces."""
        start, end = self._last.place, np.concatenate([self._first.place[1:], self._first.place[:1]])
        half = 0.5 * (end - start)
        place = 0.5 * (start + end)[:, None] + half[:, None] * _INNER
        return np.repeat(self._last.number, len(_INNER)), place.ravel(), (half[:, None] * _SHARES).ravel()

    def _area(self) -> float:
        number, place, width = self._arcs
        values, at = self._pieces_of(number), _weights(place)
        along = width @ cross(_at(values, at), _at(values, at @ TO_SLOPE))
        return 0.5 * float(along + cross(self._first.point, self._last.point).sum())

    def _sampled(self) -> Contacts:
        """Corners of the hull of many places of the curves, where lines that touch two arcs are not found: of a curve
        that turns back on itself."""
        numbers = np.unique(self._corners // POINTS)
        curves, pieces = np.divmod(numbers, self._pieces)
        neighbours = [(pieces + k) % self._pieces for k in (-1, 0, 1)]
        numbers = np.unique(np.concatenate([curves * self._pieces + each for each in neighbours]))
        curves, pieces = np.divmod(numbers, self._pieces)
        point = np.einsum("kjp,np->knj", self._values[curves, :, pieces], _weights(_DENSE)).reshape(-1, 2)
        point = np.concatenate([point, self._nodes[self._corners]])
        number = np.append(np.repeat(numbers * POINTS, len(_DENSE)), self._corners)
        place = np.append(np.tile(_DENSE, len(numbers)), PLACES[self._corners % POINTS])
        outer = hull_corners(np.ascontiguousarray(point).view(np.complex128)[:, 0])
        return Contacts(number[outer], place[outer], point[outer])

    @property
    def box(self) -> Floats:
        """Width and height, (2,) m."""
        left, right, bottom, top = self._outer.point
        return np.array([right[0] - left[0], top[1] - bottom[1]])

    def weights(self) -> Floats:
        """Derivatives (curves, 2, pieces, POINTS) of the area by the values of all curves, those in spans alone."""
        curves, _, pieces, _ = self._values.shape
        found = np.zeros((curves * pieces, 2, POINTS))
        if (polygon := self._polygon) is not None:
            neighbours = np.roll(polygon.point, 1, axis=0) - np.roll(polygon.point, -1, axis=0)
            _add(found, polygon.number, _weights(polygon.place), 0.5 * _turned(neighbours))
            return found.reshape(curves, pieces, 2, POINTS).transpose(0, 2, 1, 3)
        for contacts, other, sign in ((self._first, self._last, -0.5), (self._last, self._first, 0.5)):
            _add(found, contacts.number, _weights(contacts.place), sign * _turned(other.point))
        number, place, width = self._arcs
        values, at, half = self._pieces_of(number), _weights(place), 0.5 * width[:, None]
        slope = at @ TO_SLOPE
        _add(found, number, at, -half * _turned(_at(values, slope)))
        _add(found, number, slope, half * _turned(_at(values, at)))
        return found.reshape(curves, pieces, 2, POINTS).transpose(0, 2, 1, 3)


def _add(found: Floats, number: Indices, weights: Floats, factor: Floats) -> None:
    """Weights (k, POINTS), times factors (k, 2), to those of the pieces in which some nodes are."""
    np.add.at(found, number // POINTS, factor[:, :, None] * weights[:, None, :])


def _at(values: Floats, weights: Floats) -> Floats:
    """Polynomials (k, j, POINTS) with weights (k, POINTS) of their values, (k, j)."""
    return np.asarray(np.einsum("kjp,kp->kj", values, weights))


def _weights(place: Floats) -> Floats:
    """Weights (k, POINTS) of the values at the nodes in those at places (k,)."""
    return weights_at(place).T


def _squares(vectors: Floats) -> Floats:
    """Squares (k,) of the lengths of vectors (k, 2)."""
    return np.asarray(np.einsum("kj,kj->k", vectors, vectors))


def _turned(vectors: Floats) -> Floats:
    """Vectors (k, 2) turned by a right angle: a × b = turned(a) · b."""
    return np.stack([-vectors[:, 1], vectors[:, 0]], axis=1)
