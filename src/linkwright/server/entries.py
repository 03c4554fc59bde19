"""What entries of a text say, read word by word: a text that need not be a model yet."""

from __future__ import annotations

import math
from collections.abc import Iterable

from linkwright.core.expressions import amount
from linkwright.errors import QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence


def word(entry: MappingNode, key: str) -> str:
    """The text of a key; "" where there is none."""
    node = entry.get(key)
    return node.text if isinstance(node, Scalar) else ""


def fresh(stem: str, known: Iterable[str]) -> str:
    """The first of stem1, stem2, … that is not known."""
    place, taken = 1, set(known)
    while f"{stem}{place}" in taken:
        place += 1
    return f"{stem}{place}"


def texts(node: Node | None) -> list[str]:
    """The scalars of a list."""
    items = node.items if isinstance(node, Sequence) else []
    return [each.text for each in items if isinstance(each, Scalar)]


def places(node: Node | None) -> dict[str, list[float]]:
    found = {}
    for name, place in node if isinstance(node, MappingNode) else ():
        try:
            found[name] = [amount(text, "length") for text in texts(place)]
        except QuantityError:
            continue
    return {name: place for name, place in found.items() if len(place) == 2}


def section(root: Node | None, *keys: str) -> MappingNode | None:
    """The mapping at a path of keys."""
    for key in keys:
        root = root.get(key) if isinstance(root, MappingNode) else None
    return root if isinstance(root, MappingNode) else None


def points_of(link: Node | None) -> list[str]:
    """The points of a link's entry, those of ``also`` last."""
    if not isinstance(link, MappingNode):
        return []
    points, also = link.get("points"), section(link, "also")
    names = [name for name, _unused in points] if isinstance(points, MappingNode) else texts(points)
    return [*names, *(point for point, _unused in also or ())]


def extent(places: Iterable[list[float]]) -> float:
    """Diagonal of a drawing, m."""
    axes = [*zip(*places, strict=True)]
    return math.hypot(*(max(each) - min(each) for each in axes))
