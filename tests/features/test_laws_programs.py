"""Motion programs: junctions, what does not close, programs that are found, and programs as drivers' laws."""

from __future__ import annotations

import itertools
import math
from math import radians

import numpy as np
import pytest
from tests.every import every
from tests.refusals import findings, refused, said

import linkwright as lw
from linkwright import FoundProgram, MotionProgram, Segment, Window
from linkwright.errors import ModelError

MODEL = """
format: 1
name: driven by a program
frame: {points: {O: [0 m, 0 m], C: [0.4 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.4 m}
  rocker: {points: [C, B], length: 0.3 m}
assembly: {B: left}
driver:
  turn: crank
  about: O
  program: PROGRAM
"""
PROGRAM = """
    - {rise: 90 deg, over: 0.2 s, law: cycloidal}
    - {dwell: 0.1 s}
    - {rise: 90 deg, over: 0.2 s, law: {kind: modified_sine, crossover: 0.4}}
    - {rise: 180 deg, over: 0.5 s, law: polynomial_7}
"""


def turn(*segments: Segment) -> MotionProgram:
    return MotionProgram(segments)


@pytest.mark.parametrize("law", ["polynomial_5", "polynomial_7", "harmonic_combination"])
def test_laws_take_over_what_their_neighbours_do(law: str) -> None:
    """A rise into a passage of constant velocity and out of it, all without jumps of velocity and acceleration."""
    program = turn(
        Segment(radians(60), 0.01, law=law),
        Segment(radians(30), 0.01, law="constant_velocity"),
        Segment(radians(90), 0.005, law=law),
        Segment(radians(60)),
        Segment(radians(120), to=0.0, law=law),
    )
    assert program.smoothness >= 2
    steady = program.curves(np.radians([60.0, 75.0, 89.0]))
    assert steady[1] == pytest.approx(np.full(3, 0.01 / radians(30)), rel=1e-9)
    x = np.random.default_rng(1).uniform(0, 2 * math.pi, 300)
    curves = program.curves(x + 1e-30j)
    for lower, upper in every(itertools.pairwise(curves)):
        assert np.abs(lower.imag / 1e-30 - upper.real).max() < 1e-12 * np.abs(upper.real).max()
    assert program.curves(x + 4 * math.pi)[0] == pytest.approx(program.curves(x)[0], abs=1e-15)


def test_a_junction_says_velocity_and_acceleration() -> None:
    program = turn(
        Segment(radians(120), 0.02, velocity=0.006, acceleration=-0.004),
        Segment(radians(120), 0.005),
        Segment(radians(120), to=0.0),
    )
    junction = program.junctions[1]
    assert junction.before[:3] == pytest.approx((0.02, 0.006, -0.004), abs=1e-12)
    assert junction.after[:3] == pytest.approx((0.02, 0.006, -0.004), abs=1e-12)
    assert junction.jumps == (False, False, False, True) and program.smoothness == 2


def test_a_turn_without_a_rise_between_moving_ends() -> None:
    """Over and back within one segment: the displacement returns to where it began."""
    program = turn(
        Segment(radians(90), 0.01, law="polynomial_5", velocity=0.02),
        Segment(radians(90), 0.0, law="polynomial_5", velocity=-0.02),
        Segment(radians(180), to=0.0),
    )
    s = program.curves(np.radians([90.0, 135.0, 180.0]))[0]
    assert s[0] == pytest.approx(s[2]) and s[1] > s[0] + 0.005


