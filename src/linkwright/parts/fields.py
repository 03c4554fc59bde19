"""Fields of machine-part files beyond those of mechanisms: tables in tables, lists of tables, samples."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from linkwright import units
from linkwright.core import expressions
from linkwright.core.dataclass import dataclass
from linkwright.errors import QuantityError
from linkwright.fields.base import Field, Place, Reader, Schema, given_by_file, table_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.registry import nearest
from linkwright.words.sentence import Sentence

Make = Callable[..., Any]

#: More positions or machines than one computer takes at once.
MOST = 10_000_000
_WHOLE = re.compile(r"[+-]?[0-9]{1,18}")


@dataclass(frozen=True)
class Table(Field):
    """A mapping of known keys, made into an object by ``make``."""

    fields: Mapping[str, Field]
    make: Make = dict

    @classmethod
    def of(cls, made: type, **settings: Any) -> Table:
        """The table of what :func:`linkwright.fields.base.given` declares in a dataclass."""
        return cls(given_by_file(made), made, **settings)

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        before = reader.error_count
        values = reader.table(node, place, self.fields)
        if values is None or reader.error_count > before:
            return None
        return self.make(**values)

    def shape(self) -> Schema:
        return table_schema(self.fields)


@dataclass(frozen=True)
class Named(Field):
    """A mapping of names that the user chose, each with a value of one field."""

    item: Field
    what: str

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        found: dict[str, Any] = {}
        for entry in mapping.entries:
            child = place.child(entry.key.text)
            if reader.name(entry.key, child, self.what) is not None:
                found[entry.key.text] = self.item.read(reader, entry.value, child, given)
        return found

    def shape(self) -> Schema:
        return {"type": "object", "additionalProperties": self.item.schema()}


@dataclass(frozen=True)
class ByAddress(Named):
    """A mapping of any texts (addresses of dimensions, outputs), each with a value of one field."""

    what: str = "output"

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        return {
            entry.key.text: self.item.read(reader, entry.value, place.child(entry.key.text), given)
            for entry in mapping.entries
        }


@dataclass(frozen=True)
class Listed(Field):
    """A list with items of one field."""

    item: Field
    form: str = "[…, …]"

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        items = reader.items(node, place, None, self.form)
        if items is None:
            return None
        return tuple(
            self.item.read(reader, item, place.child(str(index)), given) for index, item in enumerate(items)
        )

    def shape(self) -> Schema:
        return {"type": "array", "items": self.item.schema()}


@dataclass(frozen=True)
class Either(Field):
    """A short form for a single value, or a table."""

    short: Field
    table: Table

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        chosen = self.table if isinstance(node, MappingNode) else self.short
        return chosen.read(reader, node, place, given)

    def shape(self) -> Schema:
        return {"anyOf": [self.short.shape(), self.table.shape()]}


@dataclass(frozen=True)
class Known(Either):
    """A name of some known values, or a table; ``code``: of the finding for another name."""

    known: Mapping[str, Any]
    code: str

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, given)
        if not isinstance(found, str):
            return found
        if found in self.known:
            return self.known[found]
        unknown_name(reader, node, place, self.code, found, list(self.known))
        return None

    def shape(self) -> Schema:
        return {"anyOf": [{"enum": list(self.known)}, self.table.shape()]}


@dataclass(frozen=True)
class Flag(Field):
    """``true`` or ``false``."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> bool | None:
        word = reader.word(node, place, ("true", "false"))
        return None if word is None else word == "true"

    def shape(self) -> Schema:
        return {"type": "boolean"}


@dataclass(frozen=True)
class Whole(Field):
    """A whole number from ``least`` to ``most``."""

    least: int = 0
    most: int = MOST

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> int | None:
        text = reader.text(node, place)
        if text is None:
            return None
        if _WHOLE.fullmatch(text.strip()) and self.least <= int(text) <= self.most:
            return int(text)
        message = Sentence("part.no_whole", text=text, least=self.least, most=self.most)
        reader.error(node, place, message, Sentence("part.no_whole_remedy"), "range")
        return None

    def shape(self) -> Schema:
        return {"type": "integer", "minimum": self.least, "maximum": self.most}


