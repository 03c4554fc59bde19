"""The JSON Schema of a model file, from the same declarations that read it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from linkwright.applied_loads.base import LOADS
from linkwright.drivers.base import LAWS
from linkwright.fields.base import Field, Schema, Word, table_schema
from linkwright.fields.references import Coordinates
from linkwright.files.node_reader import MODES
from linkwright.files.read_drivers import CYCLE_FORMS, SLIDE_FIELDS, TURN_FIELDS
from linkwright.files.read_model import FORMAT, HEADER
from linkwright.joints.base import JOINTS
from linkwright.mechanism.link import FRAME_FIELDS, LINK_FIELDS
from linkwright.mechanism.mechanism import Cycle
from linkwright.words import _

_NAME_PATTERN = r"^[^\W\d][\w'-]*$"


def json_schema() -> Schema:
    """JSON Schema (2020-12) of a model file: every section, joint kind, driver law and registered load
    kind."""
    drivers = {"oneOf": _drivers()}
    sections: dict[str, tuple[Schema, str]] = {
        "parameters": (_named({"type": ["string", "number"]}), _("named quantities for expressions")),
        "frame": (table_schema(FRAME_FIELDS), _("the fixed link")),
        "links": (_named(table_schema(LINK_FIELDS)), _("the moving links; shared point names are pins")),
        "joints": (_named({"oneOf": _joints()}), _("guides, welds, and attributes of pins")),
        "assembly": (_named({"enum": list(MODES)}), _("assembly mode by inner joint")),
        "drawing": (Coordinates().shape(), _("coordinates of the assembled drawing, in frame axes")),
        "driver": (drivers, _("the one driver")),
        "drivers": (_named(drivers), _("several drivers by name")),
        "cycle": (_cycle(), _("what one cycle is (default: one turn of the driver)")),
        "loads": (_named({"oneOf": [load.schema() for load in LOADS.values()]}), _("loads by name")),
        "outputs": (_named({"type": "string"}), _("formulas of places and rates with names of their own")),
    }
    properties = {name: each.schema() for name, each in HEADER.items()}
    properties |= {name: {**shape, "description": doc} for name, (shape, doc) in sections.items()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:linkwright:model:{FORMAT}",
        "title": "Linkwright model",
        "type": "object",
        "properties": properties,
        "required": ["format", "frame", "links"],
        "additionalProperties": False,
    }


def _named(shape: Schema) -> Schema:
    return {"type": "object", "propertyNames": {"pattern": _NAME_PATTERN}, "additionalProperties": shape}


def _joints() -> list[Schema]:
    return [
        {"title": kind, **table_schema({"kind": Word((kind,), required=True), **joint.fields()})}
        for kind, joint in JOINTS.items()
    ]


def _drivers() -> list[Schema]:
    found = []
    for rotary, way in ((True, TURN_FIELDS), (False, SLIDE_FIELDS)):
        for key, law in LAWS.items():
            fields: Mapping[str, Field] = {**way, **law.fields(rotary)}
            shape = table_schema(fields)
            shape["required"] = [*shape["required"], key]
            found.append({"title": f"{next(iter(way))}, {key}", **shape})
    return found


def _cycle() -> Schema:
    fields = Cycle.fields("angle")
    forms = [{key: replace(fields[key], required=True) for key in form} for form in CYCLE_FORMS]
    return {"type": "object", "oneOf": [table_schema(form) for form in forms]}
