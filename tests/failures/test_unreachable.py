"""Positions that cannot be reached: refused with a reason, or marked; never a plausible number."""

from __future__ import annotations

import re
from math import acos, degrees, hypot, pi, radians

import numpy as np
import pytest
from tests import store
from tests.failures.limited_machines import FOLD, TRIPLE_ROCKER, fourbar, triad
from tests.refusals import noted, refused

import linkwright as lw
from linkwright import input_range, limit_positions
from linkwright.analysis import metrics


@pytest.mark.rotating
def test_a_group_without_closed_form_alone_is_named_as_what_stops() -> None:
    """Its crank is too long, and nothing but the group itself can say where the range ends."""
    text = store.text("triad").replace("A: [30 mm, 0 mm]", "A: [90 mm, 0 mm]")
    with refused("motion.refused_told", links=("bar_1", "bar_2", "bar_3", "plate")):
        lw.solve_motion(lw.loads(text), steps=7)


#: Of the four-bar with its crank at 120°.
LACKING = {"value": "120°", "signature": "RRR", "links": ("coupler", "rocker")}


def test_missing_distance_is_said() -> None:
    """At 120° the pins are hypot(5.5, 2.598) = 6.0828 m apart, the links reach 4.5 m."""
    missing = hypot(4 + 1.5, 3 * 3**0.5 / 2) - 4.5
    with refused(
        "motion.refused_told",
        lw.PositionError,
        reason=(
            "the distance of the outer pins is {distance}, links of {first} and {second} reach {reach}: {missing} "
            "missing"
        ),
        **LACKING,
    ) as caught:
        lw.solve_motion(fourbar(3, 2, 2.5, 4), at=radians(120))
    assert float(str(caught.value.values["missing"]).removesuffix(" mm")) == pytest.approx(1e3 * missing, rel=1e-6)


def test_marked_positions_hold_no_numbers() -> None:
    motion = lw.solve_motion(fourbar(3, 2, 2.5, 4), at=np.radians([0.0, 120.0]), failures="mark")
    assert list(motion.ok) == [True, False]
    for values in (motion.point("B").position, motion.point("A").velocity, motion.link("rocker").angle):
        assert np.isfinite(values[0]).all() and np.isnan(values[1]).all()
    assert motion.outcomes[1].kind == "unreachable" and motion.outcomes[1].group == "coupler+rocker"


def test_change_point_itself_is_refused_with_the_reason() -> None:
    with refused("motion.refused_told", link="crank", signature="RRR"):
        lw.solve_motion(fourbar(1, 3, 2, 4), steps=360)
    motion = lw.solve_motion(fourbar(1, 3, 2, 4), steps=360, failures="mark")
    assert list(np.flatnonzero(~motion.ok)) == [180]
    assert motion.outcomes[180].kind == "singular"


@pytest.mark.parametrize("steps", [5, 24, 360])
@pytest.mark.parametrize("excess", [1e-9, 1e-7, 1e-5])
def test_gap_between_two_positions_bars_the_way(excess: float, steps: int) -> None:
    """The crank is a little too long to pass 180°, where no position lies: it comes there from both sides, on the
    side of the diagonal on which it began."""
    mechanism = fourbar(1 + excess, 3, 2, 4, start=20.5)
    with refused("motion.not_passed", links=("coupler", "rocker"), where="driver = 180°"):
        lw.solve_motion(mechanism, steps=steps)
    motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
    assert motion.ok.all() and not motion.complete
    a, b, q = (motion.point(name).position for name in ("A", "B", "O2"))
    side = (b - a)[:, 0] * (q - a)[:, 1] - (b - a)[:, 1] * (q - a)[:, 0]
    assert (np.sign(side) == np.sign(side[0])).all()
    noted(motion.notes, "cycle.gap", links=("coupler", "rocker"), where="driver = 180°")
    start, end = input_range(mechanism).start, input_range(mechanism).end
    assert start is not None and end is not None
    assert end < pi < start + 2 * pi
    (reached,) = metrics(motion)["range_of_motion"]
    assert reached.value == pytest.approx(end - start, abs=1e-9)
    dead = [each.value for each in metrics(motion)["dead_point"] if each.subject == "driver"]
    assert sorted(dead) == pytest.approx([end, start + 2 * pi], abs=1e-9)


