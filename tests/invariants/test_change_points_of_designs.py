"""Designs that touch a change point between two positions are those that each of them does alone."""

from __future__ import annotations

import pytest
from tests.invariants.just_turning import FOURBAR, SLIDE

import linkwright as lw


def passed(machine: lw.Mechanism, address: str, values: list[float], steps: int) -> tuple[list[bool], list[bool]]:
    """Which designs pass their cycle side by side, and which do alone."""
    swept = lw.sweep(machine, {address: values}, outputs=["B.x max"], steps=steps)
    return swept.ok.tolist(), [alone(machine.with_dimensions({address: each}), steps) for each in values]


def alone(machine: lw.Mechanism, steps: int) -> bool:
    """Whether the machine passes its cycle, between the positions too."""
    try:
        return bool(lw.solve_motion(machine, steps=steps).ok.all())
    except lw.PositionError:
        return False


@pytest.mark.parametrize("speed", [3, -3])
@pytest.mark.parametrize("start", [0, 175, 183])
@pytest.mark.parametrize("steps", [36, 37])
def test_a_crank_that_just_turns_or_does_not(steps: int, start: int, speed: int) -> None:
    """Crank 1 m, coupler 3.5 m, rocker 2.5 m: they are stretched over a frame of 5 m at 180°, folded over one of 2 m
    at 0°; beyond they part, for little or for much of the turn."""
    machine = lw.loads(FOURBAR.replace("SPEED", str(speed)).replace("START", str(start)))
    frames = [4.0, 4.99, 5.0001, 4.9999, 5.00001, 2.5, 2.01, 1.9999, 3.0]
    together, single = passed(machine, "frame.Q.x", frames, steps)
    assert together == single == [True, True, False, True, False, True, True, False, True]


@pytest.mark.parametrize("shift", [0.0, 0.13, 1.3])
def test_a_sweep_marks_the_designs_that_a_single_motion_does(shift: float) -> None:
    """A short gap at the turning point of the slide, between two positions."""
    mechanism = lw.loads(SLIDE.replace("SHIFT", str(shift)))
    rockers = [1.3935, 1.41, 1.399, 1.6065, 1.59]
    together, single = passed(mechanism, "rocker.length", rockers, 24)
    assert together == single == [False, True, False, False, True]
