"""Worked solutions against numbers of published course designs (with their errata; see the cases' pages)."""

from __future__ import annotations

import math

import pytest

import linkwright as lw
from linkwright.worked.page import Equation


def results(name: str, degrees: float) -> dict[str, Equation]:
    forces = lw.solve_forces(lw.solve_motion(lw.load(f"gallery:{name}"), at=math.radians(degrees)))
    return {line.symbol: line for line in lw.worked(forces).equations}


def printed(name: str, degrees: float, symbols: dict[str, str]) -> dict[str, float]:
    lines = results(name, degrees)
    return {word: float(lines[symbol].result) for word, symbol in symbols.items()}


def test_jaw_crusher_first_row_of_the_published_table() -> None:
    """鉸鏈式顎式破碎機方案分析: FR6 9904.580 N at 77.690° in row 1."""
    found = printed("jaw_crusher_sixbar_as_reported", 0.0, {"FR6": "F_O5,5", "BT6": "∠F_O5,5", "angle": "φ5"})
    assert found["FR6"] == pytest.approx(9904.580, abs=0.05)
    assert found["BT6"] == pytest.approx(77.690, abs=0.0006)
    assert math.radians(found["angle"]) == pytest.approx(-1.658, abs=0.0006)


def test_jaw_crusher_fourbar_first_row() -> None:
    """The same report: FR4 10261.396 N at 102.685°."""
    found = printed("jaw_crusher_fourbar", 0.0, {"FR4": "F_O3,3", "BT4": "∠F_O3,3"})
    assert found["FR4"] == pytest.approx(10261.396, abs=0.06)
    assert found["BT4"] == pytest.approx(102.685, abs=0.0006)


def test_conveyor_rates_without_the_precedence_error() -> None:
    """Swinging conveyor at 0°, corrected velocities and accelerations; balancing torque 2102.0 N·m."""
    symbols = {
        "ω2": "ω2",
        "ω3": "ω3",
        "ω4": "ω4",
        "ε2": "α2",
        "ε3": "α3",
        "ε4": "α4",
        "v": "v_Fx",
        "a": "a_Fx",
    }
    found = printed("swing_conveyor", 0.0, symbols | {"torque": "M_driver"})
    expected = {
        "ω2": -1.834732, "ω3": 15.837381, "ω4": -11.728288, "v": 0.779319,
        "ε2": 1950.2000, "ε3": 2386.1162, "ε4": -1741.1396, "a": -76.79288,
    }  # fmt: skip
    for word, value in expected.items():
        assert found[word] == pytest.approx(value, rel=6e-6), word
    assert found["torque"] == pytest.approx(2102.0, abs=0.06)


@pytest.mark.parametrize(
    ("degrees", "coupler", "rocker", "rod", "slider"),
    [
        (0.0, -12.947, 1.85923, 8.21421, 1.22361),
        (60.0, -4.354, 32.8448, -13.36, 1.14343),
        (180.0, 33.2035, 85.5745, -34.366, 0.71922),
    ],
)
def test_conveyor_printed_positions(
    degrees: float, coupler: float, rocker: float, rod: float, slider: float
) -> None:
    found = printed("swing_conveyor", degrees, {"2": "φ2", "3": "φ3", "4": "φ4", "x": "x_F"})
    assert found["2"] == pytest.approx(coupler, abs=0.0006)
    assert found["3"] == pytest.approx(rocker, abs=0.0001)
    assert found["4"] == pytest.approx(rod, abs=0.0006)
    assert found["x"] == pytest.approx(slider, abs=6e-6)
