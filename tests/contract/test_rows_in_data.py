"""Every row of a result's text stands once in its data, under a key of its own, as a number with its unit."""

import json
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import pytest

import linkwright as lw
from linkwright import parts
from linkwright.cli import main
from linkwright.parts.base import Result
from linkwright.words import speaker

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


def check(result: Result) -> None:
    """The rows of the text, in order, are those of the data."""
    blocks = result.blocks(speaker("en"))
    shown = [row.value if row.end is None else [row.value, row.end] for block in blocks for row in block.rows]
    found = list(rows_of(result.data()))
    assert len(found) == len(shown)
    assert all(value == pytest.approx(row, nan_ok=True) for (value, _), row in zip(found, shown, strict=True))
    assert all(isinstance(unit, str) for _, unit in found)


@pytest.mark.parametrize("name", NAMES)
def test_rows_of_the_text_are_rows_of_the_data(name: str) -> None:
    result = parts.load(f"gallery:{name}").solve()
    for language in ("en", "zh"):
        say = speaker(language)
        for block in result.blocks(say):
            labels = [row.cells(result.area, say)[0] for row in block.rows]
            assert len(set(labels)) == len(labels), (block.key, labels)
    if result.area != "program":  # has more in its data than in its text: both sides, slack and price
        check(result)


def test_a_program_has_its_numbers_with_units() -> None:
    data = parts.load("gallery:two_bar_truss").solve().data()
    assert data["x"]["d"] == {"value": pytest.approx(1.878 * 0.0254, rel=1e-3), "unit": "m"}
    assert data["objective"]["unit"] == "kg" and data["constraints"]["yielding"]["left"]["unit"] == "Pa"


def test_modes_tests_and_phases_keep_their_owner() -> None:
    """Two masses on springs: ω² of 400 and 1200 1/s², each under its own key; shares are plain numbers."""
    modes = parts.load("gallery:two_masses").solve().data()["modes"]
    for i, square in ((1, 400.0), (2, 1200.0)):
        assert modes[f"ω{i}"] == {"value": pytest.approx(square**0.5), "unit": "rad/s"}
    tests = parts.load("gallery:shaft_diameters").solve().data()["tests"]
    assert len([key for key in tests if key.endswith(": p")]) == 4
    load = parts.load("gallery:conveyor_load").solve().data()
    ends = [each["value"] for each in load["phases"].values()]
    assert len(ends) == 3 and all(a[1] == b[0] for a, b in pairwise(ends))
    shares = [
        load["transport"][key]["value"] for key in ("rest", "sliding forward", "sliding back", "flight")
    ]
    assert sum(shares) == pytest.approx(1.0)
    spread = parts.load("gallery:crank_rocker_tolerance").solve().data()
    share, *ends = (
        spread["rocker.angle range"]["yield"]["value"],
        *spread["rocker.angle range"]["range"]["value"],
    )
    assert 0.98 < share < 1.0 and ends[0] < ends[1]
    parts_of_variance = spread["rocker.angle range: contributions"].values()
    assert sum(each["value"] for each in parts_of_variance) == pytest.approx(1.0)


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


@pytest.mark.parametrize(
    "given", [["gallery:jaw_crusher_fourbar", "--ratio", "5", "--rim", "width=0.2"], None]
)
def test_rows_of_a_machine_are_rows_of_its_data(
    given: list[str] | None, capsys: pytest.CaptureFixture[str]
) -> None:
    curves = [
        "--torque",
        "200 + 100*sin(theta)",
        "--speed",
        "100 rpm",
        "--inertia",
        "2 kg·m²",
        "--fluctuation",
        "0.02",
    ]
    command = ["machine", *(given or curves)]
    assert main([*command, "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert main(command) == 0
    _, *lines = capsys.readouterr().out.splitlines()
    rows = [line for line in lines if line.strip() and line not in data["remarks"]]
    numbers = [each for each in data.values() if isinstance(each, dict)]
    assert len(numbers) == len(rows) and all(set(each) >= {"value", "unit"} for each in numbers)


def test_alternatives_of_one_name_keep_their_columns() -> None:
    found = lw.compare(["gallery:crank_rocker", "gallery:crank_rocker"], steps=60)
    assert len(set(found.labels)) == 2
    data = found.data()
    assert len(data["metrics"]) == len(found.rows)
    assert all(len(each["values"]) == 2 and isinstance(each["unit"], str) for each in data["metrics"])


def test_designs_have_their_units() -> None:
    """Of what varies as of the metrics."""
    machine, vary = lw.load("gallery:crank_rocker"), {"crank.length": "0.9..1.1 m"}
    found = lw.study(machine, vary, metrics=["swing_angle"], sampling="sobol", samples=4, steps=60)
    data = found.data()
    assert data["units"] == {"crank.length": "m"}
    assert all(each["unit"] == "rad" for each in data["metrics"].values())
