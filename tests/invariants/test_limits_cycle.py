"""What holds for limit positions of any mechanism: rates, order, independence from the steps and the start."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import acos, degrees, pi, radians, sqrt

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from tests.every import every
from tests.invariants.driven_slides import ARM, driven
from tests.reference.general_case import general_case
from tests.store import machine as stored
from tests.store import motion as moved
from tests.store import names

import linkwright as lw
from linkwright import LimitPosition, limit_positions

CHANGE_POINTS = {"change_point_fourbar", "truss", "two_bars_equilibrium"}


def outputs(mechanism: lw.Mechanism) -> list[str]:
    """Links, but blocks on the frame, whose names mean their displacement; guides, mass centres."""
    guides = [name for name, joint in mechanism.joints.items() if joint.kind == "prismatic"]
    blocks = {link for name in guides if "frame" in (joined := mechanism.joints[name].joined) for link in joined}
    points = [f"{link}.{point}.{axis}" for link in mechanism.links for point in ("centre",) for axis in "xy"]
    known = [text for text in points if text.split(".")[1] in mechanism.links[text.split(".")[0]].points]
    return [*(name for name in mechanism.links if name not in blocks), *guides, *known]


def rates_at(mechanism: lw.Mechanism, output: str, found: tuple[LimitPosition, ...]) -> np.ndarray:
    motion = lw.solve_motion(mechanism, times=[each.time for each in found])
    if output in mechanism.links:
        return motion.link(output).angular_velocity
    return motion.joint(output).velocity


@pytest.mark.rotating
@pytest.mark.parametrize("name", [name for name in names() if name not in CHANGE_POINTS])
def test_gallery(name: str) -> None:
    """At every limit the rate is zero; in a closed cycle maxima and minima take turns; values bound the cycle."""
    mechanism, motion = stored(name), moved(name, 120)
    for output in every(outputs(mechanism)):
        found = limit_positions(motion, output)
        kinds = [each.kind for each in found]
        assert all(a != b for a, b in pairwise(kinds))
        if motion.positions.closed and found:
            assert kinds.count("max") == kinds.count("min")
        if not found or name.startswith("dyad") or motion.states:
            continue
        is_link = output in mechanism.links
        values = motion.link(output).angle if is_link else motion.joint(output).displacement
        rates = motion.link(output).angular_velocity if is_link else motion.joint(output).velocity
        assert np.abs(rates_at(mechanism, output, found)).max() <= 1e-11 * np.abs(rates).max()
        if motion.positions.closed and abs(values[-1] - values[0]) < pi:
            span = np.ptp(values)
            assert max(each.value for each in found) >= values.max() - 1e-12 * span
            assert min(each.value for each in found) <= values.min() + 1e-12 * span


@pytest.mark.parametrize(
    "name", ["jaw_crusher_sixbar", "theo_jansen_leg", "triad", "class_four_group", "shaper_quick_return"]
)
def test_independent_of_steps(name: str) -> None:
    for output in every(outputs(stored(name))):
        fine = limit_positions(moved(name), output)
        for steps in (40, 121):
            coarse = limit_positions(moved(name, steps), output)
            assert [each.kind for each in coarse] == [each.kind for each in fine]
            assert np.allclose([e.input for e in coarse], [e.input for e in fine], rtol=0, atol=5e-13)


@pytest.mark.parametrize("start", [-200.0, 33.557309761920706, 90.0, 216.8698976458, 350.0])
def test_independent_of_start(start: float) -> None:
    """Also where the cycle begins exactly at a limit: none is lost, none counts twice."""
    begun = stored("crank_rocker").with_dimensions({"driver.start": radians(start)})
    for endpoint in (False, True):
        motion = lw.solve_motion(begun, endpoint=endpoint)
        found = limit_positions(motion, "rocker")
        assert sorted(round(degrees(each.input) % 360, 8) for each in found) == [33.55730976, 216.86989765]
        for each in found:
            after = motion.time[each.index + 1] if each.index + 1 < motion.steps else np.inf
            assert motion.time[each.index] <= each.time <= after


def test_backward_motion_gives_the_same_places() -> None:
    mechanism = stored("crank_rocker")
    back = mechanism.with_dimensions({"driver.speed": -mechanism.dimension("driver.speed")})
    ahead = limit_positions(moved("crank_rocker"), "rocker")
    behind = limit_positions(lw.solve_motion(back), "rocker")
    assert {(round(e.input % (2 * pi), 12), e.kind) for e in ahead} == {
        (round(e.input % (2 * pi), 12), e.kind) for e in behind
    }


def test_touching_zero_is_no_limit() -> None:
    """s = t - sin(2πt)/2π comes to rest at t = 1 s and goes on."""
    mechanism = driven('position: "0.1 m*(t/(1 s) - sin(2*pi*t/(1 s))/(2*pi))"')
    for steps in (16, 25, 200):
        assert limit_positions(lw.solve_motion(mechanism, steps=steps), "guide") == ()


def test_rest_between_rise_and_fall_is_one_limit() -> None:
    positions = "[0 m, 0.1 m, 0.1 m, 0 m, 0 m]"
    law = f"table: {{time: [0 s, 0.5 s, 1 s, 1.5 s, 2 s], position: {positions}, interpolation: linear}}"
    found = limit_positions(lw.solve_motion(driven(law), steps=200), "A.x")
    assert [each.kind for each in found] == ["max", "min"]
    assert [each.value for each in found] == pytest.approx([0.1, 0.0], abs=1e-15)
    assert [each.time for each in found] == pytest.approx([0.75, 1.75], abs=0.01)


def test_kink_of_a_linear_table_is_a_limit() -> None:
    law = "table: {time: [0 s, 0.7 s, 2 s], position: [0 m, 0.1 m, 0 m], interpolation: linear}"
    low, high = sorted(limit_positions(lw.solve_motion(driven(law), steps=33), "guide"), key=lambda e: e.value)
    assert (low.kind, high.kind) == ("min", "max")
    assert high.time == pytest.approx(0.7, abs=1e-12)
    assert min(low.time, 2.0 - low.time) == pytest.approx(0.0, abs=1e-12)  # the cycle's end is its beginning
    assert (low.value, high.value) == pytest.approx((0.0, 0.1), abs=1e-12)


def test_two_limits_between_neighbouring_positions() -> None:
    """s = x³ - 3 ε² x with x = t - 0.93 reverses at x = ±ε, between two positions 0.1 s apart."""
    law = 'position: "1 m*((t/(1 s) - 0.93)^3 - 3*0.03^2*(t/(1 s) - 0.93))"'
    found = limit_positions(lw.solve_motion(driven(law), steps=20), "guide")
    assert [each.kind for each in found] == ["max", "min"]
    assert [each.time for each in found] == pytest.approx([0.9, 0.96], abs=1e-12)


def test_ends_of_an_open_range_are_no_limits() -> None:
    mechanism = stored("crank_rocker")
    motion = lw.solve_motion(mechanism, at=np.radians(np.arange(40.0, 200.0)))
    assert limit_positions(motion, "rocker") == ()
    wider = lw.solve_motion(mechanism, at=np.radians(np.arange(20.0, 200.0)))
    (found,) = limit_positions(wider, "rocker")
    assert degrees(found.input) == pytest.approx(33.557309761920706, abs=1e-12)


def test_law_in_time() -> None:
    """The ladder's head is highest where its foot passes the wall, lowest where the foot turns."""
    motion = moved("double_slider", 77)
    found = limit_positions(motion, "wall")
    highest = [each for each in found if each.kind == "max"]
    lowest = [each for each in found if each.kind == "min"]
    assert [each.value for each in highest] == pytest.approx([0.5] * len(highest), abs=1e-15)
    assert [each.value for each in lowest] == pytest.approx([sqrt(0.5**2 - 0.3**2)] * 2, abs=1e-15)
    assert [each.time for each in lowest] == pytest.approx([0.5, 1.5], abs=1e-15)


