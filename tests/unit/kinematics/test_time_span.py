"""How long a cycle is that no file can ask for: backwards, without a start, by a table that ends too early."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians

import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright.kinematics.cycle import over_cycle, time_span
from linkwright.kinematics.positions import CycleError
from linkwright.mechanism.cycle import Cycle

CRANK = """
format: 1
frame: {points: {O: [0 m, 0 m], Q: [3 m, 0 m], G: [0 m, 0 m]}}
links: {a: {points: [O, A], length: 1 m}, b: {points: [Q, B], length: 1 m}, c: {points: [C]}}
joints: {way: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: c, at: C}}
drivers:
  first: {turn: a, about: O, LAW}
  second: {turn: b, about: Q, LAW}
  third: {slide: way, table: {time: [0 s, 1 s, 2 s], position: [0 m, 0.1 m, 0 m], interpolation: linear}}
"""
TURNING = CRANK.replace("LAW", "speed: 2 rad/s, start: 30 deg")


def test_a_table_that_ends_before_the_slowest_driver_is_back() -> None:
    assert time_span(lw.loads(TURNING)) == (0.0, pytest.approx(pi), False)


@pytest.mark.parametrize(
    ("cycle", "begin", "duration"),
    [
        (Cycle(start=radians(90), end=radians(-30)), radians(30), radians(-60)),
        (Cycle(end=radians(90)), 0.0, radians(30)),
    ],
)
def test_between_two_angles(cycle: Cycle, begin: float, duration: float) -> None:
    loaded = lw.loads(TURNING)
    drivers = {name: driver for name, driver in loaded.drivers.items() if name == "first"}
    mechanism = replace(loaded, drivers=drivers, cycle=cycle)
    assert time_span(mechanism) == (pytest.approx(begin), pytest.approx(duration), False)
    found = over_cycle(mechanism, 4)
    assert (found.count, found.closed, found.cycle, found.period) == (5, False, True, None)
    assert found.coordinates["first"][0][-1] == pytest.approx(cycle.end, abs=1e-14)


def test_turns_of_a_driver_that_follows_a_law_are_refused() -> None:
    law = 'position: "0.1 rad + 0 rad*t/(1 s)"'
    with refused("motion.cycle_by_coordinate", CycleError, name="first"):
        time_span(replace(lw.loads(CRANK.replace("LAW", law)), cycle=Cycle(turns=1.0)))
