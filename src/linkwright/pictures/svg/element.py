"""Elements of an SVG document as immutable values, written as valid XML; widths of texts, names with indices."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from linkwright.core.arrays import Floats
from linkwright.words.characters import pieces, printable

Attribute = str | float
_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


def number(value: float) -> str:
    """Two decimals at most, without trailing zeros."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def escape(text: str) -> str:
    """Text that XML can carry: markup characters escaped, what XML cannot hold left out."""
    return printable(text).translate(_ESCAPES)


@dataclass(frozen=True)
class Element:
    """One element: tag, attributes in order, and content: text, and what writes itself as SVG."""

    tag: str
    attributes: tuple[tuple[str, str], ...]
    content: tuple[object, ...] = ()

    def __str__(self) -> str:
        head = "".join(f' {name}="{escape(value)}"' for name, value in self.attributes)
        if not self.content:
            return f"<{self.tag}{head}/>"
        inner = "".join(escape(each) if isinstance(each, str) else str(each) for each in self.content)
        return f"<{self.tag}{head}>{inner}</{self.tag}>"

    def holding(self, *content: object) -> Element:
        """The same element with more content."""
        return Element(self.tag, self.attributes, (*self.content, *content))


def element(tag: str, attributes: Mapping[str, Attribute | None] | None = None, *content: object) -> Element:
    """An element; attributes that are None are left out, numbers are rounded."""
    pairs = tuple(
        (name, value if isinstance(value, str) else number(value))
        for name, value in (attributes or {}).items()
        if value is not None
    )
    return Element(tag, pairs, content)


def group(content: Iterable[object], style: str | None = None, **attributes: Attribute | None) -> Element:
    """A ``g`` element of the class ``style``."""
    return element("g", {"class": style, **attributes}, *content)


def coordinates(points: Floats) -> str:
    """Points (k, 2) as the text of a ``points`` attribute."""
    return " ".join(f"{number(x)},{number(y)}" for x, y in points.tolist())


def path_data(points: Floats, *, closed: bool = False) -> str:
    """Points (k, 2) as the text of a ``d`` attribute; a row of NaN starts a new stroke."""
    parts: list[str] = []
    pen_down = False
    for x, y in points.tolist():
        if x != x or y != y:
            pen_down = False
            continue
        parts.append(f"{'L' if pen_down else 'M'}{number(x)} {number(y)}")
        pen_down = True
    return "".join(parts) + ("Z" if closed and parts else "")


NARROW = frozenset("iljfI.,:;'|![]() ")
WIDE = frozenset("mwMW@%")
#: A space at which no line breaks.
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
    "Noto Sans",
    "DejaVu Sans",
    "Segoe UI",
    "Helvetica Neue",
    "Arial",
    "Noto Sans SC",
    "Noto Sans CJK SC",
    "Source Han Sans SC",
    "Microsoft YaHei",
    "PingFang SC",
    "WenQuanYi Micro Hei",
    "sans-serif",
)
FAMILY_LIST = ", ".join(f"'{name}'" if " " in name else name for name in FAMILIES)
