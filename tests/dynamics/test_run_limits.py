"""Runs to where a machine cannot be put together any further, also by links without mass."""

from __future__ import annotations

import pytest

import linkwright as lw

TETHER = """
format: 1
name: Rod on a tether
frame: {points: {O: [0 m, 0 m], P: [1 m, 0.3 m]}}
links:
  rod: {points: [O, T], length: 1 m, mass: 3 kg, inertia: 0.25 kg·m²}
  one: {points: [P, K], length: 0.4 m}
  two: {points: [T, K], length: 0.4 m}
assembly: {K: left}
driver: {turn: rod, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
"""


def test_two_light_bars_end_a_rods_fall_where_they_are_stretched() -> None:
    """|T - P| = 0.8 m at -29.3°: what a taut tether does to the rod is an impact, of which the model says nothing."""
    with pytest.raises(lw.LinkwrightError, match=r"cannot go on after 0\.26"):
        lw.run(lw.loads(TETHER), duration=1.0)


def test_before_that_the_rod_falls_freely() -> None:
    found = lw.run(lw.loads(TETHER), duration=0.25)
    assert found.motion(times=[0.0]).link("rod").angular_acceleration[0] == pytest.approx(-1.5 * 9.81)
