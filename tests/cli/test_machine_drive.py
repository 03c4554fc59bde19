"""``linkwright machine`` about actuators: does it start, what has its motor to do, which motor, how is it braked."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, run, shown

HOIST = """
format: 1
name: Hoist
frame: {points: {O: [0 mm, 0 mm]}}
links: {drum: {points: [O, P], length: 100 mm, inertia: 2 kg·m²}}
driver: {turn: drum, about: O, speed: 20 rad/s}
actuators: {motor: {kind: dc, on: drum, ratio: 10, stall_torque: 3 N·m, no_load_speed: 250 rad/s}}
loads: {rope: {kind: torque, on: drum, magnitude: -6 N·m}}
"""


@pytest.fixture
def hoist(tmp_path: Path) -> str:
    path = tmp_path / "hoist.yaml"
    path.write_text(HOIST, "utf-8")
    return str(path)


def test_whether_it_starts(hoist: str, tmp_path: Path) -> None:
    """30 N·m at rest against 6 N·m."""
    found = data("machine", hoist, "--start")
    assert found["starting_margin"]["value"] == pytest.approx(5.0, rel=1e-9)
    assert "starts from every position" in shown("machine", hoist, "--start", "--plot", str(tmp_path / "start.svg"))
    weak = tmp_path / "weak.yaml"
    weak.write_text(HOIST.replace("stall_torque: 3 N·m", "stall_torque: 0.5 N·m"), "utf-8")
    assert data("machine", str(weak), "--start", code=1)["missing"]["value"] == pytest.approx(1.0, rel=1e-9)


def test_what_the_motor_has_to_do(hoist: str, tmp_path: Path) -> None:
    found = data("machine", hoist, "--duty")
    assert found["rms_torque"]["value"] == pytest.approx(0.6, rel=1e-6)
    picture = tmp_path / "duty.svg"
    shown("machine", hoist, "--duty", "--plot", str(picture))
    assert "<svg" in picture.read_text("utf-8")


def test_the_smallest_motor_of_a_catalogue(hoist: str, tmp_path: Path) -> None:
    """By 0.9·3000 rpm over 20 rad/s the rope takes 0.424 N·m of the motor: the second has 0.45 N·m."""
    catalogue = tmp_path / "servos.csv"
    head = "name,kind,continuous,peak,largest_speed,inertia\n"
    rows = [f"S{k},servo,{c} N·m,{3 * c:.1f} N·m,3000 rpm,1e-4 kg·m²\n" for k, c in enumerate((0.1, 0.45, 0.7))]
    catalogue.write_text(head + "".join(rows), "utf-8")
    found = data("machine", hoist, "--catalogue", str(catalogue))
    assert found["best"] == "S1"
    assert [each["suffices"] for each in found["candidates"]] == [False, True, False]
    weak = data("machine", hoist, "--catalogue", str(catalogue), "--margin", "40", code=1)
    assert weak["best"] is None


def test_how_it_is_braked(hoist: str) -> None:
    """The rope brakes with 6 N·m, and 14 more: J ω/T = 2 s and J ω²/(2 T) = 20 rad."""
    found = data("machine", hoist, "--brake", "14 N·m")
    assert found["longest"]["value"] == pytest.approx(2.0, rel=1e-9)
    assert found["farthest"]["value"] == pytest.approx(20.0, rel=1e-9)


def test_what_is_refused(hoist: str, tmp_path: Path) -> None:
    is_refused(["machine", "--start"], "machine.question_needs_file")
    is_refused(["machine", hoist, "--plot", str(tmp_path / "x.svg")], "machine.plot_of_nothing")
    assert run("machine", hoist, "--start", "--duty").code == 2
    bad = tmp_path / "bad.yaml"
    bad.write_text("motors: {A: {kind: brake, torque: 2 N·m}, B: {kind: dc, stall_torque: 3 N·m}}", "utf-8")
    ended = run("machine", hoist, "--catalogue", str(bad))
    assert ended.code != 0
    assert "is no motor" in ended.err + ended.out and "no_load_speed" in ended.err + ended.out
