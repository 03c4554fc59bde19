"""Width and height of a sheet in one word: ``600x400``, in millimetres where no unit is written."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from linkwright.fields.base import Field, Quantity, Schema
from linkwright.fields.nodes import Node, Scalar
from linkwright.fields.reading import Place, Reader
from linkwright.words import _

_SIDE = Quantity("length", above=0)
_NUMBER = re.compile(r"[\d.]+")


@dataclass(frozen=True)
class SheetSize(Field):
    """Two lengths with an x between, m."""

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> tuple[float, float] | None:
        text = node.text if isinstance(node, Scalar) else ""
        sides = re.split(r"\s*[x×*]\s*", text.strip(), flags=re.IGNORECASE)
        if not isinstance(node, Scalar) or len(sides) != 2 or not all(sides):
            problem = _('"{text}" is not the size of a sheet', text=text[:60])
            reader.error(node, place, problem, _("write width and height with an x between: 600x400"), "syntax")
            return None
        written = (f"{each} mm" if _NUMBER.fullmatch(each) else each for each in sides)
        width, height = (_SIDE.read(reader, replace(node, text=each), place, siblings) for each in written)
        return None if width is None or height is None else (width, height)

    def shape(self) -> Schema:
        return {"type": "string"}
