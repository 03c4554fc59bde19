"""Tables of results: typed cells, written for terminals, files, notebooks and reports from one place.

A result offers ``table`` or ``blocks``; its text, its data, its files and its place in a report are views of them.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Container, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property
from html import escape
from itertools import count
from typing import TYPE_CHECKING, Any

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.core.quantity import MISSING, number, shown_unit, with_unit
from linkwright.formula.late_import import numpy as np
from linkwright.units import Dimension, si_symbol, si_unit
from linkwright.words import Message, Say
from linkwright.words.characters import aligned, aligned_within, cell_text
from linkwright.words.sentence import in_language

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats

#: Beside the largest of its kind anything below this share is nothing but rounding.
ROUNDING = 1e-12
_NUMBER = re.compile(r"[-+]?[\d.]+(?:e[-+]?\d+)?")
#: Digits of a column's largest value.
COLUMN_DIGITS = 5
#: Rows that a notebook shows of a long table.
MOST = 40


@dataclass(frozen=True)
class Scale:
    """A unit that the user chose: its name, its size in SI, and the SI unit of the same kind."""

    unit: str
    factor: float
    si: str


#: Shares of one as tables show them; they are plain numbers in data.
PERCENT, PARTS_PER_MILLION = Scale("%", 1e-2, ""), Scale("ppm", 1e-6, "")


def in_si(kind: Dimension) -> Scale:
    """The SI unit of a dimension."""
    return Scale(si_symbol(kind), 1.0, si_symbol(kind))


@dataclass(frozen=True)
class Amount:
    """A number of a table, SI, with its dimension; ``end`` of an interval that begins at ``value``.

    ``scale``: the unit of a number without dimension; ``bare``: the heading has the unit; ``mark``: a sign behind it.
    """

    value: float
    dimension: str = ""
    digits: int = 6
    end: float | None = None
    scale: Scale | None = None
    bare: bool = False
    mark: str = ""

    @property
    def number(self) -> str:
        """The number, or both ends, in the shown unit."""
        ends = [self.value] if self.end is None else [self.value, self.end]
        if self.scale is not None:
            return " … ".join(number(each / self.scale.factor, digits=self.digits) for each in ends)
        return " … ".join(number(each, self.dimension, self.digits) for each in ends)

    @property
    def unit(self) -> str:
        """The shown unit."""
        return self.scale.unit if self.scale is not None else shown_unit(self.dimension)

    @property
    def text(self) -> str:
        """What a cell shows."""
        return (self.number if self.bare else with_unit(self.number, self.unit)) + self.mark

    @property
    def data(self) -> dict[str, Any]:
        """Value or both ends, SI, with their unit."""
        unit = self.scale.si if self.scale else si_unit(self.dimension)
        return {"value": self.value if self.end is None else [self.value, self.end], "unit": unit}


#: A text or message, a number with its dimension, a count, or nothing.
Cell = str | Amount | int | None


@dataclass(frozen=True)
class Table:
    """Cells below a heading; ``align``: ``<``, ``>`` or ``^`` per column, by default all but the first to the right;
    ``title`` above, ``notes`` below."""

    head: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    align: str = ""
    title: str = ""
    notes: Sequence[str] = ()

    def texts(self, language: str = "en") -> list[list[str]]:
        """The heading and the rows as texts."""
        return [[_text(cell, language) for cell in row] for row in (self.head, *self.rows)]

    def values(self, language: str = "en") -> list[list[str | float | None]]:
        """The heading and the rows as texts and numbers, amounts in SI."""
        return [[_value(cell, language) for cell in row] for row in (self.head, *self.rows)]

    @property
    def alignment(self) -> str:
        """The alignment of every column."""
        return self.align or "<" + ">" * (len(self.head) - 1)

    def lines(self, language: str = "en", width: int | None = None) -> list[str]:
        """The lines on a terminal, folded within a width."""
        rows = aligned_within(self.texts(language), self.alignment, width)
        return [line for each in rows for line in each]

    def html(self, language: str = "en") -> str:
        """The table as notebooks show it."""
        head, *rows = self.texts(language)
        sides = {"<": "left", ">": "right", "^": "center"}
        styles = [f"text-align:{sides[each]}" for each in self.alignment]
        body = "".join(
            "<tr>"
            + "".join(f'<td style="{how}">{escape(cell)}</td>' for how, cell in zip(styles, row, strict=True))
            + "</tr>"
            for row in rows
        )
        heads = "".join(f"<th>{escape(word)}</th>" for word in head)
        lines = "".join(f"<p>{escape(in_language(line, language))}</p>" for line in self.notes)
        top = f"<caption>{escape(self.title)}</caption><thead><tr>{heads}</tr></thead>"
        return f"<table>{top}<tbody>{body}</tbody></table>{lines}"


def _value(cell: Cell, language: str) -> str | float | None:
    return (
        cell.value
        if isinstance(cell, Amount)
        else in_language(cell, language)
        if isinstance(cell, str)
        else cell
    )


def _text(cell: Cell, language: str) -> str:
    if cell is None:
        return ""
    if isinstance(cell, Amount):
        return cell.text
    return str(cell) if isinstance(cell, int) else in_language(cell, language)


@dataclass(frozen=True)
class Row:
    """One number of a result: its key, value (SI) and dimension; ``label`` where it is not the key's word.

    An interval goes from ``value`` to ``end``; ``scale`` is the unit of a number without dimension; ``text`` is what
    tables show in place of number and unit, ``digits`` how many they show of this one; ``note``: what is said behind
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

    def cells(self, labels: Mapping[str, Message], say: Say, digits: int = 6) -> list[str]:
        """Label, number with so many digits, unit and note."""
        label = self.label or say(labels[self.key])
        if self.text:
            return [label, self.text, "", self.note]
        amount = Amount(self.value, self.dimension, self.digits or digits, self.end, self.scale)
        return [label, amount.number, amount.unit, self.note]

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

    def lines(self, labels: Mapping[str, Message], say: Say, digits: int = 6) -> list[str]:
        """Title, rows and remarks on a terminal."""
        rows = aligned([row.cells(labels, say, digits) for row in self.rows], "<><<")
        title = [self.title] if self.title else []
        return [*title, *(f"  {line}" for line in rows), *map(str, self.remarks)]

    def data(self) -> dict[str, Any]:
        """The rows by their labels, each under one of its own, and the remarks."""
        rows: dict[str, Any] = {}
        for row in self.rows:
            rows[unused((row.label or row.key).strip(), rows)] = row.data()
        if self.remarks:
            rows[unused("remarks", rows)] = list(self.remarks)
        return rows


