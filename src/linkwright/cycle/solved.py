"""The cycles of some designs: events, the loads that they switch, pieces between them, and summaries of signals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property, partial
from math import pi

import numpy as np

from linkwright.applied_loads.phases import InputPhase, MovingPhase, SwingPhase
from linkwright.applied_loads.sizes import Table
from linkwright.applied_loads.strokes import NEAR
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import Output
from linkwright.curves.pieces import HIGH, LOW, Layout, Pieces
from linkwright.cycle.cycle import Block, ByColumns, Cycle
from linkwright.cycle.loads import (
    Acting,
    InPart,
    Never,
    OnStrokes,
    Repeated,
    WithinInput,
    between,
    input_end,
    of_limits,
)
from linkwright.cycle.machine import NotTogether
from linkwright.cycle.summaries import Summaries
from linkwright.events.course import AtInput, Cuts, Stretches
from linkwright.events.events import Events, Limits, events
from linkwright.events.formula import ROW, Formula
from linkwright.formula.trace import Scalar, Trace, sin
from linkwright.kinetostatics.signals import MotionSignals

#: Pieces of a lap of the input to begin with, and where the full course of signals is asked for, as of curves whose
#: hull is sought among their nodes.
PIECES, PIECES_OF_COURSES = 12, 24


class Solved(Block, Summaries):
    """The cycles of designs with some columns (designs,); of the machine itself where there are none."""

    def __init__(self, cycle: Cycle, designs: Mapping[str, Floats]) -> None:
        count = len(next(iter(designs.values()))) if designs else 1
        arrays = {name: np.asarray(each, dtype=float) for name, each in designs.items()}
        super().__init__(cycle.swings, {**arrays, ROW: np.arange(float(count))}, count)
        self.cycle = self.asked = cycle
        self.full = None if cycle.full is None else Block(cycle.full, self.designs, count)
        self.loads = LoadEvents(self, self.full)
        bending = [self.reversals[each] for each in cycle.bending if each in self.reversals]
        found: list[Cuts] = [*self.kinks, *self.loads.families, *bending]
        families = list({id(each): each for each in found}.values())
        self.stretches = Stretches(self.span, families, self.loads.knots)
        self.corners: list[Events] = []
        if cycle.signed is not None:
            self.corners = events(cycle.signed, self.known, self.designs, self.stretches, self.loads.columns)
            self.stretches = Stretches(self.span, [*families, *self.corners], self.loads.knots)

    @cached_property
    def pieces(self) -> Pieces:
        """The signals on pieces."""
        cycle = self.cycle
        return Pieces(
            lambda columns, nodes: cycle.formula.run(self.known, columns, nodes),
            Layout(self.stretches.design, self.count, self._columns),
            *self.stretches.first_pieces(PIECES_OF_COURSES if cycle.even_words else PIECES),
            cycle.wanted(cycle.same_dimension, joined=cycle.bent),
        )

    def _columns(self, stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        design = self.stretches.design[stretch]
        low, high = self.stretches.ends(stretch, first, last)
        found = {name: each[design] for name, each in self.designs.items()} | {LOW: low, HIGH: high}
        return found | self.loads.columns(design, low, 0.5 * (low + high))

    @cached_property
    def passed(self) -> Flags:
        """Designs that pass the full cycle, with friction that is certain, and loads that have values,
        (designs,)."""
        valid = self.pieces.most(-self.pieces.bottom[-1]) == -1.0
        tracked = self.known.paths is None or self.known.paths.passed
        return np.asarray(self.pieces.passed & valid & tracked & ~self.loads.lacking)

    @cached_property
    def turned_round(self) -> Flags:
        """Designs in which an output reverses that never does where the numbers are meant, (designs,)."""
        found = np.zeros(self.count, dtype=np.bool_)
        for output in self.cycle.never:
            if output in self.limits:
                found |= np.bincount(self.limits[output].events.design, minlength=self.count) > 0
        return found


#: The column that is a value which is reached.
REACH = "reach"
#: Takes derivatives (k,) by values that designs reach.
Reached = Callable[[Indices, Floats], None]


def _unmoved(design: Indices, by_value: Floats) -> None:
    """What places that no design moves do with derivatives by them."""


class LoadEvents:
    """When the loads of a machine act: ``acting``; ``families`` of the cuts that they make, ``knots`` (s) of those
    that no design moves; ``full``: the block over the full cycle, in which they find limits, where the course is
    a part of it."""

    def __init__(self, block: Block, full: Block | None) -> None:
        self.block, self.machine, self.limited = block, block.machine, full or block
        self.selections: list[tuple[Limits, Events]] = []
        self.reached: list[tuple[Events, Reached]] = []
        self.inputs: list[AtInput] = []
        self.acting = [self._acting(name) for name in self.machine.phases]
        self.lacking = np.zeros(block.count, dtype=np.bool_)
        for acting in self.acting:
            self.lacking |= acting.missing
        self.knots = self._tables()
        ends: dict[int, Cuts] = {id(each): each for acting in self.acting for each in acting.events}
        self.repeated: list[Repeated] = []
        if full is not None:
            limits = [ends.pop(id(each)) for _, each in self.selections if id(each) in ends]
            self.repeated = [Repeated(each, full.span.period, block.span) for each in limits]
        self.families = [*self.repeated, *ends.values(), *self.inputs, *(each for each, _ in self.reached)]

    def _acting(self, name: str) -> Acting:
        """When a load acts."""
        load = self.machine.mechanism.loads[name]
        phase = load.magnitude.phase
        if isinstance(phase, InputPhase):
            return self._between_inputs(name, phase)
        assert isinstance(phase, SwingPhase | MovingPhase)
        limited = self.limited
        limits = limited.limits.get(phase.output)
        if limits is None:
            return Never(load, self.block.span)
        selected = limits.events.selected(limits.is_outermost) if phase.outermost else limits.events
        self.selections.append((limits, selected))
        strokes = of_limits(selected, (phase.start == "min", phase.end == "min"), limits.span)
        if not phase.in_part:
            return OnStrokes(load, strokes, by_time=bool(self.machine.course.turns))
        assert isinstance(phase, SwingPhase)
        value = limited.swings.values[phase.output]
        found = InPart(load, phase, strokes, limits, value, limited.known, self.block.designs)
        for which in phase.part_edges:
            reached = self._where(self._value_beyond(phase), found.reach(which))
            self.reached.append((reached, partial(found.pull_reach, which)))
        return found

    def _value_beyond(self, phase: SwingPhase) -> Formula:
        """How far an output is beyond a value."""
        output, machine = phase.output, self.machine

        def beyond(t: Trace, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
            return {"g": found["value"] - t.position(REACH)}

        return machine.formula(("reach", output), lambda: {"value": machine.traces.value(output)}, beyond)

    def _input_beyond(self) -> Formula:
        """The same of the input, of one that turns a sine."""
        rotary = self.machine.course.first.law.rotary

        def beyond(t: Trace, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
            gone = found["input"] - t.position(REACH)
            return {"g": sin(0.5 * gone) if rotary else gone}

        return self.machine.formula("input reached", dict, beyond)

    def _where(self, beyond: Formula, value: Floats) -> Events:
        """Where a value (designs,) is reached."""
        designs = {**self.block.designs, REACH: np.nan_to_num(value)}
        (found,) = events(beyond, self.block.known, designs, self.block.base)
        return found

    def _between_inputs(self, name: str, phase: InputPhase) -> Acting:
        """Between two values of the input."""
        block, load = self.block, self.machine.mechanism.loads[name]
        addresses = input_end(name, 0), input_end(name, 1)
        first, last = (
            block.designs.get(address, np.full(block.count, value))
            for address, value in zip(addresses, (phase.start, phase.end), strict=True)
        )
        if not self.machine.course.turns:
            heading = MotionSignals(self.machine.nominal).heading
            reached = [self._where(self._input_beyond(), each) for each in (first, last)]
            found = WithinInput(load, block.span, (first, last), heading, [*reached])
            self.reached += [(each, partial(found.pull_reach, k)) for k, each in enumerate(reached)]
            return found
        start, finish = (self._at_input(*each, 1) for each in zip(addresses, (first, last), strict=True))
        backwards = not (block.speed > 0.0).all() and phase.end > phase.start
        strokes = between(finish, start, block.span) if backwards else between(start, finish, block.span)
        fits = np.abs(last - first) <= 2.0 * pi + NEAR
        return OnStrokes(load, strokes, by_time=True, backwards=backwards, fits=fits)

    def _at_input(self, address: str, value: Floats, every: int) -> AtInput:
        """Where an input that turns has a value (designs,), which is the dimension of this address."""
        first, block = self.machine.course.first, self.block
        start = block.designs.get(f"{first.name}.start", np.full(block.count, first.law.at(0.0)))
        self.inputs.append(AtInput(block.span, value, every, address, block.speed, start))
        return self.inputs[-1]

    def _tables(self) -> Floats:
        """Cuts where tables over the input bend; times, s, at which those over the time do, and over inputs that
        follow laws."""
        signals, found = MotionSignals(self.machine.nominal), [np.empty(0)]
        course = self.machine.course
        for name in self.machine.loads.names:
            size = self.machine.mechanism.loads[name].magnitude.size
            if isinstance(size, Table) and isinstance(size.over, Output) and size.interpolation == "linear":
                self.reached += [(each, _unmoved) for each in self._bends_over(size.over, size.x)]
            if not isinstance(size, Table) or not size.known_at:
                continue
            if course.turns and size.over == "input":
                every = max(1, round((size.x[-1] - size.x[0]) / (2.0 * pi)))
                for x in size.x:
                    self._at_input("", np.full(self.block.count, x), every)
            else:
                found.append(size.kinks(signals))
        times = np.concatenate(found)
        if course.closed:
            times = course.begin + (times - course.begin) % course.duration
        return np.unique(times[(times > course.begin) & (times < course.begin + course.duration)])

    def _bends_over(self, output: Output, places: tuple[float, ...]) -> list[Events]:
        """Where an output is at places of a table; nowhere where no formula tells it."""
        machine, block = self.machine, self.block

        def beyond(_: Trace, found: Mapping[str, Scalar]) -> dict[str, Scalar]:
            gone = {str(x): found["value"] - x for x in places}
            return {x: sin(0.5 * each) for x, each in gone.items()} if output.kind == "angle" else gone

        try:
            formula = machine.formula(
                ("table", output, places), lambda: {"value": machine.traces.value(output)}, beyond
            )
        except NotTogether:
            return []
        return events(formula, block.known, block.designs, block.base)

    def columns(self, design: Indices, time: Floats, middle: Floats) -> dict[str, Floats]:
        """What loads do in pieces that begin at some times, with these middles, s."""
        return {k: v for acting in self.acting for k, v in acting.columns(design, middle).items()}

    # the way back ---------------------------------------------------------------------------------------
    def pull_columns(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        """From derivatives by these columns those by what they follow from."""
        for acting in self.acting:
            acting.pull(design, middle, by_columns)

    def pull(self, back: ByColumns) -> None:
        """From derivatives by the events those by the designs' columns, and by limits."""
        for reached, hand_on in self.reached:
            roots, by_columns = back.through(reached)
            if REACH in by_columns:
                hand_on(reached.design[roots], by_columns[REACH])
        for acting in self.acting:
            back.add(np.arange(self.block.count), acting.by_dimensions)
        for each in self.inputs:
            back.add(*each.pull(self.machine.course.first.name))
        for repeated in self.repeated:
            repeated.push()
        for limits, selected in self.selections:
            if selected is not limits.events:
                limits.events.bar[limits.is_outermost] += selected.bar

    def forget(self) -> None:
        """Sets all derivatives to zero."""
        for acting in self.acting:
            for bar in (*(each.bar for each in acting.events), *acting.by_dimensions.values()):
                bar[:] = 0.0
