"""Widths of text, names with indices, and the font families that an SVG names."""

from __future__ import annotations

import re
import unicodedata

from linkwright.words.characters import pieces

NARROW = frozenset("iljfI.,:;'|![]() ")
WIDE = frozenset("mwMW@%")
#: Stands for a space at which no line breaks.
_HELD = "\u2060"
_INDEX = re.compile(r"^(?P<stem>[^\W\d_]{1,2}'*)_?(?P<index>\d+'*)$")


def width(text: str, size: float) -> float:
    """Width of a line of text at a font size, estimated a little too large rather than too small."""
    return size * sum(_share(character) for character in text)


def _share(character: str) -> float:
    if unicodedata.east_asian_width(character) in "WF":
        return 1.02
    if character in NARROW:
        return 0.36
    if character in WIDE:
        return 0.98
    if character in "rt":
        return 0.42
    return 0.7 if character.isupper() else 0.64


def fold(text: str, widest: float, size: float) -> list[str]:
    """A text in lines that fit a width; a word that is wider is cut."""
    lines = [""]
    for piece in pieces(text.replace("\u00a0", _HELD)):
        rest = piece if lines[-1] else piece.lstrip()
        if lines[-1] and piece not in "？！" and width(lines[-1] + rest, size) > widest:
            lines.append("")
            rest = piece.lstrip()
        while width(rest, size) > widest:
            keep = next(k for k in range(len(rest), 0, -1) if k == 1 or width(rest[:k], size) <= widest)
            lines[-1:] = [lines[-1] + rest[:keep], ""]
            rest = rest[keep:]
        lines[-1] += rest
    return [line.replace(_HELD, "\u00a0") for line in lines]


def split_index(name: str) -> tuple[str, str]:
    """``O1`` is O with the index 1; other names have no index."""
    found = _INDEX.match(name)
    return (found["stem"], found["index"]) if found else (name, "")


FAMILIES = (
    "Noto Sans", "DejaVu Sans", "Segoe UI", "Helvetica Neue", "Arial",
    "Noto Sans SC", "Noto Sans CJK SC", "Source Han Sans SC", "Microsoft YaHei", "PingFang SC",
    "WenQuanYi Micro Hei", "sans-serif",
)  # fmt: skip
FAMILY_LIST = ", ".join(f"'{name}'" if " " in name else name for name in FAMILIES)
