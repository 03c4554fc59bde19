"""A result together with what several metrics share: outputs, limit positions, true extremes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cached_property, partial
from math import isnan, nan
from typing import Any, Literal, TypeAlias

import numpy as np

from linkwright.analysis.outputs import mechanism_outputs
from linkwright.analysis.reachable_intervals import Signal, Ways
from linkwright.analysis.solved_again import Resolver, SolvedCuts, in_enough_positions
from linkwright.analysis.solved_summaries import Reversals, SolvedSummary, of_positions
from linkwright.applied_loads.signals import Limit
from linkwright.applied_loads.strokes import outermost
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output, row_names
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.machine import Machine, NotTogether
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import OF_LIMITS, StrokeSummary, Summary, SummaryValue
from linkwright.errors import LinkwrightError
from linkwright.events.course import Course
from linkwright.events.limit_positions import limit_positions
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.motion import TURN, Motion
from linkwright.kinematics.names import HARMONIC, output_meant
from linkwright.kinetostatics.forces import ROUNDING, Forces
from linkwright.kinetostatics.solver import ForceSolver, words_name

Result: TypeAlias = "Motion | Forces | Analysis"
Kind = Literal["max", "min"]
#: Finds a summary of some type of one machine.
Finder: TypeAlias = "Callable[[Any, Analysis], SummaryValue]"
_FINDERS: dict[type[Summary], Finder] = {}


def finds(kind: type[Summary]) -> Callable[[Finder], Finder]:
    """Decorator of the function that finds summaries of a type that are not of one output over the full cycle."""

    def filed(finder: Finder) -> Finder:
        _FINDERS[kind] = finder
        return finder

    return filed


class Analysis:
    """What metrics are read from: a motion, its forces if they were solved, and what numbers share.

    Of a cycle in few positions it is the motion in more of them.

    ``names``: what one number found and another needs too, by its kind and subject.
    """

    def __init__(self, motion: Motion, forces: Forces | None = None) -> None:
        self.motion, self.forces = motion, forces
        self.resolver = Resolver(motion, forces)
        self.cached: dict[tuple[str, str], Any] = {}
        self._limits: dict[Output, tuple[Limit, ...]] = {}
        self._outermost: dict[Output, list[Limit]] = {}
        self._words: dict[str, None] = {}
        self._outputs = motion.solver.programs.meanings
        self._asked: dict[Summary, None] = {}
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
    def closed(self) -> bool:
        """Whether the positions are one closed cycle."""
        return self.motion.positions.closed

    @property
    def once(self) -> slice:
        """The positions without the repeated first one at the end of a closed cycle."""
        return slice(0, self.motion.steps - self.motion.positions.repeated)

    @property
    def partial(self) -> bool:
        """Whether the positions are those of the drivers' laws, of which not all are reached."""
        return self.resolver.possible and not self.resolver.complete

    @property
    def complete(self) -> bool:
        """Whether the positions are one closed cycle and all are reached."""
        return self.closed and self.motion.complete

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
                if not self.meant(part.output).of_course:
                    self._words[words_name(part.output)] = None

    def signal(self, output: str) -> Callable[[Motion | Forces], Floats]:
        """An output in words (see ``kinetostatics.named``) as a function of motion or forces, (n,)."""
        names = self._words
        meant = self.meant(output)
        if meant.of_course:
            return partial(self._of_course, output=meant)
        if meant.kind in HARMONIC:
            return partial(_harmonic, output=meant, inner=self.signal(meant.owner))

        def read(solved: Motion | Forces) -> Floats:
            name, rows, evaluate = words_name(output), solved.rows, partial(self._read, solved=solved)
            names.setdefault(name)
            together = isinstance(solved, Forces) or self.forces is None
            if name not in rows.index and name not in rows.extra:
                try:
                    rows.fetch(tuple(names) if together else (name,), evaluate)
                except LinkwrightError:
                    del names[name]
                    raise
            return rows.row(name, evaluate)

        return read

    def _of_course(self, solved: Motion | Forces, output: Output) -> Floats:
        """An output that the motion gives, angles in the turns in which its positions have them."""
        motion, known = solved.motion if isinstance(solved, Forces) else solved, self.motion
        values, period = motion.read(output), known.positions.period
        if motion is known or output.kind != "angle":
            return values
        if known.link(output.owner).counted:
            return motion.row("turned_angle", output.owner) - known.link(output.owner).turns_before
        angle, begin = known.read(output), float(known.time.min())
        order = np.argsort(known.time)
        order = order[np.isfinite(angle[order])]
        time = motion.time if period is None else begin + (motion.time - begin) % period
        near = np.interp(time, known.time[order], angle[order])
        return np.asarray(values + TURN * np.round((near - values) / TURN))

    def _read(self, names: tuple[str, ...], solved: Motion | Forces) -> Floats:
        if isinstance(solved, Forces) or not solved.by_law:
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
            found = self._of_formulas(summary) or self._found_again(summary)
            reaction = summary.output.startswith("reaction ")
            small = self.forces and reaction and abs(found.value) < self.forces.rounding
            if small and abs(found.value) < self._rounding(found.time):
                found = replace(found, value=0.0)
            self._parts[summary] = found
        return self._parts[summary]

    def _of_formulas(self, part: Summary) -> SummaryValue | None:
        """A part of a cycle that is passed by one formula, found at once with all that were asked for."""
        machine, wanted = self._machine, {**self._asked, part: None}
        if machine is not None and part.of_cycle and part not in self._together:
            parts = [each for each in wanted if each.of_cycle and each not in self._together]
            self._together |= dict.fromkeys(parts)
            parts = [each for each in parts if self._tells(each.output, machine)]
            swinging = self.outputs if self.closed else ()
            limited = [each for each in swinging if self.limits(each) and machine.tells(each.name)]
            solved = Solved(Cycle(machine, parts, limited), {})
            self._solved.append(solved)
            self._together |= {each: _value(solved, each) for each in parts}
        return self._together.get(part)

    def _tells(self, words: str, machine: Machine) -> bool:
        """Whether the cycle's formulas give an output."""
        return not self.meant(words).of_course or machine.tells(words)

    @cached_property
    def _together(self) -> dict[Summary, SummaryValue | None]:
        return {}

    @cached_property
    def _machine(self) -> Machine | None:
        """The formulas of the cycle; None where it is not passed by one of each position."""
        if not self.resolver.possible or not self.resolver.complete or len(self.resolver.changes):
            return None
        try:
            static = self.forces is not None and self.forces.static
            return Machine(self.motion.mechanism, self.motion, static=static)
        except NotTogether:
            return None

    def _rounding(self, time: float) -> float:
        """Size, N, below which a joint force is a rounding error; of a machine that is partly reached compared with
        the forces at that time, s, as they may grow without bound at others."""
        if self.forces is None:
            return 0.0
        if isnan(time) or not self.partial:
            return self.forces.rounding
        near = np.where(self.motion.ok, np.abs(self.motion.time - time), np.inf)
        return float(self.forces.roundings[near.argmin()])

    def output(self, words: str) -> Output | None:
        """The output that words mean, if it is one of the mechanism's own."""
        meant = self.meant(words)
        return meant if meant in self.outputs else None

    def meant(self, words: str) -> Output:
        """The output that words mean."""
        if words not in self._outputs:
            self._outputs[words] = output_meant(self.motion.mechanism, words)
        return self._outputs[words]

    def _of_limits(self, output: Output, kind: str) -> SummaryValue:
        """Place, or value, of an output's outermost limit position, or the way between them."""
        ends: dict[str, Limit] = {each.kind: each for each in reversed(self.outermost(output))}
        if kind == "range":
            return SummaryValue(ends["max"].value - ends["min"].value, nan, nan, True)
        end = ends[kind.removeprefix("arg")]
        return SummaryValue(end.input if kind.startswith("arg") else end.value, end.time, end.input, True)

    def _found_again(self, part: Summary) -> SummaryValue:
        """A part of what no formula of the cycle gives."""
        if type(part) in _FINDERS:
            return _FINDERS[type(part)](part, self)
        output, reversals = self.output(part.output), None
        if isinstance(part, StrokeSummary):
            driven = self.meant(part.by)
            reversals = driven, self.limits(driven)
        elif output and part.kind in OF_LIMITS and self.resolver.closes and self.complete and self.limits(output):
            return self._of_limits(output, part.kind)
        return self.find(part, self.signal(part.output), self._of, reversals)

    def find(self, part: Summary, signal: Signal, of: str, reversals: Reversals | None = None) -> SummaryValue:
        """A summary of a signal, (n,) of the motion or of the forces, between the positions where that can be."""
        ways = self.ways if self.motion.steps > 2 else None
        if part.kind in ("mean", "rms") and self.partial:
            looked = self._known(of) if ways is None else ways.at(ways.looks, of)
            values = signal(looked)
            known = values[np.isfinite(values)]
            if len(known) and np.ptp(known) <= ROUNDING * abs(known[0]):
                return SummaryValue(float(abs(known[0]) if part.kind == "rms" else known[0]), nan, nan, False)
            if self.closed or ways is None:
                return SummaryValue(nan, nan, nan, False)
        values = np.asarray(signal(self._known(of)), dtype=float)
        sample = of_positions(self.motion, values, part.kind)
        if ways is None or not np.isfinite(values).any() or (part.kind == "excess" and not ways.complete):
            return sample
        found = SolvedSummary(ways, part, signal, of, reversals)
        if found.passed.all():
            return found.found()
        return sample if self.partial else replace(sample, value=nan)

    def ranges(self, output: Output) -> list[tuple[float, bool]]:
        """The ways of an output on all stretches of what is partly reached, and whether these are exact."""
        if self.ways is None:
            return []
        signal = partial(self._of_course, output=output)
        found = SolvedSummary(self.ways, Summary("", "range"), signal, "motion")
        return [(float(way), not isnan(way)) for way in found.values[""]]

    def _known(self, of: str) -> Motion | Forces:
        return self.forces if of == "forces" and self.forces else self.motion

    @property
    def _of(self) -> str:
        return "motion" if self.forces is None else "forces"

    @cached_property
    def ways(self) -> Ways | None:
        """The full cycle, or its reachable intervals; None where nothing lies between the positions."""
        resolver = self.resolver
        if not resolver.possible or self.motion.steps < 2:
            return None
        try:
            if self.partial or self.motion.steps < 3:
                found = Ways.in_part(resolver, resolver.stretches) if resolver.stretches else None
            elif self._machine is None:
                stretches = SolvedCuts(self.motion, self.forces, resolver).stretches
                found = Ways.of_cycle(resolver, stretches.span.course, stretches.begin)
            else:
                known = self._solved if not self._machine.traces.programs.signed else []
                stretches = (known or [Solved(Cycle(self._machine, ()), {})])[0].stretches
                course = Course.of(self.motion.mechanism, self.motion.positions, seam=True)
                found = Ways.of_cycle(resolver, course, stretches.begin)
                if self._solved and self._solved[0].passed[0]:
                    return found
            return found if found is not None and found.solved else None
        except LinkwrightError:
            return None

    @property
    def cycle(self) -> Ways | None:
        """The full cycle on pieces; None where not all of it is reached, or nothing lies between its positions."""
        return self.ways if self.ways is not None and self.ways.complete else None

    def mean_of(self, signal: Callable[..., Floats]) -> float:
        """Mean over the time of the cycle of what the forces (without them, the motion) give, (n,).

        By integration between the positions, so that the jumps of loads fall where they are. NaN where not all of
        a closed cycle is reached, but for what is the same everywhere; of a way that ends that of the time until
        then, if it does not grow without bound; of the positions where nothing can be solved between these.
        """
        return self.find(Summary("", "mean"), signal, self._of).value

    def extreme(self, signal: Callable[..., Floats], kind: Kind, *, of: str = "motion") -> SummaryValue | None:
        """Largest or smallest value of a signal over the cycle, found between the positions where that can be.

        ``signal`` takes a Motion (or Forces, with ``of="forces"``) and gives (n,). None where no position is
        reached.
        """
        found = self.find(Summary("", kind), signal, of)
        return None if isnan(found.value) and not found.exact else found


def _harmonic(solved: Motion | Forces, output: Output, inner: Callable[..., Floats]) -> Floats:
    """An output times the cosine or sine of a multiple of the first driver's angle, (n,)."""
    angle = int(output.on) * (solved.motion if isinstance(solved, Forces) else solved).input
    return np.asarray(inner(solved) * (np.cos(angle) if output.kind == "cosine" else np.sin(angle)))


def _value(solved: Solved, part: Summary) -> SummaryValue | None:
    """A summary of one machine's cycle; None of one that is not passed."""
    if not solved.passed[0]:
        return None
    time = solved.time_of(part.name)
    value, place = solved.values[part.name][0], solved.input_at(time)[0]
    return SummaryValue(float(value), float(time[0]), float(place), True)


_known: Recent[Motion | Forces, Analysis] = Recent(8)
