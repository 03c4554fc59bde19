"""Summaries of a sweep are those of its positions, and it says how far the ones between them are away."""

import json
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.cli import main

#: A crank that lifts a weight, of which a press takes part from 42° on, between two of 36 positions.
PRESS = """
format: 1
name: press
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.2 m}}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {press: {kind: force, on: crank, at: A, direction: -90 deg, magnitude: 500 N,
  phase: {input: [42 deg, 170 deg]}}}
"""
#: One that acts all the time.
LIFTED = PRESS.replace(",\n  phase: {input: [42 deg, 170 deg]}", "")
LENGTHS = np.array([0.1, 0.2])


def torque(degrees: float) -> float:
    return 500.0 * 0.2 * float(np.cos(np.radians(degrees)))


def test_a_sweep_says_how_far_its_peaks_are_from_those_between_positions() -> None:
    found = lw.sweep(
        lw.loads(PRESS),
        {"crank.length": LENGTHS},
        outputs=["driver.effort max", "peak_input_torque"],
        steps=36,
    )
    assert found["driver.effort max"][1] == pytest.approx(torque(50.0), rel=1e-12)
    assert found["peak_input_torque"][1] == pytest.approx(-torque(170.0), rel=1e-9)
    (note,) = found.notes
    share = (torque(42.0) - torque(50.0)) / max(abs(torque(each)) for each in range(50, 171, 10))
    assert (note.code, note.values["steps"]) == ("study.of_positions_off", 36)
    for number in (f"{torque(50.0):.6g} N·m", f"{torque(42.0):.6g} N·m", f"({100.0 * share:.2g} %"):
        assert number in note


def test_a_sweep_of_metrics_alone_has_nothing_to_say() -> None:
    found = lw.sweep(lw.loads(PRESS), {"crank.length": LENGTHS}, outputs=["peak_input_torque"], steps=36)
    assert found.notes == ()


def test_the_note_stands_at_the_place(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine = lw.loads(PRESS)
    study = lw.study(machine, {"crank.length": "0.1..0.2 m:2"}, metrics=["driver.effort max"], steps=36)
    assert study["driver.effort max"][1] == pytest.approx(torque(42.0), rel=1e-9) and not study.notes
    path = tmp_path / "press.yaml"
    path.write_text(PRESS)
    arguments = ["sweep", str(path), "--vary", "crank.length=100..200mm:2", "--numbers", "driver.effort max"]
    arguments += ["--folder", str(tmp_path / "parts"), "--steps", "36"]
    assert main(arguments) == 0
    assert f"{torque(50.0):.6g} N·m" in capsys.readouterr().out
    assert main([*arguments, "--json"]) == 0
    (note,) = json.loads(capsys.readouterr().out)["notes"]
    assert f"{torque(50.0):.6g} N·m" in note
