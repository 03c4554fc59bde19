"""Fields for what changes over the cycle: outputs, magnitudes, tables over an output, and phases."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from typing import Any, Literal

from linkwright.core.dataclass import dataclass
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.fields.base import (
    Field,
    Quantities,
    Schema,
    Word,
    quantity_schema,
    table_schema,
    written_quantity,
)
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.strokes import PARTS, StrokePart, StrokePartField
from linkwright.words.sentence import Sentence

Limit = Literal["max", "min"]


@dataclass(frozen=True)
class OutputName(Field):
    """An output: a link's name (its angle), POINT.x or POINT.y, a prismatic joint's name (its
    displacement); or the same as results are named, ``jaw.angle``."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Output | None:
        text = reader.text(node, place)
        return None if text is None else reader.output(node, place, text)

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "output"}

    def written(self, value: Any) -> Any:
        return str(value)


@dataclass(frozen=True)
class Magnitude(Field):
    """A quantity, or an expression of ``t``, ``input`` (the first driver's coordinate) and outputs."""

    dimension: str

    def read(
        self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]
    ) -> float | Expression | None:
        return reader.magnitude(node, place, self.dimension)

    def shape(self) -> Schema:
        return {**quantity_schema(self.dimension), "x-variables": ["t", "input", "OUTPUT"]}

    def flatten(self, value: Any) -> dict[str, float]:
        return {"": value} if isinstance(value, float) else {}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return lookup("") if isinstance(value, float) else value

    def written(self, value: Any) -> Any:
        return written_quantity(value, self.dimension)


@dataclass(frozen=True)
class Table:
    """Values ``y`` at increasing ``x`` of ``over``: the input, the time, or an output.

    ``linear``: straight lines between them; ``cubic``: a spline with continuous second derivative, its ends "not a
    knot"; ``periodic``: one that goes on from its end as from its beginning, over whole turns of an angle.
    """

    over: Literal["input", "time"] | Output
    x: tuple[float, ...]
    y: tuple[float, ...]
    across: str = "angle"  # dimension of x
    interpolation: Literal["linear", "cubic", "periodic"] = "linear"


@dataclass(frozen=True)
class TableField(Field):
    """A mapping ``{over: input | time | OUTPUT, x: […], y: […], interpolation: linear}``."""

    dimension: str

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Table | None:
        over: Literal["input", "time"] | Output | None = "input"
        across = "angle"
        if isinstance(node, MappingNode):
            over, across = reader.over(node, place)
        with reader.plain_numbers(Sentence("model.plain_table")):
            values = reader.table(node, place, self._fields(across))
        if values is None or over is None or values.get("x") is None or values.get("y") is None:
            return None
        if not reader.increasing(node, place, "x", values["x"], values["y"], "y"):
            return None
        table = Table(over, values["x"], values["y"], across, values.get("interpolation") or "linear")
        fault = _fault_of_period(table)
        if fault is not None:
            reader.finding(node, place, fault, "table", Sentence("model.periodic_or_cubic"))
            return None
        return table

    def _fields(self, across: str) -> dict[str, Field]:
        from linkwright.fields.base import Text

        return {
            "over": Text(required=True, doc="input, time, or an output"),
            "x": Quantities(across, required=True, doc="increasing values of what the table goes over"),
            "y": Quantities(self.dimension, required=True, doc="the magnitude at each x"),
            "interpolation": Word(("linear", "cubic", "periodic"), doc="default linear"),
        }

    def shape(self) -> Schema:
        shape = table_schema(self._fields("angle"))
        shape["properties"]["x"] = {"type": "array", "items": {"type": ["string", "number"]}}
        return shape

    def written(self, value: Any) -> Any:
        given = {
            "over": str(value.over),
            "x": [written_quantity(x, value.across) for x in value.x],
            "y": [written_quantity(y, self.dimension) for y in value.y],
        }
        return given if value.interpolation == "linear" else {**given, "interpolation": value.interpolation}


def _fault_of_period(table: Table) -> str | None:
    """What keeps a table that is said to be periodic from being so."""
    if table.interpolation != "periodic":
        return None
    turns = (table.x[-1] - table.x[0]) / math.tau
    if (
        table.over == "time"
        or table.across != "angle"
        or round(turns) < 1
        or abs(turns - round(turns)) > 1e-6
    ):
        return "periodic_span"
    close = abs(table.y[-1] - table.y[0]) <= 1e-9 * max(map(abs, table.y))
    return None if close else "periodic_ends"