CV = "constant_velocity"
REFUSED = [
    (
        (Segment(radians(90), 0.01), Segment(radians(260), to=0.0)),
        "program_short",
        "program",
        {"total": "350°", "period": "360°", "missing": "10°"},
    ),
    (
        (Segment(radians(190), 0.01), Segment(radians(190), to=0.0)),
        "program_long",
        "program",
        {"total": "380°", "period": "360°", "missing": "20°"},
    ),
    (
        (Segment(radians(90), 0.01), Segment(radians(270), -0.009)),
        "lift_open",
        "program.1",
        {"first": "0", "last": "0.001"},
    ),
    (
        (Segment(math.pi, 0.01, law=CV), Segment(math.pi, -0.01, law=CV)),
        "velocity_jump",
        "program.1",
        {"place": "0°", "after": "0.0031831"},
    ),
    ((), "program_empty", "program", {}),
    ((Segment(-1.0, 0.01),), "segment_over", "program.0.over", {"over": "-1"}),
]


@pytest.mark.parametrize(("segments", "code", "key", "values"), REFUSED)
def test_what_is_no_program_is_refused_with_place_and_remedy(
    segments: tuple[Segment, ...], code: str, key: str, values: dict[str, object]
) -> None:
    with pytest.raises(ModelError) as caught:
        MotionProgram(segments)
    assert said(caught.value.findings, code, key, **values).remedy
    assert caught.value.translate("zh") != caught.value.translate("en")


def test_both_jumps_of_a_saw_are_named() -> None:
    with pytest.raises(ModelError) as caught:
        turn(Segment(math.pi, 0.01, law=CV), Segment(math.pi, -0.01, law=CV))
    assert [each.key for each in caught.value.findings] == ["program.1", "program.0"]


def found(**changes: object) -> FoundProgram:
    given = {
        "points": ((radians(90), 0.02), (radians(120), 0.015)),
        "windows": (Window(radians(150), radians(230), 0.0, 0.0), Window(radians(250), radians(300), 0.005, 0.006)),
        "limits": (("jerk", 5.0),),
    }
    return FoundProgram(**{**given, **changes})  # type: ignore[arg-type]


def test_a_found_program_meets_what_was_asked_and_names_what_binds() -> None:
    program = found()
    assert program.curves(np.radians([90.0, 120.0]))[0] == pytest.approx([0.02, 0.015], abs=1e-9)
    dwell = np.array(program.curves(np.radians(np.linspace(150.0, 230.0, 99)))[:3])
    assert np.abs(dwell).max() < 1e-7
    window = program.curves(np.radians(np.linspace(250.0, 300.0, 4001)))[0]
    assert window.min() > 0.005 - 1e-9 and window.max() < 0.006 + 1e-9
    jerk = max(program.extreme(3, "max").value, -program.extreme(3, "min").value)
    assert jerk <= 5.0 * (1 + 1e-6)
    demands = [b.what for b in program.binding]
    for part in ("1", "2", "jerk"):  # the dwell of window 1, a bound of window 2, a limit
        assert [what for what in demands if part in what]


def test_what_a_binding_demand_is_worth_is_its_slope() -> None:
    """The jerk's limit relaxed a little: the peak falls by its worth."""
    dwell = (Window(radians(150), radians(230), 0.0, 0.0),)
    least = found(pieces=48, windows=dwell, limits=(), minimize="jerk").peak
    base, eased = (
        found(pieces=48, windows=dwell, limits=(("jerk", limit),)) for limit in (1.1 * least, 1.1 * least + 1e-4)
    )
    (worth,) = [b.worth for b in base.binding if "jerk" in b.what]

    assert base.peak - eased.peak == pytest.approx(0.0001 * worth, rel=1e-3)
    highest = max(base.extreme(2, "max").value, -base.extreme(2, "min").value)
    assert 0.98 * base.peak < highest <= base.peak * (1 + 1e-7)


def test_no_other_motion_of_the_known_laws_is_as_smooth() -> None:
    """Rise 10 mm over 90°, dwell 90°, fall, dwell: the least acceleration lies between 4 h/β² and the best law's."""
    program = FoundProgram(
        windows=(Window(radians(90), radians(180), 0.01, 0.01), Window(radians(270), radians(360), 0.0, 0.0)),
        pieces=240,
    )
    least = 4 * 0.01 / radians(90) ** 2
    assert least < program.extreme(2, "max").value < 4.888124 / 4 * least


