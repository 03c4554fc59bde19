"""Programs whose last inputs follow from their first outputs, evaluated again and again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.formula.functions import FUNCTIONS
from linkwright.formula.machine_code import available
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.table import Tables

Arrays = Mapping[str, Floats]
Found = Callable[[Floats], Mapping[str, Any] | None]
Compiled = Callable[[Floats], Floats]

#: From this evaluation over the same positions on the program is compiled, where that gives the same bits.
REPEATED = 100


class InTurn:
    """A program of which the first outputs, so many as are ``early``, need none of the ``late`` inputs.

    By NumPy in one pass. What is evaluated again and again is compiled, in two parts, where all its operations are
    those that are rounded alike everywhere: results do not depend on what was evaluated before, to the last bit.
    """

    def __init__(self, program: Program, early: int, late: set[str]) -> None:
        self.program = program.last(late)
        self.early = early
        self._numpy = NumpyProgram(self.program, late)
        self._over: Recent[Arrays, _Over] = Recent(4)

    def run(
        self, parameters: Mapping[str, float], positions: Arrays, late: Found, length: int, tables: Tables
    ) -> Floats | None:
        """Outputs (outputs, n) of one design; arguments as for :meth:`NumpyProgram.run_in_turn`."""
        over = self._over.get(positions, None, _Over)
        over.calls += 1
        if over.calls < REPEATED or self._parts is None:
            return self._numpy.run_in_turn(
                parameters, positions, late, early=self.early, length=length, tables=tables
            )
        first, second = self._parts
        if over.code is None:
            over.code = self._bind(positions)
        run_first, run_second = over.code
        found = np.empty((len(self.program.outputs), length))
        found[: self.early] = run_first(np.array([parameters[name] for name in first.parameters]))
        given = late(found)
        if given is None:
            return None
        known = {**parameters, **given}
        found[self.early :] = run_second(np.array([known[name] for name in second.parameters]))
        return found

    @cached_property
    def _parts(self) -> tuple[Program, Program] | None:
        """Programs of the early and of the other outputs; None where code would not have the same bits."""
        program, names = self.program, list(self.program.output_names)
        if program.fields or not available():
            return None
        if not all(op in _ALIKE for op, args, *_ in program.entries if args):
            return None
        return program.only(names[: self.early]), program.only(names[self.early :])

    def _bind(self, positions: Arrays) -> tuple[Compiled, Compiled]:
        """The parts as code over some positions."""
        from linkwright.formula.llvm_backend import compile_program

        assert self._parts is not None
        parts = [compile_program(part, exact=True) for part in self._parts]
        first, second = (part.repeated(positions) for part in parts if part is not None)
        return first, second


@dataclass
class _Over:
    """How often a program was evaluated over some positions, and its parts compiled for them."""

    calls: int = 0
    code: tuple[Compiled, Compiled] | None = None


#: Operations that every back end rounds alike.
_ALIKE = {"add", "sub", "mul", "div", "neg", "less", "less_equal", "and", "or", "not", "select", "stop"} | {
    op for op, function in FUNCTIONS.items() if function.exact
}
