"""Cycles that rock: limits by the cosine law and by closures of their own, the driver's course, what is refused."""

from __future__ import annotations

import json
from math import acos, asin, cos, degrees, hypot, pi, radians, sin, sqrt

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright.core.arrays import Floats
from linkwright.drivers.rocking import MARGIN
from linkwright.file_check import checked_text
from linkwright.files.model_file import json_schema
from linkwright.files.write import dump
from linkwright.page.content import page_data

FOUR_BAR = """
format: 1
name: Four-bar
frame: {points: {O1: [0 mm, 0 mm], O2: [220 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 60 mm}
  coupler: {points: [A, B], length: 110 mm, mass: 1 kg, inertia: 0.001 kg·m²}
  rocker: {points: [O2, B], length: 90 mm}
assembly: {B: left}
gravity: [0, -9.81 m/s²]
driver: DRIVER
"""
STEADY = "{turn: crank, about: O1, speed: 60 rpm}"
OTHER = "{turn: rocker, about: O2, speed: 1 rpm}"
#: cos θ = (60² + 220² − (110 + 90)²)/(2·60·220): coupler and rocker in line.
LIMIT = acos((60**2 + 220**2 - 200**2) / (2 * 60 * 220))


def four_bar(cycle: str = "rock", driver: str = STEADY, **lengths: str) -> lw.Mechanism:
    text = FOUR_BAR.replace("DRIVER", driver)
    for old, new in lengths.items():
        text = text.replace(f"{old[1:]} mm", new)
    return lw.loads(text + (f"cycle: {cycle}\n" if cycle else ""))


