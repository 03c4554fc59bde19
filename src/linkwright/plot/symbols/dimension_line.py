"""Dimension lines and arcs."""

from __future__ import annotations

import math

import numpy as np

from linkwright.plot.svg.element import Element, Floats, path
from linkwright.plot.symbols.base import EMPTY, SYMBOLS, Shape, Vec, placed, points
from linkwright.plot.symbols.input_arrow import head


@SYMBOLS.register("dimension_line")
def dimension_line(
    *,
    start: Vec = (0.0, 0.0),
    end: Vec = (80.0, 0.0),
    offset: float = 26.0,
    rises: tuple[float, float] = (0.0, 0.0),
) -> Shape:
    """A line with two heads beside the distance from ``start`` to ``end``, with extension lines.

    ``offset``: to the right of the way from start to end on the paper, negative: to the left. ``rises``: how far
    to the right of start and end the places lie from which the extension lines come.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    if length < 1.0:
        return EMPTY
    along = (dx / length, dy / length)
    over = offset + math.copysign(5.0, offset)
    line = placed([(0, offset), (length, offset)], start, along)
    first, last = ((float(x), float(y)) for x, y in line)
    inside = length > 24.0
    back = (-along[0], -along[1])
    stroke = line if inside else placed([(-16, offset), (length + 16, offset)], start, along)
    extensions = tuple(
        placed([(x, rise + math.copysign(7.0, offset - rise)), (x, over)], start, along)
        for x, rise in zip((0.0, length), rises, strict=True)
    )
    elements = (
        path(stroke, "lw-dimension"),
        *(path(line, "lw-dimension") for line in extensions),
        head(first, back if inside else along, 8.0, "lw-dimension-head"),
        head(last, along if inside else back, 8.0, "lw-dimension-head"),
    )
    return Shape(elements, (points(stroke), *extensions))


@SYMBOLS.register("dimension_arc")
def dimension_arc(
    *, at: Vec = (0.0, 0.0), radius: float = 34.0, first: float = 0.0, sweep: float = -1.0
) -> Shape:
    """An arc with two heads for an angle at a place, from the direction ``first`` on (rad, clockwise on paper)."""
    angle = first + sweep * np.linspace(0.0, 1.0, 25)
    arc = np.stack([at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)], axis=1)
    sides = tuple(
        placed([(0.3 * radius, 0.0), (radius + 5.0, 0.0)], at, (math.cos(each), math.sin(each)))
        for each in (first, first + sweep)
    )
    heads: tuple[Element, ...] = ()
    if abs(sweep) * radius > 24.0:
        chords = [(arc[0], arc[0] - arc[4]), (arc[-1], arc[-1] - arc[-5])]
        heads = tuple(
            head((float(tip[0]), float(tip[1])), _unit(way), 8.0, "lw-dimension-head") for tip, way in chords
        )
    lines = (arc, *sides)
    return Shape((*(path(line, "lw-dimension") for line in lines), *heads), lines)


def _unit(way: Floats) -> Vec:
    length = float(np.hypot(*way))
    return float(way[0]) / length, float(way[1]) / length
