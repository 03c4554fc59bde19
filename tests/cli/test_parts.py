"""The commands for machine parts: text, worked text, data, files, slips."""

import json
import re
from pathlib import Path

import pytest
from tests.cli.commands import data, finding_codes, is_refused, shown
from tests.cli.tables import rows

from linkwright.cli import main

#: The command that calculates each kind of file.
COMMANDS = {
    "beam": "beam",
    "link_bending": "beam",
    "forces": "statics",
    "rigid_body": "statics",
    "belt": "statics",
    "wedge": "statics",
    "rotor": "statics",
    "cam": "cam",
    "vibration": "vibration",
    "follower": "vibration",
    "mounts": "vibration",
    "statistics": "statistics",
    "program": "program",
    "tolerance": "tolerance",
    "trajectory": "trajectory",
    "throw": "trajectory",
}


def test_numbers_of_the_table() -> None:
    table = {row[0]: row[1:] for row in rows(shown("beam", "gallery:cantilever"))}
    assert table["A F"] == ["2000", "N"] and table["A M"] == ["3000", "N·m"]
    assert table["w(2000 mm)"] == ["-0.84375", "mm"]
    digits = {row[0]: row[1:] for row in rows(shown("statics", "gallery:force_system", "--digits", "8"))}
    assert digits["Ex"] == ["184.79983", "N"] and digits["|E|"] == ["236.90805", "N"]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_worked_text_has_the_same_formulas_in_both_languages(language: str) -> None:
    worked = shown("beam", "gallery:cantilever", "--worked", "--lang", language)
    assert "M(ξ) = −3000 + 2000·ξ N·m" in worked and "w_max = -0.84375 mm" in worked


def test_curves_data_and_picture_in_files(tmp_path: Path) -> None:
    table, kept, picture = (tmp_path / name for name in ("c.csv", "c.json", "c.svg"))
    assert main(["beam", "gallery:cantilever", "--output", str(table), "--plot", str(picture)]) == 0
    lines = table.read_text(encoding="utf-8").splitlines()
    assert lines[0] == "x [m],shear [N],moment [N·m],slope [rad],deflection [m]"
    assert float(lines[-1].split(",")[-1]) == pytest.approx(-0.84375e-3, rel=1e-12)
    assert picture.read_text(encoding="utf-8").rstrip().endswith("</svg>")
    assert main(["beam", "gallery:cantilever", "--output", str(kept)]) == 0
    assert json.loads(kept.read_text(encoding="utf-8"))["reactions"]["A F"]["value"] == pytest.approx(2000)
    is_refused(["beam", "gallery:cantilever", "--output", str(kept)], "file.exists", path=kept)


def test_a_file_of_another_kind_names_its_command() -> None:
    values = {"kind": "program", "command": "program", "file": "gallery:gear_pair"}
    is_refused(["beam", "gallery:gear_pair"], "part.other_command", **values)
    is_refused(["program", "gallery:nothing"], "no-file", name="nothing")


@pytest.mark.parametrize("kind", [*COMMANDS])
def test_every_kind_names_its_own_command_alone(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(f"format: 1\nkind: {kind}\n", encoding="utf-8")
    for command in ("solve", "structure", "synthesize"):
        for language in ("en", "zh"):
            asked = [command, str(path), "--lang", language]
            told = is_refused(asked, "kind", ends=1, kind=kind, command=COMMANDS[kind])
            assert told.translate(language).count("linkwright ") == 1
            assert f"linkwright {COMMANDS[kind]}" in told.translate(language)


def test_a_kind_that_does_not_exist_is_told_with_those_that_do(tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("format: 1\nkind: vibrations\n", encoding="utf-8")
    asked = ["solve", str(path)]
    is_refused(asked, "kind", ends=1, kind="vibrations", offer="vibration", names=set(COMMANDS))


def test_a_task_of_synthesis_names_its_command() -> None:
    for command in ("solve", "cam"):
        told = is_refused([command, "gallery:path_of_five_points"], "kind", ends=1)
        assert "linkwright synthesize" in str(told)


def test_check_reads_calculations(tmp_path: Path) -> None:
    (file,) = data("check", "gallery:cantilever")["files"]
    assert (file["ok"], file["kind"]) == (True, "beam")
    path = tmp_path / "b.yaml"
    path.write_text(
        "format: 1\nkind: beam\nlength: 1 m\nmaterial: S235\nsection: IPE 80\nsupports: {}\n", encoding="utf-8"
    )
    assert finding_codes("check", str(path)) == [("supports", "can_move")] * 2


def test_what_only_the_solution_shows_has_its_place(tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    lines = ["format: 1", "kind: program", "variables: {x: {from: 0}}", "maximize: x", "subject_to:", "  a: x >= 9"]
    path.write_text("\n".join([*lines, "  b: x <= 3", ""]), encoding="utf-8")
    (found,) = data("program", str(path), code=1)["findings"]
    assert (found["where"], found["key"], found["code"]) == ("p.yaml:6:6", "subject_to.a", "infeasible")


def test_structures_of_model_files() -> None:
    reactions = data("statics", "gallery:truss")["reactions"]
    assert reactions["support on roller Fy"]["value"] == pytest.approx(1500)
    worked = shown("statics", "gallery:two_bars_equilibrium", "--worked")
    assert len(worked.splitlines()) > 20 and {"A", "B"} <= set(re.findall(r"\b[A-Z]\b", worked))


def test_a_file_with_old_words_is_solved_and_told_the_new_ones(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "old.yaml"
    path.write_text("format: 1\nkind: forces\nforces: {P: {size: 5 N, along: [3, 4]}}\n", encoding="utf-8")
    assert main(["statics", str(path), "--json"]) == 0
    told = capsys.readouterr()
    assert json.loads(told.out)["resultant"]["Rx"]["value"] == pytest.approx(3.0)
    assert "magnitude" in told.err and "direction" in told.err
