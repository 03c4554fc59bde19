"""What a model file may hold."""

from __future__ import annotations

import json
from typing import Annotated, Any

from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction
from linkwright.assistants.mends import EXAMPLE
from linkwright.assistants.tool import Desk
from linkwright.errors import Finding, ModelError
from linkwright.fields.base import Schema
from linkwright.files.model_file import json_schema
from linkwright.registry import listed
from linkwright.words import _
from linkwright.words.message import in_language

#: Characters of a schema that are given at most.
LONGEST = 30_000


class SectionEntry(Answered):
    """One section of a model file, or one kind within a section."""

    name: str = Field(description="key of the section, or name of the kind")
    about: str = Field(description="what it holds")
    keys: list[str] = Field(description="keys that it may have; of named entries, those of one entry")


class SchemaAnswer(Answer):
    """The form of a model file or of one section."""

    sections: list[SectionEntry] = Field(default_factory=list, description="sections, or kinds of the section")
    json_schema: dict[str, Any] = Field(
        default_factory=dict, description="JSON Schema of the section or kind asked for"
    )
    example: str = Field(default="", description="a whole model, where no section is asked for")


def read_schema(
    desk: Desk,
    section: Annotated[
        str,
        Field(
            description=(
                "Section of a model file: frame, links, joints, driver, loads, assembly, cycle, drawing, parameters,"
                " outputs, optimize, actuators, stops, run, path, report. Empty (default): the list of all and a "
                "whole example."
            )
        ),
    ] = "",
    kind: Annotated[
        str,
        Field(
            description=(
                "One kind within the section: joints 'prismatic', 'gear', 'cam', 'weld'; loads 'force', 'torque', "
                "'spring'; actuators 'dc'; driver 'turn, speed'. Empty (default): the list of kinds."
            )
        ),
    ] = "",
) -> SchemaAnswer:
    """Show what a model file may hold: its sections with their keys, the JSON Schema of one section or kind, and an
    example.

    Use it before you write a model, and where a finding names an unknown or missing key. For whole models to copy
    from use search_gallery; the full schema (160 kB) is the resource linkwright://schema.

    Links join where they share the name of a point: that is a pin. Every length, angle, mass, speed and force is a
    text with its unit: "120 mm", "30 deg", "2 kg", "60 rpm". Comes back: without a section the list of all and a
    whole example; with one its JSON Schema, or where there are kinds (joints, loads, driver) their names and keys,
    and with a kind its schema.
    """
    properties: Schema = json_schema()["properties"]
    if not section:
        return SchemaAnswer(
            ok=True,
            summary=in_language(
                _("{count} sections; format, frame and links are required", count=len(properties)), desk.language
            ),
            next=[NextAction(tool="check_model", why="finds everything that is wrong with a text")],
            sections=[_entry(name, each) for name, each in properties.items()],
            example=EXAMPLE,
        )
    if section not in properties:
        raise _unknown("section", section, list(properties))
    shape = properties[section]
    kinds = {str(each.get("title", "")): each for each in _kinds(shape)}
    if kind and kind not in kinds:
        raise _unknown("kind", kind, list(kinds))
    chosen = kinds[kind] if kind else shape
    many = len(kinds) > 1 and not kind
    fits = not many and len(json.dumps(chosen)) <= LONGEST
    return SchemaAnswer(
        ok=True,
        summary=in_language(
            _("{section}: {about}", section=section, about=chosen.get("description", kind)), desk.language
        ),
        next=[
            NextAction(
                tool="read_schema",
                arguments={"section": section, "kind": next(iter(kinds))},
                why="the schema of one kind",
            )
        ]
        if many
        else [],
        sections=[_entry(name, each) for name, each in kinds.items()] if many else [],
        json_schema=chosen if fits else {},
    )


def _kinds(shape: Schema) -> list[Schema]:
    """The kinds of a section, of an entry of its own names or of the section itself."""
    for each in (shape, shape.get("additionalProperties")):
        if isinstance(each, dict) and "oneOf" in each:
            return [one for one in each["oneOf"] if one.get("title")]
    return []


def _entry(name: str, shape: Schema) -> SectionEntry:
    inner = shape.get("additionalProperties")
    keys = shape.get("properties") or (inner.get("properties") if isinstance(inner, dict) else None) or {}
    return SectionEntry(name=name, about=str(shape.get("description", "")), keys=list(keys))


def _unknown(argument: str, name: str, known: list[str]) -> ModelError:
    message = _('a model file has no {argument} "{name}"', code="assistants.schema", argument=argument, name=name)
    return ModelError([Finding("error", "", argument, message, listed(name, known), "assistants.schema")])
