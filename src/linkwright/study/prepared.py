"""A mechanism prepared to be solved again and again with other dimensions."""

from __future__ import annotations

import threading
from array import array
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Literal

import numpy as np

from linkwright.engine.cycle import CycleProgram
from linkwright.engine.llvm_backend import CompiledProgram, compile_program
from linkwright.engine.machine_code import available
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.trace import Scalar, select
from linkwright.errors import LinkwrightError, RequestError
from linkwright.kinematics.change_points import is_way, nearness, parts
from linkwright.kinematics.cycle import Floats, Positions, over_cycle
from linkwright.kinematics.design import Design
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinematics.passing import NEAR
from linkwright.kinematics.solve import MotionRun
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import run_forces
from linkwright.kinetostatics.site import TracedSite, limit_name
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.loads.along_input import magnitude
from linkwright.loads.phases import TURN
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.study.limit_stages import CONVERGED, constants, near_limits, rate_name
from linkwright.study.loaded_cycle import AlongInput, along_input
from linkwright.study.traced import Traced
from linkwright.words.sentence import Sentence

#: The row of how near a group is to a change point or a gap; 0 where it cannot be assembled.
NEAREST = "nearest change point"
#: Lanes in which limit positions are looked for beside each other, as many as a processor may have; how near to a
#: position, rad, one counts as on it.
LANES, AT = 8, 1e-9

Backend = Literal["auto", "numpy", "llvm"]


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
    return Prepared(mechanism, tuple(vary), over_cycle(mechanism, steps), backend)


