"""CSV and Markdown: tables as text."""

from __future__ import annotations

from linkwright.core.table import Tabular, csv_rows, csv_text
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.results import Results, wide


def content(results: Results, *, degrees: bool = False) -> bytes:
    """A line of names with units, then a line per position; empty where a position was not reached.

    Numbers have all digits that they need to be read back unchanged. ``degrees``: angles in degrees.
    """
    columns = [column.in_degrees(rates=True) if degrees else column for column in wide(results).values()]
    return csv_text({column.heading: column.values for column in columns}).encode()


def of_result(result: Tabular, language: str) -> bytes:
    """The curves or columns of a result, SI; without any its tables as they are shown, below one another."""
    if columns := result.columns():
        return csv_text(columns).encode()
    parts = [csv_rows([row for row in each.texts(language) if row]) for each in result.tables(language) if each.rows]
    return "\n".join(parts).encode()


def markdown(results: Results) -> bytes:
    """The metrics of a machine."""
    return of_tables(results.metrics, results.language)


def of_tables(result: Tabular, language: str) -> bytes:
    """The tables of a result."""
    return result.markdown(language).encode()


FORMATS.register("csv")(Format((".csv",), content, of_result))
FORMATS.register("markdown")(Format((".md",), markdown, of_tables))
