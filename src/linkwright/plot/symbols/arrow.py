"""Arrows of vectors and moments."""

from __future__ import annotations

import math

from linkwright.plot.svg.element import Floats, path
from linkwright.plot.symbols.base import EMPTY, SYMBOLS, Shape, Vec, placed, points
from linkwright.plot.symbols.input_arrow import crank_arrow

HEAD = 9.0


def arrow_points(start: Vec, end: Vec) -> tuple[Floats, Floats]:
    """Shaft (2, 2) and head (3, 2) of an arrow; the head shrinks with a short arrow."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    along = (dx / length, dy / length) if length else (1.0, 0.0)
    size = min(HEAD, 0.6 * length)
    neck = (end[0] - 0.8 * size * along[0], end[1] - 0.8 * size * along[1])
    tip = placed([(0, 0), (-size, -0.36 * size), (-size, 0.36 * size)], end, along)
    return points([start, neck]), tip


@SYMBOLS.register("arrow")
def arrow(*, start: Vec = (0.0, 0.0), end: Vec = (50.0, -20.0), style: str = "lw-force") -> Shape:
    """A vector from ``start`` to ``end``; nothing where both are the same."""
    if math.hypot(end[0] - start[0], end[1] - start[1]) < 0.8:
        return EMPTY
    shaft, tip = arrow_points(start, end)
    elements = (path(shaft, f"{style}-line"), path(tip, f"{style}-head", closed=True))
    return Shape(elements, (points([start, end]), tip))


@SYMBOLS.register("moment")
def moment(*, at: Vec = (0.0, 0.0), turning: int = 1, radius: float = 16.0, style: str = "lw-force") -> Shape:
    """A bent arrow about a point; ``turning`` +1: counter-clockwise."""
    return crank_arrow(at=at, radius=radius, middle=-math.pi / 2, sweep=4.4, turning=turning, style=style)
