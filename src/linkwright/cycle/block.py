"""A block of designs of one machine: the cycles of their input, and where in these outputs and joints reverse."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from math import pi

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.outputs import Output
from linkwright.cycle.machine import Machine, Swing
from linkwright.events.events import AT, Events, events
from linkwright.events.formula import Formula
from linkwright.events.limits import Limits
from linkwright.events.stretches import Span, Stretches


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
