"""What drawings consist of: lines, circles and texts, which write themselves as SVG, and pictures made of them.

Pictures of sheets and polygons are in millimetres of paper, y up; symbols and kinematic drawings in their units, y
down, as SVG has it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.pictures.fonts import needs_chinese
from linkwright.pictures.svg import Attribute, Element, element, loop_data, number, path_data, split_index
from linkwright.pictures.svg import width as text_width

#: Kinds of lines after GB/T 4457.4 and ISO 128-2: ``frame`` and ``thick`` are wide, the others have half their width;
#: ``chain`` for paths, centre lines and pitch circles, ``double_chain`` for limit positions of moving parts.
Pen = Literal["frame", "thick", "thin", "dashed", "chain", "double_chain"]
Vec: TypeAlias = tuple[float, float]
#: What a closed outline is filled with: nothing, the paper (hides what lies below), the colour of lines.
Fill = Literal["", "paper", "ink"]
Anchor = Literal["start", "middle", "end"]
#: A line of text in parts, each with its level: 0 on the line, -1 index below, 1 index above.
Runs: TypeAlias = tuple[tuple[str, int], ...]
Words: TypeAlias = str | Runs
#: Heights of capital letters, mm (GB/T 14691, ISO 3098): the minimum; of texts; of captions.
MIN_TEXT, TEXT, CAPTION = 2.5, 3.5, 5.0
#: Height of a capital letter and depth of a descender in sizes of the font; size of indices.
CAPITAL, DESCENT, INDEX = 0.72, 0.24, 0.72
#: Height of a Chinese character in sizes of the font.
CHARACTER = 0.92
#: Symbols with indices in sentences.
_SYMBOL = re.compile(r"(?<![A-Za-z0-9_])([FMμ])_([A-Za-z]+(?:,[^\s,，、；;]+)?)")
#: Length and half width of arrow heads, mm.
HEAD = (3.2, 0.55)


@dataclass(frozen=True)
class Box:
    """A rectangle, y up."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """Its width."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Its height."""
        return self.top - self.bottom

    def inset(self, by: float) -> Box:
        """The rectangle that lies inside by so much on every side."""
        return Box(self.left + by, self.bottom + by, self.right - by, self.top - by)

    def moved(self, dx: float, dy: float) -> Box:
        """The same rectangle elsewhere."""
        return Box(self.left + dx, self.bottom + dy, self.right + dx, self.top + dy)

    def meets(self, other: Box, hair: float = 1e-6) -> bool:
        """Whether both have area in common."""
        across = self.left < other.right - hair and other.left < self.right - hair
        return across and self.bottom < other.top - hair and other.bottom < self.top - hair

    def holds(self, other: Box, hair: float = 1e-6) -> bool:
        """Whether another one lies in it."""
        across = self.left <= other.left + hair and other.right <= self.right + hair
        return across and self.bottom <= other.bottom + hair and other.top <= self.top + hair


@dataclass(frozen=True)
class Line:
    """A polyline (k, 2), a row of NaN breaks it; ``closed``: back to its start; ``style``: its kind of line, or the
    class of what it is part of; ``colour``: #rrggbb in place of the colour of its kind, for bars and plates."""

    points: Floats
    style: str = "thin"
    closed: bool = False
    fill: Fill = ""
    colour: str = ""

    def placed(self, shift: Floats, turn: float = 0.0, scale: Vec = (1.0, 1.0)) -> Line:
        """The same scaled, turned (rad, from x to y) and shifted."""
        return replace(self, points=_placed(self.points, shift, turn, scale))

    @property
    def cloud(self) -> Floats:
        """Places between which it lies."""
        return self.points[np.isfinite(self.points).all(axis=1)]

    @property
    def outline(self) -> Floats:
        """The line along which it has ink."""
        return np.vstack([self.points, self.points[:1]]) if self.closed else self.points

    def __str__(self) -> str:
        attributes: dict[str, Attribute | None] = {
            "class": f"{self.style} {self.fill}".rstrip(),
            "d": path_data(self.points, closed=self.closed),
        }
        if self.colour:
            # The rules of its kind would outdo the attributes.
            own = {"stroke": self.colour, "fill": self.colour if self.closed else "none"}
            attributes |= {"class": f"{self.style}-coloured", **own}
        return str(element("path", attributes))


