"""Parameter studies: what they vary, what they measure, what they leave out."""

from __future__ import annotations

import csv
import io
import json
import re
import sys

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.features.scaled import SCALED
from tests.refusals import refused

import linkwright as lw
from linkwright import study
from linkwright.errors import RequestError


@pytest.mark.parametrize(
    ("address", "given", "values"),
    [
        ("pitman.length", "1.2..1.3 m:11", np.linspace(1.2, 1.3, 11)),
        ("pitman.length", "1200 mm .. 1.3 m : 3", [1.2, 1.25, 1.3]),
        ("jaw.mass", "700, 900 kg", [700.0, 900.0]),
        ("jaw.mass", "700..900 kg", np.linspace(700.0, 900.0, 11)),
        ("jaw.mass", [1.0, 2.0], [1.0, 2.0]),
        ("frame.O3.y", "-1.1..-0.9 m:2", [-1.1, -0.9]),
        ("driver.speed", "-60..60 rpm:2", [-2 * np.pi, 2 * np.pi]),
    ],
)
def test_a_range_is_what_it_says(address: str, given: object, values: list[float]) -> None:
    found = study(store.machine("jaw_crusher_sixbar"), {address: given}, metrics=["B.velocity max"], steps=12)
    assert found[address] == pytest.approx(values, rel=1e-15)


def test_a_grid_has_every_combination_and_closed_form_values() -> None:
    """Transmission angle of a crank-rocker at the frame line; its rocker's swing from the cosine law."""
    machine = store.machine("crank_rocker")
    a, d = machine.dimension("crank.length"), machine.dimension("frame.O2.x")
    found = study(machine, {"coupler.length": "3.1..3.7 m:4", "rocker.length": "2.4..2.8 m:3"})
    b, c = found["coupler.length"], found["rocker.length"]
    assert found.designs == 12 and len({*zip(b.tolist(), c.tolist(), strict=True)}) == 12
    cosines = [(b**2 + c**2 - (d + s * a) ** 2) / (2 * b * c) for s in (1, -1)]
    acute = np.min([np.minimum(np.arccos(x), np.pi - np.arccos(x)) for x in cosines], axis=0)
    assert found["transmission_angle"] == pytest.approx(acute, rel=1e-8)
    ends = [np.arccos((c**2 + d**2 - (b + s * a) ** 2) / (2 * c * d)) for s in (1, -1)]
    assert found["travel"] == pytest.approx(ends[0] - ends[1], rel=1e-9)
    assert found.best("transmission_angle") == int(np.argmax(acute))


def test_numbers_of_a_machine_without_groups_of_its_own() -> None:
    """Wheels of 20 and 40 teeth: at constant speed the input torque is half the load's."""
    found = study(
        store.machine("external_gear_pair"),
        {"loads.work.magnitude": "20..60 N·m:3"},
        metrics=["peak_input_torque"],
        steps=24,
    )
    assert np.abs(found["peak_input_torque"]) == pytest.approx([10.0, 20.0, 30.0], rel=1e-12)


def test_designs_that_cannot_turn_are_counted_and_the_others_go_on() -> None:
    machine = store.machine("crank_rocker")
    a, c, d = (machine.dimension(name) for name in ("crank.length", "rocker.length", "frame.O2.x"))
    found = study(machine, {"coupler.length": "1.013..7 m:40"}, metrics=["travel", "B.velocity max"])
    b = found["coupler.length"]
    turns = (b + c > d + a) & (np.abs(b - c) < d - a)
    assert np.array_equal(found.ok, turns)
    for name in ("travel", "B.velocity max"):
        assert np.array_equal(np.isfinite(found[name]), turns)
    assert sum(failure.count for failure in found.failures) == int((~turns).sum())
    assert {failure.group for failure in every(found.failures)} == {"coupler+rocker"}
    text = found.text()
    assert re.search(rf"\b40\b.*\b{int(turns.sum())}\b", text) and "(coupler, rocker)" in text


def test_a_sobol_sequence_fills_the_ranges_evenly_and_again() -> None:
    machine = store.machine("crank_rocker")
    ranges = {"coupler.length": "3..4 m", "rocker.length": "2.4..2.8 m"}
    metrics = ["closeness min"]
    found, again = (study(machine, ranges, metrics=metrics, sampling="sobol", samples=64, steps=36) for _ in range(2))
    assert found.designs == 64
    for address, low, high in (("coupler.length", 3.0, 4.0), ("rocker.length", 2.4, 2.8)):
        share = (found[address] - low) / (high - low)
        assert np.array_equal(found[address], again[address])
        # a Sobol net puts exactly 4 of 64 points into every sixteenth
        assert np.bincount((share * 16).astype(int), minlength=16).tolist() == [4] * 16


def test_loads_and_registered_metrics_of_every_design() -> None:
    machine = store.machine("jaw_crusher_sixbar")
    found = study(
        machine,
        {"pitman.length": "1.2, 1.3 m", "jaw.mass": "700, 900 kg"},
        metrics=["rms_input_torque", "driver.effort rms", "peak_reaction O5", "reaction O5 on jaw max"],
    )
    assert found["rms_input_torque"].tolist() == found["driver.effort rms"].tolist()
    assert found["peak_reaction O5"].tolist() == found["reaction O5 on jaw max"].tolist()
    for index in range(4):
        forces = lw.solve_forces(found.design(index), steps=7200)
        assert found["driver.effort rms"][index] == pytest.approx(np.sqrt((forces.input_torque**2).mean()), rel=1e-7)


