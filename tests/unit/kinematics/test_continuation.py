"""Groups without closed form between the positions of their way, against the same mechanism solved there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.invariants.output_driven import turning

import linkwright as lw
from linkwright.cycle_programs import iterated_groups
from linkwright.kinematics.between_positions import Between
from linkwright.kinematics.branch import CORRECTION, MISFIT, _Walk, follow, straight
from linkwright.kinematics.certificate import End, certify, cubic
from linkwright.kinematics.continuation import Follower, _Journey
from linkwright.kinematics.design import Design
from linkwright.kinematics.followed_way import Followed
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.reach_sentences import branch_notes
from linkwright.kinematics.solver import MotionSolver
from linkwright.metrics import Analysis

pytestmark = pytest.mark.rotating

Floats = NDArray[np.float64]


FAULTS = Path(__file__).parents[2] / "reference" / "faults"


def fault(name: str) -> lw.Mechanism:
    """A machine that was solved wrongly once."""
    return lw.load(FAULTS / f"{name}.yaml")


def followed(motion: Motion) -> Followed:
    assert motion.followed is not None
    return motion.followed


@pytest.fixture(scope="module")
def triad() -> Motion:
    return lw.solve_motion(lw.load("gallery:triad"), steps=36)


def at(motion: Motion, places: Floats) -> tuple[Floats, Followed]:
    """Drivers (m, 1) at numbers of positions, and the way solved at just these times."""
    step = motion.time[1] - motion.time[0]
    there = lw.solve_motion(motion.mechanism, times=motion.time[0] + places * step)
    return np.stack(list(there.inputs.values()), axis=1), followed(there)


PLACES = np.array([30.75, 3.25, 3.5, 3.25, 17.0, 35.5, 8.125])


def agree(found: dict[str, Floats], there: Followed) -> None:
    for name, row in there.states.items():
        turned = np.round((found[name] - row) / (2 * np.pi)) * 2 * np.pi if name.endswith("angle") else 0.0
        assert found[name] - turned == pytest.approx(row, abs=1e-11)


def test_between_two_positions_lies_what_is_solved_there(triad: Motion) -> None:
    way = followed(triad)
    q, there = at(triad, PLACES)
    agree(way.between(PLACES, q), there)


@pytest.mark.parametrize("sure", [True, False])
def test_a_law_that_is_no_straight_line_is_met_where_it_is(
    monkeypatch: pytest.MonkeyPatch, sure: bool
) -> None:
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
    if not sure:
        read = Followed._read
        monkeypatch.setattr(Followed, "_read", lambda *a: (read(*a)[0], np.zeros(len(a[1]), dtype=bool)))
    agree(followed(motion).between(places, q), there)


@pytest.mark.parametrize("shift", [0.0, 0.05, 0.2])
def test_without_a_sure_reading_the_way_is_walked(
    triad: Motion, monkeypatch: pytest.MonkeyPatch, shift: float
) -> None:
    """Nothing counts as sure; of what the walk finds, corrections that are too long are walked once more."""
    way = followed(triad)
    q, there = at(triad, PLACES)
    read = Followed._read
    polished = way.follower.loops.polished
    monkeypatch.setattr(Followed, "_read", lambda *a: (read(*a)[0] * np.nan, np.zeros(len(a[1]), dtype=bool)))
    way.between(PLACES, q)  # what the follower finds out only once is no walk of these

    def moved(y: Floats, iterations: int = 3) -> tuple[Floats, Floats]:
        exact, last = polished(y, iterations)
        return exact + (
            np.append(np.full(way.follower.loops.n, shift), 0.0) if iterations == 4 else 0.0
        ), last

    if shift:
        walked: list[float] = []
        between = way.follower.between
        monkeypatch.setattr(way.follower.loops, "polished", moved)
        monkeypatch.setattr(
            way.follower, "between", lambda a, b, c: walked.append(float(b[0])) or between(a, b, c)
        )
    agree(way.between(PLACES, q), there)
    if shift:
        assert sorted(walked) == sorted(q[:, 0])


def test_readings_are_cubics_of_the_fourth_order(triad: Motion, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without their correction they miss the root by sixteen times less at half the way."""
    off = []
    for steps, every in ((36, 1), (72, 2)):
        motion = lw.solve_motion(triad.mechanism, steps=steps)
        way = followed(motion)
        loops, polished = way.follower.loops, way.follower.loops.polished
        a = np.arange(0, steps - every, every)
        share = np.tile([0.5, 0.25, 0.7], 12)[: len(a)]
        q = way.inputs[a] + share[:, None] * way.follower.nearest_drive(way.inputs[a + 1] - way.inputs[a])
        exact, sure = way._read(a, a + 1, share, q)
        assert sure.all()
        monkeypatch.setattr(loops, "polished", lambda y, n: (y, np.zeros(len(y))))
        near, _ = way._read(a, a + 1, share, q)
        monkeypatch.setattr(loops, "polished", polished)
        off.append(np.abs((near - exact) / loops.scale).max(axis=1))
    assert off[0].max() < 2e-4
    assert np.median(off[0] / off[1]) == pytest.approx(16.0, rel=0.25)


