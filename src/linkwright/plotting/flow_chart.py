"""The flow chart of a solution: symbols in columns, the lines between them, and its pages as SVG text.

Units are those of the paper; symbols after ISO 5807 (GB/T 1526).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.pictures.drawing import document
from linkwright.pictures.picture import Circle, Line, SvgNode, Text, sentence_runs
from linkwright.pictures.svg import Element, element, fold, width
from linkwright.pictures.symbols.arrows import head
from linkwright.pictures.symbols.base import points, vec, way
from linkwright.plotting.solution_steps import Node, Shape

#: Height of letters and of lines, widest text of a symbol, of a decision, of a side note.
SIZE, LINE, WIDEST, NARROWER, ASIDE = 13.0, 17.0, 190.0, 100.0, 84.0
#: Space inside symbols, between them, and around a connector's circle.
PAD, GAP, RADIUS = 9.0, 26.0, 10.0
#: How far the sides of data lean, and the bars of a call stand off its sides.
LEAN, BARS = 14.0, 7.0
#: From the middle of a column: its edges, the lanes of the jumps back (innermost first) and of the jump forward.
LEFT, RIGHT, BACK, FORWARD = -154.0, 206.0, (-124.0, -136.0, -148.0), 146.0
#: Distance of columns.
SPACING = 14.0


@dataclass(frozen=True)
class Box:
    """A symbol at its place: middle and half sizes; its lines of text, the first ``bold`` ones the call's name."""

    shape: Shape
    x: float
    y: float
    half_width: float
    half_height: float
    lines: tuple[str, ...]
    bold: int = 0

    @property
    def top(self) -> float:
        """Its upper edge."""
        return self.y - self.half_height

    @property
    def bottom(self) -> float:
        """Its lower edge."""
        return self.y + self.half_height

    @property
    def corners(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom."""
        return self.x - self.half_width, self.top, self.x + self.half_width, self.bottom


@dataclass(frozen=True)
class FlowLine:
    """A line through corners (k, 2); ``arrow``: whether it has a head at its end."""

    corners: Floats
    arrow: bool = True


@dataclass(frozen=True)
class Word:
    """A word at an exit: its place on the baseline."""

    text: str
    x: float
    y: float


@dataclass
class Page:
    """The content of a page: symbols, lines, words, connectors with their letters."""

    boxes: list[Box] = field(default_factory=list)
    lines: list[FlowLine] = field(default_factory=list)
    words: list[Word] = field(default_factory=list)
    circles: list[tuple[float, float, str]] = field(default_factory=list)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height from the upper left corner on."""
        rights = [box.corners[2] for box in self.boxes] + [x + RADIUS for x, _, _ in self.circles]
        lows = [box.bottom for box in self.boxes] + [y + RADIUS for _, y, _ in self.circles]
        rights += [float(line.corners[:, 0].max()) for line in self.lines]
        rights += [word.x + width(word.text, SIZE) for word in self.words]
        return max(rights), max(lows)


def symbol(node: Node) -> Box:
    """The symbol of a node about the origin."""
    widest = {"decision": NARROWER, "data": WIDEST - 2 * LEAN}.get(node.shape, WIDEST)
    lines = [part for text in node.lines for part in fold(text, widest, SIZE)]
    named = fold(node.call, widest, SIZE) if node.call else []
    return _around(node.shape, (*named, *lines), len(named))


def _around(shape: Shape, lines: tuple[str, ...], bold: int = 0) -> Box:
    """A symbol about its text."""
    wide = max(width(line, SIZE) for line in lines)
    tall = LINE * len(lines)
    if shape == "decision":
        half = tall / 2 + 18.0 + 4.0 * (len(lines) - 1)
        return Box(shape, 0.0, 0.0, (wide / 2 + 2.0) / (1.0 - (tall - 6.0) / 2 / half), half, lines, bold)
    half_width = WIDEST / 2 + PAD
    if shape == "terminator":
        half_width = max(wide / 2 + 26.0, 44.0)
    return Box(shape, 0.0, 0.0, half_width, tall / 2 + 6.0, lines, bold)


def aside(text: str, decision: Box) -> Box:
    """The note to the right of a decision, as data."""
    lines = tuple(fold(text, ASIDE, SIZE))
    half = LINE * len(lines) / 2 + 6.0
    left = decision.half_width + 22.0
    right = RIGHT - 2.0
    return Box("data", (left + right) / 2, decision.y, (right - left) / 2, half, lines)


def laid_out(nodes: Sequence[Node], tallest: float, columns: int) -> list[Page]:
    """Pages of so many columns at most, each not taller than ``tallest``; columns of about equal heights."""
    chart = _Chart(nodes, tallest, columns)
    return chart.pages()


@dataclass(frozen=True)
class _Seat:
    """Position of a node: page, column, symbol."""

    page: int
    column: int
    box: Box

    @property
    def middle(self) -> float:
        """The middle of its column."""
        return self.column * (RIGHT - LEFT + SPACING) - LEFT

    @property
    def entry(self) -> tuple[float, float]:
        """Where jumps come into the line above it."""
        return self.middle, self.box.top - 0.55 * GAP


class _Chart:
    def __init__(self, nodes: Sequence[Node], tallest: float, columns: int) -> None:
        self.nodes, self.tallest, self.columns = list(nodes), tallest, columns
        self.symbols = [symbol(node) for node in nodes]
        self.sheets: list[Page] = []
        self.letters = iter("ABCDEFGHIJKLMNOPQRSTUVWXYZ" * 4)
        self.seats: list[_Seat] = []

    def pages(self) -> list[Page]:
        """Everything at its place."""
        self._seat()
        self.sheets = [Page() for _ in range(self.seats[-1].page + 1)]
        for seat in self.seats:
            self.sheets[seat.page].boxes.append(seat.box)
        for index in range(len(self.nodes) - 1):
            self._down(index)
        lanes = iter(BACK)
        jumps = [index for index, node in enumerate(self.nodes) if node.jump]
        for index in jumps:
            self._jump(index, lanes)
        return self.sheets

    # places -----------------------------------------------------------------------------------
    def _heights(self) -> list[float]:
        tall = [2 * box.half_height + GAP for box in self.symbols]
        for k, node in enumerate(self.nodes):
            if node.aside:
                tall[k] = max(tall[k], 2 * aside(node.aside, self.symbols[k]).half_height + GAP)
        return tall

    def _seat(self) -> None:
        """Symbols in columns, filled from the top; as few as hold them, of about equal heights."""
        heights = self._heights()
        head = 2 * RADIUS + GAP
        room = self.tallest - 2 * head
        count = math.ceil(sum(heights) / room) if sum(heights) > self.tallest else 1
        while True:
            column = self._filled(heights, self._limit(heights, count, room))
            if column[-1] < count or count > len(self.nodes):
                break
            count += 1
        tops = [0.0, *[head] * column[-1]]
        for k, (node_column, box) in enumerate(zip(column, self.symbols, strict=True)):
            page, place = divmod(node_column, self.columns)
            half = (heights[k] - GAP) / 2
            seat = _Seat(page, place, box)
            moved = replace(box, x=seat.middle, y=tops[node_column] + half)
            self.seats.append(_Seat(page, place, moved))
            tops[node_column] += heights[k]

    def _limit(self, heights: Sequence[float], count: int, room: float) -> float:
        """The smallest height of columns with which so many hold all; ``room`` where none does."""
        low, high = max(heights), room if count > 1 else self.tallest
        if len(set(self._filled(heights, high))) > count:
            return high
        for _ in range(24):
            middle = (low + high) / 2
            if self._filled(heights, middle)[-1] < count:
                high = middle
            else:
                low = middle
        return high

    @staticmethod
    def _filled(heights: Sequence[float], limit: float) -> list[int]:
        """The column of every symbol."""
        found, used, column = [], 0.0, 0
        for height in heights:
            if used and used + height > limit + 1e-9:
                column, used = column + 1, 0.0
            used += height
            found.append(column)
        return found

    # lines ------------------------------------------------------------------------------------
    def _down(self, index: int) -> None:
        """The line from a symbol to the next one, over connectors where that begins a column."""
        a, b = self.seats[index], self.seats[index + 1]
        node, sheet = self.nodes[index], self.sheets[a.page]
        start = (a.middle, a.box.bottom)
        if node.down:
            sheet.words.append(Word(node.down, a.middle + 6.0, a.box.bottom + SIZE))
        if (a.page, a.column) == (b.page, b.column):
            sheet.lines.append(FlowLine(np.array([start, (b.middle, b.box.top)])))
            return
        letter = next(self.letters)
        below = a.box.bottom + GAP
        sheet.lines.append(FlowLine(np.array([start, (a.middle, below)])))
        sheet.circles.append((a.middle, below + RADIUS, letter))
        above = b.box.top - GAP
        self.sheets[b.page].circles.append((b.middle, above - RADIUS, letter))
        self.sheets[b.page].lines.append(FlowLine(np.array([(b.middle, above), (b.middle, b.box.top)])))

    def _jump(self, index: int, lanes: Iterator[float]) -> None:
        """The line of a decision's second exit to where it jumps."""
        node, source = self.nodes[index], self.seats[index]
        target = self.seats[next(k for k, each in enumerate(self.nodes) if each.name == node.jump)]
        sheet, x0, y0 = self.sheets[source.page], source.middle, source.box.y
        near = (source.page, source.column) == (target.page, target.column)
        if node.aside:
            box = replace(aside(node.aside, source.box), y=y0)
            box = replace(box, x=x0 + box.x)
            sheet.boxes.append(box)
            left = box.corners[0] + LEAN / 2
            sheet.lines.append(FlowLine(np.array([(x0 + source.box.half_width, y0), (left, y0)])))
            sheet.words.append(Word(node.across, x0 + source.box.half_width + 1.0, y0 - 5.0))
            self._forward(source, target, box, near=near)
            return
        sheet.words.append(Word(node.across, x0 - source.box.half_width - width(node.across, SIZE), y0 - 5.0))
        lane = x0 + next(lanes)
        start = [(x0 - source.box.half_width, y0), (lane, y0)]
        if near:
            y1 = target.entry[1]
            sheet.lines.append(FlowLine(np.array([*start, (lane, y1), (x0, y1)])))
            return
        lane = x0 + BACK[0]
        self._connected(source, target, np.array([start[0], (lane + RADIUS, y0)]), (lane, y0), -1.0)

    def _forward(self, source: _Seat, target: _Seat, box: Box, *, near: bool) -> None:
        """From a side note down to a later symbol."""
        x0, sheet = source.middle, self.sheets[source.page]
        lane = x0 + FORWARD
        if near:
            y1 = target.entry[1]
            sheet.lines.append(FlowLine(np.array([(lane, box.bottom), (lane, y1), (x0, y1)])))
            return
        y1 = box.bottom + 0.6 * GAP
        line = np.array([(lane, box.bottom), (lane, y1)])
        self._connected(source, target, line, (lane, y1 + RADIUS), 1.0)

    def _connected(self, source: _Seat, target: _Seat, line: Floats, place: tuple[float, float], side: float) -> None:
        """A line to a connector, and the connector at the side of the target's entry."""
        letter, (x1, y1) = next(self.letters), target.entry
        self.sheets[source.page].lines.append(FlowLine(line))
        self.sheets[source.page].circles.append((*place, letter))
        reach = FORWARD if side > 0 else -BACK[0]
        there = self.sheets[target.page]
        there.circles.append((x1 + side * reach, y1, letter))
        there.lines.append(FlowLine(np.array([(x1 + side * (reach - RADIUS), y1), (x1, y1)])))


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
