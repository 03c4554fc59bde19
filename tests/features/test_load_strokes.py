"""Parts of a stroke and loads against the velocity, by hand: a centric slider-crank and a crank with a brake.

With the crank r and the rod l the pin of the slider is at x = r cos θ + √(l² - r² sin² θ), so the stroke is 2 r, the
slider is h before its outer limit where cos θ = ((r + l - h)² + r² - l²) / (2 r (r + l - h)), and it moves outward
while the crank turns from 180° to 360°.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.refusals import findings, refused, said

import linkwright as lw

R, ROD = 0.05, 0.2
PRESS = """
format: 1
name: press
frame: {{points: {{O: [0 m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: 50 mm}}
  rod: {{points: [A, B], length: 200 mm}}
  ram: {{points: [B]}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B}}
assembly: {{B: forward}}
driver: {{turn: crank, about: O, speed: {speed} rpm}}
loads:
  press: {{kind: force, on: ram, at: B, {load}}}
"""
STEPS = 720


def pressed(load: str, speed: int = 60) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Crank angle in degrees, 0 to 360, and the load that the slider feels, taken from the balance at the ram.

    Without masses the rod is a two-force link, so the load is the reaction along the guide reversed.
    """
    motion = lw.solve_motion(lw.loads(PRESS.format(load=load, speed=speed)), steps=STEPS)
    forces = lw.solve_forces(motion)
    return np.degrees(motion.input) % 360, -forces.reaction("B", on="ram")[:, 0]


def crank_angle(before: float) -> float:
    """Crank angle (deg, outward stroke) at which the slider is ``before`` m from its outer limit."""
    x = R + ROD - before
    cosine = (x * x + R * R - ROD * ROD) / (2 * R * x)
    return 360 - math.degrees(math.acos(max(cosine, -1.0)))


FULL = "direction: 180 deg, magnitude: 1 kN, phase: {of: guide, from: min, to: max"
FREE_STARTS = [("0.05", 0.095, 0.005), ("5 mm", 0.095, 0.005), ("[0.2, 10 mm]", 0.08, 0.01), ("[0, 0.1]", 0.1, 0.01)]


@pytest.mark.parametrize(("last", "way"), [("10 mm", 0.01), ("0.1", 0.01), ("0.25", 0.025), ("100 mm", 0.1)])
def test_the_last_part_of_a_stroke(last: str, way: float) -> None:
    angle, load = pressed(f"{FULL}, last: {last}}}")
    inside = (angle > crank_angle(way) + 1e-6) & (angle < 360 - 1e-6)
    outside = (angle < crank_angle(way) - 1e-6) & (angle > 1e-6)
    assert inside.sum() > 40
    np.testing.assert_allclose(load[inside], -1000, rtol=1e-9)
    np.testing.assert_allclose(load[outside], 0, atol=1e-9)


def test_the_first_part_of_a_stroke_turned_the_other_way() -> None:
    """Backwards the crank passes 360° to 180° on the way in and the slider leaves the inner limit at 180°."""
    angle, load = pressed(f"{FULL}, first: 30 mm}}", speed=-60)
    mirrored = 360 - crank_angle(0.07)
    inside = (angle < 180 - 1e-6) & (angle > mirrored + 1e-6)
    np.testing.assert_allclose(load[inside], -1000, rtol=1e-9)
    np.testing.assert_allclose(load[(angle > 180 + 1e-6) | (angle < mirrored - 1e-6)], 0, atol=1e-9)


@pytest.mark.parametrize(("free", "begin", "end"), FREE_STARTS)
def test_free_ends_of_a_stroke(free: str, begin: float, end: float) -> None:
    angle, load = pressed(f"{FULL}, free: {free}}}")
    first, last = crank_angle(begin), crank_angle(end)
    inside = (angle > first + 1e-6) & (angle < last - 1e-6)
    np.testing.assert_allclose(load[inside], -1000, rtol=1e-9)
    np.testing.assert_allclose(load[(angle < first - 1e-6) | (angle > last + 1e-6)], 0, atol=1e-9)


def test_a_ramp_over_a_part_grows_with_the_way() -> None:
    """From 0 to 2 kN over the last 20 mm: 100 N for every mm."""
    angle, load = pressed(
        "direction: 180 deg, ramp: [0 N, 2 kN], phase: {of: guide, from: min, to: max, last: 20 mm}"
    )
    theta = np.radians(angle)
    left = R + ROD - (R * np.cos(theta) + np.sqrt(ROD**2 - (R * np.sin(theta)) ** 2))
    inside = (angle > crank_angle(0.02) + 1e-6) & (angle < 360 - 1e-6)
    np.testing.assert_allclose(load[inside], -1e5 * (0.02 - left[inside]), rtol=1e-9, atol=1e-6)


def test_an_angle_takes_shares_and_angles() -> None:
    """The rod swings ± asin(r/l); its last 5° before its largest angle."""
    widest = math.degrees(math.asin(R / ROD))
    angle, load = pressed("direction: 180 deg, magnitude: 1 kN, phase: {of: rod, from: min, to: max, last: 5 deg}")
    rod = -np.degrees(np.arcsin(R / ROD * np.sin(np.radians(angle))))
    inside = (rod > widest - 5 + 1e-6) & (angle < 270 - 1e-6) & (angle > 90)
    np.testing.assert_allclose(load[inside], -1000, rtol=1e-9)
    outside = (rod < widest - 5 - 1e-6) | (angle > 270 + 1e-6)
    np.testing.assert_allclose(load[outside], 0, atol=1e-9)


def test_more_than_the_stroke_is_refused_with_its_length() -> None:
    with refused("loads.part_too_long", name="press", part="last", amounts="120 mm", stroke="100 mm", output="guide"):
        pressed(f"{FULL}, last: 120 mm}}")
    with refused("loads.part_too_long", part="free", amounts="60 mm + 50 mm"):
        pressed(f"{FULL}, free: [60 mm, 0.5]}}")


@pytest.mark.parametrize(
    ("part", "code", "key", "values"),
    [
        ("last: 1.5", "range", ".last", {"text": "1.5", "example": "10 mm"}),
        ("last: 0", "range", ".last", {"text": "0"}),
        ("first: -10 mm", "range", ".first", {"text": "-10 mm"}),
        ("last: 10 deg", "wrong-dimension", ".last", {"text": "10 deg"}),
        ("free: [0.1]", "count", ".free", {"found": 1, "count": 2}),
        ("first: 0.1, last: 0.1", "choice", "", {"words": ("first", "last")}),
    ],
)
def test_a_part_that_is_none_is_a_finding(part: str, code: str, key: str, values: dict[str, object]) -> None:
    found = findings(PRESS.format(load=f"{FULL}, {part}}}", speed=60))
    assert said(found, code, f"loads.press.phase{key}", **values).where.startswith("<text>:14:")


@pytest.mark.parametrize("part", ["last: 10 mm", "first: 0.25", "free: [0.05, 0.1]", "free: 5 mm"])
def test_a_part_is_written_as_it_was_read(part: str) -> None:
    mechanism = lw.loads(PRESS.format(load=f"{FULL}, {part}}}", speed=60))
    again = lw.loads(lw.dump(mechanism))
    assert again.loads == mechanism.loads


def test_a_force_opposes_the_velocity_of_its_point() -> None:
    angle, load = pressed("opposes: velocity, magnitude: 1 kN")
    np.testing.assert_allclose(load[(angle > 1) & (angle < 179)], 1000, rtol=1e-9)
    np.testing.assert_allclose(load[(angle > 181) & (angle < 359)], -1000, rtol=1e-9)


CRANK = """
format: 1
name: crank
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{crank: {{points: [O, A], length: 50 mm}}}}
driver: {{turn: crank, about: O, position: "60 deg*sin(2*pi*t/(1 s))"}}
cycle: {{duration: 1 s}}
loads: {{drag: {load}}}
"""


@pytest.mark.parametrize(
    ("load", "size"),
    [
        ("{kind: torque, on: crank, opposes: velocity, magnitude: 7 N·m}", 7.0),
        ("{kind: force, on: crank, at: A, opposes: velocity, magnitude: 100 N}", 100 * 0.05),
    ],
)
def test_what_opposes_the_velocity_always_takes_power(load: str, size: float) -> None:
    """The driver overcomes 7 N·m, or 100 N at 50 mm, in the direction in which it turns."""
    motion = lw.solve_motion(lw.loads(CRANK.format(load=load)), steps=360)
    rate = motion.link("crank").angular_velocity
    torque = lw.solve_forces(motion).input_torque
    moving = np.abs(rate) > 1e-6
    assert moving.sum() >= 358 and (rate[moving] > 0).any() and (rate[moving] < 0).any()
    np.testing.assert_allclose(torque[moving], size * np.sign(rate[moving]), rtol=1e-9)


def test_nothing_is_opposed_at_rest() -> None:
    load = "{kind: torque, on: crank, opposes: velocity, magnitude: 7 N·m}"
    text = CRANK.format(load=load).replace("60 deg*sin(2*pi*t/(1 s))", "60 deg + 0 deg*t/(1 s)")
    found = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=4)).input_torque
    np.testing.assert_allclose(found, 0, atol=1e-12)
