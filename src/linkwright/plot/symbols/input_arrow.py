"""Arrows that show what is driven, and which way."""

from __future__ import annotations

import math

import numpy as np

from linkwright.plot.svg.element import Element, Floats, path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, placed, points


def head(tip: Vec, along: Vec, size: float, style: str) -> Element:
    """A filled arrowhead with its point at ``tip``."""
    return path(placed([(0, 0), (-size, -0.38 * size), (-size, 0.38 * size)], tip, along), style, closed=True)


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
    ``turning`` +1: counter-clockwise as seen, -1: clockwise, 0: both ways.
    """
    forward = -1.0 if turning >= 0 else 1.0
    angle = middle + forward * np.linspace(-sweep / 2, sweep / 2, 49)
    arc = np.stack([at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)], axis=1)
    size = 9.0
    back = max(1, round(size * (len(arc) - 1) / (abs(sweep) * radius)))
    elements: list[Element] = [path(_shortened(arc, size, both=turning == 0), f"{style}-line")]
    elements.append(head(_place(arc[-1]), _chord(arc[-1 - back], arc[-1]), size, f"{style}-head"))
    if turning == 0:
        elements.append(head(_place(arc[0]), _chord(arc[back], arc[0]), size, f"{style}-head"))
    return Shape(tuple(elements), (arc,))


@SYMBOLS.register("slide_arrow")
def slide_arrow(
    *,
    at: Vec = (0.0, 0.0),
    along: Vec = (1.0, 0.0),
    length: float = 34.0,
    both: bool = True,
    style: str = "lw-input",
) -> Shape:
    """A straight arrow: the direction in which a block is driven; ``both`` for a motion to and fro."""
    a = length / 2
    line = placed([(-a, 0), (a, 0)], at, along)
    stroke = placed([(-a + (5 if both else 0), 0), (a - 5, 0)], at, along)
    elements = [path(stroke, f"{style}-line"), head(_place(line[1]), along, 9.0, f"{style}-head")]
    if both:
        elements.append(head(_place(line[0]), (-along[0], -along[1]), 9.0, f"{style}-head"))
    return Shape(tuple(elements), (line,))


def _shortened(arc: Floats, head: float, *, both: bool) -> Floats:
    """An arc that ends within its heads."""
    step = float(np.hypot(*(arc[1] - arc[0])))
    count = max(1, round(0.7 * head / step))
    return points(arc[count if both else 0 : -count])


def _place(row: Floats) -> Vec:
    return float(row[0]), float(row[1])


def _chord(a: Floats, b: Floats) -> Vec:
    dx, dy = float(b[0] - a[0]), float(b[1] - a[1])
    length = math.hypot(dx, dy)
    return dx / length, dy / length
