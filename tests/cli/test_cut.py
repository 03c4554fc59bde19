"""``linkwright cut``: its files, all of them or none, never over others."""

import csv
import json
from pathlib import Path

import ezdxf
import pytest
from tests.cli.commands import run

MODEL = """\
format: 1
name: four-bar
frame: {points: {O: [0 mm, 0 mm], Q: [80 mm, 0 mm]}}
links:
  曲柄: {points: [O, A], length: 25 mm}
  coupler: {points: [A, B], length: 70 mm}
  rocker: {points: [Q, B], length: 50 mm}
driver: {turn: 曲柄, about: O, speed: 60 rpm}
drawing: {A: [0 mm, 25 mm], B: [65 mm, 48 mm]}
construction: {material: acrylic, thickness: 3 mm, width: 12 mm, pin_radius: 2 mm, washer: 0.5 mm, fit: 0.2 mm}
"""
PLATES = ("frame", "曲柄", "coupler", "rocker")


@pytest.fixture
def model(tmp_path: Path) -> str:
    path = tmp_path / "four.yaml"
    path.write_text(MODEL, encoding="utf-8")
    return str(path)


def test_all_files_are_written_once(model: str, tmp_path: Path) -> None:
    folder = tmp_path / "parts"
    found = run("cut", model, "--output", str(folder), "--json")
    assert found.code == 0
    data = json.loads(found.out)
    assert {Path(each).name for each in data["files"]} == {each.name for each in folder.iterdir()}
    drawings = {f"{plate}.{form}" for plate in PLATES for form in ("dxf", "svg")}
    sheets = {"sheet-1-acrylic-3mm.dxf", "sheet-1-acrylic-3mm.svg"}
    assert {each.name for each in folder.iterdir()} == {*drawings, *sheets, "parts.csv", "parts.xlsx"}
    kept = (folder / "coupler.dxf").read_bytes()
    (folder / "rocker.dxf").unlink()
    again = run("cut", model, "--output", str(folder), "--kerf", "0.2 mm")
    assert again.code == 2 and "--force" in again.err
    assert not (folder / "rocker.dxf").exists() and (folder / "coupler.dxf").read_bytes() == kept
    assert run("cut", model, "--output", str(folder), "--kerf", "0.2 mm", "--force").code == 0
    assert (folder / "rocker.dxf").exists() and (folder / "coupler.dxf").read_bytes() != kept


def test_holes_are_pressed_or_run_and_the_kerf_is_halved(model: str, tmp_path: Path) -> None:
    """A pin of 4 mm is pressed into its lowest plate and turns in 4.2 mm in the other; a kerf of 0.3 mm takes as much
    off each diameter, and adds it to the width of the bars."""
    folder = tmp_path / "parts"
    assert run("cut", model, "--output", str(folder), "--kerf", "0.3mm", "--format", "dxf").code == 0
    assert not [*folder.glob("*.svg")]
    sizes: dict[str, list[float]] = {}
    for plate in PLATES:
        space = ezdxf.readfile(folder / f"{plate}.dxf").modelspace()
        sizes[plate] = sorted(round(2 * each.dxf.radius, 9) for each in space.query("CIRCLE"))
        (outline,) = space.query('LWPOLYLINE[layer=="cut"]')
        bulges = [bulge for _x, _y, bulge in outline.get_points("xyb") if bulge]
        assert bulges == pytest.approx([1.0, 1.0])
        ys = [y for _x, y, _bulge in outline.get_points("xyb")]
        assert max(ys) - min(ys) == pytest.approx(12.3)
    assert sizes["frame"][-2:] == [3.7, 3.7]
    assert sorted(size for plate in PLATES[1:] for size in sizes[plate]) == [3.7, 3.7, 3.9, 3.9, 3.9, 3.9]


def test_the_list_is_in_the_language_of_the_reader(model: str, tmp_path: Path) -> None:
    folder = tmp_path / "parts"
    assert run("cut", model, "--output", str(folder), "--lang", "zh", "--format", "svg").code == 0
    head, *rows = csv.reader((folder / "parts.csv").read_text("utf-8").splitlines())
    assert head[1:4] == ["零件", "数量", "尺寸 / mm"]
    assert rows[0][1] == "底板" and rows[0][4] == "亚克力（PMMA）" and "曲柄" in [row[1] for row in rows]


@pytest.mark.parametrize(
    ("options", "code"),
    [
        (("--sheet", "60x40"), "cut.no_room"),
        (("--sheet", "60"), "syntax"),
        (("--kerf", "5 mm"), "cut.kerf"),
        (("--kerf=-1 mm",), "range"),
    ],
)
def test_what_cannot_be_cut_writes_nothing(model: str, tmp_path: Path, options: tuple[str, ...], code: str) -> None:
    found = run("cut", model, "--output", str(tmp_path / "parts"), *options)
    assert found.code == 2 and found.told is not None and found.told.code == code
    assert not (tmp_path / "parts").exists()


def test_a_machine_without_layers_has_no_parts() -> None:
    found = run("cut", "gallery:jaw_crusher_fourbar")
    assert found.code == 1 and "pin A" in found.err
