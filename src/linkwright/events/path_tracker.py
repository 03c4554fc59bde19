"""Paths of groups without closed form tracked over a course, of many designs at once, and states read from them.

Every design goes its own way in equal steps (:mod:`linkwright.events.tracked_groups`); doubt halves those of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import pi

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import HIGH, LOW, Columns
from linkwright.events.course import Course
from linkwright.events.formula import ROW, Formula, Known
from linkwright.events.tracked_groups import DEGREE, FIT, Paths, PathStep, Place, path_states, stays_on_path
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.threads import spread_over
from linkwright.formula.trace import Mask, Trace
from linkwright.kinematics.branch import ROOM, ROUNDING, misfit, quintic
from linkwright.kinematics.groups import CONVERGED
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.mechanism.mechanism import Mechanism

#: Steps of a path in a turn; how many parts those are cut into whose quintics do not fit, one number after the other.
STEPS, FINER = 24, (4, 16, 64)
#: Places of a cycle's pieces for each of its steps: what is worth machine code there is worth it here.
PLACES = 8
#: The smallest share of a step that is tried; a small one, up to which the rule of steps leaves room, as where a
#: cam's rise begins behind a dwell; the doubt below which steps grow.
SMALLEST, SMALL, GROWS = 2.0**-22, 2.0**-10, 0.1
#: How near a group comes back to its first assembly in a closed cycle, rad or share of the size.
SAME = 1e-6
#: On the way from the machine as it is to another design: largest change of a coordinate in one step, one that is
#: small enough by itself, largest distance from what is expected as share of others, smallest share of the way.
LARGEST_CHANGE, SMALL_CHANGE, EXPECTED, SMALLEST_SHARE = 0.15, 0.02, 0.1, 1.0 / 4096


class PathTracker:
    """Tracks the designs of one machine: ``known``: its numbers, also of the dimensions that vary; ``start``: its
    states at the beginning of the ``course``."""

    def __init__(self, step: PathStep, course: Course, known: Known, start: Mapping[str, Floats]) -> None:
        self.step, self.course, self.known, self.scale = step, course, known, step.scale
        self.varied = {name: known.numbers[name] for name in step.varied}
        first = np.array([each.value(start) for each in step.coordinates])
        numbers = {name: np.array([number]) for name, number in self.varied.items()}
        there = step.place(known, numbers, np.array([course.begin]), _at_rest(first[:, None]))
        self._first, self.signs = there.values[0], there.signs

    @property
    def signs_by_group(self) -> dict[str, float]:
        """Signs of the determinants of the groups, the same ones along all paths."""
        return dict(zip(self.step.groups, self.signs[:, 0].tolist(), strict=True))

    def same_signs(self, there: Place) -> Flags:
        """Whether no determinant has another sign than in the machine as it is, (designs,)."""
        return np.asarray((there.signs == self.signs).all(axis=0))

    # the way to a design -------------------------------------------------------------------------------
    def _approached(self, known: Known, designs: Columns, begin: Floats) -> Floats:
        """Coordinates with three derivatives, (4, n, designs), at the beginning: on a straight way in the dimensions
        from the machine as it is; NaN where the assembly is doubtful."""
        count = len(begin)
        x, slope = np.repeat(self._first, count, axis=1), np.zeros((len(self.scale), count))
        done, share, lanes = np.zeros(count), np.ones(count), np.arange(count)
        while len(lanes):
            ahead = np.minimum(done[lanes] + share[lanes], 1.0)
            now = {name: first + ahead * (designs[name][lanes] - first) for name, first in self.varied.items()}
            here, gone = x[:, lanes], ahead - done[lanes]
            near = here + slope[:, lanes] * gone
            there = self.step.place(known, now, begin[lanes], _at_rest(near))
            found = there.values[0]
            with np.errstate(invalid="ignore"):
                change, off = ((np.abs(found - each) / self.scale).max(axis=0) for each in (here, near))
                sure = (change <= SMALL_CHANGE) | ((done[lanes] > 0.0) & (off <= EXPECTED * change))
                sure &= (there.residual < CONVERGED) & (change <= LARGEST_CHANGE) & self.same_signs(there)
            went = lanes[sure]
            slope[:, went] = ((found - here) / gone)[:, sure]
            x[:, went], done[went] = found[:, sure], ahead[sure]
            share[went] *= 2.0
            share[lanes[~sure]] *= 0.5
            lanes = lanes[(done[lanes] < 1.0) & (share[lanes] >= SMALLEST_SHARE)]
        x[:, done < 1.0] = np.nan
        return np.concatenate([self.step.place(known, designs, begin, _at_rest(x)).values, np.zeros((1, *x.shape))])

    # the way over the course ---------------------------------------------------------------------------
    def track(self, designs: Columns, begin: Floats, duration: Floats) -> Paths:
        """The paths of designs, columns (designs,) by name, from ``begin``, s, for a ``duration``, s."""
        steps = STEPS * max(1, int(np.ceil(self.course.laps - 1e-9)))
        designs = {name: designs[name] for name in self.varied}
        known = self.known
        if known.compiles(PLACES * steps * len(begin)):
            known = replace(known, compiled=True)
        first = self._approached(known, designs, begin)
        march = _March(self, known, designs, begin, duration, first, steps)
        series, gaps = march.series()
        reached = march.reached
        parts, rough = [series.reshape(*series.shape[:2], -1)], np.flatnonzero(gaps.ravel() > FIT)
        offset, count, behind = np.arange(gaps.size), np.ones(gaps.size, dtype=np.intp), gaps.size
        for finer in FINER if len(rough) else ():
            row, place = np.divmod(rough, steps)
            length = duration[row] / steps
            start = np.concatenate([march.knots[:, :, row, place], np.zeros((1, len(first[0]), len(row)))])
            part = _March(self, known, _some(designs, row), begin[row] + place * length, length, start, finer)
            series, gaps = part.series()
            parts.append(series.reshape(*series.shape[:2], -1))
            ended = np.flatnonzero(part.at < finer)
            fits = gaps[ended, part.at[ended]] <= FIT  # else it ends at the quintic before
            reach = np.where(fits, part.reached[ended], part.at[ended] / finer)
            reached[row[ended]] = (place[ended] + reach) / steps
            offset[rough], count[rough] = behind + np.arange(len(rough)) * finer, finer
            behind, rough = behind + gaps.size, rough[(gaps > FIT).any(axis=1)]
        rows = np.concatenate(parts, axis=2) if len(parts) > 1 else parts[0]
        change, turning = march.now[0] - first[0], np.array([[each.turns] for each in self.step.coordinates])
        gained = np.where(turning, 2.0 * np.pi * np.round(change / (2.0 * np.pi)), 0.0)
        returns = (np.abs(change - gained) <= SAME * self.scale).all(axis=0) | (not self.course.closed)
        quintics: dict[str, Floats] = {}
        laps: dict[str, Floats] = {}
        for k, each in enumerate(self.step.coordinates):
            quintics |= {each.field(order): rows[order, k] for order in range(DEGREE + 1)}
            if each.turns and len(each.states) == 1:
                laps[each.field(0)] = gained[k]
        ends = self.course.closed, reached, returns, 1.0 - march.most
        return Paths(begin, duration, steps, offset, count, quintics, laps, *ends)


class _March:
    """Designs on their way in equal ``steps``, or parts of these: coordinates with three derivatives ``now``, (4, n,
    designs), shares of the way that are ``reached``, and doubts of the ``most`` doubtful steps, (designs,)."""

    def __init__(
        self,
        tracker: PathTracker,
        known: Known,
        designs: Columns,
        begin: Floats,
        duration: Floats,
        first: Floats,
        steps: int,
    ) -> None:
        self.tracker, self.steps, self.now = tracker, steps, first.copy()
        self.step = step = duration / steps
        count, now = len(begin), self.now
        self.knots = np.full((3, *first.shape[1:], steps + 1), np.nan)
        self.knots[..., 0] = first[:3]
        self.at, self.done, self.most = np.zeros(count, dtype=np.intp), np.zeros(count), np.zeros(count)
        at, done, share = self.at, self.done, np.ones(count)
        lanes = np.flatnonzero(np.isfinite(first).all(axis=(0, 1)))
        while len(lanes):
            every = len(lanes) == count
            before, of = (now.copy(), designs) if every else (now[:, :, lanes], _some(designs, lanes))
            part = np.minimum(share[lanes], 1.0 - done[lanes])
            h, room = part * step[lanes], np.where(part > SMALL, ROUNDING, ROOM)
            time = begin[lanes] + (at[lanes] + done[lanes]) * step[lanes] + h
            there = tracker.step.place(known, of, time, before, h, room)
            sure = np.asarray((there.doubt < 1.0) & tracker.same_signs(there))
            if sure.all():
                went, gone, values, rates, off = lanes, h, there.values, before[2], there.doubt
            else:
                went, gone, off = lanes[sure], h[sure], there.doubt[sure]
                values, rates = there.values[:, :, sure], before[2][:, sure]
                share[lanes[~sure]] = 0.5 * part[~sure]
            now[:3, :, went] = values
            now[3][:, went] = (values[2] - rates) / gone
            self.most[went] = np.maximum(self.most[went], off)
            done[went] += part[sure]
            share[went] = np.where(off < GROWS, np.minimum(2.0 * share[went], 1.0), share[went])
            here = went[done[went] == 1.0]
            done[here], at[here] = 0.0, at[here] + 1
            self.knots[:, :, here, at[here]] = now[:3, :, here]
            lanes = lanes[(at[lanes] < steps) & (share[lanes] >= SMALLEST)]

    @property
    def reached(self) -> Floats:
        """Share of the way."""
        return np.asarray((self.at + self.done) / self.steps)

    def series(self) -> tuple[Floats, Floats]:
        """Coefficients of the quintics on all steps, (6, n, designs, steps), and their misfits (designs, steps)."""
        knots, h = self.knots, np.repeat(self.step[:, None], self.steps, axis=1)
        short = np.flatnonzero(self.done > 0.0)  # designs that end within a step
        knots[:, :, short, self.at[short] + 1] = self.now[:3, :, short]
        h[short, self.at[short]] *= self.done[short]
        p, v, a = knots[0], h * knots[1, ..., :-1], h * h * knots[2, ..., :-1]
        ends = p[..., 1:] - p[..., :-1], v, a, h * knots[1, ..., 1:], h * h * knots[2, ..., 1:]
        gap = np.abs(misfit(*ends)) / self.tracker.scale[:, :, None]
        series = np.stack([p[..., :-1], v, 0.5 * a, *quintic(*ends)])
        for k in range(1, DEGREE + 1):
            series[k][:, short, self.at[short]] /= self.done[short] ** k
        return series, np.asarray(np.fmax.reduce(gap, axis=0, initial=0.0))


def _at_rest(x: Floats) -> Floats:
    """Coordinates (n, designs) without derivatives, (4, n, designs)."""
    return np.concatenate([x[None], np.zeros((3, *x.shape))])


def _some(columns: Mapping[str, Floats], chosen: Indices) -> dict[str, Floats]:
    return {name: each[chosen] for name, each in columns.items()}


#: Designs that are tracked together.
BLOCK = 512


class TrackedStates:
    """States at the positions of a motion, of designs of its mechanism.

    ``solver``: traced with the dimensions that vary free and Newton's steps as formulas on paths have them;
    ``compiled``: see :class:`Known`.
    """

    def __init__(self, nominal: Motion, solver: MotionSolver, compiled: bool | None = None) -> None:
        self.programs, self.motion, positions = solver.programs, solver.motion, nominal.positions
        self.course = Course.of(nominal.mechanism, positions)
        self.known = Known(solver.nominal.parameters, compiled=compiled)
        step = PathStep(self.motion, self.course, solver.manner.free)
        first = int(np.argmin(positions.time))
        start = {name: row[first] for name, row in nominal.states.items()}
        self.tracker = PathTracker(step, self.course, self.known, start)
        self.shares = (positions.time - self.course.begin) / (self.course.duration or 1.0)
        t = Trace()
        self._formula = Formula(Program.of(t, path_states(step.coordinates, t)))

    @property
    def on_path(self) -> Mask:
        """Whether Newton's steps from these states end on the path, as a value of the motion's trace."""
        return stays_on_path(self.motion, self.tracker.signs_by_group)

    def of(self, designs: Mapping[str, Floats], threads: int = 1) -> tuple[dict[str, Floats], Floats]:
        """The states, (designs, positions) by name, NaN where the path of a design does not go; and how far its most
        doubtful step was from being refused, (designs,), 1 far, 0 at the edge."""
        count = len(next(iter(designs.values())))
        found = {name: np.empty((count, len(self.shares))) for name in self._formula.outputs}
        margin = np.empty(count)

        def work(first: int, last: int) -> None:
            some = {name: column[first:last] for name, column in designs.items()}
            self._some(some, {name: rows[first:last] for name, rows in found.items()}, margin[first:last])

        spread_over(count, BLOCK, threads, work)
        return found, margin

    def _some(self, designs: Mapping[str, Floats], into: Mapping[str, Floats], margin: Floats) -> None:
        count = len(margin)
        begin, duration = np.full(count, self.course.begin), np.full(count, self.course.duration)
        speed = designs.get(f"{self.course.first.name}.speed")
        if self.course.turns and speed is not None:
            duration = 2.0 * pi * self.course.turns / np.abs(speed)
        paths = self.tracker.track(designs, begin, duration)
        columns = {ROW: np.arange(float(count)), LOW: begin, HIGH: begin + duration}
        found = self._formula.run(self.known, columns, self.shares, paths.fields(columns, self.shares))
        for name, place in self._formula.place.items():
            into[name][...] = found[:, place].T
        margin[...] = paths.margin


def tracked_states(nominal: Motion, solver: MotionSolver, compiled: bool | None) -> TrackedStates:
    """What tracks the designs of a mechanism over some positions; what was made lately serves again."""
    key = (id(solver.programs), nominal.positions.key, compiled)  # which lives as long as what was made
    return _tracked.get(nominal.mechanism, key, lambda: TrackedStates(nominal, solver, compiled))


_tracked: Recent[Mechanism, TrackedStates] = Recent(8)
