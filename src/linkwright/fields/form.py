"""Descriptions of what a key of a model file may hold, from its JSON Schema."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from linkwright import units
from linkwright.words import Message, _


def missing_remedy(key: str, doc: str, shape: Mapping[str, Any]) -> Message:
    """What to write for a missing key: its description, or in other languages its name and its form."""
    own = form(shape)
    return _("add {key_}: {form}", key_=key, form=partial(_described, doc, own) if doc else own)


def _described(doc: str, own: Message, language: str) -> str:
    return doc if language == "en" else own.translate(language)


_NAMES = {
    "link": _("a link's name"),
    "joint": _("a joint's name"),
    "point": _("a point's name"),
    "link.point": _("a point as link.point"),
    "output": _("an output"),
}


def form(shape: Mapping[str, Any]) -> Message:
    """The words for a JSON Schema: ``a length, such as 60.5 mm``; ``list of 2: a link's name``."""
    match shape:
        case {"const": only} | {"enum": [only]}:
            return _("{value}", value=only)
        case {"enum": names}:
            return _("one of {names}", names=tuple(names))
        case {"x-dimension": dimension, "examples": [example, *_]}:
            return _("{noun}, such as {example}", noun=units.NOUNS[dimension], example=example)
        case {"x-dimension": dimension, "anyOf": [*_, {"type": "array"} as listed]}:
            one = {"x-dimension": dimension, "examples": [units.example(dimension)]}
            return _("one of these forms: {several}", several=[form(one), form(listed)])
        case {"x-dimension": dimension, "x-variables": variables}:
            return _("{noun}, an expression of {variables}", noun=units.NOUNS[dimension], variables=tuple(variables))
        case {"x-reference": what}:
            return _NAMES[what]
        case {"anyOf": several}:
            return _("one of these forms: {several}", several=[form(each) for each in several])
        case {"items": item, "minItems": fewest, "maxItems": most} if fewest == most:
            return _("a list of {count}: {item}", count=fewest, item=form(item))
        case {"items": item}:
            return _("a list: {item}", item=form(item))
        case {"additionalProperties": Mapping() as item}:
            return _("a mapping by name: {item}", item=form(item))
        case {"properties": Mapping() as inner}:
            return _("a mapping with keys of {names}", names=tuple(inner))
        case {"type": "boolean"}:
            return _("true or false")
        case {"type": "number"}:
            return _("a number")
        case {"type": "integer"}:
            return _("an integer")
        case {"type": ["string", "number"]}:
            return _("a number or a quantity")
        case {"type": "string"}:
            return _("a text")
    return _("a value")
