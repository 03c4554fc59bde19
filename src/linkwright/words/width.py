"""Texts side by side on a terminal, where a Chinese character takes two cells."""

from __future__ import annotations

from collections.abc import Sequence

GAP = "  "


def cells(text: str) -> int:
    """Cells that a text takes: two for a wide (Chinese) character, none for a combining one."""
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(c) else 2 if east_asian_width(c) in "WF" else 1 for c in text)


def padded(text: str, width: int, align: str = "<") -> str:
    """The text filled up with spaces to a width, to the left (``<``), right (``>``) or centre (``^``)."""
    space = max(width - cells(text), 0)
    if align == ">":
        return " " * space + text
    if align == "^":
        return " " * (space // 2) + text + " " * (space - space // 2)
    return text + " " * space


def aligned(rows: Sequence[Sequence[str]], align: str, gap: str = GAP) -> list[str]:
    """Lines of a table; ``align`` has one of ``<``, ``>``, ``^`` per column."""
    widths = [max((cells(row[i]) for row in rows), default=0) for i in range(len(align))]
    return [gap.join(padded(*cell) for cell in zip(row, widths, align, strict=True)).rstrip() for row in rows]
