"""When loads act: intervals of the input, strokes between limit positions, ramps; against phases found by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.refusals import refused
from tests.unit.applied_loads.turning_crank import JAW, PERIOD, Turning

from linkwright.applied_loads.force import Force
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.over_cycle import Activity, evaluate
from linkwright.applied_loads.over_cycle import activity as activity_of
from linkwright.applied_loads.phases import InputPhase, MovingPhase, SwingPhase
from linkwright.applied_loads.signals import FullCycle, Limit
from linkwright.applied_loads.sizes import Constant, Ramp, Size, Table
from linkwright.core.outputs import Output


def activity(phase: Any, signals: Any, *, ramp: bool = False) -> Activity:
    """When a force with this phase acts."""
    size: Size = Ramp(0.0, 1.0) if ramp else Constant(1.0)
    load = Force(name="load", on="jaw", at="P", direction=0.0, magnitude=Magnitude(size, phase))
    return activity_of(load, signals)


def interpolated(table: Table, signals: Turning, ok: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Values of a force with this table at the positions that are solved."""
    signals.ok = ok
    load = Force(name="load", on="jaw", at="P", direction=0.0, magnitude=Magnitude(table))
    return evaluate(load, signals)


def on(signals: Turning, phase: Any) -> list[bool]:
    return list(activity(phase, signals).where)


def degrees(start: float, end: float) -> InputPhase:
    return InputPhase(float(np.radians(start)), float(np.radians(end)))


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("lap", [-720.0, -360.0, 0.0, 360.0])
def test_an_interval_counts_modulo_one_turn(speed: float, lap: float) -> None:
    at = np.array([0.0, 231.6, 231.7, 300.0, 348.7, 348.8]) + lap
    assert on(Turning(at, speed=speed), degrees(231.65, 348.74)) == [False, False, True, True, True, False]


def test_an_interval_holds_its_ends() -> None:
    assert on(Turning([90, 180, 450, 540]), degrees(90, 180)) == [True] * 4


def test_an_interval_across_the_end_of_a_turn() -> None:
    assert on(Turning([349, 351, 0, 9, 11, 369]), degrees(350, 10)) == [False, True, True, True, False, True]


def test_an_interval_downwards_follows_a_clockwise_input() -> None:
    signals = Turning([-89, -91, -180, -271, -273, -451], speed=-1.0)
    found = activity(degrees(-90, -272), signals)
    assert list(found.where) == [False, True, True, True, False, True]
    np.testing.assert_allclose(found.share[[1, 2, 3, 5]], np.array([1, 90, 181, 1]) / 182)


def test_a_whole_turn_is_always() -> None:
    assert on(Turning(range(0, 720, 30)), degrees(0, 360)) == [True] * 24


def test_a_share_grows_from_the_start_to_the_end_of_an_interval() -> None:
    found = activity(degrees(90, 270), Turning([90, 135, 180, 270, 495]))
    np.testing.assert_allclose(found.share, [0, 0.25, 0.5, 1, 0.25])


def test_an_interval_of_a_slide_is_plain() -> None:
    signals = Turning(np.degrees([0.0, 0.1, 0.2, 0.3, 6.5]), rotary=False)
    assert on(signals, InputPhase(0.1, 0.3)) == [False, True, True, True, False]
    found = activity(InputPhase(0.3, 0.1), signals)
    np.testing.assert_allclose(found.share, [1, 1, 0.5, 0, 0])


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("lag", [0.0, 20.0, 180.0, 250.0, -37.0])
@pytest.mark.parametrize("lap", [-2, 0, 3])
def test_a_swing_ramps_from_limit_to_limit(speed: float, lag: float, lap: int) -> None:
    """From its largest value at `lag` the output falls over half a turn, whichever way the input turns."""
    gone = np.array([-1.0, 1.0, 45.0, 90.0, 179.0, 181.0, 270.0, 359.0])
    signals = Turning(lag + np.sign(speed) * gone + 360 * lap, speed=speed, lag=lag)
    found = activity(SwingPhase(JAW, "max", "min"), signals, ramp=True)
    assert list(found.where) == [False, True, True, True, True, False, False, False]
    np.testing.assert_allclose(found.share[1:5], gone[1:5] / 180, rtol=1e-12)
    back = activity(SwingPhase(JAW, "min", "max"), signals, ramp=True)
    assert list(back.where) == [not each for each in found.where]


def test_a_swing_holds_its_limit_positions() -> None:
    found = activity(SwingPhase(JAW, "max", "min"), Turning([20, 200, 380, 560], lag=20), ramp=True)
    assert list(found.where) == [True] * 4
    np.testing.assert_allclose(found.share, [0, 1, 0, 1], atol=1e-12)


def test_moving_is_where_the_rate_has_the_sign() -> None:
    signals = Turning([0, 10, 170, 180, 190, 350], speed=1.0)
    signals.output = lambda _: (signals.input, np.array([0.0, -1, -1, 0, 1, 1]))  # type: ignore[method-assign]
    assert on(signals, MovingPhase(JAW, "decreasing")) == [False, True, True, False, False, False]
    assert on(signals, MovingPhase(JAW, "increasing")) == [False, False, False, False, True, True]


