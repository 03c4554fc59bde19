"""A load of a kind that has no symbol of its own."""

from __future__ import annotations

import numpy as np

from linkwright.plot.svg.element import circle, element, path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, points, ring

SIZE = 7.0


@SYMBOLS.register("general_load")
def general_load(*, at: Vec = (0.0, 0.0), ends: tuple[Vec, ...] = ()) -> Shape:
    """A crossed ring; with two ``ends`` halfway on a dashed line between them, else at ``at``."""
    line = points(ends)
    middle = points([at])[0] if len(ends) < 2 else line.mean(axis=0)
    x, y = float(middle[0]), float(middle[1])
    a = SIZE / np.sqrt(2.0)
    crossed = points([(x - a, y - a), (x + a, y + a), (np.nan, np.nan), (x - a, y + a), (x + a, y - a)])
    shape = Shape(
        (circle((x, y), SIZE, "lw-load-ring"), path(crossed, "lw-load-thin")), (ring((x, y), SIZE),)
    )
    if len(ends) < 2:
        return shape
    dashes = element("g", {"stroke-dasharray": "6 4"}, path(line, "lw-load-thin"))
    return Shape((dashes,), (line,)) + shape
