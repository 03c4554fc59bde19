"""The fixed pivot: a triangle standing on hatched ground."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, hatching, placed


@SYMBOLS.register("fixed_pivot")
def fixed_pivot(*, at: Vec = (0.0, 0.0), toward: Vec = (0.0, 1.0), size: float = 18.0) -> Shape:
    """Triangle from the pin to the ground, which lies in the direction ``toward``."""
    half, base = 0.62 * size, 0.9 * size
    triangle = placed([(0, 0), (size, -half), (size, half)], at, toward)
    ground = placed([(size, base), (size, -base)], at, toward)
    first, last = ((float(x), float(y)) for x, y in ground)
    elements = (
        path(triangle, "lw-support", closed=True),
        path(ground, "lw-ground"),
        *(path(stroke, "lw-hatch") for stroke in hatching(first, last, 1)),
    )
    outline = placed([(0, 0), (size, -half), (size, -base), (size + 7, -base), (size + 7, base), (size, base),
                      (size, half), (0, 0)], at, toward)  # fmt: skip
    middle = placed([(0, 0), (size + 4, 0), (size + 4, -base), (size + 4, base)], at, toward)
    return Shape(elements, (outline, middle))
