"""Guides, blocks and cylinders."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import PIN, SYMBOLS, Shape, Vec, hatching, joined, placed

LENGTH, HEIGHT = 30.0, 18.0


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


@SYMBOLS.register("slider")
def slider(
    *, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = LENGTH, height: float = HEIGHT
) -> Shape:
    """A block with its long side along the guide."""
    a, b = length / 2, height / 2
    corners = placed([(-a, -b), (a, -b), (a, b), (-a, b)], at, along)
    outline = placed([(-a, -b), (a, -b), (a, b), (-a, b), (-a, -b)], at, along)
    return Shape((path(corners, "lw-block", closed=True),), (outline,))


@SYMBOLS.register("barrel")
def barrel(
    *, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 60.0, height: float = 15.0
) -> Shape:
    """The barrel, hinged at ``at``."""
    a, b = 1.6 * PIN, height / 2
    box = placed([(a, -b), (length, -b), (length, b), (a, b)], at, along)
    stem = placed([(0, 0), (a, 0)], at, along)
    outline = placed([(a, -b), (length, -b), (length, b), (a, b), (a, -b)], at, along)
    return Shape((path(stem, "lw-bar"), path(box, "lw-block", closed=True)), (stem, outline))


@SYMBOLS.register("piston")
def piston(
    *, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 40.0, height: float = 15.0
) -> Shape:
    """Rod and piston; the rod ends at ``at`` and reaches back ``length`` against ``along``."""
    rod = placed([(-length, 0), (0, 0)], at, along)
    head = placed([(-length, -0.36 * height), (-length, 0.36 * height)], at, along)
    return joined([Shape((path(rod, "lw-bar"),), (rod,)), Shape((path(head, "lw-bar"),))])
