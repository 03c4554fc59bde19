"""Fields that name links and points of the model, or place points."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from linkwright.core.outputs import Output
from linkwright.fields.base import Field, Quantities, Schema, pair_schema, quantity_schema, written_quantity
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Place, Reader
from linkwright.words import _


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

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        name = reader.text(node, place)
        if name is None or not reader.known(node, place, _("link"), name, list(reader.names.links)):
            return None
        if self.moving and name == "frame":
            reader.finding(node, place, _("the frame does not move"), "reference", _("name a moving link"))
            return None
        return name

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "link"}


@dataclass(frozen=True)
class PointName(Field):
    """The name of a point of the link that the field ``of`` of the same table names."""

    of: str

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        link = siblings.get(self.of)
        if isinstance(node, Sequence) and link is not None:
            reader.finding(
                node,
                place,
                _("coordinates stand where the name of a point is needed"),
                "type",
                _('give the point a name among the points of "{link}", and write that name here'),
                link=link,
            )
            return None
        name = reader.text(node, place)
        if name is None:
            return None
        return name if link is None or reader.point_of(node, place, name, link) else None

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "point", "x-of": self.of}


@dataclass(frozen=True)
class PointReference(Field):
    """A point of the mechanism: ``link.point``, or only ``point`` where the name leaves no doubt."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> LinkPoint | None:
        text = reader.text(node, place)
        return None if text is None else reader.link_point(node, place, text)

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "link.point"}

    def written(self, value: Any) -> Any:
        return str(value)


@dataclass(frozen=True)
class PlaceOrPoint(Quantities):
    """Coordinates in a link's axes, or the name of a point; the reader of the link knows whether it is there."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, Scalar) and node.text[:1].isalpha():
            return reader.text(node, place)
        return super().read(reader, node, place, siblings)

    def shape(self) -> Schema:
        return {"anyOf": [super().shape(), {"type": "string", "x-reference": "point"}]}

    def written(self, value: Any) -> Any:
        return value if isinstance(value, str) else super().written(value)


@dataclass(frozen=True)
class Two(Field):
    """Two different ones of a kind of references; ``form`` is an example, ``what`` they are: ``point``, ``link``."""

    form: ClassVar[str]
    what: ClassVar[str] = "point"

    @property
    @abstractmethod
    def one(self) -> Field:
        """The field of each."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        items = reader.items(node, place, 2, self.form)
        if items is None:
            return None
        a, b = (self.one.read(reader, item, place.child(str(k)), siblings) for k, item in enumerate(items))
        if a is None or b is None or a != b:
            return None if a is None or b is None else (a, b)
        problem, remedy = (
            (_('both links are "{first}"'), _("name two different links"))
            if self.what == "link"
            else (_("both points are {first}"), _("name two different points"))
        )
        reader.finding(node, place, problem, "reference", remedy, first=a)
        return None

    def shape(self) -> Schema:
        return pair_schema(self.one.shape())

    def written(self, value: Any) -> Any:
        return [self.one.written(each) for each in value]


@dataclass(frozen=True)
class LinkNames(Two):
    """Two different links [a, b]."""

    form: ClassVar[str] = "[a, b]"
    what: ClassVar[str] = "link"
    one: ClassVar[Field] = LinkName()


@dataclass(frozen=True)
class PointReferences(Two):
    """Two points of the mechanism, ``[link.point, point]``."""

    form: ClassVar[str] = "[crank.A, O3]"
    one: ClassVar[Field] = PointReference()


@dataclass(frozen=True)
class PointPair(Two):
    """Two different points ``[P, Q]`` of the link that the field ``of`` names: the ray from P to Q."""

    form: ClassVar[str] = "[P, Q]"
    of: str

    @property
    def one(self) -> Field:
        return PointName(self.of)


