"""Limit positions between which loads act, of one design after another, by steps from those of a first one."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.curves.pieces import HIGH, LOW
from linkwright.cycle.load_limits import LoadLimits
from linkwright.events.formula import NODE
from linkwright.formula.llvm_backend import CompiledProgram, compile_program
from linkwright.formula.table import Tables
from linkwright.kinetostatics.load_site import limit_input_name, limit_name, value_name

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
