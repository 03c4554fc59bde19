"""A mechanism prepared to be solved again and again with other dimensions."""

from __future__ import annotations

import threading
from array import array
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from math import inf
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.given import one_of, require
from linkwright.core.outputs import Output, row_name
from linkwright.cycle.load_limits import NearLimits
from linkwright.designs.loaded_cycle import LoadedCycle, along_input, with_limits
from linkwright.designs.traced_outputs import Traced
from linkwright.designs.varied_dimensions import checked_addresses
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.machine_code import available
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.summaries import BACKENDS, Backend
from linkwright.formula.trace import Mask, Scalar, absolute, minimum, select, sign
from linkwright.kinematics.change_points import nearness, parts
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.design import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.names import program_names
from linkwright.kinematics.passing_proof import NEAR
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.load_site import LAP, limit_name
from linkwright.kinetostatics.run import forces_of_run
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.kinetostatics.traced_loads import AlongInput, traced_magnitude
from linkwright.loads.strokes import turned
from linkwright.mechanism.mechanism import Mechanism

#: The row of how near a group is to a change point or a gap; 0 where it cannot be assembled, where a load has no
#: value, and where limit positions do not agree with the rates.
NEAREST = "nearest change point"
#: The step of the input between two positions, rad; how near to a limit, rad, a position counts as on it.
STEP, AT = "step of the input", 1e-9


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
        self._loads = _Followed.of(self)
        self.solver = self._loads.traced.solver
        self.force_solver = ForceSolver(self.solver)
        motion, forces = self.solver.outputs.standard, self.force_solver.outputs.standard
        self._names = (*motion[:-1], *forces, *self._loads.fields, NEAREST, "outcome")
        self._index = {name: i for i, name in enumerate(self._names)}
        self.program = self._trace()
        self._evaluate = self._evaluator(backend)
        known = {**self.solver.nominal.parameters, **self._loads.known}
        self._base = array("d", [known.get(name, np.nan) for name in self.program.parameters])
        self._places = {name: i for i, name in enumerate(self.program.parameters)}
        self._own = _Numbers(self._base)
        plain = not self.program.fields
        self._at_once = plain and positions.is_way and parts(self.solver, positions) == 1
        self._modes = self.solver.assembly.modes
        self._checked = False

    def __reduce__(self) -> tuple[type[Prepared], tuple[object, ...]]:
        return Prepared, (self.mechanism, self.vary, self.positions, self.backend)

    def _trace(self) -> Program:
        motion, forces = self.solver.outputs, self._loads.traced.forces.outputs
        sizes = self._loads.sizes
        others = [name for name in self._names if name != NEAREST and name not in sizes]
        values = {
            name: (motion if name in motion.standard else forces).value(name) for name in others
        } | sizes
        distance = select(self._loads.sound, nearness(self.solver), 0.0)
        values[NEAREST] = select(self.solver.motion.valid, distance, 0.0)
        values["outcome"] = values.pop("outcome")
        return Program.of(self.solver.motion.trace, values)

    def _evaluator(self, backend: Backend) -> Callable[[Floats], Floats]:
        arrays = {name: self.positions.arrays[name] for name in self.program.positions}
        if backend != "numpy":
            able = bool(self.program.positions) and not self.program.fields
            compiled = compile_program(self.program) if able else None
            if compiled is not None:
                return compiled.repeated(arrays, tables=self._loads.tables)
            if backend == "llvm":
                raise LinkwrightError("study.not_compiled")
        evaluator = numpy_program(self.program)
        return lambda table: evaluator.run(table, arrays, length=self.positions.count)

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
        motion = Motion(self.solver, design, self.positions, {}, {}, Rows(values, self._index))
        fields = {name: values[self._index[name]] for name in self._loads.fields}
        return Forces(motion, self.force_solver, fields, False, motion.rows)

    def _check(self, design: Design) -> None:
        """Raises SelfCheckError where the forces of the design by itself, whose formulas were compiled, say so."""
        forces_of_run(MotionRun(self.solver.for_design(design), self.positions), False, "mark")
        self._checked = True

    def _values(self, changes: Mapping[str, float]) -> Floats | None:
        """Outputs (names, n); None where nothing is known of the loads' limit positions."""
        numbers = self._own.numbers
        numbers[:] = self._base
        for address, value in changes.items():
            place = self._places.get(address)
            if place is not None:
                numbers[place] = value
            elif address not in self.vary:
                self._refuse_fixed(address)
        if self._loads.fields and not self._loads.limit(changes, numbers, self._places):
            return None
        return self._evaluate(self._own.table)

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


class _Numbers(threading.local):
    """One thread's numbers of a program, written through ``numbers``, read as ``table`` where they lie."""

    def __init__(self, base: array[float]) -> None:
        self.numbers = base[:]
        self.table: Floats = np.frombuffer(self.numbers)


