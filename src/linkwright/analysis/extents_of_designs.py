"""Ranges of motion and swept areas of many designs, with gradients.

A range ends where a group is stretched or folded: there the square under a dyad's root is zero. It is smooth on both
sides, so Newton's steps from the ends of the machine itself find those of its designs, and the implicit function
theorem their derivatives. Swept areas are hulls of the curves of all designs over the same pieces, each one alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from linkwright.analysis.analysis import Analysis
from linkwright.analysis.by_name import chosen_subjects, metric_of
from linkwright.analysis.of_designs import MetricsOfDesigns
from linkwright.analysis.swept_area import of_driver, points, turned
from linkwright.analysis.swept_hull import Curves, SweptHull
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.gradient import Backward
from linkwright.cycle.machine import Machine, NotTogether, Traces
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import Signal
from linkwright.events.course import Course, moves
from linkwright.events.events import AT, at_times
from linkwright.events.formula import Formula, Known
from linkwright.formula.summaries import Backend
from linkwright.formula.threads import cores, spread_over
from linkwright.formula.trace import select
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solve import solve_motion
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinetostatics.solver import force_programs
from linkwright.mechanism.mechanism import Mechanism

#: Newton steps, and the last one's size, rad.
STEPS, CONVERGED = 12, 1e-10
#: How near to an end, rad, positions may lie on either side.
NEAR = 1e-8
#: Share of the cycle's time within which two times are one.
SAME = 1e-12
_FIRST = np.zeros(1, dtype=np.intp)


@dataclass(frozen=True)
class End:
    """When a stretch of the input begins or ends in the machine itself, s, and the group that is stretched or
    folded there; none where the cycle itself ends."""

    time: float
    group: str | None


def ranged(name: str) -> bool:
    """Whether a registered number is the range of motion."""
    found = metric_of(name)
    return found is not None and found[0].input_ranges


def ranges_of_designs(mechanism: Mechanism, varied: Iterable[str], names: Iterable[str]) -> RangesOfDesigns | None:
    """Ranges of motion; None where the machine passes its full cycle, dimensions move the inputs, or not one driver
    turns at constant speed and all groups have closed forms."""
    asked, addresses, drivers = tuple(names), tuple(varied), list(mechanism.drivers.values())
    if len(drivers) != 1 or drivers[0].law.constant_speed is None or not drivers[0].law.rotary:
        return None
    for name in asked:
        chosen_subjects(name, name.partition(" ")[2], mechanism.drivers)
    nominal = solve_motion(mechanism, failures="mark")
    analysis, steps = Analysis.of(nominal), nominal.positions.steps
    if nominal.solver.motion.next_states or nominal.modes or not analysis.resolver.edges:
        return None
    if not analysis.resolver.stretches or any(moves(mechanism, address, steps) for address in addresses):
        return None
    return RangesOfDesigns(mechanism, addresses, nominal, asked, analysis)


class RangesOfDesigns(MetricsOfDesigns):
    """Ranges of motion; of several stretches the first. Made by :func:`ranges_of_designs`."""

    def __init__(
        self, mechanism: Mechanism, varied: tuple[str, ...], nominal: Motion, names: Iterable[str], analysis: Analysis
    ) -> None:
        self.mechanism, self.varied, self.nominal = mechanism, varied, nominal
        self.kinds = dict.fromkeys(names, "angle")
        self.course = Course.of(mechanism, nominal.positions)
        solver = MotionSolver(mechanism, Manner(frozenset(varied)), nominal.solver.assembly)
        self.traces = Traces(force_programs(solver.programs), frozenset(varied), self.course)
        self._known = Known(solver.nominal.parameters)
        period = nominal.positions.period or 0.0
        known = np.array([time + lap for time, _ in analysis.resolver.edges for lap in (0.0, period)])
        slack = SAME * float(np.ptp(nominal.positions.time))
        self._stretches: list[tuple[End, End]] = []
        for stretch in analysis.resolver.stretches:
            reached = [np.abs(known - time).min() <= slack for time in stretch]
            begin, end = (
                End(time, self._stretched(time) if inner else None)
                for time, inner in zip(stretch, reached, strict=True)
            )
            self._stretches.append((begin, end))

    @cached_property
    def _quality(self) -> Formula:
        """The squares under the roots of all groups that end a stretch, zero where these are stretched or folded."""
        groups = sorted({end.group for ends in self._stretches for end in ends if end.group is not None})
        placed = self.traces.motion.placed
        return self.traces.formula(
            ("quality", tuple(groups)), lambda: {name: placed[name].quality for name in groups}
        )

    def _stretched(self, time: float) -> str:
        """The group at whose end of reach the machine is at a time."""
        motion, groups = self.traces.motion, tuple(modal_groups(self.traces.programs.motion.structure))
        every = self.traces.formula(
            ("quality", groups), lambda: {name: motion.placed[name].quality for name in groups}
        )
        nominal = {name: np.array([self.mechanism.dimension(name)]) for name in self.varied}
        found = every.run(self._known, at_times(nominal, _FIRST, np.array([time])), AT)
        return every.outputs[int(np.abs(found[0, :, 0]).argmin())]

    def _ends(self, columns: Mapping[str, Floats]) -> tuple[Floats, Flags]:
        """Times, s, of the ends of all stretches, (stretches, 2, designs), and where they are found, by Newton's
        steps from those of the machine itself."""
        count = len(next(iter(columns.values())))
        every, found = np.arange(count), np.ones(count, dtype=np.bool_)
        times = np.empty((len(self._stretches), 2, count))
        for number, side in product(range(len(self._stretches)), (0, 1)):
            end = self._stretches[number][side]
            time = np.full(count, end.time)
            for _ in range(STEPS if end.group is not None else 0):
                value, slope = self._value(columns, every, end, time)
                with np.errstate(all="ignore"):
                    moved = value / slope
                time = time - moved
                if (np.abs(moved) * self._speed <= CONVERGED).all():
                    break
            if end.group is not None:
                found &= np.abs(moved) * self._speed <= CONVERGED
            times[number, side] = time
        return times, found

    def _value(self, columns: Mapping[str, Floats], design: Indices, end: End, time: Floats) -> tuple[Floats, Floats]:
        """What is zero at an end, at times, s, and its slope."""
        assert end.group is not None
        k = self._quality.place[end.group]
        found = self._quality.with_slope.run(self._known, at_times(columns, design, time), AT)[0]
        return found[2 * k], found[2 * k + 1]

    @property
    def _speed(self) -> float:
        return abs(self.course.first.law.constant_speed or 0.0)

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Those of the varied dimensions on which the ranges depend."""
        taken = {name for ends in self._stretches[0] if ends.group for name in self._quality.columns}
        return tuple(name for name in self.varied if name in taken)

    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> tuple[dict[str, Floats], Flags]:
        """The ranges, rad (designs,), by name, and which designs are certain."""
        times, found = self._ends(columns)
        certain = found & self._certain(columns, times)
        value = self._speed * np.abs(times[0, 1] - times[0, 0])
        return dict.fromkeys(self.kinds, value), certain

    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums of ranges (sums, designs) and their gradients (sums, designs, by); NaN where they are not
        certain."""
        times, found = self._ends(columns)
        certain, every = found & self._certain(columns, times), np.arange(times.shape[2])
        value = self._speed * (times[0, 1] - times[0, 0])
        slopes = np.zeros((len(every), len(by)))
        for sign, end, time in zip((-1.0, 1.0), self._stretches[0], times[0], strict=True):
            if end.group is None:
                continue
            weight = -sign * self._speed * np.sign(value) / self._value(columns, every, end, time)[1]
            bars = self._quality.vjp(self._known, at_times(columns, every, time), AT, {end.group: weight[None]})
            slopes += np.stack([bars.get(name, np.zeros(len(every))) for name in by], axis=1)
        value, slopes = np.where(certain, np.abs(value), np.nan), np.where(certain[:, None], slopes, np.nan)
        weights = np.array([sum(each.values()) for each in sums])
        return weights[:, None] * value, weights[:, None, None] * slopes

    def _certain(self, columns: Mapping[str, Floats], times: Floats) -> Flags:
        """Of which designs the ends lie where reached positions follow others."""
        begins, positions = self.course.begin, self.nominal.positions
        lap = self.course.duration if self.course.closed else np.inf
        inside = np.zeros((times.shape[2], positions.count), dtype=np.bool_)
        near, certain = inside.copy(), np.isfinite(times).all(axis=(0, 1))
        slack = NEAR / self._speed
        with np.errstate(invalid="ignore"):
            for ends, at in zip(self._stretches, times - begins, strict=True):
                for end, place in zip(ends, at, strict=True):
                    certain &= np.floor((place + slack) / lap) == np.floor((end.time - begins + slack) / lap)
                    gap = np.abs(positions.time - begins - place[:, None])
                    gap = gap % lap if np.isfinite(lap) else gap
                    near |= np.minimum(gap, lap - gap) <= slack
                certain &= at[0] < at[1]
                way = positions.time - begins - at[0][:, None]
                way = way % lap if np.isfinite(lap) else np.where(way < 0.0, np.inf, way)
                inside |= way <= (at[1] - at[0])[:, None]
        return np.asarray(certain & ((self._reached(columns) == inside) | near).all(axis=1))

    def _reached(self, columns: Mapping[str, Floats]) -> Flags:
        """Which positions the designs reach, (designs, n)."""
        motion, positions = self.traces.motion, self.nominal.positions
        formula = self.traces.formula("reached", lambda: {"valid": select(motion.valid, 1.0, 0.0)})
        count, begin = len(next(iter(columns.values()))), self.course.begin
        ends = {LOW: np.full(count, begin), HIGH: np.full(count, begin + self.course.duration)}
        shares = (positions.time - begin) / self.course.duration
        return np.asarray(formula.run(self._known, {**columns, **ends}, shares)[:, 0].T == 1.0)


#: Designs whose curves are held at the same time.
BLOCK = 256


def swept(name: str, mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
    """The points of the subjects of a registered number that is the area of a hull; none for another."""
    metric, subject = metric_of(name) or (None, "")
    known = {} if metric is None else metric().swept(mechanism)
    return {each: known[each] for each in (chosen_subjects(name, subject, known) if known else ())}


def hulls_of_designs(mechanism: Mechanism, varied: Iterable[str], names: Iterable[str]) -> HullsOfDesigns | None:
    """Areas of hulls, ``swept_area``, ``swept_area_of_link jaw``; None where the cycle is no formula of one position
    (see ``cycle.machine.Machine``), or the dimensions move its times."""
    nominal = solve_motion(mechanism, failures="mark")
    try:
        machine = Machine(mechanism, nominal, varied, unloaded=True)
    except NotTogether:
        return None
    if any(moves(mechanism, address, nominal.positions.steps) for address in machine.varied):
        return None
    return HullsOfDesigns(machine, names)


class HullsOfDesigns(MetricsOfDesigns):
    """Areas of hulls; of several links the largest. Made by :func:`hulls_of_designs`."""

    def __init__(self, machine: Machine, names: Iterable[str]) -> None:
        self.machine, self._keys = machine, points(machine.mechanism)
        self.kinds = dict.fromkeys(names, "area")
        number = {key: k for k, key in enumerate(self._keys)}
        groups = [swept(name, machine.mechanism).values() for name in self.kinds]
        self._chosen = [[[number[key] for key in own] for own in subjects] for subjects in groups]
        self._words = [f"{key}.{axis}" for key in self._keys for axis in "xy"]
        self.cycle = Cycle(machine, (), even=self._words)

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Those of the varied dimensions on which the areas depend."""
        taken = self.cycle.columns
        return tuple(name for name in self.machine.varied if name in taken)

    def evaluate(
        self, columns: Mapping[str, Floats], *, threads: int | None = None, backend: Backend = "auto"
    ) -> tuple[dict[str, Floats], Flags]:
        """The areas (designs,) by name, and which designs are certain."""
        values, _ = self._found(columns, np.empty((0, len(self.kinds))), (), threads, backend)
        return dict(zip(self.kinds, values, strict=True)), np.asarray(np.isfinite(values).all(axis=0))

    def gradients(
        self,
        sums: Sequence[Mapping[str, float]],
        columns: Mapping[str, Floats],
        by: Sequence[str],
        *,
        threads: int | None = 1,
        backend: Backend = "auto",
    ) -> tuple[Floats, Floats]:
        """Weighted sums of areas (sums, designs) and their gradients (sums, designs, by); NaN of designs that do not
        pass."""
        factors = np.array([[weights.get(name, 0.0) for name in self.kinds] for weights in sums])
        values, slopes = self._found(columns, factors, tuple(by), threads, backend)
        return factors @ values, slopes

    def _found(
        self,
        columns: Mapping[str, Floats],
        factors: Floats,
        by: tuple[str, ...],
        threads: int | None,
        backend: Backend,
    ) -> tuple[Floats, Floats]:
        """Areas (kinds, designs), and derivatives (sums, designs, by) of their sums by factors (sums, kinds)."""
        own = {name: column for name, column in columns.items() if name in self.machine.varied}
        count = len(next(iter(columns.values())))
        values = np.full((len(self.kinds), count), np.nan)
        slopes = np.full((len(factors), count, len(by)), np.nan)
        self.machine.compiled = None if backend == "auto" else backend == "llvm"

        def work(first: int, end: int) -> None:
            solved = Solved(self.cycle, {name: column[first:end] for name, column in own.items()})
            rows = [solved.pieces.values(self.cycle.number[Signal(each)]) for each in self._words]
            weights = np.zeros((len(factors), len(rows), *rows[0].shape))
            for k in np.flatnonzero(solved.passed & ~solved.pieces.unmet).tolist():
                mine = np.flatnonzero(solved.pieces.design == k)
                values[:, first + k] = self._areas(solved, np.stack(rows)[:, :, mine], mine, factors, weights)
            known = np.isfinite(values[:, first:end]).all(axis=0)
            for number, each in enumerate(weights):
                signals = {Signal(words): row for words, row in zip(self._words, each, strict=True)}
                found = Backward(solved).gradient({}, (signals, np.zeros(len(solved.pieces.stretch))))
                for place, name in enumerate(by):
                    slopes[number, first:end, place] = np.where(known, found[name], np.nan)

        spread_over(count, BLOCK, cores() if threads is None else threads, work)
        return values, slopes

    def _areas(self, solved: Solved, rows: Floats, mine: Indices, factors: Floats, weights: Floats) -> Floats:
        """The areas (kinds,) of one design, from its points (rows, POINTS, pieces); adds to the weights, (sums, rows,
        POINTS, all pieces), those of its pieces ``mine`` in the sums."""
        columns = solved.pieces.columns
        edges = np.append(columns[LOW][mine], columns[HIGH][mine][-1:])
        curves, found = self._curves(rows, edges), np.empty(len(self.kinds))
        for number, chosen in enumerate(self._chosen):
            hull = max((SweptHull(curves, own) for own in chosen), key=lambda each: each.area)
            found[number] = hull.area
            if factors[:, number].any():
                own = hull.weights().swapaxes(2, 3).reshape(rows.shape)
                weights[:, :, :, mine] += factors[:, number, None, None, None] * own
        return found

    def _curves(self, rows: Floats, edges: Floats) -> Curves:
        """The curves of a design's points, (rows, POINTS, pieces), between edges, s."""
        pieces = rows.shape[2]
        values = rows.reshape(len(self._keys), 2, rows.shape[1], pieces).swapaxes(2, 3)
        begins, ends = np.zeros((2, pieces), dtype=bool)
        spans = np.tile([0, pieces * rows.shape[1]], (len(values), 1))
        if not self.machine.course.turns:
            begins, ends = turned(self.machine.mechanism, edges, self.machine.course.closed)
            spans[:] = of_driver(self.machine.mechanism, edges)
        spans[(values == values[:, :, :1, :1]).all(axis=(1, 2, 3))] = 0, 1
        return Curves(values, begins, ends, spans)
