"""Limit positions against published numbers and closed forms of the textbooks."""

from __future__ import annotations

import math
from math import asin, atan2, cos, degrees, hypot, pi, radians, sin, sqrt

import numpy as np
import pytest

import linkwright as lw
from linkwright.events.limit_positions import LimitPosition, limit_positions

Point = tuple[float, float]


def limits(model: str, output: str, **options: int) -> tuple[LimitPosition, ...]:
    return limit_positions(lw.solve_motion(lw.load(f"gallery:{model}"), **options), output)


def folded_inputs(o1: Point, o3: Point, crank: float, coupler: float, rocker: float) -> list[float]:
    """Crank angles of a four-bar's limits (all roots): crank and coupler in line, B by the law of cosines."""
    found = []
    base = atan2(o3[1] - o1[1], o3[0] - o1[0])
    frame = hypot(o3[0] - o1[0], o3[1] - o1[1])
    for reach, turn in ((coupler + crank, 0.0), (coupler - crank, pi)):
        angle = math.acos((frame**2 + reach**2 - rocker**2) / (2 * frame * reach))
        found += [base + angle + turn, base - angle + turn]
    return found


def nearest_root(value: float, roots: list[float]) -> float:
    return min(abs((value - root + pi) % (2 * pi) - pi) for root in roots)


def test_swing_conveyor_limits_as_published() -> None:
    """The published limits 231.6500775°, with the slider at 0.662387 m, and 348.743° (source: the gallery file)."""
    found = {round(degrees(each.input)): each for each in limits("swing_conveyor", "guide")}
    first, second = found[232], found[349]
    assert degrees(first.input) == pytest.approx(231.6500775, abs=2e-7)
    assert first.value == pytest.approx(0.662387, abs=6e-7)
    assert first.kind == "min" and first.index == 231
    assert degrees(second.input) == pytest.approx(348.743, abs=6e-4)


def test_swing_conveyor_limits_are_those_of_the_rocker() -> None:
    roots = folded_inputs((0.0, 0.0), (0.19, -0.10), 0.12, 0.40, 0.32)
    found = limits("swing_conveyor", "rocker")
    assert [each.kind for each in found] == ["max", "min"]
    assert max(nearest_root(each.input, roots) for each in found) < 4e-15


def test_offset_slider_crank() -> None:
    """Stroke √((l+r)²-e²) - √((l-r)²-e²), limits with crank and rod in line."""
    r, length, e = 0.198, 0.7025, 0.0605
    far, near = limits("slider_crank_offset", "guide")
    outer, inner = sqrt((length + r) ** 2 - e**2), sqrt((length - r) ** 2 - e**2)
    assert (far.kind, near.kind) == ("max", "min")
    assert far.value == pytest.approx(outer, abs=3e-16)
    assert near.value == pytest.approx(inner, abs=3e-16)
    assert far.input == pytest.approx(asin(e / (length + r)), abs=2e-16)
    assert near.input == pytest.approx(pi + asin(e / (length - r)), abs=1e-15)


@pytest.mark.parametrize("steps", [24, 90, 360, 1000])
def test_jaw_crusher_jaw(steps: int) -> None:
    """The jaw reverses with the rocker, where crank and pitman are in line."""
    roots = folded_inputs((0.0, 0.0), (0.94, -1.0), 0.1, 1.25, 1.0)
    found = limits("jaw_crusher_sixbar", "jaw", steps=steps)
    assert sorted(each.kind for each in found) == ["max", "min"]
    assert max(nearest_root(each.input, roots) for each in found) < 2e-15


def jaw_angle(crank: float) -> float:
    """Angle of the crusher's jaw from two intersections of circles, written out here."""
    ax, ay = 0.1 * cos(crank), 0.1 * sin(crank)
    bx, by = intersection((ax, ay), 1.25, (0.94, -1.0), 1.0, -1)
    cx, cy = intersection((bx, by), 1.15, (-1.0, 0.85), 1.96, 1)
    return atan2(cy - 0.85, cx + 1.0)


