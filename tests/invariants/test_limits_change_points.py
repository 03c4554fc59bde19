"""Motion through change points: smooth, in the same family, with the closed forms of special four-bars."""

from __future__ import annotations

from math import acos, pi, radians

import numpy as np
import pytest
from tests.every import every
from tests.invariants.fourbars import fourbar

import linkwright as lw


@pytest.mark.parametrize("steps", [12, 45, 359, 360, 720])
@pytest.mark.parametrize("start", [20.0, 111.0, 20.5])
def test_parallelogram_stays_a_parallelogram(steps: int, start: float) -> None:
    motion = lw.solve_motion(fourbar(1, 2, 1, 2, start=start), steps=steps, failures="mark")
    turn = motion.link("rocker").angle - motion.link("crank").angle
    assert np.nanmax(np.abs(turn)) < 2e-9
    assert np.nanmax(np.abs(motion.link("rocker").angular_velocity - 1.0)) < 1e-9
    assert np.nanmax(np.abs(motion.link("coupler").angular_velocity)) < 1e-9
    assert (~motion.ok).sum() <= 2
    assert [note.code for note in motion.notes] == ["cycle.change"] * 2


@pytest.mark.parametrize("steps", [45, 359, 360])
def test_antiparallelogram_stays_crossed(steps: int) -> None:
    """Rocker and crank turn against each other: tan(φ/2) = -k tan(θ/2) with k = (d + a)/(d - a) or its inverse."""
    a, d = 1.0, 2.0
    motion = lw.solve_motion(fourbar(a, d, a, d, start=20, mode="right"), steps=steps, failures="mark")
    theta = motion.input[motion.ok]
    rocker = motion.link("rocker").angle[motion.ok]
    k = np.tan(rocker[0] / 2) / np.tan(theta[0] / 2)
    assert min(abs(abs(k) - 3), abs(abs(k) - 1 / 3)) < 1e-12
    expected = 2 * np.arctan2(k * np.sin(theta / 2), np.cos(theta / 2))
    assert np.abs(np.exp(1j * rocker) - np.exp(1j * expected)).max() < 1e-9


@pytest.mark.parametrize("steps", [72, 359, 360])
@pytest.mark.parametrize(("a", "d"), [(1.0, 2.0), (2.0, 1.0)])
def test_kite_keeps_its_symmetry(steps: int, a: float, d: float) -> None:
    """B is the mirror image of O1 in the line A-O2, all the way round."""
    motion = lw.solve_motion(fourbar(a, a, d, d, start=20), steps=steps, failures="mark")
    pin, b = motion.point("A").position[motion.ok], motion.point("B").position[motion.ok]
    line = np.array([d, 0.0]) - pin
    along = line * ((-pin * line).sum(axis=1) / (line**2).sum(axis=1))[:, None]
    mirrored = 2 * (pin + along)
    assert np.abs(b - mirrored).max() < 1e-8
    assert [note.code for note in motion.notes] == ["cycle.change"] * 2


@pytest.mark.parametrize("steps", [37, 100, 359, 360])
def test_one_change_point_a_turn(steps: int) -> None:
    """Crank 1, frame 4 as long as coupler 3 and rocker 2 together; whether a position lies on 180° or not, angle,
    rate and acceleration fit together across it."""
    motion = lw.solve_motion(fourbar(1, 3, 2, 4, start=0), steps=steps, failures="mark")
    ok = motion.ok
    rocker, time = motion.link("rocker"), motion.time[ok]
    angle, rate, second = rocker.angle[ok], rocker.angular_velocity[ok], rocker.angular_acceleration[ok]
    h = np.diff(time)
    hermite = 0.5 * h * (rate[1:] + rate[:-1]) + h**2 / 12 * (second[:-1] - second[1:])
    assert np.abs(np.diff(angle) - hermite).max() < 60 * h.max() ** 3
    assert [note.code for note in motion.notes] == ["cycle.change", "cycle.two_cycles"]