@dataclass(frozen=True)
class Circle:
    """A circle."""

    at: Floats | Vec
    radius: float
    style: str = "thin"
    fill: Fill = ""

    def placed(self, shift: Floats, turn: float = 0.0, scale: Vec = (1.0, 1.0)) -> Circle:
        """The same scaled, turned (rad, from x to y) and shifted."""
        at = _placed(np.asarray(self.at), shift, turn, scale)
        return replace(self, at=at, radius=self.radius * abs(scale[0]))

    @property
    def cloud(self) -> Floats:
        """Places between which it lies."""
        return np.asarray(self.at) + self.radius * np.array([(-1.0, -1.0), (1.0, 1.0)])

    @property
    def outline(self) -> Floats:
        """The line along which it has ink."""
        angle = np.linspace(0.0, 2 * np.pi, 49)
        return np.asarray(self.at) + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)

    def __str__(self) -> str:
        x, y = map(float, self.at)
        attributes: dict[str, Attribute | None] = {
            "class": f"{self.style} {self.fill}".rstrip(),
            "cx": x,
            "cy": y,
            "r": self.radius,
        }
        return str(element("circle", attributes))


#: Angle of an arc, rad, that is drawn as one line where lines are to stand for it.
CHORD = math.pi / 12


@dataclass(frozen=True)
class Outline:
    """Closed loops of lines and arcs, the area between them filled.

    ``loops``: corners (k, 2), and the bulges (k,) of the edges that begin there: the tangent of a quarter of the
    arc's angle, positive from x to y, 0 for a line.
    """

    loops: tuple[tuple[Floats, Floats], ...]
    style: str = "thin"
    fill: Fill = ""
    colour: str = ""
    closed: ClassVar[bool] = True

    def placed(self, shift: Floats, turn: float = 0.0, scale: Vec = (1.0, 1.0)) -> Outline:
        """The same scaled, turned (rad, from x to y) and shifted."""
        sense = math.copysign(1.0, scale[0] * scale[1])
        loops = tuple((_placed(corners, shift, turn, scale), sense * bulges) for corners, bulges in self.loops)
        return replace(self, loops=loops)

    @property
    def points(self) -> Floats:
        """Its loops as polylines, each back to its start, with rows of NaN between them."""
        gap = np.full((1, 2), np.nan)
        lines = [np.vstack([*_chords(corners, bulges), corners[:1], gap]) for corners, bulges in self.loops]
        return np.vstack(lines)[:-1]

    @property
    def cloud(self) -> Floats:
        """Places between which it lies."""
        return self.points[np.isfinite(self.points).all(axis=1)]

    @property
    def outline(self) -> Floats:
        """The line along which it has ink."""
        return self.points

    def __str__(self) -> str:
        attributes: dict[str, Attribute | None] = {
            "class": f"{self.style} {self.fill}".rstrip(),
            "fill-rule": "evenodd" if len(self.loops) > 1 else None,
            "d": "".join(loop_data(corners, bulges) for corners, bulges in self.loops),
        }
        if self.colour:
            attributes |= {"class": f"{self.style}-coloured", "stroke": self.colour, "fill": self.colour}
        return str(element("path", attributes))


def _chords(corners: Floats, bulges: Floats) -> Iterator[Floats]:
    """The edges of a loop as polylines without their ends."""
    for start, end, bulge in zip(corners, np.roll(corners, -1, axis=0), bulges, strict=True):
        angle = 4.0 * math.atan(bulge)
        count = max(1, math.ceil(abs(angle) / CHORD))
        if count == 1:
            yield start[None]
            continue
        chord = complex(*(end - start))
        share = np.arange(count) / count
        along = np.sin(0.5 * angle * share) / math.sin(0.5 * angle) * np.exp(0.5j * angle * (share - 1.0)) * chord
        yield start + np.stack([along.real, along.imag], axis=1)


