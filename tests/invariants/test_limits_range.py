"""Input ranges against the law of cosines, and against the limits of the mechanism driven from the other side."""

from __future__ import annotations

import json
from math import acos, degrees, pi, radians, sqrt, tan
from typing import Any

import numpy as np
import pytest
import yaml
from tests.invariants.output_driven import tied, triad, turned
from tests.refusals import refused
from tests.store import machine as stored
from tests.store import motion as moved

import linkwright as lw
from linkwright import input_range, limit_positions

FOURBAR = """
format: 1
name: four-bar
frame: {{points: {{O1: [0 m, 0 m], O2: [{d} m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: {a} m}}
  coupler: {{points: [A, B], length: {b} m}}
  rocker: {{points: [O2, B], length: {c} m}}
assembly: {{{inner}: {mode}}}
driver: {{turn: {turn}, about: {about}, speed: 1 rad/s, start: {start} deg}}
"""


def fourbar(
    a: float, b: float, c: float, d: float, *, start: float, mode: str = "left", turn: str = "crank"
) -> lw.Mechanism:
    about, inner = ("O1", "B") if turn == "crank" else ("O2", "A")
    text = FOURBAR.format(a=a, b=b, c=c, d=d, start=start, mode=mode, turn=turn, about=about, inner=inner)
    return lw.loads(text)


def opposite(a: float, d: float, reach: float) -> float:
    """Angle between sides a and d of a triangle whose third side is ``reach``."""
    return acos((a * a + d * d - reach * reach) / (2 * a * d))


def ends(found: Any) -> tuple[float, float]:
    assert found.start is not None and found.end is not None
    return found.start, found.end


@pytest.mark.parametrize(
    ("a", "b", "c", "d"), [(3.0, 2.0, 2.5, 4.0), (2.0, 1.5, 1.5, 2.2), (1.7, 1.1, 1.4, 1.3), (1.5, 2.5, 0.9, 1.6)]
)
@pytest.mark.parametrize("mode", ["left", "right"])
@pytest.mark.parametrize("share", [-0.93, 0.1, 0.7])
def test_triple_rockers(a: float, b: float, c: float, d: float, mode: str, share: float) -> None:
    """s + l > p + q: the input stops where coupler and rocker are stretched, on both sides of the frame line, or
    folded, on both sides of the opposite direction."""
    assert min(a, b, c, d) + max(a, b, c, d) > 0.5 * (a + b + c + d)
    stretched = a + d > b + c
    end = opposite(a, d, b + c) if stretched else opposite(a, d, abs(b - c))
    middle = 0.0 if stretched else pi
    half = end if stretched else pi - end
    found = input_range(fourbar(a, b, c, d, start=degrees(middle + share * half), mode=mode))
    assert np.allclose(ends(found), (middle - half, middle + half), rtol=0, atol=4e-15 / np.sin(end))
    for each, exact in ((found.low, middle - half), (found.high, middle + half)):
        assert each is not None and abs(each.value - exact) - 4e-15 / np.sin(end) <= each.precision < 1e-13
        assert each.precision >= 4e-16 * (1.0 + abs(each.value))  # its rounding, never less than nothing
    how = "stretched" if stretched else "folded"
    for each in (found.low, found.high):
        assert each.how.code == f"range.{how}" and each.group.values["links"] == ("coupler", "rocker")


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_double_rocker_has_two_ranges(sign: float) -> None:
    """Shortest link the coupler: folded at one end, stretched at the other, apart on both sides of the frame."""
    a, b, c, d = 3.0, 1.0, 2.8, 3.2
    found = input_range(fourbar(a, b, c, d, start=sign * 50))
    near, far = opposite(a, d, c - b), opposite(a, d, b + c)
    assert sorted(abs(value) for value in ends(found)) == pytest.approx([near, far], abs=2e-15)
    assert {found.low.how.code, found.high.how.code} == {"range.folded", "range.stretched"}


def test_a_range_is_told_with_its_ends() -> None:
    found = input_range(fourbar(1.9, 1.5, 2.2, 4.0, start=0))
    limit = degrees(opposite(1.9, 4.0, 3.7))
    assert not found.full
    assert f"-{limit:.7g}°" in found.explain() and f" {limit:.7g}°" in found.explain()


@pytest.mark.parametrize(
    "name", ["crank_rocker", "jaw_crusher_sixbar", "triad", "change_point_fourbar", "oldham_coupling"]
)
def test_cranks_turn_fully(name: str) -> None:
    found = input_range(stored(name))
    assert found.full and found.start is None and found.end is None


def test_rocker_of_a_crank_rocker() -> None:
    """Driven at the rocker, the range is the swing that the crank gives it."""
    swing = limit_positions(moved("crank_rocker"), "rocker")
    model = stored("crank_rocker")
    a, b, c = (model.dimension(f"{name}.length") for name in ("crank", "coupler", "rocker"))
    (x1, y1), (x2, y2) = model.frame.points["O1"], model.frame.points["O2"]
    assert y1 == y2
    start = degrees(sum(each.value for each in swing) / 2)
    found = input_range(fourbar(a, b, c, x2 - x1, start=start, turn="rocker"))
    assert ends(found) == pytest.approx(sorted(each.value for each in swing), abs=4e-15)


