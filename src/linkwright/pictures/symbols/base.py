"""What all symbols have in common, and their registry.

A symbol is a function with keyword arguments that gives a :class:`Shape` in the units of the paper: x to the
right, y down, one unit a pixel at natural size. Directions are unit vectors on the paper.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.pictures.picture import Inked, Vec
from linkwright.registry import Registry
from linkwright.words import _

PIN = 5.0
LINE = 2.6
#: Distance and depth of the strokes of a hatching.
HATCH = (6.0, 7.0)


@dataclass(frozen=True)
class Shape:
    """Lines and circles of a symbol; the polylines (k, 2) along which it has ink, for keeping labels clear of it."""

    elements: tuple[Inked, ...]
    ink: tuple[Floats, ...] = ()

    def __add__(self, other: Shape) -> Shape:
        return Shape(self.elements + other.elements, self.ink + other.ink)


EMPTY = Shape(())
Symbol = Callable[..., Shape]
SYMBOLS: Registry[Symbol] = Registry(_("symbol"), "linkwright.pictures.symbols")


def joined(shapes: Iterable[Shape]) -> Shape:
    """Several shapes as one."""
    return sum(shapes, EMPTY)


def points(rows: ArrayLike) -> Floats:
    """Points as an array (k, 2)."""
    return np.asarray(rows, dtype=float).reshape(-1, 2)


def placed(local: ArrayLike, at: Vec, along: Vec) -> Floats:
    """Points given in axes with x along ``along`` and y to its right (paper), as points of the paper."""
    p = points(local)
    c, s = along
    return np.stack([at[0] + c * p[:, 0] - s * p[:, 1], at[1] + s * p[:, 0] + c * p[:, 1]], axis=1)


def around(at: Vec, radius: float | Floats, angle: Floats) -> Floats:
    """Points (k, 2) about a place, at angles (k,) clockwise on the paper, rad."""
    return np.stack([at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)], axis=1)


def ring(at: Vec, radius: float, count: int = 12) -> Floats:
    """A closed circle of points."""
    return around(at, radius, np.linspace(0.0, 2 * np.pi, count + 1))


def way(start: Vec | Floats, end: Vec | Floats) -> tuple[float, Vec]:
    """Length and direction from one place to another; to the right where both are the same."""
    dx, dy = float(end[0] - start[0]), float(end[1] - start[1])
    length = math.hypot(dx, dy)
    return length, (dx / length, dy / length) if length else (1.0, 0.0)


def vec(row: Floats) -> Vec:
    """A point (2,) as two numbers."""
    return float(row[0]), float(row[1])


def hatching(start: Vec, end: Vec, side: int) -> list[Floats]:
    """Short strokes on one side (+1: right of the way from start to end on the paper) of a line."""
    length, along = way(start, end)
    if length < 1e-9:
        return []
    count = max(2, round(length / HATCH[0]))
    marks = (np.arange(count) + 0.75) * length / count
    return [placed([(x, 0.0), (x - 0.75 * HATCH[1], side * HATCH[1])], start, along) for x in marks]
