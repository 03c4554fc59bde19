"""Materials of links: a few by their names, any other by its density, strength and modulus.

Densities, yield strengths (0.2 % proof stress; tensile strength of acrylic, bending strength of boards) and moduli
are rounded values of the grades that are meant: S235 (EN 10025-2), 1.4301 (EN 10088-2), EN-GJL-250 (EN 1561, 0.1 %
proof stress), EN AW-6082 T6 (EN 485-2), CuZn39Pb3 R430 (EN 12164), CuSn8 R390 (EN 12163), PMMA (ISO 7823-1), MDF of 9
to 12 mm (EN 622-5), birch plywood of 12 mm across the grain of its faces (Handbook of Finnish Plywood, 2002). POM-C,
ABS and PLA: lower ends of what data sheets of solid parts give; printed parts may have half of it across layers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from linkwright.fields.base import Field, Quantity, Schema, table_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.units import format
from linkwright.words import Message, _, pgettext


@dataclass(frozen=True)
class Material:
    """``density`` kg/m³, yield ``strength`` Pa, ``modulus`` of elasticity Pa; ``name``: empty of one that the file
    describes itself."""

    name: str
    density: float
    strength: float
    modulus: float


#: Density kg/m³, strength MPa, modulus GPa.
_TABLE: Mapping[str, tuple[float, float, float]] = {
    "steel": (7850, 235, 210),
    "stainless_steel": (7900, 210, 200),
    "cast_iron": (7200, 165, 105),
    "aluminium": (2700, 240, 70),
    "brass": (8470, 220, 97),
    "bronze": (8800, 260, 110),
    "pom": (1410, 60, 2.6),
    "abs": (1040, 40, 2.1),
    "pla": (1240, 50, 3.3),
    "acrylic": (1190, 70, 3.2),
    "plywood": (680, 33, 6.8),
    "mdf": (750, 22, 2.5),
}
MATERIALS: Mapping[str, Material] = {
    name: Material(name, float(density), strength * 1e6, modulus * 1e9)
    for name, (density, strength, modulus) in _TABLE.items()
}
#: What they are called.
LABELS: Mapping[str, Message] = {
    "steel": pgettext("material", "steel"),
    "stainless_steel": pgettext("material", "stainless steel"),
    "cast_iron": pgettext("material", "cast iron"),
    "aluminium": pgettext("material", "aluminium"),
    "brass": pgettext("material", "brass"),
    "bronze": pgettext("material", "bronze"),
    "pom": pgettext("material", "POM"),
    "abs": pgettext("material", "ABS"),
    "pla": pgettext("material", "PLA"),
    "acrylic": pgettext("material", "acrylic"),
    "plywood": pgettext("material", "plywood"),
    "mdf": pgettext("material", "MDF"),
}
_FIELDS: Mapping[str, Quantity] = {
    "density": Quantity("density", above=0, required=True, doc=_("density")),
    "strength": Quantity("pressure", above=0, required=True, doc=_("yield strength")),
    "modulus": Quantity("pressure", above=0, required=True, doc=_("modulus of elasticity")),
}


@dataclass(frozen=True)
class MaterialField(Field):
    """A material by its name, or by its numbers."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Material | None:
        if isinstance(node, MappingNode):
            values = reader.table(node, place, _FIELDS) or {}
            numbers = [values.get(key) for key in _FIELDS]
            return None if None in numbers else Material("", *numbers)  # type: ignore[arg-type]
        word = reader.word(node, place, MATERIALS)
        return None if word is None else MATERIALS[word]

    def shape(self) -> Schema:
        return {"anyOf": [{"enum": list(MATERIALS)}, table_schema(_FIELDS)]}

    def limit(self, value: float) -> Message | None:
        return None if value > 0.0 else _FIELDS["density"].limit(value)

    def flatten(self, value: Any) -> dict[str, float]:
        return {} if value is None else {f".{key}": getattr(value, key) for key in _FIELDS}

    def rebuild(self, value: Any, lookup: Callable[[str], float]) -> Any:
        return None if value is None else material(*(lookup(f".{key}") for key in _FIELDS))

    def written(self, value: Any) -> Any:
        if value.name:
            return value.name
        return {key: format(getattr(value, key), each.dimension) for key, each in _FIELDS.items()}


def material(density: float, strength: float, modulus: float) -> Material:
    """The material of these numbers, with its name where it is in the table."""
    found = Material("", density, strength, modulus)
    return next((each for each in MATERIALS.values() if replace(each, name="") == found), found)
