"""Laws of drivers: exact rates by differences, what repeats and what ends, refusals, files."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.drivers.base import LAWS, Law
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.drivers.table import TableLaw

MODEL = """
format: 1
frame: {points: {O: [0 m, 0 m], G: [2 m, 0 m]}}
parameters: {a: 0.3, w: 2}
links:
  crank: {points: [O, A], length: 1 m}
  ram: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: ram, at: B}}
drivers:
  turn: {turn: crank, about: O, LAW}
  push: {slide: guide, speed: 0.25 m/s, start: 0.1 m}
cycle: {duration: 2 s}
"""
TABLE = (
    "table: {time: [0.5 s, 0.8 s, 1.4 s, 2 s, 2.5 s], position: [0 deg, 20 deg, 15 deg, 60 deg, 40 deg],"
    " interpolation: HOW}"
)
RISES = "program: [{rise: 50 deg, over: 1 s, law: cycloidal}, {fall: 50 deg, over: 0.5 s, law: cycloidal}]"
THROW = RISES.replace("fall: 50 deg", "rise: 30 deg").replace(
    "law: cycloidal}]", "law: polynomial_5, velocity: 90 deg/s}]"
)
LAWS_WRITTEN = {
    "speed": "speed: -30 rpm, start: 40 deg",
    "expression": 'position: "a*sin(w*t/(1 s))*(1 rad) + 20 deg*t/(1 s)"',
    "cubic table": TABLE.replace("HOW", "cubic"),
    "periodic table": TABLE.replace("HOW", "periodic").replace("40 deg]", "360 deg]"),
    "straight table": TABLE.replace("HOW", "linear"),
    "program": RISES,
}
each = pytest.mark.parametrize("name", LAWS_WRITTEN)


def law(name: str) -> Law:
    return lw.loads(MODEL.replace("LAW", LAWS_WRITTEN[name])).drivers["turn"].law


@each
def test_rates_are_the_derivatives(name: str) -> None:
    found, h = law(name), 1e-4
    t = np.array([0.61, 0.97, 1.31, 1.77, 2.21])
    q, rate, second = found.coordinate(t)
    ahead, before = found.coordinate(t + h), found.coordinate(t - h)
    assert rate == pytest.approx((ahead[0] - before[0]) / (2 * h), abs=2e-6)
    assert second == pytest.approx((ahead[1] - before[1]) / (2 * h), abs=2e-5)
    assert [found.at(each) for each in t] == pytest.approx(q, abs=1e-15)


@each
def test_a_law_is_written_as_it_was_read(name: str) -> None:
    first = lw.loads(MODEL.replace("LAW", LAWS_WRITTEN[name]))
    again = lw.loads(lw.dump(first)).drivers["turn"].law
    t = np.linspace(0.5, 2.5, 9)
    assert np.array(again.coordinate(t)) == pytest.approx(np.array(first.drivers["turn"].law.coordinate(t)))
    assert type(again) is type(first.drivers["turn"].law) is LAWS[again.key]


def test_a_table_goes_through_its_rows_and_a_periodic_one_again_further_on() -> None:
    times, angles = np.array([0.5, 0.8, 1.4, 2.0, 2.5]), np.radians([0, 20, 15, 60, 40])
    for name in ("cubic table", "periodic table", "straight table"):
        q = law(name).coordinate(times)[0]
        assert q[:-1] == pytest.approx(angles[:-1], abs=1e-14)
        assert q[-1] == pytest.approx(2 * np.pi if name == "periodic table" else angles[-1], abs=1e-14)
        assert law(name).natural_duration() == 2.0
    again = law("periodic table")
    for laps in (-2, 1, 3):
        later = again.coordinate(times + 2.0 * laps)
        assert later[0] == pytest.approx(again.coordinate(times)[0] + laps * 2 * np.pi, abs=1e-12)
        assert later[1][0] == pytest.approx(later[1][-1], abs=1e-12)
        assert later[2][0] == pytest.approx(later[2][-1], abs=1e-10)
    assert again.span() == (-math.inf, math.inf) and law("cubic table").span() == (0.5, 2.5)
    straight = law("straight table")
    slopes = np.diff(angles) / np.diff(times)
    q, rate, second = straight.coordinate(np.array([0.5, 0.65, 1.1, 1.4, 2.5]))
    assert rate == pytest.approx(slopes[[0, 0, 1, 2, 3]]) and (second == 0).all()
    assert q[1] == pytest.approx(0.5 * angles[1])


@pytest.mark.parametrize("name", ["cubic table", "straight table"])
def test_a_table_says_nothing_beyond_its_times(name: str) -> None:
    found = law(name)
    edge = 1e-10
    q, _, _ = found.coordinate(np.array([0.5 - edge, 2.5 + edge]))
    assert q == pytest.approx(np.radians([0, 40]), abs=1e-8)
    for t in ([0.4, 1.0], [1.0, 2.6]):
        with refused("loads.table_range", first=0.5, last=2.5, begin=t[0], end=t[1]):
            found.coordinate(np.array(t))


def test_a_program_is_repeated_where_its_velocity_goes_on() -> None:
    """50° up and down again in 1.5 s; without the way down it goes on from where it has come."""
    found = law("program")
    t = np.array([0.2, 0.9, 1.3])
    assert found.natural_duration() == 1.5 and found.span() == (-math.inf, math.inf)
    assert found.coordinate(t + 3.0)[0] == pytest.approx(found.coordinate(t)[0], abs=1e-12)
    climbs = lw.loads(MODEL.replace("LAW", RISES.replace("fall", "rise"))).drivers["turn"].law
    assert climbs.coordinate(t + 1.5)[0] == pytest.approx(climbs.coordinate(t)[0] + math.radians(100), abs=1e-12)


def test_a_program_that_begins_and_ends_with_the_same_velocity_goes_on_with_it() -> None:
    even = "program: [{rise: 90 deg, over: 1.5 s, law: constant_velocity}]"
    found = lw.loads(MODEL.replace("LAW", even)).drivers["turn"].law
    assert found.span() == (-math.inf, math.inf)
    assert found.coordinate(np.array([4.0]))[0] == pytest.approx(math.radians(240), abs=1e-12)


def test_a_program_that_ends_in_motion_says_nothing_beyond_its_end() -> None:
    found = lw.loads(MODEL.replace("LAW", THROW)).drivers["turn"].law
    q, rate, _ = found.coordinate(np.array([0.0, 1.0, 1.5]))
    assert q == pytest.approx(np.radians([0, 50, 80]), abs=1e-9)
    assert rate == pytest.approx(np.radians([0, 0, 90]), abs=1e-9)
    assert found.span() == (0.0, 1.5) == (0.0, found.natural_duration())
    for t in ([-0.1, 1.0], [1.0, 1.6]):
        with refused("loads.table_range", first=0.0, last=1.5, begin=t[0], end=t[1]):
            found.coordinate(np.array(t))


def test_of_constant_speed() -> None:
    found = law("speed")
    speed = -math.pi
    assert found.constant_speed == pytest.approx(speed) and found.natural_duration() == pytest.approx(2.0)
    assert found.at(0.3) == pytest.approx(math.radians(40) + 0.3 * speed)
    assert found.time_at(np.array([math.radians(40), math.radians(40) + 0.7 * speed])) == pytest.approx([0, 0.7])
    assert found.dimensions() == {"speed": pytest.approx(speed), "start": pytest.approx(math.radians(40))}
    for other in (ConstantSpeed(0.0, 0.2), ConstantSpeed(1.0, rotary=False)):
        assert other.natural_duration() is None
    assert ConstantSpeed(0.0, 0.2).time_at(np.array([0.2, 0.0, -5.0])).tolist() == [0.0, 0.0, 0.0]
    push = lw.loads(MODEL.replace("LAW", "speed: 1 rad/s")).drivers["push"].law
    assert (push.at(2.0), push.rotary) == (pytest.approx(0.6), False)
    for name, own in (("expression", {}), ("cubic table", {}), ("program", {"start": 0.0})):
        assert law(name).constant_speed is None and law(name).dimensions() == own


def test_a_law_follows_changed_dimensions_and_parameters() -> None:
    mechanism = lw.loads(MODEL.replace("LAW", LAWS_WRITTEN["expression"]))
    t = np.array([0.4, 1.1])
    before = mechanism.drivers["turn"].law.coordinate(t)[0]
    after = mechanism.with_dimensions({"a": 0.6}).drivers["turn"].law.coordinate(t)[0]
    assert before == pytest.approx(0.3 * np.sin(2 * t) + math.radians(20) * t)
    assert after == pytest.approx(0.6 * np.sin(2 * t) + math.radians(20) * t)
    faster = lw.loads(MODEL.replace("LAW", LAWS_WRITTEN["speed"])).with_dimensions(
        {"turn.speed": 3.0, "push.start": 0.4}
    )
    assert faster.drivers["turn"].law == replace(law("speed"), speed=3.0)
    assert faster.drivers["push"].law.at(0.0) == 0.4


def test_a_spline_through_points_of_a_cubic_is_that_cubic() -> None:
    t = np.array([0.0, 0.3, 0.7, 1.2, 1.5])
    cubic = np.polynomial.Polynomial([0.2, -1.0, 0.4, 0.9])
    found = TableLaw(tuple(t), tuple(cubic(t)))
    at = np.linspace(0, 1.5, 7)
    for order, values in every(enumerate(found.coordinate(at)), least=3):
        assert values == pytest.approx(cubic.deriv(order)(at) if order else cubic(at), abs=1e-12)


@pytest.mark.parametrize("first", [0.0, 0.7, -2.5])
def test_a_periodic_table_with_drift_gains_it_every_period(first: float) -> None:
    """A shaft that turns once per period and wobbles: q = 2πt/T + 0.1 sin(2πt/T), known with both rates."""
    period = 0.8
    times = first + np.linspace(0.0, period, 41)
    turn = 2 * np.pi / period

    def shaft(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        phase = turn * t
        return phase + 0.1 * np.sin(phase), turn * (1 + 0.1 * np.cos(phase)), -0.1 * turn**2 * np.sin(phase)

    law = TableLaw(tuple(times.tolist()), tuple(shaft(times)[0].tolist()), "periodic")
    t = np.linspace(-3.3, 5.1, 500)
    h, fourth = period / 40, 0.1 * turn**4  # bounds of Hall and Meyer (1976)
    bounds = (5 / 384 * h**4 * fourth, h**3 / 24 * fourth, 3 / 8 * h**2 * fourth)
    for found, expected, error in zip(law.coordinate(t), shaft(t), bounds, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=error)
    before, after = law.coordinate(t), law.coordinate(t + 3 * period)
    np.testing.assert_allclose(after[0] - before[0], 3 * 2 * np.pi, rtol=0, atol=1e-10)
    np.testing.assert_allclose(after[1], before[1], rtol=0, atol=1e-8)
    assert law.span() == (-np.inf, np.inf)
