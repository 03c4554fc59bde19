"""Positions that a drawing shows: at an input, at a time, and among limit positions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import LimitPosition
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import solve_motion, with_times

At = float | Mapping[str, float]


@dataclass(frozen=True)
class Shown:
    """One position of a motion."""

    motion: Motion
    index: int

    def checked(self) -> Shown:
        """The same; raises LinkwrightError where the position was not reached."""
        if not self.motion.ok[self.index]:
            sentence = self.motion.outcomes[self.index].sentence
            raise LinkwrightError("picture.the_position", sentence=sentence)
        return self


def at_input(motion: Motion, at: At) -> Shown:
    """The position at a coordinate of the first driver, or of drivers by name (rad or m).

    Within the cycle it is the position that the motion passes, in the same assembly.
    """
    given = {name: [value] for name, value in at.items()} if isinstance(at, Mapping) else [at]
    time = at_inputs(motion.mechanism, given).time
    several = isinstance(at, Mapping) and len(at) > 1
    return (None if several else _passed(motion, float(time[0]))) or Shown(
        solve_motion(motion.mechanism, at=given, failures="mark"), 0
    )


def at_time(motion: Motion, time: float) -> Shown:
    """The position at a time, s."""
    return _passed(motion, time) or Shown(solve_motion(motion.mechanism, times=[time], failures="mark"), 0)


def with_limits(motion: Motion, limits: Sequence[LimitPosition]) -> tuple[Motion, list[int]]:
    """The motion with limit positions among its positions, and their indices."""
    return with_times(motion, (each.time for each in sorted(limits, key=lambda each: each.index)))


def _passed(motion: Motion, time: float) -> Shown | None:
    """The position at a time within the motion; None where the motion does not run along a way through it."""
    way = np.diff(motion.time)
    if not len(way) or not (np.all(way > 0) or np.all(way < 0)):
        return None
    forward = 1.0 if way[0] > 0 else -1.0
    since, length = forward * (time - motion.time[0]), abs(float(motion.time[-1] - motion.time[0]))
    if motion.positions.period is not None:
        length = motion.positions.period
        since %= length
    if not -1e-12 <= since <= length * (1.0 + 1e-12):
        return None
    courses = forward * (motion.time - motion.time[0])
    near = int(np.argmin(np.abs(courses - since)))
    if abs(courses[near] - since) <= 1e-9 * length:
        return Shown(motion, near)
    denser, (index,) = with_times(motion, [float(motion.time[0]) + forward * since])
    return Shown(denser, index)