def test_csv_and_data_hold_every_design() -> None:
    machine = store.machine("crank_rocker")
    found = study(machine, {"coupler.length": "1.5..4 m:6"}, metrics=["travel", "B.velocity max"])
    rows = list(csv.reader(io.StringIO(found.csv())))
    assert rows[0] == ["coupler.length", "travel [rad]", "B.velocity max [m/s]"]
    assert len(rows) == 7
    for row, index in zip(rows[1:], range(6), strict=True):
        assert float(row[0]) == found["coupler.length"][index]
        assert (row[1] == "") == (not found.ok[index])
    data = found.data()
    assert data["designs"] == 6 and data["movable"] == int(found.ok.sum())
    assert data["metrics"]["travel"]["unit"] == "rad"
    json.dumps(data)


def test_a_named_parameter_can_be_varied() -> None:
    found = study(lw.loads(SCALED), {"r": "40..60 mm:3", "ratio": "3, 5"}, metrics=["stroke"])
    assert found["stroke"] == pytest.approx(2 * found["r"], rel=1e-9)


PRESSED = """
format: 1
name: slider-crank
parameters: {p: 5 m}
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  piston: {points: [B]}
joints: {cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  push: {kind: force, on: piston, at: B, direction: 0 deg, magnitude: "5 N*m/(cylinder - p)"}
"""


def test_designs_whose_load_has_no_value_are_counted_and_the_others_go_on() -> None:
    """The piston is between 2 and 4 m from O; at 3 and 4 m the load divides by zero on the way."""
    machine, done = lw.loads(PRESSED), []
    found = study(
        machine,
        {"p": "3..5 m:3"},
        metrics=["peak_input_torque", "travel"],
        steps=36,
        progress=lambda *each: done.append(each),
    )
    assert done == sorted(done) and done[-1] == (3, 3)  # of a sweep and of the numbers
    assert found.ok.tolist() == [False, False, True] and found["travel"][2] == pytest.approx(2.0)
    turn = np.linspace(0, 2 * np.pi, 200_001)
    place = np.cos(turn) + np.sqrt(9 - np.sin(turn) ** 2)
    torque = 5 / (place - 5) * np.gradient(place, turn)
    assert found["peak_input_torque"][2] == pytest.approx(np.abs(torque).max(), rel=1e-6)
    (failure,) = found.failures
    assert (failure.kind, failure.group, failure.count) == ("metric", None, 2)
    assert failure.designs.tolist() == [0, 1]
    assert re.search(r"^2 .*loads\.push", found.text(), re.M)
    with refused("study.none_passes", count=2, name="push"):
        study(machine, {"p": [3.0, 3.5]}, metrics=["peak_input_torque"], steps=36)
    assert found.best("peak_input_torque") == 2
    found.metrics["peak_input_torque"].setflags(write=True)
    found.metrics["peak_input_torque"][:] = np.nan
    with refused("study.no_value", metric="peak_input_torque"):
        found.best("peak_input_torque")
    assert not found.has_best("peak_input_torque") and found.data()["best"] == {}


def test_a_machine_without_outputs_is_measured_by_its_last_link() -> None:
    """A crank alone: its travel over the turn is that of the link, its power that of gravity."""
    crank = lw.loads(
        "format: 1\nframe: {points: {O: [0 m, 0 m]}}\nlinks: {crank: {points: [O, A], length: 1 m, mass: 2 kg}}\n"
        "driver: {turn: crank, about: O, speed: 3 rad/s}\ngravity: [0 m/s², -10 m/s²]\n"
    )
    found = study(crank, {"crank.mass": "2, 4 kg"}, metrics=["peak_input_torque"], steps=36)
    assert found["peak_input_torque"] == pytest.approx([10.0, 20.0])


def test_a_sobol_sequence_needs_scipy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.stats", None)
    machine = store.machine("crank_rocker")
    with refused("study.needs_scipy"):
        study(machine, {"coupler.length": "3..4 m"}, sampling="sobol", samples=4)


@pytest.mark.parametrize(
    ("model", "vary", "names"),
    [
        ("triad", "bar_1.mass", ["travel", "peak_input_torque", "rms_input_torque", "peak_reaction"]),
        ("planetary_two_inputs", "ring.mass", ["peak_input_torque", "rms_input_torque", "peak_reaction"]),
    ],
)
def test_what_a_machine_does_not_have_is_left_out_where_nobody_asked(model: str, vary: str, names: list[str]) -> None:
    """A triad has no transmission angle, what turns round and round no travel; asked for by name they are refused."""
    machine = store.machine(model)
    found = study(machine, {vary: [1.0, 2.0]}, steps=24)
    assert list(found.metrics) == names
    assert list(found.data()["metrics"]) == names
    with refused("study.does_not_apply", RequestError, name="transmission_angle", mechanism=machine.name):
        study(machine, {vary: [1.0, 2.0]}, metrics=["transmission_angle", "peak_reaction"], steps=24)
