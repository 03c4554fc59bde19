"""Flywheels of textbooks: torque given by areas or curves, no mechanism.

Areas and curves: Khurmi and Gupta, Theory of Machines, ch. 16 (examples on turning moment diagrams); fluctuations,
powers and flywheels of the examples are compared in test_published.
"""

from math import pi

import numpy as np
import pytest

import linkwright as lw
from linkwright.machine import (
    TorqueCurve,
    disk,
    energy_fluctuation,
    equivalent_torque,
    fluctuation_from_areas,
    motor,
    on_faster_shaft,
    rim,
    steady_running,
    true_speed,
)

RPM = 2 * pi / 60


def test_areas_of_a_turning_moment_diagram() -> None:
    areas = [295, -685, 40, -340, 960, -270]
    found = fluctuation_from_areas(areas, torque_scale=5.0, angle_scale=pi / 180)
    assert (found.low, found.high) == (4, 1)


def test_engine_against_a_load_that_varies() -> None:
    engine = TorqueCurve.from_function("5000 + 600*sin(2*theta)")
    load = TorqueCurve.from_function(lambda theta: 5000 + 500 * np.sin(theta))
    (slow, least), (fast, most) = engine.minus(load).extremes()
    assert least == pytest.approx(-most, rel=1e-9)
    assert np.degrees([slow, fast]) == pytest.approx([127.63, 232.37], abs=5e-3)


def test_punching_from_a_table_with_jumps() -> None:
    """A constant motor against a punch that takes 10 kJ evenly over a quarter turn: ΔE = 3/4 of the work."""
    quarter = pi / 2
    load = TorqueCurve.from_table([0, quarter, quarter, 4 * quarter], [1e4 / quarter, 1e4 / quarter, 0, 0])
    driver = TorqueCurve.constant(1e4 / (2 * pi))
    assert energy_fluctuation(driver, load).value == pytest.approx(7500.0, rel=1e-12)


def test_same_curve_as_array_and_as_function() -> None:
    theta = np.arange(7200) * 2 * pi / 7200
    table = TorqueCurve.from_function(5000 + 600 * np.sin(2 * theta))
    assert energy_fluctuation(table).value == pytest.approx(600.0, rel=1e-6)


def test_disk_and_rim_have_the_inertia_asked_for() -> None:
    plate = disk(10.0, density=7800, width_ratio=0.2)
    assert 0.5 * plate.mass * (plate.diameter / 2) ** 2 == pytest.approx(10.0)
    assert plate.mass == pytest.approx(7800 * pi / 4 * plate.diameter**2 * plate.width)
    ring = rim(10.0, density=7200, width_ratio=0.15, thickness_ratio=0.1)
    inner = ring.diameter - 2 * ring.thickness
    assert ring.mass * (ring.diameter**2 + inner**2) / 8 == pytest.approx(10.0)
    assert ring.mass < disk(10.0).mass
    assert on_faster_shaft(10.0, 4.0) == 10.0 / 16


def test_motor_with_efficiency_and_margin() -> None:
    assert motor(100.0, 20.0, efficiency=0.8, margin=1.25).power == pytest.approx(100 * 20 * 1.25 / 0.8)


def test_flywheels_of_a_machine_by_the_formula() -> None:
    """J = ΔE/(δ ω²) less the machine's own mean inertia; over i² on a shaft i times as fast."""
    forces = lw.solve_forces(lw.load("gallery:jaw_crusher_fourbar"), steps=90)
    speed, ratio = 170 * RPM, 3.0
    found = steady_running(forces, fluctuation=0.05, ratio=ratio)
    own = found.equivalent.mean_inertia
    assert found.equivalent.speed == pytest.approx(speed)
    assert found.own == pytest.approx(found.energy.value / (own * speed**2), rel=1e-12)
    assert found.flywheel == pytest.approx(found.energy.value / (0.05 * speed**2) - own, rel=1e-12)
    assert found.shaft_flywheel == pytest.approx(found.exact_flywheel / ratio**2, rel=1e-12)


def test_at_rest_the_equivalent_torque_is_the_drivers() -> None:
    motion = lw.solve_motion(lw.load("gallery:jaw_crusher_fourbar"), steps=24)
    resting = lw.solve_forces(motion, static=True)
    assert equivalent_torque(resting) == pytest.approx(resting.input_torque, abs=0.0)


@pytest.mark.parametrize(
    ("inertia", "speed", "words"),
    [
        (-1.0, 10.0, "moment of inertia is -1"),
        (0.0, 10.0, "moment of inertia is 0"),
        (1.0, -10.0, "mean speed is -10"),
        (np.cos, 10.0, "zero somewhere"),
    ],
)
def test_machines_that_cannot_run_evenly(inertia: object, speed: float, words: str) -> None:
    with pytest.raises(lw.LinkwrightError, match=words):
        true_speed(TorqueCurve.constant(1.0), inertia, speed)


def test_tables_of_torque_repeat_and_jump() -> None:
    """From 30° on, a jump at 90°, a period of half a turn; the difference of two over their common period."""
    edge = np.radians([30.0, 90.0, 90.0, 150.0])
    curve = TorqueCurve.from_table(edge, [1.0, 3.0, 8.0, 2.0], period=pi)
    at = np.radians([30.0, 60.0, 89.9999, 90.0001, 120.0, 180.0, 210.0, -150.0, 240.0])
    assert curve(at) == pytest.approx([1, 2, 3, 8, 5, 1.5, 1, 1, 2], abs=1e-4)
    assert curve.mean == pytest.approx((2 * 60 + 5 * 60 + 1.5 * 60) / 180)
    assert (curve.start, curve.period) == (pytest.approx(pi / 6), pi)
    other = TorqueCurve.from_function("2*sin(theta)")
    for one, two, sign in ((curve, other, 1.0), (other, curve, -1.0)):
        difference = one.minus(two)
        assert difference.period == pytest.approx(2 * pi)
        assert difference(at[:5]) == pytest.approx(sign * (curve(at[:5]) - 2 * np.sin(at[:5])), abs=1e-9)
        assert difference.mean == pytest.approx(sign * curve.mean, rel=1e-9)
    (low, least), (high, most) = curve.extremes()
    assert (least, most) == pytest.approx((1.0, 8.0), abs=1e-9)
    assert (low % pi, high % pi) == (pytest.approx(pi / 6, abs=1e-6), pytest.approx(pi / 2, abs=1e-6))
    assert TorqueCurve.from_function([1.0, 3.0], period=4.0)(np.array([0.0, 1.0, 2.0, 3.0])) == pytest.approx(
        [1, 2, 3, 2]
    )