def test_fold_of_a_triad() -> None:
    """The output-driven Stephenson six-bar (a triad) stops where the crank-driven one reverses its output."""
    swing = limit_positions(moved("stephenson_sixbar"), "output")
    found = input_range(stored("stephenson_sixbar_triad"))
    start, end = ends(found)
    values = [each.value % (2 * pi) for each in swing]
    assert min(abs(start - value) for value in values) < 1e-14
    assert min(abs(end - value) for value in values) < 1e-14
    assert found.low is not None and found.low.precision < 1e-13
    assert found.low.how.code == "range.singular"


def test_ladder() -> None:
    """A bar of 0.5 m between wall and floor: the foot goes 0.5 m to both sides."""
    found = input_range(stored("double_slider"))
    assert ends(found) == pytest.approx((-0.5, 0.5), abs=2e-16)
    assert not found.rotary and "-500 mm" in found.explain() and " 500 mm" in found.explain()
    assert found.low.group.values["links"] == found.high.group.values["links"] == ("bar", "head")


def test_slider_driven_slider_crank() -> None:
    """The slider's range is the stroke √((l+r)²-e²) - √((l-r)²-e²)."""
    r, length, e = 0.198, 0.7025, 0.0605
    mechanism = lw.loads(f"""
format: 1
name: engine
frame: {{points: {{O: [0 m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: {r} m}}
  rod: {{points: [A, B], length: {length} m}}
  slider: {{points: [B]}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B, offset: {e} m}}
driver: {{slide: guide, speed: 0.1 m/s, start: 0.7 m}}
cycle: {{from: 0.6 m, to: 0.8 m}}
""")
    found = input_range(mechanism)
    expected = (sqrt((length - r) ** 2 - e**2), sqrt((length + r) ** 2 - e**2))
    assert ends(found) == pytest.approx(expected, abs=5e-16)


def test_tangent_mechanism_stops_at_parallel_guides() -> None:
    found = input_range(stored("tangent_mechanism"))
    assert ends(found) == pytest.approx((-pi / 2, pi / 2), abs=2e-15)
    assert found.low.how.code == found.high.how.code == "range.parallel"


def test_a_dyad_that_ends_the_range_just_before_guides_are_parallel_is_named() -> None:
    """The tangent mechanism with a dyad far above on its rod, folded 0.4° before the guides are parallel."""
    reach = 120 * tan(radians(89.6))
    data = yaml.safe_load(lw.dump(stored("tangent_mechanism")))
    for key in ("expected", "report"):
        data.pop(key, None)
    data["links"]["rod"]["points"] = {"B": [0, 0], "C": [0, 0]}
    data["links"]["chain"] = {"points": ["C", "D"], "length": "12 m"}
    data["links"]["tie"] = {"points": ["W", "D"], "length": "10 m"}
    data["frame"]["points"]["W"] = ["120 mm", f"{reach + 2000!r} mm"]
    data["driver"]["start"] = "80 deg"
    data["assembly"] = {"D": "left"}
    found = input_range(lw.loads(json.dumps(data)))
    assert found.high is not None
    assert found.high.value == pytest.approx(radians(89.6), abs=1e-9)
    assert found.high.group.values["links"] == ("chain", "tie") and found.high.how.code == "range.folded"


def test_kite_passes_the_point_where_its_pins_meet() -> None:
    """Crank and frame of 2 m, coupler and rocker of 1 m: A passes through O2 at 0°, the end is at 60°."""
    found = input_range(fourbar(2.0, 1.0, 1.0, 2.0, start=25))
    assert ends(found) == pytest.approx((-pi / 3, pi / 3), abs=2e-15)


def test_named_driver_of_several() -> None:
    found = input_range(stored("dyad_prp"), "swing")
    assert ends(found) == pytest.approx((-pi / 2, pi / 2), abs=2e-15)
    with refused("names.no_such", noun="driver", name="swings", offer="swing"):
        input_range(stored("dyad_prp"), "swings")


def test_start_out_of_reach_uses_the_nearest_position() -> None:
    found = input_range(fourbar(3.0, 2.0, 2.5, 4.0, start=170))
    assert ends(found)[1] == pytest.approx(opposite(3.0, 4.0, 4.5), abs=2e-15)


def test_end_is_the_last_position_that_solves() -> None:
    mechanism = fourbar(3.0, 2.0, 2.5, 4.0, start=10)
    start, end = ends(input_range(mechanism))
    inside = lw.solve_motion(mechanism, at=[start + 1e-9, 0.0, end - 1e-9])
    assert inside.ok.all()
    outside = lw.solve_motion(mechanism, at=[start - 1e-9, end + 1e-9, radians(180)], failures="mark")
    assert not outside.ok.any()


SIX = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], E: [180 mm, 0 mm], G: [300 mm, 200 mm]}}
links:
  crank: {points: [O1, A], length: 50 mm}
  base: {points: [O2]}
  coupler: {points: [A, B], length: 180 mm, also: {C: [110 mm, 70 mm]}}
  rocker: {points: [O2, B], length: 130 mm}
  bar: {points: [C, D], length: 190 mm}
  ram: {points: [D]}