def test_limits_at_change_points() -> None:
    """The pins of a parallelogram are outermost where its links line up."""
    mechanism = replace(stored("parallelogram"), cycle=None)
    for steps in (45, 360, 361):
        motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
        for output, shift in (("A.x", 0.0), ("B.x", 2.0)):
            found = limit_positions(motion, output)
            assert [each.kind for each in found] == ["min", "max"]
            assert [degrees(each.input) for each in found] == pytest.approx([180.0, 360.0], abs=1e-6)
            assert [each.value for each in found] == pytest.approx([shift - 1.0, shift + 1.0], abs=1e-10)


CHANGE_POINT = """
format: 1
name: change point
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3 m}
  rocker: {points: [O2, B], length: 2 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""


def test_two_turns_through_a_change_point_show_the_limits_of_both_modes() -> None:
    """After one turn the four-bar is in its other mode. Crank and coupler are stretched once in each mode: by the law
    of cosines 28.9550° on both sides of the frame line; folded they pass the change point."""
    mechanism = lw.loads(CHANGE_POINT)
    one = limit_positions(lw.solve_motion(mechanism, steps=359), "rocker")
    twice = lw.loads(f"{CHANGE_POINT}cycle: {{turns: 2}}\n")
    two = limit_positions(lw.solve_motion(twice, steps=719), "rocker")
    assert [each.input for each in one] == pytest.approx([e.input for e in two if e.input < 2 * pi], abs=1e-9)
    assert sum(each.kind == "max" for each in two) == sum(each.kind == "min" for each in two) > 0
    assert degrees(two[0].input) == pytest.approx(degrees(acos(0.875)), abs=1e-12)
    mirrored = sorted((2 * pi - each.input) % (4 * pi) for each in two)
    assert mirrored == pytest.approx(sorted(each.input for each in two), abs=1e-9)


TURNED = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.3 m}}
driver: {turn: crank, about: O, speed: SPEED rad/s, start: START deg}
"""


