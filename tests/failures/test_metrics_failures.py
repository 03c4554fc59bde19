"""What design numbers and machine dynamics refuse, and with which words."""

from math import inf, nan

import pytest

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.files.source import read_source
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
from linkwright.metrics import coupler_curve, metrics


def forces_of(name: str) -> lw.Forces:
    return lw.solve_forces(lw.load(f"gallery:{name}"), steps=72)


@pytest.mark.parametrize(
    ("wrong", "right"), [("transmision_angle", "transmission_angle"), ("quick_return", "quick_return_ratio")]
)
def test_unknown_metric(wrong: str, right: str) -> None:
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"), steps=36)
    with pytest.raises(LinkwrightError, match=f'no metric "{wrong}"; did you mean "{right}"'):
        metrics(motion, [wrong])
    with pytest.raises(LinkwrightError, match=right):
        metrics(motion)[wrong]


def test_metric_that_does_not_apply() -> None:
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"), steps=36)
    with pytest.raises(LinkwrightError, match=r"needs the joint forces .* solve_forces"):
        metrics(motion, "peak_reaction")
    with pytest.raises(LinkwrightError, match='"stroke" does not apply'):
        metrics(motion, "stroke")
    table = metrics(motion)
    with pytest.raises(LinkwrightError, match="not in the table"):
        table["stroke"]
    with pytest.raises(LinkwrightError, match='no value for "roker"; did you mean "rocker"'):
        table["swing_angle", "roker"]


def test_path_of_an_open_cycle() -> None:
    motion = lw.solve_motion(lw.load("gallery:crank_rocker"), at=[0.0, 0.1, 0.2])
    with pytest.raises(LinkwrightError, match="not closed"):
        coupler_curve(motion, "coupler.P")


def test_no_load_no_flywheel() -> None:
    with pytest.raises(LinkwrightError, match=r"mean torque .* is zero: no work is done"):
        steady_running(forces_of("scotch_yoke"), fluctuation=0.02)
    with pytest.raises(LinkwrightError, match=r"mean torque .* is zero"):
        steady_running(forces_of("slider_crank_offset"), fluctuation=0.02)


@pytest.mark.parametrize("fluctuation", [0.0, -0.1, nan])
def test_fluctuation_that_cannot_be(fluctuation: float) -> None:
    with pytest.raises(LinkwrightError, match=r"coefficient of speed fluctuation .* above zero"):
        steady_running(forces_of("jaw_crusher_fourbar"), fluctuation=fluctuation)
    with pytest.raises(LinkwrightError, match="above zero"):
        flywheel_inertia(100.0, 10.0, fluctuation)


def test_flywheel_needs_a_turning_driver() -> None:
    with pytest.raises(LinkwrightError, match="one turning driver"):
        steady_running(forces_of("excavator"), fluctuation=0.02)


def test_part_of_a_turn_is_no_cycle() -> None:
    crusher = lw.load("gallery:jaw_crusher_fourbar")
    with pytest.raises(LinkwrightError, match="not whole turns"):
        steady_running(lw.solve_forces(lw.solve_motion(crusher, at=[0.0, 0.1, 0.2])), fluctuation=0.02)


def test_torques_that_do_not_balance() -> None:
    driver, load = TorqueCurve.constant(100.0), TorqueCurve.constant(90.0)
    with pytest.raises(LinkwrightError, match=r"do not balance.*rise"):
        energy_fluctuation(driver, load)
    with pytest.raises(LinkwrightError, match=r"do not balance.*fall"):
        true_speed(driver, 1.0, 10.0, driver=load)


def test_a_machine_that_would_stop() -> None:
    load = TorqueCurve.from_function("100 + 90*sin(theta)")
    with pytest.raises(LinkwrightError, match="would stop"):
        true_speed(load, 0.01, 1.0)


@pytest.mark.parametrize(
    ("areas", "words"),
    [([100, -90], "add up to 10 mm²"), ([], "list of numbers"), ([inf, -inf], "list of numbers")],
)
def test_areas(areas: list[float], words: str) -> None:
    with pytest.raises(LinkwrightError, match=words):
        fluctuation_from_areas(areas, torque_scale=5.0, angle_scale=0.01)


def test_area_scales() -> None:
    for torque, angle in ((0.0, 0.01), (5.0, 0.0), (-5.0, -0.01)):
        with pytest.raises(LinkwrightError, match="scales"):
            fluctuation_from_areas([1, -1], torque_scale=torque, angle_scale=angle)


def test_torque_curves() -> None:
    with pytest.raises(LinkwrightError, match="phi"):
        TorqueCurve.from_function("100*sin(phi)")
    with pytest.raises(LinkwrightError, match="period"):
        TorqueCurve.from_function("100", period=0.0)
    with pytest.raises(LinkwrightError, match="as many torques"):
        TorqueCurve.from_table([0, 1], [5])
    with pytest.raises(LinkwrightError, match="must increase"):
        TorqueCurve.from_table([0, 2, 1], [5, 6, 7])
    with pytest.raises(LinkwrightError, match="not finite"):
        TorqueCurve.from_table([0, 1], [5, nan])
    with pytest.raises(LinkwrightError, match="no common cycle"):
        TorqueCurve.constant(1.0, period=2.0).minus(TorqueCurve.constant(1.0, period=3.0))


def test_sizes_and_motors() -> None:
    for wrong in (0.0, -1.0, nan):
        with pytest.raises(LinkwrightError, match="above zero"):
            disk(wrong)
        with pytest.raises(LinkwrightError, match="above zero"):
            speed_fluctuation(10.0, 10.0, wrong)
    with pytest.raises(LinkwrightError, match=r"0\.5 \(a disk\) or less"):
        rim(1.0, thickness_ratio=0.6)
    with pytest.raises(LinkwrightError, match="ratio"):
        on_faster_shaft(1.0, 0.0)
    with pytest.raises(LinkwrightError, match="efficiency"):
        motor(1.0, 1.0, efficiency=1.2)
    with pytest.raises(LinkwrightError, match="margin"):
        motor(1.0, 1.0, margin=0.9)
    with pytest.raises(LinkwrightError, match="mean speed"):
        flywheel_inertia(1.0, 0.0, 0.1)


def test_a_motion_without_a_reached_position_says_so() -> None:
    short = lw.load("gallery:crank_rocker").with_dimensions({"coupler.length": 0.2})
    table = metrics(lw.solve_motion(short, failures="mark"))
    assert table.names == ("grashof",)
    assert "none of the positions" in table.warnings[0] and "none of the positions" in table.text()
    assert "不能装配" in table.warnings_in("zh")[0]


def test_cycles_of_so_many_turns_that_their_numbers_would_be_wrong_are_refused() -> None:
    """Over 100 000 turns the mean was 4 % off; over as many as are allowed a swing is that of one turn."""
    text = read_source("gallery:crank_rocker")[0]
    assert "\ncycle:" not in text
    for turns in ("1001", "1e7"):
        motion = lw.solve_motion(lw.loads(f"{text}\ncycle: {{turns: {turns}}}\n"), steps=36)
        with pytest.raises(LinkwrightError, match="1000") as refused:
            metrics(motion)
        assert "循环" in refused.value.say("zh")
    many, one = (
        metrics(lw.solve_motion(lw.loads(f"{text}\ncycle: {{turns: {turns}}}\n"), steps=36), "swing_angle")
        for turns in (1000, 1)
    )
    assert many.value("swing_angle") == pytest.approx(one.value("swing_angle"), rel=1e-9)
