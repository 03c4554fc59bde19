"""``linkwright animate``: moving pictures, progress, interruption, refusals."""

import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from linkwright.cli import main
from linkwright.cli.progress import progress
from linkwright.words import speaker

CRUSHER = "gallery:jaw_crusher_sixbar"
STUCK = """\
format: 1
name: Stuck four-bar
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.9 m}
  coupler: {points: [A, B], length: 1.2 m}
  rocker: {points: [O2, B], length: 1.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 60 deg}
"""


def test_moving_svg(tmp_path: Path) -> None:
    target = tmp_path / "a.svg"
    options = [
        "--paths",
        "C,jaw.D",
        "--curves",
        "jaw.angle",
        "--seconds",
        "3",
        "--forces",
        "--output",
        str(target),
    ]
    assert main(["animate", CRUSHER, *options]) == 0
    root = ET.parse(target).getroot()
    assert {e.get("dur") for e in root.iter() if e.get("dur")} == {"3s"}
    found = [word for e in root.iter() for word in e.get("class", "").split()]
    assert found.count("lw-dot") == 2 and "lw-force-line" in found
    assert any("angle of jaw (°)" in "".join(e.itertext()) for e in root.iter())


def test_gif_has_the_frames_and_the_time(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    pytest.importorskip("resvg_py")
    target = tmp_path / "a.gif"
    options = ["--frames", "10", "--seconds", "2 s", "--width", "120", "--output", str(target)]
    assert main(["animate", CRUSHER, *options]) == 0
    with image.open(target) as picture:
        assert (picture.n_frames, picture.width, picture.info["duration"]) == (10, 120, 200)


def test_mp4(tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    av = pytest.importorskip("av")
    target = tmp_path / "a.mp4"
    assert main(["animate", CRUSHER, "--seconds", "0.4 s", "--width", "120", "--output", str(target)]) == 0
    with av.open(str(target)) as film:
        assert sum(1 for _ in film.decode(video=0)) == 10


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--paths", "Q"], '--paths: there is no point "Q"'),
        (["--curves", "jaw.angel"], 'did you mean "jaw.angle"'),
        (["--seconds", "3 kg"], "--seconds"),
        (["--frames", "many"], "--frames"),
    ],
)
def test_wrong_usage(
    options: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["animate", CRUSHER, *options, "--output", str(tmp_path / "a.svg")]) == 2
    assert words in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_positions_left_out_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK, encoding="utf-8")
    assert main(["animate", str(model), "--output", str(tmp_path / "a.svg")]) == 1
    assert "positions cannot be reached" in capsys.readouterr().err
    assert (tmp_path / "a.svg").exists()


@pytest.mark.parametrize("command", ["animate", "draw"])
@pytest.mark.parametrize("option", ["--paths", "--velocities", "--accelerations", "--forces"])
def test_unknown_names_are_told_before_the_cycle_is_solved(
    command: str, option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK.replace("length: 1.2 m", "length: 0.1 m"))  # no position can be reached
    assert main([command, str(model), "--output", str(tmp_path / "a.svg"), option, "Q"]) == 2
    told = capsys.readouterr().err
    assert f"{option}: there is no" in told and '"Q"' in told and "reach" not in told


def test_interruption_leaves_no_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("resvg_py")
    pytest.importorskip("PIL")
    seen: list[str] = []

    def second_frame_never_comes(svg: str, **options: object) -> bytes:
        if seen:
            raise KeyboardInterrupt
        seen.append(svg)
        from linkwright.plot.svg.render import png

        return png(svg, width=100)

    monkeypatch.setattr("linkwright.plot.animation.png", second_frame_never_comes)
    assert main(["animate", CRUSHER, "--output", str(tmp_path / "a.gif")]) == 130
    assert capsys.readouterr().err.strip() == "interrupted"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("module", "ending", "extra"), [("PIL", "gif", "plot"), ("av", "mp4", "video")])
def test_missing_package_is_named_with_its_remedy(
    module: str,
    ending: str,
    extra: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    assert main(["animate", CRUSHER, "--output", str(tmp_path / f"a.{ending}")]) == 1
    assert f'pip install "linkwright[{extra}]"' in capsys.readouterr().err


def test_progress_shows_on_a_terminal_only(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with progress(speaker("en"), "animate.drawing") as report:
        assert report is None
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)

    def interrupted() -> None:
        with progress(speaker("en"), "animate.drawing") as report:
            assert report is not None
            report(5, 10)
            report(10, 10)
            assert capsys.readouterr().err.endswith(
                "5/10\r\x1b[K"
            )  # what is shown now has the line for itself
            report(6, 10)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    shown = capsys.readouterr().err
    assert "6/10" in shown and shown.endswith("\r\x1b[K")