@pytest.mark.parametrize(
    ("of_the_way", "last", "sure"), [(0.5, 0.0, True), (2.0, 0.0, False), (0.5, 1e-6, False)]
)
def test_a_reading_is_sure_if_its_correction_is_small_and_has_ended(
    triad: Motion, monkeypatch: pytest.MonkeyPatch, of_the_way: float, last: float, sure: bool
) -> None:
    way = followed(triad)
    loops, a = way.follower.loops, np.array([3])
    width = np.abs((way.coordinates[4] - way.coordinates[3]) / loops.scale).max()
    shift = np.append(of_the_way * CORRECTION * width * loops.scale, 0.0)
    monkeypatch.setattr(loops, "polished", lambda y, n: (y + shift, np.full(len(y), last)))
    q = 0.5 * (way.inputs[3:4] + way.inputs[4:5])
    assert way._read(a, a + 1, np.array([0.5]), q)[1].tolist() == [sure]


def test_nothing_is_read_over_a_break_or_an_end() -> None:
    motion = lw.solve_motion(fault("valid_position_barred"), steps=40, failures="mark")
    way = followed(motion)
    assert way.breaks == {10} and not way.closed
    places = np.array([9.5, 10.5, 11.0, 39.0, 40.0])
    q = np.interp(places, np.arange(41.0), motion.input)[:, None]
    found = way.between(places, q)
    for row in found.values():
        assert np.isfinite(row).tolist() == [True, False, False, False, False]
    across = replace(
        way, coordinates=np.where(np.isfinite(way.coordinates), way.coordinates, way.coordinates[10])
    )
    assert not np.isfinite(next(iter(across.between(np.array([10.5]), q[1:2]).values()))).any()


@pytest.mark.parametrize(("returns", "there"), [(True, True), (None, True), (False, False)])
def test_the_last_position_leads_to_the_first_if_the_cycle_comes_back(
    triad: Motion, returns: bool | None, there: bool
) -> None:
    way = followed(triad)
    assert way.closed and way.returns is True
    q, _ = at(triad, np.array([35.5]))
    found = replace(way, returns=returns).between(np.array([35.5]), q)
    assert np.isfinite(next(iter(found.values()))).tolist() == [there]


def test_beyond_the_last_reached_position_the_motion_goes_on_to_where_it_ends() -> None:
    motion = lw.solve_motion(fault("valid_position_barred"), steps=40, failures="mark")
    end = followed(motion).stops[0].inputs[0]
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
    way = followed(motion)
    bad = np.flatnonzero(~motion.ok)
    assert way.returns is None and len(way.stops) == 2 and len(way.breaks) == 1
    assert set(way.stop_of[bad[:-1]]) == {0} and way.stop_of[bad[-1]] == 1
    assert np.isnan(way.margin[bad]).all() and (way.margin[motion.ok] > 0.0).all()
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
        for (time, _), stop in zip(edges, followed(motion).stops, strict=True)
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
    journey = _Journey(solver.follower(), positions, False)
    assert journey._in_line() and not journey.lawful
    assert journey._shares() == pytest.approx(q / 2.0)
    way = journey.followed()
    exact = lw.solve_motion(triad.mechanism, at=q)
    agree(dict(way.states), followed(exact))
    for other, line in ((q[::-1], True), (q[[0, 2, 1, *range(3, 9)]], False), (np.append(q[:8], 1.9), True)):
        mixed = replace(positions, coordinates=dict.fromkeys(rows, (other, none, none)))
        assert _Journey(solver.follower(), mixed, False)._in_line() is line
    short = replace(positions, time=none[:2], coordinates=dict.fromkeys(rows, (q[:2], none[:2], none[:2])))
    assert not _Journey(solver.follower(), short, False)._in_line()