def intersection(p: Point, r: float, q: Point, s: float, side: int) -> Point:
    dx, dy = q[0] - p[0], q[1] - p[1]
    d = hypot(dx, dy)
    along = (d * d + r * r - s * s) / (2 * d)
    across = side * sqrt(r * r - along * along)
    return p[0] + (along * dx - across * dy) / d, p[1] + (along * dy + across * dx) / d


def test_jaw_crusher_jaw_against_own_search() -> None:
    """Ternary search on the jaw angle itself; a maximum's place is known to the root of the rounding only."""
    for each in limits("jaw_crusher_sixbar", "jaw"):
        sign = 1.0 if each.kind == "max" else -1.0
        low, high = each.input - radians(20), each.input + radians(20)
        for _ in range(100):
            a, b = low + (high - low) / 3, high - (high - low) / 3
            low, high = (a, high) if sign * jaw_angle(a) < sign * jaw_angle(b) else (low, b)
        assert each.input == pytest.approx(0.5 * (low + high), abs=1e-6)
        assert each.value == pytest.approx(jaw_angle(low), abs=1e-14)


def test_published_swing_of_the_jaw() -> None:
    found = limits("jaw_crusher_sixbar", "jaw")
    swing = found[0].value - found[1].value
    table = [jaw_angle(radians(k)) for k in range(360)]
    assert swing == pytest.approx(max(table) - min(table), rel=2e-4)
    assert swing >= max(table) - min(table)


def test_quick_return_of_crank_rocker_from_limits() -> None:
    """Crank angle between the limits: (π+θ)/(π-θ) with θ from the law of cosines (Norton, ch. 3)."""
    low, high = limits("crank_rocker", "rocker")
    mechanism = lw.load("gallery:crank_rocker")
    a, b, c = (mechanism.dimension(f"{name}.length") for name in ("crank", "coupler", "rocker"))
    o1, o2 = mechanism.frame.points["O1"], mechanism.frame.points["O2"]
    roots = folded_inputs(o1, o2, a, b, c)
    assert max(nearest_root(each.input, roots) for each in (low, high)) < 2e-15
    assert np.sign(high.value - low.value) == 1.0


@pytest.mark.parametrize("steps", [45, 360])
@pytest.mark.parametrize("law", ["cycloidal", "polynomial_345", "polynomial_4567"])
def test_a_rest_has_its_limit_in_its_middle_whatever_the_steps(law: str, steps: int) -> None:
    """33.3° of rest, 95.1° up, 71.3° of rest, 130.3° down, 30° of rest, however softly a law leaves a rest."""
    model = lw.loads(f"""
format: 1
name: Cam feed
frame: {{points: {{O: [0 mm, 0 mm], G: [0 mm, 50 mm]}}}}
links:
  shaft: {{points: [O]}}
  slide: {{points: [P]}}
joints:
  guide: {{kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}}
  lobe:
    {{kind: cam, cam: shaft, follower: slide, at: P, touch: roller, roller_radius: 8 mm, base_radius: 40 mm,
      program: [{{dwell: 33.3 deg}}, {{rise: 20 mm, over: 95.1 deg, law: {law}}}, {{dwell: 71.3 deg}},
                {{fall: 20 mm, over: 130.3 deg, law: {law}}}, {{dwell: 30 deg}}]}}
driver: {{turn: shaft, about: O, speed: 60 rpm}}
""")
    low, high = limit_positions(lw.solve_motion(model, steps=steps), "guide")
    assert (low.kind, high.kind) == ("min", "max")
    assert degrees(low.input) == pytest.approx((33.3 - 30) / 2, abs=1e-12)
    assert degrees(high.input) == pytest.approx(33.3 + 95.1 + 71.3 / 2, abs=1e-12)


