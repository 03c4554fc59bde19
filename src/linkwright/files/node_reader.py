"""Reading of plain structure from nodes: mappings, lists, texts and words, every problem a finding."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, cast

from linkwright.errors import Finding, Severity
from linkwright.fields.base import Field, Text
from linkwright.fields.nodes import Entry, Node, Scalar, Sequence, noun
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import K, Place, Reader, Sayings, missing_remedy
from linkwright.files.syntax import wide_remedy
from linkwright.registry import LISTINGS, PROBABLE, listed, nearest
from linkwright.units import decimal_comma
from linkwright.words import Message, _

NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_INTEGER = re.compile(r"[+-]?\d{1,18}")
NAME = re.compile(r"[^\W\d][\w'-]*")

_NOTHING: Mapping[str, str] = {}
#: Words of assembly modes.
MODES = ("left", "right", "forward", "backward")

#: Findings about one file, at most.
MOST_FINDINGS = 300


def as_meant(mapping: MappingNode, known: Collection[str]) -> MappingNode:
    """The mapping with known keys in the place of such as are nearly these, where these are not there themselves."""
    present = {entry.key.text for entry in mapping.entries}
    if present.issubset(known) or present.issuperset(known):
        return mapping
    entries = list(mapping.entries)
    for index, entry in enumerate(entries):
        near = None if entry.key.text in known else nearest(entry.key.text[:100], list(known), PROBABLE)
        if near is not None and near not in present:
            present.add(near)
            entries[index] = Entry(replace(entry.key, text=near), entry.value)
    return replace(mapping, entries=entries)


def _split_by_commas(texts: list[str]) -> bool:
    """Whether a number among these was written with a decimal comma: ``60,5 mm``, ``0,5 mm``."""
    integers = [bool(re.fullmatch(r"[+-]?\d+", text)) for text in texts]
    rest = [re.match(r"\d+\s*[^\s\d.]", text) is not None for text in texts]
    zeros = [text.lstrip("+-") == "0" for text in texts]
    return not all(integers) and any(
        first and (not zero or second)
        for first, zero, second in zip(integers, zeros, [*rest[1:], False], strict=True)
    )


def meant_kind(kind: Node | None, kinds: Mapping[str, object]) -> str | None:
    """The kind that a text names, or probably means."""
    text = kind.text if isinstance(kind, Scalar) else ""
    return text if text in kinds else nearest(text[:100], list(kinds), PROBABLE) if text else None


class PlainReader:
    """What every reader of a file needs; a method that reads returns None after it has noted a finding.

    ``si`` admits bare numbers as SI values (models built in code).
    """

    def __init__(self, source: str, *, si: bool = False) -> None:
        self.source, self.si = source, si
        self.findings: list[Finding] = []
        self.unread = 0
        self._own: Sayings = {}

    @property
    def error_count(self) -> int:
        """How many errors were found so far, and values ``unread`` by an error that is reported elsewhere."""
        return self.unread + sum(finding.severity == "error" for finding in self.findings)

    @contextmanager
    def saying(self, own: Sayings) -> Iterator[None]:
        """Within it a section's own messages replace the general ones."""
        before, self._own = self._own, {**self._own, **own}
        yield
        self._own = before

    @property
    def full(self) -> bool:
        """Whether there are so many findings that no more are noted."""
        return len(self.findings) > MOST_FINDINGS

    def error(
        self,
        node: Node | None,
        place: Place | str,
        message: str,
        remedy: str = "",
        code: str = "",
        *,
        column: int = 0,
        severity: Severity = "error",
    ) -> None:
        """Note a finding at a node; ``column`` is an offset within it."""
        if len(self.findings) >= MOST_FINDINGS:
            if not self.full:
                more = _("there are more than {count} findings; mend these first", count=MOST_FINDINGS)
                self.findings.append(Finding("error", self.source, "", more, code="many"))
            return
        key = place if isinstance(place, str) else place.key
        if severity == "error" and code != "decimal-comma" and isinstance(node, Scalar) and node.plain:
            remedy = (not node.text.isascii() and wide_remedy(node.text)) or remedy
        self.findings.append(Finding(severity, self.where(node, column), key, message, remedy, code))

    def finding(
        self,
        node: Node | None,
        place: Place | str,
        message: Message,
        code: str,
        remedy: str,
        /,
        *,
        severity: Severity = "error",
        general: str = "",
        **values: object,
    ) -> None:
        """Note a finding with the values of its texts at a node; or what the section says of its own instead of a
        ``general`` one."""
        if general in self._own:
            own = self._own[general]
            name = (place if isinstance(place, str) else place.key).rpartition(".")[2]
            self.error(node, place, own.message(**{"key_": name, **values}), "", own.code, severity=severity)
            return
        advice = remedy.format(**values) if isinstance(remedy, Message) else remedy
        self.error(node, place, message.format(**values), advice, code, severity=severity)

    def where(self, node: Node | None, column: int = 0) -> str:
        """The place of a node as ``file:line:column``."""
        if self.si or not self.source:
            return self.source
        if node is None:
            return f"{self.source}:1:1"
        return f"{self.source}:{node.line + 1}:{node.column + column + 1}"

    def mapping(self, node: Node | None, place: Place | str) -> MappingNode | None:
        """The node if it is a mapping."""
        if isinstance(node, MappingNode):
            return node
        self.finding(
            node,
            place,
            _("expected a mapping (key: value), not {node}"),
            "type",
            _("write {{key: value, …}} or indented lines key: value"),
            general="where_mapping",
            node=noun(node),
        )
        return None

    def items(self, node: Node, place: Place | str, count: int | None, form: str) -> list[Node] | None:
        """The items of a list, of ``count`` if that is not None; ``form`` is an example."""
        if not isinstance(node, Sequence):
            self.finding(
                node,
                place,
                _("expected a list, not {node}"),
                "type",
                _("write it as {form}", form=form),
                general="where_list",
                node=noun(node),
            )
            return None
        if count is None or len(node.items) == count:
            return node.items
        texts = [item.text if isinstance(item, Scalar) else "" for item in node.items]
        comma = len(texts) > count and _split_by_commas(texts)
        wide = any(isinstance(item, Scalar) and item.plain and "，" in item.text for item in node.items)
        remedy = _("write it as {form}", form=form)
        if comma:
            remedy = _("write it as {form}, with decimal points, not commas", form=form)
        if wide:
            remedy = _('write a plain "," in place of the full-width "，": {form}', form=form)
        code = "decimal-comma" if comma else "count"
        self.finding(
            node, place, _("expected {count} values, found {found}"), code, remedy, found=len(node.items), count=count
        )
        return None

    def text(self, node: Node, place: Place | str) -> str | None:
        """The text of a single value."""
        if isinstance(node, Scalar) and not node.empty:
            return node.text
        self.finding(
            node,
            place,
            _("expected a text, not {node}"),
            "type",
            _("write a name or a text"),
            general="where_text",
            node=noun(node),
        )
        return None

    def name(self, node: Node, place: Place | str, what: Message) -> str | None:
        """A name that the user chose for something new."""
        text = self.text(node, place)
        if text is None or NAME.fullmatch(text):
            return text
        right = re.sub(r"[^\w'-]", "_", text).strip("_") or "a"
        right = right if NAME.fullmatch(right) else f"{what[0]}{right}"
        self.finding(
            node,
            place,
            _('"{text}" cannot be the name of a {what}'),
            "name",
            _('names begin with a letter and hold letters, digits, _ and -: "{right}"'),
            text=text,
            what=what,
            right=right,
        )
        return None

    def word(self, node: Node, place: Place | str, choices: Collection[str]) -> str | None:
        """One of a few words."""
        text = self.text(node, place)
        if text is None or text in choices:
            return text
        remedy = listed(text, choices, "one_of")
        self.finding(node, place, _('"{text}" is not known here'), "unknown-word", remedy, text=text)
        return None

    def of_kind(
        self, node: Node, place: Place, kinds: Mapping[str, type[K]], missing: Message, remedy: Message
    ) -> tuple[MappingNode, type[K], dict[str, Any]] | None:
        """A table, what its key ``kind`` names or probably means, and its values by the fields of that kind, as far
        as they are written; ``missing``, ``remedy``: the sentences where there is no kind."""
        table = self.mapping(node, place)
        if table is None:
            return None
        table = self._with_kind(table, place)
        kind_node = table.get("kind")
        if kind_node is None:
            advice = remedy.format(kinds=tuple(kinds))
            self.error(table, place.child("kind"), missing, advice, "missing-key")
            return None
        self.word(kind_node, place.child("kind"), kinds)
        kind = meant_kind(kind_node, kinds)
        if kind is None:
            return None
        table, found = self._fields(table, place, {"kind": Text(), **kinds[kind].fields()})
        values = {key: value for key, value in found.items() if key != "kind" and value is not None}
        return table, kinds[kind], values

    def _with_kind(self, table: MappingNode, place: Place) -> MappingNode:
        """The table; without a ``kind``, with a key that is nearly it in its place, which is a finding."""
        if table.get("kind") is not None:
            return table
        meant = as_meant(table, ["kind"])
        changed = [was for was, now in zip(table.entries, meant.entries, strict=True) if was is not now]
        self.unknown_keys(replace(table, entries=changed), place, ["kind"])
        return meant

    def table(self, node: Node, place: Place, fields: Mapping[str, Field]) -> dict[str, Any] | None:
        """The values of a mapping by its fields; unknown and missing keys are findings, a value under a key that is
        nearly known is read as the one of that."""
        mapping = self.mapping(node, place)
        return None if mapping is None else self._fields(mapping, place, fields)[1]

    def _fields(
        self, mapping: MappingNode, place: Place, fields: Mapping[str, Field]
    ) -> tuple[MappingNode, dict[str, Any]]:
        """The mapping with keys that are nearly known in the place of those, and its values."""
        keys = {each.key or name: name for name, each in fields.items()}
        mapping = self._renamed(
            mapping, place, {each.old: key for key, name in keys.items() if (each := fields[name]).old}
        )
        meant = self._in_place_of(mapping, place, {key: fields[name] for key, name in keys.items()})
        mapping, split = self.unknown_keys(mapping, place, list(keys), meant)
        found: dict[str, Any] = {}
        for key, name in keys.items():
            value = mapping.get(key)
            each = fields[name]
            if value is None and each.required and key not in split:
                remedy = missing_remedy(key, each.doc, each.shape())
                self.finding(
                    mapping,
                    place.child(key),
                    _('the key "{key_}" is missing'),
                    "missing-key",
                    remedy,
                    general="missing_key",
                    key_=key,
                )
            elif value is not None:
                reader = cast(Reader, self)
                if each.replaced:
                    self.old_key(value, place.child(key), key, each.replaced)
                found[name] = None if key in split else each.read(reader, value, place.child(key), found)
        return mapping, found

    def _renamed(self, mapping: MappingNode, place: Place, old: Mapping[str, str]) -> MappingNode:
        """The mapping with new keys in the place of ``old`` ones, each of which is a warning."""
        present = {entry.key.text for entry in mapping.entries}
        if old.keys().isdisjoint(present):
            return mapping
        entries = list(mapping.entries)
        for index, entry in enumerate(entries):
            new = old.get(entry.key.text)
            if new is not None and new not in present:
                self.old_key(entry.key, place.child(entry.key.text), entry.key.text, new)
                entries[index] = Entry(replace(entry.key, text=new), entry.value)
        return replace(mapping, entries=entries)

    def old_key(self, node: Node, place: Place, key: str, new: str) -> None:
        """A warning for a key that files of this format had before, with the one that took its place."""
        self.finding(
            node,
            place,
            _('the key "{key_}" has a new name: {new}'),
            "old-key",
            _("write {new}: instead; files of this format with the old name go on being read"),
            severity="warning",
            key_=key,
            new=new,
        )

    def _in_place_of(self, mapping: MappingNode, place: Place, fields: Mapping[str, Field]) -> Mapping[str, str]:
        """The one key that is missing, by the only one that is not known, where it could have its value: a name of
        the model, though perhaps one that does not exist."""
        unknown = [entry for entry in mapping.entries if entry.key.text not in fields]
        missing = [key for key, each in fields.items() if each.required and mapping.get(key) is None]
        if len(unknown) != 1 or len(missing) != 1:
            return {}
        before, unread = len(self.findings), self.unread
        each, at = fields[missing[0]], place.child(missing[0])
        value = each.read(cast(Reader, self), unknown[0].value, at, {})
        fits = value is not None or {finding.code for finding in self.findings[before:]} == {"unknown-name"}
        del self.findings[before:]
        self.unread = unread
        return {unknown[0].key.text: missing[0]} if fits else {}

    def unknown_keys(
        self, mapping: MappingNode, place: Place, known: list[str], meant: Mapping[str, str] = _NOTHING
    ) -> tuple[MappingNode, set[str]]:
        """A finding for each key that is not known, with the nearest that is; ``meant``: such ones by what they mean.

        Gives the mapping with those nearest ones in their place, and the keys that need no other finding: those whose
        value a decimal comma has split (``{length: 60,5 mm}`` has the key ``5 mm``), those that are one key with
        their value (``length:60 mm``, ``length 60 mm``), and those that are offered in the place of another one.
        """
        present = {entry.key.text for entry in mapping.entries}
        split: set[str] = set()
        remaining = list(mapping.entries)
        for index, entry in enumerate(mapping.entries):
            key = entry.key.text
            if key in known:
                continue
            if self.full:
                break
            if (joined := self._joined(entry, place, known)) is not None:
                split.add(joined)
                remaining.remove(entry)
                continue
            before = mapping.entries[index - 1] if index else None
            if before is not None and self._comma(before, entry, place):
                split.add(before.key.text)
                continue
            absent = [each for each in known if each not in present]
            likely = nearest(key[:100], absent, PROBABLE) or nearest(key[:100], known, PROBABLE)
            offer = likely or meant.get(key) or nearest(key[:100], absent)
            if offer in absent and not likely:
                split.add(offer)
            remedy = LISTINGS["known"][not offer].format(offer=offer, names=tuple(known))
            self.finding(
                entry.key,
                place.child(key),
                _('unknown key "{key_}"'),
                "unknown-key",
                remedy,
                general="unknown_key",
                key_=key[:100],
                names=tuple(known),
            )
        mapping = replace(mapping, entries=remaining)
        return mapping if self.full else as_meant(mapping, known), split

    def _joined(self, entry: Entry, place: Place, known: list[str]) -> str | None:
        """The known key whose value follows it without a space after the colon, after another sign or none."""
        found = re.fullmatch(r"(\w+)(?:\s*[:=：]\s*|\s+(?=[+-]?\.?\d))(\S.*)", entry.key.text)
        if found is None or found[1] not in known or not isinstance(entry.value, Scalar):
            return None
        key, rest = found[1], found[2][:60]
        if not entry.value.empty:
            if rest[0] not in "{[":
                return None
            rest = f"{rest}: {entry.value.text}"[:60]
        self.finding(
            entry.key,
            place.child(key),
            _('the key "{key_}" and its value stand together as one key'),
            "syntax",
            _("write a colon and a space between them: {key_}: {rest}"),
            key_=key,
            rest=rest,
        )
        return key

    def _comma(self, before: Entry, entry: Entry, place: Place) -> bool:
        number, rest = before.value, entry.key.text
        if not (isinstance(number, Scalar) and isinstance(entry.value, Scalar) and entry.value.empty):
            return False
        if not re.fullmatch(r"[+-]?\d+", number.text) or not re.match(r"\d", rest):
            return False
        problem = decimal_comma(f"{number.text},{rest}")
        self.error(number, place.child(before.key.text), problem.message, problem.remedy, problem.code)
        return True

    def free(self, node: Node) -> Any:
        """Plain data of any node, numbers and truth values as in YAML 1.2."""
        if isinstance(node, MappingNode):
            return {key: self.free(value) for key, value in node}
        if isinstance(node, Sequence):
            return [self.free(item) for item in node.items]
        assert isinstance(node, Scalar)
        if not node.plain:
            return node.text
        if node.empty:
            return None
        text = node.text
        if not (text[0].isdigit() or text[0] in "+-."):
            return text == "true" if text in ("true", "false") else text
        if _INTEGER.fullmatch(text):
            return int(text)
        return float(text) if NUMBER.fullmatch(text) else text
