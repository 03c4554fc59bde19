"""Fields for tables in tables, lists of one field, and plain numbers and switches."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.fields.base import Field, Schema, file_keys, table_schema
from linkwright.fields.nodes import Entry, Node, Scalar, Sequence
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import Place, Reader, Sayings
from linkwright.words import Message, _

Make = Callable[..., Any]

#: More positions or machines than one computer takes at once.
MOST = 10_000_000
_INTEGER = re.compile(r"[+-]?[0-9]{1,18}")


@dataclass(frozen=True)
class Table(Field):
    """A mapping of known keys, made into an object by ``make``."""

    fields: Mapping[str, Field]
    make: Make = dict

    @classmethod
    def of(cls, made: type, **settings: Any) -> Table:
        """The table of what :func:`linkwright.fields.base.file_key` declares in a dataclass."""
        return cls(file_keys(made), made, **settings)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        before = reader.error_count
        values = reader.table(node, place, self.fields)
        if values is None or reader.error_count > before:
            return None
        return self.make(**values)

    def shape(self) -> Schema:
        return table_schema(self.fields)


@dataclass(frozen=True)
class Keys(Table):
    """A table whose values are taken as far as they can be read, whatever is wrong with the others, and whose keys
    may have nothing behind them; ``own``: its own sentences."""

    own: Sayings = dataclasses.field(default_factory=dict, kw_only=True)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, MappingNode):
            node = dataclasses.replace(node, entries=[each for each in node.entries if self._written(each)])
        with reader.saying(self.own):
            return reader.table(node, place, self.fields)

    def _written(self, entry: Entry) -> bool:
        field = self.fields.get(entry.key.text)
        bare = isinstance(entry.value, Scalar) and entry.value.empty
        return field is None or field.bare or not bare


@dataclass(frozen=True)
class Named(Field):
    """A mapping of names that the user chose, each with a value of one field."""

    item: Field
    what: Message

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        found: dict[str, Any] = {}
        for entry in mapping.entries:
            child = place.child(entry.key.text)
            if reader.name(entry.key, child, self.what) is not None:
                found[entry.key.text] = self.item.read(reader, entry.value, child, siblings)
        return found

    def shape(self) -> Schema:
        return {"type": "object", "additionalProperties": self.item.schema()}


@dataclass(frozen=True)
class ByAddress(Named):
    """A mapping of any texts (addresses of dimensions, outputs), each with a value of one field."""

    what: Message = _("output")

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        return {
            entry.key.text: self.item.read(reader, entry.value, place.child(entry.key.text), siblings)
            for entry in mapping.entries
        }


@dataclass(frozen=True)
class Listed(Field):
    """A list with items of one field; ``alone``: or a single one."""

    item: Field
    form: str = "[…, …]"
    alone: bool = dataclasses.field(default=False, kw_only=True)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if self.alone and not isinstance(node, Sequence):
            return self.item.read(reader, node, place, siblings)
        items = reader.items(node, place, None, self.form)
        if items is None:
            return None
        return tuple(
            self.item.read(reader, item, place.child(str(index)), siblings) for index, item in enumerate(items)
        )

    def shape(self) -> Schema:
        found = {"type": "array", "items": self.item.schema()}
        return {"anyOf": [self.item.shape(), found]} if self.alone else found


@dataclass(frozen=True)
class Either(Field):
    """A short form for a single value, or a table: one field for a value, the other for a mapping."""

    short: Field
    table: Field

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        chosen = self.table if isinstance(node, MappingNode) else self.short
        return chosen.read(reader, node, place, siblings)

    def shape(self) -> Schema:
        return {"anyOf": [self.short.shape(), self.table.shape()]}


@dataclass(frozen=True)
class Line(Field):
    """One line: a text or a number; empty where nothing is written."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        return "" if isinstance(node, Scalar) and node.empty else reader.text(node, place)

    def shape(self) -> Schema:
        return {"type": ["string", "number"]}


#: NAME: VALUE, each a line.
PAIRS = ByAddress(Line())


@dataclass(frozen=True)
class Value(Line):
    """A text or a number, stored as plain data: a bare number is one in SI."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        return None if super().read(reader, node, place, siblings) is None else reader.free(node)


@dataclass(frozen=True)
class Flag(Field):
    """``true`` or ``false``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> bool | None:
        word = reader.word(node, place, ("true", "false"))
        return None if word is None else word == "true"

    def shape(self) -> Schema:
        return {"type": "boolean"}


@dataclass(frozen=True)
class Integer(Field):
    """An integer from ``minimum`` to ``maximum``."""

    minimum: int = 0
    maximum: int = MOST

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> int | None:
        text = reader.text(node, place)
        if text is None:
            return None
        if _INTEGER.fullmatch(text.strip()) and self.minimum <= int(text) <= self.maximum:
            return int(text)
        message = _(
            '"{text}" is not an integer from {minimum} to {maximum}',
            code="part.no_whole",
            text=text,
            minimum=self.minimum,
            maximum=self.maximum,
        )
        reader.error(node, place, message, _("write digits only"), "range")
        return None

    def shape(self) -> Schema:
        return {"type": "integer", "minimum": self.minimum, "maximum": self.maximum}
