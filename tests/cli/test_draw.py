"""``linkwright draw``: pictures by their endings, choices, refusals, whole files."""

import json
import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from linkwright.cli import main

CRUSHER = "gallery:jaw_crusher_sixbar"
SVG = "{http://www.w3.org/2000/svg}"
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


def drawn(tmp_path: Path, *options: str, model: str = CRUSHER) -> ET.Element:
    target = tmp_path / "out.svg"
    assert main(["draw", model, *options, "--output", str(target), "--force"]) == 0
    return ET.parse(target).getroot()


def styles(root: ET.Element) -> list[str]:
    return [word for e in root.iter() for word in e.get("class", "").split()]


def texts(root: ET.Element) -> set[str]:
    return {"".join(e.itertext()) for e in root.iter(f"{SVG}text")}


def test_positions_out_of_reach_are_told_in_the_language_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK, encoding="utf-8")
    assert main(["draw", str(model), "--output", str(tmp_path / "out.svg"), "--lang", "zh"]) == 0
    told = capsys.readouterr().err
    assert "RRR 杆组" in told and "无法装配" in told and "cannot" not in told


def test_drawing_shows_what_is_asked_for(tmp_path: Path) -> None:
    root = drawn(
        tmp_path, "--at", "30 deg", "--overlay", "limits", "--paths", "C,jaw.D", "--velocities", "--centres"
    )
    found = styles(root)
    assert found.count("lw-pin") == 6 + 2 * 3  # A, B, C in both limit positions
    assert found.count("lw-trace") == 2
    assert found.count("lw-mass-ring") == 4
    assert {"lw-velocity-line", "lw-dashed"} <= set(found)
    assert not {"lw-acceleration-line", "lw-force-line", "lw-dimension"} & set(found)


def test_forces_dimensions_labels_inputs(tmp_path: Path) -> None:
    root = drawn(
        tmp_path, "--forces", "O5", "--dimensions", "pitman", "O1:O3", "--labels", "points", "--no-inputs"
    )
    found = styles(root)
    assert found.count("lw-force-head") == 1 + 1  # the arrow and its legend
    assert {"1.25 m", f"{math.hypot(0.94, 1.0):.6g} m"} <= texts(root)
    assert "jaw" not in texts(root) and "lw-input-head" not in found


def test_all_lengths_get_a_dimension_line(tmp_path: Path) -> None:
    assert {"100 mm", "1.25 m", "1 m", "1.15 m", "1.96 m"} <= texts(drawn(tmp_path, "--dimensions"))


def test_crank_stands_at_the_input(tmp_path: Path) -> None:
    turns = {}
    for degrees in (0, 47):
        root = drawn(tmp_path, "--at", f"{degrees} deg", model="gallery:crank_rocker")
        groups = [e.get("transform", "") for e in root.iter(f"{SVG}g") if e.get("class") == "lw-bodies"]
        turns[degrees] = float(re.findall(r"rotate\(([^)]*)\)", groups[0])[0])
    assert turns[47] - turns[0] == pytest.approx(-47.0, abs=1e-3)


def test_words_of_the_picture_in_chinese(tmp_path: Path) -> None:
    root = drawn(tmp_path, "--velocities", "C", "--lang", "zh")
    assert any(re.search("[\u4e00-\u9fff]", text) for text in texts(root))


def test_png_and_pdf(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    pytest.importorskip("resvg_py")
    assert main(["draw", CRUSHER, "--output", str(tmp_path / "a.png"), "--width", "300"]) == 0
    with image.open(tmp_path / "a.png") as picture:
        assert picture.width == 300
        corners = {picture.convert("RGB").getpixel((x, y)) for x in (0, 299) for y in (0, picture.height - 1)}
    assert corners == {(255, 255, 255)}
    pytest.importorskip("typst")
    assert main(["draw", CRUSHER, "--output", str(tmp_path / "a.pdf")]) == 0
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--paths", "Cc"], 'did you mean "C"'),
        (["--velocities", "Q"], '--velocities: there is no point "Q"'),
        (["--dimensions", "jam"], 'did you mean "jaw"'),
        (["--dimensions", "O1:Q"], 'no point "Q"'),
        (["--forces", "Q"], 'no joint "Q"'),
        (["--overlay", "limits:jam"], 'did you mean "jaw"'),
        (["--at", "30"], "has no unit"),
        (["--at", "30 deg, 40 deg"], "more than one value"),
        (["--at", "1 deg", "--time", "1 s"], "--time"),
        (["--labels", "some"], "points"),
        (["--steps", "0"], "--steps"),
    ],
)
def test_wrong_usage(
    options: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["draw", CRUSHER, *options, "--output", str(tmp_path / "a.svg")]) == 2
    assert words in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_wrong_targets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "a.svg"
    target.write_text("mine", encoding="utf-8")
    assert main(["draw", CRUSHER, "--output", str(target)]) == 2
    assert target.read_text(encoding="utf-8") == "mine"
    assert main(["draw", CRUSHER, "--output", str(tmp_path / "a.bmp")]) == 2
    assert main(["draw", CRUSHER, "--output", str(tmp_path / "no" / "a.svg")]) == 2
    assert main(["draw", CRUSHER]) == 2
    shown = capsys.readouterr().err
    assert "--force" in shown and ".svg, .png, .pdf" in shown and "create it first" in shown
    assert "--output" in shown
    assert main(["draw", CRUSHER, "--output", str(target), "--force"]) == 0
    assert target.read_text(encoding="utf-8").startswith("<svg")


def test_position_out_of_reach(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK, encoding="utf-8")
    target = tmp_path / "a.svg"
    assert main(["draw", str(model), "--at", "170 deg", "--output", str(target)]) == 1
    assert not target.exists()
    assert main(["draw", str(model), "--output", str(target)]) == 0
    assert "positions cannot be reached" in capsys.readouterr().err


def test_json_names_the_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "a.svg"
    assert main(["draw", CRUSHER, "--output", str(target), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"ok": True, "written": str(target)}


def test_missing_package_is_named_with_its_remedy(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "resvg_py", None)
    assert main(["draw", CRUSHER, "--output", str(tmp_path / "a.png")]) == 1
    assert 'pip install "linkwright[plot]"' in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
