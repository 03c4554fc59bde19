"""What a sheet is drawn with: lines, circles and texts in millimetres of paper, x to the right, y up."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import field, replace
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.pictures.svg.fonts import needs_chinese
from linkwright.pictures.svg.text import width as text_width
from linkwright.sheets.paper import Box

#: Kinds of lines after GB/T 4457.4 and ISO 128-2: ``frame`` and ``thick`` are wide, the others have half their width;
#: ``chain`` for paths, centre lines and pitch circles, ``double_chain`` for limit positions of moving parts.
Pen = Literal["frame", "thick", "thin", "dashed", "chain", "double_chain"]
#: What a closed outline is filled with: nothing, the paper (hides what lies below), the colour of lines.
Fill = Literal["", "paper", "ink"]
Anchor = Literal["start", "middle", "end"]
#: A line of text in parts, each with its level: 0 on the line, -1 index below, 1 index above.
Runs: TypeAlias = tuple[tuple[str, int], ...]
Words: TypeAlias = str | Runs
#: Heights of capital letters, mm (GB/T 14691, ISO 3098): the least; of texts; of captions.
LEAST, TEXT, CAPTION = 2.5, 3.5, 5.0
#: Height of a capital letter and depth of a descender in sizes of the font; size of indices.
CAPITAL, DESCENT, INDEX = 0.72, 0.24, 0.72
#: Height of a Chinese character in sizes of the font.
CHARACTER = 0.92
#: Length and half width of arrow heads, mm.
HEAD = (3.2, 0.55)


@dataclass(frozen=True)
class Line:
    """A polyline (k, 2); ``closed``: back to its start."""

    points: Floats
    pen: Pen = "thin"
    closed: bool = False
    fill: Fill = ""

    def moved(self, shift: Floats) -> Line:
        """The same elsewhere."""
        return replace(self, points=self.points + shift)

    @property
    def cloud(self) -> Floats:
        """Places between which it lies."""
        return self.points[np.isfinite(self.points).all(axis=1)]


@dataclass(frozen=True)
class Circle:
    """A circle."""

    at: Floats
    radius: float
    pen: Pen = "thin"
    fill: Fill = ""

    def moved(self, shift: Floats) -> Circle:
        """The same elsewhere."""
        return replace(self, at=self.at + shift)

    @property
    def cloud(self) -> Floats:
        """Places between which it lies."""
        return self.at + self.radius * np.array([(-1.0, -1.0), (1.0, 1.0)])


@dataclass(frozen=True)
class Text:
    """A line of text: its baseline begins, has its middle or ends at ``at``; ``height`` of a capital letter.

    ``turn``: direction of the line, degrees counter-clockwise; ``symbol``: set in italics; ``squeeze``: width of its
    letters as a share of their own. Of Chinese text the ``height`` is that of a character.
    """

    at: Floats
    runs: Runs
    height: float = TEXT
    anchor: Anchor = "start"
    turn: float = 0.0
    symbol: bool = False
    squeeze: float = 1.0

    def moved(self, shift: Floats) -> Text:
        """The same elsewhere."""
        return replace(self, at=self.at + shift)

    @property
    def size(self) -> float:
        """Size of its font, mm."""
        return font_size(self.runs, self.height)

    @property
    def width(self) -> float:
        """Its width, mm, estimated a little too large."""
        return self.squeeze * runs_width(self.runs, self.height)

    @property
    def cloud(self) -> Floats:
        """The corners of its box."""
        start = -self.width * {"start": 0.0, "middle": 0.5, "end": 1.0}[self.anchor]
        low = -DESCENT * self.size - (0.25 * self.size if any(level < 0 for _, level in self.runs) else 0.0)
        high = self.height + (0.35 * self.size if any(level > 0 for _, level in self.runs) else 0.0)
        corners = np.array(
            [(start, low), (start + self.width, low), (start + self.width, high), (start, high)]
        )
        c, s = math.cos(math.radians(self.turn)), math.sin(math.radians(self.turn))
        return np.asarray(self.at + corners @ np.array([(c, s), (-s, c)]))


Item: TypeAlias = Line | Circle | Text


@dataclass
class Picture:
    """Items in the order in which they are drawn."""

    items: list[Item] = field(default_factory=list)

    def line(self, points: ArrayLike, pen: Pen = "thin", *, closed: bool = False, fill: Fill = "") -> None:
        """A polyline through points (k, 2), mm; a row of NaN breaks it."""
        rows = np.asarray(points, dtype=float).reshape(-1, 2)
        good = np.isfinite(rows).all(axis=1)
        if good.all():
            self.items.append(Line(rows, pen, closed, fill))
            return
        for piece in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(good.astype(int))) + 1):
            if len(piece) > 1 and good[piece[0]]:
                self.items.append(Line(rows[piece], pen))

    def box(self, box: Box, pen: Pen = "thin") -> None:
        """A rectangle."""
        left, bottom, right, top = box.left, box.bottom, box.right, box.top
        self.line([(left, bottom), (right, bottom), (right, top), (left, top)], pen, closed=True)

    def circle(self, at: ArrayLike, radius: float, pen: Pen = "thin", *, fill: Fill = "") -> None:
        """A circle."""
        self.items.append(Circle(np.asarray(at, dtype=float), radius, pen, fill))

    def arc(self, at: ArrayLike, radius: float, start: float, end: float, pen: Pen = "thin") -> None:
        """An arc about a place from one angle to another, rad, as a polyline."""
        count = max(3, math.ceil(abs(end - start) / 0.05))
        angle = np.linspace(start, end, count)
        self.line(np.asarray(at) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1), pen)

    def head(self, tip: ArrayLike, along: ArrayLike, length: float = HEAD[0]) -> None:
        """The head of an arrow that points ``along``."""
        end, way = np.asarray(tip, dtype=float), np.asarray(along, dtype=float)
        way = way / (float(np.hypot(*way)) or 1.0)
        back, side = end - length * way, HEAD[1] * length / HEAD[0] * np.array([-way[1], way[0]])
        self.line([end, back + side, back - side], "thin", closed=True, fill="ink")

    def arrow(self, start: ArrayLike, end: ArrayLike, pen: Pen = "thick") -> None:
        """An arrow; its head is smaller where it is short."""
        first, last = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        length = float(np.hypot(*(last - first)))
        if length < 1e-3:
            return
        head = min(HEAD[0], 0.6 * length)
        self.line([first, last - 0.8 * head * (last - first) / length], pen)
        self.head(last, last - first, head)

    def text(
        self,
        at: ArrayLike,
        words: Words,
        height: float = TEXT,
        anchor: Anchor = "start",
        *,
        turn: float = 0.0,
        symbol: bool = False,
        squeeze: float = 1.0,
    ) -> None:
        """A line of text; Chinese characters are not set smaller than TEXT."""
        if runs := as_runs(words):
            height = max(height, TEXT) if any(needs_chinese(text) for text, _ in runs) else height
            self.items.append(Text(np.asarray(at, dtype=float), runs, height, anchor, turn, symbol, squeeze))

    def add(self, other: Picture, shift: ArrayLike = (0.0, 0.0)) -> None:
        """All of another picture, shifted."""
        by = np.asarray(shift, dtype=float)
        self.items += [item.moved(by) for item in other.items]

    @property
    def bounds(self) -> Box:
        """The rectangle of all that is drawn; empty at the origin where there is nothing."""
        return bounds_of(self.items)

    @property
    def texts(self) -> list[Text]:
        """Its texts."""
        return [item for item in self.items if isinstance(item, Text)]


def bounds_of(items: Iterable[Item]) -> Box:
    """The rectangle of items."""
    clouds = [item.cloud for item in items]
    if not clouds:
        return Box(0.0, 0.0, 0.0, 0.0)
    every = np.concatenate(clouds)
    (left, bottom), (right, top) = every.min(axis=0), every.max(axis=0)
    return Box(float(left), float(bottom), float(right), float(top))


def as_runs(words: Words) -> Runs:
    """A text as its parts; empty ones are left out."""
    parts = ((words, 0),) if isinstance(words, str) else words
    return tuple((text, level) for text, level in parts if text)


def indexed(letter: str, below: str = "", above: str = "") -> Runs:
    """A letter with its indices."""
    return as_runs(((letter, 0), (above, 1), (below, -1)))


def joined(*parts: Words) -> Runs:
    """Texts one after the other."""
    return tuple(run for part in parts for run in as_runs(part))


def font_size(runs: Sequence[tuple[str, int]], height: float) -> float:
    """The size of the font with which capitals, or Chinese characters where there are some, have a height; that of
    Chinese characters is TEXT at least."""
    chinese = any(needs_chinese(text) for text, _ in runs)
    return max(height, TEXT) / CHARACTER if chinese else height / CAPITAL


def runs_width(runs: Sequence[tuple[str, int]], height: float) -> float:
    """The width of a line of text, mm; an index above stands over the one below."""
    size, wide, above = font_size(runs, height), 0.0, 0.0
    for text, level in runs:
        part = text_width(text, size * (INDEX if level else 1.0))
        if level > 0:
            above = part
        elif level < 0:
            wide, above = wide + max(part, above), 0.0
        else:
            wide, above = wide + above + part, 0.0
    return wide + above
