"""``linkwright metrics``, and the warning that stands beneath every result."""

import csv
import json
import re
from math import acos, asin, hypot, pi, sqrt
from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, shown
from tests.cli.machines import TEETH
from tests.cli.tables import cells, numbers, rows, width
from tests.every import every

from linkwright.words import _, translate

PRESS, CONVEYOR = "gallery:slider_crank_offset", "gallery:swing_conveyor"
CRANK, ROD, OFFSET = 0.198, 0.7025, 0.0605


def test_the_offset_slider_crank() -> None:
    names = "stroke,quick_return_ratio,transmission_angle_of_stroke"
    found = data("metrics", PRESS, "--names", names)["metrics"]
    values = {(row["metric"], row["subject"]): row["value"] for row in found}
    outer, inner = asin(OFFSET / (ROD + CRANK)), asin(OFFSET / (ROD - CRANK))
    ratio = (pi + inner - outer) / (pi - inner + outer)
    stroke = sqrt((CRANK + ROD) ** 2 - OFFSET**2) - sqrt((ROD - CRANK) ** 2 - OFFSET**2)
    assert values["quick_return_ratio", "guide"] == pytest.approx(ratio, rel=1e-9)
    assert values["stroke", "guide"] == pytest.approx(stroke, rel=1e-12)
    angles = sorted(value for (name, _), value in values.items() if name.startswith("transmission"))
    want = [acos((CRANK + OFFSET) / ROD), acos((CRANK - OFFSET) / ROD)]
    assert angles == pytest.approx(want, rel=1e-9)


def test_the_table_shows_units_limits_and_warnings() -> None:
    """The rows of the data in their order, those with a warning marked; below, each remark once."""
    rated = data("metrics", CONVEYOR)
    found = shown("metrics", CONVEYOR)
    _, table, warnings = found.split("\n\n")
    body = [line for line in table.splitlines()[1:] if not line.startswith(" ")]
    assert len(body) == len(rated["metrics"]) > 40
    for line, row in zip(body, rated["metrics"], strict=True):
        assert row["subject"] in cells(line)
        assert line.endswith("!") == row["warning"]
        if row["limit"] is not None and not row["unit"]:
            assert numbers(cells(line.rstrip("!"))[-1]) == [row["limit"]]
    (stroke,) = [each for each in rows(found) if each[-1] == "mm" and numbers(each[2]) == [562.794]]
    assert stroke[1] == "guide"
    (near,) = [each for each in rows(found) if numbers(each[2]) == [0.141336]]
    assert near[3:] == ["332.241°", "≥ 0.17", "!"]
    lines = warnings.strip().splitlines()
    assert all(line.startswith("! ") for line in every(lines))
    assert numbers(lines[0]) == [332.241]
    assert len(lines) < sum(row["warning"] for row in rated["metrics"])


def test_the_table_in_chinese_is_aligned() -> None:
    printed = shown("metrics", PRESS, "--names", "stroke", "limit_position", "--lang", "zh")
    lines = [line for line in printed.splitlines() if "guide" in line]
    assert len({width(line[: line.index("guide")]) for line in every(lines, least=3)}) == 1


def test_the_numbers_are_written(tmp_path: Path) -> None:
    table, kept = tmp_path / "numbers.csv", tmp_path / "numbers.json"
    for path in (table, kept):
        assert str(path) in shown("metrics", CONVEYOR, "--output", str(path))
    written = list(csv.DictReader(table.read_text().splitlines()))
    assert [float(row["value"]) for row in every(written) if row["value"] != "inf"] == [
        row["value"] for row in json.loads(kept.read_text())["metrics"] if row["value"] is not None
    ]
    near = next(row for row in written if row["metric"] == "singularity")
    assert (near["limit"], near["warning"], near["at_unit"]) == ("0.17", "true", "rad")
    is_refused(["metrics", CONVEYOR, "--output", str(table)], "file.exists", path=table, remedy="--force")
    is_refused(
        ["metrics", CONVEYOR, "--output", "numbers.txt"],
        "cli.bad_suffix",
        endings={".csv", ".json", ".xlsx", ".md", ".html"},
    )


@pytest.mark.parametrize(
    ("arguments", "code", "values"),
    [
        (["--names", "strok"], "names.no_such", {"noun": "metric", "offer": "stroke"}),
        (["--names", "stroke,,grashof"], "metrics.no_names", {"text": "stroke,,grashof"}),
        (["--names", "grashof"], "metrics.does_not_apply", {"name": "grashof"}),
        (["--names", "peak_reaction"], "metrics.unloaded", {"names": {"peak_reaction"}}),
        (["--steps", "0"], "range", {"text": "0"}),
    ],
)
def test_wrong_names_are_refused(arguments: list[str], code: str, values: dict[str, object]) -> None:
    is_refused(["metrics", PRESS, *arguments], code, **values)


def test_a_structure_at_rest_has_its_reactions() -> None:
    found = data("metrics", "gallery:two_bars_equilibrium")["metrics"]
    vertical = (250 + 100 * sqrt(3)) / (1 + sqrt(3))
    values = {row["subject"].split()[0]: row["value"] for row in found if row["metric"] == "peak_reaction"}
    assert values["A"] == pytest.approx(hypot(250 - vertical, vertical))
    assert values["B"] == pytest.approx(hypot(250 - vertical, 300 - vertical))


@pytest.mark.parametrize("arguments", [[], ["--at", "300deg"], ["--no-forces"]])
def test_solve_warns_of_a_singular_position(arguments: list[str]) -> None:
    (warning,) = [line for line in shown("solve", CONVEYOR, *arguments).splitlines() if line.startswith("!")]
    assert numbers(warning) == [332.241]


def test_solve_does_not_warn_where_none_is_near() -> None:
    assert "!" not in shown("solve", "gallery:jaw_crusher_sixbar")


def in_words(kind: str, language: str) -> str:
    return translate(_(kind), language)


def test_what_comes_at_every_turn_is_shown_a_few_times_and_counted(tmp_path: Path) -> None:
    """One limit of each kind in every turn of the wheel; the data have all of them."""
    file = tmp_path / "teeth.yaml"
    file.write_text(TEETH, encoding="utf-8")
    for name in ("limit_position", "dead_point"):
        for language in ("en", "zh"):
            kinds = [in_words(each, language) for each in ("max", "min")]
            table = rows(shown("metrics", str(file), "--names", name, "--lang", language))[1:]
            of = [each[1] for each in table if each[0] == table[0][0]]
            assert len(of) == 14
            for kind in kinds:
                own = [each for each in of if each.startswith(f"rocker {kind}")]
                assert own[:6] == [f"rocker {kind}"] * 6 and len(own) == 7
                assert numbers(re.sub(r"\D+", " ", own[6])) == [91]
    found = data("metrics", str(file), "--names", "limit_position")["metrics"]
    assert [sum(row["subject"] == f"rocker {kind}" for row in found) for kind in ("max", "min")] == [97, 97]
    inputs = [row["at"] for row in found if row["subject"] == "rocker max"]
    assert inputs == pytest.approx([inputs[0] + 2.0 * pi * 101 / 97 * k for k in range(97)], abs=1e-8)
