"""What motion, ranges and ranks refuse, or can say nothing of: with the reason and what to do."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from dataclasses import replace
from math import cos, radians, sin, sqrt

import numpy as np
import pytest
from tests import store
from tests.failures.limited_machines import SWUNG, TRIAD, fourbar
from tests.refusals import refused

import linkwright as lw
from linkwright import Mechanism, input_range


def test_words_left_from_another_driver_name_the_drawing() -> None:
    """Driven at its last link, a Stephenson linkage is a triad, which takes no word but a drawing."""
    text = """
format: 1
name: Stephenson
frame: {points: {A: [0 mm, 0 mm], D: [100 mm, 0 mm], G: [180 mm, 0 mm]}}
links:
  l2: {points: [A, B], length: 30 mm}
  l3: {points: {B: [0 mm, 0 mm], C: [90 mm, 0 mm], E: [60 mm, 50 mm]}}
  l4: {points: [D, C], length: 60 mm}
  l5: {points: [E, F], length: 70 mm}
  l6: {points: [G, F], length: 80 mm}
assembly: {C: left}
driver: {turn: l2, about: A, speed: 10 rpm}
"""
    lw.solve_motion(lw.loads(text.replace("length: 70 mm", "length: 120 mm")))
    with refused("motion.word_in_open", joint="C", drawn="B: [x, y], C: [x, y], E: [x, y]"):
        lw.solve_motion(lw.loads(text.replace("l2, about: A", "l6, about: G")))


def test_a_group_without_closed_form_needs_its_points_drawn() -> None:
    text = re.sub("drawing:.*\n", "", TRIAD).replace("START", "160").replace("SPEED", "1")
    drawn = "A: [x, y], B: [x, y], C: [x, y]"
    with refused("motion.needs_drawing", links=("crank", "coupler", "rocker", "bar"), level=3, drawn=drawn):
        lw.solve_motion(lw.loads(text))


@pytest.mark.parametrize("cycle", [{"turns": 1.0}, {"start": 0.1, "end": 0.3}])
def test_a_cycle_by_a_coordinate_that_does_not_grow_evenly_is_refused(cycle: dict[str, float]) -> None:
    machine = lw.loads(SWUNG)
    assert machine.cycle is not None
    with refused("motion.cycle_by_coordinate", name="driver"):
        lw.solve_motion(replace(machine, cycle=replace(machine.cycle, duration=None, **cycle)), steps=5)


TWO_BARS = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [3 m, 0 m]}}
links: {left: {points: [O1, A], length: 1 m}, right: {points: [O2, A], length: 1 m}}
assembly: {A: left}
"""
FIVE_BARS = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [1 m, 0 m], G: [0 m, 0 m]}}
links:
  left_crank: {points: [O1, A], length: 0.3 m}
  left_bar: {points: [A, B], length: 0.5 m}
  right_bar: {points: [C, B], length: 0.5 m}
  right_slide: {points: [C]}
joints: {bed: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: right_slide, at: C}}
drivers:
  left: {turn: left_crank, about: O1, speed: 1 rad/s}
  right: {slide: bed, speed: 2 m/s}
