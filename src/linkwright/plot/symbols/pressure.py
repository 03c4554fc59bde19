"""Pressure on a piston."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.arrow import arrow_points
from linkwright.plot.symbols.base import SYMBOLS, Shape, Vec, placed


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
        elements += [path(shaft, f"{style}-thin"), path(tip, f"{style}-head", closed=True)]
        ink += [shaft, tip]
    back = placed([(-length, -0.5 * height), (-length, 0.5 * height)], at, along)
    return Shape((*elements, path(back, f"{style}-thin")), (*ink, back))
