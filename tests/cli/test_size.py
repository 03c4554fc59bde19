"""``linkwright size``: sizes of links and pins, and the model file with them."""

import json
from pathlib import Path

import pytest
from tests.cli.commands import data, shown

import linkwright as lw
from linkwright.cli import main

LIFT = """\
format: 1
name: Lift  # a comment
frame: {points: {O: [0 mm, 0 mm]}}
links:
  arm: {points: [O, P], length: 250 mm}  # welded
driver: {turn: arm, about: O, speed: 1 rad/s}
loads: {weight: {kind: force, on: arm, at: P, direction: -90 deg, magnitude: 400 N}}
"""
AS_DATA = {
    "format": 1,
    "name": "Lift",
    "frame": {"points": {"O": [0, 0]}},
    "links": {"arm": {"points": ["O", "P"], "length": "250 mm"}},
    "driver": {"turn": "arm", "about": "O", "speed": "1 rad/s"},
    "loads": {"weight": {"kind": "force", "on": "arm", "at": "P", "direction": "-90 deg", "magnitude": "400 N"}},
}
MORE = """\
joints:
  O: {kind: revolute, friction: 0}
construction: {safety: 3}
"""


@pytest.fixture
def lift(tmp_path: Path) -> Path:
    path = tmp_path / "lift.yaml"
    path.write_text(LIFT)
    return path


def test_sizes_as_data(lift: Path) -> None:
    """F = 400 N in a plate of 8 mm with 10 MPa: d = 5 mm; M = 100 N·m."""
    found = data("size", str(lift), "--thickness", "8mm", "--pressure", "10MPa")
    assert found["pins"]["O"]["needed"]["pressure"] == pytest.approx(0.005)
    assert found["links"]["arm"]["moment"] == pytest.approx(100.0)


def test_the_way_is_printed(lift: Path) -> None:
    text = shown("size", str(lift), "--material", "aluminium", "--safety", "3", "--worked")
    assert "Re = 240 MPa" in text
    assert "Safety factor 3" in text
    assert "M     = F_1·l_1" in text


@pytest.mark.parametrize("more", ["", MORE])
def test_sizes_are_written_into_the_file(lift: Path, tmp_path: Path, more: str) -> None:
    lift.write_text(LIFT + more)
    path = tmp_path / "sized.yaml"
    assert main(["size", str(lift), "--material", "brass", "--output", str(path)]) == 0
    text = path.read_text()
    assert LIFT.splitlines()[-2:] == [line for line in text.splitlines() if line.startswith(("driver", "loads"))]
    assert "name: Lift  # a comment\n" in text
    assert "}  # welded\n" in text
    before, after = lw.size_links(lw.load(lift), material="brass"), lw.load(path)
    assert after.construction is not None and after.construction.material.name == "brass"
    assert after.construction.safety == (3.0 if more else 2.0)
    assert after.construction.thickness == pytest.approx(before.plate)
    assert after.pins["O"].pin_radius == pytest.approx(0.5 * before.pins["O"].diameter)
    again = lw.size_links(after)
    assert again.links["arm"].given and again.links["arm"].width == pytest.approx(before.links["arm"].width)
    assert again.notes == ()
    assert lw.size_links(lw.loads(before.model_text())).links["arm"].width == again.links["arm"].width


def test_a_json_file_stays_json(tmp_path: Path) -> None:
    source, path = tmp_path / "lift.json", tmp_path / "sized.yaml"
    source.write_text(json.dumps(AS_DATA))
    assert main(["size", str(source), "--output", str(path)]) == 0
    found = json.loads(path.read_text())
    assert found["links"]["arm"]["shape"] == {"width": "35 mm"}
    assert found["joints"]["O"] == {"kind": "revolute", "pin_radius": "5 mm"}


def test_no_forces(lift: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lift.write_text(LIFT.partition("loads:")[0])
    assert main(["size", str(lift)]) != 0
    assert "neither loads nor masses" in capsys.readouterr().err
