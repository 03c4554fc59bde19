"""Colours of links: a few by their names, which are legible on white and on dark paper, and any other as #rrggbb."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.fields.base import Field, Schema
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader
from linkwright.words import _

#: Muted, so that they are not taken for the colours of velocities, accelerations, forces and loads.
COLOURS_OF_LINKS: Mapping[str, str] = {
    "brown": "#8a6d3b",
    "blue": "#2f6f8f",
    "green": "#5f7f36",
    "purple": "#8a4f7d",
    "red": "#a8503f",
    "grey": "#6b7378",
}
_RGB = re.compile("#[0-9a-fA-F]{6}")


def as_rgb(colour: str) -> str:
    """A colour as #rrggbb; empty where none is given."""
    return COLOURS_OF_LINKS.get(colour, colour).lower()


@dataclass(frozen=True)
class Colour(Field):
    """A colour by its name, or as #rrggbb."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        if isinstance(node, Scalar) and node.empty:
            message, remedy = _("no colour is given; text behind # is a comment"), _('put it in quotes: "#2f6f8f"')
            reader.finding(node, place, message, "type", remedy)
            return None
        text = reader.text(node, place)
        if text is None or text in COLOURS_OF_LINKS or _RGB.fullmatch(text):
            return text
        reader.finding(
            node,
            place,
            _('"{text}" is not a known colour'),
            "choice",
            _('write one of {names}, or hexadecimal digits: "#2f6f8f"'),
            text=text,
            names=", ".join(COLOURS_OF_LINKS),
        )
        return None

    def shape(self) -> Schema:
        return {"anyOf": [{"enum": list(COLOURS_OF_LINKS)}, {"type": "string", "pattern": f"^{_RGB.pattern}$"}]}
