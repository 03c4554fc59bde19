"""Groups without closed form between the positions of their way, against the same mechanism solved there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.invariants.output_driven import turning

import linkwright as lw
from linkwright.analysis import Analysis
from linkwright.events.tracked_groups import PathStep
from linkwright.kinematics.between_positions import Between
from linkwright.kinematics.branch import CORRECTION, MISFIT, Branch, Node, _Walk, follow, straight
from linkwright.kinematics.continuation import BranchTracker
from linkwright.kinematics.dimensions import Design
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.reach_messages import branch_notes
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.tracked_branch import TrackedBranch, _Journey
from linkwright.kinematics.tracking_formula import Root, TrackedGroups

pytestmark = pytest.mark.rotating

Floats = NDArray[np.float64]


FAULTS = Path(__file__).parents[2] / "reference" / "faults"


def fault(name: str) -> lw.Mechanism:
    """A machine that was solved wrongly once."""
    return lw.load(FAULTS / f"{name}.yaml")


def tracked(motion: Motion) -> TrackedBranch:
    assert motion.tracked is not None
    return motion.tracked


@pytest.fixture(scope="module")
def triad() -> Motion:
    return lw.solve_motion(lw.load("gallery:triad"), steps=36)


def at(motion: Motion, places: Floats) -> tuple[Floats, TrackedBranch]:
    """Drivers (m, 1) at numbers of positions, and the way solved at just these times."""
    step = motion.time[1] - motion.time[0]
    there = lw.solve_motion(motion.mechanism, times=motion.time[0] + places * step)
    return np.stack(list(there.inputs.values()), axis=1), tracked(there)


PLACES = np.array([30.75, 3.25, 3.5, 3.25, 17.0, 35.5, 8.125])


def agree(found: dict[str, Floats], there: TrackedBranch) -> None:
    for name, row in there.states.items():
        turned = np.round((found[name] - row) / (2 * np.pi)) * 2 * np.pi if name.endswith("angle") else 0.0
        assert found[name] - turned == pytest.approx(row, abs=1e-11)


def test_between_two_positions_lies_what_is_solved_there(triad: Motion) -> None:
    way = tracked(triad)
    q, there = at(triad, PLACES)
    agree(way.between(PLACES, q), there)


@pytest.mark.parametrize("read", [True, False])
def test_a_law_that_is_no_straight_line_is_met_where_it_is(read: bool) -> None:
    """Times at equal shares of a step are no equal shares of the driver's way."""
    folder = Path(lw.__file__).parent / "gallery"
    text = (folder / "triad.yaml").read_text("utf-8").split("expected:")
    begin = "expected:" + text[1]
    law = begin[begin.index("frame:") :].replace(
        "speed: 10 rad/s}", "position: 2 rad*sin(t/(1 s))}\ncycle: {duration: 1 s}"
    )
    motion = lw.solve_motion(lw.loads(text[0] + law), steps=6)
    places = np.array([0.5, 2.25, 4.75, 5.0])
    q, there = at(motion, places)
    way = tracked(motion) if read else replace(tracked(motion), stretches=())
    agree(way.between(places, q), there)


def test_without_a_branch_every_place_has_a_way_of_its_own(triad: Motion) -> None:
    q, there = at(triad, PLACES)
    agree(replace(tracked(triad), stretches=()).between(PLACES, q), there)


def branch_of(triad: Motion) -> Branch:
    return tracked(triad).stretches[0].branch


