"""Designs with groups that Newton's method solves: followed side by side from position to position."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import Output
from linkwright.cycle_programs.limit_stages import Way, constants, limit_stages
from linkwright.cycle_programs.loaded_cycle import along_input, doubtful, doubts, with_loads
from linkwright.cycle_programs.traced_outputs import NEAREST, VALID, Traced, design_table
from linkwright.engine.cycle import CycleProgram
from linkwright.engine.cycle_gradient import cycle_gradient
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.recently_made import Recent
from linkwright.engine.reductions import VALID_COUNT, Reduction, Results
from linkwright.engine.stage import Stage
from linkwright.engine.summaries import Backend
from linkwright.engine.trace import Scalar, select
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.step_rule import StepRule
from linkwright.kinetostatics.friction import Swinging
from linkwright.kinetostatics.traced_loads import AlongInput
from linkwright.mechanism.mechanism import Mechanism

#: Newton steps per position, and of one attempt at the beginning; the change of a coordinate (rad, or share of the
#: mechanism's size) in one step to which the known design is refined.
ITERATIONS = 4
WANTED = 0.1
#: The output that tells how far a step is from being refused.
MARGIN = "branch margin"
#: What fails is tried once more with this many times as many positions.
FINER = 8
#: At the beginning: the square of the correction that they must come to, the largest change of a
#: coordinate (rad, or part of the size) in one attempt and in the first one, the largest distance from what was
#: expected as share of the change, and the smallest share of the way.
CONVERGED = 1e-22
LARGEST_CHANGE, FIRST_CHANGE = 0.15, 0.02
EXPECTED = 0.1
SMALLEST_SHARE = 1.0 / 4096


class Following:
    """A program that carries the chain coordinates, and whether the way so far was passed.

    Where a step is larger than the assembly mode allows, positions are put between; only the asked ones count.
    A design is followed forwards; positions behind a barred one count as not reached.
    """

    def __init__(self, traced: Traced, names: tuple[str, ...], loads: AlongInput) -> None:
        self.traced = traced
        self.names = names
        self.loads = loads
        self.finer = self._needed()
        self.ways: dict[int, _Way] = {}

    def block(
        self,
        columns: Mapping[str, Floats],
        wanted: Sequence[Reduction],
        threads: int | None,
        backend: Backend,
    ) -> tuple[Results, Indices]:
        """Reductions (designs,) of designs with the given columns, and the numbers of those of which limits or
        friction are not certain, or loads have no value somewhere."""
        results = self._way(self.finer).reduced(columns, wanted, threads, backend)
        failed = np.flatnonzero(results["valid.count"] != self.traced.positions.count)
        if len(failed):
            part = {address: column[failed] for address, column in columns.items()}
            again = self._way(self.finer * FINER).reduced(part, wanted, threads, backend)
            for name, column in again.items():
                results[name][failed] = column
        return results, doubtful(results, self.loads, self.traced.positions.count, self.loads.outputs)

    def states(
        self, columns: Mapping[str, Floats], threads: int | None, backend: Backend
    ) -> dict[str, Floats]:
        """What is carried, (designs, n) by name, at the positions that were asked for; NaN for designs that do not
        pass."""
        found, passed = self._way(self.finer).states(columns, threads, backend)
        failed = np.flatnonzero(~passed)
        if len(failed):
            part = {address: column[failed] for address, column in columns.items()}
            again, passed = self._way(self.finer * FINER).states(part, threads, backend)
            for name, rows in again.items():
                found[name][failed] = np.where(passed[:, None], rows, np.nan)
        return found

    def _way(self, finer: int) -> _Way:
        if finer not in self.ways:
            self.ways[finer] = _Way(self.traced, self.names, finer, self.loads)
        return self.ways[finer]

    def _needed(self) -> int:
        """How much finer the positions must be for the known design."""
        known = self.traced.nominal.states
        size = self.traced.mechanism.size
        largest = 0.0
        for name, row in known.items():
            change = np.abs(np.diff(row)) / (size if name.endswith(".s") else 1.0)
            largest = max(largest, float(np.nanmax(change, initial=0.0)))
        return max(1, int(np.ceil(largest / WANTED)))


def following(traced: Traced, names: Iterable[str], fields: Iterable[str]) -> Following | None:
    """The program for some outputs, with the loads and the friction behind its ``fields``; what was made for the same
    mechanism lately serves again. None where these cannot be traced."""
    asked, given = tuple(dict.fromkeys(names)), tuple(fields)
    key = (traced.solver.manner, traced.positions.key, asked)
    return _followings.get(traced.mechanism, key, lambda: _found(traced, asked, given))


def _found(traced: Traced, asked: tuple[str, ...], fields: tuple[str, ...]) -> Following | None:
    loads = along_input(traced, traced.solver.manner.free, fields)
    return None if loads is None else Following(traced, asked, loads)


_followings: Recent[Mechanism, Following | None] = Recent(8)


def limits_beside(
    traced: Traced, outputs: Iterable[Swinging], valued: Iterable[Output], shown: Iterable[Output] = ()
) -> list[Stage]:
    """The stages that find limit positions, by Newton's steps from the positions next to them, where what is carried
    from position to position is given as fields; ``shown``: see ``limit_stages``."""
    mechanism, free = traced.mechanism, traced.solver.manner.free
    near = Traced(mechanism, free, traced.positions, iterations=ITERATIONS, turning=traced.turning)
    way = Way({}, near.solver.motion.valid, {})
    return limit_stages(near, outputs, valued=valued, shown=shown, way=way)


class _Way:
    """The program over positions that are ``finer`` times as many as asked."""

    def __init__(self, traced: Traced, names: tuple[str, ...], finer: int, loads: AlongInput) -> None:
        self.finer, self.loads = finer, loads
        mechanism, asked = traced.mechanism, traced.positions
        self.positions: Positions = over_cycle(mechanism, asked.steps * finer)
        plain = Traced(mechanism, traced.solver.manner.free, self.positions, iterations=ITERATIONS)
        self.traced = with_loads(plain, loads)
        count = self.positions.count
        step = self.positions.time[1] - self.positions.time[0] if count > 1 else 0.0
        self.arrays = {
            **self.positions.arrays,
            "counted": _counted(count, finer),
            "step": np.full(count, step),
        }
        quantities = self.traced.quantities(names)
        motion = self.traced.solver.motion
        self.trace = trace = motion.trace
        self.rule = StepRule(motion, trace.position("step"))
        passed = trace.logic("and", motion.valid, trace.compare("less", 0.5, trace.state("alive")))
        passed = trace.logic("and", passed, self.rule.kept)
        self.counts = trace.logic("and", passed, trace.compare("less", 0.5, trace.position("counted")))
        outputs: dict[str, Scalar | bool] = {name: each.carrier for name, each in quantities.items()}
        self.following = following = {**self.rule.following, "alive": select(passed, 1.0, 0.0)}
        outputs |= {NEAREST: self.traced.nearest, VALID: self.counts, MARGIN: self.rule.margin}
        self.doubts = doubts(self.traced, loads)
        outputs |= self.doubts
        self.program = Program.of(trace, outputs, following)
        self.approach = Approach(self.traced, traced.nominal.states)
        self.starts = {name: f"start:{name}" for name in following}
        way = Way(following, passed, self.starts)
        self.limits = tuple(limit_stages(self.traced, loads.outputs, valued=loads.valued, way=way))
        self._cycles: dict[tuple[Reduction, ...], CycleProgram] = {}

    def _cycle(self, wanted: tuple[Reduction, ...]) -> CycleProgram:
        """The limits that the loads need, then the reductions over the positions."""
        if wanted not in self._cycles:
            named = {each.name: each for each in wanted}
            last = Stage(self.program, named, valid=VALID, count=VALID_COUNT, starts=self.starts)
            self._cycles[wanted] = CycleProgram((*self.limits, last))
        return self._cycles[wanted]

    @cached_property
    def _carrying(self) -> CycleProgram:
        """What is carried from position to position, as fields."""
        program = Program.of(
            self.trace, {**self.traced.solver.motion.next_states, VALID: self.counts}, self.following
        )
        keep = tuple(self.traced.solver.motion.next_states)
        return CycleProgram((Stage(program, valid=VALID, count=VALID_COUNT, starts=self.starts, keep=keep),))

    def states(
        self, columns: Mapping[str, Floats], threads: int | None, backend: Backend
    ) -> tuple[dict[str, Floats], Flags]:
        """What is carried, (designs, n) by name, at the positions that count, and which designs pass."""
        cycle, count = self._carrying, int(self.arrays["counted"].sum())
        parts, passed = [], []
        for _, known, _ in cycle.blocks(
            self._table(cycle, columns), self.arrays, threads=threads, backend=_quicker(backend)
        ):
            parts.append(known.fields)
            passed.append(known.values[VALID_COUNT] == count)
        names = self.traced.solver.motion.next_states
        return {
            n: np.concatenate([part[n] for part in parts])[:, :: self.finer] for n in names
        }, np.concatenate(passed)

    def _table(self, cycle: CycleProgram, columns: Mapping[str, Floats]) -> Floats:
        """What a cycle program takes of the designs, (designs, dimensions)."""
        start = self.approach.states(columns)
        known = {**self.traced.solver.nominal.parameters, **self.loads.constants}
        known |= constants(self.traced) if self.limits else {}
        for name, value in {**self.rule.begin, "alive": 1.0}.items():
            if isinstance(value, str):
                start[name] = start[value]
            else:
                known[self.starts[name]] = value
        given = {**columns, **{self.starts[name]: column for name, column in start.items()}}
        return design_table(cycle.dimensions, known, given)

    def reduced(
        self,
        columns: Mapping[str, Floats],
        wanted: Sequence[Reduction],
        threads: int | None,
        backend: Backend,
    ) -> Results:
        """Reductions (designs,), those of the branch margin and of the doubts among them."""
        more = (Reduction(MARGIN, "min"), *(Reduction(name, "sum") for name in self.doubts))
        cycle = self._cycle((*wanted, *more))
        found = cycle.evaluate(
            self._table(cycle, columns),
            self.arrays,
            tables=self.loads.tables,
            threads=threads,
            backend=_quicker(backend),
        )
        found |= {name: found.pop(f"{name}.sum") for name in self.doubts}
        for name, column in found.items():
            if name.endswith((".argmin", ".argmax")):
                found[name] = np.where(column < 0, column, column // self.finer)
        return found


def _quicker(backend: Backend) -> Backend:
    """Compiled code where it is there: position after position NumPy has only a few designs to work on."""
    from linkwright.engine.machine_code import available

    return "llvm" if backend == "auto" and available() else backend


def _counted(count: int, finer: int) -> Floats:
    """1 at the positions that were asked for, 0 at those between."""
    marks = np.zeros(count)
    marks[::finer] = 1.0
    return marks


class Approach:
    """The way from a mechanism as it is to other designs at the first position.

    Every design is approached on a straight line in the varied dimensions, with Newton's steps at each stage from
    what the last two stages let expect. A stage that fails, that changes the sign of a group's determinant, or that
    ends far from what was expected, is halved. ``known``: the chain coordinates of the mechanism as it is.
    """

    def __init__(self, traced: Traced, known: Mapping[str, Floats]) -> None:
        self.traced = traced
        motion = traced.solver.motion
        residual: Scalar = 0.0
        for placed in motion.placed.values():
            residual = residual + placed.residual
        self.names = tuple(motion.next_states)
        outputs = {**motion.next_states, "residual": residual}
        groups = [(name, placed) for name, placed in motion.placed.items() if placed.coordinates]
        outputs |= {f"determinant:{name}": placed.determinant for name, placed in groups}
        self.evaluator = numpy_program(Program.of(motion.trace, outputs))
        self.begin = traced.numbers(self.evaluator.program)
        self.inputs = {name: row[:1] for name, row in traced.positions.arrays.items()}
        size = motion.mechanism.size
        self.scale = np.array([size if name.endswith(".s") else 1.0 for name in self.names])
        self.first = np.array([known[name][0] for name in self.names])

    def states(self, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """Chain coordinates (designs,) by name at the first position; NaN for designs that are not reached."""
        goal = self.traced.table(self.evaluator.program, columns)
        designs = len(goal)
        state = np.repeat(self.first[None, :], designs, axis=0)
        slope = np.full_like(state, np.nan)
        sign = np.sign(self._evaluate(self.begin[None, :], state[:1])[2])
        done, share = np.zeros(designs), np.ones(designs)
        active = np.ones(designs, dtype=bool)
        while active.any():
            rows = np.flatnonzero(active)
            ahead = np.minimum(done[rows] + share[rows], 1.0)
            table = self.begin + ahead[:, None] * (goal[rows] - self.begin)
            moved, good = self._newton(table, state[rows], slope[rows] * (ahead - done[rows])[:, None], sign)
            came = rows[good]
            slope[came] = (moved[good] - state[came]) / (ahead[good] - done[came])[:, None]
            state[came], done[came] = moved[good], ahead[good]
            share[came] *= 2.0
            share[rows[~good]] *= 0.5
            active[rows] = (done[rows] < 1.0) & (share[rows] >= SMALLEST_SHARE)
        state[done < 1.0] = np.nan
        return {name: state[:, place] for place, name in enumerate(self.names)}

    def _newton(self, table: Floats, state: Floats, expected: Floats, sign: Floats) -> tuple[Floats, Flags]:
        """States at parts of the ways, and which of them are certain; ``expected`` changes are NaN at first."""
        known = np.asarray(np.isfinite(expected).all(axis=1))
        start = self._unit(state + np.where(known[:, None], expected, 0.0))
        new, _, _ = self._evaluate(table, start)
        new, residual, determinants = self._evaluate(table, new)
        with np.errstate(invalid="ignore"):
            change = (np.abs(new - state) / self.scale).max(axis=1)
            off = (np.abs(new - start) / self.scale).max(axis=1)
            near = np.where(known, off <= EXPECTED * change + 1e-9, change <= FIRST_CHANGE)
            kept = np.asarray(np.sign(determinants) == sign).all(axis=1)
            good: Flags = np.asarray((residual < CONVERGED) & (change <= LARGEST_CHANGE) & near & kept)
            return new, good

    def _unit(self, state: Floats) -> Floats:
        """The same with directions of unit length."""
        for place, name in enumerate(self.names):
            if name.endswith(".x"):
                state[:, place : place + 2] /= np.hypot(state[:, place], state[:, place + 1])[:, None]
        return state

    def _evaluate(self, table: Floats, state: Floats) -> tuple[Floats, Floats, Floats]:
        """Next states, residuals and determinants of the groups."""
        states = {name: state[:, place : place + 1] for place, name in enumerate(self.names)}
        found = self.evaluator.run_designs(table, self.inputs, {}, states, length=1)[:, :, 0]
        n = len(self.names)
        return found[:, :n], found[:, n], found[:, n + 1 :]


class LimitsBeside:
    """Limits between which loads act, where what is carried from position to position is given."""

    def __init__(self, traced: Traced, loads: AlongInput) -> None:
        self.traced = traced
        self.cycle = CycleProgram(tuple(limits_beside(traced, loads.outputs, loads.valued)))
        self.numbers = constants(traced)
        self.known = {**traced.solver.nominal.parameters, **self.numbers, **loads.constants}

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Dimensions on which they depend."""
        return self.cycle.dimensions

    def solve(self, columns: Mapping[str, Floats], states: Mapping[str, Floats]) -> FoundBeside:
        """Those of designs with some columns (designs,), and states (designs, n)."""
        return FoundBeside(
            self, design_table(self.cycle.dimensions, self.known, columns), states, tuple(columns)
        )