class Prepared:
    """Solves designs of one mechanism; made by :func:`prepare`.

    The assembly modes are those of the starting design; positions are those of its input.
    """

    def __init__(
        self, mechanism: Mechanism, vary: tuple[str, ...], positions: Positions, backend: Backend
    ) -> None:
        known = mechanism.dimensions()
        for address in vary:
            if address not in known:
                hint = offered(address, known, "study.such_as", most=6)
                raise RequestError(
                    Sentence("study.no_dimension", address=address, name=mechanism.name, hint=hint)
                )
        self.mechanism = mechanism
        self.vary = vary
        self.positions = positions
        self.backend = backend
        self._loads = _Followed.of(self)
        self.solver = self._loads.traced.solver
        self.force_solver = ForceSolver(self.solver)
        motion, forces = self.solver.outputs.standard, self.force_solver.outputs.standard
        more = (name for name in self._loads.rates.values() if name not in motion)
        self._names = (*motion[:-1], *forces, *self._loads.fields, *more, NEAREST, "outcome")
        self._index = {name: i for i, name in enumerate(self._names)}
        self.program = self._trace()
        self._evaluate = self._evaluator(backend)
        known = {**self.solver.nominal.parameters, **self._loads.known}
        self._base = array("d", [known.get(name, np.nan) for name in self.program.parameters])
        self._places = {name: i for i, name in enumerate(self.program.parameters)}
        self._own = _Numbers(self._base)
        plain = not (self.program.fields or self.program.states)
        self._at_once = plain and is_way(positions) and parts(self.solver, positions) == 1
        self._modes = self.solver.assembly.modes

    def __reduce__(self) -> tuple[type[Prepared], tuple[object, ...]]:
        return Prepared, (self.mechanism, self.vary, self.positions, self.backend)

    def _trace(self) -> Program:
        motion, forces = self.solver.outputs, self._loads.traced.forces.outputs
        stored = {*motion.standard, *self._loads.rates.values()}
        sizes = self._loads.sizes
        values = {
            name: sizes[name] if name in sizes else (motion if name in stored else forces).value(name)
            for name in self._names
            if name != NEAREST
        }
        values[NEAREST] = select(self.solver.motion.valid, nearness(self.solver), 0.0)
        values["outcome"] = values.pop("outcome")
        return Program.of(self.solver.motion.trace, values)

    def _evaluator(self, backend: Backend) -> Callable[[Floats], Floats]:
        arrays = {name: self.positions.arrays[name] for name in self.program.positions}
        if backend != "numpy":
            able = bool(self.program.positions) and not self.program.states
            compiled = compile_program(self.program) if able else None
            if compiled is not None:
                return compiled.repeated(arrays, tables=self._loads.tables)
            if backend == "llvm":
                raise LinkwrightError(Sentence("study.not_compiled"))
        evaluator = numpy_program(self.program)
        return lambda table: evaluator.run(table, arrays, length=self.positions.count)

    def solve(self, changes: Mapping[str, float], *, failures: Literal["raise", "mark"] = "raise") -> Forces:
        """Motion and forces of the design with some dimensions changed (SI values by address).

        Raises:
            LinkwrightError: a dimension that is zero in the starting design, and was not named in ``vary``.
            PositionError: a position cannot be reached, and ``failures`` is ``raise``.
        """
        design = Design(self.mechanism, self._modes, changes)
        values = self._values(changes) if self._at_once else None
        if values is None or is_near(values[-2]):
            return self._solve_in_turn(design, failures)
        motion = Motion(self.solver, design, self.positions, {}, {}, Rows(values, self._index))
        fields = {name: values[self._index[name]] for name in self._loads.fields}
        return Forces(motion, self.force_solver, fields, False, motion.rows)

    def _values(self, changes: Mapping[str, float]) -> Floats | None:
        """Outputs (names, n); None where a load has no value, or its limit positions are not certain."""
        self._change(changes)
        loads, own = self._loads, self._own
        if not loads.fields:
            return self._evaluate(own.table)
        for limits in (loads.near, loads.searched):
            found = limits(changes)
            if found is None:
                continue
            for name, value in found.items():
                if name in self._places:
                    own.numbers[self._places[name]] = value
            values = self._evaluate(own.table)
            if loads.agree(found, values, self._index):
                return values if loads.finite(values, self._index) else None
        return None

    def _change(self, changes: Mapping[str, float]) -> None:
        """Sets the program's numbers to those of a design."""
        numbers = self._own.numbers
        numbers[:] = self._base
        for address, value in changes.items():
            place = self._places.get(address)
            if place is not None:
                numbers[place] = value
            elif address not in self.vary:
                self._refuse_fixed(address)

    def _refuse_fixed(self, address: str) -> None:
        """Refuses a dimension that the programs hold as a known zero, or do not know."""
        if self.mechanism.dimension(address) == 0.0:
            raise RequestError(Sentence("study.zero_not_named", address=address))

    def _solve_in_turn(self, design: Design, failures: str) -> Forces:
        """Motion first: where loads or iterations need it, or change points and gaps may lie between positions."""
        for address in set(design.changes) - set(self.vary):
            self._refuse_fixed(address)
        solver = self.solver.for_design(design)
        return run_forces(MotionRun(solver, self.positions).solve(failures), False)


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
    """Loads that a compiled program traces, with what finds their limit positions before."""

    def __init__(self, traced: Traced, loads: AlongInput) -> None:
        self.traced, self.loads = traced, loads
        self.tables = loads.tables
        self.fields = tuple(f"load:{name}" for name in sorted(loads.names))
        self.known = {**constants(traced), **loads.constants}
        self._own = threading.local()
        self.rates = {output: rate_name(traced, output) for output in loads.outputs}
        self._limits = [
            (rate, limit_name(output, "max"), limit_name(output, "min"))
            for output, rate in self.rates.items()
        ]

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
        traced = Traced(mechanism, vary, positions, along_input=loads.names) if loads.names else plain
        return cls(traced, loads)

    @cached_property
    def sizes(self) -> dict[str, Scalar]:
        """Their magnitudes, by the names of the fields that forces know them by."""
        motion, loads = self.traced.solver.motion, self.traced.mechanism.loads
        found = {name: loads[name.removeprefix("load:")] for name in self.fields}
        return {
            name: magnitude(load, TracedSite(motion, load, along_input=True)) for name, load in found.items()
        }

    def finite(self, values: Floats, index: Mapping[str, int]) -> bool:
        """Whether every load has a value everywhere."""
        fallible = self.loads.fallible
        return not fallible or all(np.isfinite(values[index[f"load:{name}"]]).all() for name in fallible)

    # limit positions ----------------------------------------------------------------------------
    def searched(self, changes: Mapping[str, float]) -> dict[str, float] | None:
        """What the program takes besides dimensions; None for designs whose limit positions are not certain."""
        if not self._of_drivers.isdisjoint(changes):
            return None
        if not self.loads.outputs:
            return {}
        cycle = self._cycle
        table, positions = [self._numbers(cycle.dimensions, changes)], self.traced.positions.arrays
        found = cycle.evaluate(table, positions, tables=self.tables, threads=1, backend="llvm")
        if any(found[f"doubt:{output}"][0] != 0.0 for output in self.loads.outputs):
            return None
        return {
            name: float(column[0]) for name, column in found.items() if name.startswith(("limit:", "value:"))
        }

    def near(self, changes: Mapping[str, float]) -> dict[str, float] | None:
        """The same by Newton's steps from the limit positions of the mechanism as it is; to be seen whether they
        agree with the rates."""
        if not self._of_drivers.isdisjoint(changes):
            return None
        if not self.rates:
            return {}
        newton: _Newton | None = getattr(self._own, "newton", None)
        if newton is None:
            if self._begin is None:
                return None
            newton = self._own.newton = _Newton(*self._begin)
        return newton.limits(changes)

    def agree(self, limits: Mapping[str, float], values: Floats, index: Mapping[str, int]) -> bool:
        """Whether the rates change their signs at these limit positions, and nowhere else."""
        inputs, sense, step = self._inputs, self._sense, self.known["step of the input"] + 2.0 * AT
        for rate, highest, lowest in self._limits:
            falls = np.signbit(values[index[rate]]).tobytes()
            one, other = (b"\1", b"\0") if falls[0] else (b"\0", b"\1")
            first = falls.find(other)
            second = falls.find(one, first)  # -1: back at the first position
            if first < 0 or (second >= 0 and falls.find(other, second) >= 0):
                return False
            ends = (lowest, highest) if falls[0] else (highest, lowest)
            for limit, after in zip(ends, (first, max(second, 0)), strict=True):
                if ((limits[limit] - inputs[after - 1]) * sense + AT) % TURN > step:
                    return False
        return True

    @cached_property
    def _inputs(self) -> list[float]:
        """The input at every position."""
        return [float(q) for q in next(iter(self.traced.positions.coordinates.values()))[0]]

    @cached_property
    def _sense(self) -> float:
        """1 where the input grows, else -1."""
        return float(np.sign(next(iter(self.traced.positions.coordinates.values()))[1][0]))

    @cached_property
    def _cycle(self) -> CycleProgram:
        return CycleProgram(tuple(self.loads.stages(self.traced)))

    @cached_property
    def _begin(self) -> tuple[CompiledProgram, array[float], dict[str, Floats]] | None:
        """Newton's steps compiled, their numbers, and the limits where they begin."""
        known = self.searched({})
        compiled = compile_program(near_limits(self.traced, self.loads.outputs, self.loads.valued))
        if known is None or compiled is None:
            return None
        starts = {
            f"near:{output}": np.resize([known[limit_name(output, kind)] for kind in ("max", "min")], LANES)
            for output in self.loads.outputs
        }
        return compiled, array("d", self._numbers(compiled.program.parameters, {})), starts

    def _numbers(self, names: Iterable[str], changes: Mapping[str, float]) -> list[float]:
        known = {**self.traced.solver.nominal.parameters, **self.known, **changes}
        return [known[name] for name in names]

    @cached_property
    def _of_drivers(self) -> frozenset[str]:
        """Addresses of the drivers' dimensions, where there are loads."""
        mechanism = self.traced.mechanism
        known = mechanism.dimensions() if self.fields else ()
        return frozenset(name for name in known if name.rpartition(".")[0] in mechanism.drivers)


