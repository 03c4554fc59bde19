"""Widths of text, names with indices, and the font families that an SVG names."""

from __future__ import annotations

import re
import unicodedata

from linkwright.pictures.svg.element import Attribute, Element, element

NARROW = frozenset("iljfI.,:;'|![]() ")
WIDE = frozenset("mwMW@%")
_SYMBOL = re.compile(r"(?<![A-Za-z0-9_])([FMμ])_([A-Za-z]+(?:,[^\s,，、；;]+)?)")
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


def name_width(name: str, size: float, index: str = "") -> float:
    """Width of a name whose index is set small."""
    stem, low = (name, index) if index else split_index(name)
    return width(stem, size) + width(low, 0.7 * size)


def text_element(
    x: float,
    y: float,
    name: str,
    style: str,
    size: float,
    anchor: str = "start",
    *,
    index: str = "",
    rest: str = "",
) -> Element:
    """A line of text with its baseline at (x, y); a trailing number of a short name is set as an index.

    ``index``: another index behind the name; ``rest``: text behind it on the line.
    """
    stem, low = (name, index) if index else split_index(name)
    content: list[Element | str] = [stem]
    if low:
        content.append(element("tspan", {"dy": 0.25 * size, "font-size": 0.7 * size}, low))
    if rest:
        content.append(element("tspan", {"dy": -0.25 * size, "xml:space": "preserve"}, rest) if low else rest)
    side = None if anchor == "start" else anchor
    place: dict[str, Attribute | None] = {
        "class": style,
        "x": x,
        "y": y,
        "font-size": size,
        "text-anchor": side,
    }
    return element("text", place, *content)


def sentence_element(
    x: float, y: float, text: str, style: str, size: float, anchor: str = "start"
) -> Element:
    """A line of text as it is, but for symbols such as ``M_d`` and ``μ_F``, whose indices are set low."""
    content: list[Element | str] = []
    parts = _SYMBOL.split(text)
    for before, letter, low in zip(parts[::3], [*parts[1::3], ""], [*parts[2::3], ""], strict=True):
        plain = before + letter
        if content and plain:
            content.append(element("tspan", {"dy": -0.25 * size, "xml:space": "preserve"}, plain))
        elif plain:
            content.append(plain)
        if low:
            content.append(element("tspan", {"dy": 0.25 * size, "font-size": 0.75 * size}, low))
    side = None if anchor == "start" else anchor
    return element("text", {"class": style, "x": x, "y": y, "font-size": size, "text-anchor": side}, *content)


FAMILIES = (
    "Noto Sans", "DejaVu Sans", "Segoe UI", "Helvetica Neue", "Arial",
    "Noto Sans SC", "Noto Sans CJK SC", "Source Han Sans SC", "Microsoft YaHei", "PingFang SC",
    "WenQuanYi Micro Hei", "sans-serif",
)  # fmt: skip
FAMILY_LIST = ", ".join(f"'{name}'" if " " in name else name for name in FAMILIES)
