"""Programs of derivatives, forward and reverse, evaluated at one design."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.derivative import forward, reverse
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.engine.states import states_as_fields
from linkwright.engine.sweep import Backend
from linkwright.errors import LinkwrightError
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.named import Quantity
from linkwright.kinetostatics.run import run_forces
from linkwright.study.load_slopes import LoadSlopes
from linkwright.study.traced import VALID, Traced
from linkwright.words.sentence import Sentence

Floats = NDArray[np.float64]


class Slopes:
    """Values and derivatives of quantities over the positions of a mechanism as it is.

    What groups without closed form carry is given as known numbers, from which the program does one more Newton
    step: its derivative is exact. Inputs from loads enter by the chain rule.
    """

    def __init__(
        self, traced: Traced, quantities: Mapping[str, Quantity], by: tuple[str, ...], backend: Backend
    ) -> None:
        self.traced = traced
        self.quantities = quantities
        self.by = by
        self.backend = backend
        self.program = states_as_fields(traced.program(quantities))
        self.fields = tuple(name for name in self.program.fields if name not in traced.nominal.states)
        self.own = tuple(by for by in by if by in self.program.parameters)
        self._rows: dict[str, Floats] = {}

    @cached_property
    def inputs(self) -> dict[str, Floats]:
        """All inputs per position apart from the drivers'."""
        states = dict(self.traced.nominal.states)
        return {**states, **{name: self.forces.fields[name] for name in self.fields}}

    @cached_property
    def forces(self) -> Forces:
        """Forces of the mechanism as it is."""
        return run_forces(self.traced.nominal, False)

    @cached_property
    def load_slopes(self) -> dict[str, dict[str, Floats]]:
        """Derivatives of every input from a load, by dimension."""
        if not self.fields:
            return {}
        slopes = LoadSlopes(self.traced, self.forces, self.by)
        return {name: slopes.of(name) for name in self.fields}

    def values(self, name: str) -> Floats:
        """The carrier of a quantity, (n,)."""
        return self._forward(name)[0]

    def forward(self, name: str) -> Floats:
        """Derivatives (dimensions, n) of a quantity."""
        values, slopes = self._forward(name)
        return np.where(np.isnan(slopes) & (values == 0.0), 0.0, slopes * self.quantities[name].slope(values))

    def reverse(self, name: str, weights: Floats) -> Floats:
        """Gradient (dimensions,) of the sum of ``weights`` times the quantity."""
        quantity = self.quantities[name]
        seeds = weights * quantity.slope(self.values(name))
        program = self.program.only([name, VALID])
        found = np.zeros(len(self.by))
        own = [by for by in self.by if by in program.parameters]
        if own:
            found[[self.by.index(by) for by in own]] = self._reversed(program, name, own, seeds)
        for place, by in enumerate(self.by):
            for each, slopes in self.load_slopes.items():
                if each in program.fields and slopes[by].any():
                    found[place] += float(seeds @ (self._by_field(name, each) * slopes[by]))
        return found

    def _reversed(self, program: Program, name: str, own: list[str], seeds: Floats) -> Floats:
        gradient = reverse(program, [name], own, VALID)
        nominal = self.traced.solver.nominal.parameters
        table = np.array([[nominal[each] for each in gradient.parameters]])
        known = {each: self.inputs[each] for each in program.fields}
        fields = {each: row[None, :] for each, row in {**known, f"seed:{name}": seeds}.items()}
        return np.array(gradient.evaluate(table, self.traced.arrays, fields, backend=self.backend)[1][0])

    def _forward(self, name: str) -> tuple[Floats, Floats]:
        """Carrier (n,) and its derivatives (dimensions, n)."""
        if name not in self._rows:
            program = self.program.only([name])
            own = [by for by in self.own if by in program.parameters]
            fields = [each for each in self.fields if each in program.fields]
            used = [each for each in fields if any(row.any() for row in self.load_slopes[each].values())]
            rows = self._run(forward(program, [*own, *used]))
            slopes = {by: rows.get(f"{name}|{by}", np.zeros_like(rows[name])) for by in self.by}
            for each in used:
                for by in self.by:
                    slopes[by] = slopes[by] + rows[f"{name}|{each}"] * self.load_slopes[each][by]
            self._rows |= {f"{name}|{each}": rows[f"{name}|{each}"] for each in used}
            self._rows[name] = np.stack([rows[name], *slopes.values()])
        found = self._rows[name]
        return found[0], found[1:]

    def _by_field(self, name: str, each: str) -> Floats:
        """Derivative of a quantity's carrier by an input per position."""
        self._forward(name)
        return self._rows[f"{name}|{each}"]

    def _run(self, program: Program) -> dict[str, Floats]:
        numbers, arrays = self.traced.numbers(program), self.traced.arrays
        inputs = {name: self.inputs[name] for name in program.fields}
        return dict(zip(program.output_names, self._evaluated(program, numbers, arrays, inputs), strict=True))

    def _evaluated(
        self, program: Program, numbers: Floats, arrays: Mapping[str, Floats], inputs: Mapping[str, Floats]
    ) -> Floats:
        if self.backend == "llvm":
            from linkwright.engine.llvm_backend import compile_program

            compiled = compile_program(program)
            if compiled is None:
                raise LinkwrightError(Sentence("study.no_llvmlite"))
            rows = {name: row[None, :] for name, row in inputs.items()}
            return np.array(
                compiled.store(numbers[None, :], arrays, rows, length=self.traced.positions.count)[0]
            )
        return NumpyProgram(program).run(numbers, arrays, inputs, length=self.traced.positions.count)
