"""The work of one sweep: block by block, plain designs together, others one by one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices, Whole
from linkwright.core.dataclass import dataclass
from linkwright.core.inputs import Input, mode_groups
from linkwright.core.progress import Progress, current_progress, paced
from linkwright.cycle.summary import Summary, finished, reductions
from linkwright.designs.change_points import ChangePoints, near_enough
from linkwright.designs.finished_parts import identity, once
from linkwright.designs.loaded_cycle import LoadedCycle, doubts, loaded_cycle
from linkwright.designs.one_by_one import OneByOne, changes_of
from linkwright.designs.traced_outputs import NEAREST, VALID, Traced
from linkwright.errors import LinkwrightError, SelfCheckError
from linkwright.events.following import ITERATIONS
from linkwright.events.tracked_states import TrackedStates, tracked_states
from linkwright.files.write import dump
from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.machine_code import available
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import Reduction, Results
from linkwright.formula.states import inputs_as_fields
from linkwright.formula.summaries import WORTH_COMPILING, Backend, summaries
from linkwright.formula.threads import chunks, cores
from linkwright.formula.trace import Scalar
from linkwright.kinematics.groups import iterated
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.kinetostatics.named_outputs import Quantity
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism

#: The result that says whether a design passes its cycle.
PASSED = "passed"
#: The result that says how far a design's most doubtful step was from being refused.
MARGIN = "branch margin"
#: Designs of one block, of one whose loads are found together, and of one whose inputs are found design by design.
BLOCK, TOGETHER_BLOCK, LOADED_BLOCK = 1 << 16, 1 << 13, 1 << 9
#: Designs whose states at all positions are held at a time.
TRACKED_BLOCK = 1 << 11
#: Designs whose curves are held at a time.
CURVE_BLOCK = 1 << 12
#: Designs of a sweep whose forces are checked, and the positions in which they are.
CHECKED, CHECK_STEPS = 3, 24


@dataclass(frozen=True)
class Manner:
    """How a sweep is done; see :func:`linkwright.designs.designs.sweep`."""

    partial: bool = False
    threads: int | None = None
    backend: Backend = "auto"
    progress: Progress | None = None


#: Sentences of those of the first few designs of a mechanism that do not pass, by number.
_few: Recent[Mechanism, dict[int, str]] = Recent(64)


class SweepRun:
    """Summaries of all designs; ``unloaded``: sentences of the designs whose loads cannot be found; ``margins``:
    see :attr:`linkwright.designs.designs.Sweep.branch_margin`."""

    def __init__(
        self,
        mechanism: Mechanism,
        columns: Mapping[str, Floats],
        asked: tuple[Summary, ...],
        positions: Positions,
        manner: Manner,
    ) -> None:
        self.mechanism, self.columns, self.asked = mechanism, columns, asked
        self.positions, self.manner = positions, manner
        self.progress, self.backend = manner.progress or current_progress(), manner.backend
        self._told = 0
        self.designs = len(next(iter(columns.values())))
        iterations = ITERATIONS if iterated(analysed(mechanism)) else 1
        self.traced = Traced(mechanism, columns, positions, iterations=iterations)
        names = [summary.output for summary in asked]
        self.quantities = self.traced.quantities(names)
        self.reductions = [*reductions(asked, self.quantities), Reduction(NEAREST, "min")]
        self.program = self.traced.program(self.quantities)
        self.unloaded: dict[int, str] = {}
        self.through: set[int] = set()
        self._programs: dict[tuple[tuple[str, ...], int], tuple[list[Quantity], Program]] = {}
        self.alone = bool(self.program.fields or self.traced.nominal.modes)
        self.margins = None if self._tracked is None else np.full(self.designs, np.nan)

    def swept(self) -> tuple[Whole, Flags, dict[Summary, Floats]]:
        """Assembled positions (designs,), whether each design passes its cycle, and every summary (designs,)."""
        assembled, passed = np.zeros(self.designs, dtype=np.int64), np.zeros(self.designs, dtype=np.bool_)
        values = {summary: np.empty(self.designs) for summary in self.asked}
        size = TOGETHER_BLOCK if self._together else LOADED_BLOCK if self.alone else BLOCK
        size = size if self._tracked is None else TRACKED_BLOCK
        for first, end in chunks(self.designs, size):
            results = self._block(
                {address: column[first:end] for address, column in self.columns.items()}, first
            )
            assembled[first:end], passed[first:end] = results["valid.count"], results[PASSED]
            if self.margins is not None:
                self.margins[first:end] = results[MARGIN]
            for summary, into in values.items():
                found = finished(summary, self.quantities[summary.output], results, self._input())
                if not self.manner.partial:
                    found[~passed[first:end]] = np.nan
                into[first:end] = found
            self.tell(end)
        self.unloaded |= self._unsound()
        for into in values.values():
            into[list(self.unloaded)] = np.nan
        passed[list(self.unloaded)] = False
        return assembled, passed, values

    def curves(self, names: Sequence[str]) -> Iterator[tuple[slice, dict[str, Floats]]]:
        """The outputs over the positions block by block, (designs, n) each; NaN for designs that do not pass."""
        for why in self._unsound().values():
            raise SelfCheckError(why)
        for first, end in chunks(self.designs, CURVE_BLOCK):
            part = {address: column[first:end] for address, column in self.columns.items()}
            yield slice(first, end), self._curves(names, part, first)
            self.tell(end)

    def tell(self, done: int) -> None:
        """Tells how many designs are done, once each."""
        if self.progress is not None and done > self._told:
            self._told = done
            self.progress(done, self.designs)

    def _unsound(self) -> dict[int, str]:
        """Sentences of the designs whose forces do not pass their own check, by number.

        Compiled programs have the formulas of single machines: a few designs of a mechanism's first sweep are solved
        as such, which check themselves, and all of them if one of the few fails.
        """
        if all(each.output.of_motion for each in self.quantities.values()):
            return {}
        few = np.unique(np.linspace(0, self.designs - 1, CHECKED).astype(np.intp))
        failing = _few.get(self.mechanism, None, lambda: self._failing(few))
        return failing and self._failing(np.arange(self.designs))

    def _failing(self, designs: Indices) -> dict[int, str]:
        found: dict[int, str] = {}
        for index in designs.tolist():
            try:
                design = self.mechanism.with_dimensions(changes_of(self.columns, index))
                solve_forces(design, steps=CHECK_STEPS)
            except SelfCheckError as error:
                found[index] = error.sentence
            except LinkwrightError:
                continue
        return found

    def _curves(self, names: Sequence[str], part: Mapping[str, Floats], first: int) -> dict[str, Floats]:
        """The outputs of a block, (designs, n) each; kept where parts are kept."""
        return once(lambda: self._curves_found(names, part, first), lambda: (self.own, part, *names))

    def _curves_found(
        self, names: Sequence[str], part: Mapping[str, Floats], first: int
    ) -> dict[str, Floats]:
        end = first + len(next(iter(part.values())))
        passed = self._block(part, first)[PASSED]
        flipping = np.array([k in self.through for k in range(first, end)])
        if self.traced.nominal.modes:
            flipping[:] = True
        values = np.full((end - first, len(names), self.positions.count), np.nan)
        for chosen, source in ((passed & ~flipping, None), (passed & flipping, self._flipping)):
            if chosen.any():
                columns = {address: column[chosen] for address, column in part.items()}
                values[chosen] = self._values(names, columns, source)
        return {name: values[:, k] for k, name in enumerate(names)}

    def _values(self, names: Sequence[str], part: Mapping[str, Floats], source: OneByOne | None) -> Floats:
        """Outputs (designs, names, n) of designs that pass the cycle."""
        traced = self.traced if source is None else source.traced
        quantities, program = self._stored(tuple(names), traced)
        fields: Mapping[str, Floats] = {}
        if source is None and self._tracked is not None and not self.alone:
            fields, _ = self._tracked.of(part, self.manner.threads or cores())
        elif source is not None or program.fields:
            fields, _, _ = (source or self._single).rows(program.fields, part)
        table, inputs, n = traced.table(program, part), self.positions.arrays, self.positions.count
        code = None if self.manner.backend == "numpy" else compile_program(program)
        if code is None:
            found = NumpyProgram(program).run_designs(table, inputs, fields, length=n)
        else:
            found = code.store(table, inputs, fields, threads=self.manner.threads or cores(), length=n)
        return np.stack([q.shown(found[:, k]) for k, q in enumerate(quantities)], axis=1)

    def _stored(self, names: tuple[str, ...], traced: Traced) -> tuple[list[Quantity], Program]:
        """What a program stores of some outputs, and it; what is found design by design are its fields."""
        if (names, id(traced)) not in self._programs:
            quantities = list(traced.quantities(names).values())
            program = Program.of(traced.solver.motion.trace, {q.name: q.carrier for q in quantities})
            self._programs[names, id(traced)] = quantities, _fed(program)
        return self._programs[names, id(traced)]

    def _input(self) -> Floats:
        rows = [rows[0] for rows in self.positions.coordinates.values()]
        return rows[0] if rows else np.zeros(1)

    @cached_property
    def own(self) -> str:
        """What all blocks depend on."""
        known = self.reductions, self.positions.count, self.manner.partial, self.manner.backend
        return identity(dump(replace(self.mechanism, optimize={})), *known)

    def _block(self, part: Mapping[str, Floats], first: int) -> Results:
        """The results of a block, with what they have of single designs; kept where parts are kept."""

        def found() -> tuple[Results, dict[int, str], list[int]]:
            unloaded, through = dict(self.unloaded), set(self.through)
            results = self._in_pieces(part, first)
            new = {k - first: why for k, why in self.unloaded.items() if k not in unloaded}
            return results, new, [k - first for k in self.through - through]

        results, unloaded, through = once(found, lambda: (self.own, part))
        self.unloaded |= {first + k: why for k, why in unloaded.items()}
        self.through |= {first + k for k in through}
        return results

    def _in_pieces(self, part: Mapping[str, Floats], first: int) -> Results:
        """The results of a block; in pieces of a short time each, where somebody asks how far it is. Loads that are
        found for many designs at once are found so fast that a block is one piece."""
        if self.progress is None or (self.alone and self._together):
            return self._computed(part, first)
        pieces, count = [], len(next(iter(part.values())))
        self.backend = self.manner.backend
        if self.backend == "auto" and count * self.positions.count >= WORTH_COMPILING and available():
            self.backend = "llvm"  # as it serves the whole block
        for low, high in paced(count):
            pieces.append(self._computed({a: c[low:high] for a, c in part.items()}, first + low))
            self.tell(first + high)
        return {name: np.concatenate([each[name] for each in pieces]) for name in pieces[0]}

    def _computed(self, part: Mapping[str, Floats], first: int) -> Results:
        numbers = np.arange(first, first + len(next(iter(part.values()))))
        if self.traced.nominal.modes:
            return self._noted(self._one_by_one(self._flipping, part), numbers)
        if self._together:
            results = self._noted(self._again(*self._with_loads(part), part), numbers)
        elif self.alone:
            results = self._noted(self._one_by_one(self._single, part), numbers)
        else:
            results = self._reduced(self.traced, self.program, part, {})
        return self._through_change_points(results, part, first)

    def _one_by_one(self, source: OneByOne, part: Mapping[str, Floats]) -> tuple[Results, dict[int, str]]:
        """Two passes: the motion of each design with its loads, then the summaries of the block."""
        quantities = source.traced.quantities(self.quantities)
        program = _fed(source.traced.program(quantities, {VALID: source.valid}))
        rows, failed, through = source.rows(program.fields, part)
        results = self._reduced(source.traced, program, part, rows)
        results[PASSED] = np.logical_and(results[PASSED], through)
        return results, failed

    @property
    def _together(self) -> bool:
        """Whether the loads, and the states, of the designs of a block are found at once."""
        return (self.alone or bool(self.program.states)) and self._loaded is not None

    @cached_property
    def _loaded(self) -> LoadedCycle | None:
        """The loads and the friction where these are traced; None where some are not."""
        if (self.alone and self.manner.partial) or self.traced.nominal.modes:
            return None
        return loaded_cycle(self.traced, self.columns, self.program.fields)

    @cached_property
    def _doubts(self) -> dict[str, Scalar]:
        return {} if self._loaded is None else doubts(self._loaded.traced, self._loaded.loads)

    @cached_property
    def _traced_loads(self) -> Program:
        """The program in which the loads are traced; states are given per design and position."""
        assert self._loaded is not None
        traced = self._loaded.traced
        more: dict[str, Scalar | bool] = dict(self._doubts)
        if self._tracked is not None:
            motion = traced.solver.motion
            more[VALID] = motion.trace.logic("and", motion.valid, self._tracked.on_path)
        return _fed(traced.program(traced.quantities(self.quantities), more))

    @cached_property
    def _tracked(self) -> TrackedStates | None:
        """What tracks groups without closed form, and counts turns; None where nothing must be, or loads are not
        traced."""
        if not self.program.states or self._loaded is None:
            return None
        solver, compiled = self._loaded.traced.solver, self.manner.backend != "numpy"
        return tracked_states(self.traced.nominal, solver, compiled)

    def _with_loads(self, part: Mapping[str, Floats]) -> tuple[Results, Indices]:
        """The results of a block whose loads are traced, and whose states are tracked, and the numbers of the designs
        of which these are not certain."""
        program, loaded = self._traced_loads, self._loaded
        assert loaded is not None
        threads = self.manner.threads or cores()
        states, margin = ({}, None) if self._tracked is None else self._tracked.of(part, threads)
        wanted = [*self.reductions, *(Reduction(name, "sum") for name in self._doubts)]
        limits = loaded.solve(part)
        results = summaries(program, wanted, VALID).evaluate(
            loaded.table(program.parameters, part, {} if limits is None else limits.numbers),
            self.positions.arrays,
            states,
            tables=loaded.loads.tables,
            threads=self.manner.threads,
            backend=self.backend,
        )
        results |= {name: results.pop(f"{name}.sum") for name in self._doubts}
        if margin is not None:
            results[MARGIN] = margin
        return results, loaded.doubtful(results, limits)

    def _again(
        self, results: Results, doubtful: Indices, part: Mapping[str, Floats]
    ) -> tuple[Results, dict[int, str]]:
        """The results of all designs together, those of which something is not certain found one by one."""
        results[PASSED] = results["valid.count"] == self.positions.count
        if not len(doubtful):
            return results, {}
        again, failed = self._one_by_one(self._single, {a: c[doubtful] for a, c in part.items()})
        for name, column in again.items():
            results[name][doubtful] = column
        return results, {int(doubtful[index]): sentence for index, sentence in failed.items()}

    def _noted(self, found: tuple[Results, dict[int, str]], numbers: Indices) -> Results:
        """The results; sentences of designs that failed are kept under their numbers in the whole sweep."""
        results, failed = found
        self.unloaded.update({int(numbers[index]): sentence for index, sentence in failed.items()})
        return results

    @cached_property
    def _touching(self) -> ChangePoints:
        return ChangePoints(self.traced, self.backend)

    @cached_property
    def _single(self) -> OneByOne:
        """For designs whose loads follow their own motion."""
        return OneByOne(self.traced)

    @cached_property
    def _flipping(self) -> OneByOne:
        """For designs that pass change points."""
        return OneByOne(Traced(self.mechanism, self.columns, self.positions, flipping=True), flipping=True)

    def _through_change_points(self, results: Results, part: Mapping[str, Floats], first: int) -> Results:
        """The same results, those of designs that touch a change point between two positions, or cannot pass there,
        done again over the positions that they reach; if asked for in part, of all that do not pass."""
        if self.program.states or self.positions.count < 3:
            return results
        count = np.asarray(results["valid.count"])
        whole = count == self.positions.count
        with np.errstate(invalid="ignore"):
            near = np.flatnonzero(
                (np.asarray(results[f"{NEAREST}.min"]) < near_enough(self.positions)) & whole
            )
        if len(near):
            near = near[self._touching.designs({a: c[near] for a, c in part.items()})]
        if self.manner.partial:
            near = np.append(near, np.flatnonzero(~whole & (count > 0)))
        self.through.update((first + near).tolist())
        if len(near):
            found = self._one_by_one(self._flipping, {a: c[near] for a, c in part.items()})
            again = self._noted(found, first + near)
            for name, column in again.items():
                results[name][near] = column
        return results

    def _reduced(
        self, traced: Traced, program: Program, part: Mapping[str, Floats], rows: Mapping[str, Floats]
    ) -> Results:
        results = summaries(program, self.reductions, VALID).evaluate(
            traced.table(program, part),
            self.positions.arrays,
            rows,
            threads=self.manner.threads,
            backend=self.backend,
        )
        results[PASSED] = results["valid.count"] == self.positions.count
        return results


def _fed(program: Program) -> Program:
    """The same program with states and signs of assembly modes as inputs per design and position."""
    modes = [Input("mode", group).name for group in mode_groups(program.positions)]
    return inputs_as_fields(program, [*program.states, *modes])
