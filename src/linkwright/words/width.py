"""Width of texts on a terminal, where a Chinese character takes two cells."""

from __future__ import annotations


def cells(text: str) -> int:
    """Cells that a text takes: two for a wide (Chinese) character, none for a combining one."""
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(c) else 2 if east_asian_width(c) in "WF" else 1 for c in text)


def filled(text: str, width: int) -> str:
    """The text with spaces behind it, up to a width in cells."""
    return text + " " * (width - cells(text))