def tidy(blocks: Sequence[Block]) -> list[Block]:
    """Blocks with numbers that are rounding beside the largest of their dimension as zero; remainders as found."""
    largest: dict[str, float] = {}
    for row in (row for block in blocks for row in block.rows):
        for value in (row.value, *([] if row.end is None else [row.end])):
            if not math.isnan(value):
                largest[row.dimension] = max(largest.get(row.dimension, 0.0), abs(value))
    return [
        replace(block, rows=[row.tidy(ROUNDING * largest.get(row.dimension, 0.0)) for row in block.rows])
        for block in blocks
    ]


def blocks_data(name: str, blocks: Sequence[Block]) -> dict[str, Any]:
    """Blocks by key as plain data, SI, each number with its unit."""
    found: dict[str, Any] = {"name": name}
    for block in blocks:
        found[unused(block.key, found)] = block.data()
    return found


def rows_data(blocks: Sequence[Block]) -> dict[str, Any]:
    """The rows of all blocks by their keys as plain data."""
    found: dict[str, Any] = {}
    for row in (row for block in blocks for row in block.rows):
        found[unused(row.key, found)] = row.data()
    return found


def together(blocks: Sequence[Block], labels: Mapping[str, Message], say: Say, digits: int = 7) -> list[str]:
    """The rows of all blocks aligned with one another, an empty line before each block."""
    lines = iter(aligned([row.cells(labels, say, digits) for block in blocks for row in block.rows], "<><>"))
    return [line for block in blocks if block.rows for line in ("", *(next(lines) for _ in block.rows))]