@dataclass(frozen=True)
class Text:
    """A line of text: its baseline begins, has its middle or ends at ``at``; ``size`` of its font.

    ``turn``: direction of the line, degrees from x to y; ``style``: its class; ``symbol``: set in italics;
    ``squeeze``: width of its letters as a share of their own.
    """

    at: Floats | Vec
    runs: Runs
    style: str
    size: float
    anchor: Anchor = "start"
    turn: float = 0.0
    symbol: bool = False
    squeeze: float = 1.0

    def placed(self, shift: Floats, scale: Vec = (1.0, 1.0)) -> Text:
        """The same scaled and shifted."""
        turn = self.turn if scale[0] * scale[1] > 0 else -self.turn
        return replace(
            self, at=_placed(np.asarray(self.at), shift, 0.0, scale), size=self.size * abs(scale[0]), turn=turn
        )

    @property
    def height(self) -> float:
        """Height of its capital letters, or of its Chinese characters."""
        return round(self.size * (CHARACTER if _chinese(self.runs) else CAPITAL), 9)

    @property
    def width(self) -> float:
        """Its width, estimated a little too large."""
        return self.squeeze * line_width(self.runs, self.size)

    @property
    def cloud(self) -> Floats:
        """The corners of its box, y up."""
        start = -self.width * {"start": 0.0, "middle": 0.5, "end": 1.0}[self.anchor]
        low = -DESCENT * self.size - (0.25 * self.size if any(level < 0 for _, level in self.runs) else 0.0)
        high = self.height + (0.35 * self.size if any(level > 0 for _, level in self.runs) else 0.0)
        corners = np.array([(start, low), (start + self.width, low), (start + self.width, high), (start, high)])
        return _placed(corners, np.asarray(self.at), math.radians(self.turn))

    @property
    def outline(self) -> Floats:
        """Lines that cover its box."""
        return self.cloud[[0, 1, 2, 3, 0, 2, 1, 3]]

    def __str__(self) -> str:
        x, y = map(float, self.at)
        turn = f"rotate({number(self.turn)} {number(x)} {number(y)})" if self.turn else None
        if self.squeeze < 1.0:
            turn = f"translate({number(x)} {number(y)}) scale({self.squeeze:.3f} 1)"
            x = y = 0.0
        attributes: dict[str, Attribute | None] = {
            "class": self.style or None,
            "x": x,
            "y": y,
            "font-size": self.size,
            "text-anchor": None if self.anchor == "start" else self.anchor,
            "font-style": "italic" if self.symbol else None,
            "transform": turn,
            "xml:space": "preserve" if any(text != " ".join(text.split()) for text, _ in self.runs) else None,
        }
        return str(element("text", attributes, *self._spans()))

    def _spans(self) -> Iterator[Element | str]:
        """The parts of the text; an index below one above begins where that one does."""
        raised = back = 0.0
        for text, level in self.runs:
            wanted = {0: 0.0, -1: 0.25, 1: -0.38}[level] * self.size
            if level == 0 and raised == 0.0:
                yield text
                continue
            size = INDEX * self.size if level else self.size
            shift = -back if back and level < 0 else None
            yield element("tspan", {"dx": shift, "dy": wanted - raised, "font-size": size}, text)
            raised, back = wanted, text_width(text, size) if level > 0 else 0.0


def _placed(points: Floats, shift: Floats, turn: float = 0.0, scale: Vec = (1.0, 1.0)) -> Floats:
    c, s = math.cos(turn), math.sin(turn)
    return np.asarray(shift + (points * scale) @ np.array([(c, s), (-s, c)]))


#: What has ink.
Inked: TypeAlias = Line | Circle | Outline
Item: TypeAlias = Inked | Text
#: What an SVG document consists of.
SvgNode: TypeAlias = Element | Item


