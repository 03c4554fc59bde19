"""The keys of a file that give a magnitude: its size as a number, an expression, a ramp or a table, and its phase."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

from linkwright.applied_loads.phases import InputPhase, MovingPhase, Phase, SwingPhase
from linkwright.applied_loads.sizes import Constant, Formula, Ramp, Table
from linkwright.applied_loads.strokes import Amount, PartWord, StrokePart
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.fields.base import (
    Field,
    Quantities,
    Schema,
    Text,
    Word,
    pair_schema,
    quantity_schema,
    table_schema,
    written_quantity,
)
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import OutputName
from linkwright.words import Message, _

#: Keys of a phase that name a part of the stroke.
PARTS: Mapping[PartWord, Message] = {
    "first": _("only the first part of the stroke: a share (0.2) or a way (10 mm)"),
    "last": _("only the last part of the stroke: a share (0.2) or a way (10 mm)"),
    "free": _("free parts at both ends, or [at the beginning, at the end]: shares (0.05) or ways (10 mm)"),
}


def magnitude_fields(dimension: str, word: str) -> dict[str, Field]:
    """The keys of a magnitude by their names; ``word``: what it is."""
    return {
        "magnitude": SizeField(dimension, doc=word),
        "ramp": RampField(dimension, (), 2, doc=_("from, to over the phase")),
        "table": TableField(dimension, doc=_("{what} over the input, the time or an output", what=word)),
        "phase": PhaseField(doc=_("when the load acts (default: always)")),
    }


class _Part(Field):
    """A part of a magnitude, which knows its own dimensions."""

    def flatten(self, value: Any) -> dict[str, float]:
        return {suffix: getattr(value, name) for suffix, name in value.numbers.items()}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return replace(value, **{name: lookup(suffix) for suffix, name in value.numbers.items()})


@dataclass(frozen=True)
class SizeField(_Part):
    """A quantity, or an expression of ``t``, ``input`` (the first driver's coordinate) and outputs."""

    dimension: str

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> Constant | Formula | None:
        found = reader.magnitude(node, place, self.dimension)
        if isinstance(found, Expression):
            return Formula(found)
        return None if found is None else Constant(found)

    def shape(self) -> Schema:
        return {**quantity_schema(self.dimension), "x-variables": ["t", "input", "OUTPUT"]}

    def written(self, value: Any) -> Any:
        size = value.expression if isinstance(value, Formula) else value.value
        return written_quantity(size, self.dimension)


@dataclass(frozen=True)
class RampField(_Part, Quantities):
    """Two quantities, at the beginning and at the end of the phase."""

    def read(  # type: ignore[override]
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> Ramp | None:
        found = super().read(reader, node, place, siblings)
        return None if found is None else Ramp(*found)

    def written(self, value: Any) -> Any:
        return super().written((value.start, value.end))


@dataclass(frozen=True)
class TableField(_Part):
    """A mapping ``{over: input | time | OUTPUT, x: […], y: […], interpolation: linear}``."""

    dimension: str

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Table | None:
        over: Literal["input", "time"] | Output | None = "input"
        across = "angle"
        if isinstance(node, MappingNode):
            over, across = reader.over(node, place)
        with reader.plain_numbers(_("a table")):
            values = reader.table(node, place, self._fields(across))
        if values is None or over is None or values.get("x") is None or values.get("y") is None:
            return None
        if not reader.increasing(node, place, "x", values["x"], values["y"], "y"):
            return None
        table = Table(over, values["x"], values["y"], across, values.get("interpolation") or "linear")
        fault = _fault_of_period(table)
        if fault is not None:
            reader.finding(
                node,
                place,
                fault,
                "table",
                _(
                    "close it (full turns, the last value as the first), or write interpolation: cubic",
                    code="model.periodic_or_cubic",
                ),
            )
            return None
        return table

    def _fields(self, across: str) -> dict[str, Field]:
        return {
            "over": Text(required=True, doc=_("input, time, or an output")),
            "x": Quantities(across, required=True, doc="increasing values of what the table goes over"),
            "y": Quantities(self.dimension, required=True, doc=_("the magnitude at each x")),
            "interpolation": Word(("linear", "cubic", "periodic"), doc=_("default linear")),
        }

    def shape(self) -> Schema:
        shape = table_schema(self._fields("angle"))
        shape["properties"]["x"] = {"type": "array", "items": {"type": ["string", "number"]}}
        return shape

    def written(self, value: Any) -> Any:
        mapping = {
            "over": str(value.over),
            "x": [written_quantity(x, value.across) for x in value.x],
            "y": [written_quantity(y, self.dimension) for y in value.y],
        }
        return mapping if value.interpolation == "linear" else {**mapping, "interpolation": value.interpolation}


def _fault_of_period(table: Table) -> Message | None:
    """Why a table that is declared periodic is not."""
    if table.interpolation != "periodic":
        return None
    turns = (table.x[-1] - table.x[0]) / math.tau
    of_angle = table.over != "time" and table.across == "angle"
    if not of_angle or round(turns) < 1 or abs(turns - round(turns)) > 1e-6:
        return _("a periodic table covers full turns of an angle, and this one does not")
    close = abs(table.y[-1] - table.y[0]) <= 1e-9 * max(map(abs, table.y))
    return None if close else _("a periodic table must end where it begins")


@dataclass(frozen=True)
class PhaseField(_Part):
    """``{input: [a, b]}``, ``{moving: OUTPUT, direction: increasing}`` or ``{of: OUTPUT, from: max, to: min}``,
    the last with ``first``, ``last`` or ``free`` for a part of the stroke."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Phase | None:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        forms = self._forms(reader.input_dimension())
        chosen = [key for key in forms if mapping.get(key) is not None]
        if len(chosen) != 1:
            reader.error(
                node,
                place,
                (_("several forms of a phase") if chosen else _("no form of a phase")),
                _(
                    "write one of {{input: [a, b]}}, {{moving: OUTPUT, direction: increasing}}, {{of: "
                    "OUTPUT, from: max, to: min}}"
                ),
                "choice",
            )
            return None
        values = reader.table(mapping, place, forms[chosen[0]])
        required = [name for name, each in forms[chosen[0]].items() if each.required]
        if values is None or any(values.get(name) is None for name in required):
            return None
        return _phase(reader, node, place, values)

    def _forms(self, across: str) -> dict[str, dict[str, Field]]:
        limits = ("max", "min")
        return {
            "input": {
                "input": Quantities(across, count=2, required=True, doc=_("from, to of the input's coordinate"))
            },
            "moving": {
                "moving": OutputName(required=True, doc=_("an output")),
                "direction": Word(("increasing", "decreasing"), required=True),
            },
            "of": {
                "of": OutputName(required=True, doc=_("an output")),
                "from": Word(limits, required=True),
                "to": Word(limits, required=True),
                **{word: StrokePartField(word, doc=doc) for word, doc in PARTS.items()},
            },
        }

    def shape(self) -> Schema:
        return {"oneOf": [table_schema(form) for form in self._forms("angle").values()]}

    def written(self, value: Any) -> Any:
        match value:
            case InputPhase(start, end, across):
                return {"input": [written_quantity(start, across), written_quantity(end, across)]}
            case MovingPhase(output, direction):
                return {"moving": str(output), "direction": direction}
        found = {"of": str(value.output), "from": value.start, "to": value.end}
        if (part := value.part) is None:
            return found
        dimension = value.output.dimension
        amounts = [a.value if a.share else written_quantity(a.value, dimension) for a in part.amounts]
        return {**found, part.word: amounts[0] if len(amounts) == 1 else amounts}


def _phase(reader: Reader, node: Node, place: Place, values: Mapping[str, Any]) -> Phase | None:
    if "input" in values:
        start, end = values["input"]
        if start == end:
            reader.finding(node, place, _("the phase begins where it ends"), "range", _("give two different values"))
            return None
        return InputPhase(start, end, reader.input_dimension())
    if "moving" in values:
        return MovingPhase(values["moving"], values["direction"])
    if values["from"] == values["to"]:
        reader.finding(
            node,
            place,
            _("from and to are both {end}"),
            "range",
            _("go from max to min or from min to max"),
            end=values["from"],
        )
        return None
    parts = [values[word] for word in PARTS if values.get(word) is not None]
    if len(parts) > 1:
        words = tuple(part.word for part in parts)
        reader.finding(
            node,
            place,
            _("several parts of the stroke are set: {words}"),
            "choice",
            _("keep one of them"),
            words=words,
        )
        return None
    return SwingPhase(values["of"], values["from"], values["to"], *parts)


@dataclass(frozen=True)
class StrokePartField(Field):
    """A share of a stroke or a way; for ``free`` also two of them. The output is the table's key ``of``."""

    word: PartWord

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> StrokePart | None:
        output = siblings.get("of")
        if output is None:
            return None
        nodes = [node]
        if self.word == "free" and isinstance(node, Sequence):
            nodes = reader.items(node, place, 2, "[0.05, 0.1]") or []
        with reader.plain_numbers(_("a part of a stroke")):
            found = [self._amount(reader, each, place, output.dimension) for each in nodes]
        amounts = tuple(amount for amount in found if amount is not None)
        return StrokePart(self.word, amounts) if amounts and len(amounts) == len(found) else None

    def _amount(self, reader: Reader, node: Node, place: Place, dimension: str) -> Amount | None:
        text = node.text if isinstance(node, Scalar) else ""
        try:
            found = Amount(float(text if isinstance(node, Scalar) and node.plain else "no number"), share=True)
        except ValueError:
            way = reader.quantity(node, place, dimension)
            if way is None:
                return None
            found = Amount(way, share=False)
        maximum = 1.0 if found.share else math.inf
        if 0 < found.value < maximum or found.value == (0 if self.word == "free" else maximum):
            return found
        example = "10 mm" if dimension == "length" else "5 deg"
        reader.finding(
            node,
            place,
            _('invalid part of a stroke "{text}"'),
            "range",
            _('give a share between 0 and 1, or a way such as "{example}"'),
            text=text,
            example=example,
        )
        return None

    def shape(self) -> Schema:
        one: Schema = {
            "anyOf": [{"type": "number", "minimum": 0, "maximum": 1}, quantity_schema("length")["anyOf"][0]]
        }
        if self.word != "free":
            return one
        return {"anyOf": [*one["anyOf"], pair_schema(one)]}