def ends(machine: lw.Mechanism, steps: int = 360) -> tuple[float, float]:
    """Smallest and largest coordinate of the only driver; the cycle begins at one, half of it is the other."""
    q = lw.solve_motion(machine, steps=steps).input
    assert {q.argmin(), q.argmax()} == {0, steps // 2}
    return float(q.min()), float(q.max())


def test_a_four_bar_rocks_between_the_positions_of_coupler_and_rocker_in_line() -> None:
    assert degrees(LIMIT) == pytest.approx(62.964, abs=1e-3)
    inner = (1 - 2 * MARGIN) * LIMIT
    assert ends(four_bar()) == pytest.approx((-inner, inner), abs=1e-9)


@pytest.mark.parametrize("margin", [0.002, 0.1, 0.3])
def test_the_margin_is_a_share_of_the_range(margin: float) -> None:
    inner = (1 - 2 * margin) * LIMIT
    assert ends(four_bar(f"{{rock: limits, margin: {margin}}}")) == pytest.approx((-inner, inner), abs=1e-9)


def test_the_driver_has_the_given_speed_on_average_and_rests_at_the_ends() -> None:
    motion = lw.solve_motion(four_bar(), steps=720)
    inner = (1 - 2 * MARGIN) * LIMIT
    assert motion.positions.closed
    assert motion.positions.period == pytest.approx(4 * inner / (2 * pi))  # 60 rpm are 2π rad/s
    _q, rate, second = motion.positions.coordinates["driver"]
    assert rate[[0, 360]] == pytest.approx([0, 0], abs=1e-12)
    assert np.abs(rate).max() == pytest.approx(pi / 2 * 2 * pi)
    assert np.abs(rate).mean() == pytest.approx(2 * pi, rel=1e-4)
    step = motion.time[1]
    assert np.gradient(motion.input, step)[5:-5] == pytest.approx(rate[5:-5], abs=1e-3)
    assert np.gradient(rate, step)[5:-5] == pytest.approx(second[5:-5], abs=2e-2)
    for link in ("coupler", "rocker"):
        assert np.isfinite(motion.link(link).angular_acceleration).all()
        assert motion.link(link).angular_velocity[[0, 360]] == pytest.approx([0, 0], abs=1e-9)


def test_motion_and_forces_are_those_of_the_same_course_written_as_an_expression() -> None:
    inner = (1 - 2 * MARGIN) * LIMIT
    period = 4 * inner / (2 * pi)
    course = f"{{turn: crank, about: O1, position: '-{inner!r} rad*cos(2*pi*t/({period!r} s))'}}"
    written = four_bar(f"{{duration: {period!r} s}}", course)
    a, b = lw.solve_forces(four_bar()), lw.solve_forces(written)
    for link in ("coupler", "rocker"):
        for each in ("angle", "angular_velocity", "angular_acceleration"):
            own, other = getattr(a.motion.link(link), each), getattr(b.motion.link(link), each)[:360]
            assert own == pytest.approx(other, rel=1e-7, abs=1e-7)
    assert a.driver_effort("driver") == pytest.approx(b.driver_effort("driver")[:360], rel=1e-7, abs=1e-7)


def test_a_negative_speed_begins_at_the_upper_end() -> None:
    motion = lw.solve_motion(four_bar(driver="{turn: crank, about: O1, speed: -60 rpm}"), steps=8)
    assert motion.input[0] == motion.input.max() > 0
    assert motion.positions.coordinates["driver"][1][1] < 0


SLIDER_CRANK = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod: {points: [A, B], length: 60 mm}
  block: {points: [B]}
joints: {way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B, offset: 10 mm}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm, START}
cycle: rock
"""


@pytest.mark.parametrize(("start", "turned"), [("start: 0 deg", 0.0), ("start: 180 deg", pi)])
def test_a_slider_crank_with_a_short_rod_rocks_where_the_rod_reaches_its_way(start: str, turned: float) -> None:
    """|100 sin θ − 10| ≤ 60: a range about 0°, and another one about 180° for a driver that starts there."""
    low, high = asin(-50 / 100), asin(70 / 100)
    low, high = (low, high) if turned == 0.0 else (pi - high, pi - low)
    free = MARGIN * (high - low)
    found = ends(lw.loads(SLIDER_CRANK.replace("START", start)))
    assert found == pytest.approx((low + free, high - free), abs=1e-9)


SIX_BAR = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [120 mm, 0 mm], O3: [260 mm, 40 mm]}}
links:
  crank: {points: [O1, A], length: 40 mm}
  coupler: {points: [A, B], length: 120 mm}
  rocker: {points: [O2, B], length: 80 mm}
  rod: {points: [B, C], length: 70 mm}
  arm: {points: [O3, C], length: 80 mm}
assembly: {B: left, C: left}
driver: {turn: crank, about: O1, speed: 60 rpm, start: 30 deg}
cycle: rock
"""


def joint_b(theta: float) -> tuple[float, float]:
    """B of the four-bar, left of the way from A to O2, by two circles."""
    ax, ay = 40 * cos(theta), 40 * sin(theta)
    dx, dy = 120 - ax, -ay
    d = hypot(dx, dy)
    along = (d * d + 120**2 - 80**2) / (2 * d)
    aside = sqrt(120**2 - along**2)
    return ax + (along * dx - aside * dy) / d, ay + (along * dy + aside * dx) / d


def spare(theta: float) -> float:
    """By how much rod and arm are longer than the way from B to O3 (150 mm together)."""
    x, y = joint_b(theta)
    return 150 - hypot(x - 260, y - 40)


def test_a_six_bar_rocks_where_its_second_dyad_is_in_line() -> None:
    theta = np.linspace(radians(30) - pi, radians(30) + pi, 20001)
    signs = np.array([spare(each) >= 0 for each in theta])
    middle = len(theta) // 2
    assert signs[middle] and not signs.all()
    edges = []
    for step in (-1, 1):
        k = middle
        while signs[k]:
            k += step
        inside, outside = theta[k - step], theta[k]
        for _unused in range(80):
            half = 0.5 * (inside + outside)
            inside, outside = (half, outside) if spare(half) >= 0 else (inside, half)
        edges.append(inside)
    free = MARGIN * (edges[1] - edges[0])
    assert ends(lw.loads(SIX_BAR)) == pytest.approx((edges[0] + free, edges[1] - free), abs=1e-8)


