"""Every row of a result's text stands once in its data, under a key of its own, as a number with its unit."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.contract.calculations import solved
from tests.every import every

from linkwright import parts
from linkwright.errors import speaker
from linkwright.parts.programs.program import Optimum

#: Searches that take seconds have the same rows as the others of their kind.
SEARCHES = ("beam_section", "lightest_spring")
NAMES = [name for name in parts.gallery_names() if name not in SEARCHES]


def rows_of(data: dict[str, Any]) -> Iterator[tuple[float | list[float], str]]:
    """Every value with its unit, in the order of the data."""
    for each in data.values():
        if isinstance(each, dict) and "value" in each:
            yield each["value"], each["unit"]
        elif isinstance(each, dict):
            yield from rows_of(each)


def check(result: parts.Result) -> None:
    """The rows of the text, in order, are those of the data."""
    blocks = result.blocks(speaker("en"))
    shown = [row.value if row.end is None else [row.value, row.end] for block in blocks for row in block.rows]
    found = list(rows_of(result.data()))
    assert len(found) == len(shown)
    assert all(value == pytest.approx(row, nan_ok=True) for (value, _), row in zip(found, shown, strict=True))
    assert all(isinstance(unit, str) for _, unit in found)


@pytest.mark.parametrize("name", NAMES)
def test_rows_of_the_text_are_rows_of_the_data(name: str) -> None:
    result = solved(name)
    for language in ("en", "zh"):
        translate = speaker(language)
        for block in every(result.blocks(translate)):
            labels = [texts[0] for texts in block.table(result.labels).texts(language)[1:]]
            assert len(set(labels)) == len(labels), (block.key, labels)
    if not isinstance(result, Optimum):  # has more in its data than in its text: both sides, slack and price
        check(result)


TAKEN = """format: 1
kind: program
variables: {minimum: {from: 1 mm, to: 2 mm}, remarks: {from: 1 mm, to: 3 mm}}
minimize: minimum + remarks
subject_to: {remarks: minimum + remarks >= 3 mm}
"""
NAMED = """format: 1
kind: statistics
samples: {name: {values: [1, 2, 4]}, tests: {values: [1, 3, 5]}}
tests: {p: {kind: two_means, of: [name, tests]}}
"""


def test_names_that_the_data_use_themselves_lose_nothing() -> None:
    data = parts.loads(TAKEN).solve().data()
    assert set(data["x"]) == {"minimum", "remarks"} and set(data["constraints"]) == {"remarks"}
    check(parts.loads(NAMED).solve())
