"""A path in the plane by its length: straight pieces, arcs and smooth curves through points, with their curvature."""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats

Vec = tuple[float, float]
#: Directions that agree within this (rad) make no corner; places within this share of the path are the same one.
STRAIGHT, SAME = 1e-9, 1e-12
#: Gauss points by which the length of a spline's piece is measured, and Newton's steps from a length to a place.
_X, _W = np.polynomial.legendre.leggauss(24)
_STEPS = 12


class Stretch(ABC):
    """One piece of a path."""

    @property
    @abstractmethod
    def length(self) -> float:
        """In m."""

    @property
    def joints(self) -> Floats:
        """Lengths, m, within the piece at which a derivative of the curvature jumps."""
        return np.empty(0)

    @abstractmethod
    def at(self, s: Floats) -> tuple[Floats, Floats, Floats]:
        """Place, direction and curvature vector (1/m), (n, 2) each, at lengths s (n,), m."""


@dataclass(frozen=True)
class Straight(Stretch):
    """The line from ``start`` to ``end``."""

    start: Vec
    end: Vec

    @cached_property
    def length(self) -> float:
        return math.dist(self.start, self.end)

    def at(self, s: Floats) -> tuple[Floats, Floats, Floats]:
        way = (np.array(self.end) - self.start) / self.length
        none = np.zeros((len(s), 2))
        return np.array(self.start) + s[:, None] * way, none + way, none


@dataclass(frozen=True)
class Arc(Stretch):
    """The arc from ``start`` about ``centre`` by ``turn``, rad, positive counter-clockwise."""

    start: Vec
    centre: Vec
    turn: float

    @cached_property
    def radius(self) -> float:
        """In m."""
        return math.dist(self.start, self.centre)

    @cached_property
    def length(self) -> float:
        return self.radius * abs(self.turn)

    @property
    def end(self) -> Vec:
        """Where it ends, m."""
        x, y = self.at(np.array([self.length]))[0][0]
        return float(x), float(y)

    def at(self, s: Floats) -> tuple[Floats, Floats, Floats]:
        arm, sense = np.array(self.start) - self.centre, math.copysign(1.0, self.turn)
        angle = math.atan2(arm[1], arm[0]) + sense * s / self.radius
        out = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        across = np.stack([-out[:, 1], out[:, 0]], axis=1)
        return self.centre + self.radius * out, sense * across, -out / self.radius


@dataclass(frozen=True)
class Smooth(Stretch):
    """The cubic spline through points, by the distances between them; closed where the last point is the first."""

    points: tuple[Vec, ...]

    @cached_property
    def _chords(self) -> Floats:
        rows = np.array(self.points)
        return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(rows, axis=0).T))])

    @cached_property
    def _curves(self) -> tuple[Any, Any, Any]:
        from scipy.interpolate import CubicSpline

        rows = np.array(self.points)
        closed = same(self.points[0], self.points[-1], float(self._chords[-1]))
        if closed:
            rows[-1] = rows[0]
        spline = CubicSpline(self._chords, rows, bc_type="periodic" if closed else "not-a-knot")
        return spline, spline.derivative(), spline.derivative(2)

    def _slope(self, u: Floats) -> Floats:
        return np.asarray(self._curves[1](u))

    def _measured(self, start: Floats, end: Floats) -> Floats:
        """Lengths from ``start`` to ``end`` (n,), both within one piece, m."""
        half, middle = 0.5 * (end - start), 0.5 * (start + end)
        slope = self._slope(middle[:, None] + half[:, None] * _X)
        return np.asarray(half * (np.hypot(slope[..., 0], slope[..., 1]) @ _W))

    @cached_property
    def joints(self) -> Floats:
        return np.concatenate([[0.0], np.cumsum(self._measured(self._chords[:-1], self._chords[1:]))])

    @cached_property
    def length(self) -> float:
        return float(self.joints[-1])

    def _places(self, s: Floats) -> Floats:
        """The spline's parameter at lengths (n,), by Newton's method within each piece."""
        piece = np.clip(np.searchsorted(self.joints, s, side="right") - 1, 0, len(self.joints) - 2)
        low, high = self._chords[piece], self._chords[piece + 1]
        asked = s - self.joints[piece]
        u = low + (high - low) * asked / (self.joints[piece + 1] - self.joints[piece])
        for _ in range(_STEPS):
            step = (self._measured(low, u) - asked) / np.hypot(*self._slope(u).T)
            u = np.clip(u - step, low, high)
            if np.abs(step).max(initial=0.0) <= 1e-14 * self._chords[-1]:
                break
        return u

    def at(self, s: Floats) -> tuple[Floats, Floats, Floats]:
        u = self._places(s)
        place, slope, bend = (np.asarray(curve(u)) for curve in self._curves)
        pace = np.hypot(slope[:, 0], slope[:, 1])[:, None]
        way = slope / pace
        along = (bend * way).sum(axis=1, keepdims=True)
        return place, way, (bend - along * way) / pace**2


