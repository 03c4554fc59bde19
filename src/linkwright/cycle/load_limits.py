"""Limit positions between which loads act, in many designs at once, as numbers that programs over positions take."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from math import pi

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import Output
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.machine import Machine
from linkwright.events.events import AT, events
from linkwright.events.formula import NODE, ROW, Formula
from linkwright.events.limits import Limits
from linkwright.events.stretches import Span, Stretches
from linkwright.formula.trace import Scalar
from linkwright.kinetostatics.load_site import (
    DRIFT,
    LAP,
    limit_input_name,
    limit_name,
    turns_steadily,
    value_name,
)
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.loads.signals import BetweenLimits

#: Designs of which limits are sought together.
BLOCK = 1024
#: Newton's steps from a limit of a design to that of one near it, and the change of the input in the last one that
#: ends them well, rad.
NEAR_STEPS, CONVERGED = 5, 1e-10


class LoadLimits:
    """The limits of the outputs between which loads with these ``phases`` act; ``numbers``: of the cycle, the same
    for all designs."""

    def __init__(self, machine: Machine, phases: Iterable[BetweenLimits]) -> None:
        self.machine = machine
        self.phases = tuple(phases)
        self.outputs = tuple(dict.fromkeys(phase.output for phase in self.phases))
        traces = machine.traces
        every = machine.formula(
            ("rates", self.outputs),
            lambda: {str(k): traces.rates(each) for k, each in enumerate(self.outputs)},
        )
        varying = tuple(every.varying(NODE))
        self.rates: Formula | None = None
        if varying:
            self.rates = machine.formula(
                ("varying rates", self.outputs),
                lambda: {k: traces.rates(self.outputs[int(k)]) for k in varying},
            )
        self.values = {
            output: machine.formula(("value", output), partial(self._value, output))
            for output in self.outputs
        }
        self.steady = turns_steadily(machine.mechanism)

    def _value(self, output: Output) -> dict[str, Scalar]:
        return {"value": self.machine.traces.value(output)}

    @cached_property
    def numbers(self) -> dict[str, float]:
        """How long the cycle is, and what the input gains in it."""
        course = self.machine.course
        lap = course.duration * (abs(course.first.law.constant_speed or 0.0) if self.steady else 1.0)
        if course.turns:
            lap = 2.0 * pi * course.turns
        drift = MotionSignals(self.machine.nominal).whole.drift
        return {LAP: lap * (1.0 if course.closed else 2.0), DRIFT: drift}

    @property
    def dimensions(self) -> frozenset[str]:
        """Dimensions that vary on which they depend."""
        formulas = [*self.values.values(), *([] if self.rates is None else [self.rates])]
        first = self.machine.course.first.name
        taken = {name for formula in formulas for name in formula.columns}
        return frozenset(self.machine.varied) & (taken | {f"{first}.speed", f"{first}.start"})

    def solve(self, columns: Mapping[str, Floats]) -> FoundLimits:
        """Those of designs with some columns (designs,)."""
        count = len(next(iter(columns.values()))) if columns else 1
        return FoundLimits(
            [
                _Block(self, {name: each[first : first + BLOCK] for name, each in columns.items()})
                for first in range(0, count, BLOCK)
            ]
        )


class NearLimits:
    """Limits of designs near one whose limits are known, one design at a time.

    ``start``: the limits of that one.
    """

    def __init__(self, sought: LoadLimits, start: FoundLimits) -> None:
        self.sought, machine = sought, sought.machine
        self.known = replace(machine.known, compiled=True)
        self._order = [(output, kind) for output in sought.outputs for kind in ("max", "min")]
        course = machine.course
        speed, begin = float(course.first.law.constant_speed or 0.0), course.first.law.at(0.0)
        inputs = np.array([start.numbers[limit_name(*each)][0] for each in self._order])
        self.speed, self.begin, self.times = speed, begin, (inputs - begin) / speed
        place = {} if sought.rates is None else sought.rates.place
        rows = [2 * place[str(k)] for k in range(len(sought.outputs)) for _ in ("max", "min")]
        self._rows, self._columns = np.array(rows), np.arange(len(rows))

    def limits(self, values: Mapping[str, float]) -> dict[str, float] | None:
        """Their numbers of the design with these values of the dimensions that vary; None where Newton's steps do
        not come to an end."""
        if self.sought.rates is None:
            return None
        formula, time = self.sought.rates.with_slope, self.times
        columns = {name: np.full(len(time), value) for name, value in values.items()}
        for _ in range(NEAR_STEPS):
            found = formula.run(self.known, {**columns, LOW: time, HIGH: time + 1.0}, AT)[0]
            step = found[self._rows, self._columns] / found[self._rows + 1, self._columns]
            time = time - step
        if not float(np.abs(step).sum()) * abs(self.speed) <= CONVERGED:
            return None
        columns |= {LOW: time, HIGH: time + 1.0}
        numbers = {
            limit_name(*each): self.begin + self.speed * at
            for each, at in zip(self._order, time.tolist(), strict=True)
        }
        for output in dict.fromkeys(phase.output for phase in self.sought.phases if phase.in_part):
            value = self.sought.values[output].run(self.known, columns, AT)[0, 0]
            for (own, kind), there in zip(self._order, value.tolist(), strict=True):
                if own == output:
                    numbers[value_name(own, kind)] = there
        return numbers


class FoundLimits:
    """``numbers`` (designs,) by the names of parameters; ``certain``: designs that have just one limit of either kind
    between which each load acts, one after the other."""

    def __init__(self, blocks: Sequence[_Block]) -> None:
        self._blocks = blocks
        self.numbers: dict[str, Floats] = {
            name: np.concatenate([each.numbers[name] for each in blocks]) for name in blocks[0].numbers
        }
        self.certain: Flags = np.concatenate([each.certain for each in blocks])

    def pull(self, bars: Mapping[str, Floats]) -> dict[str, Floats]:
        """From derivatives (designs,) by the numbers those by the designs' columns."""
        found, first = [], 0
        for each in self._blocks:
            part = slice(first, first := first + each.count)
            found.append(each.pull({name: bar[part] for name, bar in bars.items()}))
        return {name: np.concatenate([each[name] for each in found]) for name in found[0]}


