"""Worked solutions, as they are printed, against the published numbers of the package (validation, gallery)."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.validation.validate import from_gallery


def last_digit(number: str) -> float:
    """One unit of the last digit: 0.01 of ``3.14``."""
    return float(10.0 ** -len(number.partition(".")[2]))


def results(name: str, degrees: float) -> dict[str, Any]:
    forces = lw.solve_forces(lw.solve_motion(store.machine(name), at=math.radians(degrees)))
    return {line.symbol: line for line in lw.worked(forces).equations}


#: Where a worked solution has a published number of a model at an input, deg: symbols by the published name.
JAW = {"O5 on jaw.magnitude": "F_O5,5", "O5 on jaw.direction": "∠F_O5,5"}
ROCKER = {"O3 on jaw.magnitude": "F_O3,3", "O3 on jaw.direction": "∠F_O3,3"}
PLACES = {"coupler.angle": "φ2", "rocker.angle": "φ3", "rod.angle": "φ4", "F.position.x": "x_F"}
RATES = {
    "coupler.angular_velocity": "ω2",
    "rocker.angular_velocity": "ω3",
    "rod.angular_velocity": "ω4",
    "coupler.angular_acceleration": "α2",
    "rocker.angular_acceleration": "α3",
    "rod.angular_acceleration": "α4",
    "F.velocity.x": "v_Fx",
    "F.acceleration.x": "a_Fx",
    "input_torque": "M_driver",
}
CASES = [
    ("jaw_crusher_sixbar_as_reported", 0.0, JAW),
    ("jaw_crusher_sixbar", 0.0, {"jaw.angle": "φ5"}),
    ("jaw_crusher_fourbar", 0.0, ROCKER),
    ("swing_conveyor", 0.0, PLACES | RATES),
    ("swing_conveyor", 60.0, PLACES),
    ("swing_conveyor", 180.0, PLACES),
]


#: Of a report that prints a table of reactions: its first row (鉸鏈式顎式破碎機方案分析, 東北大學).
FIRST_ROWS = {"jaw_crusher_fourbar": {"O3 on jaw.magnitude": "10261.396 N", "O3 on jaw.direction": "102.685 deg"}}


def numbers(model: str, degrees: float) -> dict[str, str]:
    """Published numbers of a model at an input, with their units."""
    found = dict(FIRST_ROWS.get(model, {}))
    for case in from_gallery(model):
        if case.inputs.get("at", case.inputs.get("input")) == f"{degrees:g} deg":
            found |= {each.what: each.right or each.text for each in case.numbers}
    return found


@pytest.mark.parametrize(("model", "degrees", "symbols"), CASES)
def test_a_worked_solution_prints_the_published_numbers(model: str, degrees: float, symbols: dict[str, str]) -> None:
    """To the rounding of both prints; angles over full turns."""
    expected, lines = numbers(model, degrees), results(model, degrees)
    for what, symbol in every(symbols.items()):
        text, _, unit = expected[what].partition(" ")
        line, scale = lines[symbol], 180.0 / math.pi if unit == "rad" else 1.0
        gap = float(line.result) - scale * float(text)
        gap = math.remainder(gap, 360.0) if line.unit == "°" else gap
        assert abs(gap) <= 0.51 * (last_digit(line.result) + scale * last_digit(text)), (what, text, line.result)
