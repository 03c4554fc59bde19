"""Arrows: what is driven, vectors, moments, pressures; dimension lines and arcs."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.pictures.picture import Line, Vec
from linkwright.pictures.symbols.base import EMPTY, SYMBOLS, Shape, around, placed, points, vec, way

HEAD = 9.0
#: Lengths up to which dimensions have their heads outside, and how far their lines go on behind them there.
NARROW, BEHIND = 24.0, 16.0


def head(tip: Vec, along: Vec, size: float, style: str) -> Line:
    """A filled arrowhead with its point at ``tip``."""
    return Line(placed([(0, 0), (-size, -0.38 * size), (-size, 0.38 * size)], tip, along), style, closed=True)


@SYMBOLS.register("crank_arrow")
def crank_arrow(
    *,
    at: Vec = (0.0, 0.0),
    radius: float = 22.0,
    middle: float = -0.8,
    sweep: float = 1.9,
    turning: int = 1,
    style: str = "lw-input",
) -> Shape:
    """An arc about a pin with a head: the direction of rotation.

    ``middle``: angle of the arc's middle on the paper (rad, clockwise from the right, as y is down);
    ``turning`` +1: counter-clockwise on the paper, -1: clockwise, 0: both ways.
    """
    forward = -1.0 if turning >= 0 else 1.0
    angle = middle + forward * np.linspace(-sweep / 2, sweep / 2, 49)
    arc = around(at, radius, angle)
    size = HEAD
    back = max(1, round(size * (len(arc) - 1) / (abs(sweep) * radius)))
    elements: list[Line] = [Line(_shortened(arc, size, both=turning == 0), f"{style}-line")]
    elements.append(head(vec(arc[-1]), way(arc[-1 - back], arc[-1])[1], size, f"{style}-head"))
    if turning == 0:
        elements.append(head(vec(arc[0]), way(arc[back], arc[0])[1], size, f"{style}-head"))
    return Shape(tuple(elements), (arc,))


@SYMBOLS.register("slide_arrow")
def slide_arrow(
    *, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = 34.0, both: bool = True, style: str = "lw-input"
) -> Shape:
    """A straight arrow: the direction in which a block is driven; ``both`` for a motion to and fro."""
    a = length / 2
    line = placed([(-a, 0), (a, 0)], at, along)
    stroke = placed([(-a + (5 if both else 0), 0), (a - 5, 0)], at, along)
    elements = [Line(stroke, f"{style}-line"), head(vec(line[1]), along, 9.0, f"{style}-head")]
    if both:
        elements.append(head(vec(line[0]), (-along[0], -along[1]), 9.0, f"{style}-head"))
    return Shape(tuple(elements), (line,))


def _shortened(arc: Floats, head: float, *, both: bool) -> Floats:
    """An arc that ends within its heads."""
    step = float(np.hypot(*(arc[1] - arc[0])))
    count = max(1, round(0.7 * head / step))
    return points(arc[count if both else 0 : -count])


def arrow_points(start: Vec, end: Vec) -> tuple[Floats, Floats]:
    """Shaft (2, 2) and head (3, 2) of an arrow; the head shrinks with a short arrow."""
    length, along = way(start, end)
    size = min(HEAD, 0.6 * length)
    neck = (end[0] - 0.8 * size * along[0], end[1] - 0.8 * size * along[1])
    tip = placed([(0, 0), (-size, -0.36 * size), (-size, 0.36 * size)], end, along)
    return points([start, neck]), tip


@SYMBOLS.register("arrow")
def arrow(*, start: Vec = (0.0, 0.0), end: Vec = (50.0, -20.0), style: str = "lw-force") -> Shape:
    """A vector from ``start`` to ``end``; nothing where both are the same."""
    if math.dist(start, end) < 0.8:
        return EMPTY
    shaft, tip = arrow_points(start, end)
    elements = (Line(shaft, f"{style}-line"), Line(tip, f"{style}-head", closed=True))
    return Shape(elements, (points([start, end]), tip))


@SYMBOLS.register("moment")
def moment(*, at: Vec = (0.0, 0.0), turning: int = 1, radius: float = 16.0, style: str = "lw-force") -> Shape:
    """A bent arrow about a point; ``turning`` +1: counter-clockwise."""
    return crank_arrow(at=at, radius=radius, middle=-math.pi / 2, sweep=4.4, turning=turning, style=style)


@SYMBOLS.register("pressure")
def pressure(
    *,
    at: Vec = (0.0, 0.0),
    along: Vec = (1.0, 0.0),
    length: float = 24.0,
    height: float = 20.0,
    style: str = "lw-load",
) -> Shape:
    """Three arrows side by side whose points stand on the face at ``at`` and push it ``along``."""
    elements, ink = [], []
    for y in (-0.4 * height, 0.0, 0.4 * height):
        (x0, y0), (x1, y1) = placed([(-length, y), (0.0, y)], at, along).tolist()
        shaft, tip = arrow_points((x0, y0), (x1, y1))
        elements += [Line(shaft, f"{style}-thin"), Line(tip, f"{style}-head", closed=True)]
        ink += [shaft, tip]
    back = placed([(-length, -0.5 * height), (-length, 0.5 * height)], at, along)
    return Shape((*elements, Line(back, f"{style}-thin")), (*ink, back))


@SYMBOLS.register("dimension_line")
def dimension_line(
    *, start: Vec = (0.0, 0.0), end: Vec = (80.0, 0.0), offset: float = 26.0, rises: tuple[float, float] = (0.0, 0.0)
) -> Shape:
    """A line with two heads next to the distance from ``start`` to ``end``, with extension lines.

    ``offset``: to the right of the way from start to end on the paper, negative: to the left. ``rises``: how far
    to the right of start and end the places lie from which the extension lines come.
    """
    length, along = way(start, end)
    if length < 1.0:
        return EMPTY
    over = offset + math.copysign(5.0, offset)
    line = placed([(0, offset), (length, offset)], start, along)
    first, last = vec(line[0]), vec(line[1])
    inside = length > NARROW
    back = (-along[0], -along[1])
    stroke = line if inside else placed([(-BEHIND, offset), (length + BEHIND, offset)], start, along)
    extensions = tuple(
        placed([(x, rise + math.copysign(7.0, offset - rise)), (x, over)], start, along)
        for x, rise in zip((0.0, length), rises, strict=True)
    )
    elements = (
        Line(stroke, "lw-dimension"),
        *(Line(line, "lw-dimension") for line in extensions),
        head(first, back if inside else along, 8.0, "lw-dimension-head"),
        head(last, along if inside else back, 8.0, "lw-dimension-head"),
    )
    return Shape(elements, (points(stroke), *extensions))


@SYMBOLS.register("dimension_arc")
def dimension_arc(*, at: Vec = (0.0, 0.0), radius: float = 34.0, first: float = 0.0, sweep: float = -1.0) -> Shape:
    """An arc with two heads for an angle at a place, from the direction ``first`` on (rad, clockwise on paper)."""
    angle = first + sweep * np.linspace(0.0, 1.0, 25)
    arc = around(at, radius, angle)
    sides = tuple(
        placed([(0.3 * radius, 0.0), (radius + 5.0, 0.0)], at, (math.cos(each), math.sin(each)))
        for each in (first, first + sweep)
    )
    heads: tuple[Line, ...] = ()
    if abs(sweep) * radius > 24.0:
        chords = [(arc[4], arc[0]), (arc[-5], arc[-1])]
        heads = tuple(head(vec(tip), way(back, tip)[1], 8.0, "lw-dimension-head") for back, tip in chords)
    lines = (arc, *sides)
    return Shape((*(Line(line, "lw-dimension") for line in lines), *heads), lines)
