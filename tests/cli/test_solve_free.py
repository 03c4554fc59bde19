"""``linkwright solve --free``: a machine let go, its accelerations and reactions."""

import csv
from math import cos, radians
from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, shown

ROD = """\
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {rod: {points: [O, A], length: 1.2 m, mass: 3 kg, inertia: 0.36 kg·m²}}
driver: {turn: rod, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
"""
BLOCK = """\
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {block: {points: [B], mass: 2 kg}}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 30 deg, block: block, at: B, friction: 0.7}}
driver: {slide: guide, speed: 1 m/s}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""


@pytest.fixture
def rod(tmp_path: Path) -> str:
    path = tmp_path / "rod.yaml"
    path.write_text(ROD, "utf-8")
    return str(path)


def test_a_rod_is_let_go_at_several_positions(rod: str) -> None:
    found = data("solve", rod, "--free", "--at", "0 deg, 30 deg, 60 deg")
    expected = [-1.5 * 9.81 * cos(radians(angle)) / 1.2 for angle in (0, 30, 60)]
    assert found["columns"]["rod.angular_acceleration [rad/s²]"] == pytest.approx(expected, rel=1e-12)
    assert found["columns"]["O on rod.y [N]"][0] == pytest.approx(3 * 9.81 / 4, rel=1e-12)
    assert [each["outcome"] for each in found["released"]] == ["moves"] * 3
    text = shown("solve", rod, "--free", "--at", "0 deg, 30 deg, 60 deg")
    assert "-12.2625 rad/s²" in text
    assert "1.44 kg·m²" in text
    assert "driver: " not in text


def test_it_is_let_go_with_a_rate(rod: str) -> None:
    found = data("solve", rod, "--free", "--speed", "60 rpm")
    assert found["columns"]["rod.angular_velocity [rad/s]"] == pytest.approx([6.283185307179586])
    assert found["columns"]["O on rod.x [N]"] == pytest.approx([-3 * 0.6 * 6.283185307179586**2])


def test_sticking_is_told(tmp_path: Path) -> None:
    path = tmp_path / "block.yaml"
    path.write_text(BLOCK, "utf-8")
    assert "82.5 %" in shown("solve", str(path), "--free")
    assert data("solve", str(path), "--free")["released"][0]["outcome"] == "sticks"
    assert "摩擦自持" in shown("solve", str(path), "--free", "--lang", "zh")


def test_worked_solution_and_files(rod: str, tmp_path: Path) -> None:
    page = shown("solve", rod, "--free", "--worked")
    assert "M_1 = m1·(ν_G1x² + ν_G1y²) + J1·i1² = 3·(0² + 0.6²) + 0.36·1² = 1.44000 kg·m²" in page
    assert "q'' = Q/M = (-17.658)/1.44 = -12.2625 rad/s²" in page
    assert "等效惯量" in shown("solve", rod, "--free", "--worked", "--lang", "zh")
    assert len(data("solve", rod, "--free", "--worked")["worked"]) == 1
    path = tmp_path / "out.csv"
    shown("solve", rod, "--free", "--output", str(path))
    (row,) = csv.DictReader(path.read_text("utf-8").splitlines())
    assert float(row["rod.angular_acceleration [rad/s²]"]) == pytest.approx(-12.2625, rel=1e-12)


def test_what_does_not_go_with_it_is_refused(rod: str) -> None:
    is_refused(["solve", rod, "--free", "--static"], "cli.not_together")
    is_refused(["solve", rod, "--speed", "2 rad/s"], "solve.speed")
    is_refused(["solve", rod, "--free", "--speed", "crank=2 rad/s"], "solve.no_driver")
    is_refused(["solve", rod, "--free", "--speed", "2 m"], "wrong-dimension")
