"""Model files: reading, checking and changing them, and the JSON Schema that they follow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from linkwright.actuators.base import ACTUATORS
from linkwright.applied_loads.base import LOADS
from linkwright.core.arguments import describe
from linkwright.drivers.base import LAWS
from linkwright.drivers.path import ROUTE_FIELDS, path_laws
from linkwright.errors import Finding, ModelError, RequestError
from linkwright.fields.base import Field, Schema, Word, table_schema
from linkwright.fields.nodes import Node, Scalar, below
from linkwright.fields.references import Coordinates
from linkwright.files.compose import compose
from linkwright.files.node_reader import MODES
from linkwright.files.read_drivers import CYCLE_FORMS, WAYS
from linkwright.files.read_model import FORMAT, HEADER, read_model
from linkwright.files.source import ENDINGS, GALLERY, gallery_names, read_source
from linkwright.joints.base import JOINTS
from linkwright.mechanism.construction import Construction
from linkwright.mechanism.cycle import ROCK, Cycle
from linkwright.mechanism.link import FRAME_FIELDS, LINK_FIELDS
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.run_conditions import RunConditions
from linkwright.mechanism.stops import STOP_FIELDS
from linkwright.words import _

if TYPE_CHECKING:
    from pathlib import Path

    from linkwright.files.write import Document


__all__ = ["gallery_names", "load", "loads", "read_document"]


def load(source: str | Path) -> Mechanism:
    """The mechanism in a model file: a path, or ``gallery:NAME``.

    Raises ModelError with all findings where the file cannot be used.
    """
    text, name = read_source(source)
    return loads(text, name)


def loads(text: str, name: str = "<text>") -> Mechanism:
    """The mechanism in the text of a model file; findings name ``name`` as the file.

    Raises ModelError with all findings where the text cannot be used.
    """
    if not isinstance(text, str):
        raise RequestError(
            _(
                "expected the text of a model, not {found}; files are read by lw.load",
                code="given_instead.no_text",
                found=describe(text),
            )
        )
    if "\n" not in text.strip() and (text.startswith(GALLERY) or text.endswith(ENDINGS)):
        raise RequestError(
            _(
                'the text of a model is needed, not the name of a file; write lw.load("{name}")',
                code="given_instead.name_for_text",
                name=text,
            )
        )
    mechanism, findings = read_text(text, name)
    if mechanism is None:
        raise ModelError(findings)
    return mechanism


def read_document(source: str | Path) -> Document:
    """A model file that can be changed and saved with its comments and order. Raises ModelError."""
    from linkwright.files.write import Document

    text, name = read_source(source)
    return Document(text, name, read_text)


def read_text(text: str, name: str) -> tuple[Mechanism | None, list[Finding]]:
    """The mechanism of a text, or None where there is an error, and all findings."""
    return read_tree(*read_root(text, name), name)


def read_tree(root: Node | None, findings: list[Finding], name: str) -> tuple[Mechanism | None, list[Finding]]:
    """The mechanism of what :func:`read_root` gives, or None where there is an error, and all findings."""
    if root is None:
        return None, findings
    mechanism, found = read_model(root, name)
    return (None if findings else mechanism), findings + found


def declared_kind(root: Node | None) -> str | None:
    """The kind of calculation that a tree declares; None of a model."""
    node = below(root, "kind")
    return node.text if isinstance(node, Scalar) else None


def is_task(root: Node | None) -> bool:
    """Whether a tree holds a task of synthesis and no model."""
    task, *model = (below(root, key) for key in ("synthesis", "links", "frame"))
    return task is not None and model == [None, None]


def read_nodes(text: str, name: str) -> tuple[Node | None, list[Finding]]:
    """The tree of a text as far as there is one, and what is wrong with the text itself."""
    root, remarks = compose(text.removeprefix("\ufeff"))
    return root, [
        Finding("error", f"{name}:{r.line + 1}:{r.column + 1}", r.key, r.message, r.remedy, r.code) for r in remarks
    ]


def read_root(text: str, name: str) -> tuple[Node | None, list[Finding]]:
    """The tree of a text, None where there is nothing to read, and what is wrong with the text itself."""
    root, findings = read_nodes(text, name)
    if root is None or (isinstance(root, Scalar) and root.empty):
        empty = Finding("error", f"{name}:1:1", "", _("the file is empty"), _("begin with format: 1"), "empty")
        return None, findings or [empty]
    return root, findings


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
        "cycle": (
            _cycle(),
            _("what one cycle is (default: one turn of the driver); rock: to and fro between the driver's limits"),
        ),
        "path": (_path(), _("the path of a point, by which the two drivers without a law move")),
        "loads": (_named({"oneOf": [load.schema() for load in LOADS.values()]}), _("loads by name")),
        "actuators": (
            _named({"oneOf": [each.schema() for each in ACTUATORS.values()]}),
            _("motors, cylinders, brakes and flywheels by name, for motion under forces"),
        ),
        "stops": (_named(table_schema(STOP_FIELDS)), _("end stops by name, for motion under forces")),
        "run": (table_schema(RunConditions.fields({})), _("how a run under forces begins and ends")),
        "construction": (table_schema(Construction.fields()), _("how the machine is made: sizes, material, layers")),
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
    for name, (way, rotary) in WAYS.items():
        for key, law in LAWS.items():
            fields: Mapping[str, Field] = {**way, **law.fields(rotary)}
            shape = table_schema(fields)
            shape["required"] = [*shape["required"], key]
            found.append({"title": f"{name}, {key}", **shape})
        found.append({"title": f"{name}, by the path", **table_schema(way)})
    return found


def _path() -> Schema:
    forms = []
    for key, fields in path_laws().items():
        shape = table_schema({**ROUTE_FIELDS, **fields})
        shape["required"] = list(dict.fromkeys([*shape["required"], key]))
        forms.append({"title": key, **shape})
    return {"oneOf": forms}


def _cycle() -> Schema:
    fields = Cycle.fields("angle")
    forms = [{key: replace(fields[key], required=key != "margin") for key in form} for form in CYCLE_FORMS]
    return {"oneOf": [*(table_schema(form) for form in forms), {"const": ROCK}]}