def test_moving_ramps_between_reversals() -> None:
    found = activity(MovingPhase(JAW, "increasing"), Turning([225, 270, 315], lag=0), ramp=True)
    np.testing.assert_allclose(found.share, [0.25, 0.5, 0.75])


def test_the_swing_is_between_the_outermost_limits() -> None:
    signals = Turning([10, 100, 190, 280])
    inputs = {5: ("max", 1.0), 95: ("min", 0.2), 185: ("max", 0.4), 275: ("min", -1.0)}
    limits = [Limit(float(np.radians(q)), q / 360 * PERIOD, value, kind) for q, (kind, value) in inputs.items()]
    signals.limits = lambda _: limits  # type: ignore[method-assign]
    assert on(signals, SwingPhase(JAW, "max", "min")) == [True, True, True, False]


@pytest.mark.parametrize(
    ("phase", "limits", "code"),
    [
        (SwingPhase(JAW, "max", "min"), [], "loads.never_reverses"),
        (
            SwingPhase(JAW, "max", "min"),
            [Limit(1.0, 0.3, -1.0, "min"), Limit(2.0, 0.6, 1.0, "max")],
            "loads.no_such_swing",
        ),
        (
            SwingPhase(JAW, "max", "min"),
            [Limit(1.0, 0.3, 1.0, "max"), Limit(1.0, 0.6, -1.0, "min")],
            "loads.ramp_without_length",
        ),
    ],
)
def test_a_swing_that_does_not_exist(phase: SwingPhase, limits: list[Limit], code: str) -> None:
    signals = Turning([0, 10])
    signals.full_cycle = FullCycle(None)
    signals.limits = lambda _: limits  # type: ignore[method-assign]
    with refused(code, output="jaw"):
        activity(phase, signals, ramp=True)


def test_an_input_to_and_fro_needs_an_upward_interval() -> None:
    signals = Turning([0, 10])
    signals.heading = 0
    for start, end in ((30, -30), (5, 4)):
        with refused("loads.phase_to_and_fro", start=f"{start}°", end=f"{end}°"):
            activity(degrees(start, end), signals)
    assert activity(degrees(5, 30), signals).where.tolist() == [False, True]


def test_an_interval_longer_than_a_turn_is_refused() -> None:
    with refused("loads.phase_too_long", start="0°", end="720°"):
        activity(degrees(0, 720), Turning([0]))


ALL = np.ones(4, dtype=bool)


def test_a_table_counts_angles_modulo_one_turn() -> None:
    table = Table("input", tuple(np.radians([0, 90, 360])), (0.0, 9.0, 0.0))
    got = interpolated(table, Turning([-270, 45, 90, 405]), ALL)
    np.testing.assert_allclose(got, [9, 4.5, 9, 4.5])


def test_a_table_over_one_turn_and_a_half_takes_angles_as_they_are() -> None:
    table = Table("input", tuple(np.radians([-90.0, 0.0, 180.0, 450.0])), (0.0, 9.0, 0.0, 27.0), "angle")
    values = interpolated(table, Turning([-90, 0, 90, 270, 450]), np.ones(5, dtype=bool))
    assert values == pytest.approx([0.0, 9.0, 4.5, 9.0, 27.0])
    with refused("loads.table_too_short", ranges="450° to 460°"):
        interpolated(table, Turning([0, 460]), np.ones(2, dtype=bool))


def test_a_table_over_two_turns_repeats_after_them() -> None:
    table = Table("input", tuple(np.radians([0, 360, 720])), (0.0, 36.0, 0.0))
    got = interpolated(table, Turning([90, 450, 720 + 90, -90]), ALL)
    np.testing.assert_allclose(got, [9, 27, 9, 9])


def test_a_table_that_ends_too_early_says_what_is_missing() -> None:
    table = Table("input", tuple(np.radians([0, 180])), (0.0, 1.0))
    with refused("loads.table_too_short", first="0°", last="180°", low="180°", high="270°"):
        interpolated(table, Turning([0, 90, 180, 270]), ALL)
    got = interpolated(table, Turning([0, 90, 180, 270]), np.array([True, True, True, False]))
    np.testing.assert_allclose(got[:3], [0, 0.5, 1])


def test_a_table_over_an_output() -> None:
    table = Table(Output("position", "slider.B", "x", written="B.x"), (-1.0, 0.0, 1.0), (5.0, 0.0, 1.0))
    got = interpolated(table, Turning([0, 60, 90, 180]), ALL)
    np.testing.assert_allclose(got, [1, 0.5, 0, 5], atol=1e-12)
    narrow = Table(Output("position", "slider.B", "x", written="B.x"), (-0.5, 1.0), (5.0, 0.0))
    with refused("loads.table_too_short", over="B.x", low="-1000 mm", high="-500 mm"):
        interpolated(narrow, Turning([0, 60, 90, 180]), ALL)
