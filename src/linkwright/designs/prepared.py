"""A mechanism prepared to be solved again and again with other dimensions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.given import one_of, require
from linkwright.designs.loaded_cycle import LoadedCycle, loaded_cycle
from linkwright.designs.traced_outputs import Traced
from linkwright.designs.varied_dimensions import checked_addresses
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.summaries import BACKENDS, Backend
from linkwright.formula.trace import select
from linkwright.kinematics.change_points import nearness, parts
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.design import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.passing_proof import NEAR
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import forces_of_run
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism

#: The row of how near a group is to a change point or a gap; 0 where it cannot be assembled, where a load has no
#: value, and where friction is not certain.
NEAREST = "nearest change point"


def prepare(
    mechanism: Mechanism, *, vary: Iterable[str] = (), steps: int = 360, backend: Backend = "auto"
) -> Prepared:
    """Traces and compiles a mechanism once, so that every further design costs little more than its numbers.

    Args:
        mechanism: the design to start from.
        vary: addresses of dimensions that will change (``pitman.length``), or names of parameters.
        steps: positions over the cycle.
        backend: ``llvm`` compiled code, ``numpy``, or ``auto``: compiled code where llvmlite is there.

    Raises:
        LinkwrightError: an unknown address (nearest ones offered), or ``llvm`` without llvmlite.
    """
    require(mechanism, Mechanism)
    one_of("backend", backend, BACKENDS)
    return Prepared(mechanism, checked_addresses(mechanism, vary), over_cycle(mechanism, steps), backend)


class Prepared:
    """Solves designs of one mechanism; made by :func:`prepare`.

    The assembly modes are those of the starting design; positions are those of its input.
    """

    def __repr__(self) -> str:
        return f"Prepared({self.mechanism.name!r}: {', '.join(self.vary)}; {self.positions.count} positions)"

    def __init__(
        self, mechanism: Mechanism, vary: tuple[str, ...], positions: Positions, backend: Backend
    ) -> None:
        self.mechanism = mechanism
        self.vary = vary
        self.positions = positions
        self.backend = backend
        self._loaded = self._loaded_cycle()
        self.solver = self._loaded.traced.solver
        self.force_solver = ForceSolver(self.solver)
        self._sizes = self._loaded.sizes
        motion, forces = self.solver.outputs.standard, self.force_solver.outputs.standard
        self._names = (*motion[:-1], *forces, *self._sizes, NEAREST, "outcome")
        self._index = {name: i for i, name in enumerate(self._names)}
        self.program = self._trace()
        self._evaluate = self._evaluator(backend)
        known = {**self.solver.nominal.parameters, **self._loaded.constants}
        self._base = np.array([known.get(name, np.nan) for name in self.program.parameters])
        self._places = {name: i for i, name in enumerate(self.program.parameters)}
        plain = not self.program.fields
        self._at_once = plain and positions.is_way and parts(self.solver, positions) == 1
        self._modes = self.solver.assembly.modes
        self._checked = False

    def __reduce__(self) -> tuple[type[Prepared], tuple[object, ...]]:
        return Prepared, (self.mechanism, self.vary, self.positions, self.backend)

    def _loaded_cycle(self) -> LoadedCycle:
        """The mechanism with its loads and friction traced, where they can be; else without them."""
        plain = Traced(self.mechanism, self.vary, self.positions)
        fields = plain.forces.fields_needed()
        tracked = bool(plain.solver.motion.next_states)
        return (not tracked and loaded_cycle(plain, self.vary, fields)) or LoadedCycle(plain)

    def _trace(self) -> Program:
        traced = self._loaded.traced
        motion, trace = traced.solver.outputs, traced.solver.motion.trace
        others = [name for name in self._names if name != NEAREST and name not in self._sizes]
        values = {
            name: (motion if name in motion.standard else traced.forces.outputs).value(name)
            for name in others
        } | self._sizes
        solved = trace.logic("and", traced.solver.motion.valid, self._loaded.sound)
        values[NEAREST] = select(solved, nearness(self.solver), 0.0)
        values["outcome"] = values.pop("outcome")
        return Program.of(trace, values)

    def _evaluator(self, backend: Backend) -> Callable[[Floats], Floats]:
        arrays, tables = self.positions.arrays, self._loaded.loads.tables
        arrays = {name: arrays[name] for name in self.program.positions}
        if backend != "numpy":
            able = bool(self.program.positions) and not self.program.fields
            compiled = compile_program(self.program) if able else None
            if compiled is not None:
                return compiled.repeated(arrays, tables=tables)
            if backend == "llvm":
                raise LinkwrightError("study.not_compiled")
        evaluator = numpy_program(self.program)
        return lambda table: evaluator.run(table, arrays, length=self.positions.count, tables=tables)

    def solve(self, changes: Mapping[str, float], *, failures: Literal["raise", "mark"] = "raise") -> Forces:
        """Motion and forces of the design with some dimensions changed (SI values by address).

        Raises:
            LinkwrightError: a dimension that is zero in the starting design, and was not named in ``vary``.
            PositionError: a position cannot be reached, and ``failures`` is ``raise``.
        """
        require(changes, Mapping)
        design = Design(self.mechanism, self._modes, changes)
        values = self._values(changes) if self._at_once else None
        if values is None or is_near(values[-2]):
            return self._solve_alone(design, failures)
        if not self._checked:
            self._check(design)
        motion = Motion(self.solver, design, self.positions, Rows(values, self._index))
        fields = {name: values[self._index[name]] for name in self._sizes}
        return Forces(motion, self.force_solver, fields, False, motion.rows)

    def _check(self, design: Design) -> None:
        """Raises SelfCheckError where the forces of the design by itself, whose formulas were compiled, say so."""
        forces_of_run(MotionRun(self.solver.for_design(design), self.positions), False, "mark")
        self._checked = True

    def _values(self, changes: Mapping[str, float]) -> Floats | None:
        """Outputs (names, n); None where the limits between which loads act are not certain."""
        numbers = self._base.copy()
        for address, value in changes.items():
            if address in self._places:
                numbers[self._places[address]] = value
            elif address not in self.vary:
                self._refuse_fixed(address)
        free = self.solver.manner.free
        if self._loaded.limits is not None:
            if not free.issuperset(changes):
                return None
            known = {name: changes.get(name, self.mechanism.dimension(name)) for name in free}
            found = self._loaded.limits.solve({name: np.array([value]) for name, value in known.items()})
            if not found.certain.all():
                return None
            for name in found.numbers.keys() & self._places.keys():
                numbers[self._places[name]] = found.numbers[name].item()
        return self._evaluate(numbers)

    def _refuse_fixed(self, address: str) -> None:
        """Refuses a dimension that the programs hold as a known zero, or do not know."""
        if self.mechanism.dimension(address) == 0.0:
            raise RequestError("study.zero_not_named", address=address)

    def _solve_alone(self, design: Design, failures: str) -> Forces:
        """As a machine by itself: where loads are not traced, or change points and gaps may lie between positions."""
        for address in set(design.changes) - set(self.vary):
            self._refuse_fixed(address)
        solver = self.solver.for_design(design)
        return forces_of_run(MotionRun(solver, self.positions), False, failures)


def is_near(row: Floats) -> bool:
    """Whether a change point or a gap may lie between two positions, by how near every position (n,) is to one."""
    least, most = row.item(row.argmin()), row.item(row.argmax())  # many times faster than min and max
    if least - NEAR > most - least:  # no step is longer than all of them together
        return False
    steps = row[1:] - row[:-1]
    return bool(least - NEAR < max(steps[steps.argmax()], -steps[steps.argmin()]))
