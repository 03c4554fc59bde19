"""Parts of a stroke, as shares of it or as ways: the first, the last, or what is left between free ends."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from linkwright.core.dataclass import dataclass
from linkwright.fields.base import Field, Schema, pair_schema, quantity_schema, written_quantity
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Place, Reader
from linkwright.words.sentence import Sentence

PartWord = Literal["first", "last", "free"]
#: Keys of a phase that name a part of the stroke.
PARTS: Mapping[PartWord, str] = {
    "first": "only the first part of the stroke: a share (0.2) or a way (10 mm)",
    "last": "only the last part of the stroke: a share (0.2) or a way (10 mm)",
    "free": "free parts at both ends, or [at the beginning, at the end]: shares (0.05) or ways (10 mm)",
}


@dataclass(frozen=True)
class Amount:
    """A share of a stroke, 0 to 1, or a way (m or rad)."""

    value: float
    share: bool

    def way(self, stroke: float) -> float:
        """Its length in a stroke (m or rad)."""
        return self.value * stroke if self.share else self.value

    def written(self, dimension: str) -> Any:
        """As it stands in a file."""
        return self.value if self.share else written_quantity(self.value, dimension)


@dataclass(frozen=True)
class StrokePart:
    """``first`` or ``last`` amount of a stroke, or all but the ``free`` amounts at its beginning and its end."""

    word: PartWord
    amounts: tuple[Amount, ...]

    def written(self, dimension: str) -> dict[str, Any]:
        """Key and value for a file."""
        found = [amount.written(dimension) for amount in self.amounts]
        return {self.word: found[0] if len(found) == 1 else found}


@dataclass(frozen=True)
class StrokePartField(Field):
    """A share of a stroke or a way; for ``free`` also two of them. The output is the table's key ``of``."""

    word: PartWord

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> StrokePart | None:
        output = given.get("of")
        if output is None:
            return None
        nodes = [node]
        if self.word == "free" and isinstance(node, Sequence):
            nodes = reader.items(node, place, 2, "[0.05, 0.1]") or []
        with reader.plain_numbers(Sentence("model.plain_stroke_part")):
            found = [self._amount(reader, each, place, output.dimension) for each in nodes]
        amounts = tuple(amount for amount in found if amount is not None)
        return StrokePart(self.word, amounts) if amounts and len(amounts) == len(found) else None

    def _amount(self, reader: Reader, node: Node, place: Place, dimension: str) -> Amount | None:
        share = _number(node)
        if share is None:
            way = reader.quantity(node, place, dimension)
            if way is None or way > 0 or (way == 0 and self.word == "free"):
                return None if way is None else Amount(way, share=False)
        elif 0 < share < 1 or (share == 0 and self.word == "free") or (share == 1 and self.word != "free"):
            return Amount(share, share=True)
        text = node.text if isinstance(node, Scalar) else ""
        reader.finding(
            node,
            place,
            "no_stroke_part",
            "range",
            text=text,
            example="10 mm" if dimension == "length" else "5 deg",
        )
        return None

    def shape(self) -> Schema:
        one: Schema = {
            "anyOf": [{"type": "number", "minimum": 0, "maximum": 1}, quantity_schema("length")["anyOf"][0]]
        }
        if self.word != "free":
            return one
        return {"anyOf": [*one["anyOf"], pair_schema(one)]}

    def written(self, value: Any) -> Any:
        raise AssertionError("a phase writes its part")


def _number(node: Node) -> float | None:
    """A bare number, or None."""
    if not isinstance(node, Scalar) or not node.plain:
        return None
    try:
        return float(node.text)
    except ValueError:
        return None
