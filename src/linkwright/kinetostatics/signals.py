"""What the magnitudes of loads may follow, read from a motion or traced with it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.signals import FullCycle, Limit
from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import Output, RelativeAngle, row_name
from linkwright.drivers.base import Law
from linkwright.events.limit_positions import limit_positions
from linkwright.formula.table import Table
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.output_formulas import CycleAngles
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.trace import MotionTrace
from linkwright.kinetostatics.friction import moving_rate
from linkwright.kinetostatics.load_site import TracedSite, constant_name, middle_name
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


#: An angle that covers more than this is one of a link that turns.
TURNING = 1.9 * np.pi


@dataclass(frozen=True)
class AlongInput:
    """Loads whose magnitudes are traced, and what these take.

    ``outputs``: those whose limit positions they need; ``angles``: of which pairs of links (see
    ``Magnitude.angles``); ``constants`` and ``tables`` by name: numbers of the loads that are no dimensions;
    ``fallible``: loads that may have no value for some designs; ``rubbing``: friction of joints is traced as well.
    """

    names: frozenset[str]
    outputs: tuple[Output, ...] = ()
    angles: Mapping[tuple[str, str], float | None] = field(default_factory=dict)
    constants: Mapping[str, float] = field(default_factory=dict)
    tables: Mapping[str, Table] = field(default_factory=dict)
    fallible: tuple[str, ...] = ()
    rubbing: bool = False

    def sizes(self, motion: MotionTrace) -> Scalar:
        """Sum of the magnitudes of the fallible loads: not finite where one has no value."""
        return sum((traced_magnitude(motion, name) for name in self.fallible), 0.0)

    def middles(self, signals: MotionSignals) -> dict[str, float] | None:
        """Angles near which the angles that loads take stay; None where a link turns through."""
        found = {}
        for (a, b), near in self.angles.items():
            angle = signals.angle_of(a, b, near)
            low, high = float(np.nanmin(angle)), float(np.nanmax(angle))
            if not high - low <= TURNING or (near is not None and abs(angle[0] - near) > 0.9 * np.pi):
                return None
            found[middle_name(a, b)] = 0.5 * (low + high)
        return found


def numbers_of_loads(loads: Iterable[Load], mechanism: Mechanism) -> AlongInput:
    """What the magnitudes of loads of a mechanism take."""
    magnitudes = {each.name: each.magnitude for each in loads}
    sizes = magnitudes.values()
    limits = [each.limits for each in sizes if each.limits is not None]
    return AlongInput(
        frozenset(magnitudes),
        tuple(dict.fromkeys(each.output for each in limits)),
        {pair: near for each in sizes for pair, near in each.angles(mechanism).items()},
        {
            constant_name(name, key): value
            for name, each in magnitudes.items()
            for key, value in each.constants.items()
        },
        {row_name("magnitude", name): each.size.curve for name, each in magnitudes.items() if each.size.curve},
        tuple(name for name, each in magnitudes.items() if each.fallible),
    )


def traced_magnitude(motion: MotionTrace, name: str) -> Scalar:
    """The magnitude of a load over the input."""
    return TracedSite(motion, motion.mechanism.loads[name], along_input=True).magnitude()
