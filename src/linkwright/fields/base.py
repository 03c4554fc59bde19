"""What a key of a model file may hold: one class per kind of value, with its reading, its schema and its
text.

A table of the file (a link, a joint, a load) is declared as named fields; unit checks, findings with the
nearest key, the JSON Schema and the writing of files all follow from that declaration.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any, ClassVar, cast

from linkwright import units
from linkwright.core.attached import SECTIONS
from linkwright.core.entry_points import loaded
from linkwright.core.expressions import Expression
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Section
from linkwright.fields.reading import Place, Reader
from linkwright.words import LANGUAGES, Message, _, pgettext
from linkwright.words.message import LocalizedText

Schema = dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class Field(ABC):
    """One key of a table. ``key`` is its name in the file where it differs from the attribute's, ``old`` a name that
    it had in files of the same format, which is read with a warning; likewise a key that another one
    has ``replaced``.
    """

    required: bool = False
    doc: str = ""
    key: str = ""
    old: str = ""
    replaced: str = ""

    #: Whether it has a value where nothing is written behind its key, in sections that only some commands read.
    bare: ClassVar[bool] = False

    @abstractmethod
    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        """The value at the node, or None after a finding; ``siblings`` are the table's values read so far."""

    @abstractmethod
    def shape(self) -> Schema:
        """JSON Schema of the value, without the description."""

    def schema(self) -> Schema:
        """JSON Schema of the value with its description."""
        return {**self.shape(), "description": self.doc} if self.doc else self.shape()

    def limit(self, value: float) -> Message | None:
        """What numbers it takes, where this SI value is none of them."""
        return None

    def flatten(self, value: Any) -> dict[str, float]:
        """The value's dimensions: suffixes of the address (``""``, ``.x``) with SI values."""
        return {}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        """The value with its dimensions replaced by what ``lookup`` gives for the suffixes of ``flatten``."""
        return value

    def written(self, value: Any) -> Any:
        """The value as plain data (texts, lists, mappings) for a file."""
        return value


#: No default: the key must be there.
REQUIRED: Any = object()


def file_key(kind: Field, default: Any = REQUIRED) -> Any:
    """An attribute of a dataclass that a file gives; without a default the file must have it.

    A default that is a type, such as ``dict``, is called for every object.
    """
    if default is REQUIRED:
        return field(metadata={"field": replace(kind, required=True)})
    if isinstance(default, type):
        return field(default_factory=default, metadata={"field": kind})
    return field(default=default, metadata={"field": kind})


def file_keys(made: Any) -> dict[str, Field]:
    """The attributes of a dataclass that :func:`file_key` declares."""
    return {each.name: each.metadata["field"] for each in fields(made) if "field" in each.metadata}


class FileKeys:
    """As attribute of a class: what :func:`file_key` declares in it and in its bases, and ``more`` keys."""

    def __init__(self, more: Mapping[str, Field] | None = None) -> None:
        self.more = more or {}

    def __get__(self, instance: object, owner: type) -> Mapping[str, Field]:
        return {**file_keys(owner), **self.more}


def quantity_schema(dimension: str) -> Schema:
    """JSON Schema of a quantity: a text with a unit, or a bare 0; a number where it is dimensionless."""
    bare: Schema = {"type": "number"} if dimension == "dimensionless" else {"const": 0}
    return {"anyOf": [{"type": "string"}, bare], "x-dimension": dimension, "examples": [units.example(dimension)]}


def pair_schema(one: Schema) -> Schema:
    """JSON Schema of a list of two."""
    return {"type": "array", "items": one, "minItems": 2, "maxItems": 2}


def written_quantity(value: Any, dimension: str) -> Any:
    """A quantity as written in a file: text with the SI unit, an expression's text, a bare number."""
    if isinstance(value, Expression):
        return value.text
    if dimension == "dimensionless" or value == 0:
        return float(value)
    return units.format(value, dimension)


