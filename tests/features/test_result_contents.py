"""What exports and diagrams hold, against statics by hand: a block on an incline, a braked crank."""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw

#: A block of 2 kg on an incline of 30°, pushed up at 0.1 m/s, its mass centre 50 mm ahead of its point; g = 10 m/s².
INCLINE = """
format: 1
name: block on an incline
frame: {points: {O: [0 m, 0 m]}}
links:
  block: {points: [B], mass: 2 kg, mass_centre: [50 mm, 0 mm]}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 30 deg, block: block, at: B}
driver: {slide: guide, speed: 0.1 m/s}
cycle: {from: 0 m, to: 0.3 m}
gravity: [0, -10 m/s²]
"""
BRAKED = """
format: 1
name: braked crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m}
driver: {turn: crank, about: O, speed: 3 rad/s}
loads:
  brake: {kind: torque, on: crank, magnitude: -7 N·m}
"""
NORMAL, TILT = 20.0 * math.cos(math.pi / 6), math.pi / 6
#: Every column of the incline, and its value at the first position.
BY_HAND = {
    "time [s]": 0.0,
    "driver [m]": 0.0,
    "block.angle [rad]": TILT,
    "block.angular_velocity [rad/s]": 0.0,
    "block.angular_acceleration [rad/s²]": 0.0,
    "block.B.position.x [m]": 0.0,
    "block.B.position.y [m]": 0.0,
    "block.B.velocity.x [m/s]": 0.1 * math.cos(TILT),
    "block.B.velocity.y [m/s]": 0.1 * math.sin(TILT),
    "block.B.acceleration.x [m/s²]": 0.0,
    "block.B.acceleration.y [m/s²]": 0.0,
    "guide.displacement [m]": 0.0,
    "guide.velocity [m/s]": 0.1,
    "guide.acceleration [m/s²]": 0.0,
    "driver.effort [N]": 10.0,
    "guide on block.x [N]": -NORMAL * math.sin(TILT),
    "guide on block.y [N]": NORMAL * math.cos(TILT),
    "guide on block.magnitude [N]": NORMAL,
    "guide on block.direction [rad]": TILT + math.pi / 2,
    "guide on block.couple [N·m]": 0.05 * NORMAL,
    "shaking_force.x [N]": 0.0,
    "shaking_force.y [N]": 0.0,
    "shaking_moment [N·m]": 0.0,
    "power_residual [W]": 0.0,
    "balance_residual [N]": 0.0,
}