SLID = """
format: 1
frame: {points: {O: [0 mm, 0 mm], P: [300 mm, 0 mm]}}
links:
  block: {points: [A]}
  rod: {points: [A, B], length: 250 mm}
  lever: {points: [P, B], length: 150 mm}
joints: {way: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: block, at: A}}
assembly: {B: left}
driver: {slide: way, speed: 50 mm/s}
cycle: rock
"""


def test_a_slid_driver_rocks_too() -> None:
    """A on the y axis, 300 mm from P: rod and lever reach 400 mm."""
    farthest = sqrt(0.4**2 - 0.3**2)
    machine = lw.loads(SLID)
    inner = (1 - 2 * MARGIN) * farthest
    assert ends(machine) == pytest.approx((-inner, inner), abs=1e-9)
    assert lw.solve_motion(machine).positions.period == pytest.approx(4 * inner / 0.05)


def test_the_range_is_that_of_the_drawing() -> None:
    """Where a drawing shows the driver it is its range that counts, not that about the start of the law."""
    drawn = SLIDER_CRANK.replace(", START", "").replace(
        "assembly: {B: forward}",
        f"drawing: {{A: [{-100 * cos(0.2)} mm, {100 * sin(0.2)} mm], B: [{-100 * cos(0.2) - 59.2} mm, 10 mm]}}",
    )
    low, high = ends(lw.loads(drawn))
    assert low > pi / 2 and high < 3 * pi / 2


def test_given_ends_rock_a_machine_that_could_turn() -> None:
    machine = lw.loads(lw.read_document("gallery:crank_rocker").text + "cycle: {rock: [-30 deg, 20 deg]}\n")
    assert ends(machine) == pytest.approx((radians(-30), radians(20)))
    assert machine.dimension("cycle.rock.from") == pytest.approx(radians(-30))
    moved = machine.with_dimensions({"cycle.rock.to": radians(40)})
    assert ends(moved) == pytest.approx((radians(-30), radians(40)))


def test_a_driver_that_turns_fully_turns_and_says_so() -> None:
    text = lw.read_document("gallery:crank_rocker").text
    machine = lw.loads(text + "cycle: rock\n")
    rocking, turning = lw.solve_motion(machine, steps=24), lw.solve_motion(lw.loads(text), steps=24)
    assert rocking.input == pytest.approx(turning.input)
    assert rocking.notes[0].code == "cycle.rock_turns"
    found = checked_text(text + "cycle: rock\n", "model").findings
    assert [each.severity for each in found if each.code == "cycle.rock_turns"] == ["note"]


def test_changed_dimensions_move_the_limits() -> None:
    machine = four_bar().with_dimensions({"coupler.length": 0.12})
    limit = acos((60**2 + 220**2 - 210**2) / (2 * 60 * 220))
    assert ends(machine)[1] == pytest.approx((1 - 2 * MARGIN) * limit, abs=1e-9)
    turns = machine.with_dimensions({"coupler.length": 0.2})
    assert lw.solve_motion(turns, steps=12).positions.coordinates["driver"][2] == pytest.approx(np.zeros(12))


@pytest.mark.parametrize("cycle", ["rock", "{rock: limits, margin: 0.05}", "{rock: [-30 deg, 20 deg]}"])
def test_a_text_that_is_written_is_read_back(cycle: str) -> None:
    machine = four_bar(cycle)
    again = lw.loads(dump(machine))
    assert again.cycle == machine.cycle
    assert ends(again, 12) == pytest.approx(ends(machine, 12))


