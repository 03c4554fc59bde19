"""The weld: a filled triangle in the corner between two links, or on the wall."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, hatching, placed, points


@SYMBOLS.register("weld")
def weld(
    *, at: Vec = (0.0, 0.0), first: Vec = (1.0, 0.0), second: Vec = (0.0, 1.0), size: float = 13.0
) -> Shape:
    """A filled triangle between the directions ``first`` and ``second`` of two bars; a square where they align."""
    cross = first[0] * second[1] - first[1] * second[0]
    if abs(cross) < 0.17:
        a = 0.45 * size
        corners = placed([(-a, -a), (a, -a), (a, a), (-a, a)], at, first)
    else:
        corners = points([at, *((at[0] + size * x, at[1] + size * y) for x, y in (first, second))])
    return Shape((path(corners, "lw-weld", closed=True),), (corners,))


@SYMBOLS.register("wall")
def wall(*, at: Vec = (0.0, 0.0), toward: Vec = (0.0, 1.0), size: float = 18.0) -> Shape:
    """Hatched ground to which a link is welded; it lies in the direction ``toward``."""
    line = placed([(0, size), (0, -size)], at, toward)
    a, b = ((float(x), float(y)) for x, y in line)
    strokes = hatching(a, b, 1)
    ink = placed([(0, size), (0, -size), (7, -size), (7, size)], at, toward)
    return Shape((path(line, "lw-ground"), *(path(stroke, "lw-hatch") for stroke in strokes)), (ink,))
