"""A mechanism prepared to be solved again and again with other dimensions."""

from __future__ import annotations

import threading
from array import array
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property, partial
from math import inf
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.given import one_of, require
from linkwright.core.outputs import row_name
from linkwright.cycle_programs.limit_stages import CONVERGED, agree, constants, limit_stages, near_limits
from linkwright.cycle_programs.loaded_cycle import along_input, with_loads
from linkwright.cycle_programs.traced_outputs import Traced
from linkwright.engine.call_block import address_of
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.llvm_backend import CompiledProgram, compile_program
from linkwright.engine.machine_code import OF_ONE_ADDRESS, available
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.summaries import BACKENDS, Backend
from linkwright.engine.trace import Mask, Scalar, absolute, select
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.change_points import nearness, parts
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.design import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.passing_proof import NEAR
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.load_site import limit_name
from linkwright.kinetostatics.run import forces_of_run
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.kinetostatics.traced_loads import AlongInput, traced_magnitude
from linkwright.mechanism.mechanism import Mechanism
from linkwright.study.varied_dimensions import checked_addresses

#: The row of how near a group is to a change point or a gap; 0 where it cannot be assembled, where a load has no
#: value, and where limit positions do not agree with the rates.
NEAREST = "nearest change point"
#: Lanes in which limit positions are looked for beside each other, as many as a processor may have.
LANES = 8


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
        plain = not (self.program.fields or self.program.states)
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
            able = bool(self.program.positions) and not (self.program.states or self.program.fields)
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

    def __init__(self, traced: Traced, loads: AlongInput) -> None:
        self.traced, self.loads = traced, loads
        self.tables = loads.tables
        rubbing = traced.forces.programs.friction
        self.friction = {} if rubbing is None else rubbing.sizes
        self.fields = (*(row_name("magnitude", name) for name in sorted(loads.names)), *self.friction)
        self.known = {**constants(traced), **loads.constants}
        self._own = threading.local()

    @classmethod
    def of(cls, prepared: Prepared) -> _Followed:
        """The loads of a mechanism, where they can be traced and code can be compiled; else none."""
        mechanism, vary, positions = prepared.mechanism, prepared.vary, prepared.positions
        plain = Traced(mechanism, vary, positions)
        fields = plain.forces.fields_needed()
        nothing = AlongInput(frozenset())
        if not fields or prepared.backend == "numpy" or not available() or plain.solver.motion.next_states:
            return cls(plain, nothing)
        loads = along_input(plain, vary, fields) or nothing
        return cls(with_loads(plain, loads), loads)

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
        if not self.loads.outputs:
            return True
        newton: _Newton | None = getattr(self._own, "newton", None)
        if newton is None:
            if self._begin is None:
                return False
            newton = self._own.newton = _Newton(*self._begin, places)
        return newton.limit(changes, numbers)

    @cached_property
    def _begin(self) -> tuple[CompiledProgram, array[float], dict[str, Floats]] | None:
        """Newton's steps compiled, their numbers, and the limits where they begin."""
        outputs, valued = self.loads.outputs, self.loads.valued
        cycle = CycleProgram(tuple(limit_stages(self.traced, outputs, valued=valued)))
        compiled = compile_program(near_limits(self.traced, outputs, valued))
        if compiled is None:
            return None
        known = {**self.traced.solver.nominal.parameters, **self.known}
        table, positions = [[known[name] for name in cycle.dimensions]], self.traced.positions.arrays
        found = cycle.evaluate(table, positions, tables=self.tables, threads=1, backend="llvm")
        if any(found[f"doubt:{output}"][0] != 0.0 for output in outputs):
            return None
        starts = {
            f"near:{output}": np.resize(
                [found[limit_name(output, kind)][0] for kind in ("max", "min")], LANES
            )
            for output in outputs
        }
        return compiled, array("d", [known[name] for name in compiled.program.parameters]), starts

    @cached_property
    def _of_drivers(self) -> frozenset[str]:
        """Addresses of the drivers' dimensions, where there are loads."""
        mechanism = self.traced.mechanism
        known = mechanism.dimensions() if self.fields else ()
        return frozenset(name for name in known if name.rpartition(".")[0] in mechanism.drivers)


class _Newton:
    """One thread's call of Newton's steps to the limit positions of a design."""

    def __init__(
        self,
        compiled: CompiledProgram,
        base: array[float],
        starts: Mapping[str, Floats],
        places: Mapping[str, int],
    ) -> None:
        program = compiled.program
        self._base, self._numbers = base, base[:]
        self._places = {name: place for place, name in enumerate(program.parameters)}
        names = program.output_names
        self._rows = array("d", bytes(8 * LANES * len(names)))
        out = np.frombuffer(self._rows).reshape(-1, LANES)
        entry, block, _ = compiled.one_by_one(np.frombuffer(self._numbers), starts, out)
        self._run = partial(OF_ONE_ADDRESS(entry), address_of(block))
        self._read = compiled, starts, block
        lanes = [
            (lane, f"{name}:{kind}")
            for row, name in enumerate(names)
            for lane, kind in enumerate(("max", "min"), start=row * LANES)
        ]
        self._moved = [lane for lane, name in lanes if name.startswith("moved:")]
        self._found = [(lane, places[name]) for lane, name in lanes if name in places]

    def limit(self, changes: Mapping[str, float], numbers: array[float]) -> bool:
        """Writes limits, and values there, among the numbers; False where the steps do not come to an end."""
        own, rows = self._numbers, self._rows
        own[:] = self._base
        for address, value in changes.items():
            if address in self._places:
                own[self._places[address]] = value
        self._run()
        for lane, place in self._found:
            numbers[place] = rows[lane]
        return sum([rows[lane] for lane in self._moved]) <= CONVERGED
