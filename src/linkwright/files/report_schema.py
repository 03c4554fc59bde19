"""The JSON Schema of the settings of a report, so that editors know their keys."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

_WORD: Mapping[str, Any] = {"type": ["string", "number"]}
_CHAPTER: Mapping[str, Any] = {
    "type": "object",
    "properties": {
        "title": {**_WORD, "description": "title of an own chapter"},
        "text": {"type": "string", "description": "text of the chapter, Markdown"},
        "label": {**_WORD, "description": "name by which texts refer to it: [[label]]"},
    },
    "required": ["title", "text"],
    "additionalProperties": False,
}
_SOURCE: Mapping[str, Any] = {
    "type": "object",
    "properties": {
        "key": {**_WORD, "description": "name by which texts cite it: [@key]"},
        "text": {"type": "string", "description": "the source as the list of references prints it"},
    },
    "required": ["key", "text"],
    "additionalProperties": False,
}
_COVER: Mapping[str, str] = {
    "school": "name of the school, at the top",
    "kind": "what the document is (default: Course design report)",
    "logo": "picture beside the model file: PNG, JPG or SVG",
    "faculty": "faculty or department",
    "major": "major",
    "class": "class",
    "author": "author (default: that of the report)",
    "student_number": "student number, in quotation marks where it begins with 0",
    "adviser": "adviser",
    "date": "date (default: that of the report)",
}
_WORDS: Mapping[str, str] = {
    "title": "title of the report",
    "author": "author of the report",
    "course": "course",
    "date": "date of the report",
    "purpose": "what the machine is for, instead of the model's",
    "source": "where it is taken from, instead of the model's",
    "position": "position that is worked out, such as 60 deg",
}


def _cover() -> dict[str, Any]:
    properties: dict[str, Any] = {key: {**_WORD, "description": doc} for key, doc in _COVER.items()}
    properties["fields"] = {"type": "object", "description": "further rows of the cover: {Mark: }"}
    return {
        "oneOf": [
            {"type": "boolean"},
            {"type": "object", "properties": properties, "additionalProperties": False},
        ],
        "description": "a cover of its own page",
    }


def _of_language() -> dict[str, Any]:
    """The keys that a language may have for itself."""
    return {
        **{key: {**_WORD, "description": doc} for key, doc in _WORDS.items()},
        "cover": _cover(),
        "sections": {
            "type": "array", "items": {"oneOf": [{"type": "string"}, _CHAPTER]},
            "description": "sections and own chapters in order; rest: all others",
        },
        "text": {"type": "object", "description": "own text by the name of a section, Markdown"},
        "references": {
            "type": "array", "items": {"oneOf": [{"type": "string"}, _SOURCE]}, "description": "own sources",
        },
        "errata": {"type": "array", "description": "mistakes of the source"},
    }  # fmt: skip


def report_keys() -> dict[str, Any]:
    """The schemas of the keys of the section ``report``."""
    own = _of_language()
    languages = {
        "en": "what an English report says instead",
        "zh": "what a Chinese report says instead",
    }
    return {
        **own,
        "positions": {"description": "numbered positions of the tables"},
        "numbered_from": {
            "type": "string",
            "description": "limit position that is number 1, such as rocker min",
        },
        "fluctuation": {"type": ["string", "number"], "description": "coefficient of speed fluctuation"},
        **{
            key: {"type": "object", "properties": own, "additionalProperties": False, "description": doc}
            for key, doc in languages.items()
        },
    }
