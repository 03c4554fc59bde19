"""Times at which the signals of a whole cycle jump or bend, from the motion and the forces that are solved again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.events.course import Course
from linkwright.events.events import events
from linkwright.events.limit_positions import NO_NUMBERS, ONE, bend_times, one_span
from linkwright.events.solved_again import OfTimes
from linkwright.events.stretches import Stretches
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, joint_rate, moving_rate
from linkwright.kinetostatics.programs import signed_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.over_cycle import switch_times
from linkwright.metrics.solved_again import Resolver

#: Share of the cycle over which slopes of signals are taken.
BESIDE = 1e-9
#: Stretches in which it is looked when a load acts whose phase is not known beforehand.
LOOKS = 24


class SolvedCuts:
    """The cuts of a cycle of a motion, and of its forces if they were solved."""

    def __init__(self, motion: Motion, forces: Forces | None, resolver: Resolver) -> None:
        self._motion, self._forces, self._resolver = motion, forces, resolver
        self.course = Course.of(motion.mechanism, motion.positions, seam=True)
        self._times = bend_times(motion)
        if forces is not None:
            self._add(*self._switches(forces))
            self._add(self._corners(forces))

    @property
    def stretches(self) -> Stretches:
        """What lies between them."""
        return Stretches(one_span(self.course), [], self._times)

    def _add(self, *times: Floats) -> None:
        found = np.concatenate([self._times, *times])
        if self.course.closed:
            found = self.course.begin + (found - self.course.begin) % self.course.duration
        self._times = found[np.isfinite(found)]

    def _switches(self, forces: Forces) -> list[Floats]:
        """Times at which a load begins or ends to act, its table bends, or a velocity that it or friction opposes
        reverses."""
        signals, turning = MotionSignals(self._motion), list[FrictionTerm | RelativeAngle]()
        found = list[Floats]()
        for load in self._motion.mechanism.loads.values():
            known, complete = switch_times(load, signals)
            found.append(known)
            if not complete:
                looks = self.course.begin + self.course.duration * np.linspace(0.0, 1.0, LOOKS + 1)
                acts = lambda time, load=load: np.where(self._resolver.active(load, time), 1.0, -1.0)[None]  # noqa: E731
                found.append(self._changes(acts, 1, known, looks))
            reversing = load.reverses(self._motion.mechanism)
            if isinstance(reversing, Output):
                found.append(np.array([each.time for each in signals.limits(reversing)]))
            elif reversing is not None:
                turning.append(reversing)
        turning = [each for each in [*forces.solver.friction.terms, *turning]
                   if moving_rate(self._motion, each).any()]  # fmt: skip
        if turning:

            def rates(time: Floats) -> Floats:
                solved = self._resolver.motion(time)
                return np.stack([joint_rate(solved, each) for each in turning])

            found.append(self._changes(rates, len(turning)))
        return found

    def _corners(self, forces: Forces) -> Floats:
        """Times at which forces are zero with whose sizes others go."""
        names = tuple(map(signed_name, forces.solver.programs.signed))
        if not names:
            return np.empty(0)

        def signed(time: Floats) -> Floats:
            solved: Forces = self._resolver.at(time, "forces")
            values = solved.evaluate(names)
            return np.where(np.abs(values) <= 10.0 * solved.roundings, 0.0, values)

        return self._changes(signed, len(names))

    def _changes(self, values: Callable[[Floats], Floats], count: int, *more: Floats) -> Floats:
        """Times at which signals change their signs, cut at those that are known, and at ``more``."""
        signals = OfTimes(values, count, BESIDE * self.course.duration)
        stretches = Stretches(one_span(self.course), [], np.concatenate([self._times, *more]))
        return np.concatenate([each.time for each in events(signals, NO_NUMBERS, ONE, stretches)])