joints:
  bed: {kind: prismatic, guide: frame, through: E, direction: 0 deg, block: base, at: O2}
  way: {kind: prismatic, guide: frame, through: G, direction: 20 deg, block: ram, at: D}
"""
HELD = '"SHIFT mm + 1 mm*t/(1 s)"'


@pytest.mark.parametrize("shift", ["20", "12.5"])
def test_a_pushed_ram_goes_as_far_as_the_crank_would_take_it(shift: str) -> None:
    """Driven at its ram the six-bar is a triad; its fold is where the crank-driven one reverses its ram. The second
    driver, which holds a bearing, stays at its start."""
    assembly = "assembly: {B: left, D: forward}\n"
    still = HELD.replace("SHIFT", shift).replace("+ 1 mm", "+ 0 mm")
    drivers = "drivers: {turn: {turn: crank, about: O1, speed: 1 rad/s}, hold: {slide: bed, position: STILL}}\n"
    cranked = lw.loads(SIX + assembly + drivers.replace("STILL", still) + "cycle: {turns: 1}\n")
    motion = lw.solve_motion(cranked, steps=90)
    swing = sorted(each.value for each in limit_positions(motion, "way"))
    drawn = {p: motion.point(p).position[20] for p in "ABCD"} | {"O2": motion.point("O2").position[20]}
    drawing = ", ".join(f"{name}: [{float(x)!r} m, {float(y)!r} m]" for name, (x, y) in drawn.items())
    start = float(motion.joint("way").displacement[20])
    pushed = lw.loads(
        SIX
        + f"drawing: {{{drawing}}}\ndrivers:\n  push: {{slide: way, speed: 0.01 m/s, start: {start!r} m}}\n"
        + f"  hold: {{slide: bed, position: {HELD.replace('SHIFT', shift)}}}\ncycle: {{duration: 0.1 s}}\n"
    )
    found = input_range(pushed, "push")
    assert not found.rotary and found.low.how.code == found.high.how.code == "range.singular"
    assert ends(found) == pytest.approx((swing[0], swing[-1]), abs=1e-13)
    assert found.low is not None and found.high is not None
    assert max(found.low.precision, found.high.precision) < 1e-12


@pytest.mark.rotating
@pytest.mark.parametrize(("frame", "laps"), [(148.0, 0), (172.0, 2), (172.0, -3)])
def test_a_fold_behind_a_change_point(frame: float, laps: int) -> None:
    """The output of a triad turns a parallelogram that lines up on one side of the start: nothing but the triad ends
    the range, in whichever lap it begins."""
    (x, y), (ex, ey) = turned(90, frame), turned(60, 160)
    links = "follower: {points: [O4, L], length: 60 mm}\n  link: {points: [L, E], length: 90 mm}"
    text = triad(links, f", O4: [{x!r} mm, {y!r} mm]", "", start=160 + 360 * laps)
    drawn = f"L: [{x + ex - 300!r} mm, {y + ey - 200!r} mm], E: [{ex!r} mm, {ey!r} mm]"
    found = input_range(lw.loads(text.replace("drawing: {", f"drawing: {{{drawn}, ")))
    exact = np.add(ends(input_range(stored("stephenson_sixbar_triad"))), 2 * pi * laps)
    assert ends(found) == pytest.approx(tuple(exact), abs=1e-13)
    for each in (found.low, found.high):
        assert each is not None and each.how.code == "range.singular" and "crank" in each.group
        assert np.spacing(abs(each.value)) <= each.precision < 1e-12


@pytest.mark.rotating
@pytest.mark.parametrize(("side", "off"), [(1, -30.0), (1, -0.7), (1, -0.04), (-1, 9.0), (-1, 0.3)])
def test_a_dyad_before_the_fold_of_a_triad_ends_the_range(side: int, off: float) -> None:
    """A little before the triad is singular, or long before."""
    low, high = ends(input_range(stored("stephenson_sixbar_triad")))
    end = (high if side > 0 else low) + radians(off)
    found = input_range(tied(end, side, begin=160 if off > -20 else 140))
    stopped, other = (found.high, found.low) if side > 0 else (found.low, found.high)
    assert stopped is not None and other is not None
    assert stopped.value == pytest.approx(end, abs=2e-9)
    assert abs(stopped.value - end) <= stopped.precision + 1e-12
    assert stopped.group.values["links"] == ("arm", "leg") and stopped.how.code == "range.stretched"
    assert other.value == pytest.approx(low if side > 0 else high, abs=1e-9)


@pytest.mark.rotating
@pytest.mark.parametrize("off", [0.2, 0.9, 3.0])
def test_a_dyad_beyond_the_fold_of_a_triad_does_not(off: float) -> None:
    low, high = ends(input_range(stored("stephenson_sixbar_triad")))
    found = input_range(tied(high + radians(off), 1))
    assert ends(found) == pytest.approx((low, high), abs=1e-9)
    assert found.high is not None and found.high.how.code == "range.singular" and "crank" in found.high.group
