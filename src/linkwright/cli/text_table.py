"""Tables of text, aligned by the width that characters take on a terminal."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

GAP = "  "


def shown_width(text: str) -> int:
    """Cells that a text takes: two for a wide (Chinese) character, none for a combining one."""
    if text.isascii():
        return len(text)
    cells = 0
    for character in text:
        if unicodedata.combining(character):
            continue
        cells += 2 if unicodedata.east_asian_width(character) in "WF" else 1
    return cells


def padded(text: str, width: int, align: str = "<") -> str:
    """The text filled up with spaces to a width, to the left (``<``), right (``>``) or centre (``^``)."""
    space = max(width - shown_width(text), 0)
    if align == ">":
        return " " * space + text
    if align == "^":
        return " " * (space // 2) + text + " " * (space - space // 2)
    return text + " " * space


def aligned(rows: Sequence[Sequence[str]], align: str, gap: str = GAP) -> list[str]:
    """Lines of a table; ``align`` has one of ``<``, ``>``, ``^`` per column."""
    widths = [max((shown_width(row[i]) for row in rows), default=0) for i in range(len(align))]
    return [gap.join(padded(*cell) for cell in zip(row, widths, align, strict=True)).rstrip() for row in rows]
