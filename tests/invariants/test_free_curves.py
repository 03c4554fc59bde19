"""Free curves: drawn by the solver within the demands, a linkage's own curve found again."""

import math
from pathlib import Path

import numpy as np
import pytest
from benchmarks.free_curves import curve_distance
from tests.every import every
from tests.refusals import refused

import linkwright as lw

pytest.importorskip("llvmlite")
FOUR = np.array([0.9, 0.9 + 1.7j, 0.6j, 1.3 + 0.6j])  # a figure 4 in one stroke


def even_points(line: np.ndarray, count: int) -> np.ndarray:
    """Places at equal shares of a line's length."""
    way = np.append(0.0, np.cumsum(np.abs(np.diff(line))))
    at = np.linspace(0.0, way[-1], count)
    return np.interp(at, way, line.real) + 1j * np.interp(at, way, line.imag)


def nearest(places: np.ndarray, line: np.ndarray) -> float:
    """Mean distance of places from a line of corners."""
    way = np.diff(line)
    along = np.clip(((places[:, None] - line[:-1]) * way.conj()).real / np.abs(way) ** 2, 0.0, 1.0)
    return float(np.abs(places[:, None] - line[:-1] - along * way).min(axis=1).mean())


def apart(path: np.ndarray, curve: np.ndarray) -> float:
    """Mean nearest distance of two lines as they lie, there and back, in rms radii of the second."""
    path, drawn = even_points(path, 1500), even_points(curve, 1500)
    radius = np.sqrt(np.mean(np.abs(drawn - drawn.mean()) ** 2))
    return (nearest(path, curve) + nearest(drawn, path)) / float(radius)


@pytest.mark.long
def test_the_solver_draws_the_same_curve_within_the_demands() -> None:
    size = 0.02
    found = lw.free_curve(size * FOUR, seconds=2.5, joints=8, count=3)
    assert found.best.error < 0.1 < found.candidates[-1].error
    assert found.best.values["links"] > found.candidates[-1].values["links"] == 4
    for each in every(found):
        machine = each.mechanism()
        motion = lw.solve_motion(machine, steps=1500)
        path = motion.point("P").position @ [1, 1j]
        assert apart(path, size * FOUR) == pytest.approx(each.error, rel=0.03)
        assert np.abs(path[0] - each.curve[0]) < 1e-4 * size
        speed = np.abs(np.diff(path) / np.diff(motion.input)).max() * 2 * math.pi
        assert speed == pytest.approx(each.values["fastest_at_1_Hz"], rel=0.01)
    turning = lw.loads(found.model_text(0).split("cycle:")[0])
    whole = lw.solve_motion(turning, steps=720)
    places = {name: whole.point(name).position @ [1, 1j] for name in found.best.linkage.points}
    least = lw.metrics(lw.solve_motion(turning), "transmission_angle").value("transmission_angle")
    assert least == pytest.approx(found.best.transmission_angle, abs=1e-3)
    assert least >= math.radians(20)
    path = motion.point("P").position @ [1, 1j]
    curve = np.interp(np.linspace(0, 1, 4001), np.linspace(0, 1, 4), FOUR.real) + 1j * np.interp(
        np.linspace(0, 1, 4001), np.linspace(0, 1, 4), FOUR.imag
    )
    weight = np.abs(np.diff(FOUR)).repeat([1333, 1334, 1333])
    middle = np.average(0.5 * (curve[1:] + curve[:-1]), weights=weight)
    radius = math.sqrt(np.average(np.abs(0.5 * (curve[1:] + curve[:-1]) - middle) ** 2, weights=weight))
    reach = max(np.abs(each - size * middle).max() for each in places.values()) / (size * radius)
    assert reach <= 6.0
    assert found.best.values["size"] == pytest.approx(reach, rel=2e-3)


@pytest.mark.long
def test_an_input_that_swings_keeps_the_demands_while_it_draws() -> None:
    found = lw.free_curve(FOUR, seconds=1.0, joints=8, turning=False, transmission_angle=math.radians(30))
    assert not found.best.turns
    for each in every(found):
        machine = each.mechanism()
        motion = lw.solve_motion(machine, steps=1500)
        assert apart(motion.point("P").position @ [1, 1j], FOUR) == pytest.approx(each.error, rel=0.03)
        if not each.turns:
            angle = lw.metrics(motion, "transmission_angle").value("transmission_angle")
            assert angle == pytest.approx(each.transmission_angle, abs=1e-3)
            assert angle >= math.radians(30)


@pytest.mark.rotating
def test_the_curve_of_a_four_bar_is_found_again() -> None:
    crank = np.linspace(0, 2 * np.pi, 201)[:-1]
    pin = np.exp(1j * crank)
    span = 3.2 - pin
    along = (2.6**2 + np.abs(span) ** 2 - 2.4**2) / (2 * 2.6 * np.abs(span))
    coupler = span / np.abs(span) * (along + 1j * np.sqrt(1 - along**2))
    curve = pin + (1.1 + 0.9j) * coupler
    found = lw.free_curve(curve, closed=True, joints=5, seconds=1.5, size=12)
    assert found.best.error < 0.01
    assert found.best.values["links"] == 4
    assert found.best.values["drawn_as_given"] in (pytest.approx(1, abs=0.01), pytest.approx(0, abs=0.01))


@pytest.mark.long
def test_the_measure_knows_no_place_size_or_turn() -> None:
    draw = np.random.default_rng(2)
    curve = np.cumsum(draw.normal(size=60) + 1j * draw.normal(size=60))
    assert curve_distance(curve, (2 - 5j) * curve[::-1] + 7, False) < 1e-6
    circle = np.exp(1j * np.linspace(0, 2 * np.pi, 4001)[:-1])
    ellipse = circle.real + 0.5j * circle.imag
    plain = np.sqrt(np.mean(np.abs(np.diff(np.append(ellipse, 1))) * np.abs(ellipse) ** 2)) / np.sqrt(
        np.mean(np.abs(np.diff(np.append(ellipse, 1))))
    )
    even = np.abs(ellipse / plain)
    weight = np.abs(np.diff(np.append(ellipse, 1)))
    out = np.average(np.abs(even - 1), weights=weight)  # from the ellipse to the circle: along its radius
    assert curve_distance(circle, ellipse, True) > out


@pytest.mark.rotating
def test_a_curve_is_read_from_a_file(tmp_path: Path) -> None:
    """Its corners in the unit that is told, with commas in their numbers."""
    table = tmp_path / "a.csv"
    table.write_text("x;y\n1,5;-2,25\n3;4,0")
    found = lw.free_curve(file=table, file_unit=2.0, joints=5, seconds=0.05)
    assert found.target == pytest.approx(2.0 * np.array([1.5 - 2.25j, 3 + 4j]))


@pytest.mark.parametrize(
    "rows", ["1,2\n1,5 2,5\n", "1,5 2,5\n3,5 4,5\n", "0,1\nnan,2\n3,4", "0,1\n1e400,2\n3,4", "1 mm, 2 mm\n3 mm, 4 mm"]
)
def test_rows_that_are_not_two_numbers_are_refused(rows: str, tmp_path: Path) -> None:
    table = tmp_path / "a.csv"
    table.write_text(rows)
    with refused("synthesize.free_curve.line", path=table):
        lw.free_curve(file=table)
