"""Columns of text side by side, by the width that characters take."""

from __future__ import annotations

from collections.abc import Sequence
from unicodedata import east_asian_width


def aligned(rows: Sequence[Sequence[str]], align: str, gap: str = "  ") -> list[str]:
    """Lines of a table; ``align`` has ``<`` or ``>`` per column."""
    widths = [max((_width(row[i]) for row in rows), default=0) for i in range(len(align))]
    lines = []
    for row in rows:
        cells = []
        for text, width, side in zip(row, widths, align, strict=True):
            space = " " * (width - _width(text))
            cells.append(space + text if side == ">" else text + space)
        lines.append(gap.join(cells).rstrip())
    return lines


def _width(text: str) -> int:
    return sum(2 if east_asian_width(character) in "WF" else 1 for character in text)
