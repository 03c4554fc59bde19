"""Outputs that a model names by formulas: values, rates, and every place that takes an output."""

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

import linkwright as lw
from linkwright.cli import main

TEXT = """
format: 1
name: Two chains
parameters: {radius: 50 mm}
frame: {points: {O: [0 m, 0 m], D: [60 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  coupler: {points: [A, B], length: 120 mm}
  follower: {points: [D, B], length: 130 mm}
  rod: {points: [B, F], length: 400 mm}
  slider: {points: [F]}
joints:
  guide: {kind: prismatic, guide: frame, through: D, direction: 0 deg, block: slider, at: F}
assembly: {B: left, F: forward}
driver: {turn: crank, about: O, speed: -60 rpm}
outputs:
  gap: guide - radius*follower
  twice: 2*gap + 3 mm*sin(coupler)
  slip: guide.velocity - radius*follower.angular_velocity
  place: B.x*cos(input) + A.y
  leap: F.acceleration.x
"""
#: Values of the outputs written anew from the motion's own places.
FORMULAS = {
    "gap": lambda m: m.joint("guide").displacement - 0.05 * m.link("follower").angle,
    "twice": lambda m: (
        2 * (m.joint("guide").displacement - 0.05 * m.link("follower").angle)
        + 0.003 * np.sin(m.link("coupler").angle)
    ),
    "slip": lambda m: m.joint("guide").velocity - 0.05 * m.link("follower").angular_velocity,
    "place": lambda m: m.point("B").position[:, 0] * np.cos(m.input) + m.point("A").position[:, 1],
    "leap": lambda m: m.point("F").acceleration[:, 0],
}


@pytest.fixture(scope="module")
def machine() -> lw.Mechanism:
    return lw.loads(TEXT)


@pytest.fixture(scope="module")
def columns(machine: lw.Mechanism) -> dict[str, np.ndarray]:
    return lw.solve_motion(machine, steps=1440).columns()


def test_values_are_those_of_the_formulas(machine: lw.Mechanism, columns: dict[str, np.ndarray]) -> None:
    """The follower turns through with the crank, unevenly, and its angle keeps its turns."""
    motion = lw.solve_motion(machine, steps=1440)
    assert np.ptp(motion.link("follower").angle) > 6.0
    units = {"gap": "m", "twice": "m", "slip": "m/s", "place": "m", "leap": "m/s²"}
    for name, formula in FORMULAS.items():
        assert columns[f"{name} [{units[name]}]"] == pytest.approx(formula(motion), abs=1e-14)


def test_rates_are_derivatives_in_time(columns: dict[str, np.ndarray]) -> None:
    """Against differences of order 6, as far as these are exact."""
    time = columns["time [s]"]
    step, inside = time[1] - time[0], slice(3, -3)
    pairs = [
        ("gap [m]", "gap.rate [m/s]"),
        ("gap.rate [m/s]", "gap.second_rate [m/s²]"),
        ("twice.rate [m/s]", "twice.second_rate [m/s²]"),
        ("slip [m/s]", "slip.rate [m/s²]"),
        ("place [m]", "place.rate [m/s]"),
        ("place.rate [m/s]", "place.second_rate [m/s²]"),
    ]
    for value, rate in pairs:
        y = columns[value]
        d = (45 * (y[4:-2] - y[2:-4]) - 9 * (y[5:-1] - y[1:-5]) + (y[6:] - y[:-6])) / (60 * step)
        assert columns[rate][inside] == pytest.approx(d, abs=1e-8 * np.abs(d).max())
    assert not any(name.startswith(("leap.rate", "slip.second_rate")) for name in columns)


def test_a_value_does_not_depend_on_which_positions_are_asked(machine: lw.Mechanism) -> None:
    whole = lw.solve_motion(machine, steps=360)
    alone = lw.solve_motion(machine, at=[whole.input[200], whole.input[330]])
    assert alone.columns()["gap [m]"] == pytest.approx(whole.columns()["gap [m]"][[200, 330]], abs=1e-13)


def test_many_designs_have_the_values_of_single_machines(machine: lw.Mechanism) -> None:
    names = ["gap", "gap.rate", "gap.second_rate", "twice", "slip.rate", "place.second_rate", "leap"]
    lengths = np.array([0.12, 0.125])
    found = lw.sweep(
        machine,
        {"coupler.length": lengths},
        outputs=[f"{name} {kind}" for name in names for kind in ("max", "min", "rms")],
        steps=180,
    )
    for k, length in enumerate(lengths):
        motion = lw.solve_motion(machine.with_dimensions({"coupler.length": length}), steps=180)
        own = {name.partition(" [")[0]: values for name, values in motion.columns().items()}
        for name in names:
            size = np.abs(own[name]).max()
            assert found[f"{name} max"][k] == pytest.approx(own[name].max(), abs=1e-12 * size)
            assert found[f"{name} min"][k] == pytest.approx(own[name].min(), abs=1e-12 * size)
            assert found[f"{name} rms"][k] == pytest.approx(np.sqrt(np.mean(own[name] ** 2)), rel=1e-12)


def test_a_formula_follows_its_parameters(machine: lw.Mechanism) -> None:
    found = lw.sweep(machine, {"radius": np.array([0.05, 0.07])}, outputs=["gap range"], steps=180)
    other = lw.solve_motion(machine.with_dimensions({"radius": 0.07}), steps=180).columns()["gap [m]"]
    assert found["gap range"][1] == pytest.approx(np.ptp(other), rel=1e-12)
    assert found["gap range"][0] != pytest.approx(found["gap range"][1], rel=1e-3)


