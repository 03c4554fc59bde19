"""From text to nodes: the events of the YAML parser composed into a tree, no deeper than a model can be."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from yaml.error import YAMLError
from yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

from linkwright.fields.nodes import MAX_DEPTH, MAX_NODES, Entry, Mapping, Node, Remark, Scalar, Sequence
from linkwright.files.events import Source, event_reader
from linkwright.files.syntax import accident_remarks, explain, tab_remarks, wide_remarks
from linkwright.words import Message, _
from linkwright.words.characters import UNFIT

_KINDS = ("str", "int", "float", "map", "seq", "null")
_HARMLESS_TAGS = frozenset(("!", *(f"tag:yaml.org,2002:{kind}" for kind in _KINDS)))
_INNER_TAB = re.compile(r"(?<=\S)\t|(?<=\S )\t")


def compose(text: str) -> tuple[Node | None, list[Remark]]:
    """The tree of the first document of a text, and what is wrong with the text itself.

    The tree is None where the text is empty or cannot be read.
    """
    if accidents := accident_remarks(text):
        return None, accidents
    plain = text
    if "\t" in text:
        flow = text.lstrip("\ufeff \t\r\n").startswith(("{", "["))
        plain = text.replace("\t", " ") if flow else _INNER_TAB.sub(" ", text)
    source = Source(plain)
    while True:
        composer = _Composer()
        try:
            composer.documents(event_reader(source.text))
        except _Stop:
            return None, composer.remarks
        except YAMLError as error:
            mark = getattr(error, "problem_mark", None)
            if mark is not None and source.part(mark.index):
                continue
            return None, [
                *composer.remarks,
                *(tab_remarks(text) or wide_remarks(text) or [explain(error, text)]),
            ]
        except (ValueError, OverflowError) as error:
            return None, [_unreadable(error)]
        if composer.root is not None:
            source.restore(composer.root)
        return composer.root, composer.remarks


def _unreadable(error: Exception) -> Remark:
    message = _("the file cannot be read as YAML ({name})", name=type(error).__name__)
    return Remark(0, 0, message, _("check quotes, brackets and escapes"), "syntax")


class _Stop(Exception):
    """Reading further makes no sense."""


class _Composer:
    """Makes nodes of events; what is wrong with the text becomes remarks."""

    def __init__(self) -> None:
        self.next: Callable[[], Any]
        self.remarks: list[Remark] = []
        self.root: Node | None = None
        self.anchors: dict[str, tuple[Node, int]] = {}
        self.open: list[str] = []
        self.total = 0
        self.path: list[str] = []

    def remark(self, mark: Any, message: Message, remedy: Message, code: str, **values: object) -> None:
        """Note a remark with the values of its texts."""
        text, what_to_do = message.format(**values), remedy.format(**values)
        self.remarks.append(Remark(mark.line, mark.column, text, what_to_do, code, ".".join(self.path)))

    def documents(self, next_event: Callable[[], Any]) -> None:
        self.next, count = next_event, 0
        while not isinstance(event := self.next(), StreamEndEvent):
            if isinstance(event, DocumentStartEvent):
                count += 1
                if count > 1:
                    self.remark(
                        event.start_mark,
                        _("a second document begins here"),
                        _("one file holds one model: remove the --- and what follows"),
                        "documents",
                    )
                    raise _Stop
                self.root = self.node(self.next(), 0)

    def node(self, event: Any, depth: int) -> Node:
        kind = type(event)
        if kind is ScalarEvent and event.anchor is None and event.tag is None and depth <= MAX_DEPTH:
            return self.scalar(event)
        if kind is AliasEvent:
            return self.alias(event)
        if depth > MAX_DEPTH:
            self.remark(
                event.start_mark,
                _("nested deeper than {most} levels"),
                _("a model needs at most ten"),
                "depth",
                most=MAX_DEPTH,
            )
            raise _Stop
        if event.tag is not None:
            self.tag(event)
        anchor = event.anchor
        if anchor is None:
            return self.content(kind, event, depth)
        before = self.total
        self.open.append(anchor)
        node = self.content(kind, event, depth)
        self.open.remove(anchor)
        self.anchors[anchor] = node, self.total - before
        return node

    def content(self, kind: type, event: Any, depth: int) -> Node:
        if kind is ScalarEvent:
            return self.scalar(event)
        self.grow(event.start_mark, 1)
        return self.sequence(event, depth) if kind is SequenceStartEvent else self.mapping(event, depth)

    def tag(self, event: Any) -> None:
        if event.tag not in _HARMLESS_TAGS and event.implicit is not True:
            shown = event.tag.replace("tag:yaml.org,2002:", "!!")
            self.remark(
                event.start_mark,
                _('the tag "{shown}" is not supported'),
                _("remove the tag"),
                "tag",
                shown=shown,
            )

    def alias(self, event: Any) -> Node:
        name, start, end = event.anchor, event.start_mark, event.end_mark
        if name in self.anchors:
            node, size = self.anchors[name]
            self.grow(start, size)
            return node
        problem = (
            _('the alias "*{name}" is inside its own anchor')
            if name in self.open
            else _('the alias "*{name}" has no anchor "&{name}" before it')
        )
        self.remark(start, problem, _("write the value itself"), "alias", name=name)
        return Scalar(start.line, start.column, start.index, end.index, "")

    def grow(self, mark: Any, size: int) -> None:
        self.total += size
        if self.total > MAX_NODES:
            self.remark(
                mark,
                _("the file holds too many values"),
                _("a model needs far fewer; remove aliases"),
                "size",
            )
            raise _Stop

    def scalar(self, event: Any) -> Scalar:
        start, text = event.start_mark, event.value
        self.total += 1
        if self.total > MAX_NODES:
            self.grow(start, 0)
        if unfit := UNFIT.search(text):
            shown = f"U+{ord(unfit[0]):04X}"
            self.remark(
                start,
                _("the text holds the control character {shown}"),
                _("remove it: a model is plain text"),
                "control-character",
                shown=shown,
            )
            text = UNFIT.sub("\ufffd", text)
        return Scalar(start.line, start.column, start.index, event.end_mark.index, text, not event.style)

    def sequence(self, event: Any, depth: int) -> Sequence:
        start, items, path = event.start_mark, list[Node](), self.path
        while type(inner := self.next()) is not SequenceEndEvent:
            path.append(str(len(items)))
            items.append(self.node(inner, depth + 1))
            path.pop()
        return Sequence(start.line, start.column, start.index, inner.end_mark.index, items, event.flow_style)

    def mapping(self, event: Any, depth: int) -> Mapping:
        start = event.start_mark
        found = Mapping(start.line, start.column, start.index, start.index, [], event.flow_style)
        first: dict[str, Entry] = {}
        merged: list[Node] = []
        while type(inner := self.next()) is not MappingEndEvent:
            key = self.node(inner, depth + 1)
            self.path.append(key.text if isinstance(key, Scalar) else "?")
            value = self.node(self.next(), depth + 1)
            if isinstance(key, Scalar) and key.text == "<<" and key.plain:
                merged.append(value)
            else:
                self.entry(found, key, value, first)
            self.path.pop()
        found.end = inner.end_mark.index
        for value in merged:
            self.merge(found, value)
        return found

    def entry(self, found: Mapping, key: Node, value: Node, known: dict[str, Entry]) -> None:
        nothing = isinstance(value, Scalar) and value.empty
        if isinstance(key, Scalar) and key.plain and key.text.endswith(":") and nothing:
            key.text = key.text.rstrip(":")
        if not isinstance(key, Scalar):
            self.remark(key, _("a key must be a single word"), _("write key: value"), "key")
        elif first := known.get(key.text):
            self.remark(
                key,
                _('duplicate key "{text}"'),
                _("it is already in line {line}; remove or rename one"),
                "duplicate-key",
                text=key.text,
                line=first.key.line + 1,
            )
            if isinstance(first.value, Scalar) and first.value.empty:
                first.value = value
            else:
                found.repeated.append(Entry(key, value))
        else:
            known[key.text] = Entry(key, value)
            found.entries.append(known[key.text])

    def merge(self, found: Mapping, value: Node) -> None:
        have = {entry.key.text for entry in found.entries}
        sources = value.items if isinstance(value, Sequence) else [value]
        for source in sources:
            if not isinstance(source, Mapping):
                self.remark(
                    source,
                    _("a merge key (<<) needs a mapping"),
                    _("refer to an anchor of a mapping"),
                    "merge",
                )
                continue
            found.entries += [entry for entry in source.entries if entry.key.text not in have]
            have.update(entry.key.text for entry in source.entries)
