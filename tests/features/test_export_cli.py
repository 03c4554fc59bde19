"""The command ``export``: one file per call, refused before any work where it cannot be written."""

import json
from pathlib import Path
from typing import Any

import pytest
from tests.cli.commands import is_refused

from linkwright.cli import main

MODEL = "gallery:crank_rocker"


def test_a_file_is_written_and_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.csv"
    assert main(["export", MODEL, "--output", str(path), "--steps", "12"]) == 0
    assert len(path.read_text(encoding="utf-8").splitlines()) == 13
    assert str(path) in capsys.readouterr().out


def test_as_data(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "machine.txt"
    words = ["export", MODEL, "--output", str(path), "--format", "modelica", "--steps", "12", "--json"]
    assert main(words) == 0
    assert json.loads(capsys.readouterr().out) == {"ok": True, "path": str(path), "format": "modelica"}
    assert path.read_text(encoding="utf-8").startswith("model Linkwright_")


def test_a_file_that_exists_is_kept_without_force(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.csv"
    path.write_text("mine", encoding="utf-8")
    assert main(["export", MODEL, "--output", str(path)]) == 2
    assert "--force" in capsys.readouterr().err and path.read_text(encoding="utf-8") == "mine"
    assert main(["export", MODEL, "--output", str(path), "--steps", "12", "--force"]) == 0
    assert path.read_text(encoding="utf-8").startswith("time")


@pytest.mark.parametrize(
    ("words", "code", "values"),
    [
        (["--output", "a.xslx"], "export.no_ending", {"suffix": ".xslx", "offer": ".xlsx"}),
        (["--output", "a.csv", "--unit", "mm"], "export.no_option", {"name": "csv", "option": "unit"}),
        (["--output", "a.csv", "--curve", "spline"], "export.no_option", {"name": "csv", "option": "curve"}),
        (["--output", "a.csv", "--format", "exel"], "cli.bad_choice", {"name": "--format", "value": "exel"}),
        (["--output", "no/folder/a.csv"], "file.no_folder", {"path": "no/folder"}),
        (["--output", "a.csv", "--steps", "0"], "range", {"text": "0"}),
        ([], "cli.missing", {"names": ("--output",)}),
    ],
)
def test_a_wrong_command_is_refused(
    words: list[str], code: str, values: dict[str, Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    is_refused(["export", MODEL, *words], code, **values)
    assert list(tmp_path.iterdir()) == []


def test_a_machine_that_does_not_assemble_leaves_no_file(tmp_path: Path) -> None:
    model = tmp_path / "m.yaml"
    model.write_text(
        "format: 1\nname: short\nframe: {points: {O: [0 m, 0 m], P: [9 m, 0 m]}}\nlinks:\n"
        "  crank: {points: [O, A], length: 1 m}\n  coupler: {points: [A, B], length: 2 m}\n"
        "  rocker: {points: [P, B], length: 2 m}\ndriver: {turn: crank, about: O, speed: 1 rad/s}\n",
        encoding="utf-8",
    )
    is_refused(["export", str(model), "--output", str(tmp_path / "a.xml")], "motion.refused", 1, missing="4000 mm")
    assert [path.name for path in tmp_path.iterdir()] == ["m.yaml"]


def test_options_change_what_is_written(tmp_path: Path) -> None:
    for name, options in {"a.mo": [], "b.mo": ["--form", "positions", "--name", "Own"]}.items():
        assert main(["export", "gallery:crank_rocker", "--output", str(tmp_path / name), *options]) == 0
    first, second = ((tmp_path / name).read_text(encoding="utf-8") for name in ("a.mo", "b.mo"))
    assert "model Own" in second and "model Own" not in first and first != second
