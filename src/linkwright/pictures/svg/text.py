"""Widths of text, names with indices, and the font families that an SVG names."""

from __future__ import annotations

import re
import unicodedata

NARROW = frozenset("iljfI.,:;'|![]() ")
WIDE = frozenset("mwMW@%")
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
