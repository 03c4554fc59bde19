"""How long a cycle is, where it begins and whether it closes, for drivers of all kinds: reckoned by hand."""

from __future__ import annotations

import re
from math import pi, radians

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw

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


def machine(first: str = SPEED, second: str = SPEED, third: str = "", cycle: str = "") -> lw.Mechanism:
    text = TWO.replace("FIRST", first).replace("SECOND", second)
    if not third:
        text = text.replace("  third: {slide: way, THIRD}\n", "").replace(", c: {points: [C]}", "")
        text = text.replace(text[text.index("joints:") : text.index("drivers:")], "")
    return lw.loads(text.replace("THIRD", third) + (f"cycle: {{{cycle}}}\n" if cycle else ""))


def time_span(mechanism: lw.Mechanism) -> tuple[float, float, bool]:
    """Begin and duration of the cycle, and whether it closes: then the last position is not the first again."""
    time = lw.solve_motion(mechanism, steps=4).time
    closed = len(time) == 4
    return float(time[0]), float(time[-1] - time[0]) * (4 / 3 if closed else 1), closed


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
        (
            SPEED,
            TABLE.format(end=2, last=0).replace("0 s, 1 s", f"0 s, {pi} s").replace("2 s", f"{2 * pi} s"),
            (0.0, 2 * pi, True),
        ),
        (
            SPEED,
            TABLE.format(end=2, last=0.05).replace("0 s, 1 s", f"0 s, {pi} s").replace("2 s", f"{2 * pi} s"),
            (0.0, 2 * pi, False),
        ),
        (SPEED, "speed: 0.1 m/s", (0.0, pi, False)),
    ],
)
def test_a_cycle_lasts_until_all_drivers_are_back_or_as_long_as_the_slowest(
    second: str, third: str, span: tuple[float, float, bool]
) -> None:
    begin, duration, closed = time_span(machine(second=second, third=third))
    assert (begin, duration) == pytest.approx(span[:2], rel=1e-12)
    assert closed is span[2]


@pytest.mark.parametrize(
    ("first", "cycle", "span"),
    [
        (SPEED, "turns: 1", (0.0, pi, True)),
        (SPEED, "turns: 3", (0.0, 3 * pi, True)),
        (SPEED, "turns: 2.5", (0.0, 2.5 * pi, False)),
        ("speed: -2 rad/s", "turns: 1", (0.0, pi, True)),
        (SPEED, f"duration: {2 * pi!r} s", (0.0, 2 * pi, True)),
        (SPEED, "duration: 2 s", (0.0, 2.0, False)),
        (SPEED, "from: 90 deg, to: 150 deg", (radians(30), radians(30), False)),
        ("speed: -0.5 rad/s, start: 10 deg", "from: 0 deg, to: -90 deg", (radians(20), pi, False)),
    ],
)
def test_a_cycle_that_the_file_gives(first: str, cycle: str, span: tuple[float, float, bool]) -> None:
    mechanism = machine(first, first, cycle=cycle)
    begin, duration, closed = time_span(mechanism)
    assert (begin, duration) == pytest.approx(span[:2], rel=1e-12, abs=1e-15)
    assert closed is span[2]
    for steps in (1, 4):
        for endpoint in (False, True):
            found = lw.solve_motion(mechanism, steps=steps, endpoint=endpoint)
            count = steps if closed and not endpoint else steps + 1
            assert found.steps == count
            assert found.time == pytest.approx(span[0] + span[1] * np.arange(count) / steps, abs=1e-14)
            if "to: " in cycle:
                end = radians(float(cycle.split("to: ")[1].split(maxsplit=1)[0]))
                assert found.input[-1] == pytest.approx(end, abs=1e-14)


@pytest.mark.parametrize(
    ("second", "key", "numbers"),
    [
        ("speed: 4 rad/s", None, []),
        ("speed: 3 rad/s", "cycle.turns_of_drivers", ["2"]),
        ("speed: 2.17 rad/s", "cycle.drivers_apart", ["200", "628.318531"]),
        ("speed: 2.8284271247461903 rad/s", "cycle.drivers_never_back", ["1000"]),
    ],
)
def test_a_cycle_of_other_than_one_turn_is_said(second: str, key: str | None, numbers: list[str]) -> None:
    notes = lw.solve_motion(machine(second=second), steps=4).notes
    assert [note.code for note in notes] == ([] if key is None else [key])
    for note in notes:
        assert set(numbers) <= set(re.findall(r"\d+(?:\.\d+)?", note)) and "first" in note


def test_turns_of_a_fast_driver_leave_the_slow_one_on_its_way() -> None:
    for turns, closed in ((1.0, False), (2.0, True)):
        fast = machine("speed: 4 rad/s", SPEED, cycle=f"turns: {turns}")
        assert time_span(fast) == (0.0, pytest.approx(turns * pi / 2), closed)


def test_a_cycle_that_cannot_be_laid_out_is_refused() -> None:
    with refused("motion.law_without_end", driver="first"):
        time_span(machine(STILL.replace(" m", " rad"), STILL.replace(" m", " rad"), "speed: 1 m/s"))
    with refused("motion.law_without_end", driver="first"):
        time_span(machine(STILL.replace(" m", " rad"), STILL.replace(" m", " rad")))
    with refused("given_instead.no_whole_from", option="steps", value="0"):
        lw.solve_motion(machine(), steps=0)
    with refused("choice", lw.ModelError):
        machine(STILL.replace(" m", " rad"), cycle="turns: 1")
