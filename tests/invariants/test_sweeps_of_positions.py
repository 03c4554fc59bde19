"""Summaries of a sweep are those of its positions, and it says how far the ones between them are away."""

import json
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.designs.designs import sweep_curves

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
    assert (note.key, note.values["steps"]) == ("study.of_positions_off", 36)
    for number in (f"{torque(50.0):.6g} N·m", f"{torque(42.0):.6g} N·m", f"({100.0 * share:.2g} %"):
        assert number in note


def test_speeds_move_what_goes_by_the_time() -> None:
    """A press that swells in time, at positions that a crank reaches sooner or later, or the other way round."""
    machine = lw.loads(LIFTED.replace("500 N", '"500 N*sin(t*3 rad/s)"'))
    rates = np.array([1.0, 0.5, -2.0]) * 2.0 * np.pi
    asked = {"outputs": ["load press max", "driver.effort rms"], "steps": 36}
    found = lw.sweep(machine, {"driver.speed": rates}, **asked)
    ((_, curves),) = sweep_curves(machine, {"driver.speed": rates}, outputs=["driver.effort"], steps=36)
    turn = 2.0 * np.pi * np.arange(36) / 36
    for k, rate in enumerate(rates):
        time = (turn / rate) % (2.0 * np.pi / abs(rate))
        sizes = 500.0 * np.sin(3.0 * time)
        efforts = 0.2 * sizes * np.cos(turn)
        assert found["load press max"][k] == pytest.approx(np.abs(sizes).max(), rel=1e-12)
        assert found["driver.effort rms"][k] == pytest.approx(np.sqrt(np.mean(efforts**2)), rel=1e-12)
        assert curves["driver.effort"][k] == pytest.approx(efforts, abs=1e-10)


def test_designs_without_a_load_have_no_curves() -> None:
    """A root that has no value while the crank of the second design is long."""
    machine = lw.loads(LIFTED.replace("500 N", '"9 N*sqrt((0.25 m - A.y)/(1 m))"'))
    varied = {"crank.length": np.array([0.2, 0.3])}
    ((_, curves),) = sweep_curves(machine, varied, outputs=["driver.effort"], steps=36)
    assert np.isfinite(curves["driver.effort"][0]).all() and np.isnan(curves["driver.effort"][1]).all()
    assert lw.sweep(machine, varied, outputs=["driver.effort rms"], steps=36).ok.tolist() == [True, False]


def test_a_sweep_of_metrics_alone_has_nothing_to_say() -> None:
    found = lw.sweep(lw.loads(PRESS), {"crank.length": LENGTHS}, outputs=["peak_input_torque"], steps=36)
    assert found.notes == ()


def test_the_note_stands_at_the_place(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine = lw.loads(PRESS)
    study = lw.study(machine, {"crank.length": "0.1..0.2 m:2"}, metrics=["driver.effort max"], steps=36)
    assert [note.key for note in study.notes] == ["study.of_positions_off"]
    crushers = ["gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"]
    compared = lw.compare(crushers, metrics=["driver.effort max"], steps=36)
    assert {note.values["cause"].key for note in compared.notes} == {"study.of_positions_off"}
    path = tmp_path / "press.yaml"
    path.write_text(PRESS)
    arguments = ["sweep", str(path), "--vary", "crank.length=100..200mm:2", "--numbers", "driver.effort max"]
    arguments += ["--folder", str(tmp_path / "parts"), "--steps", "36"]
    assert main(arguments) == 0
    assert f"{torque(50.0):.6g} N·m" in capsys.readouterr().out
    assert main([*arguments, "--json"]) == 0
    (note,) = json.loads(capsys.readouterr().out)["notes"]
    assert f"{torque(50.0):.6g} N·m" in note
