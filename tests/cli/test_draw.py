"""``linkwright draw``: pictures by their endings, choices, refusals, whole files."""

import math
import re
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, run
from tests.cli.machines import STUCK, out_of_reach
from tests.cli.tables import numbers

from linkwright.cli import main

CRUSHER = "gallery:jaw_crusher_sixbar"
SVG = "{http://www.w3.org/2000/svg}"


def drawn(tmp_path: Path, *options: str, model: str = CRUSHER) -> ET.Element:
    target = tmp_path / "out.svg"
    assert main(["draw", model, *options, "--output", str(target), "--force"]) == 0
    return ET.parse(target).getroot()


def styles(root: ET.Element) -> list[str]:
    return [word for e in root.iter() for word in e.get("class", "").split()]


def texts(root: ET.Element) -> set[str]:
    return {"".join(e.itertext()) for e in root.iter(f"{SVG}text")}


def test_positions_out_of_reach_are_told_in_the_language_asked_for(tmp_path: Path) -> None:
    """With the same numbers: how many, of how many, and by how much the first one is out of reach."""
    model = tmp_path / "stuck.yaml"
    model.write_text(STUCK, encoding="utf-8")
    english, chinese = (
        run("draw", str(model), "--output", str(tmp_path / f"{language}.svg"), "--lang", language)
        for language in ("en", "zh")
    )
    assert english.code == chinese.code == 0
    left_out, positions, *_ = numbers(english.err)
    assert left_out == out_of_reach(int(positions))
    assert sorted(numbers(chinese.err)) == sorted(numbers(english.err))
    assert re.search("[\u4e00-\u9fff]", chinese.err) and not re.search("[a-z]{3,} [a-z]{2,}", chinese.err)


def test_drawing_shows_what_is_asked_for(tmp_path: Path) -> None:
    root = drawn(tmp_path, "--at", "30 deg", "--overlay", "limits", "--paths", "C,jaw.D", "--velocities", "--centres")
    found = styles(root)
    assert found.count("lw-pin") == 6 + 2 * 3  # A, B, C in both limit positions
    assert found.count("lw-trace") == 2
    assert found.count("lw-mass-ring") == 4
    assert {"lw-velocity-line", "lw-dashed"} <= set(found)
    assert not {"lw-acceleration-line", "lw-force-line", "lw-dimension"} & set(found)


def test_forces_dimensions_labels_inputs(tmp_path: Path) -> None:
    root = drawn(tmp_path, "--forces", "O5", "--dimensions", "pitman", "O1:O3", "--labels", "points", "--no-inputs")
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
    ("options", "code", "values"),
    [
        (["--paths", "Cc"], "names.no_such", {"name": "--paths", "noun": "point", "offer": "C"}),
        (["--velocities", "Q"], "names.no_such", {"name": "--velocities", "noun": "point"}),
        (["--dimensions", "jam"], "names.no_such", {"noun": "link", "offer": "jaw"}),
        (["--dimensions", "O1:Q"], "names.no_such", {"noun": "point"}),
        (["--forces", "Q"], "names.no_such", {"name": "--forces", "noun": "joint"}),
        (["--overlay", "limits:jam"], "study.no_such_output", {"name": "--overlay", "offer": "jaw"}),
        (["--at", "30"], "missing-unit", {"name": "--at", "text": "30"}),
        (["--at", "30 deg, 40 deg"], "draw.one_position", {"option": "--at"}),
        (["--at", "1 deg", "--time", "1 s"], "cli.not_together", {"name": "--time", "other": "--at"}),
        (["--labels", "some"], "cli.bad_choice", {"choices": {"all", "points", "none"}}),
        (["--steps", "0"], "range", {"text": "0"}),
    ],
)
def test_wrong_usage(options: list[str], code: str, values: dict[str, object], tmp_path: Path) -> None:
    is_refused(["draw", CRUSHER, *options, "--output", str(tmp_path / "a.svg")], code, **values)
    assert list(tmp_path.iterdir()) == []


def test_wrong_targets(tmp_path: Path) -> None:
    target, folder = tmp_path / "a.svg", tmp_path / "no"
    target.write_text("mine", encoding="utf-8")
    is_refused(["draw", CRUSHER, "--output", str(target)], "file.exists", path=target, remedy="--force")
    assert target.read_text(encoding="utf-8") == "mine"
    bitmap = ["draw", CRUSHER, "--output", str(tmp_path / "a.bmp")]
    is_refused(bitmap, "cli.bad_suffix", endings={".svg", ".png", ".pdf"})
    is_refused(["draw", CRUSHER, "--output", str(folder / "a.svg")], "file.no_folder", path=folder)
    is_refused(["draw", CRUSHER], "cli.missing", names={"--output"})
    assert main(["draw", CRUSHER, "--output", str(target), "--force"]) == 0
    assert target.read_text(encoding="utf-8").startswith("<svg")


def test_a_position_out_of_reach_is_not_drawn(tmp_path: Path) -> None:
    """The pins are 2.8906 m apart, both links together 2.7 m long."""
    model, target = tmp_path / "stuck.yaml", tmp_path / "a.svg"
    model.write_text(STUCK, encoding="utf-8")
    apart = math.sqrt(0.9**2 + 2**2 - 2 * 0.9 * 2 * math.cos(math.radians(170)))
    asked = ["draw", str(model), "--at", "170 deg", "--output", str(target)]
    told = is_refused(asked, "picture.the_position", ends=1, links={"coupler", "rocker"})
    assert float(str(told.values["distance"]).split()[0]) == pytest.approx(1e3 * apart, rel=1e-6)
    assert not target.exists()


def test_json_names_the_file(tmp_path: Path) -> None:
    target = tmp_path / "a.svg"
    assert data("draw", CRUSHER, "--output", str(target)) == {"ok": True, "written": str(target)}


def test_missing_package_is_named_with_its_remedy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    told = is_refused(["draw", CRUSHER, "--output", str(tmp_path / "a.png")], "picture.png_needs", ends=1)
    assert "linkwright[plot]" in str(told)
    assert list(tmp_path.iterdir()) == []
