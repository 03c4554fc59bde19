"""What motion, ranges and ranks refuse, or can say nothing of: with the reason and what to do."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from tests.failures.test_unreachable import TRIAD
from tests.invariants.test_limits_change_points import fourbar
from tests.invariants.test_limits_range import tied

import linkwright as lw
from linkwright.kinematics.assembly import AssemblyError
from linkwright.kinematics.constraint_system import drawn_coordinates
from linkwright.kinematics.input_range import input_range
from linkwright.kinematics.outcome import PositionError
from linkwright.kinematics.passing_proof import plainly_passed
from linkwright.kinematics.rank import rank_sentence
from linkwright.mechanism.geometry import mechanism_size
from linkwright.mechanism.mechanism import Cycle, Mechanism

SWUNG = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3 m}
  rocker: {points: [O2, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, position: "70 deg + 65 deg*sin(2*pi*t/(3 s))"}
cycle: {duration: 3 s}
"""


def test_words_left_from_another_driver_name_the_drawing() -> None:
    """Driven at its last link, a Stephenson linkage is a triad, which takes no word but a drawing."""
    text = """
format: 1
name: Stephenson
frame: {points: {A: [0 mm, 0 mm], D: [100 mm, 0 mm], G: [180 mm, 0 mm]}}
links:
  l2: {points: [A, B], length: 30 mm}
  l3: {points: {B: [0 mm, 0 mm], C: [90 mm, 0 mm], E: [60 mm, 50 mm]}}
  l4: {points: [D, C], length: 60 mm}
  l5: {points: [E, F], length: 70 mm}
  l6: {points: [G, F], length: 80 mm}
assembly: {C: left}
driver: {turn: l2, about: A, speed: 10 rpm}
"""
    lw.solve_motion(lw.loads(text.replace("length: 70 mm", "length: 120 mm")))
    with pytest.raises(AssemblyError) as refused:
        lw.solve_motion(lw.loads(text.replace("l2, about: A", "l6, about: G")))
    assert "assembly.C: as the machine is driven now" in str(refused.value)
    assert "drawing: {B: [x, y], C: [x, y], E: [x, y]}" in str(refused.value)


def test_a_group_without_closed_form_needs_its_points_drawn() -> None:
    text = re.sub("drawing:.*\n", "", TRIAD).replace("START", "160").replace("SPEED", "1")
    with pytest.raises(
        AssemblyError,
        match=r"crank, coupler, rocker, bar.* class 3 .*drawing: \{A: \[x, y\], B: \[x, y\], C:",
    ):
        lw.solve_motion(lw.loads(text))


@pytest.mark.parametrize("cycle", [Cycle(turns=1.0), Cycle(start=0.1, end=0.3)])
def test_a_cycle_by_a_coordinate_that_does_not_grow_evenly_is_refused(cycle: Cycle) -> None:
    with pytest.raises(lw.LinkwrightError, match="driver 'driver', which has no constant speed; write cycle"):
        lw.solve_motion(replace(lw.loads(SWUNG), cycle=cycle), steps=5)


TWO_BARS = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [3 m, 0 m]}}
links: {left: {points: [O1, A], length: 1 m}, right: {points: [O2, A], length: 1 m}}
assembly: {A: left}
"""
FIVE_BARS = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [1 m, 0 m], G: [0 m, 0 m]}}
links:
  left_crank: {points: [O1, A], length: 0.3 m}
  left_bar: {points: [A, B], length: 0.5 m}
  right_bar: {points: [C, B], length: 0.5 m}
  right_slide: {points: [C]}
joints: {bed: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: right_slide, at: C}}
drivers:
  left: {turn: left_crank, about: O1, speed: 1 rad/s}
  right: {slide: bed, speed: 2 m/s}
assembly: {B: left}
"""


def test_a_truss_that_does_not_close_is_refused_at_its_only_position() -> None:
    with pytest.raises(
        lw.LinkwrightError, match=r"at its only position: .* 3 m apart, .* reach 2 m: 1 m missing"
    ):
        lw.solve_motion(lw.loads(TWO_BARS))


@pytest.mark.parametrize(
    ("left", "right", "said"),
    [
        (
            [90, 180, 170],
            [0.9, 1.3, 0.5],
            "at input left = 180°, right = 1.3 m: group RRR (left_bar, right_bar)",
        ),
        (
            [180, 90, 120],
            [1.3, 0.9, 1.25],
            "at input left = 180°, right = 1.3 m (2 of 3 positions fail): group",
        ),
    ],
)
def test_a_refusal_names_the_first_failing_position_by_all_its_drivers(
    left: list[float], right: list[float], said: str
) -> None:
    with pytest.raises(lw.LinkwrightError) as refused:
        lw.solve_motion(lw.loads(FIVE_BARS), at={"left": np.radians(left), "right": right})
    assert said in str(refused.value) and "0.6 m missing" in str(refused.value)