def first_row(path: Path) -> dict[str, float]:
    row = next(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    return {name: float(value or math.nan) for name, value in row.items()}


def test_every_column_of_a_block_on_an_incline_with_its_unit(tmp_path: Path) -> None:
    row = first_row(lw.export(lw.loads(INCLINE), tmp_path / "a.csv", steps=7))
    assert row == pytest.approx(BY_HAND, abs=1e-12)
    turned = first_row(lw.export(lw.loads(INCLINE), tmp_path / "b.csv", steps=7, degrees=True))
    assert turned["block.angle [°]"] == pytest.approx(30.0) and "block.angular_velocity [°/s]" in turned
    assert turned["guide on block.couple [N·m]"] == row["guide on block.couple [N·m]"]


def test_json_names_owner_quantity_and_unit_of_every_column(tmp_path: Path) -> None:
    path = lw.export(lw.loads(INCLINE), tmp_path / "a.json", steps=7)
    data = json.loads(path.read_text(encoding="utf-8"))
    columns = {name: each for table in data["tables"].values() for name, each in table.items()}
    assert set(columns) == set(BY_HAND)
    for name, each in every(columns.items(), least=len(BY_HAND)):
        assert name.endswith(f"[{each['unit']}]") and len(each["values"]) == data["positions"]
        assert each["values"][0] == pytest.approx(BY_HAND[name], abs=1e-12)
    couple = columns["guide on block.couple [N·m]"]
    assert (couple["owner"], couple["quantity"]) == ("guide on block", "couple")


def test_a_turning_driver_has_a_torque_and_the_load_its_moment(tmp_path: Path) -> None:
    row = first_row(lw.export(lw.loads(BRAKED), tmp_path / "a.csv", steps=8))
    assert row["driver.effort [N·m]"] == pytest.approx(7.0)
    assert row["brake.moment [N·m]"] == pytest.approx(-7.0)
    assert row["O on crank.magnitude [N]"] == 0.0 and math.isnan(row["O on crank.direction [rad]"])
    assert not any(name.startswith("O on crank.couple") for name in row)


def curves(diagram: object) -> dict[str, np.ndarray]:
    """Curves of the first panel by their names in the legend."""
    figure = diagram.figure  # type: ignore[attr-defined]
    (legend,) = figure.legends
    lines = [line for line in figure.axes[0].lines if len(line.get_xdata()) > 2]
    by_look = {(line.get_color(), line.get_linestyle()): np.asarray(line.get_ydata()) for line in lines}
    handles = zip(legend.get_texts(), legend.get_lines(), strict=False)
    return {text.get_text(): by_look.get((line.get_color(), line.get_linestyle())) for text, line in handles}


def assert_through(drawn: np.ndarray, values: np.ndarray) -> None:
    """A curve goes through the values, and through a few peaks between them."""
    assert drawn[np.abs(drawn[:, None] - values).argmin(axis=0)] == pytest.approx(values, rel=1e-12)
    assert len(drawn) <= len(values) + 3


def test_the_diagram_of_joint_forces_draws_one_force_of_every_joint_and_all_of_a_pin_of_three() -> None:
    forces = store.forces("jaw_crusher_sixbar", 60)
    found = {name: values for name, values in curves(lw.plot(forces, "reactions")).items() if values is not None}
    expected = {"O1": ("O1", "crank"), "A": ("A", "pitman"), "O3": ("O3", "rocker"), "O5": ("O5", "jaw")}
    expected |= {f"B ({link})": ("B", link) for link in ("pitman", "rocker", "toggle")} | {"C": ("C", "jaw")}
    assert {name for name in found if "limit" not in name} == set(expected)
    for name, (joint, link) in expected.items():
        force = np.hypot(*forces.reaction(joint, on=link).T)
        assert_through(found[name] * 1e3, force)


def test_the_diagram_of_one_joint_draws_the_force_on_the_link_that_is_named() -> None:
    forces = store.forces("jaw_crusher_sixbar", 60)
    size, parts = lw.plot(forces, "reactions", joint="B", on="toggle").figure.axes
    drawn = [np.asarray(line.get_ydata()) for line in parts.lines if len(line.get_xdata()) > 2]
    force = forces.reaction("B", on="toggle")
    for column, values in enumerate(every(drawn, least=2)):
        assert_through(values * 1e3, force[:, column])
    (whole,) = [np.asarray(line.get_ydata()) for line in size.lines if len(line.get_xdata()) > 2]
    assert_through(whole * 1e3, np.hypot(*force.T))


def test_a_sliding_driver_is_drawn_as_a_force_and_a_turning_one_as_a_torque() -> None:
    pushed = lw.plot(lw.loads(INCLINE), "torque").figure.axes[0]
    assert pushed.get_ylabel().endswith("(N)") and "F" in pushed.get_ylabel()
    (line,) = [each for each in pushed.lines if len(each.get_xdata()) > 2]
    assert np.asarray(line.get_ydata()) == pytest.approx(10.0)
    turned = lw.plot(lw.loads(BRAKED), "torque").figure.axes[0]
    assert turned.get_ylabel().endswith("(N·m)")
    (line,) = [each for each in turned.lines if len(each.get_xdata()) > 2]
    assert np.asarray(line.get_ydata()) == pytest.approx(7.0)


def test_every_driver_has_its_panel() -> None:
    forces = store.forces("excavator", 20)
    axes = lw.plot(forces, "torque").figure.axes
    for one, name in zip(every(axes, least=3), forces.mechanism.drivers, strict=True):
        assert name in one.get_ylabel()
        (line,) = [each for each in one.lines if len(each.get_xdata()) > 2]
        factor = 1e3 if "(kN)" in one.get_ylabel() else 1e6 if "(MN)" in one.get_ylabel() else 1.0
        drawn = np.asarray(line.get_ydata()) * factor
        assert_through(drawn, forces.driver_effort(name))


def test_a_guide_turns_with_the_link_that_carries_it() -> None:
    forces = store.forces("dyad_rrp", 7)
    angle = forces.motion.link("disc").angle + math.radians(25.0)
    expected = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert forces.guide_direction("slot") == pytest.approx(expected, abs=1e-12)
