"""A panel of a sheet: a picture, or a table, that is drawn as large as its place allows, with its caption beneath.

A panel is written as a class with a ``name``, the ``sizes`` that it may have and a ``drawn``::

    class LiftDiagram(Panel):
        smallest, largest = 90.0, 220.0

        def drawn(self, size: float, scale: float | None) -> Drawn:
            picture = Picture()
            picture.line(points_in_mm, "thick")
            return Drawn(picture, (as_runs("lift"), joined(indexed("μ", "s"), " = 0.5 mm/mm")))

The layout asks for the longest size with which all panels of a sheet have room. A panel to scale takes the next
preferred scale with which its picture is at most ``size`` mm long; one of fixed size ignores it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from linkwright.pictures.picture import (
    CAPTION,
    GRAPHICAL,
    MIN_TEXT,
    TEXT,
    Box,
    Picture,
    Runs,
    Words,
    as_runs,
    round_up,
    runs_width,
)

#: Between a picture and its caption, and from one line of text to the next in heights of letters.
UNDER, LEADING = 3.0, 1.75


@dataclass(frozen=True)
class Drawn:
    """A panel's picture in mm with any origin, and the lines of its caption, the first one larger.

    ``scale``: as a ratio (1:2); the title block prints that of the first panel that has one.
    """

    picture: Picture
    caption: tuple[Runs, ...] = ()
    scale: str = ""


class Panel(ABC):
    """One picture of a sheet.

    ``name``: by which files move it or leave it out; ``smallest`` and ``largest``: sizes of its longer side that are
    worth drawing, mm; ``rank``: where panels have no room on a sheet, those of the highest rank are left out first;
    ``letters``: height of its letters, mm, smaller on small paper.
    """

    name: str
    smallest: float = 40.0
    largest: float = 120.0
    rank: float = 5.0
    letters: float = TEXT

    @abstractmethod
    def drawn(self, size: float, scale: float | None) -> Drawn:
        """The panel with a picture of at most ``size`` mm; ``scale``: the scale that the file asks for, SI per mm."""


@dataclass(frozen=True)
class Block:
    """A panel that is drawn, its lower left corner at the origin, with its caption centred beneath."""

    name: str
    picture: Picture
    width: float
    height: float
    scale: str = ""

    def at(self, left: float, bottom: float) -> Box:
        """Its rectangle at a place of the paper."""
        return Box(left, bottom, left + self.width, bottom + self.height)


def block_of(name: str, drawn: Drawn, caption: float = CAPTION) -> Block:
    """A drawn panel with its caption, as one picture; ``caption``: height of its first line."""
    inner = drawn.picture.bounds
    heights = [
        caption if number == 0 else (TEXT if caption > TEXT else MIN_TEXT) for number in range(len(drawn.caption))
    ]
    widths = [runs_width(line, height) for line, height in zip(drawn.caption, heights, strict=True)]
    wide = max([inner.width, *widths])
    below = sum(LEADING * height for height in heights) + (UNDER if heights else 0.0)
    found = Picture()
    found.add(drawn.picture, (0.5 * (wide - inner.width) - inner.left, below - inner.bottom))
    level = below - UNDER
    for line, height in zip(drawn.caption, heights, strict=True):
        found.text((0.5 * wide, level - 1.25 * height), line, height, "middle")
        level -= LEADING * height
    return Block(name, found, wide, below + inner.height, drawn.scale)


def preferred(minimum: float) -> float:
    """The smallest of 1, 2, 2.5, 4, 5 times a power of ten that is not below a value: graphical scales per mm."""
    return round_up(minimum, GRAPHICAL)


def drawing_scale(minimum: float, *, allowed: bool = False) -> float:
    """The smallest reduction (2.0 for 1:2, 0.5 for 2:1) of ISO 5455, or that GB/T 14690 prefers, that is not below a
    value; ``allowed``: also 1:2.5, 1:4, 2.5:1 and 4:1, which GB/T 14690 allows."""
    return round_up(minimum, GRAPHICAL if allowed else (1.0, 2.0, 5.0))


def scale_text(reduction: float) -> str:
    """A scale as a ratio: 1:2, 2:1."""
    one, other = (1.0, reduction) if reduction >= 1.0 else (1.0 / reduction, 1.0)
    return f"{round(one, 6):g}:{round(other, 6):g}"


#: Height of a row in heights of its letters, and space around a text, mm.
ROW, CELL_PADDING = 1.9, 1.6
#: Rows of a table that is not parted.
LONG = 10


class TablePanel(Panel):
    """A table with a head: texts in cells; widths follow the texts.

    ``parts``: how many stand side by side, of one after the other; by default two where it is long.
    """

    smallest = largest = 0.0

    def __init__(
        self,
        name: str,
        rank: float,
        head: Sequence[Words],
        rows: Sequence[Sequence[Words]],
        caption: Words,
        *,
        parts: int | None = None,
    ) -> None:
        self.name, self.rank = name, rank
        self.parts = parts or (1 if len(rows) <= LONG else 2)
        tall = -(-len(rows) // self.parts)
        filled = [*rows, *([[""] * len(head)] * (tall * self.parts - len(rows)))]
        sides = [filled[k * tall : (k + 1) * tall] for k in range(self.parts)]
        self.rows = [[cell for _ in sides for cell in head]]
        self.rows += [[cell for row in side for cell in row] for side in zip(*sides, strict=True)]
        self.caption = caption

    def drawn(self, size: float, scale: float | None) -> Drawn:
        picture, tall = Picture(), ROW * self.letters
        widths = [
            max(runs_width(as_runs(row[k]), self.letters) for row in self.rows) + 2 * CELL_PADDING
            for k in range(len(self.rows[0]))
        ]
        outline = Box(0.0, -tall * len(self.rows), sum(widths), 0.0)
        for number, row in enumerate(self.rows):
            left, level = 0.0, -tall * number
            for width, text in zip(widths, row, strict=True):
                baseline = level - 0.5 * tall - 0.42 * self.letters
                picture.text((left + 0.5 * width, baseline), text, self.letters, "middle")
                left += width
            if number:
                picture.line([(0.0, level), (outline.right, level)], "thick" if number == 1 else "thin")
        left = 0.0
        for number, width in enumerate(widths[:-1], 1):
            left += width
            between = number * self.parts % len(widths) == 0
            picture.line([(left, 0.0), (left, outline.bottom)], "thick" if between else "thin")
        picture.box(outline, "thick")
        return Drawn(picture, (as_runs(self.caption),))
