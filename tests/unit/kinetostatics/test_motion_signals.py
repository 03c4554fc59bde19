"""What loads read of a motion: angles counted on over the turns, whichever positions are asked for."""

from __future__ import annotations

import numpy as np
import pytest
from tests.unit.kinematics.geared_followers import DRAG, ROCKER, fourbar

import linkwright as lw
from linkwright.core.outputs import Output
from linkwright.kinetostatics.signals import MotionSignals

PERIOD = np.pi


def machine(lengths: tuple[str, str], backwards: bool) -> lw.Mechanism:
    found = fourbar(lengths, "-1")
    return found.with_dimensions({"driver.speed": -2.0}) if backwards else found


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("lengths", [DRAG, ROCKER])
def test_angles_are_those_of_the_cycle_and_whole_turns(lengths: tuple[str, str], backwards: bool) -> None:
    """A follower that turns once a turn gains 2π in each; one that swings, and the crank's law, give the sense."""
    mechanism = machine(lengths, backwards)
    cycle = lw.solve_motion(mechanism, steps=720)
    sense = (-1.0 if backwards else 1.0) if lengths is DRAG else 0.0
    time = np.array([0.1, 2.9, 0.1 + PERIOD, 0.1 - PERIOD, 2.9 + 5 * PERIOD, 1.7, 1.7 - 3 * PERIOD])
    laps = np.floor(time / PERIOD)
    signals = MotionSignals(lw.solve_motion(mechanism, times=time))
    for name in ("follower", "wheel"):
        turns = sense * (-1.0 if name == "wheel" else 1.0)
        value, rate = signals.output(Output("angle", name))
        known = np.interp(time - laps * PERIOD, cycle.time, cycle.link(name).angle)
        assert value == pytest.approx(known + 2 * np.pi * turns * laps, abs=1e-3)
        assert rate == pytest.approx(signals.motion.link(name).angular_velocity, abs=1e-12)
    between = signals.angle_between("crank", "follower", 0.3)
    gain = 2 * np.pi * (sense - (-1.0 if backwards else 1.0))
    own = np.interp(time - laps * PERIOD, cycle.time, cycle.link("follower").angle - cycle.link("crank").angle)
    near = own + gain * laps - between
    assert near == pytest.approx(np.full(7, 2 * np.pi * np.round(near[0] / (2 * np.pi))), abs=1e-3)
    begin = cycle.link("follower").angle[0] - cycle.link("crank").angle[0] - near[0]
    assert abs(begin - 0.3) <= np.pi + 1e-9
    assert signals.heading == (-1 if backwards else 1) and signals.rotary and signals.closes is None
    assert signals.full_cycle.period == pytest.approx(PERIOD)
    assert MotionSignals(cycle).closes == pytest.approx((PERIOD, -2 * np.pi if backwards else 2 * np.pi))
    assert MotionSignals(lw.solve_motion(mechanism, steps=720, endpoint=True)).closes is None
