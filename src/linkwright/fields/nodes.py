"""The tree of a YAML or JSON text, every node with its place, read without ever making Python objects of
tags.

Problems (duplicate keys, tags, a second document, too deep nesting) become remarks, not exceptions.
"""

from __future__ import annotations

import re
from collections import abc
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from linkwright import units
from linkwright.core.data import FrozenDict, frozen
from linkwright.errors import Finding
from linkwright.words import _

MAX_DEPTH, MAX_NODES = 40, 30_000
_PLACED = re.compile(r":\d+:\d+$")
_NULLS = frozenset(("", "~", "null", "Null", "NULL"))


@dataclass(slots=True)
class Node:
    """A value in the text: line and column count from 0, ``start`` and ``end`` are character offsets."""

    line: int
    column: int
    start: int
    end: int


@dataclass(slots=True)
class Scalar(Node):
    """A word, number or text; ``plain`` where it was written without quotes."""

    text: str
    plain: bool = True

    @property
    def empty(self) -> bool:
        """Whether no value is written."""
        return self.plain and self.text in _NULLS


@dataclass(slots=True)
class Sequence(Node):
    """A list."""

    items: list[Node] = field(default_factory=list)
    flow: bool = False


@dataclass(slots=True)
class Entry:
    """A key and its value."""

    key: Scalar
    value: Node


@dataclass(slots=True)
class Mapping(Node):
    """Keys and values in the order of the text; a key occurs once, ``repeated`` are entries whose key was there."""

    entries: list[Entry] = field(default_factory=list)
    flow: bool = False
    repeated: list[Entry] = field(default_factory=list)
    _index: dict[str, Node] = field(default_factory=dict, init=False, repr=False, compare=False)

    def get(self, key: str) -> Node | None:
        """The value of a key, or None."""
        if len(self._index) != len(self.entries):
            self._index = {entry.key.text: entry.value for entry in self.entries}
        return self._index.get(key)

    def __iter__(self) -> Iterator[tuple[str, Node]]:
        return iter([(entry.key.text, entry.value) for entry in self.entries])


class Section(FrozenDict[str, Any]):
    """A section that is stored as plain data, with its ``node`` and the reader's ``source``; a copy is data alone."""

    def __init__(self, values: abc.Mapping[str, Any], node: Mapping, source: str) -> None:
        super().__init__(frozen(values))
        self.node, self.source = node, source


@dataclass(frozen=True)
class Remark:
    """A problem of the text itself at a place of it."""

    line: int
    column: int
    message: str
    remedy: str
    code: str
    key: str = ""


def towards(node: Node | None, path: str) -> Node | None:
    """The node at a dotted path, whose keys may have dots themselves, or the last one on the way there."""
    parts = path.split(".")
    while parts:
        if isinstance(node, Sequence):
            place = int(parts[0]) if parts[0].isdecimal() else len(node.items)
            below, length = (node.items[place] if place < len(node.items) else None), 1
        elif isinstance(node, Mapping):
            keys = (".".join(parts[:k]) for k in range(len(parts), 0, -1))
            key = next((each for each in keys if node.get(each) is not None), parts[0])
            below, length = node.get(key), key.count(".") + 1
        else:
            return node
        if below is None:
            return node
        node, parts = below, parts[length:]
    return node


def located(finding: Finding, root: Node | None, name: str) -> Finding:
    """A finding with line and column of its key in the text of a root, unless it has them."""
    node = towards(root, finding.key) if finding.key and not _PLACED.search(finding.where) else None
    return finding if node is None else replace(finding, where=f"{name}:{node.line + 1}:{node.column + 1}")


def below(node: Node | None, *keys: str) -> Node | None:
    """The node at a path of keys; None where there is none."""
    for key in keys:
        node = node.get(key) if isinstance(node, Mapping) else None
    return node


def noun(node: Node | None) -> str:
    """What the node is, in words, for messages."""
    if isinstance(node, Mapping):
        return _("a mapping (key: value)")
    if isinstance(node, Sequence):
        return _("a list", code="model.a_list")
    if node is None or (isinstance(node, Scalar) and node.empty):
        return _("nothing", code="model.nothing")
    return _("a single value")


def node_of(value: Any) -> Node:
    """The node of plain data; texts are as in quotes."""
    if isinstance(value, abc.Mapping):
        return Mapping(
            0, 0, 0, 0, [Entry(Scalar(0, 0, 0, 0, str(key)), node_of(each)) for key, each in value.items()]
        )
    if isinstance(value, str):
        return Scalar(0, 0, 0, 0, value, plain=False)
    if isinstance(value, bool):
        return Scalar(0, 0, 0, 0, "true" if value else "false")
    if value is None:
        return Scalar(0, 0, 0, 0, "null")
    if isinstance(value, int):
        return Scalar(0, 0, 0, 0, str(value))
    if isinstance(value, abc.Iterable):
        return Sequence(0, 0, 0, 0, [node_of(each) for each in value])
    try:
        return Scalar(0, 0, 0, 0, units.number(float(value)))
    except (TypeError, ValueError):
        return Scalar(0, 0, 0, 0, str(value), plain=False)
