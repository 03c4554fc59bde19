"""Angles at the positions of a motion, with their turns counted over the mechanism's cycle."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import CycleError, Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.mechanism.mechanism import Mechanism

#: Steps of the cycle that anchors angles and brackets limit positions.
STEPS = 360
TURN = 2 * np.pi


class CycleAngles:
    """Angles refer to the mechanism's cycle, so they do not depend on which positions are asked."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion

    @cached_property
    def cycle(self) -> Motion:
        """The motion over the mechanism's cycle; the motion itself where no cycle is known."""
        positions = self.motion.positions
        if (positions.closed or positions.cycle) and self.motion.steps >= STEPS:
            return self.motion
        found = self.over(self.motion.mechanism)
        return self.motion if found is None else found

    def over(self, mechanism: Mechanism) -> Motion | None:
        """The motion of a mechanism of the same assembly over its cycle; None where no cycle is known."""
        try:
            positions: Positions = over_cycle(mechanism, STEPS)
        except CycleError:
            return None
        return MotionRun(self.motion.solver.for_design(self.motion.design), positions).solve("mark")

    def of(self, link: str) -> Floats:
        """The angle of a link, (n,) rad."""
        angle = self.motion.link(link).angle
        return angle if self.cycle is self.motion else self.anchored(angle, self.cycle.link(link).angle)

    def anchored(self, angle: Floats, on_cycle: Floats) -> Floats:
        """The same angle, moved by full turns next to what it is at that time of the cycle, of which a part may not
        be reached."""
        positions = self.cycle.positions
        time, values, laps, gain = positions.time, on_cycle, np.zeros(len(angle)), 0.0
        if positions.period is not None:
            gain = TURN * float(np.nan_to_num(np.round((values[-1] - values[0]) / TURN)))
            time, values = np.append(time, time[0] + positions.period), np.append(values, values[0] + gain)
            laps = np.floor((self.motion.time - time[0]) / positions.period)
        order = np.argsort(time)
        order = order[np.isfinite(values[order])]
        if not len(order):
            return angle
        there = np.interp(self.motion.time - laps * (positions.period or 0.0), time[order], values[order])
        return np.asarray(angle + TURN * np.round((there + laps * gain - angle) / TURN))
