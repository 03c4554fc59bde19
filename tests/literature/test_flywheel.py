"""Flywheels of textbooks: torque given by areas or curves, no mechanism.

Areas and curves: Khurmi and Gupta, Theory of Machines, ch. 16 (examples on turning moment diagrams); fluctuations,
powers and flywheels of the examples are compared in test_published.
"""

from math import pi

import numpy as np
import pytest
from scipy.special import ellipk
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.machine import (
    TorqueCurve,
    disk,
    energy_fluctuation,
    equivalent_torque,
    fluctuation_from_areas,
    flywheel_inertia,
    motor,
    on_faster_shaft,
    rim,
    speed_fluctuation,
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
    forces = lw.solve_forces(store.machine("jaw_crusher_fourbar"), steps=90)
    speed, ratio = 170 * RPM, 3.0
    found = steady_running(forces, fluctuation=0.05, ratio=ratio)
    own = found.equivalent.mean_inertia
    assert found.equivalent.speed == pytest.approx(speed)
    assert found.own == pytest.approx(found.energy.value / (own * speed**2), rel=1e-12)
    assert found.flywheel == pytest.approx(found.energy.value / (0.05 * speed**2) - own, rel=1e-12)
    assert found.shaft_flywheel == pytest.approx(found.exact_flywheel / ratio**2, rel=1e-12)
    on_the_crank = steady_running(forces, fluctuation=0.05)
    assert on_the_crank.ratio == 1.0
    assert on_the_crank.shaft_flywheel == on_the_crank.exact_flywheel == found.exact_flywheel


def test_at_rest_the_equivalent_torque_is_the_drivers() -> None:
    motion = lw.solve_motion(store.machine("jaw_crusher_fourbar"), steps=24)
    resting = lw.solve_forces(motion, static=True)
    assert equivalent_torque(resting) == pytest.approx(resting.input_torque, abs=0.0)


@pytest.mark.parametrize(
    ("inertia", "speed", "code", "values"),
    [
        (-1.0, 10.0, "running.bad_inertia", {"inertia": -1.0}),
        (0.0, 10.0, "running.bad_inertia", {"inertia": 0.0}),
        (1.0, -10.0, "running.bad_speed", {"speed": -10.0}),
        (np.cos, 10.0, "running.no_inertia", {}),
    ],
)
def test_machines_that_cannot_run_evenly(inertia: object, speed: float, code: str, values: dict[str, float]) -> None:
    with refused(code, **values):
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


def test_wheels_are_of_cast_iron_a_tenth_as_wide_as_high_where_nothing_is_said() -> None:
    """J = ρ π b (D⁴ - d⁴)/32 with ρ = 7200 kg/m³, b = D/10, a rim D/10 thick, a disk without a hole."""
    plate, ring = disk(10.0), rim(10.0)
    for wheel, hole, thickness in ((plate, 0.0, 0.5), (ring, 0.8, 0.1)):
        size = (320 / (7200 * pi * 0.1 * (1 - hole**4))) ** 0.2
        assert (wheel.diameter, wheel.width) == (pytest.approx(size), pytest.approx(size / 10))
        assert wheel.thickness == pytest.approx(thickness * size)
        assert wheel.mass == pytest.approx(7200 * pi / 4 * size**3 / 10 * (1 - hole**2))
        assert wheel.inertia == 10.0
        assert wheel.rim_speed(-30.0) == pytest.approx(15 * size)
    assert (plate.shape, ring.shape) == ("disk", "rim")


def test_energy_of_areas_with_its_diagram() -> None:
    """Running sums of the areas in J; the same by Shigley's table from the first area on."""
    areas = [295.0, -685.0, 40.0, -340.0, 960.0, -270.0]
    found = fluctuation_from_areas(areas, torque_scale=5.0, angle_scale=pi / 180)
    sums = np.array([0.0, 295.0, -390.0, -350.0, -690.0, 270.0, 0.0]) * 5 * pi / 180
    assert found.energy == pytest.approx(sums) and found.angle.tolist() == [0, 1, 2, 3, 4, 5, 6]
    assert (found.value, found.balance) == (pytest.approx(985 * 5 * pi / 180), pytest.approx(0.0, abs=1e-12))


def test_curves_of_energy_and_speed_over_a_period() -> None:
    """T = 100 + 50 sin 2θ against its mean: E = 25 (1 - cos 2θ), ω from ½ J ω² = E0 + E over one turn."""
    driver = TorqueCurve.from_function("100 + 50*sin(2*theta)")
    energy = energy_fluctuation(driver)
    assert energy.angle[[0, -1]] == pytest.approx([0.0, 2 * pi], abs=1e-12)
    assert energy.energy == pytest.approx(25 * (1 - np.cos(2 * energy.angle)), abs=1e-9)
    assert len(energy.angle) >= 361 and (np.diff(energy.angle) > 0).all()
    speed = true_speed(TorqueCurve.constant(100.0), 2.0, 10.0, driver=driver)
    assert speed.angle == pytest.approx(np.linspace(0, 2 * pi, 361)) and len(speed.speed) == 361
    rise = speed.speed**2 - speed.speed[0] ** 2
    assert rise == pytest.approx(25 * (1 - np.cos(2 * speed.angle)), abs=1e-9)
    assert np.trapezoid(1 / speed.at(np.linspace(0, 2 * pi, 20_001)), dx=2 * pi / 20_000) == pytest.approx(
        2 * pi / 10
    )
    assert speed.fluctuation == pytest.approx((speed.fastest[1] - speed.slowest[1]) / 10.0, rel=1e-12)
    assert (speed.motor_torque, speed.periodicity) == (pytest.approx(100.0), pytest.approx(0.0, abs=1e-12))
    assert len(true_speed(driver, 2.0, 10.0, steps=8).angle) == 9


def test_a_difference_kinks_where_either_curve_does_over_the_common_period() -> None:
    edge = np.radians([30.0, 90.0, 90.0, 150.0])
    half = TorqueCurve.from_table(edge, [1.0, 3.0, 8.0, 2.0], period=pi)
    whole = TorqueCurve.from_table(np.radians([10.0, 200.0]), [5.0, 7.0])
    first, other = half.minus(whole), whole.minus(half)
    knots = [np.unique(np.round(np.degrees(curve.knots), 6)).tolist() for curve in (first, other)]
    assert knots[0] == [30, 90, 150, 200, 210, 270, 330, 370, 390]
    assert knots[1] == [10, 30, 90, 150, 200, 210, 270, 330, 370]
    assert np.degrees((first.start, other.start, first.period)) == pytest.approx((30, 10, 360))
    at = np.radians([0.0, 45.0, 100.0, 205.0, 359.0])
    assert first(at) == pytest.approx(half(at) - whole(at)) and other(at) == pytest.approx(-first(at))
    assert first.work.total == pytest.approx(half.mean * 2 * pi - 6.0 * 2 * pi, rel=1e-13)
    with refused("running.no_common_period") as caught:
        TorqueCurve.constant(1.0, period=2.0).minus(TorqueCurve.constant(1.0, period=3.0))
    assert "114.592°" in str(caught.value) and "171.887°" in str(caught.value)


@pytest.mark.parametrize(
    ("angle", "torque", "period"),
    [([0.0, 3.2], [1.0, 2.0], pi), ([0.5, 3.7], [1.0, 2.0], pi), ([1.0, 0.5], [1.0, 2.0], 2 * pi)],
)
def test_tables_longer_than_their_period_or_out_of_order_are_refused(
    angle: list[float], torque: list[float], period: float
) -> None:
    with refused("running.table_order"):
        TorqueCurve.from_table(angle, torque, period=period)


def test_tables_of_a_whole_period_close_with_a_jump() -> None:
    """The last row stands at the period's end: from 3 it jumps back to 1, and none is added."""
    saw = TorqueCurve.from_table([0.0, 2.0], [1.0, 3.0], period=2.0)
    assert saw.knots == (0.0, 2.0) and saw.mean == pytest.approx(2.0, rel=1e-14)
    assert saw(np.array([-0.5, 1.9999999, 2.0])) == pytest.approx([2.5, 3.0, 1.0], abs=1e-6)
    for one in ([], [3.0]):
        with refused("running.bad_table"):
            TorqueCurve.from_function(one)


def test_what_is_left_of_unequal_work_is_said_with_both_means() -> None:
    weak, strong = TorqueCurve.constant(90.0, period=pi), TorqueCurve.constant(100.0, period=pi)
    left = 10 * pi
    with refused("running.speeds_up", total=left, mean=100.0, load=90.0):
        energy_fluctuation(strong, weak)
    with refused("running.slows_down", total=-left, mean=90.0, load=100.0):
        energy_fluctuation(weak, strong)


ENGINE = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  shaft: {points: {O: [0 m, 0 m], P: [1 m, 0 m]}, inertia: 0.2 kg·m²}
driver: {turn: shaft, about: O, speed: 10 rad/s}
loads:
  gas: {kind: torque, on: shaft, magnitude: "100 N*m + 90 N*m*sin(input)"}
"""


@pytest.mark.parametrize("speed", [10.0, -10.0])
def test_an_engine_is_held_even_by_its_flywheel(speed: float) -> None:
    """ΔE = 2·90 J; the speed as of the torque curve, which the next test compares with a pendulum."""
    text = ENGINE.replace("10 rad/s", f"{speed} rad/s").replace("100 N*m", f"{100 * np.sign(speed)} N*m")
    forces = lw.solve_forces(lw.loads(text), steps=360)
    running = steady_running(forces, fluctuation=0.5)
    assert (running.mean_torque, running.energy.value) == pytest.approx((-100, 180), rel=1e-9)
    assert running.flywheel == pytest.approx(180 / (0.5 * 100) - 0.2, rel=1e-9)
    curve = TorqueCurve.from_function(f"100 + {90 * np.sign(speed)}*sin({np.sign(speed)}*theta)")
    assert running.speed.fluctuation == pytest.approx(true_speed(curve, 3.6, 10.0).fluctuation, rel=1e-6)
    exact = true_speed(curve, 0.2 + running.exact_flywheel, 10.0)
    assert exact.fluctuation == pytest.approx(0.5, rel=1e-6)
    table = lw.metrics(forces)
    assert table.value("energy_fluctuation") == pytest.approx(180, rel=1e-9)
    assert table.value("flywheel") == pytest.approx(180 / (0.02 * 100) - 0.2, rel=1e-9)
    swept = lw.sweep(forces.mechanism, {"shaft.inertia": [0.2, 0.4]}, outputs=["flywheel", "exact_flywheel"])
    assert swept["flywheel"] == pytest.approx([89.8, 89.6], rel=1e-9)
    assert swept["exact_flywheel"][0] - swept["exact_flywheel"][1] == pytest.approx(0.2, rel=1e-6)
    assert "motor_power" not in running.data()


@pytest.mark.parametrize("inertia", [0.0825, 0.2, 5.0])
def test_a_machine_that_hardly_gets_over_its_load_like_a_pendulum(inertia: float) -> None:
    """ω² = 2 (E + 90 cos θ - 90)/J: one turn takes 4 √(J/2E) K(180/E), the complete elliptic integral."""
    found = true_speed(TorqueCurve.from_function("100 + 90*sin(theta)"), inertia, 10.0)
    energy = 0.5 * inertia * found.fastest[1] ** 2
    assert 4 * np.sqrt(inertia / (2 * energy)) * ellipk(180 / energy) == pytest.approx(2 * pi / 10, rel=1e-6)
    assert found.slowest == pytest.approx((pi, np.sqrt(2 * (energy - 180) / inertia)), rel=1e-4)
    assert found.motor_torque == pytest.approx(100.0)


def test_a_table_with_short_steps_is_a_straight_line_in_each() -> None:
    curve = TorqueCurve.from_table([0.0, 0.25, 0.75], [1.0, 3.0, 2.0], period=1.0)
    assert curve(np.array([0.125, 0.5, 0.875])) == pytest.approx([2.0, 2.5, 1.5])
    assert curve.mean == pytest.approx(0.25 * 2.0 + 0.5 * 2.5 + 0.25 * 1.5, rel=1e-13)


def test_steady_running_of_few_positions_is_that_of_the_cycle() -> None:
    crusher = store.machine("jaw_crusher_fourbar")
    many, few = (steady_running(lw.solve_forces(crusher, steps=n), fluctuation=0.02) for n in (360, 2))
    assert few.flywheel == pytest.approx(many.flywheel, rel=1e-9)


def test_cycles_that_are_not_passed_have_no_steady_running() -> None:
    short = store.machine("crank_rocker").with_dimensions({"coupler.length": 1.5, "rocker.mass": 1.0})
    marked = lw.solve_forces(lw.solve_motion(short, steps=36, failures="mark"))
    with refused("running.not_all_reached", name=short.name):
        steady_running(marked, fluctuation=0.02)


def test_a_shaft_may_turn_either_way() -> None:
    for speed in (12.0, -12.0):
        assert speed_fluctuation(30.0, speed, 5.0) == pytest.approx(30.0 / (5.0 * 144.0), rel=1e-14)
        assert flywheel_inertia(30.0, speed, 0.04) == pytest.approx(30.0 / (0.04 * 144.0), rel=1e-14)