@pytest.mark.parametrize("steps", [9, 10, 24])
@pytest.mark.parametrize(("speed", "start"), [(2.0, 0.0), (-2.0, 10.0), (0.5, 90.0), (3.0, -200.0)])
@pytest.mark.parametrize(
    ("turns", "endpoint"), [(1.0, False), (1.0, True), (2.0, False), (0.7, False), (1.55, False)]
)
def test_a_circle_reverses_at_its_four_ends(
    steps: int, speed: float, start: float, turns: float, endpoint: bool
) -> None:
    """x = r cos θ and y = r sin θ: place, time, value, kind and the position before, on plain numbers."""
    text = TURNED.replace("SPEED", f"{speed}").replace("START", f"{start}")
    mechanism = lw.loads(f"{text}cycle: {{turns: {turns}}}\n")
    motion = lw.solve_motion(mechanism, steps=steps, endpoint=endpoint)
    closed, begin = turns in (1.0, 2.0), radians(start)
    time, period = motion.time, turns * 2 * pi / abs(speed)
    for axis, shift in (("x", 0.0), ("y", pi / 2)):
        expected = []
        for k in range(-12, 13):
            at = (k * pi + shift - begin) / speed
            inside = -1e-12 < at < period - 1e-12 if closed else 1e-12 < at < period - 1e-12
            if inside:
                expected.append((max(at, 0.0), "max" if k % 2 == 0 else "min"))
        found = limit_positions(motion, f"A.{axis}")
        assert [each.kind for each in found] == [kind for _, kind in sorted(expected)]
        for each, (at, kind) in zip(found, sorted(expected), strict=True):
            assert each.time == pytest.approx(at, abs=1e-14)
            assert each.input == pytest.approx(begin + speed * at, abs=1e-14)
            assert each.value == pytest.approx(0.3 if kind == "max" else -0.3, abs=1e-16)
            last = period if each.index == len(time) - 1 else time[each.index + 1]
            assert time[each.index] <= each.time < last + 1e-14


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize(("length", "start"), [(0.26, 2.0), (0.26, 358.0), (0.28, 0.5), (0.251, 2.0), (0.24, 2.0)])
def test_two_reversals_between_neighbours_of_a_machine_at_constant_speed(
    length: float, start: float, speed: float
) -> None:
    """x = cos θ + ρ cos 2θ has its maxima at 0° and, for ρ > 1/4, at 180°, and minima where cos θ = -1/(4 ρ); at
    18 steps two of these lie between two positions. For ρ < 1/4 the rate dips and does not reach zero."""
    text = ARM.replace("LENGTH", f"{length}").replace("SPEED", f"{speed}").replace("START", f"{start}")
    found = limit_positions(lw.solve_motion(lw.loads(text), steps=18), "T.x")
    if length > 0.25:
        side = pi - acos(1.0 / (4.0 * length))
        expected = {0.0: "max", pi: "max", side: "min", 2 * pi - side: "min"}
    else:
        expected = {0.0: "max", pi: "min"}
    assert len(found) == len(expected)
    for at, kind in expected.items():
        each = min(found, key=lambda e: abs(np.exp(1j * e.input) - np.exp(1j * at)))
        assert each.kind == kind
        assert each.value == pytest.approx(np.cos(at) + length * np.cos(2 * at), abs=1e-13)
        assert abs(np.exp(1j * each.input) - np.exp(1j * at)) < 1e-11
    assert [each.time for each in found] == sorted(each.time for each in found)