@dataclass(frozen=True)
class Direction(Field):
    """A direction in the axes of the link that the field ``of`` names: an angle, or two points [P, Q] of it."""

    dimension: ClassVar[str] = "angle"
    of: str = "guide"

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, Sequence):
            return PointPair(self.of).read(reader, node, place, siblings)
        return reader.quantity(node, place, "angle")

    def shape(self) -> Schema:
        pair = pair_schema({"type": "string"})
        return {"anyOf": [*quantity_schema("angle")["anyOf"], pair], "x-dimension": "angle"}

    def written(self, value: Any) -> Any:
        return written_quantity(value, "angle") if isinstance(value, float) else list(value)


#: The coordinates of a point, m.
PLACE = Quantities("length", ("x", "y"))


@dataclass(frozen=True)
class Coordinates(Field):
    """Points with their coordinates: ``{A: [0 m, 0 m], B: …}``, whose addresses leave out the key."""

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> dict[str, tuple[float, float] | None] | None:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        owner = place.outside()
        found: dict[str, tuple[float, float] | None] = {}
        for entry in mapping.entries:
            name = reader.name(entry.key, owner.child(entry.key.text), _("point"))
            if name is not None:
                found[name] = PLACE.read(reader, entry.value, owner.child(name), {})  # type: ignore[assignment]
        return found

    def shape(self) -> Schema:
        return {"type": "object", "additionalProperties": PLACE.shape()}


@dataclass(frozen=True)
class LinkPoints(Field):
    """The points of a link: a list of names, or a mapping of names to coordinates in the link's axes."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if isinstance(node, MappingNode):
            return Coordinates().read(reader, node, place, siblings)
        if not isinstance(node, Sequence):
            reader.items(node, place, None, "[A, B]")
            return None
        names: dict[str, None] = {}
        for index, item in enumerate(node.items):
            name = reader.name(item, place.child(str(index)), _("point"))
            if name in names:
                reader.finding(
                    item,
                    place,
                    _('the point "{name}" is listed twice'),
                    "duplicate",
                    _("remove one or rename it"),
                    name=name,
                )
            elif name is not None:
                names[name] = None
        return list(names)

    def shape(self) -> Schema:
        names: Schema = {"type": "array", "items": {"type": "string"}, "minItems": 1}
        return {"anyOf": [names, Coordinates().shape()]}


@dataclass(frozen=True)
class OutputName(Field):
    """An output: a link's name (its angle), POINT.x or POINT.y, a prismatic joint's name (its
    displacement); or the same as results are named, ``jaw.angle``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Output | None:
        text = reader.text(node, place)
        return None if text is None else reader.output(node, place, text)

    def shape(self) -> Schema:
        return {"type": "string", "x-reference": "output"}

    def written(self, value: Any) -> Any:
        return str(value)


def sliding(joints: Iterable[tuple[str, str, str]], links: Collection[str]) -> dict[str, str]:
    """Names that mean a displacement, with the joint that has it: joints that slide, with guide and block, but for
    those with the name of a link, and links that slide along the frame."""
    found: dict[str, str] = {}
    for name, guide, block in joints:
        own = [link for link in (guide, block) if link != "frame"]
        found |= dict.fromkeys({name} - set(links), name)
        if len(own) == 1:
            found.setdefault(own[0], name)
    return found


def resolve_output(text: str, links: Mapping[str, Collection[str]], slides: Mapping[str, str]) -> Output | None:
    """The place over the cycle that a text means, by each link's points and names of displacements; None where
    it means none. ``jaw`` or ``jaw.angle``, ``guide`` or ``guide.displacement``, ``C.x`` or ``C.position.x``."""
    owner, _unused, part = text.rpartition(".")
    name = owner if part == "displacement" else text
    if name in slides or (part == "displacement" and owner in slides.values()):
        joint = slides.get(name, name)
        return Output("displacement", joint, written="" if name == joint else name)
    link = owner if part == "angle" else text
    if link in links and link != "frame":
        return Output("angle", link)
    if part not in ("x", "y"):
        return None
    owner = owner.removesuffix(".position")
    link, _unused2, point = owner.rpartition(".")
    if link:
        return Output("position", owner, part) if point in links.get(link, ()) else None
    having = [name for name, points in links.items() if point in points]
    return Output("position", f"{having[0]}.{point}", part, written=f"{point}.{part}") if having else None
