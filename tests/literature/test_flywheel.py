"""Flywheels of textbooks: torque given by areas or curves, no mechanism.

Areas and curves: Khurmi and Gupta, Theory of Machines, ch. 16 (examples on turning moment diagrams).
"""

from math import pi

import numpy as np
import pytest

from linkwright.machine import (
    TorqueCurve,
    disk,
    energy_fluctuation,
    fluctuation_from_areas,
    flywheel_inertia,
    motor,
    on_faster_shaft,
    rim,
    speed_fluctuation,
)

RPM = 2 * pi / 60


def test_areas_of_a_turning_moment_diagram() -> None:
    areas = [295, -685, 40, -340, 960, -270]
    found = fluctuation_from_areas(areas, torque_scale=5.0, angle_scale=pi / 180)
    assert found.value == pytest.approx(85.957, abs=5e-4)
    assert (found.low, found.high) == (4, 1)
    assert speed_fluctuation(found.value, 1800 * RPM, 36 * 0.15**2) == pytest.approx(0.2987e-2, abs=5e-7)


def test_engine_against_its_mean_torque() -> None:
    engine = TorqueCurve.from_function("20000 + 9500*sin(2*theta) - 5700*cos(2*theta)")
    speed = 180 * RPM
    assert motor(engine.mean, speed).power == pytest.approx(376.99e3, abs=5)
    found = energy_fluctuation(engine)
    assert found.value == pytest.approx(11078.81, abs=5e-3)
    assert flywheel_inertia(found.value, speed, 0.01) == pytest.approx(3118.1, abs=5e-2)


def test_engine_against_a_load_that_varies() -> None:
    engine = TorqueCurve.from_function("5000 + 600*sin(2*theta)")
    load = TorqueCurve.from_function(lambda theta: 5000 + 500 * np.sin(theta))
    inertia, speed = 500 * 0.4**2, 150 * RPM
    found = energy_fluctuation(engine, load)
    assert found.value == pytest.approx(1204.1667, abs=5e-5)
    assert speed_fluctuation(found.value, speed, inertia) == pytest.approx(6.1004e-2, abs=5e-7)
    (slow, least), (fast, most) = engine.minus(load).extremes()
    assert (least / inertia, most / inertia) == pytest.approx((-12.203, 12.203), abs=5e-4)
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
