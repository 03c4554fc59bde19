"""A model file that can be changed in place: everything that is not changed stays as the user wrote it."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection
from pathlib import Path
from typing import NamedTuple

from linkwright.errors import Finding, LinkwrightError, ModelError, with_remedy
from linkwright.fields.nodes import Entry, Mapping, Node, Scalar, Sequence, located
from linkwright.files.compose import compose
from linkwright.files.write import flow
from linkwright.filesystem import atomic_write
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import _

_AXES = {"x": "0", "y": "1"}
ReadText = Callable[[str, str], tuple[Mechanism | None, list[Finding]]]


class Edit(NamedTuple):
    """What takes the place of a part of a text; ``adds``: a key that was not there."""

    start: int
    end: int
    written: str
    adds: bool = False

    def overlaps(self, other: Edit) -> bool:
        """Whether both change the same characters."""
        return self.start < other.end and other.start < self.end

    def made(self, text: str) -> str:
        """The text with it."""
        return text[: self.start] + self.written + text[self.end :]


class Document:
    """The text of a model file, its mechanism, and changes of single values that keep comments and order."""

    def __init__(self, text: str, name: str, read_text: ReadText) -> None:
        self.name, self._read_text = name, read_text
        self.text, self.mechanism = text, self._checked(text)
        self._composed = "", Mapping(0, 0, 0, 0, [])

    def __repr__(self) -> str:
        return f"Document({self.name!r}: {self.mechanism!r})"

    def _checked(self, text: str) -> Mechanism:
        mechanism, findings = self._read_text(text, self.name)
        if mechanism is None:
            raise ModelError(findings)
        return mechanism

    def located(self, error: ModelError, without: Collection[str] = ()) -> ModelError:
        """The error with its findings at their lines; those below keys ``without`` are not about the text."""
        root, other = _root(self.text), tuple(f"{key}." for key in without)
        return ModelError(
            [each if f"{each.key}.".startswith(other) else located(each, root, self.name) for each in error.findings]
        )

    def set(self, address: str, value: str) -> None:
        """Write ``value`` (as text of the file, such as ``"1.3 m"``) at a place of the file.

        ``address`` is a dimension's address (``crank.length``) or a path of keys (``links.crank.length``). A last
        key that is not there yet is added. Raises ModelError, and changes nothing, where the new text is not a
        model; LinkwrightError for a place that the file does not have.
        """
        self.set_all({address: value})

    def set_all(self, values: dict[str, str]) -> None:
        """The same for texts by address, all or none of them: the new text is checked once."""
        text, left = self.text, list(values.items())
        while left:
            root, edits = _root(text), list[Edit]()
            while left:
                edit = self._edit(text, root, *left[0])
                if edits and (edit.adds or any(edit.overlaps(each) for each in edits)):
                    break
                edits.append(edit)
                left.pop(0)
                if edit.adds:
                    break
            for edit in sorted(edits, reverse=True):
                text = edit.made(text)
        self.mechanism, self.text = self._checked(text), text

    def _edit(self, text: str, root: Mapping, address: str, value: str) -> Edit:
        for path in _paths(address, root):
            node, rest = _follow(root, path)
            if not rest:
                return self._replaced(text, node, value)
            last = len(rest) == 1 and rest[0] not in ("x", "y", "0", "1")
            if last and isinstance(node, Mapping) and node is not root:
                return self._added(text, node, rest[0], value)
        raise LinkwrightError(
            with_remedy(
                _('the file has no place for "{address}"', code="model.no_place", address=address),
                offered(address, self.mechanism.dimensions()),
            )
        )

    def place(self, address: str) -> tuple[int, int] | None:
        """Span of the value at an address in the text: its first offset and the one behind it; None where the
        file has no such place."""
        root = self._tree
        offset = 1 if self.text.startswith("\ufeff") else 0
        for path in _paths(address, root):
            node, rest = _follow(root, path)
            if not rest and isinstance(node, Scalar):
                return node.start + offset, node.end + offset
        return None

    def edit(self, address: str, value: str) -> Edit | None:
        """What :meth:`set` would do to the text; None for a place that the file does not have."""
        try:
            return self._edit(self.text, self._tree, address, value)
        except LinkwrightError:
            return None

    def with_text(self, text: str) -> Document:
        """A document of another text; raises ModelError where that is not a model."""
        return Document(text, self.name, self._read_text)

    @property
    def _tree(self) -> Mapping:
        if self._composed[0] != self.text:
            self._composed = self.text, _root(self.text)
        return self._composed[1]

    def save(self, path: str | Path, *, force: bool = False) -> None:
        """Write the text to a file, atomically.

        Raises LinkwrightError where it cannot be written, and for a file that is there already unless ``force``.
        """
        atomic_write(path, self.text.encode(), force=force)

    def _replaced(self, text: str, node: Node, value: str) -> Edit:
        offset = 1 if text.startswith("\ufeff") else 0
        start, end = node.start + offset, node.end + offset
        while end > start and text[end - 1] in " \r\n":
            end -= 1
        written = self._written(value)
        if isinstance(node, Scalar) and node.empty and start == end:
            written = f" {written}"
        return Edit(start, end, written)

    def _added(self, text: str, node: Mapping, key: str, value: str) -> Edit:
        offset = 1 if text.startswith("\ufeff") else 0
        name = json.dumps(key) if self._json else key
        entry = f"{name}: {self._written(value)}"
        if not node.entries or node.flow:
            place = _flow_end(node, text, offset)
            glue = ", " if node.entries else ""
            return Edit(place, place, glue + entry, adds=True)
        last = node.entries[-1]
        line_end = text.find("\n", content_end(last) + offset)
        at = len(text) if line_end < 0 else line_end
        if text[at - 1 : at] == "\r":
            at -= 1
        newline = "\r\n" if "\r\n" in text else "\n"
        return Edit(at, at, newline + " " * last.key.column + entry, adds=True)

    @property
    def _json(self) -> bool:
        return self.text.lstrip("\ufeff \t\r\n").startswith("{")

    def _written(self, value: str) -> str:
        stripped = value.strip()
        if stripped[:1] in ("[", "{", '"', "'"):
            return stripped
        return json.dumps(stripped, ensure_ascii=False) if self._json and stripped != "0" else flow(stripped)


def _root(text: str) -> Mapping:
    root, _unused = compose(text.removeprefix("\ufeff"))
    assert isinstance(root, Mapping)
    return root


def _flow_end(node: Mapping, text: str, offset: int) -> int:
    """Where to insert before the closing brace: behind the last entry's value."""
    if node.entries:
        return content_end(node.entries[-1]) + offset
    return text.rfind("}", 0, node.end + offset)


