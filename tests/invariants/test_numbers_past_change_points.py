"""Metrics of motions through change points, in closed form and whatever the steps.

A parallelogram copies its crank: no angular acceleration, no torque; its coupler goes round a circle.
"""

from __future__ import annotations

from math import atan2, inf, pi, sqrt
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.analysis import metrics

MODEL = """
format: 1
name: parallelogram
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 2 m, mass: 2 kg, inertia: 0.7 kg·m²}
  rocker: {points: [O2, B], length: 1 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 5 rad/s, start: 90 deg}
"""
LOADED = MODEL + "loads: {work: {kind: torque, on: rocker, magnitude: 10 N·m}}\n"
STEPS = [97, 361, 1001, 3601]


def numbers(text: str, steps: int, failures: str = "raise") -> lw.MetricsTable:
    return metrics(lw.solve_forces(lw.solve_motion(lw.loads(text), steps=steps, failures=failures)))


@pytest.mark.parametrize("steps", STEPS)
def test_nothing_is_left_of_rounding(steps: int) -> None:
    """The pins share the coupler's m r ω² = 50 N; 361 steps have a position 4e-5 rad beside a change point."""
    table = numbers(MODEL, steps)
    for name in ("peak_acceleration", "peak_input_torque", "rms_input_torque", "peak_power"):
        assert table.value(name) == pytest.approx(0.0, abs=1e-7)
    for pin in ("O1", "O2", "A", "B"):
        assert table["peak_reaction", pin].value == pytest.approx(25.0, rel=1e-8)
        assert table["rms_reaction", pin].value == pytest.approx(25.0, rel=1e-8)
    assert table.value("peak_shaking_force") == pytest.approx(50.0, rel=1e-8)
    assert table.value("transmission_angle") == 0.0
    assert table.value("pressure_angle") == pytest.approx(pi / 2, abs=1e-9)
    assert all(row.exact for row in table)


@pytest.mark.parametrize("steps", STEPS)
def test_a_load_that_the_change_point_cannot_carry_has_infinite_reactions(steps: int) -> None:
    """The coupler's force along itself is T / (r sin θ); the torque is T all the way, the power T ω."""
    table = numbers(LOADED, steps)
    for pin in ("O1", "O2", "A", "B"):
        row = table["peak_reaction", pin]
        assert row.value == inf
        assert [(each.key, each.message.values["at"]) for each in row.warnings] == [("unbounded", "180°")]
        assert row.at == pytest.approx(pi, abs=1e-6) and row.warnings
        assert table["rms_reaction", pin].value == inf
    for name, value in (("peak_input_torque", 10.0), ("rms_input_torque", 10.0), ("mean_power", -50.0)):
        assert abs(table.value(name)) == pytest.approx(abs(value), rel=1e-8)


def test_positions_on_change_points_that_are_marked_hide_nothing_between() -> None:
    table = numbers(LOADED, 360, "mark")
    assert table["peak_reaction", "A"].value == inf
    assert table.value("peak_input_torque") == pytest.approx(10.0, rel=1e-8)


def test_infinite_reactions_are_compared_drawn_and_reported(tmp_path: Path) -> None:
    """Infinite is worse than anything finite and as bad as itself; pictures say ∞, scores stay numbers."""
    files = []
    for name, text in {"idle": MODEL, "loaded": LOADED, "more": LOADED.replace("10 N·m", "12 N·m")}.items():
        files.append(tmp_path / f"{name}.yaml")
        files[-1].write_text(text.replace("start: 90 deg", "start: 89.6 deg"), encoding="utf-8")
    compared = lw.compare(files, metrics=["peak_reaction"])
    assert compared.ranking[0].index == 0
    assert [row.score(k) for row in compared.judged for k in range(3)] == [1.0, 0.0, 0.0]
    both = lw.compare(files[1:])
    assert all(0.0 <= rank.score <= 1.0 for rank in both.ranking)
    assert "nan" not in both.text() + both.evaluation()
    forces = lw.solve_forces(lw.solve_motion(lw.load(files[1])))
    assert "∞" in lw.plot(forces, "reactions").svg()


def test_a_rocker_that_does_not_come_back_after_a_turn_swings_from_where_it_begins() -> None:
    """Coupler and rocker are as long: it begins at (-1 + 1/√5, 1/2 + 2/√5) and turns back below its pivot."""
    text = MODEL.replace("[A, B], length: 2 m", "[A, B], length: 1.5 m")
    text = text.replace("[O2, B], length: 1 m", "[O2, B], length: 1.5 m")
    (swing,) = numbers(text, 97)["swing_angle"]
    assert swing.value == pytest.approx(1.5 * pi - atan2(0.5 + 2 / sqrt(5), -1 + 1 / sqrt(5)), rel=1e-12)
