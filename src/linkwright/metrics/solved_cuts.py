"""Times at which the signals of a whole cycle jump or bend, from the motion and the forces that are solved again."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.core.search import ends, zeros
from linkwright.curves.curve import increasing
from linkwright.curves.polynomials import NODES
from linkwright.kinematics.bends import bend_times, stretches
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, joint_rate, moving_rate
from linkwright.kinetostatics.programs import signed_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.base import Load
from linkwright.loads.over_cycle import activity, switch_times
from linkwright.loads.strokes import NEAR
from linkwright.metrics.solved_again import Resolver

#: Share of the largest value up to which another is rounding, share of a bracket over which its slope is taken, and
#: the most changes of sign of what is no rounding.
_NOTHING, _BESIDE, _MOST = 1e-11, 1e-6, 24
#: The same share where formulas meet, of which each has digits of its own.
_NEAR_EDGES = 1e-9
#: Pieces in which forces are looked at whose signs tell how others go on.
PIECES = 24


class SolvedCuts:
    """The cuts of a cycle of a motion, and of its forces if they were solved."""

    def __init__(self, motion: Motion, forces: Forces | None, resolver: Resolver) -> None:
        self._motion, self._forces, self.resolver = motion, forces, resolver
        self.start, self.end = sorted(motion.positions.around[[0, -1]].tolist())

    @property
    def times(self) -> Floats:
        """All of them, s."""
        found = self._switches()
        return np.append(found, self._corners(found)) if self._forces else found

    def _switches(self) -> Floats:
        """Times at which the motion goes over to another formula, a load begins or ends to act, its table bends, or a
        velocity that it or friction opposes reverses.

        A phase that holds a little more than its ends ends there all the same.
        """
        found = [bend_times(self._motion)]
        if self._forces is None:
            return self._wrapped(found)
        signals, turning = MotionSignals(self._motion), list[FrictionTerm | RelativeAngle]()
        for load in self._motion.mechanism.loads.values():
            known, complete = switch_times(load, signals)
            found.append(known)
            if not complete:
                switched = self._bisected(load, signals)
                apart = np.abs(switched[:, None] - known).min(axis=1, initial=np.inf)
                found.append(switched[apart > 2.0 * NEAR * (self.end - self.start)])
            reversing = load.reverses(self._motion.mechanism)
            if isinstance(reversing, Output):
                found.append(np.array([each.time for each in signals.limits(reversing)]))
            elif reversing is not None:
                turning.append(reversing)
        turning = [*self._forces.solver.friction.terms, *turning]
        if turning := [each for each in turning if moving_rate(self._motion, each).any()]:
            found.append(self._reversals(turning))
        return self._wrapped(found)

    def _reversals(self, terms: Iterable[FrictionTerm | RelativeAngle]) -> Floats:
        """Times at which the parts of joints with friction, and links, turn round against each other."""

        def rates(solved: Motion) -> Floats:
            return np.stack([joint_rate(solved, term) for term in terms])

        known, time = rates(self._motion), self._motion.positions.around
        if self._motion.positions.closed:
            known = np.append(known, known[:, :1], axis=1)
        edges = np.zeros(len(time), dtype=np.bool_)
        if parts := stretches(self._motion):
            time, edges = np.append(time, parts.places), np.append(edges, ~parts.inside(parts.places))
            known = np.append(known, rates(self.resolver.motion(parts.places)), axis=1)
        order = np.argsort(time, kind="stable")
        return _changes(
            lambda at: rates(self.resolver.motion(at)), known[:, order], time[order], edges[order]
        )

    def _corners(self, cuts: Floats) -> Floats:
        """Times at which forces are zero with whose sizes others go."""
        assert self._forces is not None
        if not (names := tuple(map(signed_name, self._forces.solver.programs.signed))):
            return np.empty(0)
        edges = np.unique(np.concatenate([np.linspace(self.start, self.end, PIECES + 1), cuts]))
        shares = np.concatenate([[_NEAR_EDGES], NODES, [1.0 - _NEAR_EDGES]])
        places = (edges[:-1, None] + np.diff(edges)[:, None] * shares).ravel()
        solved = self.resolver.at(places, "forces")
        known = solved.evaluate(names)
        known[np.abs(known) <= 10.0 * solved.rounding] = 0.0
        return _changes(lambda at: self.resolver.at(at, "forces").evaluate(names), known, places)

    def _wrapped(self, found: Iterable[Floats]) -> Floats:
        times = np.concatenate([np.empty(0), *found])
        period = self._motion.positions.period
        if period is not None:
            times = self.start + (times - self.start) % period
        return increasing(times[np.isfinite(times)])

    def _bisected(self, load: Load, signals: MotionSignals) -> Floats:
        """Times at which a load begins or ends to act, by halving the steps in which it does."""
        where, time = activity(load, signals).where, self._motion.time
        if signals.closes is not None:
            where, time = np.append(where, where[0]), np.append(time, time[0] + signals.closes[0])
        steps = np.flatnonzero(where[:-1] != where[1:])
        if not len(steps):
            return np.empty(0)
        before = where[steps]
        return ends(lambda at: self.resolver.active(load, at) == before, time[steps], time[steps + 1])


def _changes(
    values: Callable[[Floats], Floats], known: Floats, places: Floats, edges: Flags | None = None
) -> Floats:
    """Where values (k, n), ``known`` at some places (n,), change their signs; none of those that do so too often.
    What is zero at ``edges`` does so there."""
    found: list[tuple[int, int, int]] = []
    there: list[float] = []
    for number, row in enumerate(known):
        nothing = _NOTHING if edges is None else _NEAR_EDGES
        decided = np.flatnonzero(np.abs(row) > nothing * np.abs(row).max())
        before, after = decided[:-1], decided[1:]
        turned = (row[before] * row[after] < 0.0) & (places[before] != places[after])
        if turned.sum() <= _MOST:
            for a, b in zip(before[turned], after[turned], strict=True):
                at = [] if edges is None else places[a + 1 : b][edges[a + 1 : b]].tolist()
                there += at
                found += [] if at else [(number, a, b)]
    if not found:
        return np.array(there)
    rows, low, high = np.array(found).T
    beside = _BESIDE * (places[high] - places[low])

    def function(at: Floats) -> tuple[Floats, Floats]:
        both = values(np.append(at, at + beside))[np.tile(rows, 2), np.arange(2 * len(at))]
        value, following = both.reshape(2, -1)
        return value, (following - value) / beside

    return np.append(zeros(function, places[low], places[high], known[rows, low]), there)
