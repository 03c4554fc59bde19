"""From text to nodes: the tree of a YAML text with the place of every value, no deeper than a model can be.

By libyaml where its parser in C is there. ``BaseLoader`` leaves every scalar a text: what it means is decided by the
rules of YAML 1.2; no tag makes an object.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from itertools import accumulate
from typing import Any

import yaml
from yaml.composer import ComposerError
from yaml.error import YAMLError
from yaml.nodes import MappingNode, ScalarNode, SequenceNode

from linkwright.fields.nodes import MAX_DEPTH, MAX_NODES, Entry, Mapping, Node, Remark, Scalar, Sequence
from linkwright.files.syntax import accident_remarks, explain, tab_remarks, wide_remarks
from linkwright.words import Message, _
from linkwright.words.characters import UNFIT

_HARMLESS_TAGS = frozenset(f"tag:yaml.org,2002:{kind}" for kind in ("str", "int", "float", "map", "seq", "null"))
_INNER_TAB = re.compile(r"(?<=\S)\t|(?<=\S )\t")
_NAME = re.compile(r"[&*]([^\s,\[\]{}]*)")
_SECOND = "another document"
#: What the composer refuses, by a part of its complaint.
_REFUSED = {
    _SECOND: (_("a second document begins here"), _("one file holds one model: remove the --- and what follows")),
    "undefined alias": (_('the alias "*{name}" has no anchor "&{name}" before it'), _("write the value itself")),
    "second occurrence": (_('the anchor "&{name}" is given twice'), _("give every anchor a name of its own")),
}


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
        converter = _Converter(source.text)
        try:
            found = root_node(source.text)
            root = None if found is None else converter.node(found)
        except Refused as error:
            return None, [*converter.remarks, error.remark]
        except ComposerError as error:
            return None, [_refused(error, source.text)]
        except YAMLError as error:
            mark = getattr(error, "problem_mark", None)
            if mark is not None and source.part(mark.index):
                continue
            return None, tab_remarks(text) or wide_remarks(text) or [explain(error, text)]
        except (ValueError, OverflowError) as error:
            return None, [_unreadable(error)]
        if root is not None:
            source.restore(root)
        return root, converter.remarks


def _unreadable(error: Exception) -> Remark:
    message = _("the file cannot be read as YAML ({name})", name=type(error).__name__)
    return Remark(0, 0, message, _("check quotes, brackets and escapes"), "syntax")


def _refused(error: ComposerError, text: str) -> Remark:
    """The remark about what is YAML but makes no tree."""
    mark = error.problem_mark
    message, remedy = next(each for sign, each in _REFUSED.items() if sign in error.problem)
    code = "documents" if _SECOND in error.problem else "alias"
    return Remark(mark.line, mark.column, message.format(name=_name(text, mark)), remedy.format(), code)


def _name(text: str, mark: Any) -> str:
    """The name of the anchor or alias at a place."""
    found = _NAME.search(text, mark.index)
    return found[1] if found else ""


class _Converter:
    """Makes our nodes of PyYAML's; what is wrong becomes remarks."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.remarks: list[Remark] = []
        self.made: dict[int, tuple[Node, int]] = {}
        self.open: set[int] = set()
        self.total = 0
        self.path: list[str] = []

    def remark(self, place: Any, message: Message, remedy: Message, code: str, **values: object) -> None:
        """Note a remark with the values of its texts."""
        texts = message.format(**values), remedy.format(**values)
        self.remarks.append(Remark(place.line, place.column, *texts, code, ".".join(self.path)))

    def node(self, found: Any) -> Node:
        own, start = id(found), found.start_mark
        if own in self.made:
            node, size = self.made[own]
            self.total += size
            check_count(self.total, start)
            return node
        if own in self.open:
            self.remark(
                start,
                _('the alias "*{name}" is inside its own anchor'),
                _("write the value itself"),
                "alias",
                name=_name(self.text, start),
            )
            return Scalar(start.line, start.column, start.index, start.index, "")
        if found.tag not in _HARMLESS_TAGS:
            shown = found.tag.replace("tag:yaml.org,2002:", "!!")
            self.remark(start, _('the tag "{shown}" is not supported'), _("remove the tag"), "tag", shown=shown)
        before = self.total
        self.total += 1
        self.open.add(own)
        kinds = {ScalarNode: self.scalar, SequenceNode: self.sequence, MappingNode: self.mapping}
        node = kinds[type(found)](found)
        self.open.remove(own)
        self.made[own] = node, self.total - before
        return node

    def scalar(self, found: ScalarNode) -> Scalar:
        start, text = found.start_mark, found.value
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
        return Scalar(start.line, start.column, start.index, found.end_mark.index, text, not found.style)

    def sequence(self, found: SequenceNode) -> Sequence:
        start, items = found.start_mark, list[Node]()
        for number, item in enumerate(found.value):
            self.path.append(str(number))
            items.append(self.node(item))
            self.path.pop()
        return Sequence(start.line, start.column, start.index, found.end_mark.index, items, found.flow_style)

    def mapping(self, found: MappingNode) -> Mapping:
        start = found.start_mark
        made = Mapping(start.line, start.column, start.index, found.end_mark.index, [], found.flow_style)
        first_entries: dict[str, Entry] = {}
        merged: list[Node] = []
        for key_node, value_node in found.value:
            key = self.node(key_node)
            self.path.append(key.text if isinstance(key, Scalar) else "?")
            value = self.node(value_node)
            if isinstance(key, Scalar) and key.text == "<<" and key.plain:
                merged.append(value)
            else:
                self.entry(made, key, value, first_entries)
            self.path.pop()
        for value in merged:
            self.merge(made, value)
        return made

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
                    source, _("a merge key (<<) needs a mapping"), _("refer to an anchor of a mapping"), "merge"
                )
                continue
            found.entries += [entry for entry in source.entries if entry.key.text not in have]
            have.update(entry.key.text for entry in source.entries)


