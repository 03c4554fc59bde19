"""From text to nodes: the events of the YAML reader composed into a tree, without recursion into the
unknown."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from linkwright.model.nodes import MAX_DEPTH, MAX_NODES, Entry, Mapping, Node, Remark, Scalar, Sequence
from linkwright.model.syntax import explain, tab_remarks

_HARMLESS_TAGS = (
    "tag:yaml.org,2002:str",
    "tag:yaml.org,2002:int",
    "tag:yaml.org,2002:float",
    "tag:yaml.org,2002:map",
    "tag:yaml.org,2002:seq",
    "tag:yaml.org,2002:null",
    "!",
)

_INNER_TAB = re.compile(r"(?<=\S)\t|(?<=\S )\t")


def compose(text: str) -> tuple[Node | None, list[Remark]]:
    """The tree of the first document of a text, and what is wrong with the text itself.

    The tree is None where the text is empty or cannot be read.
    """
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    flow = text.lstrip("\ufeff \t\r\n").startswith(("{", "["))
    source = text.replace("\t", " ") if flow else _INNER_TAB.sub(" ", text)
    composer = _Composer()
    try:
        composer.documents(iter(YAML(typ="safe", pure=True).parse(source)))
    except _Stop:
        return None, composer.remarks
    except YAMLError as error:
        return None, [*composer.remarks, *(tab_remarks(text) or [explain(error, text)])]
    except (ValueError, OverflowError, IndexError, KeyError, AssertionError, RecursionError) as error:
        return None, [
            *composer.remarks,
            Remark(
                0,
                0,
                f"the file cannot be read as YAML ({type(error).__name__})",
                "check quotes, brackets and escapes",
                "syntax",
            ),
        ]
    return composer.root, composer.remarks


class _Stop(Exception):
    """Reading further makes no sense."""


class _Composer:
    def __init__(self) -> None:
        self.remarks: list[Remark] = []
        self.root: Node | None = None
        self.anchors: dict[str, Node] = {}
        self.open: list[str] = []
        self.sizes: dict[int, int] = {}
        self.keep: list[Node] = []
        self.total = 0
        self.path: list[str] = []

    def remark(self, mark: Any, message: str, remedy: str, code: str) -> None:
        self.remarks.append(Remark(mark.line, mark.column, message, remedy, code, ".".join(self.path)))

    def documents(self, events: Iterator[Any]) -> None:
        count = 0
        for event in events:
            kind = type(event).__name__
            if kind == "DocumentStartEvent":
                count += 1
                if count > 1:
                    self.remark(
                        event.start_mark,
                        "a second document begins here",
                        "one file holds one model: remove the --- and what follows",
                        "documents",
                    )
                    raise _Stop
            elif kind not in ("StreamStartEvent", "StreamEndEvent", "DocumentEndEvent"):
                self.root = self.node(event, events, 0)

    def node(self, event: Any, events: Iterator[Any], depth: int) -> Node:
        kind = type(event).__name__
        if kind == "AliasEvent":
            return self.alias(event)
        if depth > MAX_DEPTH:
            self.remark(
                event.start_mark,
                f"nested deeper than {MAX_DEPTH} levels",
                "a model needs at most ten",
                "depth",
            )
            raise _Stop
        self.tag(event)
        anchor = str(event.anchor) if event.anchor else ""
        if anchor:
            self.open.append(anchor)
        node: Node
        if kind == "ScalarEvent":
            node = self.scalar(event)
        elif kind == "SequenceStartEvent":
            node = self.sequence(event, events, depth)
        else:
            node = self.mapping(event, events, depth)
        if anchor:
            self.open.remove(anchor)
            self.anchors[anchor] = node
        return node

    def tag(self, event: Any) -> None:
        tag = str(event.tag) if event.tag is not None else ""
        if tag and tag not in _HARMLESS_TAGS and getattr(event, "implicit", False) is not True:
            shown = tag.replace("tag:yaml.org,2002:", "!!")
            self.remark(event.start_mark, f'the tag "{shown}" is not supported', "remove the tag", "tag")

    def alias(self, event: Any) -> Node:
        name = str(event.anchor)
        start, end = event.start_mark, event.end_mark
        if name in self.anchors:
            self.grow(start, self.sizes.get(id(self.anchors[name]), 1))
            return self.anchors[name]
        inside = name in self.open
        self.remark(
            start,
            f'the alias "*{name}" stands inside its own anchor'
            if inside
            else f'the alias "*{name}" has no anchor "&{name}" before it',
            "write the value itself",
            "alias",
        )
        return Scalar(start.line, start.column, start.index, end.index, "")

    def grow(self, mark: Any, size: int) -> None:
        self.total = self.total + size
        if self.total > MAX_NODES:
            self.remark(
                mark, "the file holds too many values", "a model needs far fewer; remove aliases", "size"
            )
            raise _Stop

    def scalar(self, event: Any) -> Scalar:
        start, end = event.start_mark, event.end_mark
        self.grow(start, 1)
        plain = not event.style
        return Scalar(start.line, start.column, start.index, end.index, _whole(str(event.value)), plain)

    def sequence(self, event: Any, events: Iterator[Any], depth: int) -> Sequence:
        start, before = event.start_mark, self.total
        found = Sequence(start.line, start.column, start.index, start.index, flow=bool(event.flow_style))
        for inner in events:
            if type(inner).__name__ == "SequenceEndEvent":
                found.end = inner.end_mark.index
                break
            self.path.append(str(len(found.items)))
            found.items.append(self.node(inner, events, depth + 1))
            self.path.pop()
        self.measure(found, start, before)
        return found

    def measure(self, node: Node, mark: Any, before: int) -> None:
        self.grow(mark, 1)
        self.sizes[id(node)] = self.total - before
        self.keep.append(node)

    def mapping(self, event: Any, events: Iterator[Any], depth: int) -> Mapping:
        start, before = event.start_mark, self.total
        found = Mapping(start.line, start.column, start.index, start.index, flow=bool(event.flow_style))
        seen: dict[str, Scalar] = {}
        merged: list[Node] = []
        for inner in events:
            if type(inner).__name__ == "MappingEndEvent":
                found.end = inner.end_mark.index
                break
            key = self.node(inner, events, depth + 1)
            self.path.append(key.text if isinstance(key, Scalar) else "?")
            value = self.node(next(events), events, depth + 1)
            if isinstance(key, Scalar) and key.text == "<<" and key.plain:
                merged.append(value)
            else:
                self.entry(found, key, value, seen)
            self.path.pop()
        for value in merged:
            self.merge(found, value)
        self.measure(found, start, before)
        return found

    def entry(self, found: Mapping, key: Node, value: Node, seen: dict[str, Scalar]) -> None:
        if isinstance(key, Scalar) and key.plain and key.text.endswith(":") and _nothing(value):
            key.text = key.text.rstrip(":")
        if not isinstance(key, Scalar):
            self.remark(key, "a key must be a single word", "write key: value", "key")
        elif key.text in seen:
            self.remark(
                key,
                f'the key "{key.text}" is given twice',
                f"it stands in line {seen[key.text].line + 1} already; remove or rename one",
                "duplicate-key",
            )
        else:
            seen[key.text] = key
            found.entries.append(Entry(key, value))

    def merge(self, found: Mapping, value: Node) -> None:
        sources = value.items if isinstance(value, Sequence) else [value]
        for source in sources:
            if not isinstance(source, Mapping):
                self.remark(
                    source, "a merge key (<<) needs a mapping", "refer to an anchor of a mapping", "merge"
                )
                continue
            have = {entry.key.text for entry in found.entries}
            found.entries.extend(entry for entry in source.entries if entry.key.text not in have)


def _whole(text: str) -> str:
    """The text with the halves of escaped characters (JSON's surrogates) joined, a lone half replaced."""
    if any("\ud800" <= char <= "\udfff" for char in text):
        return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")
    return text


def _nothing(value: Node) -> bool:
    return isinstance(value, Scalar) and value.empty
