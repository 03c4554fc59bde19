"""Limit positions: where an output reverses, to machine precision in the input.

Sign changes of the exact rate bracket the limits; Newton's steps with the exact acceleration as derivative,
kept inside their brackets, refine all of them at once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from linkwright.errors import LinkwrightError
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.kinematics.cycle import Floats, Positions, at_times
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical, find_point
from linkwright.model.mechanism import Mechanism
from linkwright.model.signal_fields import Output, resolve_output
from linkwright.registry import nearest

Indices = NDArray[np.intp]

#: Rates below this share of the largest one, or of the whole mechanism's, are rounding errors of zero.
STILL = 1e-12
CONSTANT = 1e-10
#: A Newton step of this share of the distance between two positions ends the refinement.
FINE = 1e-13


@dataclass(frozen=True)
class LimitPosition:
    """A reversal of an output.

    ``input``: the first driver's coordinate (rad or m); ``time`` s; ``value`` of the output (rad or m); ``kind``
    ``max`` or ``min`` (a reversal from growing to falling as time goes on, or the other way); ``index``: the
    last position of the motion before it, or at it.
    """

    input: float
    time: float
    value: float
    kind: Literal["max", "min"]
    index: int


def limit_positions(motion: Motion, output: Output | str) -> tuple[LimitPosition, ...]:
    """All positions within a motion where an output's rate is zero and changes its sign, in order of the motion.

    Exact to rounding in the input, independent of the steps, as long as at most two reversals lie between two
    neighbouring positions. In a closed cycle the way from the last position to the first counts as well; the
    ends of an open one are no limits, nor is a rate that touches zero without changing its sign. Of a rest
    over several positions between opposite motions the middle is given.

    Args:
        motion: positions along the drivers' laws, such as a cycle.
        output: an output, or its text: ``jaw`` (angle of a link), ``C.x``, ``jaw.D.y``, ``guide`` (displacement).

    Raises:
        LinkwrightError: there is no such output, or the positions do not follow the drivers' laws in time.
    """
    found = output_of(motion.mechanism, output) if isinstance(output, str) else output
    if motion.steps < 3 or not motion.mechanism.drivers:
        return ()
    return _Search(motion, found).limits()


def output_of(mechanism: Mechanism, text: str) -> Output:
    """The output that a text means. Raises LinkwrightError, with the nearest one, where it means none."""
    links = {name: link.points for name, link in mechanism.links.items()}
    joints = {name: joint.kind for name, joint in mechanism.joints.items()}
    found = resolve_output(text, links, joints)
    if found is not None:
        return found
    guides = [name for name, joint in mechanism.joints.items() if isinstance(joint, PrismaticJoint)]
    points = [f"{point}.{axis}" for link in links.values() for point in link for axis in "xy"]
    offer = nearest(text, [*links, *guides, *dict.fromkeys(points)])
    hint = f"; did you mean {offer!r}?" if offer else ""
    raise LinkwrightError(
        f"there is no output {text!r}; name a link (its angle), POINT.x, POINT.y or a guide (its displacement)"
        f"{hint}"
    )


class Between:
    """A motion evaluated at times between its positions, in the same assembly."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        nominal = at_times(motion.mechanism, motion.time)
        for name, (q, *_) in motion.positions.coordinates.items():
            if not np.allclose(q, nominal.coordinates[name][0], rtol=1e-9, atol=1e-12):
                raise LinkwrightError(
                    f"the positions of this motion do not follow the law of driver {name!r} in time, so there is no "
                    "way between them; find limit positions in a motion over a cycle or at times"
                )

    def evaluate(self, names: tuple[str, ...], before: Indices, time: Floats) -> Floats:
        """Outputs of the program (names, m) at times a little after the positions ``before``; NaN off reach."""
        motion = self.motion
        positions = at_times(motion.mechanism, time)
        modes = {name: row[before] for name, row in motion.modes.items()}
        values = motion.solver.evaluate(
            (*names, "outcome"), positions, self._states(positions, before), modes, motion.design
        )
        values[:-1, values[-1] != 0] = np.nan
        return np.asarray(values[:-1])

    def _states(self, positions: Positions, before: Indices) -> dict[str, Floats]:
        if not self.motion.states:
            return {}
        found = {name: np.empty(positions.count) for name in self.motion.states}
        for k, index in enumerate(before):
            moved = self._moved(int(index), float(positions.time[k]))
            for name in found:
                found[name][k] = moved[name]
        return found

    def _moved(self, index: int, time: float) -> dict[str, float]:
        """States of groups without closed form, from a position to a time near it."""
        follower = self._follower
        state = [float(self.motion.states[name][index]) for name in follower.names]
        way = at_times(self.motion.mechanism, [float(self.motion.time[index]), time])
        reached = follower.step(way, 0, 1, state)
        return dict(zip(follower.names, reached or [np.nan] * len(state), strict=True))

    @cached_property
    def _follower(self) -> Follower:
        motion = self.motion
        return Follower(
            motion.mechanism, motion.structure, motion.solver.assembly, motion.design.parameters
        )


@dataclass
class Brackets:
    """Stretches after the positions ``before``, from ``low`` to ``high`` (shares of ``span`` s), with their rates."""

    before: Indices
    span: Floats
    low: Floats
    high: Floats
    rate_low: Floats
    rate_high: Floats