@pytest.mark.parametrize("steps", [5, 24, 61, 721])
@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_limits_and_dead_points_of_a_part_of_a_cycle_are_those_for_any_number_of_positions(
    speed: float, steps: int
) -> None:
    """The crank comes to 180° less 0.7° from both sides; the rocker turns back where crank and coupler are in one
    line."""
    mechanism = fourbar(2, 3.5, 2.4999, 4, start=50).with_dimensions({"driver.speed": speed})
    motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
    (limit,) = limit_positions(motion, "rocker")
    stretched = acos((5.5**2 + 4**2 - 2.4999**2) / (2 * 5.5 * 4))
    assert np.cos(limit.input) == pytest.approx(np.cos(stretched), abs=1e-9)
    ends = acos((2**2 + 4**2 - 5.9999**2) / (2 * 2 * 4))
    found = metrics(motion)["dead_point"]
    assert np.cos([each.value for each in found if each.subject == "driver"]) == pytest.approx(
        [np.cos(ends)] * 2, abs=1e-9
    )
    assert len(found) == 3
    (swing,) = metrics(motion)["swing_angle"]
    turned_back = acos((4**2 + 2.4999**2 - 5.5**2) / (2 * 4 * 2.4999))
    beyond = np.arctan2(2 * np.sin(ends), 4 - 2 * np.cos(ends))
    assert swing.value == pytest.approx(turned_back + beyond, abs=5e-5)  # ends follow from places beside


def test_a_little_shorter_passes() -> None:
    motion = lw.solve_motion(fourbar(1 - 1e-5, 3, 2, 4, start=20.5), steps=360)
    assert motion.ok.all() and motion.notes == ()


def test_positions_beyond_a_stretch_out_of_reach_belong_to_another_motion() -> None:
    """Double rocker: on both sides of the frame line two stretches that the mechanism cannot leave."""
    motion = lw.solve_motion(fourbar(3, 1, 2.8, 3.2, start=50), steps=360, failures="mark")
    turned = np.degrees(motion.input) % 360
    assert turned[motion.ok].min() == pytest.approx(34.0) and turned[motion.ok].max() == pytest.approx(75.0)
    other = int(np.flatnonzero(np.isclose(turned, 300.0))[0])
    assert motion.outcomes[other].kind == "barred"
    alone = lw.solve_motion(fourbar(3, 1, 2.8, 3.2, start=50), at=radians(300))
    assert alone.ok.all()


