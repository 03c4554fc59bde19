"""A result together with what several design numbers share: outputs, limit positions, true extremes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from math import isnan
from typing import Any, Literal, TypeAlias, overload

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.cached_property import cached_property
from linkwright.core.outputs import Output, row_names
from linkwright.core.search import first_largest
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.machine import Machine, NotTogether
from linkwright.cycle.solved import Solved
from linkwright.cycle.summary import Summary, SummaryValue
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import limit_positions
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.programs import words_name
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.loads.signals import Limit
from linkwright.loads.strokes import outermost
from linkwright.metrics.outputs import mechanism_outputs
from linkwright.metrics.reached_extremes import PartlyReached
from linkwright.metrics.solved_again import in_enough_positions
from linkwright.metrics.solved_cuts import SolvedCuts
from linkwright.metrics.solved_pieces import SolvedPieces

Result: TypeAlias = "Motion | Forces | Analysis"
Kind = Literal["max", "min"]
#: Finds summaries of some type of one machine.
Finder: TypeAlias = "Callable[[Sequence[Any], Analysis], list[SummaryValue]]"
_FINDERS: dict[type[Summary], Finder] = {}


def finds(kind: type[Summary]) -> Callable[[Finder], Finder]:
    """Decorator of the function that finds summaries of a type that are not of one output over the whole cycle."""

    def filed(finder: Finder) -> Finder:
        _FINDERS[kind] = finder
        return finder

    return filed


def _first_largest(*found: SummaryValue) -> SummaryValue:
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
        self._outputs = motion.solver.programs.meanings
        self._asked: dict[Summary, None] = {}
        self._found: dict[Summary, SummaryValue] = {}
        self._parts: dict[Summary, SummaryValue] = {}
        self._solved: list[Solved] = []

    def __getstate__(self) -> dict[str, Any]:
        """All but the formulas of its cycle, which every process makes for itself."""
        return {**self.__dict__, "_machine": None, "_solved": []}

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

    def ask(self, parts: Iterable[Summary]) -> None:
        """Says which summaries will be wanted, so that their outputs are evaluated together."""
        for part in parts:
            if part.of_cycle:
                self._asked[part] = None
                if not self._meant(part.output).of_course:
                    self._words[words_name(part.output)] = None

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

    def part(self, summary: Summary) -> SummaryValue:
        """A summary over the cycle with its place where it has one.

        ``peak``: the largest size; places of extremes of a mechanism's outputs are its outermost limit positions.
        """
        if summary not in self._parts:
            found = self._of_cycle(summary) or self._summarised(summary)
            reaction = summary.output.startswith("reaction ")
            small = self.forces and reaction and abs(found.value) < self.forces.rounding
            if small and abs(found.value) < self._rounding(found.time):
                found = replace(found, value=0.0)
            self._parts[summary] = found
        return self._parts[summary]

    def _of_cycle(self, part: Summary) -> SummaryValue | None:
        """A part of a cycle that is passed by one formula, found at once with all that were asked for."""
        if not part.of_cycle or self._machine is None:
            return None
        if part not in self._together:
            wanted = {**self._asked, part: None}
            parts = [each for each in wanted if each.of_cycle and each not in self._together]
            told = {each: self._tells(each.output) for each in parts}
            swinging = self.outputs if self.closed else ()
            limited = [each for each in swinging if self.limits(each) and self._machine.tells(each.name)]
            parts = [each for each in parts if told[each]]
            self._together |= dict.fromkeys(told)
            solved = Solved(Cycle(self._machine, parts, limited), {})
            self._solved.append(solved)
            self._together |= {each: self._read_of(solved, each) for each in parts}
        return self._together[part]

    def _tells(self, words: str) -> bool:
        """Whether the cycle's formulas give an output."""
        assert self._machine is not None
        return not self._meant(words).of_course or self._machine.tells(words)

    def _read_of(self, solved: Solved, part: Summary) -> SummaryValue | None:
        """A part of one machine's cycle; None of one that is not passed."""
        if not solved.passed[0]:
            return None
        time = solved.time_of(part.name)
        return SummaryValue(
            float(solved.values[part.name][0]), float(time[0]), float(solved.input_at(time)[0]), True
        )

    @cached_property
    def _together(self) -> dict[Summary, SummaryValue | None]:
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

    def _summarised(self, summary: Summary) -> SummaryValue:
        kind, finder = summary.kind, _FINDERS.get(type(summary))
        if finder is not None:
            return self._found_together(summary, finder)
        if kind in ("argmax", "argmin", "range") and (output := self.output(summary.output)):
            return self._of_limits(output, kind)
        nothing, signal = (
            SummaryValue(float("nan"), float("nan"), float("nan"), True),
            self.signal(summary.output),
        )
        if kind in ("mean", "rms"):
            value = (self.mean_of if kind == "mean" else self.rms_of)(signal)
            return replace(nothing, value=value, exact=self.cycle is not None)
        if kind == "excess":
            rate = float(abs(self.input_rate[0]))
            return (
                nothing
                if self.cycle is None
                else replace(nothing, value=rate * self.cycle.excess(signal, self._of))
            )
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

    def _found_together(self, part: Summary, finder: Finder) -> SummaryValue:
        """A part that a finder finds, at once with those of all that were asked for."""
        if part not in self._found:
            alike = [each for each in {**self._asked, part: None} if type(each) is type(part)]
            missing = [each for each in alike if each not in self._found]
            self._found |= zip(missing, finder(missing, self), strict=True)
        return self._found[part]

    def _extreme(self, output: str, kind: str) -> SummaryValue | None:
        side: Kind = "max" if kind == "max" else "min"
        signal = self.signal(output)
        return self.extreme(signal, side) if self.forces is None else self.extreme(signal, side, of="forces")

    def output(self, words: str) -> Output | None:
        """The output of the mechanism that words mean."""
        meant = self._meant(words)
        return meant if meant in self.outputs else None

    def _meant(self, words: str) -> Output:
        if words not in self._outputs:
            self._outputs[words] = output_meant(self.motion.mechanism, words)
        return self._outputs[words]

    def _of_limits(self, output: Output, kind: str) -> SummaryValue:
        """Place of an output's outermost limit position, or the way between them."""
        if kind == "range":
            return self._range(output)
        end = next(each for each in self.outermost(output) if each.kind == kind.removeprefix("arg"))
        return SummaryValue(end.input, end.time, end.input, True)

    def _range(self, output: Output) -> SummaryValue:
        """The way of an output between its outermost places, the largest one of all stretches that are reached."""
        nowhere = SummaryValue(float("nan"), float("nan"), float("nan"), self.resolver.possible)
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
        found = []
        for way in self.ways:
            high, low = (way.extreme(lambda each: each.read(output), sign, "motion") for sign in (1.0, -1.0))
            if high is None or low is None:
                return []
            found.append((high.value - low.value, not np.isnan(high.value - low.value)))
        return found

    @property
    def _of(self) -> str:
        return "motion" if self.forces is None else "forces"

    @cached_property
    def cycle(self) -> SolvedPieces | None:
        """The cycle on pieces; None where not all of it is reached, or nothing lies between its positions."""
        if not self.resolver.possible or self.motion.steps < 3 or not self.resolver.whole:
            return None
        try:
            if self._machine is None:
                cuts = SolvedCuts(self.motion, self.forces, self.resolver).stretches.begin
            else:
                known = self._solved if not self._machine.traces.programs.signed else []
                cuts = (known or [Solved(Cycle(self._machine, ()), {})])[0].stretches.begin
            found = SolvedPieces.of_cycle(self.motion, self.resolver, cuts)
            return found if found.reached else None
        except LinkwrightError:
            return None

    def mean_of(self, signal: Callable[..., Floats], *, square: bool = False) -> float:
        """Mean over the time of the cycle of what the forces (without them, the motion) give, (n,), or of its
        ``square``.

        By integration between the positions, so that the jumps of loads fall where they are. NaN where not all of
        a closed cycle is reached, but for what is the same everywhere; of a way that ends that of the time until
        then, if it does not grow without bound; of the positions where nothing can be solved between these.
        """
        if self.cycle is not None:
            return self.cycle.integral(signal, self._of, square=square) / self.cycle.duration
        if self.partial:
            return self.mean_of_part(signal, self._of, square=square)
        return self.mean(np.asarray(signal(self.forces or self.motion)) ** (2 if square else 1))

    def rms_of(self, signal: Callable[..., Floats]) -> float:
        """Root of the mean square over the time of the cycle, found in the same way."""
        return float(np.sqrt(self.mean_of(signal, square=True)))

    @overload
    def extreme(self, signal: Callable[[Motion], Floats], kind: Kind) -> SummaryValue | None: ...
    @overload
    def extreme(
        self, signal: Callable[[Forces], Floats], kind: Kind, *, of: Literal["forces"]
    ) -> SummaryValue | None: ...
    def extreme(
        self, signal: Callable[..., Floats], kind: Kind, *, of: str = "motion"
    ) -> SummaryValue | None:
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
        sample = SummaryValue(float(values[index]), float(time[index]), at, False)
        if not self.resolver.possible or self.motion.steps < 3:
            return sample
        if self.cycle is not None:
            return self.cycle.extreme(signal, sign, of)
        return self.extreme_of_part(signal, sign, of, sample)


_known: Recent[Motion | Forces, Analysis] = Recent(8)
