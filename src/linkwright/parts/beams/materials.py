"""Materials: a small table of nominal values, each with its source, or values of one's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from linkwright.fields.base import Quantity, Text, file_key
from linkwright.fields.tables import Table
from linkwright.parts.fields import Known
from linkwright.words import _


@dataclass(frozen=True)
class Material:
    """Young's ``modulus`` Pa, ``strength`` (yield, for brittle materials tensile strength) Pa, ``density`` kg/m³.

    ``strength`` and ``density`` are None where they are not known.
    """

    modulus: float = file_key(Quantity("pressure", above=0.0, doc="Young's modulus E"))
    strength: float | None = file_key(Quantity("pressure", above=0.0, doc="yield strength"), None)
    density: float | None = file_key(Quantity("density", above=0.0, doc="density"), None)
    label: str = ""
    source: str = ""


#: Nominal values for small thicknesses; a design takes those of its delivery.
TABLE: Mapping[str, Material] = {
    each.label: each
    for each in (
        Material(210e9, 235e6, 7850, "S235", "EN 10025-2 (up to 16 mm); EN 1993-1-1"),
        Material(210e9, 355e6, 7850, "S355", "EN 10025-2 (up to 16 mm); EN 1993-1-1"),
        Material(206e9, 235e6, 7850, "Q235", "GB/T 700 (up to 16 mm); GB 50017"),
        Material(206e9, 355e6, 7850, "45 steel", "GB/T 699, normalised"),
        Material(70e9, 250e6, 2700, "EN AW-6082 T6", "EN 755-2, profiles up to 5 mm; EN 1999-1-1"),
        Material(110e9, 250e6, 7200, "EN-GJL-250", "EN 1561 (tensile strength)"),
    )
}
MATERIAL = Known(
    Text(),
    Table.of(Material),
    TABLE,
    _('there is no material "{name}"', code="beam.no_material"),
    required=True,
    doc=f"material: {', '.join(TABLE)}, or {{modulus: 210 GPa, strength: 235 MPa}}",
)
