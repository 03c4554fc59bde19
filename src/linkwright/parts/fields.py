"""Fields of machine-part files beyond those of mechanisms: samples, known values, quantities, and a mechanism."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright import units
from linkwright.core import expressions
from linkwright.errors import NO_FILE, Finding, ModelError, QuantityError
from linkwright.fields.base import Field, Schema, Text
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Either
from linkwright.files.model_file import load
from linkwright.files.source import GALLERY
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.registry import nearest
from linkwright.words import Message, _

if TYPE_CHECKING:
    from typing import Self


@dataclass(frozen=True)
class Known(Either):
    """A name of some known values, or a table; ``other``: the message about another name."""

    known: Mapping[str, Any]
    other: Message

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, siblings)
        if not isinstance(found, str):
            return found
        if found in self.known:
            return self.known[found]
        offer, listed = nearest(found, list(self.known)), tuple(self.known)
        remedy = (
            _("(known: {known})", known=listed)
            if offer is None
            else _('did you mean "{offer}"? (known: {known})', offer=offer, known=listed)
        )
        reader.error(node, place, self.other.format(name=found), remedy, "unknown-name")
        return None

    def shape(self) -> Schema:
        return {"anyOf": [{"enum": list(self.known)}, self.table.shape()]}


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

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Numbers | None:
        unit, factor, kind = "", 1.0, None
        if isinstance(node, MappingNode):
            node, _unused = reader.unknown_keys(node, place, ["unit", "values"])
            named, node_values = node.get("unit"), node.get("values")
            if isinstance(named, Scalar):
                unit = named.text
                try:
                    factor, kind = units.unit(units.tidy(unit)) if unit.strip() else (1.0, units.NONE)
                except QuantityError as error:
                    reader.quantity_error(error, named, place.child("unit"), unit)
                    return None
            if node_values is None:
                missing = _('the key "values" is missing'), _("add it: values: [20.1, 19.9]")
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
            message = _(
                "the values differ in kind: {first} and {second}",
                code="part.kinds_differ",
                first=first,
                second=second,
            )
            reader.error(node, place, message, _("give all of one kind"), "unit")
            return None
        shared = kinds.pop() if kinds else units.NONE
        return Numbers(tuple(each[0] for each in read if each), shared, unit, factor)

    def shape(self) -> Schema:
        values = {"type": "array", "items": {"type": ["string", "number"]}}
        table = {"type": "object", "properties": {"unit": {"type": "string"}, "values": values}}
        return {"anyOf": [values, table]}


def _any(
    reader: Reader, node: Node, place: Place, factor: float, kind: units.Dimension | None, likely: Sequence[str] = ()
) -> tuple[float, units.Dimension] | None:
    """SI value and dimension of one value, of a ``likely`` dimension where it is of one; a bare number takes the unit
    of the complete list."""
    text = reader.quantity_text(node, place, "20.1 mm")
    if text is None:
        return None
    try:
        found, own = _likely(text, likely, reader)
        reader.used.update(found.names)
        value = float(found.evaluate(reader.values))
    except QuantityError as error:
        reader.quantity_error(error, node, place, text)
        return None
    if kind is not None and own == units.NONE:
        value, own = value * factor, kind
    return None if reader.within(value, node, place, *units.most(own)) is None else (value, own)


def _likely(text: str, likely: Sequence[str], reader: Reader) -> tuple[expressions.Expression, units.Dimension]:
    """The expression of a text and its dimension, the first of the ``likely`` ones that it can have."""
    for dimension in likely:
        with suppress(QuantityError):
            return expressions.parse_as(text, dimension, reader.kinds), units.DIMENSIONS[dimension]
    found = expressions.parse_any(text, reader.kinds)
    return found, found.dimension(reader.kinds)


@dataclass(frozen=True)
class AnyQuantity(Field):
    """One quantity of any dimension, first of those named in ``likely``: its SI value and its dimension."""

    likely: tuple[str, ...] = ()

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> tuple[float, units.Dimension] | None:
        return _any(reader, node, place, 1.0, None, self.likely)

    def shape(self) -> Schema:
        return {"type": ["string", "number"]}


MECHANISM = Text(required=True, doc="model file of the mechanism, relative to this file, or gallery:NAME")


def load_referenced(name: str, folder: Path) -> Mechanism:
    """The mechanism that a file in ``folder`` names.

    Raises:
        ModelError: there is no such file, with a finding at ``mechanism``; or what is wrong in it, at its places.
    """
    try:
        return load(name if name.startswith(GALLERY) else folder / name)
    except ModelError as error:
        if error.findings[0].code not in NO_FILE:
            raise
        missing = error.findings[0]
        message = _("{name}: {message}", name=name, message=missing.message)
        raise ModelError([Finding("error", "", "mechanism", message, missing.remedy, "reference")]) from None


class OfMechanism(Problem):
    """A calculation about a mechanism, which its file names."""

    mechanism: Mechanism

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> Self:
        return cls(**{**values, "mechanism": load_referenced(values["mechanism"], folder)})
