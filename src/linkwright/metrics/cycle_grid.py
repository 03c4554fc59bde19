"""A cycle solved once at Gauss points, from which every integral and extreme is read."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.cached_property import cached_property
from linkwright.core.outputs import Output, RelativeAngle, kind_of
from linkwright.core.piecewise import (
    POINTS,
    SMOOTH,
    TO_ENDS,
    WEIGHTS,
    Extreme,
    Piecewise,
    edges_between,
    increasing,
    joined,
    misses,
    nodes,
    sought,
)
from linkwright.core.search import ends, zeros
from linkwright.engine.recently_made import Recent
from linkwright.errors import LinkwrightError
from linkwright.kinematics.bends import bend_times, stretches, with_leaps
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.friction import FrictionTerm, joint_rate, moving_rate
from linkwright.kinetostatics.programs import signed_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.base import Load
from linkwright.loads.over_cycle import activity, switch_times
from linkwright.loads.strokes import NEAR
from linkwright.metrics.one_sided_limits import between, limit, sides
from linkwright.metrics.solved_again import Resolver

#: Pieces of one cycle before the places where something jumps or bends are cut out.
PIECES = 24
#: Halvings of pieces that polynomials do not meet.
HALVINGS = 24
#: Stored outputs whose sizes are compared: places, rates, second derivatives, forces and moments.
_ALIKE = {
    **dict.fromkeys(("position", "direction", "displacement"), "place"),
    **dict.fromkeys(("velocity", "angular_velocity", "slide_velocity"), "rate"),
    **dict.fromkeys(("acceleration", "angular_acceleration", "slide_acceleration"), "second"),
    **dict.fromkeys(("reaction", "couple", "effort"), "force"),
}
#: A piece around a change point reaches this share of the cycle to both sides. Nearer to it than the innermost Gauss
#: points no position is asked for: places are exact to the machine's digits over the distance, second derivatives to
#: these over its cube. To this share polynomials meet what is smooth there.
AROUND, PASSED = 1.0 / 36.0, 1e-8
#: What is left of this share of a signal's size, and more, is no noise. More rough pieces than this are noise.
_LOUDEST = 1e-4
_NOISE = 96
#: Share of the largest value up to which another is rounding, share of a bracket over which its slope is taken, and
#: the most changes of sign of what is no rounding.
_NOTHING, _BESIDE, _MOST = 1e-11, 1e-6, 24
#: The same share where formulas meet, of which each has digits of its own.
_NEAR_EDGES = 1e-9
_NONE: Floats = np.empty(0)


class CycleGrid:
    """Motion, and forces if they were solved, at the Gauss points of pieces between ``start`` and ``end``, s.

    ``asked``: outputs that will be wanted beside those that are stored. Edges lie where loads begin or end to act;
    pieces that still are not smooth are halved. Change points lie in the middle of pieces that are not.
    """

    def __init__(
        self,
        resolver: Resolver,
        motion: Motion,
        forces: Forces | None,
        span: tuple[float, float],
        asked: tuple[str, ...],
    ) -> None:
        self.resolver, self._motion, self._forces = resolver, motion, forces
        (self.start, self.end), self._asked = span, asked
        self._curves: Recent[Callable[[Any], Floats], Piecewise] = Recent(8)

    @cached_property
    def motion(self) -> Motion:
        """The motion at the Gauss points."""
        solved = self._solved[1]
        return solved.motion if isinstance(solved, Forces) else solved

    @property
    def forces(self) -> Forces:
        """The forces at the Gauss points."""
        solved = self._solved[1]
        assert isinstance(solved, Forces)
        return solved

    @property
    def edges(self) -> Floats:
        """Ends of the pieces, s."""
        return self._solved[0]

    @cached_property
    def _meeting(self) -> Flags:
        """At which inner edges nothing jumps or bends."""
        return joined(self.edges, self._solved[3])

    def met(self, values: Floats, sizes: Floats | float) -> Flags:
        """Whether polynomials meet signals (..., pieces, POINTS) of some ``sizes`` (...) everywhere."""
        return np.asarray(misses(values, self._meeting).max(axis=-1) <= self.tolerance * sizes)

    @property
    def tolerance(self) -> float:
        """Share of a signal's size to which polynomials meet it."""
        return max(SMOOTH, 8.0 * self._solved[2], PASSED if len(self.around) else 0.0)

    @cached_property
    def around(self) -> Floats:
        """Ends of the pieces around change points, s, (changes, 2)."""
        length, changes = self.end - self.start, self.resolver.changes
        if not len(changes):
            return np.empty((0, 2))
        if self._motion.positions.closed:
            changes = np.concatenate([changes - length, changes, changes + length])
        changes = np.sort(changes)
        apart = np.minimum(np.diff(changes, prepend=-np.inf), np.diff(changes, append=np.inf))
        way = np.minimum(AROUND * length, 0.5 * apart)
        ends = np.clip(np.stack([changes - way, changes + way], axis=1), self.start, self.end)
        return np.asarray(ends[ends[:, 1] > ends[:, 0]])

    def _first_edges(self, knots: Floats) -> Floats:
        """Those of the first pieces."""
        edges = with_leaps(self._motion, edges_between(self.start, self.end, PIECES, _NONE))
        for low, high in self.around:
            edges = edges[(edges <= low) | (edges >= high)]
        edges = edges[(np.abs(edges[:, None] - knots) > self._near).all(axis=1)]
        return increasing(np.concatenate([edges, self.around.ravel(), knots]))

    def _apart(self, places: Floats) -> Floats:
        """Times within the cycle in order. Such as coincide are one: between them a load of a phase that ends would
        act beside one of a phase that has not begun."""
        near = self._near
        inner = np.sort(places[(places > self.start + near) & (places < self.end - near)])
        return inner[np.diff(inner, prepend=self.start) > near]

    @property
    def _near(self) -> float:
        return 2.0 * NEAR * (self.end - self.start)

    def _passing(self, edges: Floats) -> Flags:
        """Which pieces belong to change points."""
        middle = 0.5 * (edges[:-1] + edges[1:])
        low, high = self.around.T[:, :, None]
        return np.asarray(((middle > low) & (middle < high)).any(axis=0))

    def curve(self, signal: Callable[[Any], Floats], of: str, *, halve: bool = False) -> Piecewise:
        """A signal of the motion, or of the forces, over the time; ``halve``: where it kinks of itself, too."""
        return self._curves.get(signal, (of, halve), lambda: self._curve(signal, of, halve))

    def _curve(self, signal: Callable[[Any], Floats], of: str, halve: bool) -> Piecewise:
        values = np.asarray(signal(self.forces if of == "forces" else self.motion), dtype=float)
        pieces, tolerance = values.reshape(-1, POINTS), self.tolerance
        found = Piecewise(self.edges, pieces, tolerance=tolerance)
        if not halve or self.met(pieces, float(np.abs(values).max(initial=0.0))):
            return found
        return Piecewise(self.edges, pieces, self.function(signal, of), self._solved[3], tolerance)

    def means(self, values: Floats, sizes: Floats) -> tuple[Floats, Flags]:
        """Means over the time of signals (k, pieces, POINTS), and which of them polynomials meet everywhere.

        ``sizes``: the largest of their sizes, (k,)."""
        mean = 0.5 * (values @ WEIGHTS) @ np.diff(self.edges) / (self.end - self.start)
        return mean, self.met(values, sizes)

    def extremes_between(
        self, kind: str, wanted: Sequence[tuple[Callable[[Any], Floats], tuple[float, float]]], of: str
    ) -> list[Extreme]:
        """The largest or smallest values of signals between pairs of times, the second perhaps in the next cycle."""
        period, found = self.end - self.start, []
        for signal, span in wanted:
            curve, function = self.curve(signal, of), self.function(signal, of)
            whole = curve if span[1] <= self.end else _twice(curve, period)
            part = whole.part(*span)
            for k, outer in ((0, part.edges[:2]), (-1, part.edges[-2:])):
                if not whole.smooth[np.searchsorted(whole.edges, outer.mean()) - 1]:
                    part.values[k] = function(nodes(outer)[0])
            found.append(sought(part, kind, function))
        return [
            each if each.place <= self.end else replace(each, place=each.place - period) for each in found
        ]

    def function(self, signal: Callable[[Any], Floats], of: str) -> Callable[[Floats], Floats]:
        """A signal at any times of the cycle, (n,); around change points as the polynomials on both sides of them."""

        def solved(time: Floats) -> Floats:
            return np.asarray(signal(self.resolver.at(time, of)), dtype=float)

        known = self._around_changes(signal, of)
        if not known:
            return solved

        def found(time: Floats) -> Floats:
            values, rest = np.full(len(time), np.nan), np.ones(len(time), dtype=bool)
            for (low, high), row in known:
                near = (time > low) & (time < high)
                values[near] = between(row, (2.0 * time[near] - low - high) / (high - low))
                rest &= ~near
            if rest.any():
                values[rest] = solved(time[rest])
            return values

        return found

    def _around_changes(self, signal: Callable[[Any], Floats], of: str) -> list[tuple[Floats, Floats]]:
        """Ends of the whole pieces around change points, with the signal (POINTS,) in them."""
        if not len(self.around):
            return []
        values = np.asarray(signal(self.forces if of == "forces" else self.motion), dtype=float)
        pieces = values.reshape(-1, POINTS)
        firsts = np.searchsorted(self.edges, self.around[:, 0])
        return [
            (ends, pieces[k])
            for ends, k in zip(self.around, firsts, strict=True)
            if k < len(pieces) and self.edges[k + 1] == ends[1] and self._centred(ends)
        ]

    def _centred(self, ends: Floats) -> bool:
        """Whether a change point lies in the middle, not near the end of the cycle."""
        middle, changes = 0.5 * float(ends[0] + ends[1]), self.resolver.changes
        return bool((np.abs(changes - middle) < 1e-9 * (self.end - self.start)).any())

    def limits_at_changes(self, signal: Callable[[Any], Floats], of: str) -> list[tuple[float, float, float]]:
        """Times of change points, s, with the limits of a signal before and after each."""
        found = []
        for rim, values in self._around_changes(signal, of):
            before, after = sides(values)
            found.append((0.5 * float(rim[0] + rim[1]), limit(before), limit(after)))
        return found

    @cached_property
    def _solved(self) -> tuple[Floats, Motion | Forces, float, Floats]:
        """Edges, the result at all Gauss points between them, the noise in it, and at which edges something may jump
        or bend.

        What halving does not make smoother is noise: as share of the size of an output, that of positions which are
        found by iteration, or near a singular one. A jump stays in one of both halves.
        """
        knots = self._apart(self._switches())
        edges = self._first_edges(knots)
        solved = self._at(edges)
        if len(corners := self._corners(edges, solved)):
            knots = self._apart(np.append(knots, corners))
            edges = self._first_edges(knots)
            solved = self._at(edges)
        knots = np.append(knots, self.around)
        before, many = np.inf, 0
        for _ in range(HALVINGS):
            tail = self._tails(solved, joined(edges, knots))
            rough = (tail > SMOOTH) & (np.diff(edges) > 1e-12 * (self.end - self.start))
            rough &= ~self._passing(edges)
            level = float(np.median(tail[rough])) if rough.any() else 0.0
            if not 0 < rough.sum() <= _NOISE or (level > 0.25 * before and rough.sum() > many):
                break
            before, many = level, int(rough.sum())
            edges = np.sort(np.append(edges, 0.5 * (edges[:-1] + edges[1:])[rough]))
            solved = self._at(edges)
        if len(edges) > 2 and (tail > SMOOTH).mean() > 0.5:
            tail = self._tails(solved, np.zeros(len(edges) - 2, dtype=bool))  # gaps are no noise
        noise = float(np.quantile(tail, 0.9)) if len(edges) > 2 and (tail > SMOOTH).mean() > 0.5 else 0.0
        return edges, solved, noise if noise < _LOUDEST else 0.0, knots

    def _at(self, edges: Floats) -> Any:
        """The result at the Gauss points between edges."""
        of = "motion" if self._forces is None else "forces"
        return self.resolver.at(nodes(edges).ravel(), of, self._asked)

    def _tails(self, solved: Any, meeting: Flags) -> Floats:
        """How far polynomials are from meeting any stored output, (pieces,), as share of the outputs alike."""
        found, all_rows = np.zeros(len(meeting) + 1), [solved.rows]
        if self._forces and solved.motion.rows is not solved.rows:
            all_rows.append(solved.motion.rows)
        for rows in all_rows:
            last = misses(rows.values.reshape(len(rows.values), -1, POINTS), meeting)
            sizes = np.abs(rows.values).max(axis=1)
            for places in _alike.get(rows.index, None, partial(_places_of, rows.index)):
                found = np.maximum(found, last[places].max(axis=0) / (float(sizes[places].max()) or 1.0))
        return found

    # places where loads jump ------------------------------------------------------------------------
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

    def _corners(self, edges: Floats, solved: Motion | Forces) -> Floats:
        """Times at which forces are zero with whose sizes others go."""
        if isinstance(solved, Motion) or not solved.solver.programs.signed:
            return _NONE
        names = tuple(map(signed_name, solved.solver.programs.signed))
        inside, between = solved.evaluate(names).reshape(len(names), -1, POINTS), nodes(edges)
        ends = inside @ TO_ENDS
        known = np.dstack([ends[..., :1], inside, ends[..., 1:]]).reshape(len(names), -1)
        known[np.abs(known) <= 10.0 * solved.rounding] = 0.0
        places = np.column_stack([edges[:-1], between, edges[1:]]).ravel()
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


def _places_of(index: Mapping[str, int]) -> list[list[int]]:
    """The rows of outputs whose sizes are compared, by their sorts."""
    found: dict[str, list[int]] = {}
    for name, place in index.items():
        if sort := _ALIKE.get(kind_of(name)):
            found.setdefault(sort, []).append(place)
    return list(found.values())


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


_alike: Recent[Mapping[str, int], list[list[int]]] = Recent(64)


def _twice(curve: Piecewise, period: float) -> Piecewise:
    """Two cycles of a curve."""
    edges = np.append(curve.edges, curve.edges[1:] + period)
    return Piecewise(edges, np.concatenate([curve.values, curve.values]), tolerance=curve.tolerance)


def cycle_grid(
    resolver: Resolver, motion: Motion, forces: Forces | None, asked: tuple[str, ...]
) -> CycleGrid | None:
    """The grid of a motion all of whose positions are reached, and between which others can be solved; else None."""
    if not resolver.possible or motion.steps < 3 or not resolver.whole:
        return None
    start, end = sorted(motion.positions.around[[0, -1]].tolist())
    grid = CycleGrid(resolver, motion, forces, (start, end), asked)
    try:
        return grid if grid.motion.ok.all() else None
    except LinkwrightError:
        return None