@pytest.mark.parametrize(
    "times", [(0.0, 2.0, 200), (1.0, 0.0, 30), (2.0, 0.0, 100), (0.0, 0.45, 20), (0.55, 1.0, 20)]
)
def test_limits_at_times_of_ones_own(times: tuple[float, float, int]) -> None:
    """Crank and coupler 1 + 3 in line: the rocker stands at π - acos(1/4), and a turn's other half is its mirror."""
    begin, end, count = times
    motion = lw.solve_motion(
        fourbar(1, 3, 2, 4, start=0), times=2 * pi * np.linspace(begin, end, count), failures="mark"
    )
    limits = lw.limit_positions(motion, "rocker")
    stretched, first = pi - acos(0.25), acos(7 / 8)
    expected = {
        round(turn, 9): angle
        for turn, angle in ((first / (2 * pi), stretched), (1 - first / (2 * pi), -stretched))
        if min(begin, end) < turn < max(begin, end)
    }
    assert len(limits) == len(expected) > 0
    for limit in limits:
        angle = expected[round(limit.time / (2 * pi), 9)]
        assert np.exp(1j * limit.value) == pytest.approx(np.exp(1j * angle), abs=1e-9)


def test_all_links_equal() -> None:
    """Rhombus: at one place the links line up, at the other the pins A and O2 meet; it stays a parallelogram."""
    for steps in (359, 360):
        motion = lw.solve_motion(fourbar(1, 1, 1, 1, start=20), steps=steps, failures="mark")
        turn = motion.link("rocker").angle - motion.link("crank").angle
        assert np.nanmax(np.abs(turn)) < 1e-9
        assert np.nanmax(np.abs(motion.link("rocker").angular_velocity - 1.0)) < 1e-8
        assert [note.code for note in motion.notes] == ["cycle.change", "cycle.meeting"]


@pytest.mark.parametrize("start", [0.0, 25.0, 340.0])
def test_kite_whose_pins_meet_within_its_range(start: float) -> None:
    """Crank and frame 2 m, coupler and rocker 1 m: one smooth stretch from -60° to 60° through A on O2, wherever
    the closed cycle begins."""
    motion = lw.solve_motion(fourbar(2, 1, 1, 2, start=start), steps=359, failures="mark")
    turned = np.degrees(motion.input) % 360
    crank = np.radians((turned[motion.ok] + 180) % 360)
    order = np.argsort(crank)
    rocker = np.unwrap(motion.link("rocker").angle[motion.ok][order])
    rate = motion.link("rocker").angular_velocity[motion.ok][order]
    middle = slice(20, -20)
    assert np.abs(np.gradient(rocker, crank[order]) - rate)[middle].max() < 1e-2
    assert "cycle.two_cycles" not in [note.code for note in every(motion.notes)]


def test_two_parallelograms_in_a_row() -> None:
    """Both groups line up at the same crank angles; the second one's sign follows the first one's."""
    mechanism = lw.loads("""
format: 1
name: locomotive
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m], O3: [3.5 m, 0 m]}}
links:
  wheel_1: {points: [O1, A], length: 1 m}
  rod_1: {points: [A, B], length: 2 m}
  wheel_2: {points: [O2, B], length: 1 m}
  rod_2: {points: [B, C], length: 1.5 m}
  wheel_3: {points: [O3, C], length: 1 m}
assembly: {B: left, C: left}
driver: {turn: wheel_1, about: O1, speed: 1 rad/s, start: 20.3 deg}
""")
    motion = lw.solve_motion(mechanism, steps=360)
    for wheel in ("wheel_2", "wheel_3"):
        assert np.abs(motion.link(wheel).angle - motion.input).max() < 1e-9
        assert np.abs(motion.link(wheel).angular_velocity - 1.0).max() < 1e-9


def test_single_positions_follow_the_word_of_the_file() -> None:
    """Positions far apart are no way: each is assembled as the file says."""
    mechanism = fourbar(1, 3, 2, 4, start=0)
    motion = lw.solve_motion(mechanism, at=np.radians([30.0, 100.0, 300.0]))
    single = lw.solve_motion(mechanism, at=radians(300.0))
    assert motion.link("rocker").direction[2] == pytest.approx(single.link("rocker").direction[0])
    assert motion.link("rocker").angle[2] % (2 * pi) == pytest.approx(single.link("rocker").angle[0] % (2 * pi))
