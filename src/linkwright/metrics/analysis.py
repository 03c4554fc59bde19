"""A result together with what several design numbers share: outputs, limit positions, true extremes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from math import isnan
from typing import Any, Literal, TypeAlias, overload

import numpy as np

from linkwright.core.arrays import EQUAL, Floats
from linkwright.core.cached_property import cached_property
from linkwright.core.outputs import Output, row_names
from linkwright.core.piecewise import POINTS, Piecewise, largest, reach, sought
from linkwright.core.search import first_largest
from linkwright.cycle.cycle import Cycle, Solved
from linkwright.cycle.machine import Machine, NotTogether
from linkwright.cycle.summary import STROKES, TRUE_SPEED, Extreme, Summary, one, signal_of
from linkwright.engine.recently_made import Recent
from linkwright.kinematics.limits import limit_positions
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinetostatics.forces import ROUNDING, Forces
from linkwright.kinetostatics.programs import words_name
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.loads.signals import Limit
from linkwright.loads.strokes import outermost
from linkwright.metrics.cycle_grid import PASSED, CycleGrid, cycle_grid
from linkwright.metrics.outputs import mechanism_outputs
from linkwright.metrics.reached_extremes import PartlyReached
from linkwright.metrics.solved_again import in_enough_positions

Result: TypeAlias = "Motion | Forces | Analysis"
Kind = Literal["max", "min"]
#: By kind of summary values and times (s) of some outputs, and whether polynomials meet these.
Columns: TypeAlias = dict[str, tuple[list[float], list[float], list[bool]]]
#: Summaries that are found of all outputs at once.
_TOGETHER = frozenset({"max", "min", "peak", "mean", "rms"})


#: Finds parts of some kinds of one machine.
Finder: TypeAlias = "Callable[[Sequence[Summary], Analysis], list[Extreme]]"
_FINDERS: dict[str, Finder] = {}


def finds(*kinds: str) -> Callable[[Finder], Finder]:
    """Decorator of the function that finds parts of kinds that are no summaries of one output."""

    def filed(finder: Finder) -> Finder:
        _FINDERS.update(dict.fromkeys(kinds, finder))
        return finder

    return filed


def _first_largest(*found: Extreme) -> Extreme:
    """The one of largest size, of equal ones the first."""
    ordered = sorted(found, key=lambda each: each.time)
    return ordered[first_largest(np.abs([each.value for each in ordered]))]


class Analysis(PartlyReached):
    """What design numbers are read from: a motion, its forces if they were solved, and what numbers share.

    Of a cycle in few positions it is the motion in more of them.

    ``kept``: what one number found and another needs too, by its kind and subject.
    """

    def __init__(self, motion: Motion, forces: Forces | None = None) -> None:
        super().__init__(motion, forces)
        self.kept: dict[tuple[str, str], Any] = {}
        self._limits: dict[Output, tuple[Limit, ...]] = {}
        self._outermost: dict[Output, list[Limit]] = {}
        self._words: dict[str, None] = {}
        self._rows: dict[str, None] = {}
        self._outputs = motion.solver.programs.meanings
        self._asked: dict[Summary, Extreme | None] = {}
        self._met: dict[str, tuple[int, Columns]] = {}
        self._parts: dict[str, Extreme] = {}
        self._texts: dict[str, None] = {}

    @classmethod
    def of(cls, result: Motion | Forces | Analysis) -> Analysis:
        """The analysis of a result, the same one as long as the result is of use.

        Positions that were asked for in no order are taken by their times.
        """
        if isinstance(result, Analysis):
            return result
        return _known.get(result, "", lambda: cls._in_order(result.in_order()))

    @classmethod
    def _in_order(cls, result: Motion | Forces) -> Analysis:
        motion, forces = (result.motion, result) if isinstance(result, Forces) else (result, None)
        return cls(*in_enough_positions(motion, forces))

    @cached_property
    def input_dimension(self) -> str:
        """``angle`` or ``length``: of the first driver's coordinate."""
        return "angle" if next(iter(self.motion.positions.rotary.values()), True) else "length"

    @cached_property
    def outputs(self) -> tuple[Output, ...]:
        """What the machine puts out: angles of links that turn about the frame, displacements of blocks on it."""
        return mechanism_outputs(self.motion.mechanism)

    @cached_property
    def input_rate(self) -> Floats:
        """Rate of the first driver, (n,) rad/s or m/s."""
        return next(iter(self.motion.positions.coordinates.values()))[1]

    @property
    def loaded(self) -> bool:
        """Whether anything acts: a load, or mass."""
        mechanism = self.motion.mechanism
        return bool(mechanism.loads) or any(link.mass or link.inertia for link in mechanism.links.values())

    @property
    def whole(self) -> bool:
        """Whether the positions are one closed cycle and all are reached."""
        return self.closed and self.motion.whole

    def limits(self, output: Output) -> tuple[Limit, ...]:
        """Limit positions of an output, by increasing time; none where the positions follow no law in time."""
        if output not in self._limits:
            turning = (each.owner for each in self.outputs if each.kind == "angle")
            self.motion.evaluate_together(each for link in turning for each in row_names("direction", link))
            found = limit_positions(self.motion, output) if self.resolver.possible else ()
            self._limits[output] = tuple(sorted(found, key=lambda each: each.time))
        return self._limits[output]

    def outermost(self, output: Output) -> list[Limit]:
        """Those of its limit positions with the largest and the smallest value."""
        if output not in self._outermost:
            limits = self.limits(output)
            self._outermost[output] = outermost(limits) if limits else []
        return self._outermost[output]

    def ask(self, parts: Iterable[str]) -> None:
        """Says which summaries will be wanted, so that their outputs are evaluated together."""
        texts = tuple(parts)
        self._texts |= dict.fromkeys(texts)
        for summary in map(one, texts):
            output = summary.output
            if summary.kind in STROKES.values():
                output = signal_of(summary)
                self._asked.setdefault(summary)
            if summary.kind not in TRUE_SPEED and not self._meant(output).of_course:
                self._words[words_name(output)] = None

    def ask_rows(self, names: Iterable[str]) -> None:
        """Says which outputs, by their names in programs, will be wanted of the :attr:`grid`."""
        self._rows |= dict.fromkeys(names)

    def signal(self, output: str) -> Callable[[Motion | Forces], Floats]:
        """An output in words (see ``kinetostatics.named``) as a function of motion or forces, (n,)."""
        kept = self._words
        meant = self._meant(output)
        if meant.of_course:
            return lambda each: (each.motion if isinstance(each, Forces) else each).read(meant)

        def read(solved: Motion | Forces) -> Floats:
            name, rows, evaluate = words_name(output), solved.rows, partial(self._read, solved=solved)
            kept.setdefault(name)
            together = isinstance(solved, Forces) or self.forces is None
            if name not in rows.index and name not in rows.extra:
                rows.fetch(tuple(kept) if together else (name,), evaluate)
            return rows.row(name, evaluate)

        return read

    def _read(self, names: tuple[str, ...], solved: Motion | Forces) -> Floats:
        if isinstance(solved, Forces):
            return solved.evaluate(names)
        values = ForceSolver(solved.solver).evaluate(names, solved, {})
        if not solved.ok.all():
            values[:, ~solved.ok] = np.nan
        return values

    def part(self, summary: str) -> Extreme:
        """A summary over the cycle, ``"reaction O5 on jaw max"``, with its place where it has one.

        ``peak``: the largest size; places of extremes of a mechanism's outputs are its outermost limit positions.
        """
        if summary not in self._parts:
            found = self._of_cycle(summary) or self._summarised(one(summary))
            small = (
                self.forces and summary.startswith("reaction ") and abs(found.value) < self.forces.rounding
            )
            if small and abs(found.value) < self._rounding(found.time):
                found = replace(found, value=0.0)
            self._parts[summary] = found
        return self._parts[summary]

    def _of_cycle(self, text: str) -> Extreme | None:
        """A part of a cycle that is passed by one formula, found at once with all that were asked for."""
        if one(text).kind in TRUE_SPEED or self._machine is None:
            return None
        if text not in self._together:
            parts = [each for each in {**self._texts, text: None} if each not in self._together]
            parts = [each for each in parts if one(each).kind not in TRUE_SPEED]
            limited = [output for output in self.outputs if self.limits(output)] if self.closed else ()
            solved = Cycle(self._machine, parts, limited).solve({})
            self._together |= {each: self._read_of(solved, each) for each in parts}
        return self._together[text]

    def _read_of(self, solved: Solved, text: str) -> Extreme | None:
        """A part of one machine's cycle; None of one that is not passed."""
        if not solved.passed[0]:
            return None
        value, time = float(solved.values[text][0]), float(solved.time_of(text)[0])
        place = float(solved.input_at(solved.time_of(text))[0])
        return Extreme(value, time, place, True)

    @cached_property
    def _together(self) -> dict[str, Extreme | None]:
        return {}

    @cached_property
    def _machine(self) -> Machine | None:
        """The formulas of the cycle; None where it is not passed by one of each position."""
        if not self.resolver.possible or not self.resolver.whole or len(self.resolver.changes):
            return None
        try:
            static = self.forces is not None and self.forces.static
            return Machine(self.motion.mechanism, self.motion, static=static)
        except NotTogether:
            return None

    def _rounding(self, time: float) -> float:
        """Size, N, below which a joint force is but rounding; of a machine that is partly reached beside the forces
        at that time, s, as they may grow without bound at others."""
        if self.forces is None:
            return 0.0
        if isnan(time) or not self.partial:
            return self.forces.rounding
        near = np.where(self.motion.ok, np.abs(self.motion.time - time), np.inf)
        return float(self.forces.roundings[near.argmin()])

    def _summarised(self, summary: Summary) -> Extreme:
        kind = summary.kind
        if kind in TRUE_SPEED or kind in STROKES.values():
            return self._found_together(summary, _FINDERS[kind])
        if kind in _TOGETHER and (known := self._known(summary.output, kind)):
            return known
        if kind in ("argmax", "argmin", "range") and (output := self.output(summary.output)):
            return self._of_limits(output, kind)
        nothing, signal = Extreme(float("nan"), float("nan"), float("nan"), True), self.signal(summary.output)
        if kind in ("mean", "rms"):
            value = (self.mean_of if kind == "mean" else self.rms_of)(signal)
            return replace(nothing, value=value, exact=self.grid is not None)
        if kind == "excess":
            return replace(nothing, value=self._excess(signal))
        if kind in ("max", "min"):
            return self._extreme(summary.output, kind) or replace(nothing, exact=False)
        high, low = self._extreme(summary.output, "max"), self._extreme(summary.output, "min")
        if high is None or low is None:
            return replace(nothing, exact=False)
        if kind == "range":
            return replace(nothing, value=high.value - low.value, exact=high.exact and low.exact)
        if kind == "peak":
            largest = _first_largest(high, low)
            return replace(largest, value=abs(largest.value))
        found = high if kind == "argmax" else low
        return replace(found, value=found.input)

    def _found_together(self, part: Summary, finder: Finder) -> Extreme:
        """A part that a finder finds, at once with those of all that were asked for."""
        found = self._asked.get(part)
        if found is None:
            wanted = {**self._asked, part: None}
            missing = [
                each for each in wanted if self._asked.get(each) is None and _FINDERS[each.kind] is finder
            ]
            self._asked |= zip(missing, finder(missing, self), strict=True)
            found = self._asked[part]
        assert found is not None
        return found

    def _excess(self, signal: Callable[[Motion | Forces], Floats]) -> float:
        """Largest difference of the integral over the first driver's way of a signal's lack of its mean."""
        if self.grid is None:
            return float("nan")
        curve = self.grid.curve(signal, "forces", halve=True)
        mean = curve.total / (self.grid.end - self.grid.start)
        work = Piecewise(curve.edges, mean - curve.values).integral()
        least, most = Piecewise(curve.edges, work.at_nodes).extremes()
        way, size = self.grid.end - self.grid.start, float(np.abs(curve.values).max())
        excess = most.value - least.value
        return float(abs(self.input_rate[0])) * (excess if excess > ROUNDING * size * way else 0.0)

    def _extreme(self, output: str, kind: str) -> Extreme | None:
        side: Kind = "max" if kind == "max" else "min"
        if known := self._known(output, kind):
            return known
        signal = self.signal(output)
        return self.extreme(signal, side) if self.forces is None else self.extreme(signal, side, of="forces")

    def _known(self, output: str, kind: str) -> Extreme | None:
        """One of the summaries of an output that are found together, where polynomials meet it, found at once with
        those of all that were asked for."""
        name = words_name(output)
        if name not in self._met:
            if self._meant(output).of_course or self.grid is None:
                return None
            missing = tuple(each for each in {**self._words, name: None} if each not in self._met)
            columns = self._summaries(self.grid, missing)
            self._met |= {each: (k, columns) for k, each in enumerate(missing)}
        k, columns = self._met[name]
        values, times, met = columns[kind]
        if not met[k]:
            return None
        return Extreme(
            values[k], times[k], times[k] if isnan(times[k]) else self.resolver.input_at(times[k]), True
        )

    def _summaries(self, grid: CycleGrid, names: tuple[str, ...]) -> Columns:
        """The summaries of some outputs."""
        solved = grid.motion if self.forces is None else grid.forces
        rows = solved.rows.fetch(names, lambda missing: self._read(missing, solved))
        pieces, count = np.concatenate(rows).reshape(len(names), -1, POINTS), len(names)
        both = np.empty((2, count, POINTS, pieces.shape[1]))
        both[0] = pieces.swapaxes(1, 2)
        np.negative(both[0], out=both[1])
        values = both.reshape(2 * count, *both.shape[2:])
        tops = values.max(axis=1)
        size = tops.max(axis=1).reshape(2, count).max(axis=0)
        with np.errstate(all="ignore"):
            means, met = grid.means(pieces, size)
            squares, even = grid.means(pieces * pieces, size * size)
            sizes = np.sqrt(squares)
        piece, place, top, rough = largest(values, tops)
        time = grid.edges[piece] + 0.5 * (place + 1.0) * np.diff(grid.edges)[piece]
        high, low = top[:count], -top[count:]
        time[np.tile(high - low <= ROUNDING * np.abs(high), 2)] = grid.start
        bound = np.tile(grid.tolerance * size, 2)
        smooth = (rough <= bound) & (reach(pieces, tops.reshape(2, count, -1), bound[:count]) <= top + bound)
        first, last, never = time[:count], time[count:], np.full(count, np.nan)
        above, below, more = smooth[:count], smooth[count:], np.abs(high) - np.abs(low)
        upwards = np.where(np.abs(more) <= EQUAL * size, first <= last, more > 0.0)
        found = {
            "max": (high, first, above),
            "min": (low, last, below),
            "peak": (np.abs(np.where(upwards, high, low)), np.where(upwards, first, last), above & below),
            "mean": (means, never, met),
            "rms": (sizes, never, even),
        }
        return {kind: (a.tolist(), b.tolist(), c.tolist()) for kind, (a, b, c) in found.items()}

    def output(self, words: str) -> Output | None:
        """The output of the mechanism that words mean."""
        meant = self._meant(words)
        return meant if meant in self.outputs else None

    def _meant(self, words: str) -> Output:
        if words not in self._outputs:
            self._outputs[words] = output_meant(self.motion.mechanism, words)
        return self._outputs[words]

    def _of_limits(self, output: Output, kind: str) -> Extreme:
        """Place of an output's outermost limit position, or the way between them."""
        if kind == "range":
            return self._range(output)
        end = next(each for each in self.outermost(output) if each.kind == kind.removeprefix("arg"))
        return Extreme(end.input, end.time, end.input, True)

    def _range(self, output: Output) -> Extreme:
        """The way of an output between its outermost places, the largest one of all stretches that are reached."""
        nowhere = Extreme(float("nan"), float("nan"), float("nan"), self.resolver.possible)
        if found := self.ranges(output):
            return replace(
                nowhere, value=max(way for way, _ in found), exact=all(exact for _, exact in found)
            )
        known = np.append(self.motion.read(output), [limit.value for limit in self.limits(output)])
        exact = self.resolver.possible and not self.partial
        return replace(nowhere, value=float(np.ptp(known[np.isfinite(known)])), exact=exact)

    def ranges(self, output: Output) -> list[tuple[float, bool]]:
        """The ways of an output on all stretches of what is partly reached, and whether these are exact; none where
        nothing is solved on one of them."""
        if not self.partial or not self.ways.known:
            return []
        limits = self.ends.limits(lambda solved: solved.read(output), "motion")
        return list(self.ways.ranges(output, zip(self.ends.times, limits, strict=True)))

    @cached_property
    def grid(self) -> CycleGrid | None:
        """The cycle at Gauss points; None where not all of it is reached, or nothing lies between its positions."""
        return cycle_grid(self.resolver, self.motion, self.forces, (*self._words, *self._rows))

    def mean_of(self, signal: Callable[..., Floats]) -> float:
        """Mean over the time of the cycle of what the forces (without them, the motion) give, (n,).

        By integration between the positions, so that the jumps of loads fall where they are. NaN where not all of
        a closed cycle is reached, but for what is the same everywhere; of a way that ends that of the time until
        then, if it does not grow without bound; of the positions where nothing can be solved between these.
        """
        of = "motion" if self.forces is None else "forces"
        if self.grid is None:
            if self.partial:
                return self.mean_of_part(signal, of)
            return self.mean(signal(self.forces or self.motion))
        for _, *ends in self.grid.limits_at_changes(signal, of):
            if np.isinf(ends).any():
                return float(np.sum(ends))  # infinite, or undefined where it grows to both sides
        return self.grid.curve(signal, of, halve=True).total / (self.grid.end - self.grid.start)

    def rms_of(self, signal: Callable[..., Floats]) -> float:
        """Root of the mean square over the time of the cycle, found in the same way."""
        return float(np.sqrt(self.mean_of(lambda solved: signal(solved) ** 2)))

    @overload
    def extreme(self, signal: Callable[[Motion], Floats], kind: Kind) -> Extreme | None: ...
    @overload
    def extreme(
        self, signal: Callable[[Forces], Floats], kind: Kind, *, of: Literal["forces"]
    ) -> Extreme | None: ...
    def extreme(self, signal: Callable[..., Floats], kind: Kind, *, of: str = "motion") -> Extreme | None:
        """Largest or smallest value of a signal over the cycle, found between the positions where that can be.

        ``signal`` takes a Motion (or Forces, with ``of="forces"``) and gives (n,). None where no position is
        reached.
        """
        solved = self.forces if of == "forces" else self.motion
        values = signal(solved)
        if not np.isfinite(values).any():
            return None
        sign = 1.0 if kind == "max" else -1.0
        index = first_largest(sign * values)
        time = self.motion.time
        at = float(self.motion.input[index]) if self.motion.inputs else float("nan")
        sample = Extreme(float(values[index]), float(time[index]), at, False)
        if not self.resolver.possible or self.motion.steps < 3:
            return sample
        if self.grid is not None:
            curve = self.grid.curve(signal, of)
            if len(self.grid.around) and not curve.extreme(kind).smooth:
                return self._past_changes(self.grid, signal, of, sign)
            found = sought(curve, kind, self.grid.function(signal, of))
            return Extreme(found.value, found.place, self.resolver.input_at(found.place), True)
        return self.extreme_of_part(signal, sign, of, sample)

    def _past_changes(
        self, grid: CycleGrid, signal: Callable[[Any], Floats], of: str, sign: float
    ) -> Extreme | None:
        """The extreme of a signal that polynomials do not meet in a cycle with change points."""
        for time, *ends in grid.limits_at_changes(signal, of):
            if sign * np.inf in ends:
                return Extreme(sign * np.inf, time, self.resolver.input_at(time), True)
        times = np.linspace(grid.start, grid.end, 361)
        times = np.sort(np.append(times, grid.around.mean(axis=1)))
        function = grid.function(signal, of)
        found = self._best_of(lambda t: sign * function(t), times, sign)
        if found is None or abs(found.value) > PASSED * np.nanmax(np.abs(function(times))):
            return found
        return replace(found, value=0.0)

    def extremes_between(
        self,
        kind: Kind,
        wanted: Sequence[tuple[Callable[[Any], Floats], tuple[float, float]]],
        of: str = "motion",
    ) -> list[Extreme | None]:
        """The same of signals, each between a pair of times, s, both among the candidates, where positions can be
        solved between; None where none of them is reached."""
        grid = self.grid
        if wanted and grid is not None and all(grid.start <= start < end for _, (start, end) in wanted):
            found = grid.extremes_between(kind, wanted, of)
            return [
                Extreme(each.value, each.place, self.resolver.input_at(each.place), True) for each in found
            ]
        return [self._extreme_between(signal, kind, of, *span) for signal, span in wanted]

    def _extreme_between(
        self, signal: Callable[[Any], Floats], kind: Kind, of: str, start: float, end: float
    ) -> Extreme | None:
        """The same between two times, from samples."""
        sign = 1.0 if kind == "max" else -1.0
        return self._best_of(
            lambda t: sign * signal(self.resolver.at(t, of)), np.linspace(start, end, 361), sign
        )

    def _best_of(self, signal: Callable[[Floats], Floats], time: Floats, sign: float) -> Extreme | None:
        """The largest of a signal at some times, s, and between those beside it."""
        values = signal(time)
        if not np.isfinite(values).any():
            return None
        best = first_largest(values)
        at = float(time[best])
        first = Extreme(sign * float(values[best]), at, self.resolver.input_at(at), True)
        low, high = time[[max(best - 1, 0)]], time[[min(best + 1, len(time) - 1)]]
        return self.narrowed(signal, low, high, sign, first)


_known: Recent[Motion | Forces, Analysis] = Recent(8)
