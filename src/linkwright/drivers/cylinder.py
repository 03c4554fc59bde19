"""Two points as one element: a driver whose coordinate is their distance, as of a hydraulic cylinder."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from linkwright.fields.base import Field, Quantities, Schema, table_schema
from linkwright.fields.body import BODY_FIELDS
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import LinkPoint, PointReferences
from linkwright.words import _


@dataclass(frozen=True)
class Body(Field):
    """The table of barrel or rod, whose values are read as those of the link that it becomes."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        mapping = reader.mapping(node, place)
        if mapping is not None:
            reader.unknown_keys(mapping, place, list(BODY_FIELDS))
        return mapping

    def shape(self) -> Schema:
        return table_schema(BODY_FIELDS)


@dataclass(frozen=True)
class Stroke(Quantities):
    """The shortest and the longest distance."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> tuple[float, ...] | None:
        found = super().read(reader, node, place, siblings)
        if found is not None and found[0] >= found[1]:
            message, remedy = _("the first length is not below the second"), _("exchange them")
            reader.error(node, place, message, remedy, "range")
            return None
        return found


CYLINDER_FIELDS: Mapping[str, Field] = {
    "between": PointReferences(required=True, doc=_("the two points whose distance is driven, [frame.U, boom.K]")),
    "stroke": Stroke("length", count=2, above=0, doc=_("shortest and longest distance (default: no limits)")),
    "barrel": Body(doc=_("mass of the part at the first point, its axes from the first point to the second")),
    "rod": Body(doc=_("mass of the part at the second point, in axes of the same direction")),
}


def barrel_name(driver: str) -> str:
    """The link that a driver between two points has at the first."""
    return f"{driver}_barrel"


def rod_name(driver: str) -> str:
    """The link that a driver between two points has at the second."""
    return f"{driver}_rod"


@dataclass(frozen=True)
class Cylinder:
    """The points (on links) between which a driver acts, and the shortest and the longest distance, m.

    In the mechanism it is a barrel, a rod, and a prismatic joint between them that has the driver's name: the
    distance is the joint's displacement, the driver's effort (N) the thrust, negative where it pulls.
    """

    between: tuple[LinkPoint, LinkPoint]
    stroke: tuple[float, float] | None = None

    def dimensions(self) -> Mapping[str, float]:
        """Names of its dimensions within the driver with their SI values."""
        return {} if self.stroke is None else {f"stroke.{k}": each for k, each in enumerate(self.stroke)}

    def with_dimensions(self, value: Callable[[str], float]) -> Cylinder:
        """The same with the values that ``value`` gives for the names of ``dimensions``."""
        return self if self.stroke is None else replace(self, stroke=(value("stroke.0"), value("stroke.1")))

    def written(self) -> dict[str, Any]:
        """Points and stroke as plain data for a file."""
        values = {"between": self.between, "stroke": self.stroke}
        return {key: CYLINDER_FIELDS[key].written(each) for key, each in values.items() if each is not None}
