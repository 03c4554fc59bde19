"""Mechanisms with more drivers than mobility, or with drivers against each other, are refused with the places."""

from __future__ import annotations

import re

import pytest

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


def refusal(text: str) -> str:
    with pytest.raises(lw.LinkwrightError) as caught:
        lw.solve_motion(lw.loads(text))
    return str(caught.value)


def named(said: str) -> set[str]:
    """The links that a refusal says are determined more than once."""
    found = re.search(r"the links ((?:'\w+'(?:, )?)+) are determined more than once", said)
    assert found is not None, said
    return set(re.findall(r"'(\w+)'", found[1]))


@pytest.mark.parametrize("drivers", [TWO, ON_COUPLER])
def test_two_drivers_on_mobility_one_name_what_they_determine_twice(drivers: str) -> None:
    said = refusal(FOURBAR + drivers)
    assert "mobility 1 and two drivers" in said
    assert named(said) == {"crank", "coupler", "rocker"} and "remove a driver" in said


def test_two_drivers_of_one_coordinate_name_each_other() -> None:
    said = refusal(FOURBAR + SAME)
    assert 'drivers.second: the driver "first" drives the same coordinate' in said


def test_a_driven_structure_cannot_move() -> None:
    said = refusal(FOURBAR + BAR + ONE)
    assert "mobility 0 by Grübler's formula, so it cannot be driven, but one driver is given" in said
    assert named(said) == {"crank", "coupler", "rocker", "brace"}


def test_one_part_driven_twice_and_another_not_at_all_is_refused() -> None:
    """Mobility three and two drivers: the first loop is driven twice, while the bars at the end are free."""
    said = refusal(FIVEBAR.replace("[O3, C]", "[C, D]") + TWO)
    assert named(said) == {"crank", "coupler", "rocker"}
