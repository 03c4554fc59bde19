"""How a machine is made: material, thickness, pins, supports, layers and sheets; the section ``construction``."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from linkwright.core.data import Frozen
from linkwright.fields.base import Field, Quantities, Quantity, Schema, Word
from linkwright.fields.material import MATERIALS, Material, MaterialField
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader
from linkwright.fields.shape_of_link import LinkShape, ShapeKind
from linkwright.registry import offered
from linkwright.words import _

__all__ = ["MATERIALS", "Construction", "LinkShape", "Material", "ShapeKind"]

Vec = tuple[float, float]
Supports = Literal["cantilevered", "both"]
Ends = Literal["heads", "flush"]
#: The highest layer that a file may name.
MOST_LAYERS = 999
#: Words before the name of a link or joint in that of a plate which is not the link's own.
OTHER_PLATES = ("guide", "block", "wheel", "rack", "cam", "roller", "rod", "post")


@dataclass(frozen=True)
class FixedLayers(Field):
    """Plates by name with the number of the layer in which they lie; ``all`` for a frame that is a wall in all."""

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> Mapping[str, int | None] | None:
        mapping = reader.mapping(node, place)
        if mapping is None:
            return None
        found: dict[str, int | None] = {}
        for entry in mapping.entries:
            name, at = entry.key.text, place.child(entry.key.text)
            if not _is_plate(reader, entry.key, at, name):
                continue
            text = entry.value.text.strip() if isinstance(entry.value, Scalar) else ""
            if text == "all" and name == "frame":
                found[name] = None
            elif re.fullmatch("[0-9]{1,3}", text):
                found[name] = int(text)
            else:
                self._refuse(reader, entry.value, at, text)
        return found if len(found) == len(mapping.entries) else None

    def _refuse(self, reader: Reader, node: Node, place: Place, text: str) -> None:
        problem = (
            _("only the frame can be in all layers", code="layers.all_of_link")
            if text == "all"
            else _('"{text}" is not the number of a layer', text=text[:60], code="layers.no_number")
        )
        remedy = _("write an integer from 0, the layer of the frame, to {most}", most=MOST_LAYERS)
        reader.error(node, place, problem, remedy, "range")

    def shape(self) -> Schema:
        one: Schema = {"anyOf": [{"type": "integer", "minimum": 0, "maximum": MOST_LAYERS}, {"const": "all"}]}
        return {"type": "object", "additionalProperties": one}

    def written(self, value: Any) -> Any:
        return {name: "all" if layer is None else layer for name, layer in value.items()}


def _is_plate(reader: Reader, node: Node, place: Place, name: str) -> bool:
    """Whether a machine may have a plate of a name; a finding with the nearest if not."""
    links, joints = list(reader.names.links), list(reader.names.joints)
    word, _unused, owner = name.partition(" ")
    if name in (*links, "cover") or (word in OTHER_PLATES and owner in (*links, *joints)):
        return True
    if not reader.names.listed:
        return False
    slides = [f"guide {each}" for each in dict.fromkeys(reader.names.sliding.values())]
    choices = [f"{word} {each}" for each in (*links, *joints)] if word in OTHER_PLATES else []
    offer = offered(name, [*links, "cover", *slides, *choices], _("plates have the names of links: {names}"))
    problem = _('there is no plate "{name}"', name=name, code="layers.no_plate")
    reader.error(node, place, problem, offer, "unknown-name")
    return False


#: The keys of the section in a file.
FIELDS: Mapping[str, Field] = {
    "material": MaterialField(doc=_("material of all parts (default steel)")),
    "thickness": Quantity("length", above=0, doc=_("thickness of the plates")),
    "width": Quantity("length", above=0, doc=_("width of the links around their points")),
    "pin_radius": Quantity("length", above=0, doc=_("radius of the pins that do not have one of their own")),
    "supports": Word(
        ("cantilevered", "both"), doc=_("the frame on one side (cantilevered, the default) or on both sides")
    ),
    "ends": Word(("heads", "flush"), doc=_("ends of the pins: heads in the next layers (default), or flush")),
    "clearance": Quantity("length", minimum=0, doc=_("smallest gap between what moves in one layer")),
    "layers": FixedLayers(doc=_("layers that are fixed, by plate: {{crank: 1, guide slide: 2, frame: all}}")),
    "washer": Quantity("length", minimum=0, doc=_("thickness of the washers between two layers")),
    "fit": Quantity("length", minimum=0, doc=_("diameter of a hole less that of its pin (default 0)")),
    "kerf": Quantity("length", minimum=0, doc=_("width that a cut takes (default 0)")),
    "sheet": Quantities("length", count=2, above=0, doc=_("width and height of the sheets")),
    "safety": Quantity("dimensionless", minimum=1, doc=_("safety factor of sizes from forces (default 2)")),
}


@dataclass(frozen=True)
class Construction(Frozen):
    """The section ``construction`` of a model file; lengths in m, None for the usual ones.

    ``supports``: the frame on one side of the machine (``cantilevered``) or on ``both``; ``ends`` of pins: ``heads``
    that stick out into the next layers, or ``flush``; ``clearance``: smallest gap between what moves in one layer;
    ``layers``: layers of plates that are fixed by name, 0 the frame's own, None in all layers (``frame: all``);
    ``washer``: thickness between two layers; ``fit``: by how much a hole's diameter is larger than its pin's;
    ``kerf``: width that a cut takes; ``sheet``: width and height of the sheets.
    """

    material: Material = MATERIALS["steel"]
    thickness: float | None = None
    width: float | None = None
    pin_radius: float | None = None
    supports: Supports = "cantilevered"
    ends: Ends = "heads"
    clearance: float | None = None
    layers: Mapping[str, int | None] = field(default_factory=dict)
    washer: float | None = None
    fit: float = 0.0
    kerf: float = 0.0
    sheet: Vec | None = None
    safety: float = 2.0

    @staticmethod
    def fields() -> Mapping[str, Field]:
        """The keys of the section in a file."""
        return FIELDS

    @classmethod
    def of_values(cls, values: Mapping[str, Any]) -> Construction:
        """The construction of these keys of a file; keys of None are those that are not there."""
        return cls(**{key: value for key, value in values.items() if value is not None})

    def values(self) -> dict[str, Any]:
        """The keys of the file that are not the usual ones, and the material, with their SI values."""
        usual = Construction()
        found = {key: getattr(self, key) for key in FIELDS}
        return {key: each for key, each in found.items() if key == "material" or each != getattr(usual, key)}

    def dimensions(self) -> dict[str, float]:
        """Addresses (``construction.width``, ``construction.material.density``, …) with their SI values."""
        flat = {key: field.flatten(getattr(self, key)) for key, field in FIELDS.items()}
        return {f"construction.{key}{end}": each for key, parts in flat.items() for end, each in parts.items()}

    def with_dimensions(self, value: Callable[[str], float]) -> Construction:
        """The same construction with the values that ``value`` gives for the addresses of ``dimensions``."""
        return self.of_values(
            {
                key: field.rebuild(getattr(self, key), lambda end, key=key: value(f"construction.{key}{end}"))  # type: ignore[misc]
                for key, field in FIELDS.items()
            }
        )

    def written(self, expressions: Collection[str] = ()) -> dict[str, Any]:
        """As plain data for a file; with the keys of which ``expressions`` has the address."""
        found = {key: getattr(self, key) for key in FIELDS if f"construction.{key}" in expressions}
        return {key: FIELDS[key].written(value) for key, value in {**self.values(), **found}.items()}