def is_near(row: Floats) -> bool:
    """Whether a change point or a gap may lie between two positions, by how near every position (n,) is to one."""
    least, most = row.item(row.argmin()), row.item(row.argmax())  # many times faster than min and max
    if least - NEAR > most - least:  # no step is longer than all of them together
        return False
    steps = row[1:] - row[:-1]
    return bool(least - NEAR < max(steps[steps.argmax()], -steps[steps.argmin()]))


class _Followed:
    """Loads and friction that a compiled program traces, with what finds limit positions before."""

    def __init__(self, loaded: LoadedCycle) -> None:
        self.traced, self.loads, self.sought = loaded.traced, loaded.loads, loaded.limits
        self.tables = self.loads.tables
        rubbing = self.traced.forces.programs.friction
        self.friction = {} if rubbing is None else rubbing.sizes
        self.fields = (*(row_name("magnitude", name) for name in sorted(self.loads.names)), *self.friction)
        lap = loaded.constants.get(LAP, 0.0)
        self.known = {**loaded.constants, STEP: lap / self.traced.positions.count}

    @classmethod
    def of(cls, prepared: Prepared) -> _Followed:
        """The loads of a mechanism, where they can be traced and code can be compiled; else none."""
        mechanism, vary, positions = prepared.mechanism, prepared.vary, prepared.positions
        plain = Traced(mechanism, vary, positions)
        fields = plain.forces.fields_needed()
        nothing = AlongInput(frozenset())
        if not fields or prepared.backend == "numpy" or not available() or plain.solver.motion.next_states:
            return cls(LoadedCycle(plain, nothing, None, {}))
        loads = along_input(plain, vary, fields) or nothing
        return cls(with_limits(plain, loads) or LoadedCycle(plain, nothing, None, {}))

    @cached_property
    def sizes(self) -> dict[str, Scalar]:
        """Their magnitudes, by the names of the fields that forces know them by."""
        motion = self.traced.solver.motion
        loads = {
            row_name("magnitude", name): traced_magnitude(motion, name) for name in sorted(self.loads.names)
        }
        return {**loads, **self.friction}

    @cached_property
    def sound(self) -> Mask:
        """Whether every load has a value, limit positions are those of the rates, and the friction is certain."""
        found = agree(self.traced, self.loads.outputs)
        rubbing = self.traced.forces.programs.friction
        if rubbing is not None:
            found = self.traced.solver.motion.trace.logic("and", found, rubbing.certain)
        for name in self.loads.fallible:
            has = absolute(self.sizes[row_name("magnitude", name)]) < inf
            found = self.traced.solver.motion.trace.logic("and", found, has)
        return found

    # limit positions ----------------------------------------------------------------------------
    def limit(self, changes: Mapping[str, float], numbers: array[float], places: Mapping[str, int]) -> bool:
        """Writes a design's limit positions among the numbers of the program; False where they are not found.

        By Newton's steps from those of the mechanism as it is.
        """
        if not self._of_drivers.isdisjoint(changes):
            return False
        if self.sought is None:
            return True
        found = None if self._near is None else self._near.limits({**self._nominal, **changes})
        for name, value in (found or {}).items():
            if name in places:
                numbers[places[name]] = value
        return found is not None

    @cached_property
    def _nominal(self) -> dict[str, float]:
        """The dimensions that vary in the mechanism as it is."""
        return {name: self.traced.mechanism.dimension(name) for name in self.traced.solver.manner.free}

    @cached_property
    def _near(self) -> NearLimits | None:
        """What finds limits from those of the mechanism as it is; None where these are not just two."""
        assert self.sought is not None
        found = self.sought.solve({name: np.array([value]) for name, value in self._nominal.items()})
        return NearLimits(self.sought, found) if found.certain.all() else None

    @cached_property
    def _of_drivers(self) -> frozenset[str]:
        """Addresses of the drivers' dimensions, where there are loads."""
        mechanism = self.traced.mechanism
        known = mechanism.dimensions() if self.fields else ()
        return frozenset(name for name in known if name.rpartition(".")[0] in mechanism.drivers)


def agree(traced: Traced, outputs: Iterable[Output]) -> Mask:
    """Whether every output falls at this position just where it lies between the limits ``max`` and ``min``, with
    positions on both ways; on a limit its rate may have either sign."""
    motion, logic = traced.solver.motion, traced.solver.motion.trace.logic
    found: Mask = True
    for output in outputs:
        (driver,) = traced.mechanism.drivers
        sense = sign(motion.trace.parameter(f"{driver}.speed"))
        step, lap = motion.trace.parameter(STEP), motion.trace.parameter(LAP)
        highest, lowest = (motion.trace.parameter(limit_name(output, kind)) for kind in ("max", "min"))
        way = turned(sense * (motion.trace.position("input") - highest), lap)
        length = turned(sense * (lowest - highest), lap)
        gone = way - length
        rate = traced.solver.outputs.value(program_names(traced.mechanism, output)[1][0])
        beside = minimum(minimum(way, lap - way), absolute(gone)) <= AT
        apart = minimum(length, lap - length) > step
        found = logic("and", found, logic("and", apart, logic("or", rate * gone >= 0.0, beside)))
    return found