@dataclass(frozen=True)
class Route:
    """Pieces one after the other; ``closed`` where the end is the start."""

    pieces: tuple[Stretch, ...]

    @cached_property
    def edges(self) -> Floats:
        """Lengths at which pieces meet, from 0 to the length of all, m."""
        return np.concatenate([[0.0], np.cumsum([each.length for each in self.pieces])])

    @property
    def length(self) -> float:
        """In m."""
        return float(self.edges[-1])

    @cached_property
    def closed(self) -> bool:
        """Whether it ends where it begins."""
        first, last = self._at_ends[0][0][0].tolist(), self._at_ends[-1][0][1].tolist()
        return same((first[0], first[1]), (last[0], last[1]), self.length)

    @cached_property
    def _at_ends(self) -> list[tuple[Floats, Floats, Floats]]:
        """Of every piece place, direction and curvature at both ends."""
        return [each.at(np.array([0.0, each.length])) for each in self.pieces]

    @cached_property
    def joints(self) -> Floats:
        """Lengths at which curvature or its derivatives may jump, in order, m; of a closed path 0 among them."""
        inner = [start + each.joints for start, each in zip(self.edges[:-1], self.pieces, strict=True)]
        found = np.unique(np.concatenate([self.edges, *inner]))
        found = found[np.diff(found, prepend=-np.inf) > SAME * self.length]
        return found[:-1] if self.closed else found[1:-1]

    @cached_property
    def corners(self) -> list[tuple[float, Vec]]:
        """Lengths and places of corners, at which the direction jumps, m; of a closed path perhaps one at 0."""
        ends = self._at_ends
        meeting = list(zip(self.edges[1:-1].tolist(), itertools.pairwise(ends), strict=True))
        if self.closed:
            meeting.append((0.0, (ends[-1], ends[0])))
        found = []
        for at, (before, after) in meeting:
            (a, b), place = (before[1][1], after[1][0]), after[0][0]
            if abs(math.atan2(a[0] * b[1] - a[1] * b[0], a @ b)) > STRAIGHT:
                found.append((at, (float(place[0]), float(place[1]))))
        return sorted(found)

    def at(self, s: Floats) -> tuple[Floats, Floats, Floats]:
        """Place, direction and curvature vector (1/m), (n, 2) each, at lengths s (n,), m; a closed path goes round,
        of an open one beyond the ends those of the ends."""
        s = np.mod(s, self.length) if self.closed else np.clip(s, 0.0, self.length)
        piece = np.clip(np.searchsorted(self.edges, s, side="right") - 1, 0, len(self.pieces) - 1)
        found = [np.empty((len(s), 2)) for _ in range(3)]
        for k in np.unique(piece):
            own = piece == k
            for row, values in zip(found, self.pieces[k].at(s[own] - self.edges[k]), strict=True):
                row[own] = values
        return found[0], found[1], found[2]


def same(a: Vec, b: Vec, size: float) -> bool:
    """Whether two places are one on a path of a size, m."""
    return math.dist(a, b) <= 1e-9 * size


def route(start: Vec, pieces: Sequence[Vec | tuple[Vec, float]], smooth: bool = False) -> Route:
    """The path from a point to points, or by arcs (centre, turn in rad) between them; ``smooth``: one curve through
    all points."""
    if smooth:
        return Route((Smooth((start, *(each for each in pieces if not isinstance(each[0], tuple)))),))
    found, here = list[Stretch](), start
    for each in pieces:
        if isinstance(each[0], tuple):
            arc = Arc(here, each[0], float(each[1]))
            found.append(arc)
            here = arc.end
        else:
            found.append(Straight(here, each))
            here = each
    return Route(tuple(found))