@dataclass(frozen=True)
class Quantity(Field):
    """A number with a unit, in SI; limits are in SI as well."""

    dimension: str
    minimum: float | None = field(default=None, kw_only=True)
    above: float | None = field(default=None, kw_only=True)
    below: float | None = field(default=None, kw_only=True)
    maximum: float | None = field(default=None, kw_only=True)
    nonzero: bool = field(default=False, kw_only=True)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> float | None:
        value = self._value(reader, node, place)
        limit = None if value is None else self.limit(value)
        if value is None or limit is None:
            return value
        shown = node.text if isinstance(node, Scalar) else f"{value:g}"
        reader.finding(
            node,
            place,
            _("{shown} is {fault}"),
            "range",
            _("give {limit}"),
            shown=shown,
            fault=self._fault(value),
            limit=limit,
        )
        return None

    def _value(self, reader: Reader, node: Node, place: Place) -> float | None:
        return reader.quantity(node, place, self.dimension)

    def _fault(self, value: float) -> str:
        if value == 0:
            return _("zero", code="model.zero")
        if (self.below is not None and value >= self.below) or value > (self.maximum or math.inf):
            return _("too large", code="model.too_large")
        return (
            _("negative", code="model.negative") if value < 0 and not (self.minimum or self.above) else _("too small")
        )

    def limit(self, value: float) -> Message | None:
        above = self.above is None or value > max(self.above, units.SMALLEST)
        within = above and (self.minimum is None or value >= self.minimum)
        within &= (self.below is None or value < self.below) and value <= (self.maximum or math.inf)
        if within and not (self.nonzero and value == 0):
            return None
        noun, minimum = (units.NOUNS[self.dimension], self.minimum if self.above is None else self.above)
        most = self.below or self.maximum
        if most is not None and self.above is not None:
            message = (
                _("{noun} above {low} and below {high}") if self.below else _("{noun} above {low}, up to {high}")
            )
            return message.format(noun=noun, low=f"{self.above:g}", high=units.format(most, self.dimension))
        if self.maximum is not None:
            low, high = (units.format(each, self.dimension) for each in (minimum or 0.0, self.maximum))
            return _("{noun} from {low} to {high}", noun=noun, low=low, high=high)
        if self.below is not None:
            unit = "deg" if self.dimension == "angle" else None
            low, high = (units.format(each, self.dimension, unit) for each in (minimum or 0.0, self.below))
            return _("{noun} from {low} to below {high}", code="model.from_to_below", noun=noun, low=low, high=high)
        if minimum is None:
            return _("{noun} other than zero", code="model.not_zero", noun=noun)
        shown = units.format(minimum, self.dimension) if minimum else pgettext("model", "zero")
        return (
            _("{noun} of {limit} or more", code="model.or_more")
            if self.above is None
            else _("{noun} above {limit}", code="model.above")
        ).format(noun=noun, limit=shown)

    def shape(self) -> Schema:
        return quantity_schema(self.dimension)

    def flatten(self, value: Any) -> dict[str, float]:
        return {} if value is None else {"": value}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return None if value is None else lookup("")

    def written(self, value: Any) -> Any:
        return written_quantity(value, self.dimension)


@dataclass(frozen=True)
class Number(Quantity):
    """A number without a unit, written out: no expression of parameters."""

    dimension: str = "dimensionless"

    def _value(self, reader: Reader, node: Node, place: Place) -> float | None:
        text = reader.text(node, place)
        if text is None:
            return None
        with suppress(ValueError):
            if math.isfinite(found := float(text)):
                return found
        message = _('invalid number "{text}"; write it with a point and without a unit, such as 0.9', text=text)
        reader.error(node, place, message, "", "type")
        return None

    def shape(self) -> Schema:
        return {"type": "number"}


@dataclass(frozen=True)
class Quantities(Field):
    """A list of quantities of one dimension; ``names`` names them (x, y), ``count`` limits their number, each is
    ``above`` a limit in SI."""

    dimension: str
    names: tuple[str, ...] = ()
    count: int | None = None
    above: float | None = field(default=None, kw_only=True)
    form: str = field(default="", kw_only=True)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> tuple[float, ...] | None:
        items = reader.items(node, place, len(self.names) or self.count, self._form)
        if items is None:
            return None
        values = [
            self._one.read(reader, item, place.child(self._suffix(index)), siblings)
            for index, item in enumerate(items)
        ]
        return None if any(value is None for value in values) else tuple(v for v in values if v is not None)

    @cached_property
    def _one(self) -> Quantity:
        return Quantity(self.dimension, above=self.above)

    def limit(self, value: float) -> Message | None:
        return self._one.limit(value)

    @cached_property
    def _form(self) -> str:
        if self.form:
            return self.form
        one = units.example(self.dimension)
        return f"[{', '.join([one] * (len(self.names) or self.count or 2))}]"

    def _suffix(self, index: int) -> str:
        return self.names[index] if self.names else str(index)

    def shape(self) -> Schema:
        size = len(self.names) or self.count
        limits = {"minItems": size, "maxItems": size} if size else {}
        return {"type": "array", "items": quantity_schema(self.dimension), **limits}

    def flatten(self, value: Any) -> dict[str, float]:
        return {} if value is None else {f".{self._suffix(index)}": each for index, each in enumerate(value)}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return None if value is None else tuple(lookup(suffix) for suffix in self.flatten(value))

    def written(self, value: Any) -> Any:
        return [written_quantity(each, self.dimension) for each in value]