class _Newton:
    """One thread's call of Newton's steps to the limit positions of a design."""

    def __init__(self, compiled: CompiledProgram, base: array[float], starts: Mapping[str, Floats]) -> None:
        program = compiled.program
        self._base, self._numbers = base, base[:]
        self._places = {name: place for place, name in enumerate(program.parameters)}
        names = program.output_names
        self._rows = array("d", bytes(8 * LANES * len(names)))
        out = np.frombuffer(self._rows).reshape(-1, LANES)
        self._run = compiled.bound(np.frombuffer(self._numbers), starts, out)
        self._moved, self._found = [], []
        for row, name in enumerate(names):
            for lane, kind in enumerate(("max", "min"), start=row * LANES):
                if name.startswith("moved:"):
                    self._moved.append(lane)
                else:
                    self._found.append((lane, f"{name}:{kind}"))

    def limits(self, changes: Mapping[str, float]) -> dict[str, float] | None:
        """Limits, and values there, by name; None where the steps do not come to an end."""
        self._numbers[:] = self._base
        for address, value in changes.items():
            if address in self._places:
                self._numbers[self._places[address]] = value
        self._run()
        rows = self._rows
        for place in self._moved:
            if not rows[place] <= CONVERGED:
                return None
        return {name: rows[place] for place, name in self._found}
