"""How long a cycle is, where it begins and whether it closes, for drivers of all kinds: reckoned by hand."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import CycleError, over_cycle, time_span
from linkwright.mechanism.mechanism import Cycle

TWO = """
format: 1
frame: {points: {O: [0 m, 0 m], Q: [3 m, 0 m], G: [0 m, 0 m]}}
links: {a: {points: [O, A], length: 1 m}, b: {points: [Q, B], length: 1 m}, c: {points: [C]}}
joints: {way: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: c, at: C}}
drivers:
  first: {turn: a, about: O, FIRST}
  second: {turn: b, about: Q, SECOND}
  third: {slide: way, THIRD}
"""
SPEED = "speed: 2 rad/s, start: 30 deg"
STILL = 'position: "0.1 m + 0 m*t/(1 s)"'
TABLE = "table: {{time: [0 s, 1 s, {end} s], position: [0 m, 0.1 m, {last} m], interpolation: linear}}"


def machine(
    first: str = SPEED, second: str = SPEED, third: str = "", cycle: Cycle | None = None
) -> lw.Mechanism:
    text = TWO.replace("FIRST", first).replace("SECOND", second)
    if not third:
        text = text.replace("  third: {slide: way, THIRD}\n", "").replace(", c: {points: [C]}", "")
        text = text.replace(text[text.index("joints:") : text.index("drivers:")], "")
    return replace(lw.loads(text.replace("THIRD", third)), cycle=cycle)


@pytest.mark.parametrize(
    ("second", "third", "span"),
    [
        (SPEED, "", (0.0, pi, True)),
        ("speed: -1 rad/s", "", (0.0, 2 * pi, True)),
        ("speed: 0.5 rad/s", "", (0.0, 4 * pi, True)),
        ("speed: 3 rad/s", "", (0.0, 2 * pi, True)),
        ("speed: 4 rad/s, start: 7 rad", "", (0.0, pi, True)),
        ("speed: 0.75 rad/s", "", (0.0, 8 * pi, True)),
        ("speed: 2.17 rad/s", "", (0.0, pi, False)),
        ("speed: 2.8284271247461903 rad/s", "", (0.0, pi, False)),
        (SPEED, TABLE.format(end=2, last=0), (0.0, pi, False)),
        (SPEED, TABLE.format(end=2, last=0).replace("0 s, 1 s", f"0 s, {pi} s").replace("2 s", f"{2 * pi} s"),
         (0.0, 2 * pi, True)),
        (SPEED, TABLE.format(end=2, last=0.05).replace("0 s, 1 s", f"0 s, {pi} s").replace("2 s", f"{2 * pi} s"),
         (0.0, 2 * pi, False)),
        (SPEED, "speed: 0.1 m/s", (0.0, pi, False)),
    ],
)  # fmt: skip
def test_a_cycle_lasts_until_all_drivers_are_back_or_as_long_as_the_slowest(
    second: str, third: str, span: tuple[float, float, bool]
) -> None:
    begin, duration, closed = time_span(machine(second=second, third=third))
    assert (begin, duration) == pytest.approx(span[:2], rel=1e-12)
    assert closed is span[2]


@pytest.mark.parametrize(
    ("first", "cycle", "span"),
    [
        (SPEED, Cycle(turns=1.0), (0.0, pi, True)),
        (SPEED, Cycle(turns=3.0), (0.0, 3 * pi, True)),
        (SPEED, Cycle(turns=2.5), (0.0, 2.5 * pi, False)),
        ("speed: -2 rad/s", Cycle(turns=1.0), (0.0, pi, True)),
        (SPEED, Cycle(duration=2 * pi), (0.0, 2 * pi, True)),
        (SPEED, Cycle(duration=2.0), (0.0, 2.0, False)),
        (SPEED, Cycle(start=radians(90), end=radians(150)), (radians(30), radians(30), False)),
        (SPEED, Cycle(start=radians(90), end=radians(-30)), (radians(30), radians(-60), False)),
        (SPEED, Cycle(end=radians(90)), (0.0, radians(30), False)),
        ("speed: -0.5 rad/s, start: 10 deg", Cycle(start=0.0, end=-pi / 2), (radians(20), pi, False)),
    ],
)  # fmt: skip
def test_a_cycle_that_the_file_gives(first: str, cycle: Cycle, span: tuple[float, float, bool]) -> None:
    mechanism = machine(first, first, cycle=cycle)
    begin, duration, closed = time_span(mechanism)
    assert (begin, duration) == pytest.approx(span[:2], rel=1e-12, abs=1e-15)
    assert closed is span[2]
    for steps in (1, 4):
        for endpoint in (False, True):
            found = over_cycle(mechanism, steps, endpoint)
            count = steps if closed and not endpoint else steps + 1
            assert (found.count, found.closed, found.cycle) == (count, closed, True)
            assert found.time == pytest.approx(span[0] + span[1] * np.arange(count) / steps, abs=1e-14)
            assert found.period == (pytest.approx(abs(span[1])) if closed else None)
            if cycle.end is not None:
                assert found.coordinates["first"][0][-1] == pytest.approx(cycle.end, abs=1e-14)


@pytest.mark.parametrize(
    ("second", "words"),
    [
        ("speed: 4 rad/s", []),
        ("speed: 3 rad/s", ["2 turns of 'first': only then are all drivers back"]),
        ("speed: 2.17 rad/s", ["200 turns of 'first'", "cycle: {duration: 628.318531 s}"]),
        ("speed: 2.8284271247461903 rad/s", ["not back together within 1000 turns"]),
    ],
)
def test_a_cycle_of_other_than_one_turn_is_said(second: str, words: list[str]) -> None:
    notes = "".join(map(str, lw.solve_motion(machine(second=second), steps=4).notes))
    assert all(word in notes for word in words) and bool(notes) == bool(words)


def test_turns_of_a_fast_driver_leave_the_slow_one_on_its_way() -> None:
    for turns, closed in ((1.0, False), (2.0, True)):
        fast = machine("speed: 4 rad/s", SPEED, cycle=Cycle(turns=turns))
        assert time_span(fast) == (0.0, pytest.approx(turns * pi / 2), closed)


def test_a_cycle_that_cannot_be_laid_out_is_refused() -> None:
    with pytest.raises(CycleError, match="no natural end"):
        time_span(machine(STILL.replace(" m", " rad"), STILL.replace(" m", " rad"), "speed: 1 m/s"))
    with pytest.raises(
        CycleError, match=r"follows a law in time; write how long it is: cycle: \{duration: 2 s\}"
    ):
        time_span(machine(STILL.replace(" m", " rad"), STILL.replace(" m", " rad")))
    with pytest.raises(LinkwrightError, match="steps is 0; give a whole number"):
        over_cycle(machine(), 0)
    with pytest.raises(CycleError, match="constant speed"):
        time_span(machine(STILL.replace(" m", " rad"), cycle=Cycle(turns=1.0)))
