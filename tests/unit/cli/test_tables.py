"""Texts in tables of commands."""

import csv
import io

from linkwright.core.table import csv_text


def test_names_that_begin_like_formulas_are_texts_in_tables_and_numbers_stay_numbers() -> None:
    rows = list(
        csv.reader(io.StringIO(csv_text({"=1+1": ["@x", "+y", "plain", "-z"], "value": [-1.5, 2.0, -3e-9, 0.0]})))
    )
    assert rows[0] == ["'=1+1", "value"]
    assert [row[0] for row in rows[1:]] == ["'@x", "'+y", "plain", "'-z"]
    assert [float(row[1]) for row in rows[1:]] == [-1.5, 2.0, -3e-9, 0.0]