@dataclass(frozen=True)
class Numbers:
    """Values (SI) of one dimension, with the unit in which they were given."""

    values: tuple[float, ...]
    dimension: units.Dimension = units.NONE
    unit: str = ""
    factor: float = 1.0


@dataclass(frozen=True)
class Sample(Field):
    """Values of any dimension: a list of quantities, or ``{unit: mm, values: [20.1, 19.9]}``."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Numbers | None:
        unit, factor, kind = "", 1.0, None
        if isinstance(node, MappingNode):
            node, _ = reader.unknown_keys(node, place, ["unit", "values"])
            named, node_values = node.get("unit"), node.get("values")
            if isinstance(named, Scalar):
                unit = named.text
                try:
                    factor, kind = units.unit(units.tidy(unit)) if unit.strip() else (1.0, units.NONE)
                except QuantityError as error:
                    reader.quantity_error(error, named, place.child("unit"), unit)
                    return None
            if node_values is None:
                missing = Sentence("part.no_values"), Sentence("part.no_values_remedy")
                reader.error(node, place.child("values"), *missing, "missing-key")
                return None
            node, place = node_values, place.child("values")
        items = reader.items(node, place, None, "[20.1 mm, 19.9 mm]")
        if items is None:
            return None
        read = [_any(reader, item, place.child(str(i)), factor, kind) for i, item in enumerate(items)]
        if any(each is None for each in read):
            return None
        kinds = {each[1] for each in read if each is not None}
        if len(kinds) > 1:
            first, second = (units.name_of(each) for each in sorted(kinds)[:2])
            message = Sentence("part.kinds_differ", first=first, second=second)
            reader.error(node, place, message, Sentence("part.kinds_differ_remedy"), "unit")
            return None
        shared = kinds.pop() if kinds else units.NONE
        return Numbers(tuple(each[0] for each in read if each), shared, unit, factor)

    def shape(self) -> Schema:
        values = {"type": "array", "items": {"type": ["string", "number"]}}
        table = {"type": "object", "properties": {"unit": {"type": "string"}, "values": values}}
        return {"anyOf": [values, table]}


def _any(
    reader: Reader, node: Node, place: Place, factor: float, kind: units.Dimension | None
) -> tuple[float, units.Dimension] | None:
    """SI value and dimension of one value; a bare number takes the unit of the whole list."""
    text = reader.quantity_text(node, place, "20.1 mm")
    if text is None:
        return None
    try:
        found = expressions.parse_any(text, reader.kinds)
        reader.used |= found.names
        value, own = float(found.evaluate(reader.values)), found.dimension(reader.kinds)
    except QuantityError as error:
        reader.quantity_error(error, node, place, text)
        return None
    if kind is not None and own == units.NONE:
        value, own = value * factor, kind
    return None if reader.within(value, node, place, *units.most(own)) is None else (value, own)


def unknown_name(reader: Reader, node: Node, place: Place, code: str, name: str, known: list[str]) -> None:
    """The finding for a name that a table does not have, with the nearest that it has."""
    offer = nearest(name, known)
    listed = tuple(known)
    remedy = (
        Sentence("part.known", known=listed)
        if offer is None
        else Sentence("part.nearest", offer=offer, known=listed)
    )
    reader.error(node, place, Sentence(code, name=name), remedy, "unknown-name")


@dataclass(frozen=True)
class AnyQuantity(Field):
    """One quantity of any dimension: its SI value and its dimension."""

    def read(
        self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]
    ) -> tuple[float, units.Dimension] | None:
        return _any(reader, node, place, 1.0, None)

    def shape(self) -> Schema:
        return {"type": ["string", "number"]}