def test_at_an_input_the_rates_are_those_of_the_way_out() -> None:
    over, at = lw.solve_motion(four_bar(), steps=360), lw.solve_motion(four_bar(), at=0.3)
    rates: Floats = over.positions.coordinates["driver"][1]
    expected = np.interp(0.3, over.input[:181], rates[:181])
    assert at.positions.coordinates["driver"][1] == pytest.approx([expected], rel=1e-3)
    with refused("motion.beyond_rock"):
        lw.solve_motion(four_bar("{rock: [-30 deg, 20 deg]}"), at=1.0)


@pytest.mark.parametrize(
    ("cycle", "driver", "code"),
    [
        ("rock", "{turn: crank, about: O1, position: '1 rad*sin(t*1 rad/s)'}", "choice"),
        ("rock", "{turn: crank, about: O1, speed: 0 rpm}", "choice"),
        ("{rock: [30 deg, 20 deg]}", STEADY, "range"),
        ("{rock: [0 deg, 20 deg], margin: 0.1}", STEADY, "choice"),
        ("{margin: 0.1}", STEADY, "choice"),
        ("{rock: limits, margin: 0.5}", STEADY, "range"),
        ("{rock: ends}", STEADY, "unknown-word"),
        ("{rock: limits, turns: 2}", STEADY, "choice"),
    ],
)
def test_what_cannot_rock_is_refused(cycle: str, driver: str, code: str) -> None:
    with refused(code):
        four_bar(cycle, driver)


def test_several_drivers_are_refused() -> None:
    text = FOUR_BAR.replace("driver: DRIVER", f"drivers: {{one: {STEADY}, two: {OTHER}}}")
    with refused("choice"):
        lw.loads(text + "cycle: rock\n")


def test_a_slide_without_a_limit_is_refused_with_what_to_write() -> None:
    text = "format: 1\nframe: {points: {O: [0 m, 0 m]}}\nlinks: {block: {points: [A]}}\n"
    text += "driver: {slide: way, speed: 1 m/s}\n"
    text += "joints: {way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: A}}\n"
    with refused("motion.no_limit", low="0 mm", high="50 mm"):
        lw.solve_motion(lw.loads(text + "cycle: rock\n"))
    assert ends(lw.loads(text + "cycle: {rock: [0 mm, 50 mm]}\n")) == pytest.approx((0.0, 0.05))


def test_designs_of_other_limits_are_refused_designs_of_the_same_ends_are_not() -> None:
    with refused("study.moves_limits"):
        lw.study(four_bar(), {"coupler.length": [0.11, 0.12]}, metrics=["swing_angle"])
    with refused("study.moves_limits"):
        lw.sensitivity(four_bar(), of=["swing_angle"], by=["coupler.length"])
    assert lw.sensitivity(four_bar(), of=["driver.effort rms"], by=["coupler.mass"])
    with refused("study.moves_positions"):
        lw.study(four_bar(), {"driver.speed": [5.0, 6.0]}, metrics=["swing_angle"])
    found = lw.study(four_bar("{rock: [-30 deg, 30 deg]}"), {"coupler.length": [0.11, 0.12]}, metrics=["swing_angle"])
    assert found.ok.all()
    assert found["swing_angle"][0] != found["swing_angle"][1]


def test_a_living_page_has_the_closed_cycle_and_its_inputs() -> None:
    motion = lw.solve_motion(four_bar(), steps=120)
    (model,) = page_data([(motion, None)], "en")["models"]
    positions = model["positions"]
    assert positions["closed"] and positions["steady"] is None and positions["drift"] == pytest.approx(0.0)
    assert positions["period"] == pytest.approx(motion.positions.period)
    assert "cycle: rock" in model["text"]


def test_the_schema_knows_the_word_and_the_table() -> None:
    forms = json_schema()["properties"]["cycle"]["oneOf"]
    assert {"const": "rock"} in forms
    assert any(set(each.get("properties", ())) == {"rock", "margin"} for each in forms)
    json.dumps(forms)
