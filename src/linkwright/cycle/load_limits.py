"""Limit positions between which loads act, in many designs at once, as numbers that programs over positions take."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from math import pi

import numpy as np

from linkwright.applied_loads.signals import BetweenLimits
from linkwright.core.arrays import Flags, Floats
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.cycle import Block, ByColumns, Swings
from linkwright.cycle.machine import Machine
from linkwright.events.events import Limits
from linkwright.events.formula import NODE, ROW
from linkwright.formula.llvm_backend import CompiledProgram, compile_program
from linkwright.formula.table import Tables
from linkwright.kinetostatics.load_site import DRIFT, LAP, limit_input_name, limit_name, turns_steadily, value_name
from linkwright.kinetostatics.signals import MotionSignals

#: Designs of which limits are sought together.
BLOCK = 1024


class LoadLimits:
    """The limits of the outputs between which loads with these ``phases`` act; ``numbers``: of the cycle, the same
    for all designs."""

    def __init__(self, machine: Machine, phases: Iterable[BetweenLimits]) -> None:
        self.machine = machine
        self.phases = tuple(phases)
        self.outputs = tuple(dict.fromkeys(phase.output for phase in self.phases))
        self.swings = Swings(machine, self.outputs, self.outputs)
        self.steady = turns_steadily(machine.mechanism)

    @cached_property
    def numbers(self) -> dict[str, float]:
        """How long the cycle is, and what the input gains in it."""
        course = self.machine.course
        lap = course.duration * (abs(course.first.law.constant_speed or 0.0) if self.steady else 1.0)
        if course.turns:
            lap = 2.0 * pi * course.turns
        drift = MotionSignals(self.machine.nominal).full_cycle.drift
        return {LAP: lap * (1.0 if course.closed else 2.0), DRIFT: drift}

    @property
    def dimensions(self) -> frozenset[str]:
        """Dimensions that vary on which they depend."""
        return self.machine.taken(self.swings.formulas)

    def solve(self, columns: Mapping[str, Floats]) -> FoundLimits:
        """Those of designs with some columns (designs,)."""
        count = len(next(iter(columns.values()))) if columns else 1
        return FoundLimits(
            [
                _Block(self, {name: each[first : first + BLOCK] for name, each in columns.items()})
                for first in range(0, count, BLOCK)
            ]
        )


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
        self.sought = sought
        arrays = {name: np.asarray(each, dtype=float) for name, each in columns.items()}
        self.count = len(next(iter(arrays.values()))) if arrays else 1
        self.block = Block(sought.swings, {**arrays, ROW: np.arange(float(self.count))}, self.count)
        self.numbers = self._numbers()
        self.certain = np.ones(self.count, dtype=np.bool_)
        for phase in sought.phases:
            self.certain &= self._fits(phase)

    def _numbers(self) -> dict[str, Floats]:
        found = {}
        for output in self.sought.outputs:
            limits = self.block.limits.get(output)
            for kind in ("max", "min"):
                time = np.full(self.count, np.nan) if limits is None else _time(limits, kind)
                there = self.block.input_at(time)
                found[limit_name(output, kind)] = there if self.sought.steady else time
                found[limit_input_name(output, kind)] = there
                found[value_name(output, kind)] = time if limits is None else limits.at(kind)
        return found

    def _fits(self, phase: BetweenLimits) -> Flags:
        """Whether a load with the phase acts between two limits alone."""
        limits = self.block.limits.get(phase.output)
        if limits is None:
            return np.zeros(self.count, dtype=np.bool_)
        found = limits.single(outermost=phase.outermost)
        if not self.block.span.course.closed:
            with np.errstate(invalid="ignore"):
                found &= _time(limits, phase.end) > _time(limits, phase.start)
        return found

    def pull(self, bars: Mapping[str, Floats]) -> dict[str, Floats]:
        """From derivatives (designs,) by the numbers those by the designs' columns."""
        back, nothing = ByColumns(self.block), np.zeros(self.count)
        self.block.forget()
        for output, limits in self.block.limits.items():
            for kind in ("max", "min"):
                place = limits.outermost[kind]
                has = place >= 0
                by_limit, by_input, by_value = (
                    np.where(has, bars.get(name(output, kind), nothing), 0.0)
                    for name in (limit_name, limit_input_name, value_name)
                )
                if self.sought.steady:
                    by_limit, by_input = nothing, by_limit + by_input
                by_time = by_limit + self.block.pull_input(by_input, _time(limits, kind), back)
                np.add.at(limits.events.bar, place[has], by_time[has])
                np.add.at(limits.bar, place[has], by_value[has])
        self.block.pull(back)
        return back.found


