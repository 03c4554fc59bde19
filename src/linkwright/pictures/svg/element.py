"""Elements of an SVG document as immutable values, written as valid XML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.words.characters import printable

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
