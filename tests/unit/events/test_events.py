"""Events of functions whose roots are known, over cycles of many designs."""

from collections.abc import Callable, Mapping

import numpy as np
import pytest

import linkwright as lw
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.loads import between, of_limits
from linkwright.events.course import Course, Span, Stretches
from linkwright.events.events import Events, events
from linkwright.events.formula import NODE, ROW, Formula, Known
from linkwright.events.solved_again import OfTimes
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, Trace, cos, maximum, sin

TURN = 2.0 * np.pi


def span(count: int, *, closed: bool = True) -> Span:
    """Cycles of one turn at 1 rad/s, so that times are angles."""
    machine = lw.load("gallery:crank_rocker")
    (driver,) = machine.drivers.values()
    course = Course((driver,), 0.0, TURN, closed, 1 if closed else 0)
    return Span(course, np.full(count, TURN), np.zeros(count))


def formula(of: Callable[[Scalar, Mapping[str, Scalar]], Scalar], *columns: str) -> Formula:
    t = Trace()
    low, high = t.position(LOW), t.position(HIGH)
    given = {name: t.position(name) for name in columns}
    return Formula(Program.of(t, {"g": of(low + (high - low) * t.parameter(NODE), given)}))


def roots(
    of: Callable[[Scalar, Mapping[str, Scalar]], Scalar],
    *,
    closed: bool = True,
    cuts: Events | None = None,
    **columns: list[float],
) -> Events:
    count = len(next(iter(columns.values()), [0.0]))
    given = {name: np.array(column) for name, column in columns.items()} | {ROW: np.arange(float(count))}
    stretches = Stretches(span(count, closed=closed), [] if cuts is None else [cuts])
    (found,) = events(formula(of, *columns), Known({}), given, stretches)
    return found


def test_roots_of_a_wave_are_met_to_rounding_with_their_sense() -> None:
    found = roots(lambda x, _: sin(3.0 * x - 0.4))
    expected = (0.4 + np.pi * np.arange(6)) / 3.0
    assert np.sort(np.mod(found.time, TURN)) == pytest.approx(expected, abs=1e-15)
    order = np.argsort(np.mod(found.time, TURN))
    assert found.rising[order].tolist() == [True, False] * 3


def test_designs_have_as_many_roots_as_each_has() -> None:
    found = roots(lambda x, c: cos(x) - c["a"], a=[0.3, 1.5, -0.999999, 0.0])
    assert np.bincount(found.design, minlength=4).tolist() == [2, 0, 2, 2]
    each = np.arccos([0.3, -0.999999, 0.0])
    expected = np.sort(np.stack([each, TURN - each]), axis=0).T.ravel()
    assert np.mod(found.time, TURN) == pytest.approx(expected, abs=1e-10)


def test_what_touches_zero_has_no_event_and_what_dips_below_has_two() -> None:
    found = roots(lambda x, c: 1.0 + c["a"] + cos(x), a=[0.0, 1e-7, -1e-7])
    assert np.bincount(found.design, minlength=3).tolist() == [0, 0, 2]
    half = np.arccos(1.0 - 1e-7)
    assert np.mod(found.time, TURN) == pytest.approx([np.pi - half, np.pi + half], abs=1e-9)


def test_an_open_course_does_not_go_around() -> None:
    assert len(roots(lambda x, _: cos(x - 1.0)).time) == 2
    found = roots(lambda x, _: sin(0.5 * x - 0.5), closed=False)
    assert found.time == pytest.approx([1.0], abs=1e-14)


def test_of_a_rest_between_two_ways_the_middle_counts() -> None:
    """max(sin x - 1/2, 0) + min(sin x + 1/2, 0) rests where |sin x| < 1/2; cut at the ends of the rests."""
    cuts = roots(lambda x, _: (sin(x) - 0.5) * (sin(x) + 0.5))
    assert len(cuts.time) == 4
    found = roots(lambda x, _: maximum(sin(x) - 0.5, 0.0) - maximum(-sin(x) - 0.5, 0.0), cuts=cuts)
    assert np.sort(np.mod(found.time + 1.0, TURN)) == pytest.approx([1.0, 1.0 + np.pi], abs=1e-12)
    assert (found.edges >= 0).all()


def test_times_of_events_have_the_derivatives_of_the_implicit_function() -> None:
    found = roots(lambda x, c: cos(x) - c["a"], a=[0.3, -0.6])
    found.bar[:] = 1.0
    design, by_columns, _ = found.pull()
    assert design.tolist() == [0, 0, 1, 1]
    assert by_columns["a"] == pytest.approx(-1.0 / np.sin(found.time), rel=1e-12)


def test_strokes_go_from_one_event_to_the_next_around_the_cycle() -> None:
    found = roots(lambda x, c: sin(x - c["a"]), a=[0.5, 4.0])
    own = found.stretches.span
    rising = of_limits(found, (True, False), own)
    assert rising.length == pytest.approx([np.pi, np.pi])
    _, acts, since = rising.at(np.array([0, 0, 1, 1]), np.array([1.0, 5.0, 5.0, 0.3]))
    assert acts.tolist() == [True, False, True, True]
    assert since == pytest.approx([0.5, 0.5, 4.0, 4.0 - TURN])
    begin, end = (found.selected(found.rising == kind) for kind in (True, False))
    assert between(begin, end, own).length == pytest.approx([np.pi, np.pi])


def test_signals_of_times_change_their_sign_at_roots_and_at_jumps() -> None:
    """The place of a jump, of which no slope tells, is halved down to."""

    def values(time: np.ndarray) -> np.ndarray:
        turn = time % TURN
        return np.stack([np.cos(turn) - 0.3, np.where((turn > 2.0) & (turn < 2.1), 1.0, -1.0)])

    signals = OfTimes(values, 2, 1e-9 * TURN)
    smooth, jumping = events(signals, Known({}), {ROW: np.zeros(1)}, Stretches(span(1), []))
    assert np.sort(smooth.time % TURN) == pytest.approx([np.arccos(0.3), TURN - np.arccos(0.3)], abs=1e-13)
    assert np.sort(jumping.time % TURN) == pytest.approx([2.0, 2.1], abs=1e-12)
    assert jumping.rising[np.argsort(jumping.time % TURN)].tolist() == [True, False]
