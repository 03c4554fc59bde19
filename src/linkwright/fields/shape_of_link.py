"""The key ``shape`` of a link: a word, or a table of what its plate is like."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, cast

from linkwright.core.data import Frozen
from linkwright.fields.base import Field, Quantity, Schema, Text, Word, table_schema
from linkwright.fields.material import Material, MaterialField
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.outline import Holes, Outline, Ring, fault_of
from linkwright.fields.outline_file import rings_of_file
from linkwright.fields.reading import Place, Reader
from linkwright.fields.references import PLACE
from linkwright.fields.tables import Listed
from linkwright.words import _

Vec = tuple[float, float]
ShapeKind = Literal["bar", "plate", "path", "outline", "disc", "none"]


@dataclass(frozen=True)
class LinkShape(Frozen):
    """The key ``shape`` of a link.

    ``kind``: ``bar``, a bar with round ends along the link's points (in line: in the order of their places, else in
    that of the file; the usual one of links whose points are in line); ``plate``, their convex hull widened by half
    the width (the usual one of all others); ``path``, a bar ``through`` points by name and places in the link's axes
    (bent bars, hooks); ``outline``: ``rings``, the outer one first, in the link's axes; ``disc``: about the first
    point; ``none``: takes no room; None: the usual one. ``width``, ``radius``, ``thickness``: m, None for those of
    the construction; ``material``: None for that of the construction.
    """

    kind: ShapeKind | None = None
    width: float | None = None
    radius: float | None = None
    through: tuple[str | Vec, ...] = ()
    rings: tuple[Ring, ...] = ()
    thickness: float | None = None
    material: Material | None = None

    def dimensions(self) -> dict[str, float]:
        """Ends of addresses (``.width``, ``.through.1.x``, ``.material.density``) with their SI values."""
        return {
            f".{key}{end}": number
            for key, field in SHAPE_FIELDS.items()
            if key in _PLAIN_KEYS and (value := getattr(self, key)) is not None
            for end, number in field.flatten(value).items()
        }

    def with_dimensions(self, value: Callable[[str], float]) -> LinkShape:
        """The same shape with the values that ``value`` gives for the ends of ``dimensions``."""
        return replace(
            self,
            **{
                key: SHAPE_FIELDS[key].rebuild(old, lambda end, key=key: value(f".{key}{end}"))  # type: ignore[misc]
                for key in _PLAIN_KEYS
                if (old := getattr(self, key)) is not None
            },
        )

    def written(self) -> Any:
        """As plain data for a file: a word where there is nothing else to say."""
        plain = {key: getattr(self, key) for key in _PLAIN_KEYS}
        found: dict[str, Any] = {key: each for key, each in plain.items() if each not in (None, ())}
        if self.rings:
            found["outline"] = self.rings[0]
        if self.rings[1:]:
            found["holes"] = self.rings[1:]
        told = {key: SHAPE_FIELDS[key].written(value) for key, value in found.items()}
        implied = next((kind for key, kind in _KIND_BY_KEY.items() if key in told), None)
        if not told:
            return self.kind
        return told if self.kind in (None, implied) else {"kind": self.kind, **told}


@dataclass(frozen=True)
class Through(Listed):
    """Points of the link by name and places in its axes, in order; the reader of the link knows its points."""

    item: Field = PLACE
    form: str = "[A, [30 mm, 20 mm], B]"

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        items = reader.items(node, place, None, self.form)
        found = [
            reader.text(each, place)
            if isinstance(each, Scalar)
            else PLACE.read(reader, each, place.child(str(index)), {})
            for index, each in enumerate(items or [])
        ]
        if items is None or None in found:
            return None
        if len(found) > 1:
            return tuple(found)
        problem = _("a path needs two points or more", code="shapes.short_path")
        reader.error(node, place, problem, _("write it as {form}", form=self.form), "count")
        return None

    def shape(self) -> Schema:
        one: Schema = {"anyOf": [{"type": "string", "x-reference": "point"}, PLACE.shape()]}
        return {"type": "array", "items": one, "minItems": 2}

    def flatten(self, value: Any) -> dict[str, float]:
        return {
            f".{index}{end}": number
            for index, each in enumerate(value)
            if not isinstance(each, str)
            for end, number in PLACE.flatten(each).items()
        }

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return tuple(
            each if isinstance(each, str) else PLACE.rebuild(each, lambda end, k=index: lookup(f".{k}{end}"))  # type: ignore[misc]
            for index, each in enumerate(value)
        )

    def written(self, value: Any) -> Any:
        return [each if isinstance(each, str) else PLACE.written(each) for each in value]


_KINDS: tuple[ShapeKind, ...] = ("bar", "plate", "path", "outline", "disc", "none")
#: The keys of a shape's table.
SHAPE_FIELDS: Mapping[str, Field] = {
    "kind": Word(
        _KINDS,
        doc=_(
            "bar along the link's points; plate, their convex hull; path; outline; disc about the first point; none, "
            "takes no room (default: what the other keys say, else bar for points in line and plate for others)"
        ),
    ),
    "width": Quantity("length", above=0, doc=_("width of the bar, or of the plate around its points")),
    "radius": Quantity("length", above=0, doc=_("radius of the disc")),
    "thickness": Quantity("length", above=0, doc=_("thickness (default: that of the construction)")),
    "material": MaterialField(doc=_("material (default: that of the construction)")),
    "through": Through(doc=_("where a bent bar goes: points by name, and places in the link's axes")),
    "outline": Outline(doc=_("corners of the outline in the link's axes, in order")),
    "holes": Holes(doc=_("outlines that are cut out of it")),
    "file": Text(doc=_("DXF file with the outline and the holes in the link's axes, next to the model file")),
}
#: The keys that an object has as they are.
_PLAIN_KEYS = ("width", "radius", "thickness", "material", "through")
#: The kind that a key means.
_KIND_BY_KEY: Mapping[str, ShapeKind] = {"through": "path", "outline": "outline", "file": "outline", "radius": "disc"}
#: The keys that go with a kind, besides thickness and material.
_KEYS_BY_KIND: Mapping[ShapeKind | None, tuple[str, ...]] = {
    None: ("width",),
    "bar": ("width",),
    "plate": ("width",),
    "path": ("width", "through"),
    "outline": ("outline", "holes", "file"),
    "disc": ("radius",),
    "none": (),
}
#: The key without which a kind says nothing.
_REQUIRED_KEY: Mapping[ShapeKind, str] = {"path": "through", "outline": "outline", "disc": "radius"}


@dataclass(frozen=True)
class ShapeField(Field):
    """A word, or a table of the keys of a shape."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> LinkShape | None:
        before = reader.error_count
        if isinstance(node, MappingNode):
            values = reader.table(node, place, SHAPE_FIELDS)
        else:
            word = reader.word(node, place, _KINDS)
            values = None if word is None else {"kind": word}
        if values is None or reader.error_count > before:
            return None
        kind: ShapeKind | None = values.get("kind") or next(
            (_KIND_BY_KEY[key] for key in _KIND_BY_KEY if key in values), None
        )
        if not _fits(reader, node, place, kind, values):
            return None
        rings = self._rings(reader, node, place, values)
        if rings is None:
            return None
        return LinkShape(kind, rings=rings, **{key: values[key] for key in _PLAIN_KEYS if key in values})

    def _rings(self, reader: Reader, node: Node, place: Place, values: Mapping[str, Any]) -> tuple[Ring, ...] | None:
        """The outline and its holes, () where there is none; None after a finding."""
        key = next((key for key in ("outline", "file") if key in values), None)
        if key is None:
            return ()
        at, below = node.get(key) if isinstance(node, MappingNode) else node, place.child(key)
        drawn = rings_of_file(reader, at or node, below, values["file"]) if key == "file" else (values["outline"],)
        if drawn is None:
            return None
        found = (*drawn, *values.get("holes", ()))
        fault = fault_of(found)
        if fault is not None:
            reader.error(at, below, *fault, "outline")
            return None
        return cast(tuple[Ring, ...], found)

    def shape(self) -> Schema:
        return {"anyOf": [{"enum": list(_KINDS)}, table_schema(SHAPE_FIELDS)]}

    def flatten(self, value: Any) -> dict[str, float]:
        return {} if value is None else cast(LinkShape, value).dimensions()

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return None if value is None else cast(LinkShape, value).with_dimensions(lookup)

    def written(self, value: Any) -> Any:
        return cast(LinkShape, value).written()


