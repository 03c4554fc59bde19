"""The commands for machine parts: text, worked text, data, files, slips."""

import json
from pathlib import Path

import pytest

from linkwright.cli import main
from linkwright.files.calculations import COMMANDS


def test_numbers_and_worked_text_in_both_languages(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["beam", "gallery:cantilever"]) == 0
    assert "-0.84375  mm" in capsys.readouterr().out
    assert main(["statics", "gallery:force_system", "--digits", "8"]) == 0
    assert "184.79983" in capsys.readouterr().out
    assert main(["beam", "gallery:cantilever", "--worked", "--lang", "zh"]) == 0
    shown = capsys.readouterr().out
    assert "静定" in shown and "M(ξ) = −3000 + 2000·ξ N·m" in shown


def test_curves_data_and_picture_in_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, data, picture = (tmp_path / name for name in ("c.csv", "c.json", "c.svg"))
    assert main(["beam", "gallery:cantilever", "--output", str(table), "--plot", str(picture)]) == 0
    rows = table.read_text(encoding="utf-8").splitlines()
    assert rows[0] == "x [m],shear [N],moment [N·m],slope [rad],deflection [m]"
    assert float(rows[-1].split(",")[-1]) == pytest.approx(-0.84375e-3, rel=1e-12)
    assert picture.read_text(encoding="utf-8").rstrip().endswith("</svg>")
    assert main(["beam", "gallery:cantilever", "--output", str(data)]) == 0
    assert json.loads(data.read_text(encoding="utf-8"))["reactions"]["A F"]["value"] == pytest.approx(2000)
    capsys.readouterr()
    assert main(["beam", "gallery:cantilever", "--output", str(data)]) == 2
    assert "--force" in capsys.readouterr().err


def test_a_file_of_another_kind_names_its_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["beam", "gallery:gear_pair"]) == 2
    assert "call: linkwright program gallery:gear_pair" in capsys.readouterr().err
    assert main(["program", "gallery:nothing"]) == 2


def test_a_mechanism_command_names_the_calculation(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "b.yaml"
    path.write_text("format: 1\nkind: beam\nlength: 1 m\n", encoding="utf-8")
    assert main(["solve", str(path)]) == 1
    told = capsys.readouterr().err
    assert "a calculation of the kind beam" in told and "linkwright beam calculates it" in told


@pytest.mark.parametrize("kind", [*COMMANDS])
def test_every_kind_names_its_own_command_alone(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(f"format: 1\nkind: {kind}\n", encoding="utf-8")
    for command in ("structure", "synthesize"):
        for language, said in (("en", "linkwright {} calculates it"), ("zh", "请用 linkwright {} 计算")):
            assert main([command, str(path), "--lang", language]) in (1, 2)
            told = capsys.readouterr().err
            assert said.format(COMMANDS[kind]) in told and told.count("linkwright ") == 1


def test_a_kind_that_does_not_exist_is_told_with_those_that_do(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("format: 1\nkind: vibrations\n", encoding="utf-8")
    assert main(["solve", str(path)]) == 1
    told = capsys.readouterr().err
    assert 'the kind "vibrations" is not known; did you mean "vibration"?' in told
    assert "the model of a machine has no kind" in told


def test_a_task_of_synthesis_names_its_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for command in ("solve", "cam"):
        assert main([command, "gallery:path_of_five_points"]) in (1, 2)
        assert "linkwright synthesize finds machines for it" in capsys.readouterr().err


def test_check_reads_calculations(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "gallery:cantilever"]) == 0
    assert "fine (kind beam)" in capsys.readouterr().out
    path = tmp_path / "b.yaml"
    path.write_text(
        "format: 1\nkind: beam\nlength: 1 m\nmaterial: S235\nsection: IPE 80\nsupports: {}\n",
        encoding="utf-8",
    )
    assert main(["check", str(path)]) == 1
    assert "too few supports: the beam can turn about" in capsys.readouterr().out


def test_what_only_the_solution_shows_has_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "p.yaml"
    lines = [
        "format: 1",
        "kind: program",
        "variables: {x: {from: 0}}",
        "maximize: x",
        "subject_to:",
        "  a: x >= 9",
    ]
    path.write_text("\n".join([*lines, "  b: x <= 3", ""]), encoding="utf-8")
    assert main(["program", str(path)]) == 1
    assert "p.yaml:6:6: subject_to.a: no solution" in capsys.readouterr().err


def test_structures_of_model_files(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["statics", "gallery:truss", "--json"]) == 0
    reactions = json.loads(capsys.readouterr().out)["reactions"]
    assert reactions["support on roller Fy"]["value"] == pytest.approx(1500)
    assert main(["statics", "gallery:two_bars_equilibrium", "--worked"]) == 0
    assert len(capsys.readouterr().out.splitlines()) > 20
