"""``linkwright plot``: files, defaults, refusals, progress."""

import sys
from pathlib import Path
from typing import Any

import pytest
from tests.cli.commands import is_refused, run

from linkwright.cli import main

CRUSHER = "gallery:jaw_crusher_sixbar"


def test_without_options_the_output_is_drawn_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["plot", CRUSHER, "--steps", "72"]) == 0
    assert (tmp_path / "jaw_crusher_sixbar-sva.svg").read_bytes().startswith(b"<?xml")
    assert main(["plot", CRUSHER, "--steps", "72"]) == 2
    assert main(["plot", CRUSHER, "--steps", "72", "--force"]) == 0


def test_options_reach_the_diagram(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "p.pdf"
    command = [
        "plot",
        CRUSHER,
        "--kind",
        "force_polygon",
        "--of",
        "jaw",
        "--at",
        "-200deg",
        "--steps",
        "36",
        "--output",
        str(path),
    ]
    assert main(command) == 0
    assert path.read_bytes().startswith(b"%PDF") and str(path) in capsys.readouterr().out


def test_an_unknown_kind_lists_the_kinds(tmp_path: Path) -> None:
    error = is_refused(
        ["plot", CRUSHER, "--kind", "polygon", "--output", str(tmp_path / "x.svg")], "picture.no_kind", name="--kind"
    )
    assert {"hodograph", "force_polygon"} < set(error.values["names"])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "code", "values"),
    [
        (["--output", "x.bmp"], "cli.bad_suffix", {"path": "x.bmp", "endings": (".svg", ".pdf", ".png")}),
        (["--dpi", "nan"], "type", {"text": "nan"}),
        (["--fluctuation", "0.1"], "picture.no_use", {"option": "fluctuation", "users": ("speed",)}),
        (["--kind", "speed", "--fluctuation", "0"], "range", {"shown": "0"}),
        (["--kind", "hodograph", "--joint", "O55"], "names.no_such", {"name": "O55", "offer": "O1"}),
        (["--kind", "velocity_polygon", "--at", "30"], "missing-unit", {"name": "--at", "right": "30 deg"}),
        (["--kind", "velocity_polygon", "--at", "foo"], "quantity", {"name": "--at", "text": "foo"}),
        (["--kind", "velocity_polygon", "--at", "3 m"], "wrong-dimension", {"name": "--at", "text": "3 m"}),
        (["--kind", "velocity_polygon", "--at", "3deg,4deg"], "draw.one_position", {"option": "--at"}),
    ],
)
def test_slips_are_refused_and_nothing_is_written(
    options: list[str], code: str, values: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    is_refused(["plot", CRUSHER, "--steps", "36", *options], code, **values)
    assert list(tmp_path.iterdir()) == []


def test_several_models_are_compared_with_progress_on_a_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "c.svg"
    models = [CRUSHER, "gallery:jaw_crusher_sixbar_as_reported"]
    command = ["plot", *models, "--kind", "torque", "--steps", "72", "--output", str(path)]
    assert main(command) == 0
    assert not capsys.readouterr().err and path.exists()
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    assert main([*command, "--force"]) == 0
    assert "solving" in capsys.readouterr().err


def test_chinese_is_drawn(tmp_path: Path) -> None:
    path = tmp_path / "z.png"
    ended = run("plot", CRUSHER, "--lang", "zh", "--steps", "36", "--dpi", "50", "--output", str(path))
    if ended.told is not None and ended.told.code == "picture.boxes":
        assert ended.code == 1 and not path.exists()
        pytest.skip("no installed font can write Chinese")
    assert ended.code == 0 and path.read_bytes().startswith(b"\x89PNG")


def test_a_report_of_no_position_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "r.html"
    options = ["--position", "foo", "--sections", "task", "--output", str(path)]
    is_refused(["report", CRUSHER, *options], "quantity", name="position", text="foo")
    assert not path.exists()
