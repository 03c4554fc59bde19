"""What all symbols have in common, and their registry.

A symbol is a function with keyword arguments that gives a :class:`Shape` in the units of the paper: x to the
right, y down, one unit a pixel at natural size. Directions are unit vectors on the paper.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.plot.svg.element import Element
from linkwright.registry import Registry

Vec = tuple[float, float]
PIN = 5.0
LINE = 2.6


@dataclass(frozen=True)
class Shape:
    """Elements of a symbol and, for keeping labels clear of it, the polylines (k, 2) along which it has ink."""

    elements: tuple[Element, ...]
    ink: tuple[Floats, ...] = ()

    def __add__(self, other: Shape) -> Shape:
        return Shape(self.elements + other.elements, self.ink + other.ink)


EMPTY = Shape(())
Symbol = Callable[..., Shape]
SYMBOLS: Registry[Symbol] = Registry("symbol", "linkwright.plot.symbols")


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


def ring(at: Vec, radius: float, count: int = 12) -> Floats:
    """A closed circle of points."""
    angle = np.linspace(0.0, 2 * np.pi, count + 1)
    return np.stack([at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)], axis=1)


def vec(row: Floats) -> Vec:
    """A point (2,) as two numbers."""
    return float(row[0]), float(row[1])


def hatching(start: Vec, end: Vec, side: int, *, step: float = 6.0, depth: float = 7.0) -> list[Floats]:
    """Short strokes on one side (+1: right of the way from start to end on the paper) of a line."""
    length = float(np.hypot(end[0] - start[0], end[1] - start[1]))
    if length < 1e-9:
        return []
    along = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
    count = max(2, round(length / step))
    marks = (np.arange(count) + 0.75) * length / count
    return [placed([(x, 0.0), (x - 0.75 * depth, side * depth)], start, along) for x in marks]
