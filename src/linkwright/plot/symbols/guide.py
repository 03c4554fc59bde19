"""Guides: hatched ground under a block, and a rod of a moving link."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, hatching, placed
from linkwright.plot.symbols.slider import HEIGHT


@SYMBOLS.register("ground_guide")
def ground_guide(
    *,
    at: Vec = (0.0, 0.0),
    along: Vec = (1.0, 0.0),
    start: float = -30.0,
    end: float = 30.0,
    side: int = 1,
    height: float = HEIGHT,
) -> Shape:
    """A hatched surface that the block slides on, from ``start`` to ``end`` of the line through ``at``.

    ``side`` +1: the ground is to the right of ``along`` on the paper.
    """
    y = side * (height / 2 + 1.3)
    rail = placed([(start, y), (end, y)], at, along)
    first, last = ((float(x), float(z)) for x, z in rail)
    strokes = hatching(first, last, side)
    under = placed([(start, y + 7 * side), (end, y + 7 * side)], at, along)
    middle = placed([(start, y + 3.5 * side), (end, y + 3.5 * side)], at, along)
    elements = (path(rail, "lw-ground"), *(path(stroke, "lw-hatch") for stroke in strokes))
    return Shape(elements, (rail, middle, under))


@SYMBOLS.register("moving_guide")
def moving_guide(
    *, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), start: float = -30.0, end: float = 30.0
) -> Shape:
    """The rod of a moving link on which a block slides."""
    rod = placed([(start, 0), (end, 0)], at, along)
    return Shape((path(rod, "lw-bar"),), (rod,))