@pytest.mark.parametrize(("excess", "count"), [(2.2e-4, 4), (2e-5, 2)])
def test_a_way_back_of_less_than_a_ten_millionth_is_no_reversal(excess: float, count: int) -> None:
    """The rate 1 - (1 + δ) cos 2πt is below zero for √(2 δ)/2π around every second: back by 1e-7 m, or by 3e-9 m, of
    0.2 m."""
    law = f'position: "0.1 m*(t/(1 s) - {1.0 + excess}*sin(2*pi*t/(1 s))/(2*pi))"'
    found = limit_positions(lw.solve_motion(driven(law), steps=20), "guide")
    side = acos(1.0 / (1.0 + excess)) / (2 * pi)
    expected = [side, 1.0 - side, 1.0 + side, 2.0 - side] if count == 4 else [side, 2.0 - side]
    assert [each.time for each in found] == pytest.approx(expected, abs=1e-9)
    assert [each.kind for each in found] == ["min", "max"] * (count // 2)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("first", "apart", "third"),
    [
        (0.91, 0.06, 1.7),
        (0.905, 0.09, 0.3),
        (0.95, 0.01, 1.13),
        (0.93, 0.03, 0.86),
        (0.901, 0.02, -2.0),
        (0.97, 0.025, 1.03),
        (0.942, 0.055, 40.0),
    ],
)
def test_two_reversals_of_a_rate_that_is_a_cubic_are_always_found(
    first: float, apart: float, third: float, sign: float
) -> None:
    """Two zeros between the positions at 0.9 s and 1 s, one elsewhere, of which those within the cycle count."""
    zeros = sorted([first, first + apart, third])
    rate = np.polynomial.Polynomial.fromroots(zeros) * sign
    terms = " + ".join(f"({c!r})*(t/(1 s))^{k + 1}/{k + 1}" for k, c in enumerate(map(float, rate.coef)))
    found = limit_positions(lw.solve_motion(driven(f'position: "1 m*({terms})"'), steps=20), "guide")
    assert [each.time for each in found] == pytest.approx([t for t in zeros if 0.0 < t < 2.0], abs=1e-9)
    bent = rate.deriv()
    assert [each.kind for each in found] == ["max" if bent(each.time) < 0.0 else "min" for each in found]


@pytest.mark.parametrize(("half", "expected"), [(1e-3, [1.7]), (5e-3, [0.995, 1.005, 1.7])])
def test_a_way_back_to_nowhere_before_a_single_reversal_is_none(half: float, expected: list[float]) -> None:
    """Back by (4/3) 0.7 ε³ on a way of 0.7⁴/12 between the reversals: 5e-8 and 6e-6 of it."""
    terms = np.polynomial.Polynomial.fromroots([1.0 - half, 1.0 + half, 1.7])
    law = " + ".join(f"({c!r})*(t/(1 s))^{k + 1}/{k + 1}" for k, c in enumerate(map(float, terms.coef)))
    found = limit_positions(lw.solve_motion(driven(f'position: "1 m*({law})"'), steps=20), "guide")
    assert [each.time for each in found] == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize("least", [1e-7, 0.01, 0.3])
def test_a_rate_that_comes_near_to_zero_between_two_positions_is_none(least: float) -> None:
    law = f'position: "1 m*((t/(1 s) - 0.96)^3/3 + {least * 1e-3}*t/(1 s))"'
    assert limit_positions(lw.solve_motion(driven(law), steps=20), "guide") == ()


