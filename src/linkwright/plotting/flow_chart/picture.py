"""Pages of a flow chart as SVG text, to the size in which they are printed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from linkwright.pictures.drawing import document
from linkwright.pictures.picture import Circle, Line, SvgNode, Text, sentence_runs
from linkwright.pictures.svg.element import Element, element, fold
from linkwright.pictures.symbols.arrows import head
from linkwright.pictures.symbols.base import points, vec, way
from linkwright.plotting.flow_chart.content import Node
from linkwright.plotting.flow_chart.layout import BARS, LEAN, LINE, RADIUS, SIZE, Box, Page, laid_out

#: Printed width of a unit, mm: two columns fill the width of an A4 page's text, and letters have 8.5 points.
MILLIMETRE = 0.23
#: Height of a page's picture, mm, and columns on it.
TALLEST, COLUMNS = 205.0, 2


def flow_chart_pages(nodes: Sequence[Node], title: str, *, columns: int = COLUMNS, heading: str = "") -> list[str]:
    """SVG text of every page, to be printed in its own size; ``columns`` on a page, ``heading`` above."""
    sheets = laid_out(nodes, TALLEST / MILLIMETRE, columns)
    return [_document(sheet, title, heading) for sheet in sheets]


def _document(sheet: Page, title: str, heading: str) -> str:
    wide, tall = sheet.size
    left = min(float(line.corners[:, 0].min()) for line in sheet.lines)
    left = min(left, *(box.corners[0] for box in sheet.boxes), *(x - RADIUS for x, _, _ in sheet.circles), wide)
    content = [each for part in (_lines(sheet), _boxes(sheet), _marks(sheet)) for each in part]
    top = 0.0
    if heading:
        lines = fold(heading, wide - left, SIZE)
        top = -LINE * (len(lines) + 0.8)
        content += [
            Text((left, top + LINE * number + SIZE), sentence_runs(line), "lw-legend", SIZE)
            for number, line in enumerate(lines)
        ]
    return document(content, (left, top, wide, tall), title, None, millimetre=MILLIMETRE)


def _lines(sheet: Page) -> Iterator[SvgNode]:
    for line in sheet.lines:
        yield Line(line.corners, "lw-flow-line")
        if line.arrow:
            _, along = way(line.corners[-2], line.corners[-1])
            yield head(vec(line.corners[-1]), along, 9.0, "lw-flow-head")


def _boxes(sheet: Page) -> Iterator[SvgNode]:
    for box in sheet.boxes:
        yield from _outline(box)
        first = box.y - LINE * len(box.lines) / 2 + 0.5 * (LINE + 0.7 * SIZE)
        for number, text in enumerate(box.lines):
            style = "lw-legend lw-flow-call" if number < box.bold else "lw-legend"
            yield Text((box.x, first + LINE * number), sentence_runs(text), style, SIZE, "middle")


def _outline(box: Box) -> Iterator[SvgNode]:
    left, top, right, bottom = box.corners
    match box.shape:
        case "terminator":
            yield _rectangle(box, rx=box.half_height)
        case "data":
            lean = [(left + LEAN, top), (right, top), (right - LEAN, bottom), (left, bottom)]
            yield Line(points(lean), "lw-flow", closed=True)
        case "preparation":
            tip = min(LEAN, box.half_height)
            hexagon = [
                (left - tip + LEAN / 2, box.y),
                (left + LEAN / 2, top),
                (right - LEAN / 2, top),
                (right + tip - LEAN / 2, box.y),
                (right - LEAN / 2, bottom),
                (left + LEAN / 2, bottom),
            ]
            yield Line(points(hexagon), "lw-flow", closed=True)
        case "decision":
            yield Line(points([(left, box.y), (box.x, top), (right, box.y), (box.x, bottom)]), "lw-flow", closed=True)
        case _:
            yield _rectangle(box)
            if box.shape == "call":
                for x in (left + BARS, right - BARS):
                    yield Line(np.array([(x, top), (x, bottom)]), "lw-flow-line")


def _rectangle(box: Box, rx: float | None = None) -> Element:
    left, top, right, bottom = box.corners
    size = {"x": left, "y": top, "width": right - left, "height": bottom - top}
    return element("rect", {"class": "lw-flow", **size, "rx": rx})


def _marks(sheet: Page) -> Iterator[SvgNode]:
    for word in sheet.words:
        yield Text((word.x, word.y), sentence_runs(word.text), "lw-legend", SIZE)
    for x, y, letter in sheet.circles:
        yield Circle((x, y), RADIUS, "lw-flow")
        yield Text((x, y + 0.36 * SIZE), sentence_runs(letter), "lw-legend", SIZE, "middle")
