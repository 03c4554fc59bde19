"""Columns of results: their parts, the pick of the user, and the choice that fits a terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats, largest
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.words import Say
from linkwright.words.characters import GAP, cells, padded

#: Digits of a column's largest value.
DIGITS = 5
#: Share of the scale below which a value is rounding.
NOTHING = 1e-12
MISSING = "–"


@dataclass(frozen=True)
class Column:
    """Values (n,) of one quantity of a link, point, joint or driver (``owner``), in ``unit``.

    ``scale`` is the size against which values are mere rounding, and printed as 0.
    """

    name: str
    owner: str
    quantity: str
    unit: str
    values: Floats
    scale: float = 1.0

    @classmethod
    def of(cls, output: Output, values: Floats) -> Column:
        """The column of a result."""
        return cls(output.column, output.place, output.quantity, output.unit, values)

    def in_degrees(self) -> Column:
        """The same with angles in degrees."""
        return replace(self, unit="°", values=np.degrees(self.values)) if self.unit == "rad" else self

    def cells(self) -> list[str]:
        """Texts of the values, with the same number of decimals."""
        return [self.text(value) for value in self.values]

    def text(self, value: float) -> str:
        """Text of one value as this column writes it."""
        if not math.isfinite(value):
            return MISSING
        if self._largest < NOTHING * self.scale:
            return "0"
        if self._decimals is None:
            return f"{value:.{DIGITS - 1}e}"
        return f"{round(value, self._decimals) + 0.0:.{self._decimals}f}"

    @cached_property
    def _largest(self) -> float:
        return largest(self.values)

    @cached_property
    def _decimals(self) -> int | None:
        """Decimals that all values get, no more than they need; None for numbers written with a power of ten."""
        place = math.floor(math.log10(self._largest))
        if not -4 <= place < 9:
            return None
        most = min(max(DIGITS - 1 - place, 0), 6)
        values = self.values[np.isfinite(self.values)]
        exact = (d for d in range(most) if np.abs(values - np.round(values, d)).max() < 1e-9 * self._largest)
        return next(exact, most)


def fitting(
    fixed: Sequence[Column], blocks: Sequence[Sequence[Column]], width: int, say: Say, *, least: int
) -> list[list[Column]]:
    """The first of the blocks (columns that belong together) that fit beside the fixed ones; at least ``least``."""
    used = total_width(fixed, say)
    chosen: list[list[Column]] = []
    for block in blocks:
        wide = len(GAP) + total_width(block, say)
        if len(chosen) >= least and used + wide > width:
            break
        used += wide
        chosen.append(list(block))
    return chosen


def total_width(columns: Sequence[Column], say: Say) -> int:
    """Cells that columns take side by side, under their owners and words."""
    widths = _widths(columns, say)
    _owner_line(columns, widths)
    return sum(widths) + len(GAP) * (len(widths) - 1)


def _widths(columns: Sequence[Column], say: Say) -> list[int]:
    return [
        max(cells(text) for text in [*column.cells(), label(column, say), column.unit]) for column in columns
    ]


def label(column: Column, say: Say) -> str:
    """What a column is called under its owner's name."""
    try:
        return say(f"solve.quantity.{column.quantity}")
    except KeyError:
        return column.quantity


def table(columns: Sequence[Column], say: Say) -> list[str]:
    """Lines of the table: owners, quantities, units, values."""
    labels = [label(column, say) for column in columns]
    cells = [column.cells() for column in columns]
    widths = _widths(columns, say)
    owners = _owner_line(columns, widths)
    lines = [owners] if owners.strip() else []
    for row in [labels, [column.unit for column in columns], *zip(*cells, strict=True)]:
        lines.append(
            GAP.join(padded(text, wide, ">") for text, wide in zip(row, widths, strict=True)).rstrip()
        )
    return lines


def _owner_line(columns: Sequence[Column], widths: list[int]) -> str:
    """Names over the columns that belong to them; a name wider than its columns widens the first of them."""
    parts: list[str] = []
    start = 0
    while start < len(columns):
        end = start
        while end < len(columns) and columns[end].owner == columns[start].owner:
            end += 1
        owner = columns[start].owner
        span = sum(widths[start:end]) + len(GAP) * (end - start - 1)
        lacking = cells(owner) - span
        if lacking > 0:
            widths[start] += lacking
            span += lacking
        wide = owner and end - start > 1 and span >= cells(owner) + 4
        rule = f" {owner} " if wide else owner
        parts.append(_ruled(rule, span) if rule != owner else padded(owner, span, ">"))
        start = end
    return GAP.join(parts).rstrip()


def _ruled(text: str, span: int) -> str:
    """A name with lines to both sides, over the columns that it heads."""
    space = span - cells(text)
    return "─" * (space // 2) + text + "─" * (space - space // 2)
