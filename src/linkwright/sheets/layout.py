"""Panels of a sheet, drawn as large as their places allow, and where they stand: in rows from the top.

All panels take the longest size with which they have room together; then each of them, in its order, grows as far as
the others let it. What is left of the paper is spread between them. Panels do not meet one another, the frame, the
title block or the control bar, by construction.

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
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

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


#: Minimum space between panels, and between them and the frame, mm; most that a gap is spread to.
GAP, WIDEST_GAP = 8.0, 60.0
#: A row's first block is centred where it is so many times as high as the others.
MAIN = 1.4
#: Rank from which a panel is left out where all others would be below this share of their size ranges.
SPARE, COMFORT = 5.0, 0.15
#: Shares of the way from the smallest to the largest size that are tried, from large to small.
SHARES = tuple(1.0 - k / 12 for k in range(13))

#: A panel's name with a share of its size range gives its block.
Draw = Callable[[str, float], Block]


@dataclass(frozen=True)
class Room:
    """Where panels may stand: a rectangle without the ``taken`` ones (title block, control bar, fixed panels)."""

    outer: Box
    taken: tuple[Box, ...] = ()

    def without(self, *boxes: Box) -> Room:
        """The same with more taken."""
        return replace(self, taken=(*self.taken, *boxes))

    def stretches(self, top: float, bottom: float) -> list[tuple[float, float]]:
        """The free stretches from left to right between two heights, GAP away from what is taken."""
        found = [(self.outer.left, self.outer.right)]
        for box in self.taken:
            if box.bottom - GAP >= top or box.top + GAP <= bottom:
                continue
            cut = (box.left - GAP, box.right + GAP)
            pieces = [((a, min(b, cut[0])), (max(a, cut[1]), b)) for a, b in found]
            found = [piece for pair in pieces for piece in pair if piece[1] - piece[0] > 1.0]
        return found


@dataclass
class Column:
    """Blocks above one another."""

    blocks: list[Block] = field(default_factory=list)

    @property
    def width(self) -> float:
        """Its widest block."""
        return max(block.width for block in self.blocks)

    @property
    def height(self) -> float:
        """Its blocks with gaps between them."""
        return sum(block.height for block in self.blocks) + GAP * (len(self.blocks) - 1)


@dataclass
class Row:
    """Columns in one free stretch between two heights."""

    left: float
    right: float
    top: float
    height: float
    columns: list[Column] = field(default_factory=list)

    @property
    def free(self) -> float:
        """Width that is left for a further column."""
        used = sum(column.width + GAP for column in self.columns)
        return self.right - self.left - used

    def take(self, block: Block) -> bool:
        """Puts a block under the last column that has room, else into a new column; False where it has no room."""
        if block.height > self.height + 1e-9:
            return False
        for column in self.columns:
            wider = max(0.0, block.width - column.width)
            if column.height + GAP + block.height <= self.height + 1e-9 and wider <= self.free:
                column.blocks.append(block)
                return True
        if block.width <= self.free + 1e-9:
            self.columns.append(Column([block]))
            return True
        return False


Places = dict[str, Box]


def packed(blocks: Sequence[Block], room: Room, *, even: bool = False) -> list[Row] | None:
    """Rows that hold all blocks in their order, None where they have no room; each block goes into the first row in
    which it fits. A new row is as high as its first block, with ``even`` as the highest one that is still to come."""
    rows: list[Row] = []
    top = room.outer.top
    for number, block in enumerate(blocks):
        if any(row.take(block) for row in rows):
            continue
        high = max(each.height for each in blocks[number:]) if even else block.height
        opened = _opened(block, room, top, high) or _opened(block, room, top, block.height)
        if opened is None:
            return None
        rows += opened
        top = opened[0].top - opened[0].height - GAP
    return rows


def _opened(block: Block, room: Room, top: float, high: float) -> list[Row] | None:
    """Rows of a height side by side between what is taken, from ``top`` down, one of which holds the block."""
    while top - high >= room.outer.bottom - 1e-9:
        rows = [Row(a, b, top, high) for a, b in room.stretches(top, top - high)]
        if any(row.take(block) for row in rows):
            return rows
        tops = [box.bottom - GAP for box in room.taken if box.bottom - GAP < top - 1e-9]
        if not tops:
            return None
        top = max(tops)
    return None


def spread(rows: Sequence[Row], room: Room) -> Places:
    """The places of blocks: what is free in a row goes between its columns, in a column between its blocks."""
    found: Places = {}
    for row in rows:
        if not row.columns:
            continue
        spare = row.right - row.left - sum(column.width for column in row.columns)
        gap = min(WIDEST_GAP, spare / (len(row.columns) + 1))
        x = row.left + 0.5 * (spare - gap * (len(row.columns) - 1))
        for column in _in_the_middle(row):
            free = row.height - sum(block.height for block in column.blocks)
            between = free / (len(column.blocks) + 1)
            y = row.top - between
            for block in column.blocks:
                y -= block.height
                left = x + 0.5 * (column.width - block.width)
                found[block.name] = block.at(left, y)
                y -= between
            x += column.width + gap
    return _lowered(found, rows, room)


def _in_the_middle(row: Row) -> list[Column]:
    """The columns of a row from left to right: the first one, where its block is the main one, in the middle."""
    first, *others = row.columns
    highest = max((block.height for column in others for block in column.blocks), default=0.0)
    if len(others) < 2 or first.blocks[0].height < MAIN * highest:
        return row.columns
    left = (len(others) + 1) // 2
    return [*others[:left], first, *others[left:]]


def _lowered(found: Places, rows: Sequence[Row], room: Room) -> Places:
    """Places with the height that is left below the last row spread between the rows, as far as nothing is met."""
    tops = sorted({row.top for row in rows if row.columns}, reverse=True)
    lowest = min((box.bottom for box in found.values()), default=room.outer.bottom)
    spare = lowest - room.outer.bottom
    for share in (1.0, 0.75, 0.5, 0.25):
        step = share * spare / (len(tops) + 1)
        shift = {top: step * (number + 1) for number, top in enumerate(tops)}
        moved: Places = {}
        for row in rows:
            for column in row.columns:
                moved |= {b.name: found[b.name].moved(0.0, -shift[row.top]) for b in column.blocks}
        if all(not box.meets(taken) for box in moved.values() for taken in room.taken):
            return moved
    return found


@dataclass(frozen=True)
class Layout:
    """Blocks with the places of their lower left corners, and the names of those that have no room."""

    blocks: Mapping[str, Block]
    places: Mapping[str, Box]
    left_out: tuple[str, ...] = ()


def _in_order(blocks: list[Block]) -> list[Block]:
    return blocks


def _tall_first(blocks: list[Block]) -> list[Block]:
    return sorted(blocks, key=lambda block: -block.height)


#: Orders in which blocks are packed, with even rows or not; the share of size that the given one, which reads better,
#: may cost.
_ORDERS = ((_in_order, True), (_in_order, False), (_tall_first, False))
_TIDY = 0.4


@dataclass(frozen=True)
class _Asked:
    """Panels to lay out, the order in which they are packed, whether in ``even`` rows, and their room."""

    names: Sequence[str]
    order: Callable[[list[Block]], list[Block]]
    even: bool
    draw: Draw
    room: Room

    def rows(self, shares: Mapping[str, float]) -> list[Row] | None:
        """The rows with panels of these shares of their size ranges; None where they have no room."""
        blocks = self.order([self.draw(name, shares[name]) for name in self.names])
        return packed(blocks, self.room, even=self.even)

    @cached_property
    def share(self) -> float | None:
        """The largest share of their size ranges with which all panels have room; None where there is none."""
        if self.rows(dict.fromkeys(self.names, 0.0)) is None:
            return None
        return next((each for each in SHARES if self.rows(dict.fromkeys(self.names, each))), 0.0)

    @property
    def merit(self) -> float:
        """The share, and more for the order that reads better."""
        return (self.share or 0.0) + (_TIDY if self.order is _in_order else 0.0)


def laid_out(names: Sequence[str], ranks: Mapping[str, float], draw: Draw, room: Room) -> Layout:
    """The layout of panels in their order.

    Where not even the smallest sizes have room, the panel of the highest rank is left out, and so on; one of a rank
    of SPARE or more already where it leaves the others little room.
    """
    chosen, left_out = list(names), list[str]()
    while chosen:
        tried = [_Asked(tuple(chosen), order, even, draw, room) for order, even in _ORDERS]
        fitting = [asked for asked in tried if asked.share is not None]
        crowded = len(chosen) > 1 and max(map(ranks.__getitem__, chosen)) >= SPARE
        if fitting and not (crowded and all((asked.share or 0.0) < COMFORT for asked in fitting)):
            return _grown(max(fitting, key=lambda asked: asked.merit), tuple(left_out))
        worst = max(reversed(chosen), key=lambda name: ranks[name])
        chosen.remove(worst)
        left_out.append(worst)
    return Layout({}, {}, tuple(left_out))


def _grown(asked: _Asked, left_out: tuple[str, ...]) -> Layout:
    """The layout with every panel as large as the others let it."""
    share = asked.share or 0.0
    shares = dict.fromkeys(asked.names, share)
    rows = asked.rows(shares)
    assert rows is not None
    for name in asked.names:
        for larger in (each for each in SHARES if each > share):
            tried = asked.rows({**shares, name: larger})
            if tried is not None:
                rows, shares[name] = tried, larger
                break
    blocks = {name: asked.draw(name, shares[name]) for name in asked.names}
    return Layout(blocks, spread(rows, asked.room), left_out)
