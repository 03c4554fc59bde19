"""The legend: one arrow of a round value for every kind of vector."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.plot.drawing.picture import Box
from linkwright.plot.drawing.vectors import Vectors, round_length, with_unit
from linkwright.plot.svg.element import Element, Floats
from linkwright.plot.svg.text import text_element, width
from linkwright.plot.symbols.base import SYMBOLS, points
from linkwright.words import say

SIZE, ROW = 12.0, 19.0


def legend(
    families: Sequence[tuple[Vectors, float]], box: Box, language: str
) -> tuple[list[Element], list[Floats]]:
    """Rows below the drawing, and their extent."""
    elements: list[Element] = []
    extent: list[Floats] = []
    left, y = box[0], box[3] + 12.0
    for family, scale in families:
        if scale <= 0:
            continue
        y += ROW
        value = round_length(scale)
        end = left + value * scale
        arrow = SYMBOLS["arrow"](start=(left, y), end=(end, y), style=family.style)
        text = f"{with_unit(value, family.unit)}  {say(f'drawing.{family.kind}', language)}"
        elements += [*arrow.elements, text_element(end + 8.0, y + 0.35 * SIZE, text, "lw-legend", SIZE)]
        extent.append(points([(left, y - SIZE), (end + 8.0 + width(text, SIZE), y + 0.5 * SIZE)]))
    return elements, extent