# a step without a certificate ------------------------------------------------------------------------------
def walk(motion: Motion, steps: float = 1.0) -> tuple[_Walk, End, End]:
    """A walk at the beginning of one step, and both its ends."""
    loops, q = motion.solver.follower().loops, motion.positions.coordinates["driver"][0]
    way = straight(
        motion.solver.follower().loops, q[:1], q[:1] + steps * (q[1:2] - q[:1]), motion.solver.follower().unit
    )
    found = _Walk(loops, way, followed(motion).coordinates[0])
    assert found.here is not None
    end = found._end(1.0, (found.here.y + found.here.rate)[: loops.n], found.here.sign)
    assert end is not None
    return found, found.here, end


@pytest.mark.parametrize(
    ("guess", "rate", "second", "kept"),
    [(0.0, 0.0, 0.0, True), (0.9, 0.0, 0.0, True), (1.1, 0.0, 0.0, False), (0.0, 0.9, 0.0, True),
     (0.0, 1.1, 0.0, False), (0.0, 0.0, 0.9, True), (0.0, 0.0, 1.1, False), (0.0, 0.0, -1.1, False)],
)  # fmt: skip
def test_a_step_is_plausible_up_to_its_documented_shares(
    triad: Motion, guess: float, rate: float, second: float, kept: bool
) -> None:
    """Shares of what is allowed: of the guess's correction, and of the misfit that wrong rates make (h/2, h²/12)."""
    found, a, b = walk(triad, 0.01)
    loops, h = found.loops, b.x - a.x
    step = loops.largest(b.y - a.y)
    unit = np.append(loops.scale, 0.0) * step
    aside = b.y + guess * CORRECTION * unit
    bent = replace(
        a,
        rate=a.rate + rate * MISFIT * 2.0 / h * unit,
        second=a.second + second * MISFIT * 12.0 / h**2 * unit,
    )
    assert found._plausible(bent, aside, b) is kept


def test_both_ends_on_one_side_of_the_fold_and_never_over_it(triad: Motion) -> None:
    found, a, _ = walk(triad)
    n = found.loops.n
    assert found._end(1.0, a.y[:n] + a.rate[:n], -a.sign) is None
    assert found._end(1.0, np.full(n, np.nan), a.sign) is None
    passed, certificate = found._step(0.01, 0.01, False)
    assert passed and certificate.certified and found.here is not None and found.here.x == 0.01


def test_laws_are_compared_with_the_cubic_at_the_places_asked_for(triad: Motion) -> None:
    """A law that leaves the cubic between the ends by some angle is a deviation of just that angle."""
    found, a, b = walk(triad)
    bump = lambda x: 1e-3 * np.sin(np.pi * x) ** 2  # noqa: E731
    drive = found.way.drive

    def bent(x: Floats) -> tuple[Floats, Floats, Floats]:
        q, first, second = drive(x)
        return q + bump(x)[:, None], first, second

    found.way = replace(found.way, drive=bent, places=np.array([0.25, 1.0]), checks=np.array([0.0, 0.5, 1.0]))
    values, deviation = found._driven(a, b, np.array([0]))
    assert deviation == pytest.approx([1e-3], rel=1e-9)
    assert values == pytest.approx(bent(np.array([0.25]))[0])
    found.way = replace(found.way, checks=np.zeros(0))
    assert found._driven(a, b, np.array([0]))[1] == pytest.approx([0.5e-3], rel=1e-9)
    found.way = replace(found.way, drive=drive)
    assert found._driven(a, b, np.array([0]))[1].tolist() == [0.0]
    assert found._driven(a, b, np.zeros(0, dtype=int))[0].shape == (0, 1)


def test_the_cubic_has_both_ends_places_and_rates(triad: Motion) -> None:
    _, a, b = walk(triad)
    x, h = np.array([a.x, b.x]), 1e-6
    assert cubic(a, b, x) == pytest.approx(np.stack([a.y, b.y]), abs=1e-14)
    rates = (cubic(a, b, x + h) - cubic(a, b, x - h)) / (2 * h)
    assert rates == pytest.approx(np.stack([a.rate, b.rate]), abs=1e-8)


