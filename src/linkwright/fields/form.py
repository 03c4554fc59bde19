"""What a key of a model file may hold, in words: said from its JSON Schema, so of every kind of field."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkwright import units
from linkwright.words import Message
from linkwright.words.sentence import Gloss, Sentence


def missing_remedy(key: str, doc: str, shape: Mapping[str, Any]) -> Message:
    """What to write for a missing key: its description, or in other languages its name and its form."""
    own = form(shape)
    return Sentence("form.add_key", key_=key, form=Gloss(doc, own) if doc else own)


def form(shape: Mapping[str, Any]) -> Message:
    """The words for a JSON Schema: ``a length, such as 60.5 mm``; ``list of 2: a link's name``."""
    match shape:
        case {"const": only}:
            return Sentence("form.just", value=only)
        case {"enum": names}:
            return Sentence("form.one_of", names=tuple(names))
        case {"x-dimension": dimension, "examples": [example, *_]}:
            return Sentence("form.such_as", noun=Sentence(f"nouns.a_{dimension}"), example=example)
        case {"x-dimension": dimension, "anyOf": [*_, {"type": "array"} as listed]}:
            one = {"x-dimension": dimension, "examples": [units.example(dimension)]}
            return Sentence("form.either", several=[form(one), form(listed)])
        case {"x-dimension": dimension, "x-variables": variables}:
            return Sentence("form.formula", noun=Sentence(f"nouns.a_{dimension}"), variables=tuple(variables))
        case {"x-reference": what}:
            return Sentence(f"form.name_of_{what.replace('.', '_')}")
        case {"anyOf": several}:
            return Sentence("form.either", several=[form(each) for each in several])
        case {"items": item, "minItems": least, "maxItems": most} if least == most:
            return Sentence("form.list_of_so_many", count=least, item=form(item))
        case {"items": item}:
            return Sentence("form.list_of", item=form(item))
        case {"additionalProperties": Mapping() as item}:
            return Sentence("form.by_name", item=form(item))
        case {"properties": Mapping() as inner}:
            return Sentence("form.keys", names=tuple(inner))
        case {"type": "integer"}:
            return Sentence("form.whole")
        case {"type": ["string", "number"]}:
            return Sentence("form.any_quantity")
        case {"type": "string"}:
            return Sentence("form.text")
    return Sentence("form.value")