assembly: {B: left}
"""


def test_a_truss_that_does_not_close_is_refused_at_its_only_position() -> None:
    with refused(
        "motion.refused",
        distance="3000 mm",
        first="1000 mm",
        second="1000 mm",
        reach="2000 mm",
        missing="1000 mm",
        where="its only position",
    ):
        lw.solve_motion(lw.loads(TWO_BARS))


@pytest.mark.parametrize(
    ("left", "right", "failed"),
    [([90, 180, 170], [0.9, 1.3, 0.5], {}), ([180, 90, 120], [1.3, 0.9, 1.25], {"failed": 2, "steps": 3})],
)
def test_a_refusal_names_the_first_failing_position_by_all_its_drivers(
    left: list[float], right: list[float], failed: dict[str, object]
) -> None:
    links = ("left_bar", "right_bar")
    with refused("motion.refused_told", links=links, missing="600 mm", **failed) as caught:
        lw.solve_motion(lw.loads(FIVE_BARS), at={"left": np.radians(left), "right": right})
    assert [each.values for each in caught.value.values["parts"]] == [
        {"name": "left", "value": "180°"},
        {"name": "right", "value": "1300 mm"},
    ]


def test_a_refusal_of_a_crank_tells_its_range() -> None:
    with refused("motion.refused_told", link="crank"):
        lw.solve_motion(fourbar(3, 2, 2.5, 4, start=0), steps=12)


def test_a_table_without_pandas_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    motion = lw.solve_motion(lw.loads(SWUNG), steps=5)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with refused("motion.needs_pandas"):
        motion.to_dataframe()


def test_a_dyad_that_is_out_of_reach_behind_a_triad_leaves_no_place_to_begin() -> None:
    """Stretched at 140°, while the drawing and the start are at 160°."""
    x, y = 300 + 300 * cos(radians(65)), 200 + 300 * sin(radians(65))
    half = 0.5 * sqrt(140**2 + 300**2 - 2 * 140 * 300 * cos(radians(75)))
    text = re.sub("driver:.*\\ncycle:.*", "driver: {turn: output, about: O3, speed: 1 rad/s, start: 160 deg}", TRIAD)
    text = text.replace("O3: [300 mm, 200 mm]", f"O3: [300 mm, 200 mm], O5: [{x!r} mm, {y!r} mm]")
    bars = f"  arm: {{points: [D, F], length: {half!r} mm}}\n  leg: {{points: [O5, F], length: {half!r} mm}}\n"
    text = text.replace("drawing:", bars + "assembly: {F: left}\ndrawing:")
    with refused("range.not_assembled", driver="driver", place="160°"):
        input_range(lw.loads(text))


TWO_CYLINDERS = """
format: 1
name: Two cylinders
frame: {points: {O: [0 m, 0 m], C: [0 m, -1 m]}}
links:
  boom: {points: {O: [0 m, 0 m], E: [3 m, 0 m], H: [1 m, 0 m], K: [2 m, 0 m]}}
  stick: {points: {E: [0 m, 0 m], L: [0 m, 0.5 m]}}
  barrel1: {points: [C]}
  rod1: {points: [H]}
  barrel2: {points: [K]}
  rod2: {points: [L]}
joints:
  lift: {kind: prismatic, guide: barrel1, through: C, direction: 0 deg, block: rod1, at: H}
  dig: {kind: prismatic, guide: barrel2, through: K, direction: 0 deg, block: rod2, at: L}
drawing: {H: [1 m, 0 m], E: [3 m, 0 m], K: [2 m, 0 m], L: [3 m, 0.5 m]}
drivers:
  raise: {slide: lift, position: "1.4 m + 0.1 m*sin(2*pi*t/(1 s))"}
  curl: {slide: dig, position: "1.4 m + 0.2 m*sin(2*pi*t/(1 s))"}
cycle: {duration: 1 s}
"""


def test_of_several_drivers_the_range_of_the_one_that_fails_is_told() -> None:
    """K and E are 1 m apart, E and L 0.5 m: the second cylinder goes from 0.5 to 1.5 m, and 1.6 m are asked for; the
    first one's range was told."""
    ends = {
        "link": "rod2",
        "low": "500 mm",
        "high": "1500 mm",
        "reasons": "with the other drivers at their start {reason}",
    }
    with refused("motion.refused_told", lw.PositionError, **ends):
        lw.solve_motion(lw.loads(TWO_CYLINDERS))


def test_a_point_of_links_welded_there_is_one_point() -> None:
    """C needs no link before it, and both links' names of it mean the same place."""
    text = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 50 mm}
  rod: {points: [A, C], length: 180 mm}
  arm: {points: {C: [0 mm, 0 mm], B: [40 mm, 30 mm]}}
  rocker: {points: {O2: [0 mm, 0 mm], B: [150 mm, 0 mm]}}
joints:
  held: {kind: weld, links: [rod, arm], at: C}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
    motion = lw.solve_motion(lw.loads(text), steps=8)
    place = motion.point("C").position
    assert np.array_equal(place, motion.point("rod.C").position)
    assert place == pytest.approx(motion.point("arm.C").position, abs=1e-15)
    assert np.hypot(*(place - motion.point("A").position).T) == pytest.approx(0.18, rel=1e-12)


@pytest.mark.parametrize(
    ("asked", "code", "values"),
    [
        (
            lambda m: lw.solve_motion(m, at="30 deg"),
            "motion.text_for_number",
            {"text": "30 deg", "right": "0.523599"},
        ),
        (lambda m: lw.solve_motion(m, times=["1 s"]), "motion.text_for_number", {"text": "1 s", "right": "1"}),
        (lambda m: lw.solve_motion(m, failures="ignore"), "motion.no_failures", {"value": "ignore"}),
        (
            lambda m: m.with_dimensions({"coupler.length": "60 mm"}),
            "model.set_no_number",
            {"address": "coupler.length", "text": "'60 mm'"},
        ),
    ],
)
def test_texts_for_numbers_and_other_ways_with_failures_are_told(
    asked: Callable[[Mechanism], object], code: str, values: dict[str, object]
) -> None:
    with refused(code, **values):
        asked(store.machine("crank_rocker"))
