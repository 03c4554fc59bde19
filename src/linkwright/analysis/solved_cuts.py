"""Times at which the signals of a full cycle jump or have kinks, from the motion and the forces that are solved
again."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial

import numpy as np

from linkwright.analysis.solved_again import Resolver
from linkwright.applied_loads.base import Load
from linkwright.applied_loads.over_cycle import switch_times
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.events.course import Course, Stretches
from linkwright.events.events import events
from linkwright.events.limit_positions import NO_NUMBERS, ONE, bend_times, one_span
from linkwright.events.solved_again import OfTimes
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, joint_rate, moving_rate
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.solver import signed_name

#: Share of the cycle over which slopes of signals are taken.
NEARBY = 1e-9
#: Stretches in which it is looked when a load acts whose phase is not known beforehand.
LOOKS = 24


class SolvedCuts:
    """The cuts of a cycle of a motion, and of its forces if they were solved: ``stretches`` lie between them."""

    def __init__(self, motion: Motion, forces: Forces | None, resolver: Resolver) -> None:
        self._motion, self._resolver = motion, resolver
        self.course = Course.of(motion.mechanism, motion.positions, seam=True)
        self.stretches = self._between(bend_times(motion))
        if forces is not None:
            self.stretches = self._between(self.stretches.begin, *self._switches(forces))
            if names := tuple(map(signed_name, forces.solver.programs.signed)):
                corners = self._changes(partial(self._signed, names), len(names))
                self.stretches = self._between(self.stretches.begin, corners)

    def _between(self, *times: Floats) -> Stretches:
        found, course = np.concatenate(times), self.course
        gone = np.inf if course.closed else course.duration
        inside = (found - course.begin < gone) & ((found > course.begin) | course.closed)
        return Stretches(one_span(self.course), [], found[inside])

    def _switches(self, forces: Forces) -> Iterator[Floats]:
        """Times at which a load begins or ends to act, its table bends, or a velocity that it or friction opposes
        reverses."""
        mechanism, signals = self._motion.mechanism, MotionSignals(self._motion)
        turning: list[FrictionTerm | RelativeAngle] = [*forces.solver.friction.terms]
        for load in mechanism.loads.values():
            known, complete = switch_times(load, signals)
            yield known
            if not complete:
                looks = self.course.begin + self.course.duration * np.linspace(0.0, 1.0, LOOKS + 1)
                yield self._changes(partial(self._acts, load), 1, known, looks)
            reversing = load.reverses(mechanism)
            if isinstance(reversing, Output):
                yield np.array([each.time for each in signals.limits(reversing)])
            elif reversing is not None:
                turning.append(reversing)
        if turning := [each for each in turning if moving_rate(self._motion, each).any()]:
            yield self._changes(partial(self._rates, turning), len(turning))

    def _changes(self, values: Callable[[Floats], Floats], count: int, *more: Floats) -> Floats:
        """Times at which signals change their signs, cut at those that are known, and at ``more``."""
        signals = OfTimes(values, count, NEARBY * self.course.duration)
        found = events(signals, NO_NUMBERS, ONE, self._between(self.stretches.begin, *more))
        return np.concatenate([each.time for each in found])

    def _acts(self, load: Load, time: Floats) -> Floats:
        """1 where a load acts, else -1."""
        return np.where(self._resolver.active(load, time), 1.0, -1.0)[None]

    def _rates(self, turning: Iterable[FrictionTerm | RelativeAngle], time: Floats) -> Floats:
        solved = self._resolver.motion(time)
        return np.stack([joint_rate(solved, each) for each in turning])

    def _signed(self, names: tuple[str, ...], time: Floats) -> Floats:
        """Forces with whose sizes others go."""
        solved: Forces = self._resolver.at(time, "forces")
        values = solved.evaluate(names)
        return np.where(np.abs(values) <= 10.0 * solved.roundings, 0.0, values)
