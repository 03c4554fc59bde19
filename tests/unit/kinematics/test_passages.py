"""Change points and gaps of a cycle: what they cut off, which signs they turn, how finely they are sought."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.invariants.fourbars import fourbar

import linkwright as lw
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.kinematics.change_points import (
    _divided,
    closes,
    crossings,
    cut_off,
    mark_singular,
    nearness,
    outputs_at_crossings,
    parts,
    signs,
    way,
)
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.passing import ChangePointCrossing
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.reach_messages import passage_notes
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.cycle import Cycle


def row(n: int, step: float = 0.1, closed: bool = False, cycle: bool = False, rotary: bool = True) -> Positions:
    q = step * np.arange(n)
    one = np.ones(n)
    period = n * step if closed else None
    return Positions(q, {"driver": (q, one, 0 * one)}, {"driver": rotary}, period, cycle)


def crossing(
    before: int, kind: Any = "change", share: float = 0.5, group: str = "a+b", **more: Any
) -> ChangePointCrossing:
    place = before + share
    return ChangePointCrossing(
        group, before, before + 1, share, 0.0, kind, 0.1 * place, more.get("flips", (place, np.inf))
    )


@pytest.mark.parametrize(
    ("codes", "closed", "gaps", "breaks", "off"),
    [
        ([0, 0, 1, 0, 0, 0], False, [], set(), [0, 0, 0, 1, 1, 1]),
        ([0, 0, 1, 0, 0, 0], True, [], set(), [0, 0, 0, 0, 0, 0]),
        ([0, 0, 1, 0, 1, 0], True, [], set(), [0, 0, 0, 1, 0, 0]),
        ([0, 0, -1, 0, 0, 0], False, [], set(), [0, 0, 0, 0, 0, 0]),
        ([2, 0, 0, 1, 0, 0], False, [], set(), [0, 0, 0, 0, 1, 1]),
        ([0, 0, 0, 0, 0, 0], False, [3], set(), [0, 0, 0, 0, 1, 1]),
        ([0, 0, 0, 0, 0, 0], True, [3], set(), [0, 0, 0, 0, 0, 0]),
        ([0, 0, 0, 0, 0, 0], True, [1, 3], set(), [0, 0, 1, 1, 0, 0]),
        ([0, 0, 0, 0, 0, 0], True, [5], set(), [0, 0, 0, 0, 0, 0]),
        ([0, 0, 0, 0, 0, 0], True, [], {2}, [0, 0, 0, 0, 0, 0]),
        ([0, 0, 0, 0, 0, 0], True, [], {1, 3}, [0, 0, 1, 1, 0, 0]),
        ([0, 0, 0, 0, 0, 0], False, [], {1}, [0, 0, 1, 1, 1, 1]),
        ([0, 0, 0, 1, 0, 0], True, [0], set(), [0, 1, 1, 0, 0, 0]),
        ([1, 1, 1, 1, 1, 1], True, [], set(), [0, 0, 0, 0, 0, 0]),
    ],
)
def test_what_cannot_be_reached_from_the_first_solved_position_is_cut_off(
    codes: list[int], closed: bool, gaps: list[int], breaks: set[int], off: list[int]
) -> None:
    found = cut_off(np.array(codes, float), row(6, closed=closed), breaks | set(gaps))
    assert found.tolist() == off
    apart = row(6, step=2.0)
    assert not cut_off(np.array(codes, float), apart, breaks | set(gaps)).any()


def test_positions_are_one_way_if_they_follow_each_other_closely_or_are_a_cycle() -> None:
    assert row(3, 0.5).is_way and not row(3, 0.6).is_way and not row(2, 0.1).is_way
    assert row(3, 0.6, closed=True).is_way and row(3, 2.0, cycle=True).is_way and row(2, 2.0, cycle=True).is_way
    assert row(3, 5.0, rotary=False).is_way


def test_a_group_has_its_other_sign_behind_every_change_point() -> None:
    passing = [crossing(1), crossing(3, "meeting"), crossing(2, "gap"), crossing(4, group="c+d", flips=(0.5, 4.5))]
    found = signs(passing, {"a+b": 1.0, "c+d": -1.0, "e": 1.0}, 6)
    assert {name: sign.tolist() for name, sign in found.items()} == {
        "mode:a+b": [1, 1, -1, -1, 1, 1],
        "mode:c+d": [-1, 1, 1, 1, 1, -1],
    }
    assert signs([crossing(0)], {"a+b": -1.0}, 3)["mode:a+b"].tolist() == [-1, 1, 1]
    at = signs(passing, {"a+b": 1.0, "c+d": -1.0}, np.array([1.4, 1.6]))
    assert at["mode:a+b"].tolist() == [1, -1]
    assert signs([crossing(-1, share=1.0)], {"a+b": 1.0}, 2)["mode:a+b"].tolist() == [1, 1]
    assert [p.touches for p in passing] == [True, True, False, True] == [not p.barred for p in passing]
    assert passing[1].place == 3.5


def test_a_cycle_closes_if_every_group_passes_an_even_number() -> None:
    assert closes([]) and closes([crossing(1), crossing(3)]) and closes([crossing(1, "gap")])
    assert not closes([crossing(1)]) and not closes([crossing(1), crossing(2, group="c")])
    assert closes([crossing(1, flips=(1.5, 4.0))])


def test_positions_on_a_change_point_are_singular() -> None:
    structure = SimpleNamespace(groups=[SimpleNamespace(name="x"), SimpleNamespace(name="a+b")])
    codes = np.zeros(5)
    mark_singular(
        codes, [crossing(1), crossing(1, share=1.0), crossing(2, "gap", 1.0), crossing(4, share=1.0)], structure
    )  # type: ignore[arg-type]
    assert codes.tolist() == [-2, 0, -2, 0, 0]


def test_change_points_and_gaps_are_said_once_with_their_place() -> None:
    along = row(8)
    twice = [replace(crossing(1, share=0.0), at=np.pi / 3), replace(crossing(1, share=0.0), at=np.pi / 3)]
    (said,) = passage_notes(twice, along)
    assert "a, b" in said and "driver = 60°" in said
    assert "driver = 250 mm" in passage_notes([replace(crossing(1), at=0.25)], row(8, rotary=False))[0]
    assert "driver = 0°" in passage_notes([replace(crossing(1), at=-1e-13)], along)[0]
    kinds = [passage_notes([crossing(1, kind)], along)[0].code for kind in ("change", "meeting", "gap", "pole")]
    assert len(set(kinds)) == 4
    assert len(passage_notes([crossing(1)], row(8, closed=True))) == 2
    assert len(passage_notes([crossing(1), crossing(2)], row(8, closed=True))) == 2
    assert len(passage_notes([crossing(1)], along)) == 1


PUSHED = """
format: 1
frame: {points: {O: [0 m, 0 m], G: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 2 m}
  slide: {points: [B]}
joints: {bed: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slide, at: B}}
drawing: {A: [0 m, 1 m], B: [1.7320508 m, 0 m]}
driver: {slide: bed, LAW}
cycle: {duration: 1 s}
"""


@pytest.mark.parametrize("steps", [1, 2, 3, 4, 20])
@pytest.mark.parametrize(
    ("law", "pace"),
    [
        ("speed: 30 m/s, start: 1.7320508 m", 30.0),
        ("speed: -0.3 m/s, start: 1.7320508 m", 0.3),
        ("position: 1.7 m + 0.1 m*sin(2*pi*t/(1 s) + 1)", 0.2 * np.pi),
    ],
)
def test_steps_of_a_sliding_driver_are_shares_of_the_size(law: str, pace: float, steps: int) -> None:
    """0.05 of the size is one part, and 24 are there at least; the law's peak rate counts, not that of positions."""
    mechanism = lw.loads(PUSHED.replace("LAW", law))
    solver, positions = MotionSolver(mechanism), over_cycle(mechanism, steps)
    by_size = int(np.ceil(pace / steps / mechanism.size / 0.05))
    assert parts(solver, positions) == max(by_size, -(-24 // steps))
    assert parts(solver, replace(positions, cycle=False)) == 1


@pytest.mark.parametrize(("steps", "count"), [(12, 11), (36, 4), (125, 2), (126, 1), (720, 1)])
def test_steps_of_a_crank_are_divided_into_parts_of_a_twentieth(steps: int, count: int) -> None:
    mechanism = store.machine("crank_rocker")
    assert parts(MotionSolver(mechanism), over_cycle(mechanism, steps)) == count


def test_places_between_positions_follow_the_laws_or_lines() -> None:
    mechanism = store.machine("crank_rocker")
    solver, positions = MotionSolver(mechanism), over_cycle(mechanism, 36)
    ((q, rate, _),) = way(solver, positions)(np.array([3.25, 35.5])).coordinates.values()
    begin, speed = positions.coordinates["driver"][0][0], positions.coordinates["driver"][1][0]
    assert q == pytest.approx(begin + np.sign(speed) * np.array([3.25, 35.5]) * np.pi / 18, abs=1e-12)
    assert rate == pytest.approx([speed, speed])
    own = np.array([0.0, 0.3, 0.5, 0.4])
    free = replace(positions, time=np.zeros(4), coordinates={"driver": (own, own**2, 2 * own)}, period=None)
    rows = way(solver, free)(np.array([0.5, 2.5, 3.0])).coordinates["driver"]
    assert [each.tolist() for each in rows] == [
        pytest.approx([0.15, 0.45, 0.4]),
        pytest.approx([0.045, 0.205, 0.16]),
        pytest.approx([0.3, 0.9, 0.8]),
    ]


@pytest.mark.parametrize(
    ("lengths", "kinds", "ends"),
    [
        ((1, 2, 1, 2), ["change", "change"], [0.0, np.pi]),
        ((2, 2, 1, 1), ["change", "change"], [0.0, np.pi]),
        ((1, 2, 2, 1), ["meeting"], [0.0]),
        ((1, 3, 2.5, 2), [], []),
        ((2, 2, 1.5, 2), ["gap"], None),
    ],
)
@pytest.mark.parametrize("start", [20.0, 170.0])
@pytest.mark.parametrize("steps", [5, 24, 361])
def test_the_same_passages_are_found_however_coarse_the_steps(
    lengths: tuple[float, float, float, float], kinds: list[str], ends: list[float] | None, steps: int, start: float
) -> None:
    mechanism = fourbar(*lengths, start=start)
    coarse, fine = (crossings(MotionSolver(mechanism), over_cycle(mechanism, n), None) for n in (steps, 720))
    if kinds != ["gap"]:
        assert sorted(p.kind for p in coarse) == sorted(p.kind for p in fine) == kinds
        angles, exact = (
            sorted(float(np.angle(np.exp(1j * (p.at - 0.1)))) + 0.1 for p in found) for found in (coarse, fine)
        )
        assert angles == pytest.approx(exact, abs=1e-7)
        assert ends is None or angles == pytest.approx(ends, abs=1e-7)
        assert [p.place / steps for p in coarse] == pytest.approx([p.place / 720 for p in fine], abs=1e-7)
        assert [p.flips[0] / steps for p in coarse] == pytest.approx([p.flips[0] / 720 for p in fine], abs=1e-7)
    for p in coarse:
        assert 0 <= p.before < steps and p.after == (p.before + 1) % steps and 0.0 < p.share <= 1.0
        assert p.at == pytest.approx(np.radians(start) + 2 * np.pi * p.place / steps, abs=1e-9)


def test_divided_steps_are_equal_parts_of_the_same_way() -> None:
    mechanism = store.machine("crank_rocker")
    solver = MotionSolver(mechanism)
    for steps, closed, count in ((4, True, 20), (4, False, 21)):
        whole = over_cycle(mechanism, steps)
        along = whole if closed else replace(over_cycle(mechanism, steps, endpoint=True), period=None)
        fine = _divided(solver, along, 5)
        assert (fine.count, fine.closed, fine.cycle, fine.period) == (count, closed, True, along.period)
        assert fine.time[::5] == pytest.approx(along.time, abs=1e-15)
        assert np.diff(fine.time) == pytest.approx(np.full(count - 1, (along.time[1] - along.time[0]) / 5))


def test_how_near_a_dyad_comes_is_the_least_of_its_square_and_of_its_pins_distance() -> None:
    """Four-bar: sin² of the transmission angle, and the distance of A and O2 over the size."""
    mechanism = fourbar(1, 3, 2.5, 2, start=20.0)
    motion = lw.solve_motion(mechanism, steps=36)
    solver = MotionSolver(mechanism)
    program = Program.of(solver.motion.trace, {"near": nearness(solver)})
    known = motion.solver.nominal.parameters
    found = NumpyProgram(program).run([known[name] for name in program.parameters], motion.positions.arrays)[0]
    gap = motion.point("A").position - [2.0, 0.0]
    square = (gap**2).sum(axis=1)
    cosine = (3**2 + 2.5**2 - square) / (2 * 3 * 2.5)
    assert found == pytest.approx(np.minimum(1.0 - cosine**2, square / mechanism.size**2), rel=1e-10)
    assert (found < 1.0 - cosine**2 - 1e-6).any() and (found > square / mechanism.size**2 - 1e-12).any()


def test_what_shows_passages_is_named_where_steps_are_fine_and_guides_stay_apart() -> None:
    def shown(mechanism: lw.Mechanism, steps: int) -> tuple[str, ...] | None:
        return outputs_at_crossings(MotionSolver(mechanism), over_cycle(mechanism, steps))

    names = shown(fourbar(1, 3, 2.5, 2, start=20.0), 360)
    assert names == ("quality:coupler+rocker", "fact:coupler+rocker|distance²")
    assert shown(fourbar(1, 3, 2.5, 2, start=20.0), 24) is None
    assert shown(store.machine("tangent_mechanism"), 720) is None


def found_between(mechanism: lw.Mechanism, begin: float, end: float, steps: int) -> list[ChangePointCrossing]:
    """Passages of an open way between two crank angles, deg."""
    cycle = Cycle(start=np.radians(begin), end=np.radians(end))
    mechanism = replace(mechanism, cycle=cycle)
    positions = over_cycle(mechanism, steps)
    assert not positions.closed and positions.count == steps + 1
    return crossings(MotionSolver(mechanism), positions, None)


@pytest.mark.parametrize("steps", [7, 40, 131])
@pytest.mark.parametrize(
    ("begin", "end"),
    [(20, 179.9), (20, 181), (178, 300), (179.9, 200), (180.1, 300), (200, 90), (20, 180), (180, 60)],
)
def test_open_ways_have_the_change_points_between_their_ends_only(begin: float, end: float, steps: int) -> None:
    """Crank 1, coupler 3, rocker 2, frame 4: at 180° alone, the ends counted."""
    found = found_between(fourbar(1, 3, 2, 4, start=begin), begin, end, steps)
    if not min(begin, end) <= 180 <= max(begin, end):
        assert found == []
        return
    (p,) = found
    assert p.kind == "change"
    assert p.place / steps == pytest.approx((180 - begin) / (end - begin), abs=1e-7)
    assert p.at == pytest.approx(np.pi, abs=1e-6)
    assert p.flips == (pytest.approx(p.place), np.inf)
    assert 0 <= p.before <= steps and p.share <= 1.0


@pytest.mark.parametrize("steps", [3, 5, 30])
@pytest.mark.parametrize("start", [210.0, 150.0, 20.0])
def test_a_stretch_out_of_reach_lies_behind_the_last_position_that_can_be(start: float, steps: int) -> None:
    """A crank of 1.05 m: A and O2 are more than 5 m apart from 160° to 200°."""
    edge = np.arccos((1.05**2 + 16.0 - 25.0) / 8.4)
    mechanism = fourbar(1.05, 3, 2, 4, start=start)
    found = crossings(MotionSolver(mechanism), over_cycle(mechanism, steps), None)
    angles = np.radians(start + 360.0 * np.arange(steps) / steps)
    hidden = not (np.cos(angles) < np.cos(edge)).any()
    assert [p.kind for p in found] == (["gap"] if hidden else [])
    for p in found:
        assert np.cos(p.at) == pytest.approx(np.cos(edge), abs=1e-9)
        assert np.sin(p.at) > 0.0
        assert p.place == pytest.approx(((edge - np.radians(start)) % (2 * np.pi)) / (2 * np.pi) * steps, abs=1e-7)
        assert (p.before, p.after) == (int(p.place), (int(p.place) + 1) % steps)


@pytest.mark.parametrize("steps", [4, 9, 50])
@pytest.mark.parametrize(("begin", "end"), [(-80, 80), (-80, 91), (-91, 80), (-100, 100), (60, 300), (100, -80)])
def test_guides_become_parallel_between_the_ends_of_an_open_way(begin: float, end: float, steps: int) -> None:
    """A slotted arm that is square to its rod's guide at 0° is along it at 90° and at 270°."""
    found = found_between(store.machine("tangent_mechanism"), begin, end, steps)
    low, high = min(begin, end), max(begin, end)
    expected = sorted((a for a in (-90.0, 90.0, 270.0) if low < a < high), reverse=end < begin)
    assert [p.kind for p in found] == ["pole"] * len(expected)
    assert [np.degrees(p.at) for p in found] == pytest.approx(expected, abs=1e-9)
    assert [p.place / steps for p in found] == pytest.approx(
        [(a - begin) / (end - begin) for a in expected], abs=1e-9
    )


@pytest.mark.parametrize("steps", [3, 9, 50, 200])
@pytest.mark.parametrize("start", [-40.0, 85.0, 89.99, 100.0, 271.0, 300.0])
def test_a_slotted_arm_that_turns_fully_has_its_guides_parallel_twice(start: float, steps: int) -> None:
    """At 90° and 270°, also between the last position and the first."""
    mechanism = store.machine("tangent_mechanism")
    driver = mechanism.drivers["driver"]
    law = replace(driver.law, start=np.radians(start))  # type: ignore[type-var]
    mechanism = replace(mechanism, drivers={"driver": replace(driver, law=law)}, cycle=Cycle(turns=1.0))
    positions = over_cycle(mechanism, steps)
    assert positions.closed
    found = crossings(MotionSolver(mechanism), positions, None)
    expected = sorted(((a - start) % 360.0) / 360.0 * steps for a in (90.0, 270.0))
    assert [p.kind for p in found] == ["pole", "pole"]
    assert [p.place for p in found] == pytest.approx(expected, abs=1e-5)
    assert [np.degrees(p.at) - start for p in found] == pytest.approx([360 * e / steps for e in expected], abs=1e-4)
    assert [(p.before, p.after) for p in found] == [
        (k, (k + 1) % steps) for k in (int(np.ceil(p.place)) - 1 for p in found)
    ]
