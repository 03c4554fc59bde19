"""Numbers of results by name, in blocks: rows of tables, and the same as data."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from linkwright.core.table import ROUNDING, Amount, Cell, Scale, Table, Tabular, unused
from linkwright.errors import speaker
from linkwright.words import Message, Translate


@dataclass(frozen=True)
class Row:
    """One number of a result: its key, value (SI) and dimension; ``label`` where it is not the key's word.

    An interval goes from ``value`` to ``end``; ``scale`` is the unit of a number without dimension; ``text`` is what
    tables show in place of number and unit, ``digits`` how many they show of this one; ``note``: a remark behind
    it, ``more``: the same as data; a ``remainder`` is what a balance leaves, itself nothing but rounding.
    """

    key: str
    value: float
    dimension: str = ""
    label: str = ""
    note: str = ""
    scale: Scale | None = None
    end: float | None = None
    text: str = ""
    remainder: bool = False
    more: Mapping[str, Any] = field(default_factory=dict)
    digits: int | None = None

    def cells(self, labels: Mapping[str, Message], digits: int = 6) -> list[Cell]:
        """Label, number with so many digits, unit and note."""
        label = self.label or labels[self.key]
        if self.text:
            return [label, self.text, "", self.note]
        amount = Amount(self.value, self.dimension, self.digits or digits, self.end, self.scale, bare=True)
        return [label, amount, amount.unit, self.note]

    def tidy(self, rounding: float) -> Row:
        """The row with values below a limit as zero; a plain number, or a ``remainder``, stays."""
        if not self.dimension or self.remainder or self.text:
            return self
        value = 0.0 if abs(self.value) <= rounding else self.value
        end = 0.0 if self.end is not None and abs(self.end) <= rounding else self.end
        return replace(self, value=value, end=end)

    def data(self) -> dict[str, Any]:
        """Value or both ends, SI, with their unit, and the note; what is no number with the text that says why."""
        found = Amount(self.value, self.dimension, end=self.end, scale=self.scale).data
        note = self.text if math.isnan(self.value) else "" if self.more else self.note
        return {**found, **self.more, **({"note": note} if note else {})}


@dataclass(frozen=True)
class Block:
    """Rows under a title; ``key`` names them in data, ``remarks`` are sentences below."""

    key: str
    title: str
    rows: Sequence[Row]
    remarks: Sequence[str] = ()

    def table(self, labels: Mapping[str, Message], digits: int = 6) -> Table:
        """Labels, numbers with so many digits, units and notes, the remarks below."""
        rows = [row.cells(labels, digits) for row in self.rows]
        return Table((), rows, "<><<", self.title, self.remarks)

    def data(self) -> dict[str, Any]:
        """The rows by their labels, each under one of its own, and the remarks."""
        rows: dict[str, Any] = {}
        for row in self.rows:
            rows[unused((row.label or row.key).strip(), rows)] = row.data()
        if self.remarks:
            rows[unused("remarks", rows)] = list(self.remarks)
        return rows


def tidy(blocks: Sequence[Block]) -> list[Block]:
    """Blocks with rounding errors of the largest of a dimension set to zero; remainders as found."""
    largest: dict[str, float] = {}
    for row in (row for block in blocks for row in block.rows):
        for value in (row.value, *([] if row.end is None else [row.end])):
            if not math.isnan(value):
                largest[row.dimension] = max(largest.get(row.dimension, 0.0), abs(value))
    return [
        replace(block, rows=[row.tidy(ROUNDING * largest.get(row.dimension, 0.0)) for row in block.rows])
        for block in blocks
    ]


class Numbers(Tabular):
    """A result of numbers in blocks; ``labels``: what they are, by the keys of their rows, ``digits``: how many are
    shown of each."""

    labels: ClassVar[Mapping[str, Message]] = {}
    digits: ClassVar[int] = 6

    @property
    @abstractmethod
    def title(self) -> str:
        """What the result is of."""

    @abstractmethod
    def blocks(self, say: Translate) -> list[Block]:
        """The numbers, with titles and remarks in a language."""

    def notes(self, language: str = "en") -> list[str]:
        """Remarks about the numbers."""
        return []

    def tables(self, language: str = "en", digits: int | None = None) -> tuple[Table, ...]:
        """The blocks in words of the language, each number with so many digits, and the notes."""
        blocks, notes = tidy(self.blocks(speaker(language))), self.notes(language)
        tables = (each.table(self.labels, digits or self.digits) for each in blocks)
        return (Table(title=self.title), *tables, Table(notes=notes))

    def data(self) -> dict[str, Any]:
        """The numbers by key, SI, each with its unit; notes and remarks in English."""
        found: dict[str, Any] = {"name": self.title}
        for row in (row for block in self.blocks(speaker("en")) for row in block.rows):
            found[unused(row.key, found)] = row.data()
        return {**found, "remarks": self.notes()}
