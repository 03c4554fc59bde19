"""Magnitudes at one position against magnitudes over arrays of positions, for cranks turned either way.

The formulas are the same; how a stroke is found is not: by limits of the input in one turn, or by times. The numbers
of the formulas stand in ``test_phases`` and ``test_load_magnitudes``, from closed forms.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.refusals import refused
from tests.unit.applied_loads.turning_crank import JAW, Turning

from linkwright.applied_loads.force import Force
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.over_cycle import evaluate
from linkwright.applied_loads.phases import Always, InputPhase, MovingPhase, Phase, SwingPhase
from linkwright.applied_loads.signals import BetweenLimits
from linkwright.applied_loads.sizes import Constant, Formula, Ramp, Size, Table
from linkwright.applied_loads.strokes import Amount, StrokePart, moving_of_turn, stroke_of_turn
from linkwright.core.expressions import parse
from linkwright.core.outputs import Output
from linkwright.formula.trace import Mask, Scalar

PLACE = Output("position", "jaw.P", "x")
TURN = 2 * np.pi


@dataclass
class AtPosition:
    """What a traced magnitude sees, as plain numbers, at one position of a crank."""

    load: Force
    signals: Turning
    index: int

    @property
    def input(self) -> float:
        return float(self.signals.input[self.index])

    @property
    def rotary(self) -> bool:
        return True

    @property
    def heading(self) -> float:
        return float(self.signals.rate)

    @property
    def along(self) -> float:
        return self.input

    @property
    def sense(self) -> float:
        return float(np.sign(self.heading))

    @property
    def lap(self) -> float:
        return TURN

    def share_of_input(self, phase: BetweenLimits, share: Scalar) -> Scalar:
        return share

    def stroke(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        return stroke_of_turn(self, phase)

    def moving(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        return moving_of_turn(self, phase)

    def named(self, name: str) -> float:
        return float(self.signals.time[self.index]) if name == "t" else self.input

    def dimension(self, field: str) -> float:
        return self.load.dimensions()[f"loads.load.{field}"]

    def constant(self, field: str) -> float:
        return self.load.magnitude.constants[field]

    def limit(self, output: Output, kind: str) -> float:
        return next(each.input for each in self.signals.limits(output) if each.kind == kind)

    def limit_value(self, output: Output, kind: str) -> float:
        return next(each.value for each in self.signals.limits(output) if each.kind == kind)

    def output(self, output: Output) -> float:
        return float(self.signals.output(output)[0][self.index])

    def angle_between(self, a: str, b: str, near: float) -> float:
        raise AssertionError

    def lookup(self, x: float) -> float:
        table = self.load.magnitude.size
        assert isinstance(table, Table)
        return float(np.interp(x, table.x, table.y))


def force(size: Size, phase: Phase = Always()) -> Force:
    return Force(name="load", on="jaw", at="P", direction=0.0, magnitude=Magnitude(size, phase))


def magnitude(load: Force, course: AtPosition) -> float:
    return float(load.magnitude.at(course))


def degrees(start: float, end: float) -> InputPhase:
    return InputPhase(float(np.radians(start)), float(np.radians(end)))


def part(word: Any, *amounts: float, share: bool = True) -> SwingPhase:
    return SwingPhase(PLACE, "max", "min", StrokePart(word, tuple(Amount(each, share) for each in amounts)))


PHASES: dict[str, Phase] = {
    "interval": degrees(30, 200),
    "interval through the end of the turn": degrees(300, 400),
    "interval from the larger end": degrees(200, 30),
    "whole turn": degrees(0, 360),
    "growing": MovingPhase(JAW, "increasing"),
    "falling": MovingPhase(JAW, "decreasing"),
    "from limit to limit": SwingPhase(JAW, "max", "min"),
    "back": SwingPhase(JAW, "min", "max"),
    "first share": part("first", 0.3),
    "last share": part("last", 0.3),
    "last way": part("last", 0.5, share=False),
    "free ends": part("free", 0.1, 0.25),
    "free by the same way": part("free", 0.4, share=False),
    "first share backwards": replace(part("first", 0.3), start="min", end="max"),
}
SPEEDS = pytest.mark.parametrize("speed", [1.0, -1.0])
LAGS = pytest.mark.parametrize("lag", [0.0, 75.0])


def compared(load: Force, signals: Turning) -> tuple[np.ndarray, np.ndarray]:
    traced = [magnitude(load, AtPosition(load, signals, k)) for k in range(len(signals.input))]
    return np.array(traced), evaluate(load, signals)


@SPEEDS
@LAGS
@pytest.mark.parametrize("phase", PHASES)
def test_a_ramp_in_a_phase(phase: str, lag: float, speed: float) -> None:
    """At 9.5°, 26.5° … of three turns, and at the same magnitude without a ramp."""
    signals = Turning(speed * (np.arange(0, 1080, 17.0) + 9.5), speed=speed, lag=lag)
    if phase == "interval from the larger end" and speed < 0:
        signals = Turning(-np.arange(0, 1080, 17.0) - 9.5, speed=speed, lag=lag)
    for load in (force(Ramp(20.0, 90.0), PHASES[phase]), force(Constant(7.0), PHASES[phase])):
        traced, array = compared(load, signals)
        assert traced == pytest.approx(array, abs=1e-9)
        assert phase == "whole turn" or 0 < np.count_nonzero(array) < len(array)


@pytest.mark.parametrize(("phase", "at"), [("interval", [30, 200]), ("from limit to limit", [0, 180])])
def test_a_phase_holds_its_ends(phase: str, at: list[float]) -> None:
    load = force(Ramp(20.0, 90.0), PHASES[phase])
    traced, array = compared(load, Turning([*at, *(each + 360 for each in at)]))
    assert traced == pytest.approx([20, 90, 20, 90], abs=1e-6)
    assert array == pytest.approx(traced, abs=1e-6)


def test_a_size_follows_the_share_of_its_phase() -> None:
    load, signals = force(Ramp(20.0, 90.0), PHASES["interval"]), Turning([250])
    assert load.magnitude.size.at(AtPosition(load, signals, 0), 0.25) == pytest.approx(37.5)
    assert magnitude(load, AtPosition(load, signals, 0)) == 0.0


TABLES = {
    "half a turn": Table("input", tuple(np.radians([-30, 60, 150])), (1.0, 5.0, 2.0)),
    "a turn": Table("input", tuple(np.radians([0, 90, 360])), (1.0, 9.0, 1.0)),
    "a turn from within": Table("input", tuple(np.radians([30, 90, 390])), (1.0, 9.0, 1.0)),
    "two turns": Table("input", tuple(np.radians([0, 360, 720])), (1.0, 36.0, 1.0)),
    "one turn and a half": Table("input", tuple(np.radians([0, 360, 540])), (1.0, 36.0, 4.0)),
    "time": Table("time", (0.0, 1.0, 4.0), (3.0, 4.0, -2.0), across="time"),
    "angle": Table(JAW, (-1.0, 0.2, 1.0), (3.0, 4.0, -2.0)),
    "length": Table(PLACE, (-1.0, 0.2, 1.0), (3.0, 4.0, -2.0), across="length"),
}


@SPEEDS
@pytest.mark.parametrize("name", TABLES)
def test_a_table(name: str, speed: float) -> None:
    """Within what it covers as the arrays have it; elsewhere no number."""
    table, load = TABLES[name], force(TABLES[name])
    at = np.arange(-350, 1081, 14.3) if table.over == "input" else speed * np.arange(5, 1081, 14.3)
    signals = Turning(at, speed=speed)
    traced = np.array([magnitude(load, AtPosition(load, signals, k)) for k in range(len(at))])
    covered = np.isfinite(traced)
    assert covered.sum() > 3
    some = Turning(at[covered], speed=speed)
    assert traced[covered] == pytest.approx(evaluate(load, some), abs=1e-9)
    for k in np.flatnonzero(~covered)[:3]:
        with refused("loads.table_too_short", name="load"):
            evaluate(load, Turning(at[[k]], speed=speed))
    whole = {"a turn", "a turn from within", "two turns", "angle", "length"}
    assert covered.all() == (name in whole)


def test_a_table_begins_and_ends_with_its_rows() -> None:
    load = force(TABLES["half a turn"])
    traced, array = compared(load, Turning([-30, 150, 330, 510]))
    assert traced == pytest.approx([1, 2, 1, 2]) and array == pytest.approx(traced)


@pytest.mark.parametrize(
    ("phase", "ends"),
    [
        (part("first", 0.3), (0.0, 0.6)),
        (part("first", 0.3, share=False), (0.0, 0.3)),
        (part("last", 0.3), (1.4, 2.0)),
        (part("free", 0.1, 0.25), (0.2, 1.5)),
        (part("free", 0.4, share=False), (0.4, 1.6)),
    ],
)
def test_a_part_of_a_stroke_of_two_metres(phase: SwingPhase, ends: tuple[float, float]) -> None:
    load = force(Constant(1.0), phase)
    begin, end, stroke = phase.part_ends(AtPosition(load, Turning([0]), 0))
    assert (begin, end) == pytest.approx(ends) and stroke == pytest.approx(-2.0)


@pytest.mark.parametrize("amounts", [(0.6, 0.5), (0.55, 0.5), (-0.1, 0.2), (0.2, -0.1)])
def test_a_part_that_the_stroke_does_not_have_gives_no_number(amounts: tuple[float, float]) -> None:
    for size in (Ramp(1.0, 2.0), Constant(5.0)):
        load = force(size, part("free", *amounts))
        assert np.isnan(magnitude(load, AtPosition(load, Turning([90]), 0)))
        with refused("loads.part_too_long", part="free", stroke="2000 mm"):
            evaluate(load, Turning([90]))


def test_outputs_and_numbers_that_a_load_takes() -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    link = next(iter(mechanism.links))
    names = (link, "t", "nothing")
    divided = Magnitude(Formula(parse(f"sin({link})/(2 + cos({link}))", names)))
    assert not divided.traceable(mechanism)
    assert [str(each) for each in divided.outputs(mechanism)] == [link]
    plain = Magnitude(Formula(parse(f"3*sin({link})/2 + t", names)))
    assert plain.traceable(mechanism) and len(plain.outputs(mechanism)) == 1
    assert Magnitude(Formula(parse("1/(2 + t)", names))).traceable(mechanism)
    assert not Magnitude(Formula(parse("nothing", names))).traceable(mechanism)
    constant = Magnitude(Constant(5.0))
    assert constant.traceable(mechanism) and constant.outputs(mechanism) == ()
    over = Magnitude(TABLES["length"], part("free", 0.1, 0.25))
    assert over.outputs(mechanism) == (PLACE,)
    assert over.constants == {"first": -1.0, "last": 1.0, "part.0": 0.1, "part.1": 0.25}
    assert Magnitude(Constant(1.0), PHASES["back"]).outputs(mechanism) == ()
