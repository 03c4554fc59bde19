"""``linkwright plot``: files, defaults, refusals, progress."""

import sys
from pathlib import Path

import pytest

from linkwright.cli import main
from linkwright.plot.diagrams.picture import chinese_font

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
        "--output",
        str(path),
    ]
    assert main(command) == 0
    assert path.read_bytes().startswith(b"%PDF") and str(path) in capsys.readouterr().out


def test_an_unknown_kind_lists_the_kinds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plot", CRUSHER, "--kind", "polygon", "--output", str(tmp_path / "x.svg")]) == 2
    said = capsys.readouterr().err
    assert "hodograph" in said and "force_polygon" in said
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "word"),
    [
        (["--output", "x.bmp"], ".svg"),
        (["--dpi", "nan"], "--dpi"),
        (["--fluctuation", "0"], "--fluctuation"),
        (["--kind", "hodograph", "--joint", "O55"], "O5"),
        (["--kind", "velocity_polygon", "--at", "30"], "30 deg"),
    ],
)
def test_slips_are_refused_and_nothing_is_written(
    options: list[str],
    word: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["plot", CRUSHER, "--steps", "36", *options]) == 2
    assert word in capsys.readouterr().err
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
    assert "1/2" in capsys.readouterr().err


def test_chinese_is_drawn_or_refused_with_a_remedy(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "z.png"
    code = main(["plot", CRUSHER, "--lang", "zh", "--steps", "36", "--dpi", "50", "--output", str(path)])
    if chinese_font() is None:
        assert code == 1 and "fonts-noto-cjk" in capsys.readouterr().err and not path.exists()
    else:
        assert code == 0 and path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("text", "said"), [("foo", "not a quantity"), ("3 m", "an angle is needed"), ("3deg,4deg", "give one")]
)
def test_an_input_that_cannot_be_is_refused_by_its_option(
    text: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = [
        "plot",
        CRUSHER,
        "--kind",
        "velocity_polygon",
        "--at",
        text,
        "--output",
        str(tmp_path / "x.svg"),
    ]
    assert main(command) == 2
    told = capsys.readouterr().err
    assert "error: --at:" in told and said in told


def test_a_report_of_no_position_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "r.html"
    assert main(["report", CRUSHER, "--position", "foo", "--sections", "task", "--output", str(path)]) == 2
    assert 'position: "foo" is not a quantity' in capsys.readouterr().err and not path.exists()