@pytest.mark.parametrize(
    ("changes", "code", "key", "values"),
    [
        ({"limits": (("jerk", 0.5),)}, "nothing_meets", "find", {}),
        ({"points": (), "windows": ()}, "nothing_asked", "find", {}),
        ({"minimize": "noise"}, "aim", "find.minimize", {"aim": "noise"}),
        ({"windows": (Window(2.0, 1.0, 0.0, 1.0),)}, "window", "find.windows.0", {}),
        ({"points": ((7.0, 0.0),)}, "point_outside", "find.points.0", {}),
        ({"pieces": 3}, "pieces", "find.pieces", {"pieces": 3}),
    ],
)
def test_what_cannot_be_found_is_refused(
    changes: dict[str, object], code: str, key: str, values: dict[str, object]
) -> None:
    with pytest.raises(ModelError) as caught:
        found(**changes)
    said(caught.value.findings, code, key, **values)


def test_a_driver_follows_a_program() -> None:
    mechanism = lw.loads(MODEL.replace("PROGRAM", PROGRAM))
    motion = lw.solve_motion(mechanism, steps=200)
    assert motion.time[-1] == pytest.approx(0.995)
    assert np.degrees(motion.input[[0, 40, 60, 100]]) == pytest.approx([0, 90, 90, 180], abs=1e-9)
    rate = np.gradient(motion.input, motion.time)
    assert motion.link("crank").angular_velocity[2:-2] == pytest.approx(rate[2:-2], abs=0.12)
    again = lw.loads(lw.dump(mechanism))
    assert lw.solve_motion(again, steps=200).input == pytest.approx(motion.input, abs=1e-12)


@pytest.mark.parametrize(
    ("program", "code", "key", "values"),
    [
        (
            "[{rise: 90 deg, over: 0.2 s, law: constant_velocity}, {dwell: 1 s}]",
            "velocity_jump",
            ".1",
            {"place": "0.2 s", "after": "0"},
        ),
        ("[{rise: 90 deg, law: cycloidal}]", "missing-key", ".0", {}),
        ("[{rise: 90 deg, dwell: 1 s}]", "choice", ".0", {}),
        ("[{rise: 90 deg, over: 1 s, law: cyclodal}]", "unknown-word", ".0.law", {"text": "cyclodal"}),
        (
            "[{rise: 90 deg, over: 1 s, law: polydyne}]",
            "missing-key",
            ".0.law",
            {"law": "polydyne", "names": ("ratio",)},
        ),
        ("[{rise: 90 mm, over: 1 s}]", "wrong-dimension", ".0.rise", {"text": "90 mm"}),
        ("[]", "program_empty", "", {}),
        (
            "[{rise: 9 deg, over: 1 s, law: {kind: modified_sine, portion: [0.5, 0.2]}}]",
            "laws.portion",
            ".0.law",
            {"start": 0.5, "end": 0.2},
        ),
    ],
)
def test_a_program_in_a_file_is_checked_at_its_place(
    program: str, code: str, key: str, values: dict[str, object]
) -> None:
    found = findings(MODEL.replace("PROGRAM", program))
    assert said(found, code, f"driver.program{key}", **values).where.startswith("<text>:13:")


def test_a_program_that_does_not_repeat_ends() -> None:
    """It ends in motion and began at rest, so nothing is known beyond."""
    mechanism = lw.loads(MODEL.replace("PROGRAM", "[{rise: 90 deg, over: 0.2 s, velocity: 3 rad/s}]"))
    assert lw.solve_motion(mechanism, steps=10).input[-1] == pytest.approx(math.pi / 2)
    with refused("loads.table_range", first=0.0, last=0.2, begin=0.3):
        lw.solve_motion(mechanism, times=[0.3])
