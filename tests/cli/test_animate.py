"""``linkwright animate``: moving pictures, positions left out, refusals."""

import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from tests.cli.commands import is_refused, run
from tests.cli.machines import STUCK, out_of_reach
from tests.cli.tables import numbers

from linkwright.cli import main

CRUSHER = "gallery:jaw_crusher_sixbar"


def test_moving_svg(tmp_path: Path) -> None:
    target = tmp_path / "a.svg"
    options = ["--paths", "C,jaw.D", "--curves", "jaw.angle", "--seconds", "3", "--forces"]
    assert main(["animate", CRUSHER, *options, "--output", str(target)]) == 0
    root = ET.parse(target).getroot()
    assert {e.get("dur") for e in root.iter() if e.get("dur")} == {"3s"}
    found = [word for e in root.iter() for word in e.get("class", "").split()]
    assert found.count("lw-dot") == 2 and "lw-force-line" in found
    assert any("jaw (°)" in "".join(e.itertext()) for e in root.iter())


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
    ("options", "code", "values"),
    [
        (["--paths", "Q"], "names.no_such", {"name": "--paths", "noun": "point"}),
        (["--curves", "jaw.angel"], "study.no_such_output", {"offer": "jaw.angle"}),
        (["--seconds", "3 kg"], "wrong-dimension", {"name": "--seconds", "text": "3 kg"}),
        (["--frames", "many"], "range", {"text": "many"}),
    ],
)
def test_wrong_usage(options: list[str], code: str, values: dict[str, object], tmp_path: Path) -> None:
    is_refused(["animate", CRUSHER, *options, "--output", str(tmp_path / "a.svg")], code, **values)
    assert list(tmp_path.iterdir()) == []


def test_positions_left_out_are_told_with_their_number(tmp_path: Path) -> None:
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK, encoding="utf-8")
    ended = run("animate", str(model), "--output", str(tmp_path / "a.svg"))
    left_out, positions = numbers(ended.err)[:2]
    assert left_out == out_of_reach(int(positions))
    assert ended.code == 1
    assert (tmp_path / "a.svg").exists()


@pytest.mark.parametrize("command", ["animate", "draw"])
@pytest.mark.parametrize("option", ["--paths", "--velocities", "--accelerations", "--forces"])
def test_unknown_names_are_told_before_the_cycle_is_solved(command: str, option: str, tmp_path: Path) -> None:
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK.replace("length: 1.2 m", "length: 0.1 m"))  # no position can be reached
    asked = [command, str(model), "--output", str(tmp_path / "a.svg"), option, "Q"]
    assert '"Q"' in str(is_refused(asked, "names.no_such", name=option))


@pytest.mark.parametrize(("module", "ending", "extra"), [("PIL", "gif", "plot"), ("av", "mp4", "video")])
def test_missing_package_is_named_with_its_remedy(
    module: str, ending: str, extra: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    asked = ["animate", CRUSHER, "--output", str(tmp_path / f"a.{ending}")]
    assert f"linkwright[{extra}]" in str(is_refused(asked, f"picture.{ending}_needs", ends=1))