def test_a_refusal_of_a_crank_tells_its_range() -> None:
    with pytest.raises(
        lw.LinkwrightError, match=r"cannot be solved .*; the crank can turn from .*; change the"
    ):
        lw.solve_motion(fourbar(3, 2, 2.5, 4, start=0), steps=12)


def test_a_table_without_pandas_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    motion = lw.solve_motion(lw.loads(SWUNG), steps=5)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(lw.LinkwrightError, match="pandas"):
        motion.to_dataframe()


def test_no_rank_is_said_where_no_position_is_reached() -> None:
    assert rank_sentence(fourbar(1, 1, 1, 9, start=0)) == ""
    assert rank_sentence(lw.loads(re.sub("cycle:.*\n", "", SWUNG))) == ""
    assert "mobility 1" in rank_sentence(lw.loads(SWUNG))


def test_a_dyad_that_is_out_of_reach_behind_a_triad_leaves_no_place_to_begin() -> None:
    """Stretched at 140°, while the drawing and the start are at 160°."""
    with pytest.raises(lw.LinkwrightError, match=r"cannot be assembled at any coordinate.*160"):
        input_range(tied(np.radians(140), 1))


PASSED = (
    "crank_rocker", "slider_crank_offset", "dyad_rpr", "parallelogram", "change_point_fourbar", "triad",
    "scotch_yoke", "external_gear_pair", "double_slider", "truss",
)  # fmt: skip


@pytest.mark.parametrize("name", PASSED)
def test_what_plainly_passes_its_cycle_is_so_when_it_is_solved(name: str) -> None:
    """Nothing is asked of machines of which plain numbers cannot tell."""
    mechanism = lw.load(f"gallery:{name}")
    motion = lw.solve_motion(mechanism, steps=36, failures="mark")
    whole = len(mechanism.drivers) == 1 and mechanism.cycle is None
    law = next(iter(mechanism.drivers.values())).law if mechanism.drivers else None
    groups = [p for p in motion.solver.motion.placed.values() if p.group.unknowns]
    closed = all("sine" not in p.facts and p.dyad is not None for p in groups)
    wheels = any(joint.higher for joint in mechanism.joints.values())
    plain = (
        whole and law is not None and law.constant_speed is not None and law.rotary and closed and not wheels
    )
    found = plainly_passed(mechanism, lw.structure(mechanism), 36)
    assert (found is not None) == (plain and bool(motion.ok.all()) and not motion.notes)


@pytest.mark.parametrize(
    ("make", "passed"),
    [
        (lambda: fourbar(1, 3, 2.5, 2, start=20), True),
        (lambda: fourbar(3, 1, 2.8, 3.2, start=50), False),
        (lambda: fourbar(1.00001, 3, 2, 4, start=20.5), False),
        (lambda: fourbar(0.99999, 3, 2, 4, start=20.5), False),
        (lambda: fourbar(0.9, 3, 2, 4, start=20.5), True),
        (lambda: replace(fourbar(1, 3, 2.5, 2, start=20), cycle=Cycle(turns=1.0)), False),
    ],
)
@pytest.mark.parametrize("steps", [5, 90])
def test_a_crank_that_comes_near_to_its_end_is_not_said_to_pass(
    make: Callable[[], Mechanism], passed: bool, steps: int
) -> None:
    mechanism = make()
    assert (plainly_passed(mechanism, lw.structure(mechanism), steps) is not None) is passed


TWO_CYLINDERS = """
format: 1
name: Two cylinders
frame: {points: {O: [0 m, 0 m], C: [0 m, -1 m]}}
links:
  boom: {points: {O: [0 m, 0 m], E: [3 m, 0 m], H: [1 m, 0 m], K: [2 m, 0 m]}}
  stick: {points: {E: [0 m, 0 m], L: [0 m, 0.5 m]}}
  barrel1: {points: [C]}
  rod1: {points: [H]}
  barrel2: {points: [K]}
  rod2: {points: [L]}
joints:
  lift: {kind: prismatic, guide: barrel1, through: C, direction: 0 deg, block: rod1, at: H}
  dig: {kind: prismatic, guide: barrel2, through: K, direction: 0 deg, block: rod2, at: L}
drawing: {H: [1 m, 0 m], E: [3 m, 0 m], K: [2 m, 0 m], L: [3 m, 0.5 m]}
drivers:
  raise: {slide: lift, position: "1.4 m + 0.1 m*sin(2*pi*t/(1 s))"}
  curl: {slide: dig, position: "1.4 m + 0.2 m*sin(2*pi*t/(1 s))"}
cycle: {duration: 1 s}
"""