#: What libyaml takes for the end of a line, and YAML 1.2 does not.
_OLD_BREAKS = re.compile("[\x85\u2028\u2029]")
#: Colons without a space that are put right in one text, at most.
MOST_SHIFTS = 20
_PAIR = re.compile(r"(?<!\\)(?:\\\\)*(\\u[dD][89abAB][0-9a-fA-F]{2})(\\u[dD][c-fC-F][0-9a-fA-F]{2})")
_BASE: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)


class Refused(Exception):
    """A text that no tree is made of, with the remark that says why."""

    def __init__(self, mark: Any, message: str, remedy: Message, *, code: str) -> None:
        self.remark = Remark(mark.line, mark.column, message, remedy.format(), code)


def check_count(count: int, mark: Any) -> None:
    """Refuse more values than a model can have."""
    if count > MAX_NODES:
        message, remedy = _("the file holds too many values"), _("a model needs far fewer; remove aliases")
        raise Refused(mark, message.format(), remedy, code="size")


class _Loader(_BASE):  # type: ignore[misc]
    """Ends where a text is too deep or too long for a model: libyaml's composer has no bounds of its own."""

    depth = count = 0

    def descend_resolver(self, parent: Any, index: Any) -> None:
        """Called before every value."""
        self.depth, self.count = self.depth + 1, self.count + 1
        if self.depth > MAX_DEPTH + 1:
            message = _("nested deeper than {most} levels", most=MAX_DEPTH)
            raise Refused(parent.start_mark, message, _("a model needs at most ten"), code="depth")
        if parent is not None:
            check_count(self.count, parent.start_mark)

    def ascend_resolver(self) -> None:
        """Called after every value."""
        self.depth -= 1


def root_node(text: str) -> Any:
    """PyYAML's node of a text's document, None where there is none; raises YAMLError and Refused."""
    return yaml.compose(_OLD_BREAKS.sub(" ", text), Loader=_Loader)


class Source:
    """A text as the parser gets it, and where its characters stood before.

    Escaped pairs (``\\ud83d\\ude00``, as JSON writes them) become one escape, two characters shorter; ``part`` puts a
    space behind a colon that libyaml takes for a part of a word.
    """

    def __init__(self, text: str) -> None:
        self._before = text
        self._shifts: list[tuple[int, int]] = []  # from this offset on, so many characters were there more
        self.text = _PAIR.sub(self._join, text) if "\\u" in text else text

    def _join(self, found: re.Match[str]) -> str:
        code = 0x10000 + ((int(found[1][2:], 16) - 0xD800) << 10) + int(found[2][2:], 16) - 0xDC00
        gone = 2 * len(self._shifts)
        self._shifts.append((found.end() - gone - 2, 2))
        return f"{found[0][:-12]}\\U{code:08x}"

    def part(self, offset: int) -> bool:
        """Whether a colon of a mapping in braces stood at the offset, and has a space behind it now."""
        behind = self.text[offset + 1 : offset + 2]
        if len(self._shifts) >= MOST_SHIFTS or self.text[offset : offset + 1] != ":" or behind not in tuple(",[]{}"):
            return False
        self.text = f"{self.text[: offset + 1]} {self.text[offset + 1 :]}"
        later = [(at + 1 if at > offset else at, shift) for at, shift in self._shifts]
        self._shifts = sorted([*later, (offset + 2, -1)])
        return True

    def restore(self, root: Node) -> None:
        """Gives every node below its place in the text as it was."""
        if not self._shifts:
            return
        offsets = [at for at, _ in self._shifts]
        sums = [0, *accumulate(shift for _, shift in self._shifts)]
        breaks = [at for at, character in enumerate(self._before) if character == "\n"]
        for node in _below(root):
            node.start += sums[bisect_right(offsets, node.start)]
            node.end += sums[bisect_right(offsets, node.end)]
            node.line = bisect_left(breaks, node.start)
            node.column = node.start - (breaks[node.line - 1] + 1 if node.line else 0)


def _below(root: Node) -> list[Node]:
    """Every node of a tree once, also where an alias makes it stand in several places."""
    found: dict[int, Node] = {}
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if id(node) not in found:
            found[id(node)] = node
            if isinstance(node, Sequence):
                waiting += node.items
            elif isinstance(node, Mapping):
                waiting += [each for entry in node.entries for each in (entry.key, entry.value)]
    return list(found.values())
