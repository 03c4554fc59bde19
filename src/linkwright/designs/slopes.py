"""Programs of derivatives, forward and reverse, evaluated at one design."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.designs.known_loads import KnownLoads
from linkwright.designs.loaded_cycle import RUBBING, friction_doubt
from linkwright.designs.traced_outputs import VALID, Traced
from linkwright.errors import LinkwrightError
from linkwright.formula.derivative import forward, reverse
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.summaries import Backend
from linkwright.kinetostatics.load_site import middle_name
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.words import _


class Slopes:
    """Values and derivatives of quantities over the positions of a mechanism as it is.

    What groups without closed form carry is given as known numbers, from which the program does one more Newton
    step: its derivative is exact. Limit positions between which loads act enter by the chain rule.
    """

    def __init__(
        self,
        traced: Traced,
        quantities: Mapping[str, Quantity],
        by: tuple[str, ...],
        backend: Backend,
        loads: KnownLoads,
    ) -> None:
        self.traced, self.quantities, self.by = traced, quantities, by
        self.backend, self.loads = backend, loads
        self.program = _known_as_fields(traced.program(quantities, {RUBBING: friction_doubt(traced)}))
        self.own = tuple(each for each in by if each in self.program.parameters)
        self.moving = tuple(each for each in loads.slopes if each in self.program.parameters)
        self._rows: dict[str, Floats] = {}

    @cached_property
    def inputs(self) -> dict[str, Floats]:
        """All inputs per position except the drivers'."""
        return {**self.traced.nominal.states, **self.loads.fields}

    @cached_property
    def numbers(self) -> dict[str, float]:
        """All that the program takes of the mechanism."""
        return {**self.traced.solver.nominal.parameters, **self.loads.numbers}

    @property
    def certain(self) -> bool:
        """Whether the friction is, at all positions."""
        return not self.loads.rubbing or not self.values(RUBBING).any()

    def values(self, name: str) -> Floats:
        """The carrier of a quantity, (n,)."""
        return np.asarray(self._forward(name)[0])

    def forward(self, name: str) -> Floats:
        """Derivatives (dimensions, n) of a quantity."""
        found = self._forward(name)
        values, slopes = found[0], found[1:]
        return np.where(np.isnan(slopes) & (values == 0.0), 0.0, slopes * self.quantities[name].slope(values))

    def reverse(self, name: str, weights: Floats) -> Floats:
        """Gradient (dimensions,) of the sum of ``weights`` times the quantity."""
        seeds = weights * self.quantities[name].slope(self.values(name))
        program = self.program.only([name, VALID])
        by = [each for each in (*self.own, *self.moving) if each in program.parameters]
        found = np.zeros(len(self.by))
        if not by:
            return found
        gradient = reverse(program, [name], by, VALID)
        table = np.array([[self.numbers[each] for each in gradient.parameters]])
        known = {each: self.inputs[each] for each in program.fields}
        fields = {each: row[None, :] for each, row in {**known, f"seed:{name}": seeds}.items()}
        slopes = gradient.evaluate(table, self.traced.arrays, fields, tables=self.loads.tables, backend=self.backend)[
            1
        ][0]
        for each, slope in zip(by, slopes, strict=True):
            found += slope * self._by(each)
        return found

    def _by(self, parameter: str) -> Floats:
        """Derivatives (dimensions,) of a parameter of the program."""
        if parameter in self.loads.slopes:
            return self.loads.slopes[parameter]
        return np.array([1.0 if each == parameter else 0.0 for each in self.by])

    def _forward(self, name: str) -> Floats:
        """Carrier (n,) and its derivatives (dimensions, n) below it."""
        if name not in self._rows:
            program = self.program.only([name])
            by = [each for each in (*self.own, *self.moving) if each in program.parameters]
            rows = self._run(forward(program, by))
            slopes = np.zeros((len(self.by), len(rows[name])))
            for each in by:
                if f"{name}|{each}" in rows:
                    slopes += self._by(each)[:, None] * rows[f"{name}|{each}"]
            self._rows[name] = np.vstack([rows[name], slopes])
        return self._rows[name]

    def _run(self, program: Program) -> dict[str, Floats]:
        numbers = np.array([self.numbers[each] for each in program.parameters])
        inputs = {name: self.inputs[name] for name in program.fields}
        return dict(zip(program.output_names, self._evaluated(program, numbers, inputs), strict=True))

    def _evaluated(self, program: Program, numbers: Floats, inputs: Mapping[str, Floats]) -> Floats:
        arrays, count, tables = self.traced.arrays, self.traced.positions.count, self.loads.tables
        if self.backend == "llvm":
            from linkwright.formula.llvm_backend import compile_program

            compiled = compile_program(program)
            if compiled is None:
                raise LinkwrightError(
                    _("llvmlite cannot be loaded: install it, or use the numpy back end", code="study.no_llvmlite")
                )
            rows = {name: row[None, :] for name, row in inputs.items()}
            return np.array(compiled.store(numbers[None, :], arrays, rows, length=count, tables=tables)[0])
        return NumpyProgram(program).run(numbers, arrays, inputs, length=count, tables=tables)


def _known_as_fields(program: Program) -> Program:
    """The program with the angles near which angles stay taken per position."""
    known = middle_name("", "").partition(":")[0]
    return program.with_inputs([name for name in program.parameters if name.startswith(f"{known}:")])
