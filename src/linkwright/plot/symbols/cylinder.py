"""A hydraulic or pneumatic cylinder: the barrel on one link, rod and piston on the other."""

from __future__ import annotations

from linkwright.plot.svg.element import path
from linkwright.plot.symbols.base import PIN, SYMBOLS, Shape, Vec, joined, placed


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
