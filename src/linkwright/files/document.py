"""A model file that can be changed in place: everything that is not changed stays as the user wrote it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from linkwright.errors import Finding, LinkwrightError, ModelError, with_remedy
from linkwright.fields.nodes import Entry, Mapping, Node, Scalar, Sequence
from linkwright.files.compose import compose
from linkwright.files.write import flow
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.whole_files import write_whole
from linkwright.words.sentence import Sentence

_AXES = {"x": "0", "y": "1"}
ReadText = Callable[[str, str], tuple[Mechanism | None, list[Finding]]]


class Document:
    """The text of a model file, its mechanism, and changes of single values that keep comments and order."""

    def __init__(self, text: str, name: str, read_text: ReadText) -> None:
        self.name, self._read_text = name, read_text
        self.text, self.mechanism = text, self._checked(text)

    def _checked(self, text: str) -> Mechanism:
        mechanism, findings = self._read_text(text, self.name)
        if mechanism is None:
            raise ModelError(findings)
        return mechanism

    def set(self, address: str, value: str) -> None:
        """Write ``value`` (the text that stands in the file, such as ``"1.3 m"``) at a place of the file.

        ``address`` is a dimension's address (``crank.length``) or a path of keys (``links.crank.length``).
        A last key
        that is not there yet is added. Raises ModelError, and changes nothing, where the new text is not a
        model;
        LinkwrightError for a place that the file does not have.
        """
        root, _ = compose(self.text.removeprefix("\ufeff"))
        assert isinstance(root, Mapping)
        missing: str | None = None
        for path in _paths(address, root):
            node, rest = _follow(root, path)
            if not rest:
                self._replace(node, value)
                return
            if len(rest) == 1 and isinstance(node, Mapping) and node is not root:
                missing = rest[0] if missing is None else missing
                if rest[0] == path[-1] and rest[0] not in ("x", "y", "0", "1"):
                    self._insert(node, rest[0], value)
                    return
        raise LinkwrightError(
            with_remedy(
                Sentence("model.no_place", address=address), offered(address, self.mechanism.dimensions())
            )
        )

    def place(self, address: str) -> tuple[int, int] | None:
        """Where the value at an address stands in the text: its first offset and the one behind it; None where the
        file has no such place."""
        root, _ = compose(self.text.removeprefix("\ufeff"))
        assert isinstance(root, Mapping)
        offset = 1 if self.text.startswith("\ufeff") else 0
        for path in _paths(address, root):
            node, rest = _follow(root, path)
            if not rest and isinstance(node, Scalar):
                return node.start + offset, node.end + offset
        return None

    def save(self, path: str | Path) -> None:
        """Write the text to a file, whole or not at all; raises LinkwrightError where it cannot be written."""
        write_whole(path, self.text.encode())

    def _replace(self, node: Node, value: str) -> None:
        offset = 1 if self.text.startswith("\ufeff") else 0
        start, end = node.start + offset, node.end + offset
        while end > start and self.text[end - 1] in " \r\n":
            end -= 1
        written = self._written(value)
        if isinstance(node, Scalar) and node.empty and start == end:
            written = f" {written}"
        self._accept(self.text[:start] + written + self.text[end:])

    def _insert(self, node: Mapping, key: str, value: str) -> None:
        offset = 1 if self.text.startswith("\ufeff") else 0
        name = json.dumps(key) if self._json else key
        entry = f"{name}: {self._written(value)}"
        if not node.entries or node.flow:
            place = _flow_end(node, self.text, offset)
            glue = ", " if node.entries else ""
            self._accept(self.text[:place] + glue + entry + self.text[place:])
            return
        last = node.entries[-1]
        end = content_end(last) + offset
        line_end = self.text.find("\n", end)
        at = len(self.text) if line_end < 0 else line_end
        if self.text[at - 1 : at] == "\r":
            at -= 1
        newline = "\r\n" if "\r\n" in self.text else "\n"
        self._accept(self.text[:at] + newline + " " * last.key.column + entry + self.text[at:])

    @property
    def _json(self) -> bool:
        return self.text.lstrip("\ufeff \t\r\n").startswith("{")

    def _written(self, value: str) -> str:
        stripped = value.strip()
        if stripped[:1] in ("[", "{", '"', "'"):
            return stripped
        return json.dumps(stripped, ensure_ascii=False) if self._json and stripped != "0" else flow(stripped)

    def _accept(self, text: str) -> None:
        self.mechanism = self._checked(text)
        self.text = text


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
            below = (
                node.items[int(position)] if position.isdigit() and int(position) < len(node.items) else None
            )
        if below is None:
            return node, path[index:]
        node = below
    return node, []
