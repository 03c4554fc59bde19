"""Where panels stand on a sheet: in rows from the top, two or more above one another where they are low.

All panels take the longest size with which they have room together; then each of them, in its order, grows as far as
the others let it. What is left of the paper is spread between them. Panels do not meet one another, the frame, the
title block or the control bar, by construction.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from linkwright.pictures.picture import Box
from linkwright.sheets.panel import Block

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
