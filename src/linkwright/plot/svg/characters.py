"""Characters that a file or a font can hold."""

from __future__ import annotations

import unicodedata


def printable(text: str) -> str:
    """A text without what neither XML nor a font can hold: control characters, halves of pairs, no characters.

    Tabs and line ends stay.
    """
    return "".join(c for c in text if c in "\t\n" or not _unwritable(c))


def one_line(text: str) -> str:
    """A printable text on one line."""
    return " ".join(printable(text).split())


def _unwritable(character: str) -> bool:
    code = ord(character)
    return (
        unicodedata.category(character) in ("Cc", "Cs") or code & 0xFFFE == 0xFFFE or 0xFDD0 <= code <= 0xFDEF
    )
