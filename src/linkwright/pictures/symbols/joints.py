"""Pins, plain points, supports, welds, guides, blocks and cylinders, and the mass centre."""

from __future__ import annotations

import numpy as np

from linkwright.pictures.picture import Circle, Line, Vec
from linkwright.pictures.symbols.base import PIN, SYMBOLS, Shape, around, hatching, joined, placed, points, ring


@SYMBOLS.register("pin")
def pin(*, at: Vec = (0.0, 0.0), radius: float = PIN) -> Shape:
    """A small open circle."""
    return Shape((Circle(at, radius, "lw-pin"),), (ring(at, radius),))


@SYMBOLS.register("point")
def point(*, at: Vec = (0.0, 0.0), radius: float = 0.55 * PIN) -> Shape:
    """A dot: a named point that is no joint."""
    return Shape((Circle(at, radius, "lw-point"),), (ring(at, radius, 8),))


@SYMBOLS.register("fixed_pivot")
def fixed_pivot(*, at: Vec = (0.0, 0.0), toward: Vec = (0.0, 1.0), size: float = 18.0) -> Shape:
    """Triangle from the pin to the ground, which lies in the direction ``toward``."""
    half, base = 0.62 * size, 0.9 * size
    triangle = placed([(0, 0), (size, -half), (size, half)], at, toward)
    ground = placed([(size, base), (size, -base)], at, toward)
    first, last = ((float(x), float(y)) for x, y in ground)
    elements = (
        Line(triangle, "lw-support", closed=True),
        Line(ground, "lw-ground"),
        *(Line(stroke, "lw-hatch") for stroke in hatching(first, last, 1)),
    )
    outline = placed(
        [
            (0, 0),
            (size, -half),
            (size, -base),
            (size + 7, -base),
            (size + 7, base),
            (size, base),
            (size, half),
            (0, 0),
        ],
        at,
        toward,
    )
    middle = placed([(0, 0), (size + 4, 0), (size + 4, -base), (size + 4, base)], at, toward)
    return Shape(elements, (outline, middle))


@SYMBOLS.register("weld")
def weld(*, at: Vec = (0.0, 0.0), first: Vec = (1.0, 0.0), second: Vec = (0.0, 1.0), size: float = 13.0) -> Shape:
    """A filled triangle between the directions ``first`` and ``second`` of two bars; a square where they align."""
    cross = first[0] * second[1] - first[1] * second[0]
    if abs(cross) < 0.17:
        a = 0.45 * size
        corners = placed([(-a, -a), (a, -a), (a, a), (-a, a)], at, first)
    else:
        corners = points([at, *((at[0] + size * x, at[1] + size * y) for x, y in (first, second))])
    return Shape((Line(corners, "lw-weld", closed=True),), (corners,))


@SYMBOLS.register("wall")
def wall(*, at: Vec = (0.0, 0.0), toward: Vec = (0.0, 1.0), size: float = 18.0) -> Shape:
    """Hatched ground to which a link is welded; it lies in the direction ``toward``."""
    line = placed([(0, size), (0, -size)], at, toward)
    a, b = ((float(x), float(y)) for x, y in line)
    strokes = hatching(a, b, 1)
    ink = placed([(0, size), (0, -size), (7, -size), (7, size)], at, toward)
    return Shape((Line(line, "lw-ground"), *(Line(stroke, "lw-hatch") for stroke in strokes)), (ink,))


@SYMBOLS.register("mass_centre")
def mass_centre(*, at: Vec = (0.0, 0.0), radius: float = 6.0) -> Shape:
    """The symbol for the centre of mass."""
    quarters = [around(at, radius, np.linspace(first, first + 0.5 * np.pi, 13)) for first in (0.0, np.pi)]
    filled = (Line(np.vstack([points([at]), arc]), "lw-mass", closed=True) for arc in quarters)
    return Shape((Circle(at, radius, "lw-mass-ring"), *filled), (ring(at, radius),))


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
    elements = (Line(rail, "lw-ground"), *(Line(stroke, "lw-hatch") for stroke in strokes))
    return Shape(elements, (rail, middle, under))


@SYMBOLS.register("moving_guide")
def moving_guide(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), start: float = -30.0, end: float = 30.0) -> Shape:
    """The rod of a moving link on which a block slides."""
    rod = placed([(start, 0), (end, 0)], at, along)
    return Shape((Line(rod, "lw-bar"),), (rod,))


@SYMBOLS.register("slider")
def slider(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = LENGTH, height: float = HEIGHT) -> Shape:
    """A block with its long side along the guide."""
    a, b = length / 2, height / 2
    corners = placed([(-a, -b), (a, -b), (a, b), (-a, b)], at, along)
    outline = placed([(-a, -b), (a, -b), (a, b), (-a, b), (-a, -b)], at, along)
    return Shape((Line(corners, "lw-block", closed=True),), (outline,))


@SYMBOLS.register("barrel")
def barrel(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 60.0, height: float = 15.0) -> Shape:
    """The barrel, hinged at ``at``."""
    a, b = 1.6 * PIN, height / 2
    box = placed([(a, -b), (length, -b), (length, b), (a, b)], at, along)
    stem = placed([(0, 0), (a, 0)], at, along)
    outline = placed([(a, -b), (length, -b), (length, b), (a, b), (a, -b)], at, along)
    return Shape((Line(stem, "lw-bar"), Line(box, "lw-block", closed=True)), (stem, outline))


@SYMBOLS.register("piston")
def piston(*, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 40.0, height: float = 15.0) -> Shape:
    """Rod and piston; the rod ends at ``at`` and reaches back ``length`` against ``along``."""
    rod = placed([(-length, 0), (0, 0)], at, along)
    head = placed([(-length, -0.36 * height), (-length, 0.36 * height)], at, along)
    return joined([Shape((Line(rod, "lw-bar"),), (rod,)), Shape((Line(head, "lw-bar"),))])
