"""Dimension lines."""

from __future__ import annotations

import math

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import EMPTY, SYMBOLS, Shape, Vec, placed, points
from linkwright.plot.symbols.input_arrow import head


@SYMBOLS.register("dimension_line")
def dimension_line(*, start: Vec = (0.0, 0.0), end: Vec = (80.0, 0.0), offset: float = 26.0) -> Shape:
    """A line with two heads beside the distance from ``start`` to ``end``, with extension lines.

    ``offset``: to the right of the way from start to end on the paper, negative: to the left.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    if length < 1.0:
        return EMPTY
    along = (dx / length, dy / length)
    over = offset + math.copysign(5.0, offset)
    gap = math.copysign(7.0, offset)
    line = placed([(0, offset), (length, offset)], start, along)
    first, last = ((float(x), float(y)) for x, y in line)
    inside = length > 24.0
    back = (-along[0], -along[1])
    stroke = line if inside else placed([(-16, offset), (length + 16, offset)], start, along)
    extensions = tuple(placed([(x, gap), (x, over)], start, along) for x in (0.0, length))
    elements = (
        path(stroke, "lw-dimension"),
        *(path(line, "lw-dimension") for line in extensions),
        head(first, back if inside else along, 8.0, "lw-dimension-head"),
        head(last, along if inside else back, 8.0, "lw-dimension-head"),
    )
    return Shape(elements, (points(stroke), *extensions))