class FoundBeside:
    """As :class:`linkwright.cycle.load_limits.FoundLimits`."""

    def __init__(
        self, sought: LimitsBeside, table: Floats, states: Mapping[str, Floats], by: tuple[str, ...]
    ) -> None:
        self._sought, self._inputs = sought, (table, sought.traced.positions.arrays, states)
        self._by = [name for name in by if name in sought.cycle.dimensions]
        found = sought.cycle.evaluate(*self._inputs, threads=1)
        self.numbers: dict[str, Floats] = {
            n: np.asarray(v, dtype=float) for n, v in found.items() if n.startswith(("limit:", "value:"))
        }
        self.certain: Flags = np.all([v == 0.0 for n, v in found.items() if n.startswith("doubt:")], axis=0)

    def pull(self, bars: Mapping[str, Floats]) -> dict[str, Floats]:
        """From derivatives (designs,) by the numbers those by the designs' columns."""
        names = [name for name in self.numbers if name in bars]
        if not names or not self._by:
            return {}
        gradient = cycle_gradient(self._sought.cycle, names, self._by)
        slopes = gradient.evaluate_all(*self._inputs, threads=1)[1]
        found = np.einsum("kd,kdw->wd", np.array([bars[name] for name in names]), slopes)
        return dict(zip(self._by, found, strict=True))
