"""What a beam consists of: cross sections, materials, supports and loads."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.errors import Finding, RequestError, fault
from linkwright.fields.base import Field, Quantities, Quantity, Schema, Text, Word, file_key, quantity_schema
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Table
from linkwright.parts.beams.elastic import SupportCondition
from linkwright.parts.fields import Known
from linkwright.words import _

#: IPE profiles, EN 10365: h, b, web, flange, root radius (mm), area (mm²), I (mm⁴), W (mm³).
IPE: Mapping[str, tuple[float, ...]] = {
    "IPE 80": (80, 46, 3.8, 5.2, 5, 764, 80.1e4, 20.0e3),
    "IPE 100": (100, 55, 4.1, 5.7, 7, 1032, 171e4, 34.2e3),
    "IPE 120": (120, 64, 4.4, 6.3, 7, 1321, 318e4, 53.0e3),
    "IPE 140": (140, 73, 4.7, 6.9, 7, 1643, 541e4, 77.3e3),
    "IPE 160": (160, 82, 5.0, 7.4, 9, 2009, 869e4, 109e3),
    "IPE 180": (180, 91, 5.3, 8.0, 9, 2395, 1317e4, 146e3),
    "IPE 200": (200, 100, 5.6, 8.5, 12, 2848, 1943e4, 194e3),
}


@dataclass(frozen=True)
class Section:
    """A cross section bent about its strong axis: ``second_moment`` I m⁴, ``area`` m², ``modulus`` W = I/c m³.

    ``area`` and ``modulus`` are None where only I is known.
    """

    second_moment: float
    area: float | None = None
    modulus: float | None = None
    label: str = ""


def rectangle(width: float, height: float) -> Section:
    """I = b h³/12, W = b h²/6."""
    return Section(width * height**3 / 12, width * height, width * height**2 / 6, "rectangle")


def circle(diameter: float) -> Section:
    """I = π d⁴/64, W = π d³/32."""
    return Section(math.pi * diameter**4 / 64, math.pi * diameter**2 / 4, math.pi * diameter**3 / 32, "circle")


def tube(diameter: float, wall: float) -> Section:
    """A round tube of outer diameter and wall: the difference of two circles."""
    _require_room(diameter - 2 * wall)
    outer, inner = circle(diameter), circle(diameter - 2 * wall)
    second = outer.second_moment - inner.second_moment
    return Section(second, (outer.area or 0.0) - (inner.area or 0.0), 2 * second / diameter, "tube")


def box(width: float, height: float, wall: float) -> Section:
    """A rectangular tube: the difference of two rectangles."""
    _require_room(width - 2 * wall, height - 2 * wall)
    outer, inner = rectangle(width, height), rectangle(width - 2 * wall, height - 2 * wall)
    second = outer.second_moment - inner.second_moment
    return Section(second, (outer.area or 0.0) - (inner.area or 0.0), 2 * second / height, "box")


def i_beam(height: float, width: float, web: float, flange: float) -> Section:
    """Two flanges and a web, without fillets."""
    _require_room(width - web, height - 2 * flange)
    outer, inner = rectangle(width, height), rectangle(width - web, height - 2 * flange)
    second = outer.second_moment - inner.second_moment
    return Section(second, (outer.area or 0.0) - (inner.area or 0.0), 2 * second / height, "i_beam")


def _require_room(*inner: float) -> None:
    """Raises RequestError where walls are thicker than what they surround."""
    if min(inner) < 0:
        raise RequestError(_("these dimensions make no section", code="beam.no_section"))


def profile(name: str) -> Section:
    """A rolled profile of the table; raises KeyError for one that it does not have."""
    *_unused, area, second, modulus = IPE[name]
    return Section(second * 1e-12, area * 1e-6, modulus * 1e-9, name)


#: Shapes with the number and the names of their dimensions.
SHAPES: Mapping[str, tuple[Callable[..., Section], str]] = {
    "rectangle": (rectangle, "[width, height]"),
    "circle": (circle, "[diameter]"),
    "tube": (tube, "[outer diameter, wall]"),
    "box": (box, "[width, height, wall]"),
    "i_beam": (i_beam, "[height, width, web, flange]"),
}
COUNTS = {"rectangle": 2, "circle": 1, "tube": 2, "box": 3, "i_beam": 4}
FIELDS: Mapping[str, Field] = {
    **{name: Quantities("length", count=COUNTS[name], doc=form) for name, (_unused, form) in SHAPES.items()},
    "second_moment": Quantity("second_moment_of_area", above=0.0, doc="I, where no shape is given"),
    "area": Quantity("area", above=0.0, doc="area, in addition to second_moment"),
    "modulus": Quantity("volume", above=0.0, doc="section modulus W = I/c, in addition to second_moment"),
}


@dataclass(frozen=True)
class SectionField(Known):
    """``IPE 100``, or one shape with its dimensions, or ``{second_moment: …, area: …, modulus: …}``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, siblings)
        return _shaped(reader, node, place, found) if isinstance(found, dict) else found


