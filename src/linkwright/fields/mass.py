"""A mass, or the words that let it follow from the shape."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from linkwright.fields.base import Quantity, Schema
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader

#: What a file has in the place of a mass that follows from the shape.
FROM_SHAPE = "from shape"


@dataclass(frozen=True)
class Mass(Quantity):
    """A mass, or ``from shape``."""

    dimension: str = "mass"
    minimum: float | None = field(default=0.0, kw_only=True)

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        text = " ".join(node.text.replace("_", " ").split()) if isinstance(node, Scalar) else ""
        if text == FROM_SHAPE:
            return FROM_SHAPE
        if text.partition(" ")[0] == "from":
            return reader.word(node, place, (FROM_SHAPE,))
        return super().read(reader, node, place, siblings)

    def shape(self) -> Schema:
        found = super().shape()
        return {**found, "anyOf": [*found["anyOf"], {"const": FROM_SHAPE}]}

    def written(self, value: Any) -> Any:
        return value if value == FROM_SHAPE else super().written(value)
