"""Fields that refer to links, points and joints of the model by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import TYPE_CHECKING, Any

from linkwright.core.dataclass import dataclass
from linkwright.fields.base import Field, Schema, pair_schema, quantity_schema, written_quantity
from linkwright.fields.nodes import Node, Sequence

if TYPE_CHECKING:
    from linkwright.files.plain_reader import Place
    from linkwright.files.reader import Reader


@dataclass(frozen=True)
class LinkPoint:
    """A point of a link."""

    link: str
    point: str

    def __str__(self) -> str:
        return f"{self.link}.{self.point}"


@dataclass(frozen=True)
class LinkName(Field):
    """The name of a link; ``moving`` excludes the frame."""

    moving: bool = field(default=False, kw_only=True)

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> str | None:
        name = reader.text(node, place)
        if name is None or not reader.known(node, place, "link", name, list(reader.names.links)):
            return None
        if self.moving and name == "frame":
            reader.finding(node, place, "frame_at_rest", "reference")
            return None
        return name

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "link"}


@dataclass(frozen=True)
class PointName(Field):
    """The name of a point of the link that the field ``of`` of the same table names."""

    of: str

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> str | None:
        name, link = reader.text(node, place), given.get(self.of)
        if name is None:
            return None
        return name if link is None or reader.point_of(node, place, name, link) else None

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "point", "x-of": self.of}


@dataclass(frozen=True)
class PointPair(Field):
    """Two different points ``[P, Q]`` of the link that the field ``of`` names: the ray from P to Q."""

    of: str

    def read(
        self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]
    ) -> tuple[str, str] | None:
        return reader.ray(node, place, given.get(self.of))

    def shape(self) -> Schema:
        return pair_schema(PointName(self.of).shape())

    def written(self, value: Any) -> Any:
        return list(value)


@dataclass(frozen=True)
class PointReference(Field):
    """A point of the mechanism: ``link.point``, or only ``point`` where the name leaves no doubt."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> LinkPoint | None:
        text = reader.text(node, place)
        return None if text is None else reader.link_point(node, place, text)

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "link.point"}

    def written(self, value: Any) -> Any:
        return str(value)


@dataclass(frozen=True)
class PointReferences(Field):
    """Two points of the mechanism, ``[link.point, point]``."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        items = reader.items(node, place, 2, "[crank.A, O3]")
        if items is None:
            return None
        one = PointReference()
        found = [one.read(reader, item, place.child(str(index)), given) for index, item in enumerate(items)]
        return reader.two(node, place, found, "point")

    def shape(self) -> Schema:
        return pair_schema(PointReference().shape())

    def written(self, value: Any) -> Any:
        return [str(point) for point in value]


@dataclass(frozen=True)
class Direction(Field):
    """A direction in the axes of the link that the field ``of`` names: an angle, or two points [P, Q] of it."""

    of: str = "guide"

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        if isinstance(node, Sequence):
            return reader.ray(node, place, given.get(self.of))
        return reader.quantity(node, place, "angle")

    def shape(self) -> Schema:
        pair = pair_schema({"type": "string"})
        return {"anyOf": [*quantity_schema("angle")["anyOf"], pair], "x-dimension": "angle"}

    def written(self, value: Any) -> Any:
        return written_quantity(value, "angle") if isinstance(value, float) else list(value)


@dataclass(frozen=True)
class LinkNames(Field):
    """Two different links [a, b]."""

    def read(
        self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]
    ) -> tuple[str, str] | None:
        items = reader.items(node, place, 2, "[a, b]")
        if items is None:
            return None
        return reader.two(
            node, place, [LinkName().read(reader, item, place, given) for item in items], "link"
        )

    def shape(self) -> Schema:
        return pair_schema(LinkName().shape())