def section_field(doc: str = "cross section") -> SectionField:
    """The key of a cross section."""
    profiles = {name: profile(name) for name in IPE}
    return SectionField(
        Text(),
        Table(FIELDS),
        profiles,
        _('there is no profile "{name}"', code="beam.no_profile"),
        required=True,
        doc=doc,
    )


def _shaped(reader: Reader, node: Node, place: Place, found: dict[str, Any]) -> Section | None:
    shapes = [name for name in SHAPES if name in found]
    if len(shapes) + ("second_moment" in found) != 1:
        message = _("{count} shapes of the section are given", code="beam.one_shape", count=len(shapes))
        remedy = _("give one of {shapes}, or second_moment", shapes=tuple(SHAPES))
        reader.error(node, place, message, remedy, "choice")
        return None
    if not shapes:
        return Section(found["second_moment"], found.get("area"), found.get("modulus"))
    sizes = found[shapes[0]]
    try:
        made = SHAPES[shapes[0]][0](*sizes) if min(sizes) > 0 else None
    except RequestError:
        made = None
    if made is None or made.second_moment <= 0 or (made.area or 0.0) <= 0:
        reader.error(
            node,
            place,
            _("these dimensions make no section", code="beam.no_section"),
            _("give lengths above zero that fit"),
            "range",
        )
        return None
    return made


def require_modulus(section: Section) -> list[Finding]:
    """A finding where stresses cannot be computed from the section."""
    return (
        []
        if section.area and section.modulus
        else [
            fault(
                "no_modulus",
                "section",
                _("stresses need the section's area and modulus"),
                _("give a shape, or area and modulus in addition to second_moment"),
            )
        ]
    )


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


SUPPORTS = ("fixed", "pinned", "roller", "guided", "spring")


@dataclass(frozen=True)
class BeamSupport:
    """``kind``: fixed, pinned or roller (equal in bending), guided (slope held), spring; ``at`` m.

    ``settlement``: given deflection, m; ``stiffness`` N/m and ``torsional_stiffness`` N·m/rad of a spring.
    """

    kind: str = file_key(Word(SUPPORTS, doc=", ".join(SUPPORTS)))
    at: float = file_key(Quantity("length", minimum=0.0, doc="its place"))
    settlement: float = file_key(Quantity("length", doc="given deflection, upwards positive"), 0.0)
    stiffness: float = file_key(Quantity("stiffness", minimum=0.0, doc="of a spring"), 0.0)
    torsional_stiffness: float = file_key(Quantity("torsional_stiffness", minimum=0.0, doc="of a spring"), 0.0)

    @property
    def hold(self) -> SupportCondition:
        """What it holds."""
        return SupportCondition(
            self.at,
            self.kind in ("fixed", "pinned", "roller"),
            self.kind in ("fixed", "guided"),
            self.settlement,
            self.stiffness,
            self.torsional_stiffness,
        )


@dataclass(frozen=True)
class LineLoad(Quantities):
    """One value, or ``[first, last]``."""

    def read(self, reader: Any, node: Any, place: Any, siblings: Mapping[str, Any]) -> tuple[float, ...] | None:
        from linkwright.fields.nodes import Sequence as SequenceNode

        if isinstance(node, SequenceNode):
            return super().read(reader, node, place, siblings)
        value = reader.quantity(node, place, self.dimension)
        return None if value is None else (value, value)

    def shape(self) -> Schema:
        return {"anyOf": [quantity_schema(self.dimension), super().shape()]}


@dataclass(frozen=True)
class BeamLoad:
    """One of: ``force`` (N, up) ``at`` a place, ``couple`` (N·m, counter-clockwise) ``at`` a place, ``line`` load.

    A line load (N/m, up) lies from ``start`` to ``end``, to the beam's end unless given, constant or from its first
    to its last value.
    """

    force: float | None = file_key(Quantity("force", doc="force, upwards positive, with at"), None)
    couple: float | None = file_key(Quantity("torque", doc="couple, counter-clockwise positive, with at"), None)
    line: tuple[float, ...] | None = file_key(
        LineLoad(
            "line_load",
            count=2,
            form="[0 N/m, -2 kN/m]",
            doc="line load, upwards positive; [first, last] where it varies",
        ),
        None,
    )
    at: float | None = file_key(Quantity("length", minimum=0.0, doc="where the force or couple acts"), None)
    start: float = file_key(
        Quantity("length", minimum=0.0, key="from", doc="where the line load begins; default: 0"), 0.0
    )
    end: float | None = file_key(
        Quantity("length", minimum=0.0, key="to", doc="where it ends; default: the beam's end"), None
    )


@dataclass(frozen=True)
class SectionStep:
    """From ``start`` on (m) the beam has another ``section``."""

    start: float = file_key(Quantity("length", above=0.0, key="from", doc="from here on"))
    section: Section = file_key(section_field())