def _fits(reader: Reader, node: Node, place: Place, kind: ShapeKind | None, values: Mapping[str, Any]) -> bool:
    """Whether the keys of a shape go with its kind and with each other."""
    own = _KEYS_BY_KIND[kind] if kind == "none" else (*_KEYS_BY_KIND[kind], "thickness", "material")
    odd = next((key for key in values if key != "kind" and key not in own), None)
    needed = _REQUIRED_KEY.get(kind) if kind else None
    at = node.get(odd or "kind") if isinstance(node, MappingNode) else node
    if odd is not None:
        problem = _('"{key_}" does not go with kind: {kind}', code="shapes.odd_key", key_=odd, kind=kind or "bar")
        remedy = _("remove one of them; keys of {kind}: {names}", kind=kind or "bar", names=own or ("kind",))
        reader.error(at or node, place.child(odd), problem, remedy, "choice")
    elif "outline" in values and "file" in values:
        problem = _("{keys} are both set", code="loads.both_given", keys="outline, file")
        reader.error(
            at or node, place.child("file"), problem, _("keep one of {words}", words=("outline", "file")), "choice"
        )
    elif needed and needed not in values and "file" not in values:
        remedy = _("add {key_}: {form}", key_=needed, form=SHAPE_FIELDS[needed].doc)
        problem = _('the key "{key_}" is missing')
        reader.finding(at or node, place.child(needed), problem, "missing-key", remedy, key_=needed)
    else:
        return True
    return False