def content_end(entry: Entry) -> int:
    """Offset behind the last character of an entry's value."""
    value = entry.value
    if isinstance(value, Scalar) or value.end <= value.start:
        return max(value.end, entry.key.end)
    if isinstance(value, Mapping) and not value.flow and value.entries:
        return content_end(value.entries[-1])
    if isinstance(value, Sequence) and not value.flow and value.items:
        return value.items[-1].end
    return value.end


def _paths(address: str, root: Mapping) -> list[list[str]]:
    """The paths of keys that an address may mean, best first."""
    parts = address.split(".")
    found = [parts]
    if len(parts) == 1:
        found.append(["parameters", *parts])
    head, *rest = parts
    for section in ("links", "joints", "drivers"):
        owners = root.get(section)
        if isinstance(owners, Mapping) and owners.get(head) is not None:
            found.append([section, *parts])
            if section == "links" and len(rest) == 2:
                found += [[section, head, holder, *rest] for holder in ("points", "also")]
    if head == "frame" and len(rest) == 2:
        found.append(["frame", "points", *rest])
    return found


def _follow(root: Mapping, path: list[str]) -> tuple[Node, list[str]]:
    """The node at a path, or the last that exists and the keys that are left."""
    node: Node = root
    for index, part in enumerate(path):
        below: Node | None = None
        if isinstance(node, Mapping):
            below = node.get(part)
        elif isinstance(node, Sequence):
            position = _AXES.get(part, part)
            below = node.items[int(position)] if position.isdecimal() and int(position) < len(node.items) else None
        if below is None:
            return node, path[index:]
        node = below
    return node, []