@pytest.mark.parametrize("steps", [24, 60, 499])
def test_all_reversals_are_found_however_many_turns_lie_between_two_positions(steps: int) -> None:
    """A table with two near times makes its spline run some turns; reversals of the rocker by a dense closed form."""
    times, places = [0.0, 0.25, 0.4, 0.402, 0.7, 1.0], [0.0, 20.0, -10.0, 30.0, 15.0, 0.0]
    model = lw.loads(f"""
format: 1
frame: {{points: {{O: [0 m, 0 m], Q: [0.3 m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: 0.1 m}}
  coupler: {{points: [A, B], length: 0.28 m}}
  rocker: {{points: [Q, B], length: 0.2 m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O, table: {{time: [{", ".join(f"{t} s" for t in times)}],
  position: [{", ".join(f"{p} deg" for p in places)}], interpolation: cubic}}}}
""")
    input_ = CubicSpline(times, np.radians(places))
    t = np.linspace(0.0, 1.0, 400_001)
    reach = 0.1 * np.stack([np.cos(input_(t)), np.sin(input_(t))]) - np.array([[0.3], [0.0]])
    length = np.hypot(*reach)
    corner = np.arccos((length**2 + 0.2**2 - 0.28**2) / (2.0 * length * 0.2))
    angle = np.unwrap(np.arctan2(reach[1], reach[0]) - corner)
    turned = np.flatnonzero(np.diff(np.sign(np.diff(angle)))) + 1
    assert np.ptp(input_(t)) > 12.0
    found = limit_positions(lw.solve_motion(model, steps=steps), "rocker")
    inner = [each for each in found if 1e-9 < each.time < 1.0 - 1e-9]
    assert [each.time for each in inner] == pytest.approx(t[turned].tolist(), abs=2.0 * t[1])


@pytest.mark.rotating
@pytest.mark.parametrize("seed", [3, 20])
def test_limits_lie_in_what_is_reached(seed: int) -> None:
    """Machines with tables as laws that reach a part of their cycle: nothing beyond its ends is a limit."""
    motion = lw.solve_motion(lw.loads(general_case(seed).text), steps=60, failures="mark")
    assert motion.ok.any() and not motion.ok.all()
    limits = [each for output in outputs(motion.mechanism) for each in limit_positions(motion, output)]
    for each in every(limits):
        assert np.isfinite(each.value) and motion.ok[each.index]


@pytest.mark.rotating
@pytest.mark.parametrize(
    "name", ["swing_conveyor", "dyad_rpp", "theo_jansen_leg", "planetary_two_inputs", "scotch_yoke"]
)
def test_numbers_of_a_cycle_in_few_positions_are_those_in_many(name: str) -> None:
    """Two positions hide turns, and of four reversals close to each other some."""
    model = stored(name)
    many, *few = (
        {(row.metric, row.subject): row.value for row in lw.metrics(lw.solve_forces(model, steps=steps))}
        for steps in (360, 1, 2, 4, 7)
    )
    for found in few:
        assert found == pytest.approx(many, rel=1e-6, abs=1e-9)


def test_positions_out_of_reach_are_counted_as_they_were_asked_for() -> None:
    short = stored("crank_rocker").with_dimensions({"coupler.length": 1.5})
    table = lw.metrics(lw.solve_motion(short, steps=8, failures="mark"))
    (note,) = table.notes
    assert (note.code, note.values["reached"], note.values["count"]) == ("metrics.part_reached", 3, 8)


@pytest.mark.rotating
@pytest.mark.parametrize("seed", [100, 135, 138, 139])
def test_numbers_of_what_is_reached_are_those_for_any_number_of_positions(seed: int) -> None:
    """Machines that come out of reach in a step, some of them before guides become parallel in it."""
    model, known = lw.loads(general_case(seed).text), list[dict[tuple[str, str], list[float]]]()
    for steps in (24, 361):
        solved = lw.solve_forces(lw.solve_motion(model, steps=steps, failures="mark"))
        found: dict[tuple[str, str], list[float]] = {}
        for row in lw.metrics(solved):
            found.setdefault((row.metric, row.subject), []).append(row.value)
        known.append(found)
        assert not solved.motion.ok.all() and found["range_of_motion", next(iter(model.drivers))]
    few, many = known
    assert few.keys() == many.keys()
    for key, values in few.items():
        if key[0] != "singularity":
            assert values == pytest.approx(many[key], rel=1e-6, abs=1e-9), key
