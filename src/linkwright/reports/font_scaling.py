"""Drawings whose letters can be read where they are printed."""

from __future__ import annotations

from collections.abc import Callable

from linkwright.pictures.svg import natural_size
from linkwright.plotting.drawing.machine import DIAGONAL
from linkwright.plotting.drawing.scene import LINK_SIZE
from linkwright.reports.typst_pages import TEXT

#: A point of printers, mm.
POINT = 25.4 / 72
#: Letters of link names that are large enough, and those aimed at else, points: margins do not shrink with the
#: machine; the smallest diagonal.
ENOUGH, AIM, SMALLEST = 6.5, 7.2, 260.0


def font_scaling(drawn: Callable[[float], str], share: float, tallest: float) -> str:
    """A drawing for a share of the page's width and a height, mm: smaller where its letters would be too small.

    ``drawn`` gives its SVG text for a diagonal of the machine.
    """
    svg = drawn(DIAGONAL)
    size = printed_letters(svg, share, tallest)
    return svg if size >= ENOUGH else drawn(max(DIAGONAL * size / AIM, SMALLEST))


def printed_letters(svg: str, share: float, tallest: float) -> float:
    """Size of the letters of link names where a drawing is printed, points."""
    wide, high = natural_size(svg)
    return LINK_SIZE * min(share * TEXT / wide, tallest / high) / POINT
