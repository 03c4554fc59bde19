"""Texts as a terminal or a table can carry them, and how wide they are there."""

from __future__ import annotations

import re
from collections.abc import Sequence

#: Characters that no text should hold: control characters, halves of pairs, and what Unicode keeps free.
UNFIT = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")
_FORMULA = re.compile(r"[=+\-@\t\r]")
#: What stays together where lines break: a word with a number before it, up to a plus or dash; a Chinese character;
#: and the Chinese punctuation behind.
_PIECE = r"\s*(?:\d[\d.]* )?(?:[\u2e80-\uffef]|[^\s+–\u2e80-\uffef]*[+–]|[^\s+–\u2e80-\uffef]+)[，。；：、）]*"


def terminal_text(text: str) -> str:
    """The text for a terminal: unfit characters replaced."""
    return UNFIT.sub("\ufffd", text)


def cell_text(text: str) -> str:
    """The text as a cell of a table that spreadsheets open: an apostrophe before what they would take for a formula.

    Numbers are no texts and stay as they are.
    """
    return f"'{text}" if _FORMULA.match(text) else text


def printable(text: str) -> str:
    """A text without what neither XML nor a font can hold; tabs and line ends stay."""
    return UNFIT.sub("", text)


def one_line(text: str) -> str:
    """A printable text on one line."""
    return " ".join(printable(text).split())


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


def pieces(text: str) -> list[str]:
    """What a text consists of where lines may break, each with the blanks before it."""
    return re.findall(_PIECE, text)


def folded(text: str, width: int) -> list[str]:
    """A text in lines of at most so many cells; a wider word is not split."""
    if cells(text) <= width:
        return [text]
    lines = [""]
    for piece in pieces(text):
        if lines[-1] and cells(lines[-1] + piece) > width:
            lines.append("")
        lines[-1] += piece if lines[-1] else piece.lstrip()
    return lines