def _time(limits: Limits, kind: str) -> Floats:
    """When an output has its largest or smallest value, (designs,) s."""
    return np.append(limits.events.time, np.nan)[limits.outermost[kind]]


#: Newton's steps at most, and the change of the input in the last one that ends them well, rad.
STEPS, CONVERGED = 6, 1e-9


class NearLimits:
    """Limits of designs that have as many as the machine as it is, each kind once, which turns steadily.

    Whether a design has no others is for its caller to see, from the signs of the rates at its positions.
    """

    def __init__(
        self, sought: LoadLimits, place: Mapping[str, int], code: CompiledProgram, inputs: Mapping[str, float]
    ) -> None:
        machine, order = sought.machine, [(each, kind) for each in sought.outputs for kind in ("max", "min")]
        law = machine.course.first.law
        self._speed, self._begin = float(law.constant_speed or 0.0), law.at(0.0)
        lanes = -(-len(order) // code.width) * code.width
        self._names = [name(*each) for name in (limit_name, limit_input_name, value_name) for each in order]
        times = [(inputs[limit_name(*each)] - self._begin) / self._speed for each in order]
        self._count, self._times, self._lane = len(order), np.resize(times, lanes), np.arange(lanes)
        output = [sought.outputs.index(each) for each, _ in order]
        self._rate = np.resize([place[f"rate {k}"] for k in output], lanes)
        self._value = np.resize([place[f"value {k}"] for k in output], lanes)
        numbers = {**machine.known.numbers, NODE: 0.0}
        self._numbers = np.array([numbers[name] for name in code.program.parameters])
        self._own = _Lanes(code, code.program.positions, lanes, machine.known.tables)

    @classmethod
    def of(cls, sought: LoadLimits, values: Mapping[str, float]) -> NearLimits | None:
        """From those of the design with ``values``; None where its limits are not certain, or no code is compiled."""
        start = sought.solve({name: np.array([value]) for name, value in values.items()})
        machine, outputs = sought.machine, sought.outputs
        if not (sought.steady and start.certain.all()):
            return None
        traces = machine.traces
        both = machine.formula(
            ("rates and values", outputs),
            lambda: (
                {f"rate {k}": traces.rates(each) for k, each in enumerate(outputs)}
                | {f"value {k}": traces.value(each) for k, each in enumerate(outputs)}
            ),
        ).with_slope
        code = compile_program(both.program)
        if code is None:
            return None
        return cls(sought, both.place, code, {name: float(each[0]) for name, each in start.numbers.items()})

    def numbers(self, values: Mapping[str, float]) -> dict[str, float] | None:
        """Their numbers of the design with these values of the dimensions that vary; None where Newton's steps do not
        come to an end."""
        columns, run, time, lane = self._own.columns, self._own.run, self._times, self._lane
        for name in columns.keys() - {LOW, HIGH}:
            columns[name].fill(values[name])
        for _ in range(STEPS):
            columns[LOW][:] = time
            np.add(time, 1.0, out=columns[HIGH])
            found = run(self._numbers)
            step = found[self._rate, lane] / found[self._rate + 1, lane]
            time = time - step
            if float(np.abs(step).max()) * abs(self._speed) <= CONVERGED:
                at, value = self._begin + self._speed * time, found[self._value, lane]
                own = [each[: self._count] for each in (at, at, value)]
                return dict(zip(self._names, np.concatenate(own).tolist(), strict=True))
        return None


class _Lanes(threading.local):
    """The columns of the places of one thread, written where they lie, and the code that reads them there."""

    def __init__(self, code: CompiledProgram, names: Iterable[str], lanes: int, tables: Tables | None) -> None:
        self.columns: dict[str, Floats] = {name: np.empty(lanes) for name in names}
        self.run = code.repeated(self.columns, tables=tables)
