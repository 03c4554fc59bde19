"""The slider's block."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, placed

LENGTH, HEIGHT = 30.0, 18.0


@SYMBOLS.register("slider")
def slider(
    *, at: Vec = (0.0, 0.0), along: Vec = (1.0, 0.0), length: float = LENGTH, height: float = HEIGHT
) -> Shape:
    """A block with its long side along the guide."""
    a, b = length / 2, height / 2
    corners = placed([(-a, -b), (a, -b), (a, b), (-a, b)], at, along)
    outline = placed([(-a, -b), (a, -b), (a, b), (-a, b), (-a, -b)], at, along)
    return Shape((path(corners, "lw-block", closed=True),), (outline,))
