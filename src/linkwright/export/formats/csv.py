"""CSV: one wide table."""

from __future__ import annotations

from linkwright.core.table import csv_text
from linkwright.export.export import FORMATS, Format
from linkwright.export.results import Results
from linkwright.export.tables import wide


def content(results: Results, *, degrees: bool = False) -> bytes:
    """A line of names with units, then a line per position; empty where a position was not reached.

    Numbers have all digits that they need to be read back unchanged. ``degrees``: angles in degrees.
    """
    columns = [column.in_degrees(rates=True) if degrees else column for column in wide(results).values()]
    return csv_text({column.heading: column.values for column in columns}).encode()


FORMATS.register("csv")(Format((".csv",), content))
