"""End stops: outputs that go no further in motion under forces; the section ``stops`` of a model file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, cast

from linkwright.core.outputs import Output
from linkwright.fields.base import Field, Quantity, Schema, Word, quantity_schema
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import OutputName
from linkwright.words import _

Side = Literal["below", "above"]


@dataclass(frozen=True)
class AlongOutput(Field):
    """A value of the output that the earlier field ``of`` of the same table names."""

    of: str

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> float | None:
        output = siblings.get(self.of)
        return None if output is None else reader.quantity(node, place, output.dimension)

    def shape(self) -> Schema:
        return {"anyOf": [{"type": "string"}, {"const": 0}], "examples": [quantity_schema("length")["examples"][0]]}

    def flatten(self, value: Any) -> dict[str, float]:
        return {"": value}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return lookup("")


#: The keys of a stop in a file.
STOP_FIELDS: Mapping[str, Field] = {
    "of": OutputName(
        required=True, doc=_("the output that is stopped: a link (its angle), POINT.x or POINT.y, or a guide")
    ),
    "at": AlongOutput("of", required=True, doc=_("value of the output at which it is stopped")),
    "side": Word(
        ("below", "above"), required=True, doc=_("below: the output does not go below that value; above: not above")
    ),
    "restitution": Quantity(
        "dimensionless",
        minimum=0,
        maximum=1,
        doc=_("speed after the impact over the speed before: 0, no rebound, to 1, no loss (default 0)"),
    ),
}


@dataclass(frozen=True)
class Stop:
    """An end stop: the output ``of`` does not go ``below``, or ``above``, the value ``at`` (rad or m).

    ``restitution``: speed after an impact over the speed before, 0 to 1 (Newton's law of impact).
    """

    section: ClassVar[str] = "stops"
    name: str
    of: Output
    at: float
    side: Side
    restitution: float = 0.0

    @classmethod
    def of_values(cls, name: str, values: Mapping[str, Any]) -> Stop:
        """The stop of these keys of a file."""
        return cls(name, values["of"], values["at"], values["side"], values.get("restitution") or 0.0)

    @staticmethod
    def fields() -> Mapping[str, Field]:
        """The keys of a stop in a file."""
        return STOP_FIELDS

    def dimensions(self) -> dict[str, float]:
        """Addresses ``stops.NAME.at``, ``stops.NAME.restitution`` with their SI values."""
        return {f"stops.{self.name}.at": self.at, f"stops.{self.name}.restitution": self.restitution}

    def with_dimensions(self, value: Callable[[str], float]) -> Stop:
        """The same stop with the values that ``value`` gives for the addresses of ``dimensions``."""
        at, restitution = (value(address) for address in self.dimensions())
        return replace(self, at=at, restitution=restitution)

    def written(self) -> dict[str, Any]:
        """As plain data for a file."""
        place = Quantity(self.of.dimension).written(self.at)
        found = {"of": str(self.of), "at": place, "side": cast(str, self.side)}
        return {**found, "restitution": self.restitution} if self.restitution else found