def test_singular_ends_have_no_certificate(triad: Motion) -> None:
    """All links of the loops in line."""
    found, _, b = walk(triad)
    line = replace(b, x=0.0, y=0.0 * b.y, rate=0.0 * b.rate)
    refused = certify(found.loops, line, replace(line, x=1.0), np.zeros(found.loops.d))
    assert not refused.certified and refused.tube is None


@pytest.mark.parametrize("count", [2, 7])
def test_a_way_keeps_every_place_asked_for_in_order(triad: Motion, count: int) -> None:
    follower, way = triad.solver.follower(), followed(triad)
    straight_way = straight(follower.loops, way.inputs[0], way.inputs[9], follower.unit)
    places = np.linspace(0.0, 1.0, count)
    branch = follow(follower.loops, replace(straight_way, places=places), way.coordinates[0])
    assert branch.complete and branch.certified.all() and branch.reached == 1.0
    assert branch.found[:, -1] == pytest.approx(
        way.inputs[0, 0] + places * (way.inputs[9, 0] - way.inputs[0, 0])
    )
    assert branch.found[-1] == pytest.approx(branch.last, abs=1e-12)
    assert straight_way.pace == pytest.approx(abs(way.inputs[9, 0] - way.inputs[0, 0]))
    apart = follow(follower.loops, replace(straight_way, places=places), np.full(follower.loops.n, np.nan))
    assert not apart.complete and apart.found.shape == (0, follower.loops.n + 1)
    assert apart.reached == 0.0 and np.isnan(apart.last).all()


def test_a_way_that_stands_still_is_complete(triad: Motion) -> None:
    follower, way = triad.solver.follower(), followed(triad)
    here = straight(follower.loops, way.inputs[4], way.inputs[4], follower.unit)
    branch = follow(follower.loops, here, way.coordinates[4])
    assert branch.complete and branch.last[:-1] == pytest.approx(way.coordinates[4], abs=1e-13)


def test_a_way_of_too_many_tries_is_followed_without_proof_and_said_so(
    triad: Motion, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The rest of a way is passed in steps as long as they are plausible, not in ever shorter ones."""
    monkeypatch.setattr("linkwright.kinematics.branch.PATIENCE", 5)
    motion = lw.solve_motion(triad.mechanism, steps=12)
    way = followed(motion)
    sure = int(way.certified.sum())
    assert 1 <= sure < 12 and way.certified[:sure].all()
    for link in triad.mechanism.links:
        assert motion.link(link).direction == pytest.approx(triad.link(link).direction[::3], abs=1e-11)
    unsure = np.flatnonzero(~way.certified)
    near = unsure[np.argmin(way.margin[unsure])]
    (note,) = branch_notes(motion)
    assert f"{len(unsure)} position" in note and f"{np.degrees(motion.input[near]):.6g}°" in note
    assert f"{way.margin[near]:.2g}" in note
    assert {o.sentence == "the mechanism is assembled" for o in motion.outcomes if not o.certified} == {False}
    motion.followed = replace(way, returns=False)
    assert len(branch_notes(motion)) == 2
    motion.followed = replace(way, certified=np.ones(12, dtype=bool))
    assert branch_notes(motion) == ()
    motion.followed = None
    assert branch_notes(motion) == ()


def test_a_second_sweep_follows_no_way_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """What depends on the mechanism as it is serves every sweep of it, and the results are those of a first one."""

    def swept(mechanism: lw.Mechanism) -> lw.Sweep:
        lengths = mechanism.dimension("bar_1.P.x") * np.linspace(0.999, 1.001, 4)
        return lw.sweep(mechanism, {"bar_1.P.x": lengths}, outputs=["input_torque rms"], steps=48)

    mechanism = lw.load("gallery:triad")
    first, anew = swept(mechanism), swept(lw.load("gallery:triad"))
    monkeypatch.setattr(Follower, "follow", lambda *_: pytest.fail("followed again"))
    monkeypatch.setattr(iterated_groups._Way, "__init__", lambda *_: pytest.fail("traced again"))
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
    there = followed(lw.solve_motion(triad.mechanism.with_dimensions(changes), steps=36))
    agree(other, there)
    agree(solver.states(triad.positions), followed(triad))
