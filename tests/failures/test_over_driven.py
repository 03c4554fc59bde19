"""Mechanisms with more drivers than mobility, or with drivers against each other, are refused with the places."""

from __future__ import annotations

import pytest
from tests.refusals import findings, refused, said

import linkwright as lw

FOURBAR = """
format: 1
name: four-bar
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.35 m}
  rocker: {points: [O2, B], length: 0.25 m}
"""
BAR = "  brace: {points: [O1, B], length: 0.45 m}\n"
ONE = "driver: {turn: crank, about: O1, speed: 1 rad/s}\n"
TWO = """
drivers:
  first: {turn: crank, about: O1, speed: 1 rad/s}
  second: {turn: rocker, about: O2, speed: 1 rad/s}
"""
ON_COUPLER = TWO.replace("turn: rocker, about: O2,", "turn: coupler, about: A, relative_to: crank,")
SAME = TWO.replace("turn: rocker, about: O2,", "turn: crank, about: O1,")
FIVEBAR = """
format: 1
name: five-bar and a four-bar on it
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0 m], O3: [1 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.35 m}
  rocker: {points: [O2, B], length: 0.25 m}
  bar: {points: [B, C], length: 0.5 m}
  end: {points: [O3, C], length: 0.3 m}
"""


def twice(text: str, **values: object) -> set[str]:
    """The links that a refusal says are determined more than once."""
    with refused("mobility.excess", lw.StructureError, **values) as caught:
        lw.solve_motion(lw.loads(text))
    return {each.strip("'") for each in caught.value.values["links"]}


@pytest.mark.parametrize("drivers", [TWO, ON_COUPLER])
def test_two_drivers_on_mobility_one_name_what_they_determine_twice(drivers: str) -> None:
    told = twice(FOURBAR + drivers, mobility=1, count=2, drivers="two drivers")
    assert told == {"crank", "coupler", "rocker"}


def test_two_drivers_of_one_coordinate_name_each_other() -> None:
    said(
        findings(FOURBAR + SAME),
        "duplicate",
        "drivers.second",
        message='the driver "{name}" drives the same coordinate',
        name="first",
    )


def test_a_driven_structure_cannot_move() -> None:
    told = twice(
        FOURBAR + BAR + ONE,
        mobility=0,
        count=1,
        why=("{name!r} has mobility {mobility} by Grübler's formula, so it cannot be driven, but {drivers} is set"),
    )
    assert told == {"crank", "coupler", "rocker", "brace"}


def test_one_part_driven_twice_and_another_not_at_all_is_refused() -> None:
    """Mobility three and two drivers: the first loop is driven twice, while the bars at the end are free."""
    told = twice(FIVEBAR.replace("[O3, C]", "[C, D]") + TWO, mobility=3, count=2)
    assert told == {"crank", "coupler", "rocker"}
