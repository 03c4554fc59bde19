"""Texts as a terminal or a table can carry them."""

from __future__ import annotations

import re

#: Characters that no text should hold: control characters, halves of pairs, and what Unicode keeps free.
UNFIT = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")
_UNPRINTABLE = re.compile(rf"(?!\x1b\[[0-9;]*m|\r\x1b\[K){UNFIT.pattern}")
_FORMULA = re.compile(r"[=+\-@\t\r]")


def terminal_text(text: str) -> str:
    """The text for a terminal: unfit characters replaced; the codes of colours may pass."""
    return _UNPRINTABLE.sub("\ufffd", text)


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