@dataclass(frozen=True)
class Text(Field):
    """Any text."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        return reader.text(node, place)

    def shape(self) -> Schema:
        return {"type": "string"}


@dataclass(frozen=True)
class LocalizedTextField(Text):
    """Any text, or one in each language: ``{en: Press, zh: 压力机}``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        if not isinstance(node, MappingNode) or not node.entries:
            return super().read(reader, node, place, siblings)
        texts = reader.table(node, place, _IN_LANGUAGES) or {}
        by_language = {language: text for language, text in texts.items() if text}
        return LocalizedText(by_language) if by_language else None

    def shape(self) -> Schema:
        texts = {language: field.shape() for language, field in _IN_LANGUAGES.items()}
        by_language: Schema = {
            "type": "object",
            "properties": texts,
            "additionalProperties": False,
            "minProperties": 1,
        }
        return {"anyOf": [super().shape(), by_language]}

    def written(self, value: Any) -> Any:
        return dict(value.texts) if isinstance(value, LocalizedText) else value


_IN_LANGUAGES: Mapping[str, Field] = {language: Text(doc=f"the text, {language}") for language in LANGUAGES}


@dataclass(frozen=True)
class Word(Field):
    """One of a few words."""

    choices: tuple[str, ...]

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        return reader.word(node, place, self.choices)

    def shape(self) -> Schema:
        return {"enum": list(self.choices)}


@dataclass(frozen=True)
class Free(Field):
    """A free mapping that is stored and not interpreted; ``section``: the key under which a command's room declares
    what it reads in it."""

    section: str = ""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        mapping = reader.mapping(node, place)
        return None if mapping is None else Section(reader.free(mapping), mapping, reader.source)

    def shape(self) -> Schema:
        return cast(Field, loaded(SECTIONS[self.section])).shape() if self.section else {"type": "object"}


@dataclass(frozen=True)
class Count(Field):
    """An integer with one allowed value, such as the version of the format."""

    only: int

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> int | None:
        text = reader.text(node, place)
        if text is None or text.strip() == str(self.only):
            return self.only
        reader.finding(
            node,
            place,
            _('version "{text}" is not known'),
            "version",
            _("write {key_}: {only}"),
            text=text,
            key_=place.key,
            only=self.only,
        )
        return None

    def shape(self) -> Schema:
        return {"const": self.only}


@dataclass(frozen=True)
class Formula(Field):
    """An expression of the time ``t`` and of named parameters."""

    dimension: str

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Expression | None:
        return reader.formula(node, place, self.dimension, {"t": units.DIMENSIONS["time"]})

    def shape(self) -> Schema:
        return {"type": "string", "x-dimension": self.dimension, "x-variables": ["t"]}

    def written(self, value: Any) -> Any:
        return value.text


@dataclass(frozen=True)
class TimeTableValues:
    """Positions over time, with the way in which they are interpolated."""

    times: tuple[float, ...]
    positions: tuple[float, ...]
    interpolation: str = "cubic"


@dataclass(frozen=True)
class TimeTable(Field):
    """A mapping ``{time: […], position: […], interpolation: cubic}``."""

    dimension: str

    def _fields(self) -> dict[str, Field]:
        return {
            "time": Quantities("time", required=True, doc=_("increasing times")),
            "position": Quantities(self.dimension, required=True, doc=_("coordinate at each time")),
            "interpolation": Word(("cubic", "periodic", "linear"), doc=_("default cubic")),
        }

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> TimeTableValues | None:
        with reader.plain_numbers(_("a driver's table")):
            values = reader.table(node, place, self._fields())
        if values is None or values.get("time") is None or values.get("position") is None:
            return None
        times, positions = values["time"], values["position"]
        way = values.get("interpolation") or "cubic"
        if not reader.increasing(node, place, "time", times, positions, "position"):
            return None
        drift = positions[-1] - positions[0]
        turns = drift / (2 * math.pi) if self.dimension == "angle" else drift / (abs(max(positions, key=abs)) or 1.0)
        if way == "periodic" and abs(turns - (round(turns) if self.dimension == "angle" else 0)) > 1e-6:
            problem = (
                _("a periodic table must end where it begins (or full turns further)")
                if self.dimension == "angle"
                else _("a periodic table must end where it begins")
            )
            reader.finding(node, place, problem, "table", _("make the last position equal to the first"))
            return None
        return TimeTableValues(times, positions, way)

    def shape(self) -> Schema:
        return table_schema(self._fields())

    def written(self, value: Any) -> Any:
        fields = self._fields()
        return {
            "time": fields["time"].written(value.times),
            "position": fields["position"].written(value.positions),
            "interpolation": value.interpolation,
        }


def table_schema(fields: Mapping[str, Field]) -> Schema:
    """JSON Schema of a mapping with these fields and no others."""
    keys = {each.key or name: each for name, each in fields.items()}
    required = [key for key, each in keys.items() if each.required]
    found: Schema = {
        "type": "object",
        "properties": {key: each.schema() for key, each in keys.items()},
        "additionalProperties": False,
    }
    return {**found, "required": required} if required else found