def unused(key: str, taken: Container[str]) -> str:
    """The key, numbered where a name that the user chose has taken it: ``remarks (2)``."""
    return next(each for n in count(1) if (each := f"{key} ({n})" if n > 1 else key) not in taken)


@dataclass(frozen=True)
class Column:
    """Values (n,) of one quantity of a link, point, joint or driver (``owner``), in ``unit``.

    ``scale`` is the size against which values are mere rounding, and printed as 0.
    """

    owner: str
    quantity: str
    unit: str
    values: Floats
    scale: float = 1.0

    @classmethod
    def of(cls, output: Output, values: Floats) -> Column:
        """The column of a result."""
        return cls(output.place, output.quantity, output.unit, values)

    @property
    def name(self) -> str:
        """Its name: ``jaw.angle``."""
        return ".".join(filter(None, (self.owner, self.quantity)))

    @property
    def heading(self) -> str:
        """Its name with the unit: ``jaw.angle [rad]``."""
        return f"{self.name} [{self.unit}]"

    def in_degrees(self, *, rates: bool = False) -> Column:
        """The same with angles, and where asked their rates, in degrees."""
        if not (self.unit.startswith("rad") if rates else self.unit == "rad"):
            return self
        return replace(self, unit=self.unit.replace("rad", "°", 1), values=np.degrees(self.values))

    def cells(self) -> list[str]:
        """Texts of the values, with the same number of decimals."""
        return [self.text(value) for value in self.values]

    def text(self, value: float) -> str:
        """Text of one value as this column writes it."""
        if not math.isfinite(value):
            return MISSING
        if self._largest < ROUNDING * self.scale:
            return "0"
        if self._decimals is None:
            return f"{value:.{COLUMN_DIGITS - 1}e}"
        return f"{round(value, self._decimals) + 0.0:.{self._decimals}f}"

    @cached_property
    def _largest(self) -> float:
        from linkwright.core.arrays import largest

        return largest(self.values)

    @cached_property
    def _decimals(self) -> int | None:
        """Decimals that all values get, no more than they need; None for numbers written with a power of ten."""
        place = math.floor(math.log10(self._largest))
        if not -4 <= place < 9:
            return None
        most = min(max(COLUMN_DIGITS - 1 - place, 0), 6)
        values = self.values[np.isfinite(self.values)]
        exact = (d for d in range(most) if np.abs(values - np.round(values, d)).max() < 1e-9 * self._largest)
        return next(exact, most)


def csv_text(columns: Mapping[str, Any]) -> str:
    """Columns as CSV; numbers to the last bit, nothing where there is no number or a column ends."""
    longest = max(map(len, columns.values()), default=0)
    return csv_rows(
        [list(columns), *([c[i] if i < len(c) else "" for c in columns.values()] for i in range(longest))]
    )


def csv_rows(rows: Sequence[Sequence[Any]]) -> str:
    """Rows as CSV; texts that spreadsheets would take for formulas begin with an apostrophe."""
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows([_csv_cell(cell) for cell in row] for row in rows)
    return stream.getvalue()


def _csv_cell(cell: Any) -> str:
    if cell is None:
        return ""
    if isinstance(cell, str):
        return cell if _NUMBER.fullmatch(cell) else cell_text(cell)
    if isinstance(cell, bool | int):
        return str(cell).lower()
    amount = float(cell)
    return repr(amount) if amount == amount else ""


def columns_table(title: str, columns: Mapping[str, Any], notes: Sequence[str] = ()) -> Table:
    """The first rows of named columns, numbered, with notes below."""
    longest = max(map(len, columns.values()), default=0)
    rows: list[list[Cell]] = [
        [i, *(Amount(float(each[i])) for each in columns.values())] for i in range(min(longest, MOST))
    ]
    below = [f"{MOST} / {longest}"] if longest > MOST else []
    return Table(["", *columns], rows, title=title, notes=[*below, *notes])
