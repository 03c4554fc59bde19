"""XLSX: a workbook with one sheet per subject."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from linkwright.analysis.base import METRICS
from linkwright.core.arrays import largest
from linkwright.core.table import Amount, Cell, Column, Table, Tabular
from linkwright.designs.ranges import dimension_of
from linkwright.errors import RequestError
from linkwright.exporters.charts import Charts, Place, write_charts
from linkwright.exporters.export import FORMATS, Format, package
from linkwright.exporters.results import QUANTITIES, Results, Subject, tables
from linkwright.units import NONE, si_symbol
from linkwright.words import Message, _, pgettext
from linkwright.words.characters import printable
from linkwright.words.message import in_language

LONGEST_TEXT = 32767
MOST_ROWS, MOST_COLUMNS = 1_048_575, 16_384
#: Words over the columns of sheets that are no values over the positions, with the columns' widths.
#: Titles of sheets, and heads of their columns.
SHEETS = {
    "model": _("Model"),
    "structure": _("Structure"),
    "links": _("Links"),
    "points": _("Points"),
    "joints": _("Joints"),
    "forces": _("Forces"),
    "loads": _("Loads"),
    "outputs": _("Outputs"),
    "charts": _("Charts"),
    "metrics": _("Metrics"),
}
HEADS = {
    "item": _("item"),
    "value": pgettext("export", "value"),
    "unit": _("unit"),
    "number": _("no."),
    "group": _("group"),
    "links": _("links"),
    "class": _("class"),
    "order": _("order"),
    "drivers": pgettext("export", "drivers"),
    "joints": _("joints"),
    "metric": _("metric"),
    "subject": _("of"),
    "at": _("at input"),
    "at_unit": _("unit"),
    "remark": _("remark"),
}
_MODEL = {"item": 28, "value": 60, "unit": 12}
_GROUPS = {"number": 8, "group": 14, "links": 32, "class": 8, "order": 8, "drivers": 20, "joints": 40}
_METRICS = {"metric": 34, "subject": 24, "value": 14, "unit": 8, "at": 12, "at_unit": 8, "remark": 60}


def content(results: Results, *, degrees: bool = False) -> bytes:
    """Sheets on the model, its structure, links, points, joints, forces, loads, charts and metrics.

    Charts are the program's own, of the cells of the other sheets: motion of the outputs, joint forces and driving
    effort over the input, the hodograph of the joint on the frame that carries most.

    The heading of a column has its owner, quantity and unit and stays in view, as do time and inputs. Texts are
    written as texts: none is read as a formula or a link. Values that are not finite stay empty. ``degrees``: angles
    in degrees.
    """
    properties = {"title": results.mechanism.name, "comments": results.mechanism.source}
    return _written(lambda book: Workbook(book, results, degrees).write(), properties)


def of_result(result: Tabular, language: str) -> bytes:
    """A sheet for every table of a result, in the units in which it is shown."""
    return _written(lambda book: Sheets(book, language).write_tables(result.tables(language)), {})


def _written(write: Callable[[Any], None], properties: Mapping[str, str]) -> bytes:
    """The file of a workbook that is filled by a function."""
    xlsxwriter = package("xlsxwriter", _("Excel files"), "XlsxWriter")
    stream = io.BytesIO()
    settings = {
        "in_memory": True,
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "strings_to_numbers": False,
    }
    with xlsxwriter.Workbook(stream, settings) as book:
        book.set_properties(properties)
        write(book)
    return stream.getvalue()


class Sheets:
    """Tables on the sheets of a workbook."""

    def __init__(self, book: Any, language: str) -> None:
        self.book, self.language = book, language
        head = {"bold": True, "text_wrap": True, "valign": "top", "bottom": 1, "bg_color": "#E8EEF4"}
        self.head = book.add_format(head)
        self.text = book.add_format({"text_wrap": True, "valign": "top"})

    def write_tables(self, tables: Sequence[Table]) -> None:
        """A sheet for every table that has rows, with the paragraphs before it or behind it."""
        sheet, row, filled = None, 0, False
        for table in tables:
            if sheet is None or (filled and table.rows):
                sheet, row, filled = self.book.add_worksheet(), 0, False
                sheet.set_column(0, 0, 40)
                sheet.set_column(1, 20, 16)
            heads = [([table.title], None), (table.head, self.head)]
            rows = [*heads, *((cells, self.text) for cells in table.rows), *(([note], None) for note in table.notes)]
            for cells, form in rows:
                self._put(sheet, row, cells, form)
                row += any(cells)
            row, filled = row + 1, filled or bool(table.rows)

    def _put(self, sheet: Any, row: int, cells: Sequence[Cell], form: Any) -> None:
        """Writes a row of cells; numbers as they are shown, their units as formats."""
        for column, cell in enumerate(cells):
            if isinstance(cell, Amount) and cell.end is None:
                if math.isfinite(cell.value):
                    unit = cell.text.removeprefix(cell.number)
                    formats = [self.book.add_format({"num_format": f'General"{unit}"'})] if unit else []
                    sheet.write_number(row, column, cell.shown, *formats)
            elif isinstance(cell, int):
                sheet.write_number(row, column, cell)
            elif cell:
                text = cell.text if isinstance(cell, Amount) else in_language(cell, self.language)
                sheet.write_string(row, column, printable(text)[:LONGEST_TEXT], form)


class Workbook(Sheets):
    """The sheets of a motion, with its forces where there are any."""

    def __init__(self, book: Any, results: Results, degrees: bool) -> None:
        super().__init__(book, results.language)
        self.results, self.degrees = results, degrees
        self.places: dict[tuple[str, str, str], Place] = {}

    def write(self) -> None:
        """All sheets."""
        self._rows("model", _MODEL, list(_model(self.results, self.translate)))
        self._rows("structure", _GROUPS, list(_groups(self.results)))
        first, *others = tables(self.results)
        leading = self._turned(first.columns)
        for table in others:
            self._values(table, leading)
        rows = Charts(self.results, self.places).all()
        if rows:
            sheet = self._sheet("charts")
            sheet.hide_gridlines(2)
            write_charts(sheet, self.book, rows)
        numbers = list(_metrics(self.results))
        if numbers:
            self._rows("metrics", _METRICS, numbers)

    def translate(self, message: Message) -> str:
        """A message in the language of the results."""
        return message.translate(self.results.language)

    def _turned(self, columns: Sequence[Column]) -> list[Column]:
        return [column.in_degrees(rates=True) if self.degrees else column for column in columns]

    def _sheet(self, subject: str) -> Any:
        return self.book.add_worksheet(self.translate(SHEETS[subject]))

    def _rows(self, subject: str, columns: Mapping[str, int], rows: Sequence[Sequence[Cell]]) -> None:
        """A sheet of a table under a heading; columns by their words, with their widths."""
        sheet = self._sheet(subject)
        for column, width in enumerate(columns.values()):
            sheet.set_column(column, column, width)
        self._put(sheet, 0, [self.translate(HEADS[word]) for word in columns], self.head)
        for row, cells in enumerate(rows, start=1):
            self._put(sheet, row, cells, self.text)
        sheet.freeze_panes(1, 0)

    def _values(self, table: Subject, leading: Sequence[Column]) -> None:
        """A sheet of values over the positions."""
        sheet = self._sheet(table.subject)
        columns = [*leading, *self._turned(table.columns)]
        if len(columns) > MOST_COLUMNS or len(columns[0].values) > MOST_ROWS:
            raise RequestError(
                _(
                    "an Excel sheet holds {columns} columns of {rows} values; take fewer steps, or .parquet",
                    code="export.sheet_full",
                    columns=MOST_COLUMNS,
                    rows=MOST_ROWS,
                )
            )
        for index, column in enumerate(columns):
            sheet.write_string(0, index, self._heading(column), self.head)
            subject = table.subject if index >= len(leading) else "positions"
            place = Place(sheet.get_name(), index, column)
            self.places.setdefault((subject, column.owner, column.quantity), place)
            sheet.set_column(index, index, 14, self.book.add_format({"num_format": number_format(column.values)}))
            for row, value in enumerate(column.values.tolist(), start=1):
                if math.isfinite(value):
                    sheet.write_number(row, index, value)
        sheet.set_row(0, 48)
        sheet.freeze_panes(1, len(leading))
        sheet.autofilter(0, 0, len(columns[0].values), len(columns) - 1)

    def _heading(self, column: Column) -> str:
        """Owner, quantity in words, unit, each on a line."""
        owner = self.translate(_("shaking force")) if column.owner == "shaking_force" else column.owner
        word = self.translate(QUANTITIES[column.quantity]) if column.quantity else self.translate(_("input"))
        return printable("\n".join(filter(None, (owner, word, f"[{column.unit}]"))))


def number_format(values: np.ndarray[Any, np.dtype[np.float64]]) -> str:
    """Decimals that show six digits of the largest value; a power of ten where it is very large or small."""
    size = largest(values)
    if size == 0.0:
        return "0.000"
    place = math.floor(math.log10(size))
    if not -4 <= place < 8:
        return "0.00000E+00"
    decimals = max(0, min(9, 5 - place))
    return "0." + "0" * decimals if decimals else "0"


def _model(results: Results, translate: Callable[[Message], str]) -> Iterable[Sequence[Cell]]:
    mechanism = results.mechanism
    yield translate(_("name")), mechanism.name, ""
    for name, text in ((_("purpose"), mechanism.purpose), (_("source"), mechanism.source)):
        if text:
            yield translate(name), text, ""
    yield translate(_("mobility")), results.structure.mobility, ""
    yield translate(pgettext("export", "positions")), results.motion.steps, ""
    yield translate(_("positions reached")), int(results.motion.ok.sum()), ""
    if results.motion.positions.period is not None:
        yield translate(_("period")), Amount(results.motion.positions.period), "s"
    for note in results.notes:
        yield translate(pgettext("export", "note")), note, ""
    for address, value in mechanism.dimensions().items():
        yield address, Amount(value), si_symbol(dimension_of(mechanism, address) or NONE)


def _groups(results: Results) -> Iterable[Sequence[Cell]]:
    for number, group in enumerate(results.structure.groups, start=1):
        joints = ", ".join(dict.fromkeys(connection.joint for connection in group.joints))
        yield (
            number,
            group.signature,
            ", ".join(group.links),
            group.assur_class,
            group.assur_order,
            ", ".join(group.drivers),
            joints,
        )


def _metrics(results: Results) -> Iterable[Sequence[Cell]]:
    for row in results.metrics:
        data = row.data(results.language)
        label = METRICS[row.metric]().label_in(results.language, row.dimension)
        at = None if row.at is None else Amount(row.at)
        yield (label, row.subject, Amount(row.value), row.unit, at, data["at_unit"] or "", data["remark"])


FORMATS.register("xlsx")(Format((".xlsx",), content, of_result))
