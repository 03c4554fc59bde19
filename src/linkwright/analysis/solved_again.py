"""A motion and its forces solved again at other times or in more positions, and the times of jumps and kinks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property, partial
from math import ceil
from typing import Any

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.over_cycle import activity, switch_times
from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.errors import LinkwrightError
from linkwright.events.course import Course, Stretches
from linkwright.events.events import events
from linkwright.events.limit_positions import NO_NUMBERS, ONE, bend_times, one_span
from linkwright.events.solved_again import OfTimes
from linkwright.kinematics.between_positions import Between, Reach
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, joint_rate, moving_rate
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.kinetostatics.solver import signed_name

#: Shares of the cycle at which the forces of an extreme are looked at: at a jump they are those of one side.
NEARBY = np.array([0.0, -1e-9, 1e-9])
#: Steps of a cycle from which its numbers are read.
FEWEST = 24


def in_enough_positions(motion: Motion, forces: Forces | None) -> tuple[Motion, Forces | None]:
    """A motion and its forces; of a cycle in so few positions that much can lie between them, in more."""
    from linkwright.kinetostatics.run import run_forces

    positions = motion.positions
    if not (motion.by_law and positions.cycle and positions.steps < FEWEST and motion.inputs):
        return motion, forces
    steps = positions.steps * ceil(FEWEST / positions.steps)
    over = over_cycle(motion.mechanism, steps, endpoint=positions.repeated)
    closer = MotionRun(MotionSolver(motion.mechanism), over).solve("mark")
    return closer, forces and run_forces(closer, forces.static)


class _SameCycle(MotionSignals):
    """Signals of a motion within a cycle that is known."""

    def __init__(self, motion: Motion, known: MotionSignals) -> None:
        super().__init__(motion)
        self._known = known

    @property
    def cycle(self) -> Motion:
        return self._known.cycle

    @property
    def turned(self) -> Motion:
        return self._known.turned


class Resolver(Reach):
    """Solves the design of a motion at further times, with the programs that are there already."""

    def __init__(self, motion: Motion, forces: Forces | None) -> None:
        super().__init__(motion, _between(motion))
        self._forces = forces

    @property
    def possible(self) -> bool:
        """Whether the positions are those of the drivers' laws at their times, so that others lie between them."""
        return self._between is not None

    @property
    def closes(self) -> bool:
        """Whether the first position comes after the last one, in the same assembly."""
        return self._between is not None and self._between.closes

    def at(self, time: Floats, of: str = "motion", asked: tuple[str, ...] = ()) -> Any:
        """Motion, or Forces with ``of="forces"``, at some times, s; ``asked``: outputs besides the stored ones."""
        if of != "forces":
            return self.motion(time)
        return self.forces(self.motion(time), asked)

    def forces_at(
        self, wanted: Sequence[tuple[Callable[[Forces], Floats], float, float]]
    ) -> tuple[Forces, list[int]]:
        """Forces where signals of them have values, and the position of each: at a jump that on its side.

        ``wanted``: signals of the forces, each with a time, s, and its value there.
        """
        times = np.array([time for _, time, _ in wanted])[:, None] + self._motion.time.max() * NEARBY
        forces = self.at(times.ravel(), "forces")
        off = [np.abs(signal(forces) - value).reshape(times.shape) for signal, _, value in wanted]
        return forces, [k * NEARBY.size + int(each[k].argmin()) for k, each in enumerate(off)]

    def motion(self, time: Floats) -> Motion:
        """Motion at some times; positions out of reach are NaN, also those that could be assembled behind a gap."""
        return self.solved(time, None if self.complete else self.reached(time))

    def forces(self, motion: Motion, asked: tuple[str, ...] = ()) -> Forces:
        """Forces of such a motion; ``asked``: outputs besides the stored ones."""
        from linkwright.kinetostatics.run import run_forces

        known = self._forces
        assert known is not None
        return run_forces(motion, known.static, known.solver, _SameCycle(motion, self._signals), asked)

    def active(self, load: Load, time: Floats) -> Flags:
        """Whether a load acts at some times, (n,)."""
        return activity(load, _SameCycle(self.motion(time), self._signals)).where

    @cached_property
    def _signals(self) -> MotionSignals:
        return MotionSignals(self._motion)

    def input_at(self, time: float) -> float:
        """Coordinate of the first driver at a time."""
        name, driver = next(iter(self._motion.mechanism.drivers.items()))
        try:
            return driver.law.at(time)
        except LinkwrightError:
            if self._between is None:
                raise
            return float(self._between.positions(np.array([time])).coordinates[name][0][0])


def _between(motion: Motion) -> Between | None:
    if not (motion.by_law and motion.mechanism.drivers):
        return None
    try:
        return Between(motion)
    except LinkwrightError:
        return None


#: Share of the cycle over which slopes of signals are taken.
NEAR_CUT = 1e-9
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
        signals = OfTimes(values, count, NEAR_CUT * self.course.duration)
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
