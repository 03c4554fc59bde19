"""The commands compare and study: what they print, write and refuse."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from tests.cli.commands import is_refused
from tests.every import every

from linkwright.cli import main

SIX, FOUR = "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"


def test_both_crushers_by_one_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", SIX, FOUR]) == 0
    english = capsys.readouterr().out
    assert main(["compare", SIX, FOUR, "--lang", "zh"]) == 0
    chinese = capsys.readouterr().out
    for part in ("2.2635°", "1633.7 N·m", "580.71 N·m"):
        assert part in english and part in chinese
    assert english.isascii() is False and any("\u4e00" <= letter <= "\u9fff" for letter in chinese)
    assert not any("\u4e00" <= letter <= "\u9fff" for letter in english)


def test_a_comparison_is_written_with_its_curves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, curves = tmp_path / "table.csv", tmp_path / "curves.json"
    options = ["--metrics", "peak_input_torque", "travel", "--weights", "peak_input_torque=2"]
    assert main(["compare", SIX, FOUR, *options, "--output", str(table), "--curves", str(curves), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    rows = list(csv.reader(table.read_text().splitlines()))
    assert [row[0] for row in rows] == ["metric", "peak_input_torque [N·m]", "travel [rad]"]
    assert [float(cell) for cell in rows[1][1:]] == data["metrics"][0]["values"]
    lines = {each["name"]: each["lines"] for each in json.loads(curves.read_text())}
    assert all(len(line["x"]) == len(line["y"]) == 360 for line in every(lines["input_torque"].values()))
    assert main(["compare", SIX, FOUR, "--output", str(table)]) == 2


def test_a_study_by_one_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "study.csv"
    vary = ["--vary", "crank.length=40..60 mm:3", "rod.length=150, 200 mm"]
    assert main(["study", "gallery:slider_crank_inline", *vary, "--metrics", "stroke", "--output", str(path)]) == 0
    assert [word for word in capsys.readouterr().out.split() if word == "6"] == ["6", "6"]
    rows = list(csv.DictReader(path.read_text().splitlines()))
    assert [float(row["stroke [m]"]) for row in rows] == pytest.approx([0.08, 0.08, 0.1, 0.1, 0.12, 0.12], rel=1e-9)
    assert {float(row["rod.length"]) for row in rows} == {0.15, 0.2}


def test_the_studys_designs_that_cannot_move_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    vary = ["--vary", "coupler.length=1.013..7 m:12"]
    assert main(["study", "gallery:crank_rocker", *vary, "--metrics", "travel", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    b = np.linspace(1.013, 7.0, 12)
    turns = (b + 2.5 > 5.0) & (np.abs(b - 2.5) < 3.0)
    assert data["movable"] == int(turns.sum())
    assert sum(failure["count"] for failure in data["failures"]) == int((~turns).sum())
    assert [value is not None for value in data["metrics"]["travel"]["values"]] == turns.tolist()


@pytest.mark.parametrize(
    ("arguments", "ends", "code", "values"),
    [
        (["compare", SIX], 2, "compare.too_few", {}),
        (["compare", SIX, "gallery:shaper_quick_return"], 1, "study.no_common_output", {"names": ("rocker", "jaw")}),
        (["compare", SIX, FOUR, "--weights", "flywheel"], 2, "syntax", {"text": "flywheel"}),
        (["compare", SIX, FOUR, "--fluctuation", "no"], 2, "type", {"text": "no"}),
        (["compare", SIX, FOUR, "--of", "jaw", "jaw", "jaw"], 2, "compare.bad_count", {"count": 3, "files": 2}),
        (["compare", SIX, FOUR, "--metrics", "flywhel"], 2, "study.no_metric", {"offer": "flywheel"}),
        (["study", SIX], 2, "cli.missing", {"names": ("--vary",)}),
        (["study", SIX, "--vary", "pitman.length"], 2, "syntax", {"text": "pitman.length"}),
        (
            ["study", SIX, "--vary", "pitman.length=1 m", "pitman.length=2 m"],
            2,
            "duplicate-key",
            {"name": "pitman.length"},
        ),
        (["study", SIX, "--vary", "pitman.lenth=1 m"], 2, "study.no_dimension", {"offer": "pitman.length"}),
        (["study", SIX, "--vary", "pitman.length=20..30 m:3"], 1, "study.none_passes", {"count": 3}),
        (
            ["study", SIX, "--vary", "pitman.length=1.2 m", "--output", "study.txt"],
            2,
            "cli.bad_suffix",
            {"path": "study.txt", "endings": (".csv", ".json", ".xlsx", ".md", ".html")},
        ),
    ],
)
def test_what_the_commands_refuse(arguments: list[str], ends: int, code: str, values: dict[str, object]) -> None:
    is_refused(arguments, code, ends, **values)