@pytest.mark.parametrize("steps", [37, 45, 48, 360])
def test_a_rest_between_two_positions_has_its_limit_in_its_middle(steps: int) -> None:
    """A slide that a program moves up in 2 s, holds for 0.04 s and moves back in 2.5 s."""
    model = lw.loads("""
format: 1
name: Feed
frame: {points: {G: [0 mm, 0 mm]}}
links: {slide: {points: [P]}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slide, at: P, block_angle: 0 deg}
driver:
  slide: guide
  program: [{rise: 20 mm, over: 2 s, law: cycloidal}, {dwell: 0.04 s}, {fall: 20 mm, over: 2.5 s, law: cycloidal}]
""")
    (high,) = (each for each in limit_positions(lw.solve_motion(model, steps=steps), "guide") if each.kind == "max")
    assert high.time == pytest.approx(2.02, abs=1e-12)
    assert high.value == pytest.approx(0.02, rel=1e-12)


@pytest.mark.parametrize("law", ["cycloidal", "polynomial_4567"])
@pytest.mark.parametrize("steps", [24, 97, 360])
def test_rests_of_a_cam_that_rocks_lie_between_the_times_of_its_bends(law: str, steps: int) -> None:
    """A shaft at 60° sin(2πt/T): its cam rises from -40° to 10°, rests up to 50°, falls up to 55°, rests up to 70°.

    On the way up the slide stands highest between 10° and 50° and lower from 55° over the dead point at 60° back to
    55°; lowest, from -40° over -60° back to -40°.
    """
    model = lw.loads(f"""
format: 1
name: Rocked feed
frame: {{points: {{O: [0 mm, 0 mm], G: [0 mm, 50 mm]}}}}
links:
  shaft: {{points: [O]}}
  slide: {{points: [P]}}
joints:
  guide: {{kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}}
  lobe:
    {{kind: cam, cam: shaft, follower: slide, at: P, touch: roller, roller_radius: 8 mm, base_radius: 60 mm,
      turn: counterclockwise, phase: -70 deg, program: [{{dwell: 30 deg}}, {{rise: 20 mm, over: 50 deg, law: {law}}},
      {{dwell: 40 deg}}, {{fall: 4 mm, over: 5 deg, law: {law}}}, {{dwell: 15 deg}},
      {{fall: 16 mm, over: 220 deg, law: {law}}}]}}
driver: {{turn: shaft, about: O, position: "60 deg*sin(2*pi*t/(2 s))"}}
cycle: {{duration: 2 s}}
""")

    def time(angle: float) -> float:
        return asin(angle / 60) / pi

    found = limit_positions(lw.solve_motion(model, steps=steps), "guide")
    up, back = 0.5 * (time(10) + time(50)), 1.0 - 0.5 * (time(10) + time(50))
    expected = [("max", up), ("min", 0.5), ("max", back), ("min", 1.5)]
    assert [each.kind for each in found] == [kind for kind, _ in expected]
    assert [each.time for each in found] == pytest.approx([each for _, each in expected], abs=1e-12)


@pytest.mark.parametrize("steps", [16, 45, 360])
def test_a_rest_of_an_expression_lies_between_its_kinks(steps: int) -> None:
    """A sine cut off at 0.2 and 0.9 rests around its extremes, which lie in the middle."""
    model = lw.loads("""
format: 1
name: Feed
frame: {points: {G: [0 mm, 0 mm]}}
links: {slide: {points: [P]}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slide, at: P, block_angle: 0 deg}
driver: {slide: guide, position: "100 mm*max(min(sin(2*pi*t/(1.7 s)), 0.9), 0.2)^3"}
cycle: {duration: 2.6 s}
""")
    found = limit_positions(lw.solve_motion(model, steps=steps), "guide")
    assert [each.kind for each in found] == ["max", "min", "max"]
    assert [each.time / 1.7 for each in found] == pytest.approx([0.25, 0.75, 1.25], abs=1e-12)
    assert found[1].value == pytest.approx(0.1 * 0.2**3, rel=1e-12)
