"""A text as nested values as they are written, and the lines where its entries stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from linkwright.core.data import Plain
from linkwright.fields.nodes import Mapping, Node, Scalar, Sequence
from linkwright.files.compose import compose


def outline(text: str) -> Plain:
    """``entries``: all values as texts, lists and mappings; ``lines``: by path ("links.crank") from 1; both are
    empty for a text that cannot be read."""
    root, _unused = compose(text.removeprefix("\ufeff"))
    if not isinstance(root, Mapping):
        return {"entries": {}, "lines": {}}
    return {"entries": outlined(root), "lines": dict(_lines(root, ""))}


def outlined(node: Node) -> Any:
    """A value as plain data, texts as they are written."""
    if isinstance(node, Mapping):
        return {key: outlined(value) for key, value in node}
    if isinstance(node, Sequence):
        return [outlined(each) for each in node.items]
    return node.text if isinstance(node, Scalar) else ""


def _lines(node: Mapping, path: str) -> Iterator[tuple[str, int]]:
    for entry in node.entries:
        here = f"{path}{entry.key.text}"
        yield here, entry.key.line + 1
        if isinstance(entry.value, Mapping):
            yield from _lines(entry.value, f"{here}.")