def test_gradients_are_those_of_differences(machine: lw.Mechanism) -> None:
    by, step = "coupler.length", 1e-6
    found = lw.sensitivity(machine, of=["gap rms", "slip max"], by=[by], steps=180)
    ends = []
    for sign in (-1, 1):
        value = machine.dimension(by) + sign * step
        motion = lw.solve_motion(machine.with_dimensions({by: value}), steps=180).columns()
        ends.append((np.sqrt(np.mean(motion["gap [m]"] ** 2)), motion["slip [m/s]"].max()))
    slopes = (np.array(ends[1]) - np.array(ends[0])) / (2 * step)
    for name, slope in zip(("gap rms", "slip max"), slopes, strict=True):
        assert found.gradient(name)[0] == pytest.approx(slope, rel=1e-5)


def test_where_a_formula_divides_by_zero_it_has_no_value() -> None:
    machine = lw.loads(TEXT + "  ratio: B.x/A.y\n")
    values = lw.solve_motion(machine, at=[0.0, 0.5, math.pi]).columns()["ratio []"]
    assert np.isnan(values[[0, 2]]).all()
    assert np.isfinite(values[1])


def test_the_file_keeps_the_formulas(machine: lw.Mechanism) -> None:
    again = lw.loads(lw.dump(machine))
    assert {name: each.expression.text for name, each in again.outputs.items()} == {
        name: each.expression.text for name, each in machine.outputs.items()
    }
    assert [each.name for each in again.outputs["slip"].outputs] == ["slip", "slip.rate"]


def test_a_model_built_in_code_names_its_outputs() -> None:
    model = lw.Model("crank")
    model.frame(O=(0, 0))
    model.link("crank", ["O", "A"], length=0.1)
    model.drive("crank", about="O", speed=10)
    model.outputs(height="A.y - 20 mm", half="height/2")
    motion = lw.solve_motion(model.build(), at=[0.5])
    assert motion.columns()["half [m]"][0] == pytest.approx(0.05 * math.sin(0.5) - 0.01, abs=1e-15)


def test_commands_take_the_names(tmp_path: Path) -> None:
    file, table, curves = tmp_path / "m.yaml", tmp_path / "t.csv", tmp_path / "gap.svg"
    file.write_text(TEXT, encoding="utf-8")
    with redirect_stdout(StringIO()) as told:
        assert main(["solve", str(file), "--steps", "4", "--columns", "gap", "--json"]) == 0
        assert main(["export", str(file), "--output", str(table), "--steps", "8"]) == 0
        assert main(["plot", str(file), "--kind", "sva", "--of", "gap", "--output", str(curves)]) == 0
        assert main(["study", str(file), "--vary", "radius=40..60 mm:3", "--metrics", "gap range"]) == 0
    assert "gap.second_rate" in told.getvalue()
    with table.open(encoding="utf-8") as stream:
        head, first, *_ = csv.reader(stream)
    motion = lw.solve_motion(lw.loads(TEXT), steps=8)
    assert float(first[head.index("gap [m]")]) == motion.columns()["gap [m]"][0]
    assert curves.read_text(encoding="utf-8").startswith("<?xml")


def test_optimisation_makes_a_named_output_small(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    task = "optimize: {vary: {rod.length: [300 mm, 500 mm]}, minimize: slip rms}\n"
    file.write_text(TEXT + task, encoding="utf-8")
    with redirect_stdout(StringIO()) as told:
        assert main(["optimize", str(file), "--json"]) == 0
    found = json.loads(told.getvalue())
    assert found["ok"]


def test_the_bed_of_the_press_is_in_step_with_its_cylinder() -> None:
    """The press's own name for what its cam does: constant in the zone of impression to a millionth of a mm."""
    press = store.machine("printing_press")
    motion = lw.solve_motion(press, steps=720)
    zone = (np.degrees(motion.input) <= -882.734) & (np.degrees(motion.input) >= -1449.5665)
    lead = motion.columns()["lead [m]"]
    assert zone.sum() > 200
    assert 1e3 * np.ptp(lead[zone]) < 1e-6
    assert np.abs(motion.columns()["lead.rate [m/s]"][zone]).max() < 1e-6


def test_the_bed_that_drives_finds_the_printed_crank_angles() -> None:
    """ψ of the flat-bed press at ten displacements of its slider, printed to 1e-4 degrees."""
    printed = [133.3740, 140.7340, 147.9701, 155.2380, 162.6878, 170.4900, 178.8701, 188.1747, 199.0442, 213.0665]
    inverted = lw.loads("""
format: 1
name: Slider-crank driven from its slider
frame: {points: {O2: [0 mm, 0 mm]}}
links:
  crank: {points: [O2, C], length: 198 mm}
  rod: {points: [C, D], length: 702.5 mm}
  slider: {points: [D]}
joints:
  guide: {kind: prismatic, guide: frame, through: O2, direction: 180 deg, block: slider, at: D, offset: 60.5 mm}
assembly: {C: left}
driver: {slide: guide, speed: 1 m/s}
outputs: {psi: 90 deg - 14.84722 deg + crank}
""")
    outer = math.sqrt(0.9005**2 - 0.0605**2)
    motion = lw.solve_motion(inverted, at=list(0.13 - outer + 0.24 * np.arange(10) / 9))
    assert np.degrees(motion.columns()["psi [rad]"]) == pytest.approx(printed, abs=6e-5)
