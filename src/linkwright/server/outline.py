"""A text as nested values as they are written, and the lines where its entries stand."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.data import Plain
from linkwright.fields.nodes import Mapping, Node, Scalar, Sequence
from linkwright.files.compose import compose


def outline(text: str) -> Plain:
    """``entries``: all values as texts, lists and mappings; ``lines``: by path ("links.crank") from 1; both are
    empty for a text that cannot be read."""
    root, _unused = compose(text.removeprefix("\ufeff"))
    if not isinstance(root, Mapping):
        return {"entries": {}, "lines": {}}
    return {"entries": _value(root), "lines": dict(_lines(root, ""))}


def _value(node: Node) -> Plain | list[object] | str:
    if isinstance(node, Mapping):
        return {key: _value(value) for key, value in node}
    if isinstance(node, Sequence):
        return [_value(each) for each in node.items]
    return node.text if isinstance(node, Scalar) else ""


def _lines(node: Mapping, path: str) -> Iterator[tuple[str, int]]:
    for entry in node.entries:
        here = f"{path}{entry.key.text}"
        yield here, entry.key.line + 1
        if isinstance(entry.value, Mapping):
            yield from _lines(entry.value, f"{here}.")
