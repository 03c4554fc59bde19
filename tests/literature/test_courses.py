"""The two courses of the gallery: schemes of the task books, closed forms, base circles found in other ways."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests import store
from tests.contract.calculations import solved

import linkwright as lw

#: x1, x2, y, H (mm), revolutions per minute, weights N; then AB and BC in mm as reports of this task have them.
PRESSES = {
    "I": ((50, 140, 220, 150, 100), 49.2870, 223.1828),
    "II": ((60, 170, 260, 180, 90), 59.1170, 263.8833),
    "III": ((70, 200, 310, 210, 90), 69.0150, 314.4246),
}
#: O2O4, O2A, O4B (mm), revolutions per minute; quick-return ratio and stroke (mm).
SHAPERS = {
    "I": ((380, 110, 540, 60), 1.4599, 312.632),
    "II": ((350, 90, 580, 64), 1.3968, 298.286),
    "III": ((430, 110, 810, 72), 1.3943, 414.419),
}


def press(scheme: str) -> lw.Mechanism:
    (x1, x2, y, stroke, speed), _, _ = PRESSES[scheme]
    lengths = {"x1": x1, "x2": x2, "y": y, "H": stroke}
    sizes = {name: 1e-3 * value for name, value in lengths.items()}
    return store.machine("press_course").with_dimensions({**sizes, "driver.speed": -speed * math.pi / 30})


def shaper(scheme: str) -> lw.Mechanism:
    (distance, crank, lever, speed), _, _ = SHAPERS[scheme]
    sizes = {"O2O4": 1e-3 * distance, "O2A": 1e-3 * crank, "O4B": 1e-3 * lever}
    return store.machine("shaper_course").with_dimensions({**sizes, "driver.speed": speed * math.pi / 30})


def numbers(mechanism: lw.Mechanism, *names: str) -> dict[str, float]:
    """The governing value of each number."""
    table = lw.metrics(lw.solve_motion(mechanism, steps=720), names)
    return {name: table.value(name) for name in names}


@pytest.mark.parametrize("scheme", PRESSES)
def test_the_press_has_the_lengths_of_its_scheme(scheme: str) -> None:
    """AC is BC - AB where the rocker is 60° from the vertical, BC + AB where it is 120° from it."""
    (x1, _, y, stroke, _), crank, coupler = PRESSES[scheme]
    mechanism = press(scheme)
    points = {name: link.points for name, link in mechanism.links.items()}
    rocker = 2 * stroke / 3
    away = [
        math.dist((x1, y), (rocker * math.sin(limit), rocker * math.cos(limit)))
        for limit in (math.pi / 3, 2 * math.pi / 3)
    ]
    assert [1e3 * points["crank"]["B"][0], 1e3 * points["coupler"]["C"][0]] == pytest.approx(
        [crank, coupler], abs=6e-5
    )
    assert 1e3 * points["crank"]["B"][0] == pytest.approx((away[1] - away[0]) / 2, rel=1e-12)
    assert 1e3 * points["coupler"]["C"][0] == pytest.approx((away[1] + away[0]) / 2, rel=1e-12)
    assert 1e3 * points["rocker"]["E"][0] == pytest.approx(stroke)
    assert 1e3 * points["connector"]["F"][0] == pytest.approx(stroke / 4)
    found = numbers(mechanism, "stroke", "swing_angle")
    assert found["stroke"] == pytest.approx(1e-3 * stroke, rel=1e-9)
    assert found["swing_angle"] == pytest.approx(math.pi / 3, rel=1e-9)


@pytest.mark.parametrize("scheme", SHAPERS)
def test_the_shaper_has_the_stroke_and_the_ratio_of_its_scheme(scheme: str) -> None:
    (distance, crank, lever, _), ratio, stroke = SHAPERS[scheme]
    found = numbers(shaper(scheme), "stroke", "quick_return_ratio")
    swing = 2 * math.asin(crank / distance)
    assert found["quick_return_ratio"] == pytest.approx((math.pi + swing) / (math.pi - swing), rel=1e-9)
    assert found["quick_return_ratio"] == pytest.approx(ratio, abs=6e-5)
    assert 1e3 * found["stroke"] == pytest.approx(2 * lever * crank / distance, rel=1e-9)
    assert 1e3 * found["stroke"] == pytest.approx(stroke, abs=6e-4)


def test_the_guide_of_the_ram_leaves_equal_pressure_angles_above_and_below() -> None:
    """Midway in the arc: B is as far above the guide at mid-swing as below it at the limits."""
    height = 0.54 * (1 + math.cos(math.asin(11 / 38))) / 2
    assert store.machine("shaper_course").joints["guide"].offset == pytest.approx(height, rel=1e-12)
    connector = store.motion("shaper_course", 720).link("connector").angle - math.pi
    assert abs(connector).max() == pytest.approx(math.asin((0.54 - height) / 0.135), rel=1e-6)
    assert connector.max() == pytest.approx(-connector.min(), rel=1e-4)


@pytest.mark.parametrize(
    ("name", "work", "speed"),
    [("shaper_course", 7000 * 0.9 * 0.31263158, 60), ("press_course", 4000 * 0.25 * 0.15, 100)],
)
def test_the_mean_power_is_the_work_of_the_resistance(name: str, work: float, speed: float) -> None:
    found = lw.metrics(store.forces(name, 720), ["mean_power"])[0].value
    assert found == pytest.approx(work * speed / 60, rel=1e-6)


def test_the_base_circle_of_the_press_is_that_of_the_closed_form() -> None:
    """Without offset tan α = s'/(r0 + s), so r0 = max(s'/tan α - s); cosine law, h = 17 mm over 55° and 85°."""
    needed = []
    for over in (55, 85):
        beta = math.radians(over)
        u = np.linspace(0.0, 1.0, 200001)
        s, rate = 8.5 * (1 - np.cos(np.pi * u)), 8.5 * np.pi / beta * np.sin(np.pi * u)
        needed.append(float((rate / math.tan(math.radians(30)) - s).max()))
    design = solved("cam_press")
    assert 1e3 * design.cam.base_radius + 8.0 == pytest.approx(max(needed), rel=1e-8)
    assert abs(design.pressure_angle_rise.value) == pytest.approx(math.radians(30), abs=1e-7)


def shaper_angle(prime: float) -> float:
    """Largest pressure angle (rad) of the shaper's cam, by the instant centre of cam and follower.

    With the cam's centre at 0, the pivot at c = 150 mm and q = dψ/dφ the instant centre is at x = q c/(1 + q) of the
    line through both; the common normal runs through it and the roller's centre, and the roller moves square to the
    arm.
    """
    arm, between, lift, beta = 125.0, 150.0, math.radians(15), math.radians(75)
    u = np.linspace(0.0, 1.0, 200001)
    psi = np.where(u < 0.5, 2 * u**2, 1 - 2 * (1 - u) ** 2) * lift
    start = math.acos((between**2 + arm**2 - prime**2) / (2 * between * arm))
    along = -np.exp(-1j * (start + psi))
    steepest = []
    for way in (1, -1):
        rate = way * np.where(u < 0.5, 4 * u, 4 * (1 - u)) * lift / beta
        normal = between + arm * along - rate * between / (1 + rate)
        steepest.append(float(np.arccos(np.abs((normal * along.conj()).imag) / np.abs(normal)).max()))
    return max(steepest)


def test_the_base_circle_of_the_shaper_is_that_of_the_instant_centre() -> None:
    low, high = 40.0, 80.0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if shaper_angle(middle) > math.radians(40) else (low, middle)
    design = solved("cam_shaper")
    assert 1e3 * design.cam.base_radius + 15.0 == pytest.approx(high, rel=1e-8)
