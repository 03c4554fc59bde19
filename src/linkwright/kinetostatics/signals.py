"""What the magnitudes of loads may follow, read from a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from linkwright.applied_loads.signals import FullCycle, Limit
from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.drivers.base import Law
from linkwright.events.limit_positions import limit_positions
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.output_formulas import CycleAngles
from linkwright.kinematics.positions import Positions
from linkwright.kinetostatics.friction import moving_rate
from linkwright.mechanism.mechanism import Mechanism

TURN = 2 * np.pi


class MotionSignals:
    """Signals over the positions of a motion; see :class:`linkwright.applied_loads.signals.Signals`.

    Angles and limit positions refer to the mechanism's cycle, so they do not depend on which positions are
    asked.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion = motion

    @property
    def mechanism(self) -> Mechanism:
        """Whose motion it is."""
        return self.motion.mechanism

    @property
    def time(self) -> Floats:
        """Times, (n,) s."""
        return self.motion.time

    @property
    def input(self) -> Floats:
        """Coordinate of the first driver, (n,) rad or m."""
        return self.motion.input

    @property
    def ok(self) -> Flags:
        """Which positions are solved, (n,)."""
        return self.motion.ok

    @cached_property
    def rotary(self) -> bool:
        """Whether the first driver turns."""
        return next(iter(self.motion.positions.rotary.values()), True)

    @cached_property
    def heading(self) -> int:
        """1 where the input only grows over the cycle, -1 where it only falls, else 0."""
        rate = next(iter(self.cycle.positions.coordinates.values()))[1]
        return int((rate > 0).all()) - int((rate < 0).all())

    @cached_property
    def closes(self) -> tuple[float, float] | None:
        """Period and gain of the input in it, where the first position comes after the last."""
        return None if self.motion.positions.repeated else self._lap(self.motion.positions)

    @cached_property
    def _angles(self) -> CycleAngles:
        return CycleAngles(self.motion)

    @property
    def cycle(self) -> Motion:
        """The motion over the mechanism's cycle; the motion itself where no cycle is known."""
        return self._angles.cycle

    @cached_property
    def turned(self) -> Motion:
        """The motion over a cycle that closes, if one can be passed, else over the model's own."""
        if self.cycle.positions.closed or self.mechanism.cycle is None:
            return self.cycle
        found = self._angles.over(replace(self.mechanism, cycle=None))
        return found if found is not None and found.positions.closed and found.complete else self.cycle

    @cached_property
    def full_cycle(self) -> FullCycle:
        """The cycle over which limits are found."""
        return FullCycle(*(self._lap(self.turned.positions) or (None,)))

    def output(self, output: Output) -> tuple[Floats, Floats]:
        """Value and rate of an output, (n,) each."""
        value, rate, second = (self.motion.read(each) for each in output.course)
        if output.kind == "angle" and self.cycle is not self.motion:
            value = self._angles.of(output.owner)
        return value, self.motion.moving(rate, second, output.dimension)

    def rate(self, output: Output | RelativeAngle) -> Floats:
        """Rate of an output, (n,), zero at rest."""
        return self.output(output)[1] if isinstance(output, Output) else moving_rate(self.motion, output)

    def limits(self, output: Output) -> Sequence[Limit]:
        """Where an output reverses within the cycle, by increasing time."""
        return sorted(limit_positions(self.turned, output), key=lambda each: each.time)

    def angle_between(self, a: str, b: str, near: float) -> Floats:
        """Angle of link b against link a, (n,) rad, within half a turn of ``near`` where the cycle begins."""
        first = _between(self.cycle, a, b)
        begin = next(iter(first[np.isfinite(first)]), near)
        first = first + TURN * np.round((near - begin) / TURN)
        return first if self.cycle is self.motion else self._angles.anchored(_between(self.motion, a, b), first)

    def angle_of(self, a: str, b: str, near: float | None) -> Floats:
        """The same; without ``near`` as the motion has it."""
        if near is None:
            return self.output(Output("angle", b))[0]
        return self.angle_between(a, b, near)

    def _lap(self, positions: Positions) -> tuple[float, float] | None:
        """Period of a closed cycle, s, and what the input goes in it."""
        if positions.period is None:
            return None
        begin = float(positions.time[0])
        return positions.period, self._law.at(begin + positions.period) - self._law.at(begin)

    @property
    def _law(self) -> Law:
        """Of the first driver."""
        return next(iter(self.mechanism.drivers.values())).law


def _between(motion: Motion, a: str, b: str) -> Floats:
    return motion.link(b).angle - motion.link(a).angle