def test_of_several_drivers_the_range_of_the_one_that_fails_is_told() -> None:
    """K and E are 1 m apart, E and L 0.5 m: the second cylinder goes from 0.5 to 1.5 m, and 1.6 m are asked for; the
    first one's range was told."""
    with pytest.raises(PositionError) as caught:
        lw.solve_motion(lw.loads(TWO_CYLINDERS))
    assert "with the other drivers at their start the rod2 can slide from 0.5 m to 1.5 m" in str(caught.value)
    assert "其余原动件停在起始位置时" in caught.value.say("zh")


def test_a_point_of_links_welded_there_is_one_point() -> None:
    """C needs no link before it, and both links' names of it mean the same place."""
    text = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 50 mm}
  rod: {points: [A, C], length: 180 mm}
  arm: {points: {C: [0 mm, 0 mm], B: [40 mm, 30 mm]}}
  rocker: {points: {O2: [0 mm, 0 mm], B: [150 mm, 0 mm]}}
joints:
  held: {kind: weld, links: [rod, arm], at: C}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
    motion = lw.solve_motion(lw.loads(text), steps=8)
    place = motion.point("C").position
    assert np.array_equal(place, motion.point("rod.C").position)
    assert place == pytest.approx(motion.point("arm.C").position, abs=1e-15)
    assert np.hypot(*(place - motion.point("A").position).T) == pytest.approx(0.18, rel=1e-12)


def test_drawn_coordinates_are_those_of_the_links_origins() -> None:
    """Of links whose named points lie off their origin, drawn where the motion has them: by hand, turned, moved."""
    text = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 1 m]}}
links:
  crank: {points: {O1: [0.3 m, -0.7 m], A: [1.3 m, -0.7 m]}}
  coupler: {points: {A: [0.2 m, 0.5 m], B: [3.2 m, 1.1 m]}}
  rocker: {points: {O2: [-0.4 m, 0.6 m], B: [-0.1 m, 3.1 m]}}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s, start: 40 deg}
"""
    machine = lw.loads(text)
    motion = lw.solve_motion(machine, at=[np.radians(40.0)])
    places = {name: motion.point(name).position[0] for name in ("A", "B")}
    drawn = ", ".join(
        f"{name}: [{x!r} m, {y!r} m]" for name, (x, y) in ((n, map(float, p)) for n, p in places.items())
    )
    found = drawn_coordinates(lw.loads(text + f"drawing: {{{drawn}}}\n"))
    assert found is not None
    size, rows = mechanism_size(machine), found.reshape(-1, 3)
    for (name, link), (x, y, angle) in zip(machine.links.items(), rows, strict=True):
        point, local = next(iter(link.points.items()))
        turned = complex(*local) * np.exp(1j * motion.link(name).angle[0])
        origin = complex(*motion.point(f"{name}.{point}").position[0]) - turned
        assert complex(x, y) * size == pytest.approx(origin, abs=1e-12)
        assert np.exp(1j * angle) == pytest.approx(np.exp(1j * motion.link(name).angle[0]), abs=1e-12)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (
            lambda m: lw.solve_motion(m, at="30 deg"),
            '"30 deg" is a text; give the number in SI units (rad, m, s): 0.523599',
        ),
        (lambda m: lw.solve_motion(m, times=["1 s"]), '"1 s" is a text; give the number in SI units'),
        (lambda m: lw.solve_motion(m, failures="ignore"), "failures is 'ignore'; give 'raise'"),
        (
            lambda m: m.with_dimensions({"coupler.length": "60 mm"}),
            "coupler.length: '60 mm' is no number; give its SI",
        ),
    ],
)
def test_texts_for_numbers_and_other_ways_with_failures_are_told(
    asked: Callable[[Mechanism], object], told: str
) -> None:
    with pytest.raises(lw.LinkwrightError) as refused:
        asked(lw.load("gallery:crank_rocker"))
    assert told in str(refused.value) and str(refused.value) != refused.value.say("zh")
