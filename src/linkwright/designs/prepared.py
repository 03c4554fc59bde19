"""A mechanism prepared to be solved again and again with other dimensions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Literal

import numpy as np

from linkwright.applied_loads.strokes import turned
from linkwright.core.arguments import STEPS, one_of, require
from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.cycle.load_limits import LoadLimits, NearLimits
from linkwright.designs.traced_outputs import LoadedCycle, Traced, loaded_cycle
from linkwright.designs.varied_dimensions import checked_addresses
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.summaries import BACKENDS, Backend
from linkwright.formula.trace import Mask, absolute, minimum, select, sign
from linkwright.kinematics.change_points import nearness, parts
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.dimensions import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.names import program_names
from linkwright.kinematics.passing import NEAR
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.solve import MotionRun
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.load_site import LAP, limit_name
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: The row of how near a group is to a change point or a gap; 0 where it cannot be assembled, where a load has no
#: value, where limit positions do not agree with the rates, and where friction is not certain.
NEAREST = "nearest change point"
#: The step of the input between two positions, rad; how near to a limit, rad, a position counts as on it.
STEP, AT = "step of the input", 1e-9


def prepare(
    mechanism: Mechanism, *, vary: Iterable[str] = (), steps: int = STEPS, backend: Backend = "auto"
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

    def __init__(self, mechanism: Mechanism, vary: tuple[str, ...], positions: Positions, backend: Backend) -> None:
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
        constants, count = self._loaded.constants, positions.count
        step = {STEP: constants.get(LAP, 0.0) / count if count else 0.0}
        known = {**self.solver.nominal.parameters, **constants, **step}
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
            name: (motion if name in motion.standard else traced.forces.outputs).value(name) for name in others
        } | self._sizes
        solved = trace.logic("and", traced.solver.motion.valid, self._loaded.sound)
        if self._near is not None:
            solved = trace.logic("and", solved, agree(traced, self._loaded.loads.outputs))
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
                raise LinkwrightError(
                    _(
                        "this mechanism cannot be compiled here: llvmlite is missing, or a group iterates",
                        code="study.not_compiled",
                    )
                )
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
        run_forces(MotionRun(self.solver.for_design(design), self.positions).solve("mark"), False)
        self._checked = True

    def _values(self, changes: Mapping[str, float]) -> Floats | None:
        """Outputs (names, n); None where the limits between which loads act are not certain."""
        numbers = self._base.copy()
        for address, value in changes.items():
            if address in self._places:
                numbers[self._places[address]] = value
            elif address not in self.vary:
                self._refuse_fixed(address)
        if self._loaded.limits is not None:
            if not self._nominal.keys() >= changes.keys():
                return None
            limits = self._limits(self._loaded.limits, {**self._nominal, **changes})
            if limits is None:
                return None
            for name in limits.keys() & self._places.keys():
                numbers[self._places[name]] = limits[name]
        return self._evaluate(numbers)

    def _limits(self, sought: LoadLimits, values: Mapping[str, float]) -> Mapping[str, float] | None:
        """The limits between which loads act in a design; None where they are not certain.

        By steps from those of the machine as it is, where the positions show that they are all.
        """
        if self._near is not None:
            return self._near.numbers(values)
        found = sought.solve({name: np.array([value]) for name, value in values.items()})
        return {name: each.item() for name, each in found.numbers.items()} if found.certain.all() else None

    @cached_property
    def _nominal(self) -> dict[str, float]:
        """The dimensions that vary, of the machine as it is."""
        return {name: self.mechanism.dimension(name) for name in self.solver.manner.free}

    @cached_property
    def _near(self) -> NearLimits | None:
        """What finds limits from those of the machine as it is; None where they are not certain, or its drivers'
        dimensions vary."""
        drivers = self.mechanism.drivers
        fixed = not any(name.rpartition(".")[0] in drivers for name in self._nominal)
        sought = self._loaded.limits
        return NearLimits.of(sought, self._nominal) if sought and fixed and self.backend != "numpy" else None

    def _refuse_fixed(self, address: str) -> None:
        """Refuses a dimension that the programs hold as a known zero, or do not know."""
        if self.mechanism.dimension(address) == 0.0:
            raise RequestError(
                _(
                    "{address!r} is zero and was not named when the mechanism was prepared; write "
                    "prepare(mechanism, vary=[{address!r}, …])",
                    code="study.zero_not_named",
                    address=address,
                )
            )

    def _solve_alone(self, design: Design, failures: str) -> Forces:
        """As a machine by itself: where loads are not traced, or change points and gaps may lie between positions."""
        for address in set(design.changes) - set(self.vary):
            self._refuse_fixed(address)
        solver = self.solver.for_design(design)
        return run_forces(MotionRun(solver, self.positions).solve(failures), False)


def is_near(row: Floats) -> bool:
    """Whether a change point or a gap may lie between two positions, by how near every position (n,) is to one."""
    smallest, largest = row.item(row.argmin()), row.item(row.argmax())  # many times faster than min and max
    if smallest - NEAR > largest - smallest:  # no step is longer than all of them together
        return False
    steps = row[1:] - row[:-1]
    return bool(smallest - NEAR < max(steps[steps.argmax()], -steps[steps.argmin()]))


def agree(traced: Traced, outputs: Iterable[Output]) -> Mask:
    """Whether every output falls at a position just where this lies between the limits ``max`` and ``min``, with
    positions on both ways; on a limit its rate may have either sign."""
    motion, logic = traced.solver.motion, traced.solver.motion.trace.logic
    (driver,) = traced.mechanism.drivers
    found: Mask = True
    sense = sign(motion.trace.parameter(f"{driver}.speed"))
    step, lap = motion.trace.parameter(STEP), motion.trace.parameter(LAP)
    for output in outputs:
        highest, lowest = (motion.trace.parameter(limit_name(output, kind)) for kind in ("max", "min"))
        way = turned(sense * (motion.trace.position("input") - highest), lap)
        length = turned(sense * (lowest - highest), lap)
        gone = way - length
        rate = traced.solver.outputs.value(program_names(traced.mechanism, output)[1][0])
        near_end = minimum(minimum(way, lap - way), absolute(gone)) <= AT
        separated = minimum(length, lap - length) > step
        found = logic("and", found, logic("and", separated, logic("or", rate * gone >= 0.0, near_end)))
    return found
