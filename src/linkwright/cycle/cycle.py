"""What is wanted of the cycles of a machine, in formulas of one position, and a block of designs of it.

``Solved(Cycle(machine, parts), designs)`` serves one machine and thousands of designs: pieces of all designs lie
behind each other, whatever pattern of events each has.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property
from math import pi

import numpy as np

from linkwright.applied_loads.phases import MovingPhase, SwingPhase
from linkwright.core.arrays import Floats, Indices
from linkwright.core.outputs import Output, RelativeAngle
from linkwright.cycle.loads import input_end
from linkwright.cycle.machine import VALID, Machine, Swing
from linkwright.cycle.summaries import OF_LIMITS, Asked, Signal, StrokeSummary, Summary
from linkwright.events.course import Span, Stretches
from linkwright.events.events import AT, Events, Limits, events
from linkwright.events.formula import Formula
from linkwright.formula.trace import Scalar, absolute
from linkwright.kinetostatics.friction import FrictionTerm
from linkwright.kinetostatics.load_site import acts_name


class Cycle(Asked):
    """What is wanted of a machine: ``parts``, its summaries.

    ``limited``: outputs whose places and extremes are those of their limit positions; ``never``: outputs by whose
    reversals designs are distinguished; ``even``: signals that pieces meet everywhere; ``bent``: one may
    bend where it is zero, between two nodes of neighbours.
    """

    def __init__(
        self,
        machine: Machine,
        parts: Iterable[Summary],
        limited: Collection[Output] = (),
        never: Iterable[Output] = (),
        even: Iterable[str] = (),
    ) -> None:
        self.machine = machine
        every = {part.name: part for part in parts}
        found = {
            text: output
            for text, part in every.items()
            if type(part) is Summary and part.kind in OF_LIMITS
            for output in [machine.meant(part.output)]
            if output in limited
        }
        strokes = {
            text: (machine.meant(part.by), part.way)
            for text, part in every.items()
            if isinstance(part, StrokeSummary)
        }
        words = {text: self._signal(each.output, each.kind) for text, each in every.items() if text not in found}
        super().__init__(every, words, found, strokes, map(Signal, dict.fromkeys(even)))
        signals, traces = tuple(self.number), machine.traces
        kinds: dict[tuple[str, bool], list[int]] = {}
        for k, each in enumerate(signals):
            kinds.setdefault((traces.quantity(each.words).dimension, each.squared), []).append(k)
        self.bent = any(not each.squared and traces.square(each.words) is not None for each in signals)
        self.same_dimension: list[Indices] = [np.array(rows) for rows in kinds.values() if len(rows) > 1]
        self.formula = machine.formula(("signals", signals), lambda: self._outputs(signals))
        self.never = tuple(dict.fromkeys(never))
        self._follow()

    def _signal(self, words: str, kind: str) -> Signal:
        """The signal from which a summary is found: of sizes their square where that tells as much."""
        squared = kind in ("max", "peak", "rms", "argmax") and self.machine.traces.square(words) is not None
        return Signal(words, squared)

    def _outputs(self, signals: Iterable[Signal]) -> dict[str, Scalar]:
        traces = self.machine.traces
        found: dict[str, Scalar] = {}
        for each in signals:
            square = traces.square(each.words) if each.squared else None
            found[str(each)] = traces.quantity(each.words).value if square is None else square
        return {**found, VALID: traces.valid()}

    def _follow(self) -> None:
        """What oscillates: ``full``, where loads find limits over more than the course."""
        machine, loads = self.machine, self.machine.mechanism.loads.values()
        phases = [load.magnitude.phase for load in loads]
        swung = [each.output for each in phases if isinstance(each, SwingPhase)]
        moving = [each.output for each in phases if isinstance(each, MovingPhase)]
        turned = machine.turned if swung or moving else None
        reversing = [load.reverses(machine.mechanism) for load in loads]
        opposed = [each for each in reversing if isinstance(each, Output)]
        pairs = [each for each in reversing if isinstance(each, RelativeAngle)]
        terms: list[RelativeAngle | FrictionTerm] = [*pairs, *machine.terms]
        turning = [each for each in terms if machine.swings(each)]
        driven = [output for output, _ in self.on_strokes.values()]
        asked = [*opposed, *driven, *self.limited.values(), *self.never]
        own = [*moving, *asked] if turned else [*swung, *moving, *asked]
        valued = self.limited.values() if turned else [*self.limited.values(), *swung]
        self.swings = Swings(machine, dict.fromkeys([*own, *turning]), valued)
        self.full = Swings(turned, dict.fromkeys([*swung, *moving]), swung) if turned else None
        self.bending = tuple(dict.fromkeys([*opposed, *driven, *moving, *turning]))
        self.signed = self._signed()

    def _signed(self) -> Formula | None:
        """Forces, N, at whose zeros the signals bend: those that press guides with friction, and between teeth."""
        programs, trace = self.machine.traces.programs, self.machine.traces.motion.trace
        if not programs.signed:
            return None
        outputs = self._outputs(self.number)
        needed = set(trace.needed([trace.lift(value) for value in outputs.values()]))
        bending = {
            name: force
            for name, force in programs.signed.items()
            if programs.friction is not None or trace.lift(absolute(force)) in needed
        }
        return self.machine.varying(("signed", tuple(bending)), lambda: bending)

    @cached_property
    def columns(self) -> frozenset[str]:
        """The dimensions that vary on which anything depends."""
        machine = self.machine
        formulas = [self.formula, *self.swings.formulas, *(machine.kinks() or ())]
        formulas += [self.signed] if self.signed else []
        acting = {name for name in machine.phases for each in formulas if acts_name(name) in each.columns}
        ends = {input_end(name, which) for name in acting for which in (0, 1)}
        return machine.taken(formulas) | (ends & frozenset(machine.varied))


class Swings:
    """What goes to and fro in a machine: ``rates``, whose outputs are named by the numbers of the swings, None where
    none varies, and ``values`` of outputs."""

    def __init__(self, machine: Machine, swings: Iterable[Swing], valued: Iterable[Output]) -> None:
        self.machine, self.swings = machine, tuple(swings)
        traces = machine.traces
        self.rates = machine.varying(
            ("rates", self.swings), lambda: {str(k): traces.rates(each) for k, each in enumerate(self.swings)}
        )
        self.values = {each: self._value(each) for each in dict.fromkeys(valued)}

    def _value(self, output: Output) -> Formula:
        return self.machine.formula(("value", output), lambda: {"value": self.machine.traces.value(output)})

    @property
    def formulas(self) -> list[Formula]:
        """All of them."""
        return [*self.values.values(), *([self.rates] if self.rates else [])]


class Block:
    """Some designs of a machine with columns ``designs``: ``reversals`` of what goes to and fro, of outputs as
    ``limits`` with their values; none of what does not move in any."""

    def __init__(self, swings: Swings, designs: Mapping[str, Floats], count: int) -> None:
        self.swings, self.machine, self.designs, self.count = swings, swings.machine, designs, count
        self.span = Span(self.machine.course, self._periods(), np.zeros(count))
        self.known = self.machine.tracked(designs, self.span.period)
        self.kinks = self._kinks()
        self.base = Stretches(self.span, self.kinks)
        found = events(swings.rates, self.known, designs, self.base) if swings.rates else []
        self.reversals = {swings.swings[int(each.name)]: each for each in found}
        self.limits = {
            output: Limits(each, swings.values.get(output), self.span)
            for output, each in self.reversals.items()
            if isinstance(output, Output)
        }

    def _periods(self) -> Floats:
        course = self.machine.course
        if not course.turns:
            return np.full(self.count, course.duration)
        return np.asarray(2.0 * pi * course.turns / np.abs(self.speed))

    @cached_property
    def speed(self) -> Floats:
        """Rate of the first driver where the cycle begins, (designs,) rad/s or m/s."""
        course = self.machine.course
        rate = float(course.first.law.coordinate(np.array([course.begin]))[1][0])
        return self.designs.get(f"{course.first.name}.speed", np.full(self.count, rate))

    def _kinks(self) -> list[Events]:
        """Where joints go over from one formula to the next."""
        formulas = self.machine.kinks()
        if formulas is None:
            return []
        sines, cosines = formulas
        found = events(sines, self.known, self.designs, Stretches(self.span, []))
        return [
            each.selected(cosines.run(self.known, each.columns(), AT)[0, k] > 0.0) if len(each.time) else each
            for k, each in enumerate(found)
        ]

    # the input ------------------------------------------------------------------------------------------
    def inside(self, time: Floats, design: Indices | slice = slice(None)) -> Floats:
        """Times, s, of some designs in the cycle that begins where the course does."""
        course = self.machine.course
        if not course.closed:
            return time
        period = self.span.period[design]
        share = (time - course.begin) / period
        return np.asarray(time - np.floor(share + 1e-12) * period)

    def input_at(self, time: Floats) -> Floats:
        """The first driver's coordinate at times, (designs,) rad or m."""
        course = self.machine.course
        if not course.turns:
            return self._along_law(time)[0]
        start = self.designs.get(f"{course.first.name}.start", course.first.law.at(0.0))
        return np.asarray(start + self.speed * self.inside(time))

    def _along_law(self, time: Floats) -> tuple[Floats, Floats]:
        """Coordinate and rate at times, of which some may be NaN."""
        course, known = self.machine.course, np.isfinite(time)
        value, rate, _ = course.first.law.coordinate(np.where(known, time, course.begin))
        return np.where(known, value, np.nan), np.where(known, rate, np.nan)

    # the way back ---------------------------------------------------------------------------------------
    def pull_input(self, bar: Floats, time: Floats, back: ByColumns) -> Floats:
        """From derivatives by the input at times, (designs,) s, those by the driver's dimensions, and by the
        times."""
        course = self.machine.course
        if not course.turns:
            return np.asarray(bar * self._along_law(time)[1])
        name, every = course.first.name, np.arange(self.count)
        back.add(every, {f"{name}.speed": np.nan_to_num(bar * time), f"{name}.start": bar})
        return np.asarray(bar * self.speed)

    def pull(self, back: ByColumns) -> None:
        """From derivatives by limits, reversals and bends those by the columns of the designs."""
        for limits in self.limits.values():
            back.add(*limits.pull())
        for each in (*self.reversals.values(), *self.kinks):
            back.through(each)
        if self.machine.course.turns:
            by_speed = -self.span.bar * self.span.period / self.speed
            back.add(np.arange(self.count), {f"{self.machine.course.first.name}.speed": by_speed})

    def forget(self) -> None:
        """Sets all derivatives to zero."""
        self.span.bar[:] = 0.0
        for each in (*self.reversals.values(), *self.kinks):
            each.bar[:] = 0.0
        for limits in self.limits.values():
            limits.bar[:] = 0.0


class ByColumns:
    """Derivatives by the columns of some designs, (designs,) each, as they are ``found`` one after the other."""

    def __init__(self, block: Block) -> None:
        self.found = {name: np.zeros(block.count) for name in block.designs}

    def add(self, design: Indices, by_columns: Mapping[str, Floats]) -> None:
        """Adds some, (k,) by the columns of some designs."""
        for name, each in by_columns.items():
            if name in self.found:
                np.add.at(self.found[name], design, each)

    def through(self, events: Events) -> tuple[Indices, dict[str, Floats]]:
        """Adds those by the times of events; the roots among these, with the derivatives by all their columns."""
        if not events.bar.any():
            return np.empty(0, dtype=np.intp), {}
        design, by_columns, roots = events.pull()
        self.add(design, by_columns)
        return roots, by_columns