@dataclass
class Picture:
    """Items in the order in which they are drawn."""

    items: list[Item] = field(default_factory=list)

    def line(self, points: ArrayLike, pen: Pen = "thin", *, closed: bool = False, fill: Fill = "") -> None:
        """A polyline through points (k, 2), mm; a row of NaN breaks it."""
        rows = np.asarray(points, dtype=float).reshape(-1, 2)
        if np.isfinite(rows).all():
            self.items.append(Line(rows, pen, closed, fill))
        else:
            self.items += [Line(piece, pen) for piece in unbroken(rows)]

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
        end, direction = np.asarray(tip, dtype=float), np.asarray(along, dtype=float)
        direction = direction / (float(np.hypot(*direction)) or 1.0)
        back, side = end - length * direction, HEAD[1] * length / HEAD[0] * np.array([-direction[1], direction[0]])
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
            size = font_size(runs, height)
            self.items.append(Text(np.asarray(at, dtype=float), runs, "", size, anchor, turn, symbol, squeeze))

    def add(self, other: Picture, shift: ArrayLike = (0.0, 0.0)) -> None:
        """All of another picture, shifted."""
        by = np.asarray(shift, dtype=float)
        self.items += [item.placed(by) for item in other.items]

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


def unbroken(points: Floats) -> Iterator[Floats]:
    """The pieces of a polyline (k, 2) between rows of NaN."""
    good = np.asarray(np.isfinite(points).all(axis=1))
    for piece in np.split(np.arange(len(points)), np.flatnonzero(np.diff(good.astype(int))) + 1):
        if len(piece) > 1 and good[piece[0]]:
            yield points[piece]


#: Steps of graphical scales within a power of ten.
GRAPHICAL = (1.0, 2.0, 2.5, 4.0, 5.0)


def round_up(value: float, steps: Sequence[float] = (1.0, 2.0, 2.5, 5.0)) -> float:
    """The smallest round number, one of some steps times a power of ten, that is not below a value."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-12)
    round_numbers = (k * each for each in (power, 10.0 * power) for k in steps)
    return min(each for each in round_numbers if each >= value * (1 - 1e-9))


def as_runs(words: Words) -> Runs:
    """A text as its parts; empty ones are left out."""
    parts = ((words, 0),) if isinstance(words, str) else words
    return tuple((text, level) for text, level in parts if text)


def name_runs(name: str) -> Runs:
    """A name whose trailing number is an index: O1 is O with the index 1."""
    return indexed(*split_index(name))


def sentence_runs(text: str) -> Runs:
    """A text as it is, but for symbols such as ``M_d`` and ``μ_F``, whose indices are set low."""
    parts = _SYMBOL.split(text)
    levels = [level for _ in parts[::3] for level in (0, 0, -1)]
    return as_runs(tuple(zip(parts, levels, strict=False)))


def indexed(letter: str, below: str = "", above: str = "") -> Runs:
    """A letter with its indices."""
    return as_runs(((letter, 0), (above, 1), (below, -1)))


def joined(*parts: Words) -> Runs:
    """Texts one after the other."""
    return tuple(run for part in parts for run in as_runs(part))


def font_size(runs: Runs, height: float) -> float:
    """The size of the font with which capitals, or Chinese characters where there are some, have a height; that of
    Chinese characters is TEXT at least."""
    return max(height, TEXT) / CHARACTER if _chinese(runs) else height / CAPITAL


def _chinese(runs: Runs) -> bool:
    return any(needs_chinese(text) for text, _ in runs)


def runs_width(runs: Runs, height: float) -> float:
    """The width of a line of text whose capitals have a height."""
    return line_width(runs, font_size(runs, height))


def line_width(runs: Runs, size: float) -> float:
    """The width of a line of text at a size of its font; an index above is placed over the one below."""
    wide = above = 0.0
    for text, level in runs:
        part = text_width(text, size * (INDEX if level else 1.0))
        if level > 0:
            above = part
        elif level < 0:
            wide, above = wide + max(part, above), 0.0
        else:
            wide, above = wide + above + part, 0.0
    return wide + above
