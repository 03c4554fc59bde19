"""Tables of results: typed cells, written for terminals, files, notebooks and reports from one place.

A result offers ``tables``; its text, its files, its place in notebooks and reports are views of them. Most of them
are numbers by name, in blocks of rows, and give the same as data.
"""

from __future__ import annotations

import csv
import io
import math
import re
from abc import ABC, abstractmethod
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from html import escape
from itertools import count
from typing import TYPE_CHECKING, Any, ClassVar

from linkwright.core.outputs import Output
from linkwright.core.quantity import MISSING, number, shown_factor, shown_unit, with_unit
from linkwright.errors import LinkwrightError, speaker
from linkwright.formula.late_import import numpy as np
from linkwright.units import Dimension, si_symbol, si_unit
from linkwright.words import Message, Translate, _
from linkwright.words.characters import aligned, cell_text
from linkwright.words.message import in_language

if TYPE_CHECKING:
    import pandas

    from linkwright.core.arrays import Floats


#: Values below this share of the largest of their kind are rounding errors.
ROUNDING = 1e-12
#: Characters with a meaning in Markdown.
_MARKDOWN_SIGNS = re.compile(r"[\\`*_\[\]<>|#]")
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
    def shown(self) -> float:
        """The value in the shown unit."""
        return self.value / self.scale.factor if self.scale is not None else self.value * shown_factor(self.dimension)

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
    ``title`` above, ``notes`` below. Without rows it is a paragraph."""

    head: Sequence[str] = ()
    rows: Sequence[Sequence[Cell]] = ()
    align: str = ""
    title: str = ""
    notes: Sequence[str] = ()

    def texts(self, language: str = "en") -> list[list[str]]:
        """The heading and the rows as texts."""
        return [[_text(cell, language) for cell in row] for row in (self.head, *self.rows)]

    @property
    def alignment(self) -> str:
        """The alignment of every column."""
        columns = max(map(len, (self.head, *self.rows)))
        return (self.align or "<" + ">" * columns)[:columns]

    def lines(self, language: str = "en") -> list[str]:
        """Title, rows and notes; rows without a heading are indented, a heading has empty lines around its rows."""
        head, *body = self.texts(language)
        title = [in_language(self.title, language)] if self.title else []
        notes = [in_language(note, language) for note in self.notes]
        if not head:
            return [*title, *(f"  {line}" for line in aligned(body, self.alignment)), *notes]
        rows = aligned([head, *body], self.alignment)
        return [*title, *[""] * len(title), *rows, *[""] * bool(notes), *notes]

    def html(self, language: str = "en") -> str:
        """The table as notebooks show it."""
        head, *rows = self.texts(language)
        notes = "".join(f"<p>{escape(in_language(line, language))}</p>" for line in self.notes)
        title = escape(in_language(self.title, language))
        if not rows:
            return f"<p><b>{title}</b></p>{notes}" if title else notes
        sides = {"<": "left", ">": "right", "^": "center"}
        styles = [f"text-align:{sides[each]}" for each in self.alignment]
        body = "".join(
            "<tr>"
            + "".join(f'<td style="{how}">{escape(cell)}</td>' for how, cell in zip(styles, row, strict=True))
            + "</tr>"
            for row in rows
        )
        heads = "".join(f"<th>{escape(word)}</th>" for word in head)
        top = f"<caption>{title}</caption><thead><tr>{heads}</tr></thead>"
        return f"<table>{top}<tbody>{body}</tbody></table>{notes}"

    def markdown(self, language: str = "en") -> str:
        """The table in Markdown, with what else it holds in paragraphs."""
        head, *rows = [
            [_MARKDOWN_SIGNS.sub(r"\\\g<0>", cell.strip()) for cell in row] for row in self.texts(language)
        ]
        rule = [{"<": "---", ">": "--:", "^": ":-:"}[each] for each in self.alignment]
        lines = (f"| {' | '.join(row)} |" for row in (head or [""] * len(rule), rule, *rows))
        notes = (_MARKDOWN_SIGNS.sub(r"\\\g<0>", in_language(note, language).strip()) for note in self.notes)
        title = _MARKDOWN_SIGNS.sub(r"\\\g<0>", in_language(self.title, language))
        parts = (f"**{title}**" if title else "", "\n".join(lines) if rows else "", *notes)
        return "\n\n".join(filter(None, parts))


class Tabular(ABC):
    """A result that is read as tables; its text and its files are views of them.

    ``row_names``: the column that names the rows of the others.
    """

    row_names: ClassVar[str | None] = None

    @abstractmethod
    def tables(self, language: str = "en", *args: Any, **options: Any) -> Sequence[Table]:
        """The tables in the order in which they are read, with the text above and below each."""

    @abstractmethod
    def data(self) -> Mapping[str, Any]:
        """Plain data, SI."""

    def columns(self) -> Mapping[str, Any]:
        """Curves, or numbers of many designs, by name with unit, SI; empty where there are none."""
        return {}

    def text(self, language: str = "en", **options: Any) -> str:
        """The tables as plain text, in a language (``en``, ``zh``); ``options``: those of ``tables``."""
        parts = ("\n".join(each.lines(language)) for each in self.tables(language, **options))
        return "\n\n".join(filter(None, parts))

    def markdown(self, language: str = "en") -> str:
        """The tables in Markdown."""
        return "\n\n".join(filter(None, (each.markdown(language) for each in self.tables(language)))) + "\n"

    def to_dataframe(self) -> pandas.DataFrame:
        """The columns as a pandas table; needs pandas."""
        return dataframe(self.columns(), index=self.row_names)

    def _repr_html_(self) -> str:
        """The tables as notebooks show them."""
        return "".join(each.html() for each in self.tables())


def _text(cell: Cell, language: str) -> str:
    if cell is None:
        return ""
    if isinstance(cell, Amount):
        return cell.text
    return str(cell) if isinstance(cell, int) else in_language(cell, language)


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


def dataframe(named: Mapping[str, Any], *, index: str | None = None) -> pandas.DataFrame:
    """A pandas table of named columns, one of them its index where asked.

    Raises:
        LinkwrightError: pandas is not installed.
    """
    try:
        import pandas
    except ImportError as error:
        raise LinkwrightError(
            _("pandas is not installed; install it with: pip install pandas", code="motion.needs_pandas")
        ) from error
    table = pandas.DataFrame(dict(named))
    return table if index is None else table.set_index(index)


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
    def blocks(self, translate: Translate) -> list[Block]:
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
