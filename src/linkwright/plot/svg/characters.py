"""Characters that a file or a font can hold."""

from __future__ import annotations

from linkwright.words.carried import UNFIT


def printable(text: str) -> str:
    """A text without what neither XML nor a font can hold; tabs and line ends stay."""
    return UNFIT.sub("", text)


def one_line(text: str) -> str:
    """A printable text on one line."""
    return " ".join(printable(text).split())
