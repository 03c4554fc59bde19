"""CSV: one wide table."""

from __future__ import annotations

import csv
import io

from linkwright.export.base import FORMATS, Format
from linkwright.export.results import Results
from linkwright.export.tables import wide
from linkwright.words.characters import cell_text


def content(results: Results, *, degrees: bool = False) -> bytes:
    """A line of names with units, then a line per position; empty where a position was not reached.

    Numbers have all digits that they need to be read back unchanged. ``degrees``: angles in degrees.
    """
    columns = [column.turned if degrees else column for column in wide(results).values()]
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([cell_text(column.name) for column in columns])
    for row in zip(*(column.values.tolist() for column in columns), strict=True):
        writer.writerow(["" if value != value else repr(value) for value in row])
    return stream.getvalue().encode()


FORMATS.register("csv")(Format((".csv",), content))
