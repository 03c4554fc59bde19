"""Cams that keep an output constant in a zone."""

from __future__ import annotations

import csv
import json
import math
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.cli import main

#: The zone of impression in values of the motor's angle, deg: 176.5468° to 289.9133° of the driving shaft.
ZONE = (-882.734, -1449.5665)

#: A ram moved by a crank-driven slide and by a lever on a cam: the lever's angle counts by its cosine.
LEVER = """
format: 1
name: Ram on a lever
frame: {points: {O: [0 mm, 0 mm], P: [-90 mm, 0 mm], C: [0 mm, 150 mm]}}
links:
  shaft: {points: {O: [0 mm, 0 mm], A: [20 mm, 0 mm]}}
  rod: {points: [A, F], length: 140 mm}
  slide: {points: [F]}
  lever: {points: {P: [0 mm, 0 mm], R: [90 mm, 0 mm], T: [60 mm, 30 mm]}}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: slide, at: F}
  cam: {kind: cam, cam: shaft, follower: lever, at: R, touch: roller, roller_radius: 10 mm, base_radius: 40 mm,
        side: left, program: [{rise: 8 deg, over: 120 deg}, {fall: 8 deg, over: 120 deg}, {dwell: 120 deg}]}
assembly: {F: forward}
driver: {turn: shaft, about: O, speed: 60 rpm}
outputs: {height: guide + T.y}
"""


def test_the_cam_in_the_file_is_found_again() -> None:
    press = store.machine("printing_press")
    zone = math.radians(ZONE[0]), math.radians(ZONE[1])
    found = lw.compensating_cam(press, "lead", zone=zone)
    cam = press.joints["compensating_cam"]
    assert found.angles == pytest.approx(np.array(cam.angles), abs=3e-8)
    assert found.lifts == pytest.approx(np.array(cam.lifts), abs=2e-7)
    assert 1e3 * found.before == pytest.approx(2.201 + 1.397, abs=0.1)  # of the ten printed differences
    assert 1e3 * found.after < 1e-6
    assert found.joint == "compensating_cam"


def test_a_lift_that_counts_unevenly_is_corrected() -> None:
    """The lever's point rises by 60 sin + 30 cos of its angle, so that one division would leave something."""
    machine = lw.loads(LEVER)
    found = lw.compensating_cam(machine, "height", zone=(math.radians(60), math.radians(110)))
    motion = lw.solve_motion(found.mechanism, steps=3600)
    inside = (motion.input >= math.radians(60)) & (motion.input <= math.radians(110))
    height = motion.joint("guide").displacement + motion.point("lever.T").position[:, 1]
    assert np.ptp(height[inside]) < 1e-7
    assert found.before > 1e-3


def test_the_zone_chosen_is_the_quietest() -> None:
    press, span = store.machine("printing_press"), math.radians(500)
    found = lw.compensating_cam(press, "lead", span=span)
    assert abs(found.zone[1] - found.zone[0]) == pytest.approx(span, rel=1e-2)
    for shift in (-1.5, 1.5):
        beside = lw.compensating_cam(press, "lead", zone=(found.zone[0] + shift, found.zone[1] + shift))
        assert beside.before > found.before


def test_the_command_writes_the_model_and_the_table(tmp_path: Path) -> None:
    model, table = tmp_path / "press.yaml", tmp_path / "lift.csv"
    zone = f"{ZONE[0]}..{ZONE[1]} deg"
    with redirect_stdout(StringIO()) as told:
        command = ["compensate", "gallery:printing_press", "lead", "--zone", zone]
        assert main([*command, "--output", str(model)]) == 0
        assert main([*command, "--output", str(table), "--json"]) == 0
    data = json.loads(told.getvalue()[told.getvalue().index("{\n") :])
    assert data["after"] < 1e-9
    again = lw.load(model)
    assert again.joints["compensating_cam"].lifts == pytest.approx(data["lifts"], abs=1e-12)
    with table.open(encoding="utf-8") as stream:
        _, *rows = csv.reader(stream)
    assert len(rows) == len(data["lifts"])
    assert float(rows[3][1]) == pytest.approx(1e3 * data["lifts"][3])


def test_what_cannot_be_kept_constant_is_refused() -> None:
    press = store.machine("printing_press")
    zone = math.radians(ZONE[0]), math.radians(ZONE[1])
    with refused("cams.compensation_no_effect", output="shaft_2"):
        lw.compensating_cam(press, "shaft_2", zone=zone)
    with refused("cams.zone_or_span"):
        lw.compensating_cam(press, "lead")
    with refused("cams.compensation_zone"):
        lw.compensating_cam(press, "lead", zone=(0.0, -31.0))
    with refused("cams.compensated_output", name="driver.effort"):
        lw.compensating_cam(press, "driver.effort", zone=zone)
    with refused("cams.which_cam_joint", name="lobe"):
        lw.compensating_cam(press, "lead", joint="lobe", zone=zone)
    with refused("cams.no_cam_joint"):
        lw.compensating_cam(store.machine("crank_rocker"), "rocker", zone=(0.1, 0.2))
    assert main(["compensate", "gallery:printing_press", "lead", "--zone", "3 deg"]) == 2