@dataclass(frozen=True)
class InputPhase:
    """While the first driver's coordinate is between ``start`` and ``end`` (rad or m; angles modulo one
    turn)."""

    start: float
    end: float
    across: str = "angle"  # dimension of both


@dataclass(frozen=True)
class MovingPhase:
    """While an output increases or decreases."""

    output: Output
    direction: Literal["increasing", "decreasing"]

    @property
    def start(self) -> Limit:
        """The limit at which that begins."""
        return "min" if self.direction == "increasing" else "max"

    @property
    def end(self) -> Limit:
        """The limit at which it ends."""
        return "max" if self.direction == "increasing" else "min"


@dataclass(frozen=True)
class SwingPhase:
    """While an output goes from one of its limits to the other, both found by the program; ``part`` of that."""

    output: Output
    start: Limit
    end: Limit
    part: StrokePart | None = None


Phase = InputPhase | MovingPhase | SwingPhase


@dataclass(frozen=True)
class PhaseField(Field):
    """``{input: [a, b]}``, ``{moving: OUTPUT, direction: increasing}`` or ``{of: OUTPUT, from: max, to: min}``,
    the last with ``first``, ``last`` or ``free`` for a part of the stroke."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Phase | None:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        forms = self._forms(reader.input_dimension())
        chosen = [key for key in forms if mapping.get(key) is not None]
        if len(chosen) != 1:
            reader.error(
                node,
                place,
                Sentence("model.several_forms" if chosen else "model.no_form"),
                Sentence("model.write_phase"),
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
                "input": Quantities(across, count=2, required=True, doc="from, to of the input's coordinate")
            },
            "moving": {
                "moving": OutputName(required=True, doc="an output"),
                "direction": Word(("increasing", "decreasing"), required=True),
            },
            "of": {
                "of": OutputName(required=True, doc="an output"),
                "from": Word(limits, required=True),
                "to": Word(limits, required=True),
                **{word: StrokePartField(word, doc=doc) for word, doc in PARTS.items()},
            },
        }

    def shape(self) -> Schema:
        return {"oneOf": [table_schema(form) for form in self._forms("angle").values()]}

    def flatten(self, value: Any) -> dict[str, float]:
        return {".input.0": value.start, ".input.1": value.end} if isinstance(value, InputPhase) else {}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        if not isinstance(value, InputPhase):
            return value
        return InputPhase(lookup(".input.0"), lookup(".input.1"), value.across)

    def written(self, value: Any) -> Any:
        match value:
            case InputPhase(start, end, across):
                return {"input": [written_quantity(start, across), written_quantity(end, across)]}
            case MovingPhase(output, direction):
                return {"moving": str(output), "direction": direction}
        found = {"of": str(value.output), "from": value.start, "to": value.end}
        return found if value.part is None else {**found, **value.part.written(value.output.dimension)}


def _phase(reader: Reader, node: Node, place: Place, values: Mapping[str, Any]) -> Phase | None:
    if "input" in values:
        start, end = values["input"]
        if start == end:
            reader.finding(node, place, "phase_empty", "range")
            return None
        return InputPhase(start, end, reader.input_dimension())
    if "moving" in values:
        return MovingPhase(values["moving"], values["direction"])
    if values["from"] == values["to"]:
        reader.finding(node, place, "from_is_to", "range", end=values["from"])
        return None
    parts = [values[word] for word in PARTS if values.get(word) is not None]
    if len(parts) > 1:
        words = tuple(part.word for part in parts)
        reader.finding(node, place, "several_parts", "choice", words=words)
        return None
    return SwingPhase(values["of"], values["from"], values["to"], *parts)


def resolve_output(text: str, links: Mapping[str, Collection[str]], slides: Collection[str]) -> Output | None:
    """The output that a text means, given each link's points and the joints with a displacement; None where it means
    none. ``jaw`` or ``jaw.angle``, ``guide`` or ``guide.displacement``, ``C.x`` or ``C.position.x``."""
    owner, _, part = text.rpartition(".")
    for kind, owners in (("angle", links), ("displacement", slides)):
        name = owner if part == kind else text
        if name in owners and name != "frame":
            return Output(kind, name)
    if part not in ("x", "y"):
        return None
    owner = owner.removesuffix(".position")
    link, _, point = owner.rpartition(".")
    if link:
        return Output("position", owner, part) if point in links.get(link, ()) else None
    having = [name for name, points in links.items() if point in points]
    return Output("position", f"{having[0]}.{point}", part, written=f"{point}.{part}") if having else None
