"""``linkwright run``: motion under forces on the command line."""

import csv
import json
import math
from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, run, shown

ROD = """\
format: 1
name: Rod on a pin that rubs
frame: {points: {O: [0 m, 0 m]}}
links: {rod: {points: [O, A], length: 1 m, mass: 3 kg, inertia: 0.25 kg·m²}}
joints: {O: {kind: revolute, pin_radius: 20 mm, friction: 0.2}}
driver: {turn: rod, about: O, speed: 1 rad/s, start: 0 deg}
gravity: [0, -9.81 m/s²]
"""
WHEEL = """\
format: 1
name: Wheel with a motor
frame: {points: {O: [0 m, 0 m]}}
links: {wheel: {points: [O, A], length: 1 m, mass: 2 kg, mass_centre: [0 m, 0 m], inertia: 0.5 kg·m²}}
driver: {turn: wheel, about: O, speed: 20 rad/s}
actuators: {motor: {kind: constant, on: wheel, torque: 3 N·m}}
loads: {loss: {kind: torsion_damper, links: [frame, wheel], damping: 0.1 N·m·s/rad}}
run: {for: 4 s, speed: 1 rad/s}
"""


@pytest.fixture
def rod(tmp_path: Path) -> str:
    path = tmp_path / "rod.yaml"
    path.write_text(ROD, "utf-8")
    return str(path)


@pytest.fixture
def wheel(tmp_path: Path) -> str:
    path = tmp_path / "wheel.yaml"
    path.write_text(WHEEL, "utf-8")
    return str(path)


def speed(time: float, begin: float) -> float:
    """Of the wheel: 30 rad/s is reached in the long run, the time constant is 5 s."""
    return 30.0 + (begin - 30.0) * math.exp(-time / 5.0)


def test_a_wheel_runs_up(wheel: str) -> None:
    found = data("run", wheel, "--steps", "4")
    assert found["columns"]["time [s]"] == pytest.approx([0, 1, 2, 3, 4])
    expected = [speed(time, 1.0) for time in range(5)]
    assert found["columns"]["wheel.angular_velocity [rad/s]"] == pytest.approx(expected, rel=1e-8)
    assert found["end_state"]["driver"]["rate"] == pytest.approx(speed(4.0, 1.0), rel=1e-8)
    assert found["energy_residual [J]"] < 1e-7
    assert found["ok"] and found["reason"] == "the time is over"


def test_options_go_before_the_file(wheel: str) -> None:
    found = data("run", wheel, "--for", "2s", "--from", "rest", "--at", "30 deg")
    assert found["end [s]"] == 2.0
    assert found["columns"]["driver [rad]"][0] == pytest.approx(math.pi / 6)
    assert found["end_state"]["driver"]["rate"] == pytest.approx(speed(2.0, 0.0), rel=1e-8)
    assert data("run", wheel, "--speed", "60 rpm")["end_state"]["driver"]["rate"] == pytest.approx(
        speed(4.0, 2 * math.pi), rel=1e-8
    )
    turned = data("run", wheel, "--turns", "2")
    assert turned["columns"]["driver [rad]"][-1] == pytest.approx(4 * math.pi)
    assert turned["events"][-1]["kind"] == "turns"


def test_what_happened_is_told(rod: str) -> None:
    text = shown("run", rod, "--for", "2s", "--steps", "10")
    assert "0.962364 s  at rest for a moment, or reversal  driver = -177.716°" in text
    assert "energy missing at most" in text
    assert "time is over" in text
    assert "Largest joint forces" in text
    assert "发生了什么" in shown("run", rod, "--for", "2s", "--lang", "zh")


def test_files(rod: str, tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("out.csv", "curves.svg", "moving.svg")]
    shown(
        *("run", rod, "--for", "1s", "--steps", "5"),
        *("--output", str(paths[0]), "--plot", str(paths[1]), "--animate", str(paths[2])),
    )
    rows = list(csv.DictReader(paths[0].read_text("utf-8").splitlines()))
    assert [float(row["time [s]"]) for row in rows] == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1.0])
    kinetic = 0.5 * float(rows[-1]["rod.angular_velocity [rad/s]"]) ** 2
    assert float(rows[-1]["work [J]"]) == pytest.approx(kinetic, rel=1e-8)
    assert "time" in paths[1].read_text("utf-8")
    assert "<animate" in paths[2].read_text("utf-8")
    sheet = tmp_path / "out.json"
    shown("run", rod, "--for", "1s", "--output", str(sheet))
    assert json.loads(sheet.read_text("utf-8"))["end [s]"] == 1.0


def test_many_designs_run_side_by_side(wheel: str, tmp_path: Path) -> None:
    path = tmp_path / "runs.csv"
    shown("run", wheel, "--vary", "actuators.motor.torque=2..4N·m:3", "--output", str(path))
    rows = list(csv.DictReader(path.read_text("utf-8").splitlines()))
    found = [float(row["driver.rate"]) for row in rows]
    expected = [10 * torque + (1 - 10 * torque) * math.exp(-0.8) for torque in (2, 3, 4)]
    assert found == pytest.approx(expected, rel=1e-7)
    assert data("run", wheel, "--vary", "wheel.inertia=0.5, 1 kg·m²")["outcomes"] == ["ended", "ended"]
    is_refused(["run", wheel, "--vary", "wheel.inertia=0.5, 1 kg·m²", "--stiff"], "cli.not_together")


def test_what_is_not_reached_is_told(wheel: str) -> None:
    ended = run("run", wheel, "--until", "rest", "--at-most", "1s")
    assert ended.code == 1
    assert "not at rest after 1 s" in ended.out


def test_what_cannot_be_is_refused(rod: str) -> None:
    is_refused(["run", rod, "--for", "1s", "--turns", "2"], "cli.not_together")
    is_refused(["run", rod, "--for", "1s", "--at-most", "2s"], "cli.not_together")
    is_refused(["run", rod, "--speed", "2 m/s"], "wrong-dimension")
    is_refused(["run", rod, "--at", "crank=2 deg"], "solve.no_driver")
    is_refused(["run", rod, "--plot", "curves.txt"], "cli.bad_suffix")


def test_reports_have_the_run(wheel: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    shown("report", wheel, "--sections", "run", "--to", "html", "--output", str(path))
    text = path.read_text("utf-8")
    assert "How the run ends" in text
    assert "the time is over" in text
