"""One limit of closeness to a singular position, in tables, data and marks, and for ``check`` and ``structure``."""

import json
import math
from pathlib import Path
from typing import Any

import pytest
from tests.store import motion

import linkwright as lw
from linkwright.analysis import MetricValue
from linkwright.cli import main

BRACKET = """
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links:
  crank: {{points: {{O: [0 m, 0 m], P: [0.3 m, 0 m], Q: [0.5 m, 0 m]}}}}
  bar_1: {{points: [P, T], length: 0.15 m}}
  bar_2: {{points: [Q, T], length: {length} m}}
assembly: {{T: left}}
driver: {{turn: crank, about: O, speed: 60 rpm}}
"""
PARALLELOGRAM = """
format: 1
frame: {{points: {{A: [0 m, 0 m], D: [0.4 m, 0 m]}}}}
links:
  crank: {{points: [A, B], length: 0.1 m}}
  coupler: {{points: [B, C], length: 0.4 m}}
  rocker: {{points: [D, C], length: 0.1 m}}
assembly: {{C: left}}
driver: {{turn: crank, about: A, speed: 60 rpm, start: {start} deg}}
"""


def row(name: str) -> MetricValue:
    return lw.metrics(motion(name, 72))["singularity"][0]


@pytest.mark.parametrize(("name", "cuts"), [("triad", 2), ("fourbar_lecture", 1)])
def test_the_limit_of_a_row_is_the_one_by_which_it_is_marked(name: str, cuts: int) -> None:
    found = row(name)
    assert found.limit == pytest.approx(0.17**cuts)
    assert found.cells()[-1] == f"≥ {found.limit:.3g}"
    assert bool(found.warnings) == (found.value < found.limit)


def test_the_data_of_metrics_has_the_same_limit(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["metrics", "gallery:triad", "--names", "singularity", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["metrics"]
    assert found["limit"] == pytest.approx(0.17**2)


def said(command: str, text: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, Any]]:
    """The exit code of a command, and the data that it prints."""
    path = folder / "model.yaml"
    path.write_text(text)
    code = main([command, str(path), "--json"])
    return code, json.loads(capsys.readouterr().out)


def codes(data: dict[str, Any]) -> list[str]:
    return [finding["code"] for file in data["files"] for finding in file["findings"]]


def test_a_motion_that_is_singular_all_the_time_is_not_called_determined(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, data = said("check", BRACKET.format(length=0.05), tmp_path, capsys)
    assert (code, codes(data)) == (1, ["motion.refused"])
    _, data = said("structure", BRACKET.format(length=0.05), tmp_path, capsys)
    assert "(bar_1, bar_2)" in data["rank"]


@pytest.mark.parametrize("length", [0.05000001, 0.0501, 0.06])
def test_check_marks_by_the_limit_of_the_metric(
    length: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of a triangle that turns as one body: sin μ by the law of cosines, the same in all positions."""
    cosine = (0.15**2 + length**2 - 0.2**2) / (2.0 * 0.15 * length)
    near = math.sqrt(1.0 - cosine**2) < 0.17
    code, data = said("check", BRACKET.format(length=length), tmp_path, capsys)
    assert (code, codes(data)) == (0, ["singular"] if near else [])


@pytest.mark.parametrize("start", [0.0, 1.0, 0.3])
def test_check_and_metrics_agree_at_a_change_point(
    start: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = PARALLELOGRAM.format(start=start)
    check, metrics = (said(command, text, tmp_path, capsys)[0] for command in ("check", "metrics"))
    assert check == metrics == int(start != 0.3)