def test_readings_are_quintics_of_the_sixth_order(triad: Motion, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without their correction they miss the root by sixty-four times less at half the step."""
    tracker, way, off = triad.solver.tracker(), tracked(triad), []
    share = np.linspace(0.01, 0.99, 41)
    q = way.inputs[0] + share[:, None] * (way.inputs[9] - way.inputs[0])
    monkeypatch.setattr("linkwright.kinematics.branch.WANTED", 1e9)
    for steps in (18, 36):
        monkeypatch.setattr("linkwright.kinematics.branch.LONGEST", float(q[-1, 0] - q[0, 0]) / steps)
        branch = tracker.between(way.inputs[0], way.inputs[9], way.coordinates[0])
        near, _, known = branch.read(share, q)
        assert known.all() and len(branch.steps) >= steps
        off.append(np.abs(near - tracker.groups.many(near, q)[0]).max(axis=1))
    assert off[0].max() < 1e-4
    assert np.median(off[0]) / np.median(off[1]) == pytest.approx(64.0, rel=0.4)


@pytest.mark.parametrize(
    ("of_the_step", "other", "sure"), [(0.5, False, True), (2.0, False, False), (0.5, True, False)]
)
def test_a_reading_counts_if_its_correction_is_small_and_the_signs_are_kept(
    triad: Motion, monkeypatch: pytest.MonkeyPatch, of_the_step: float, other: bool, sure: bool
) -> None:
    """Else the place is walked to from the beginning of its step."""
    way, walked = tracked(triad), list[float]()
    tracker, branch = way.tracker, branch_of(triad)
    x = np.array([0.5 * (branch.steps[3][0].x + branch.steps[3][1].x)])
    q = branch.way.drive(x)
    change = (branch.read(x, q)[1] / tracker.groups.scale).max()
    exact, signs = tracker.groups.many(branch.read(x, q)[0], q)
    moved = branch.read(x, q)[0] + of_the_step * CORRECTION * change * tracker.groups.scale
    found = [tuple(each != other for each in signs[0])]
    monkeypatch.setattr(tracker.groups, "many", lambda z, q: (moved.copy(), found))
    own = BranchTracker._walked
    monkeypatch.setattr(BranchTracker, "_walked", lambda *a: (walked.append(a[2]), own(*a))[1])
    value = tracker.read(branch, x, q)
    assert (walked == []) is sure
    assert value == pytest.approx(moved if sure else exact, abs=1e-12)


def test_nothing_is_read_over_a_break_or_an_end() -> None:
    motion = lw.solve_motion(fault("valid_position_barred"), steps=40, failures="mark")
    way = tracked(motion)
    assert way.breaks == {10} and not way.closed
    places = np.array([9.5, 10.5, 11.0, 39.0, 40.0])
    q = np.interp(places, np.arange(41.0), motion.input)[:, None]
    found = way.between(places, q)
    for row in found.values():
        assert np.isfinite(row).tolist() == [True, False, False, False, False]
    across = replace(way, coordinates=np.where(np.isfinite(way.coordinates), way.coordinates, way.coordinates[10]))
    assert not np.isfinite(next(iter(across.between(np.array([10.5]), q[1:2]).values()))).any()


@pytest.mark.parametrize(("returns", "there"), [(True, True), (None, True), (False, False)])
def test_the_last_position_leads_to_the_first_if_the_cycle_comes_back(
    triad: Motion, returns: bool | None, there: bool
) -> None:
    way = tracked(triad)
    assert way.closed and way.returns is True
    q, _ = at(triad, np.array([35.5]))
    found = replace(way, returns=returns).between(np.array([35.5]), q)
    assert np.isfinite(next(iter(found.values()))).tolist() == [there]


def test_beyond_the_last_reached_position_the_motion_goes_on_to_where_it_ends() -> None:
    motion = lw.solve_motion(fault("valid_position_barred"), steps=40, failures="mark")
    end = tracked(motion).stops[0].inputs[0]
    step = motion.input[1] - motion.input[0]
    times = np.interp(end + np.array([-0.3, -0.05, 0.3]) * step, motion.input, motion.time)
    names = tuple(f"w:{link}" for link in motion.mechanism.links)
    found = Between(motion).evaluate(names, np.array([10, 10, 10]), times)
    there = lw.solve_motion(motion.mechanism, times=times[:2])
    for row, link in zip(found, motion.mechanism.links, strict=True):
        assert row[:2] == pytest.approx(there.link(link).angular_velocity, rel=1e-8)
    assert not np.isfinite(found[:, 2]).all()


@pytest.mark.parametrize("speed", ["1", "-1"])
def test_a_cycle_that_ends_on_both_sides_has_two_stops_and_does_not_come_back(speed: str) -> None:
    motion = lw.solve_motion(lw.loads(turning(float(speed))), steps=60, failures="mark")
    way = tracked(motion)
    bad = np.flatnonzero(~motion.ok)
    assert way.returns is None and len(way.stops) == 2 and len(way.breaks) == 1
    assert set(way.stop_of[bad[:-1]]) == {0} and way.stop_of[bad[-1]] == 1
    first, second = (float(stop.inputs[0]) for stop in way.stops)
    turn = 2 * np.pi * float(speed)
    ends = (
        sorted([motion.input[bad[0] - 1], motion.input[bad[0]]]),
        sorted([motion.input[bad[-1]], motion.input[bad[-1]] + turn / 60]),
    )
    assert ends[0][0] <= first <= ends[0][1]
    assert any(ends[1][0] <= second + lap <= ends[1][1] for lap in (0.0, turn))


@pytest.mark.parametrize("speed", ["1", "-1"])
@pytest.mark.parametrize("steps", [20, 60])
def test_what_is_reached_goes_on_to_both_its_ends(speed: str, steps: int) -> None:
    """From the last position before a barred stretch, and backwards from the first one behind it."""
    motion = lw.solve_motion(lw.loads(turning(float(speed))), steps=steps, failures="mark")
    edges = Analysis.of(motion).resolver.edges
    laps = [
        np.radians(160.0) + float(speed) * time - stop.inputs[0]
        for (time, _), stop in zip(edges, tracked(motion).stops, strict=True)
    ]
    assert [sense for _, sense in edges] == [-1, 1]
    assert np.sin(laps) == pytest.approx([0.0, 0.0], abs=3e-7)


def test_a_straight_row_of_inputs_is_one_way(triad: Motion) -> None:
    """As an input range asks for it: times are not known, so the drivers' coordinates alone are followed."""
    solver = triad.solver
    q = np.linspace(0.0, 2.0, 9)
    none = np.zeros(9)
    rows = dict.fromkeys(triad.positions.coordinates, (q, none, none))
    positions = replace(triad.positions, time=none, coordinates=rows, period=None, cycle=False)
    journey = _Journey(solver.tracker(), positions, False)
    assert journey._in_line() and not journey.lawful
    assert journey._shares() == pytest.approx(q / 2.0)
    way = journey.track_branch()
    exact = lw.solve_motion(triad.mechanism, at=q)
    agree(dict(way.states), tracked(exact))
    for other, line in ((q[::-1], True), (q[[0, 2, 1, *range(3, 9)]], False), (np.append(q[:8], 1.9), True)):
        mixed = replace(positions, coordinates=dict.fromkeys(rows, (other, none, none)))
        assert _Journey(solver.tracker(), mixed, False)._in_line() is line
    short = replace(positions, time=none[:2], coordinates=dict.fromkeys(rows, (q[:2], none[:2], none[:2])))
    assert not _Journey(solver.tracker(), short, False)._in_line()


# one step ---------------------------------------------------------------------------------------------------
def walk(motion: Motion, steps: float = 1.0) -> tuple[_Walk, Root, Root]:
    """A walk at the beginning of one step, and the roots at both its ends."""
    tracker, q = motion.solver.tracker(), motion.positions.coordinates["driver"][0]
    ahead = steps * (q[1:2] - q[:1])
    found = _Walk(tracker.groups, straight(q[:1], q[:1] + ahead, tracker.groups.unit), tracked(motion).coordinates[0])
    assert found.here is not None
    begin = found._towards(found.here, ahead)
    assert begin is not None
    end = tracker.groups.solve(begin.root.z, (q[:1] + ahead).tolist(), ahead.tolist())
    assert end is not None
    return found, begin.root, end


@pytest.mark.parametrize(
    ("guess", "rate", "second", "kept"),
    [
        (0.0, 0.0, 0.0, True),
        (0.9, 0.0, 0.0, True),
        (1.1, 0.0, 0.0, False),
        (0.0, 0.9, 0.0, True),
        (0.0, 1.1, 0.0, False),
        (0.0, 0.0, 0.9, True),
        (0.0, 0.0, 1.1, False),
        (0.0, 0.0, -1.1, False),
    ],
)
def test_a_step_counts_up_to_its_documented_shares(
    triad: Motion, guess: float, rate: float, second: float, kept: bool
) -> None:
    """Shares of what is allowed: of the guess's correction, and of the misfit that wrong rates make (1/2, 1/12)."""
    found, a, b = walk(triad, 0.01)
    step = float(np.abs(np.subtract(b.z, a.z)).max())
    aside = (np.array(b.z) + guess * CORRECTION * step).tolist()
    bent = replace(
        a,
        rate=(np.array(a.rate) + rate * MISFIT * 2.0 * step).tolist(),
        second=(np.array(a.second) + second * MISFIT * 12.0 * step).tolist(),
    )
    assert (found._off(bent, aside, b) < 1.0) is kept


def test_rates_in_another_direction_are_those_solved_there(triad: Motion) -> None:
    """Of one driver they are scaled: twice the way has twice the rate, and four times the second."""
    found, a, _ = walk(triad)
    _, twice, _ = walk(triad, 2.0)
    assert twice.rate == pytest.approx(2.0 * np.array(a.rate), rel=1e-9)
    assert twice.second == pytest.approx(4.0 * np.array(a.second), rel=1e-9)
    here = found.here
    assert here is not None
    begin = Node(here.x, here.q, np.array([0.5]), replace(a, rate=[1.0] * 4, second=[3.0] * 4))
    back = found._towards(begin, np.array([-0.25]))
    assert back is not None and back.root.rate == [-0.5] * 4 and back.root.second == [0.75] * 4


def test_no_step_leads_over_a_fold(triad: Motion, monkeypatch: pytest.MonkeyPatch) -> None:
    """A root whose determinant has another sign is none of the assembly."""
    found, _, _ = walk(triad, 0.01)
    solve = TrackedGroups.solve

    def other(groups: TrackedGroups, *given: object) -> Root | None:
        root = solve(groups, *given)  # type: ignore[arg-type]
        ahead = given[1] != found.way.drive(np.zeros(1))[0].tolist()
        return root and replace(root, signs=tuple(each != ahead for each in root.signs))

    monkeypatch.setattr(TrackedGroups, "solve", other)
    assert found._step(1.0) == np.inf and found.steps == []
    monkeypatch.setattr(TrackedGroups, "solve", solve)
    assert found._step(1.0) < 1.0 and len(found.steps) == 1


@pytest.mark.parametrize("count", [2, 7])
def test_a_way_is_read_at_every_place(triad: Motion, count: int) -> None:
    tracker, way = triad.solver.tracker(), tracked(triad)
    branch = tracker.between(way.inputs[0], way.inputs[9], way.coordinates[0])
    assert branch.complete and branch.reached == 1.0
    assert branch.way.pace == pytest.approx(abs(way.inputs[9, 0] - way.inputs[0, 0]))
    x = np.linspace(0.0, 1.0, count)
    q = way.inputs[0] + x[:, None] * (way.inputs[9] - way.inputs[0])
    found = tracker.read(branch, x, q)
    assert found[-1] == pytest.approx(branch.last, abs=1e-12) == way.coordinates[9]
    beyond = tracker.read(branch, np.array([-0.1, 1.1]), q[[0, -1]])
    assert np.isnan(beyond).all()
    apart = follow(tracker.groups, branch.way, np.full(len(tracker.groups.scale), np.nan))
    assert not apart.complete and apart.end is None and apart.last is None and apart.reached == 0.0


def test_a_way_that_stands_still_is_complete(triad: Motion) -> None:
    tracker, way = triad.solver.tracker(), tracked(triad)
    branch = tracker.between(way.inputs[4], way.inputs[4], way.coordinates[4])
    assert branch.complete and branch.last == pytest.approx(way.coordinates[4], abs=1e-13)


def test_a_way_of_too_many_tries_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkwright.kinematics.branch.PATIENCE", 5)
    motion = lw.solve_motion(lw.load("gallery:triad"), steps=12, failures="mark")
    assert 1 <= int(motion.ok.sum()) < 12


def test_a_cycle_that_ends_in_another_assembly_is_reported(triad: Motion) -> None:
    motion = lw.solve_motion(triad.mechanism, steps=12)
    assert branch_notes(motion) == ()
    motion.tracked = replace(tracked(motion), returns=False)
    (note,) = branch_notes(motion)
    assert note.code == "cycle.not_back"
    motion.tracked = None
    assert branch_notes(motion) == ()


def test_a_second_sweep_follows_no_way_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """What depends on the mechanism as it is serves every sweep of it, and the results are those of a first one."""

    def swept(mechanism: lw.Mechanism) -> lw.Sweep:
        lengths = mechanism.dimension("bar_1.P.x") * np.linspace(0.999, 1.001, 4)
        return lw.sweep(mechanism, {"bar_1.P.x": lengths}, outputs=["input_torque rms"], steps=48)

    mechanism = lw.load("gallery:triad")
    first, anew = swept(mechanism), swept(lw.load("gallery:triad"))
    monkeypatch.setattr(_Journey, "track_branch", lambda *_: pytest.fail("followed again"))
    monkeypatch.setattr(PathStep, "__init__", lambda *_: pytest.fail("traced again"))
    second = swept(mechanism)
    assert np.isfinite(second["input_torque", "rms"]).all()
    for each in (anew, second):
        assert np.array_equal(each["input_torque", "rms"], first["input_torque", "rms"])
        assert each.branch_margin is not None and first.branch_margin is not None
        assert np.array_equal(each.branch_margin, first.branch_margin)


def test_times_of_a_later_turn_are_those_of_the_first(triad: Motion) -> None:
    """Also within the first step, behind which the first position of the next turn lies."""
    names, step = tuple(f"w:{link}" for link in triad.mechanism.links), triad.time[1] - triad.time[0]
    times = triad.time[0] + step * np.array([0.4, 7.3, 35.6])
    first = Between(triad).evaluate(names, np.array([0, 7, 35]), times)
    later = Between(triad).evaluate(names, np.array([0, 7, 35]), times + triad.positions.period)
    assert np.isfinite(first).all() and later == pytest.approx(first, rel=1e-9)


def test_another_design_has_a_way_of_its_own(triad: Motion) -> None:
    solver = MotionSolver(triad.mechanism)
    changes = {"crank.A.x": 0.9 * triad.mechanism.dimensions()["crank.A.x"]}
    other = solver.states(triad.positions, Design(triad.mechanism, solver.assembly.modes, changes))
    there = tracked(lw.solve_motion(triad.mechanism.with_dimensions(changes), steps=36))
    agree(other, there)
    agree(solver.states(triad.positions), tracked(triad))