class _Block:
    """The limits of some designs."""

    def __init__(self, sought: LoadLimits, columns: Mapping[str, Floats]) -> None:
        self.sought, self.machine = sought, sought.machine
        given = {name: np.asarray(each, dtype=float) for name, each in columns.items()}
        self.count = len(next(iter(given.values()))) if given else 1
        self.designs = {**given, ROW: np.arange(float(self.count))}
        self.span = Span(self.machine.course, self._periods(), np.zeros(self.count))
        self.certain = np.ones(self.count, dtype=np.bool_)
        self.limits: dict[Output, Limits] = {}
        if sought.rates is not None:
            stretches, known = Stretches(self.span, []), self.machine.tracked(self.designs, self.span.period)
            for each in events(sought.rates, known, self.designs, stretches):
                output = sought.outputs[int(each.name)]
                self.limits[output] = Limits(each, sought.values[output], self.span)
        self.numbers = self._numbers()

    def _periods(self) -> Floats:
        course = self.machine.course
        if not course.turns or f"{course.first.name}.speed" not in self.designs:
            return np.full(self.count, course.duration)
        return np.asarray(2.0 * pi * course.turns / np.abs(self.speed))

    @property
    def speed(self) -> Floats:
        """Rate of the first driver where the cycle begins, (designs,) rad/s or m/s."""
        course = self.machine.course
        rate = float(course.first.law.coordinate(np.array([course.begin]))[1][0])
        return self.designs.get(f"{course.first.name}.speed", np.full(self.count, rate))

    def _numbers(self) -> dict[str, Floats]:
        found = {}
        for output in self.sought.outputs:
            limits = self.limits.get(output)
            for kind in ("max", "min"):
                time = np.full(self.count, np.nan) if limits is None else self._time(limits, kind)
                there = self._input(time)
                found[limit_name(output, kind)] = there if self.sought.steady else time
                found[limit_input_name(output, kind)] = there
                found[value_name(output, kind)] = time if limits is None else limits.at(kind)
        for phase in self.sought.phases:
            self.certain &= self._fits(phase)
        return found

    def _fits(self, phase: BetweenLimits) -> Flags:
        """Whether a load with the phase acts between two limits alone."""
        limits = self.limits.get(phase.output)
        if limits is None:
            return np.zeros(self.count, dtype=np.bool_)
        counted = limits.is_outermost() if phase.outermost else np.ones(len(limits.value), dtype=np.bool_)
        sides = [
            np.bincount(
                limits.events.design[counted & (limits.events.rising == rising)], minlength=self.count
            )
            for rising in (True, False)
        ]
        found = (sides[0] == 1) & (sides[1] == 1)
        if not self.span.course.closed:
            with np.errstate(invalid="ignore"):
                found &= self._time(limits, phase.end) > self._time(limits, phase.start)
        return np.asarray(found)

    def _time(self, limits: Limits, kind: str) -> Floats:
        return np.append(limits.events.time, np.nan)[limits.outermost[kind]]

    def _input(self, time: Floats) -> Floats:
        """The first driver's coordinate at times, (designs,) rad or m."""
        course = self.machine.course
        if course.turns:
            start = self.designs.get(f"{course.first.name}.start", course.first.law.at(0.0))
            return np.asarray(start + self.speed * time)
        return self._coordinate(time)[0]

    def _coordinate(self, time: Floats) -> tuple[Floats, Floats]:
        """The same and its rate along a law."""
        known = np.isfinite(time)
        value, rate, _ = self.machine.course.first.law.coordinate(
            np.where(known, time, self.machine.course.begin)
        )
        return np.where(known, value, np.nan), np.where(known, rate, np.nan)

    # the way back ---------------------------------------------------------------------------------------
    def pull(self, bars: Mapping[str, Floats]) -> dict[str, Floats]:
        """From derivatives (designs,) by the numbers those by the designs' columns."""
        back = {name: np.zeros(self.count) for name in self.designs}
        for output, limits in self.limits.items():
            limits.bar[:] = limits.events.bar[:] = 0.0
            for kind in ("max", "min"):
                self._enter(back, limits, kind, bars, output)
            self._gather(back, *limits.pull())
            if limits.events.bar.any():
                design, by_columns, _ = limits.events.pull()
                self._gather(back, design, by_columns)
        return back

    def _enter(
        self, back: dict[str, Floats], limits: Limits, kind: str, bars: Mapping[str, Floats], output: Output
    ) -> None:
        place, nothing = limits.outermost[kind], np.zeros(self.count)
        has = place >= 0
        given = [
            np.where(has, bars.get(name(output, kind), nothing), 0.0)
            for name in (limit_name, limit_input_name, value_name)
        ]
        by_limit, by_input, by_value = given
        if self.sought.steady:
            by_limit, by_input = nothing, by_limit + by_input
        time = self._time(limits, kind)
        if self.machine.course.turns:
            name, rate = self.machine.course.first.name, self.speed
            for address, slope in ((f"{name}.speed", time), (f"{name}.start", np.ones(self.count))):
                if address in back:
                    back[address] += np.where(has, by_input * slope, 0.0)
        else:
            rate = self._coordinate(time)[1]
        np.add.at(limits.events.bar, place[has], (by_limit + by_input * rate)[has])
        np.add.at(limits.bar, place[has], by_value[has])

    def _gather(self, back: dict[str, Floats], design: Indices, by_columns: Mapping[str, Floats]) -> None:
        for name, each in by_columns.items():
            if name in back:
                np.add.at(back[name], design, each)
