"""``linkwright metrics``, and the warning that stands beneath every result."""

import csv
import json
from math import acos, asin, hypot, pi, sqrt
from pathlib import Path

import pytest

from linkwright.cli import main
from linkwright.words.characters import cells

PRESS, CONVEYOR = "gallery:slider_crank_offset", "gallery:swing_conveyor"
CRANK, ROD, OFFSET = 0.198, 0.7025, 0.0605


def test_the_offset_slider_crank(capsys: pytest.CaptureFixture[str]) -> None:
    names = "stroke,quick_return_ratio,transmission_angle_of_stroke"
    assert main(["metrics", PRESS, "--names", names, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["metrics"]
    values = {(row["metric"], row["subject"]): row["value"] for row in rows}
    outer, inner = asin(OFFSET / (ROD + CRANK)), asin(OFFSET / (ROD - CRANK))
    ratio = (pi + inner - outer) / (pi - inner + outer)
    stroke = sqrt((CRANK + ROD) ** 2 - OFFSET**2) - sqrt((ROD - CRANK) ** 2 - OFFSET**2)
    assert values["quick_return_ratio", "guide"] == pytest.approx(ratio, rel=1e-9)
    assert values["stroke", "guide"] == pytest.approx(stroke, rel=1e-12)
    angles = sorted(value for (name, _), value in values.items() if name.startswith("transmission"))
    want = [acos((CRANK + OFFSET) / ROD), acos((CRANK - OFFSET) / ROD)]
    assert angles == pytest.approx(want, rel=1e-9)


def test_the_table_shows_units_limits_and_remarks(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["metrics", CONVEYOR]) == 0
    shown = capsys.readouterr().out
    table, warnings = shown.split("\n\n")[1:]
    line = next(line for line in table.splitlines() if line.startswith("distance from a singular"))
    assert line.split()[-4:] == ["332.241°", "≥", "0.17", "!"]
    assert "crank-rocker: s + l < p + q" in table
    lines = warnings.strip().splitlines()
    assert all(line.startswith("! ") for line in lines)
    assert "passes close to a singular position at 332.241°" in lines[0]
    assert sum("singular position" in line for line in lines) == 1


def test_the_table_in_chinese_is_aligned(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["metrics", PRESS, "--names", "stroke", "limit_position", "--lang", "zh"]) == 0
    lines = capsys.readouterr().out.strip().splitlines()[2:]
    starts = {cells(line[: line.index("guide")]) for line in lines[1:]}
    assert len(starts) == 1


def test_the_numbers_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, data = tmp_path / "numbers.csv", tmp_path / "numbers.json"
    for path in (table, data):
        assert main(["metrics", CONVEYOR, "--output", str(path)]) == 0
        assert str(path) in capsys.readouterr().out
    rows = list(csv.DictReader(table.read_text().splitlines()))
    kept = json.loads(data.read_text())
    assert [float(row["value"]) for row in rows if row["value"] != "inf"] == [
        row["value"] for row in kept["metrics"] if row["value"] is not None
    ]
    near = next(row for row in rows if row["metric"] == "singularity")
    assert (near["limit"], near["warning"], near["at_unit"]) == ("0.17", "true", "rad")
    assert main(["metrics", CONVEYOR, "--output", str(table)]) == 2
    assert main(["metrics", CONVEYOR, "--output", "numbers.txt"]) == 2


@pytest.mark.parametrize(
    ("arguments", "code", "part"),
    [
        (["--names", "strok"], 2, 'did you mean "stroke"'),
        (["--names", "stroke,,grashof"], 2, "empty place"),
        (["--names", "grashof"], 2, "does not apply"),
        (["--names", "peak_reaction"], 2, "no mass and there are no loads"),
        (["--steps", "0"], 2, "--steps"),
    ],
)
def test_wrong_names_are_refused(
    arguments: list[str], code: int, part: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["metrics", PRESS, *arguments]) == code
    shown = capsys.readouterr()
    assert part in shown.err
    assert not shown.out


def test_a_structure_at_rest_has_its_reactions(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["metrics", "gallery:two_bars_equilibrium", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["metrics"]
    vertical = (250 + 100 * sqrt(3)) / (1 + sqrt(3))
    values = {row["subject"].split()[0]: row["value"] for row in found if row["metric"] == "peak_reaction"}
    assert values["A"] == pytest.approx(hypot(250 - vertical, vertical))
    assert values["B"] == pytest.approx(hypot(250 - vertical, 300 - vertical))


@pytest.mark.parametrize("arguments", [[], ["--at", "300deg"], ["--no-forces"]])
def test_solve_warns_of_a_singular_position(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", CONVEYOR, *arguments]) == 0
    assert "passes close to a singular position at 332.24" in capsys.readouterr().out


def test_solve_does_not_warn_where_none_is_near(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:jaw_crusher_sixbar"]) == 0
    assert "singular" not in capsys.readouterr().out


#: A wheel of 101 teeth, which a pinion of 97 turns 97 times until both are back, moves a rocker.
TEETH = """
format: 1
name: teeth
frame: {points: {O: [0 m, 0 m], Q: [0.198 m, 0 m], R: [0.5 m, 0 m]}}
links:
  pinion: {points: {O: [0 m, 0 m]}}
  wheel: {points: {Q: [0 m, 0 m], A: [0.05 m, 0 m]}}
  rod: {points: [A, B], length: 0.3 m}
  rocker: {points: [R, B], length: 0.2 m}
joints: {mesh: {kind: gear, links: [pinion, wheel], teeth: [97, 101]}}
assembly: {B: left}
driver: {turn: pinion, about: O, speed: 10 rad/s}
"""


def test_what_comes_at_every_turn_is_shown_a_few_times_and_counted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One limit of each kind in every turn of the wheel; the data have all of them."""
    file = tmp_path / "teeth.yaml"
    file.write_text(TEETH, encoding="utf-8")
    assert main(["metrics", str(file), "--names", "limit_position,dead_point"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) < 50
    for name in ("limit position", "dead point"):
        for kind in ("max", "min"):
            own = [line for line in lines if line.startswith(name) and f"rocker {kind}" in line]
            assert len(own) == 7 and f"rocker {kind}, 91 more" in own[-1] and " … " in own[-1]
    assert main(["metrics", str(file), "--names", "limit_position", "--lang", "zh"]) == 0
    assert "rocker 最大，另有 91 处" in capsys.readouterr().out
    assert main(["metrics", str(file), "--names", "limit_position", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["metrics"]
    assert [sum(row["subject"] == f"rocker {kind}" for row in rows) for kind in ("max", "min")] == [97, 97]
    inputs = [row["at"] for row in rows if row["subject"] == "rocker max"]
    assert inputs == pytest.approx([inputs[0] + 2.0 * pi * 101 / 97 * k for k in range(97)], abs=1e-8)