def test_limits_stay_within_the_reached_stretch() -> None:
    """Crank and coupler in one line, 4 m from O1 to B; their overlap at acos(0.5) is in the other stretch."""
    motion = lw.solve_motion(fourbar(3, 1, 2.8, 3.2, start=50), steps=360, failures="mark")
    stretched = acos((4**2 + 3.2**2 - 2.8**2) / (2 * 4 * 3.2))
    for output, kind in (("rocker", "min"), ("B.x", "max"), ("B.y", "max")):
        (found,) = limit_positions(motion, output)
        assert found.kind == kind
        assert found.input % (2 * pi) == pytest.approx(stretched, abs=1e-9)
    assert limit_positions(motion, "coupler") == ()


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("crnk", "study.no_such_output", {"name": "crnk", "offer": "crank"}),
        ("B", "study.no_such_output", {"name": "B", "offer": "B.x"}),
        ("B.z", "study.no_such_output", {"name": "B.z"}),
        ("frame", "study.no_such_output", {"name": "frame"}),
        ("rocker.angular_velocity", "motion.no_output", {"text": "rocker.angular_velocity"}),
    ],
)
def test_unknown_output(text: str, code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        limit_positions(store.motion("crank_rocker"), text)


def test_limits_need_a_way_in_time() -> None:
    mechanism = lw.loads("""
format: 1
name: five-bar
frame: {points: {O1: [0 m, 0 m], O2: [1 m, 0 m]}}
links:
  left_crank: {points: [O1, A], length: 0.3 m}
  left_bar: {points: [A, B], length: 1 m}
  right_bar: {points: [C, B], length: 1 m}
  right_crank: {points: [O2, C], length: 0.3 m}
drivers:
  left: {turn: left_crank, about: O1, speed: 1 rad/s}
  right: {turn: right_crank, about: O2, speed: 2 rad/s}
""")
    apart = {"left": np.radians([0.0, 10.0, 20.0, 30.0]), "right": np.radians([0.0, 10.0, 20.0, 30.0])}
    with refused("motion.no_way_between", name="right"):
        limit_positions(lw.solve_motion(mechanism, at=apart), "left_bar")
    assert limit_positions(lw.solve_motion(mechanism), "B.y")


def test_too_few_positions_have_no_limits() -> None:
    mechanism = store.machine("crank_rocker")
    assert limit_positions(lw.solve_motion(mechanism, at=[0.1, 0.2]), "rocker") == ()
    assert limit_positions(lw.solve_motion(store.machine("truss")), "tie") == ()


def test_no_range_without_a_driver_or_an_assembly() -> None:
    with refused("range.no_driver", name="Triangular truss on a pin and a roller"):
        input_range(store.machine("truss"))
    with refused("range.not_assembled", name="four-bar", driver="driver"):
        input_range(fourbar(1, 1, 1, 9))


@pytest.mark.parametrize("steps", [359, 360])
def test_guides_that_become_parallel_bar_the_way(steps: int) -> None:
    """A turning slot and a fixed guide: at 90° the pin is infinitely far away, y = tan of the angle."""
    mechanism = lw.loads(re.sub("(?m)^cycle: .*", "cycle: {turns: 1}", lw.dump(store.machine("tangent_mechanism"))))
    motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
    turned = np.degrees(motion.input) % 360.0
    turned -= np.where(turned > 180.0, 360.0, 0.0)
    assert turned[motion.ok].max() - turned[motion.ok].min() < 180.0
    if steps == 359:
        assert [lw.LinkwrightError(note).code for note in motion.notes] == ["cycle.pole"] * 2
    with pytest.raises(lw.PositionError):
        lw.solve_motion(mechanism, steps=steps)


@pytest.mark.parametrize(
    ("beyond", "kind"), [(1e-7, "singular"), (9e-7, "singular"), (1.2e-6, "unreachable"), (0.2, "unreachable")]
)
def test_a_position_on_the_limit_of_a_triad_is_singular_and_beyond_it_the_limit_is_said(
    beyond: float, kind: str
) -> None:
    motion = lw.solve_motion(triad(160), at=[2.4, FOLD + beyond, 2.5], failures="mark")
    assert motion.ok.tolist() == [True, False, True]
    found = motion.outcomes[1]
    assert found.kind == kind and not found.ok
    assert found.group == "crank+coupler+rocker+bar"
    if kind == "unreachable":
        noted([found.sentence], "outcome.stopped", where=f"driver = {degrees(FOLD):.6g}°")


def test_a_cycle_that_begins_out_of_reach_is_not_followed_at_all() -> None:
    motion = lw.solve_motion(triad(190, -1.0), steps=6, failures="mark")
    assert not motion.ok.any()
    first, *others = motion.outcomes
    noted([first.sentence], "outcome.stopped", where=f"driver = {degrees(FOLD):.6g}°")
    for each in others:
        assert (each.kind, each.group, each.ok) == ("unreachable", first.group, False)
        noted([each.sentence], "outcome.lost")


@pytest.mark.parametrize("turn", np.arange(0.1, 6.2, 0.7).tolist())
def test_a_swing_up_to_the_ends_of_reach_is_the_same_however_the_frame_is_turned(turn: float) -> None:
    """Angles at ends are read in another turn than those of the positions where the frame lies so."""
    reach = np.arccos((2.6**2 + 4**2 - 4.2**2) / (2 * 2.6 * 4))
    crank = reach * np.sin(np.linspace(-np.pi / 2, np.pi / 2, 4001))
    apart = 2.6 * np.exp(1j * crank) - 4.0
    cosine = (2.2**2 + np.abs(apart) ** 2 - 2**2) / (2 * 2.2 * np.abs(apart))
    rocker = np.unwrap(np.angle(apart)) - np.arccos(np.clip(cosine, -1.0, 1.0))
    x, y = float(4 * np.cos(turn)), float(4 * np.sin(turn))
    motion = lw.solve_motion(lw.loads(TRIPLE_ROCKER.format(x=x, y=y, start=turn)), steps=72, failures="mark")
    found = lw.metrics(motion, ["swing_angle", "range_of_motion"])
    assert found.value("swing_angle", "rocker") == pytest.approx(np.ptp(rocker), rel=1e-6)
    assert found.value("range_of_motion") == pytest.approx(2 * reach, rel=1e-9)
