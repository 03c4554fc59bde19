"""What metrics and machine dynamics refuse: each with its code and what it is about."""

from math import degrees, inf, nan, pi

import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.analysis import coupler_curve, metrics
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
    steady_running,
    true_speed,
)


def forces_of(name: str) -> lw.Forces:
    return store.forces(name, 72)


@pytest.mark.parametrize(
    ("wrong", "right"), [("transmision_angle", "transmission_angle"), ("quick_return", "quick_return_ratio")]
)
def test_unknown_metric(wrong: str, right: str) -> None:
    motion = store.motion("crank_rocker", 36)
    with refused("names.no_such", noun="metric", name=wrong, offer=right):
        metrics(motion, [wrong])
    with refused("names.no_such", noun="metric", name=wrong, offer=right):
        metrics(motion)[wrong]


def test_metric_that_does_not_apply() -> None:
    motion = store.motion("crank_rocker", 36)
    with refused("metrics.needs_forces", name="peak_reaction"):
        metrics(motion, "peak_reaction")
    with refused("metrics.does_not_apply", name="stroke"):
        metrics(motion, "stroke")
    table = metrics(motion)
    with refused("metrics.not_in_table", name="stroke"):
        table["stroke"]
    with refused("metrics.no_value", offer="rocker", subject="roker"):
        table["swing_angle", "roker"]


def test_path_of_an_open_cycle() -> None:
    motion = lw.solve_motion(store.machine("crank_rocker"), at=[0.0, 0.1, 0.2])
    with refused("metrics.path_open", point="coupler.P"):
        coupler_curve(motion, "coupler.P")


def test_no_load_no_flywheel() -> None:
    with refused("running.no_work", name="Scotch yoke"):
        steady_running(forces_of("scotch_yoke"), fluctuation=0.02)
    with refused("running.no_work", name=store.machine("slider_crank_offset").name):
        steady_running(forces_of("slider_crank_offset"), fluctuation=0.02)


@pytest.mark.parametrize("fluctuation", [0.0, -0.1, nan])
def test_fluctuation_that_cannot_be(fluctuation: float) -> None:
    with refused("running.bad_coefficient", fluctuation=fluctuation):
        steady_running(forces_of("jaw_crusher_fourbar"), fluctuation=fluctuation)
    with refused("running.bad_coefficient", fluctuation=fluctuation):
        flywheel_inertia(100.0, 10.0, fluctuation)


def test_flywheel_needs_a_turning_driver() -> None:
    with refused("running.one_driver", name="Excavator arm"):
        steady_running(forces_of("excavator"), fluctuation=0.02)


def test_part_of_a_turn_is_no_cycle() -> None:
    crusher = store.machine("jaw_crusher_fourbar")
    with refused("running.not_whole_turns", name="Hinged jaw crusher, four-bar"):
        steady_running(lw.solve_forces(lw.solve_motion(crusher, at=[0.0, 0.1, 0.2])), fluctuation=0.02)


def test_torques_that_do_not_balance() -> None:
    driver, load = TorqueCurve.constant(100.0), TorqueCurve.constant(90.0)
    with refused("running.speeds_up", total=20 * pi, mean=100.0, load=90.0):
        energy_fluctuation(driver, load)
    with refused("running.slows_down", total=-20 * pi, mean=90.0, load=100.0):
        true_speed(driver, 1.0, 10.0, driver=load)


def test_a_machine_that_would_stop() -> None:
    load = TorqueCurve.from_function("100 + 90*sin(theta)")
    with refused("running.would_stop"):
        true_speed(load, 0.01, 1.0)


@pytest.mark.parametrize(
    ("areas", "code", "values"),
    [
        ([100, -90], "running.areas_sum", {"total": 10.0}),
        ([], "running.areas_list", {}),
        ([inf, -inf], "running.areas_list", {}),
    ],
)
def test_areas(areas: list[float], code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        fluctuation_from_areas(areas, torque_scale=5.0, angle_scale=0.01)


def test_area_scales() -> None:
    for torque, angle in ((0.0, 0.01), (5.0, 0.0), (-5.0, -0.01)):
        with refused("running.scales"):
            fluctuation_from_areas([1, -1], torque_scale=torque, angle_scale=angle)


def test_torque_curves() -> None:
    with refused("unknown-name", name="phi"):
        TorqueCurve.from_function("100*sin(phi)")
    with refused("running.bad_period", period=0.0):
        TorqueCurve.from_function("100", period=0.0)
    with refused("running.bad_table"):
        TorqueCurve.from_table([0, 1], [5])
    with refused("running.table_order"):
        TorqueCurve.from_table([0, 2, 1], [5, 6, 7])
    with refused("running.table_not_finite"):
        TorqueCurve.from_table([0, 1], [5, nan])
    with refused("running.no_common_period", period=degrees(2.0), period2=degrees(3.0)):
        TorqueCurve.constant(1.0, period=2.0).minus(TorqueCurve.constant(1.0, period=3.0))


def test_sizes_and_motors() -> None:
    for wrong in (0.0, -1.0, nan):
        with refused("running.bad_size", value=wrong):
            disk(wrong)
        with refused("running.bad_inertia", inertia=wrong):
            speed_fluctuation(10.0, 10.0, wrong)
    with refused("running.bad_rim", thickness_ratio=0.6):
        rim(1.0, thickness_ratio=0.6)
    with refused("running.bad_ratio"):
        on_faster_shaft(1.0, 0.0)
    with refused("running.bad_efficiency", efficiency=1.2):
        motor(1.0, 1.0, efficiency=1.2)
    with refused("running.bad_margin", margin=0.9):
        motor(1.0, 1.0, margin=0.9)
    with refused("running.still_shaft"):
        flywheel_inertia(1.0, 0.0, 0.1)


def test_a_motion_without_a_reached_position_says_so() -> None:
    short = store.machine("crank_rocker").with_dimensions({"coupler.length": 0.2})
    table = metrics(lw.solve_motion(short, failures="mark"))
    assert table.names == ("grashof",)
    (english,), (chinese,) = table.warnings_in("en"), table.warnings_in("zh")
    assert english == table.warnings[0] != chinese


def test_cycles_of_so_many_turns_that_their_numbers_would_be_wrong_are_refused() -> None:
    """Over 100 000 turns the mean was 4 % off; over as many as are allowed a swing is that of one turn."""
    text = store.text("crank_rocker")
    assert "\ncycle:" not in text
    for turns in ("1001", "1e7"):
        motion = lw.solve_motion(lw.loads(f"{text}\ncycle: {{turns: {turns}}}\n"), steps=36)
        with refused("metrics.too_many_turns", most=1000):
            metrics(motion)
    many, one = (
        metrics(lw.solve_motion(lw.loads(f"{text}\ncycle: {{turns: {turns}}}\n"), steps=36), "swing_angle")
        for turns in (1000, 1)
    )
    assert many.value("swing_angle") == pytest.approx(one.value("swing_angle"), rel=1e-9)
