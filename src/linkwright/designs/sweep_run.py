"""The work of one sweep: block by block, designs together, where they can be, else one by one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices, Integers
from linkwright.core.progress import Progress, current_progress, paced
from linkwright.cycle.load_limits import FoundLimits
from linkwright.cycle.summaries import Summary, finished, reductions
from linkwright.designs.checkpoints import checkpointed, identity
from linkwright.designs.failures import ChangePoints, near_enough
from linkwright.designs.metrics_of_designs import changes_of, motion_alone, outputs_alone, places_in, summary_of
from linkwright.designs.traced_outputs import NEAREST, VALID, LoadedCycle, Traced, loaded_cycle
from linkwright.errors import LinkwrightError, SelfCheckError
from linkwright.events.path_tracker import TrackedStates, tracked_states
from linkwright.events.tracked_groups import ITERATIONS
from linkwright.files.write import dump
from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.machine_code import available
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import VALID_COUNT, Reduction, Results
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
#: Designs of one block, of one whose loads are found together, and of one whose designs are found alone.
BLOCK, TOGETHER_BLOCK, ALONE_BLOCK = 1 << 16, 1 << 13, 1 << 9
#: Designs whose states at all positions are held at a time.
TRACKED_BLOCK = 1 << 11
#: Designs whose curves are held at a time.
CURVE_BLOCK = 1 << 12
#: Designs of a sweep whose forces are checked, and the positions in which they are.
CHECKED, CHECK_STEPS = 3, 24


@dataclass(frozen=True)
class Manner:
    """How a sweep is done; see :func:`linkwright.designs.sweep.sweep`. ``sampled``: summaries are those of the
    positions, else nothing but the motion is wanted of these."""

    partial: bool = False
    threads: int | None = None
    backend: Backend = "auto"
    progress: Progress | None = None
    sampled: bool = True


#: Sentences of those of the first few designs of a mechanism that do not pass, by number.
_few: Recent[Mechanism, dict[int, str]] = Recent(64)


class SweepRun:
    """Summaries of all designs; ``unloaded``: sentences of the designs whose loads cannot be found; ``alone``:
    numbers of those that are found each by itself; ``margins``: see
    :attr:`linkwright.designs.sweep.Sweep.branch_margin`."""

    def __init__(
        self,
        mechanism: Mechanism,
        columns: Mapping[str, Floats],
        asked: tuple[Summary, ...],
        positions: Positions,
        manner: Manner,
    ) -> None:
        self.mechanism, self.columns, self.asked = mechanism, columns, asked if manner.sampled else ()
        self.positions, self.manner = positions, manner
        self.progress, self.backend = manner.progress or current_progress(), manner.backend
        self._reported = 0
        self.designs = len(next(iter(columns.values())))
        iterations = ITERATIONS if iterated(analysed(mechanism)) else 1
        self.traced = Traced(mechanism, columns, positions, iterations=iterations)
        self.quantities = self.traced.quantities(summary.output for summary in asked)
        self._reduced = {each.output: self.quantities[each.output] for each in self.asked}
        self.reductions = [*reductions(self.asked, self.quantities), Reduction(NEAREST, "min")]
        self.program = self.traced.program(self._reduced)
        inputs, carried = {*self.program.fields}, self.traced.solver.motion.next_states.keys()
        self._state_dependent, self._under_loads = bool(inputs & carried), bool(inputs - carried)
        self.unloaded: dict[int, str] = {}
        self.alone: set[int] = set()
        self._programs: dict[tuple[str, ...], tuple[list[Quantity], Program]] = {}
        self.margins = None if self._tracked is None else np.full(self.designs, np.nan)

    def swept(self) -> tuple[Integers, Flags, dict[Summary, Floats]]:
        """Assembled positions (designs,), whether each design passes its cycle, and every summary (designs,)."""
        assembled, passed = np.zeros(self.designs, dtype=np.int64), np.zeros(self.designs, dtype=np.bool_)
        values = {summary: np.empty(self.designs) for summary in self.asked}
        size = ALONE_BLOCK if self._loaded is None else TOGETHER_BLOCK if self._under_loads else BLOCK
        size = size if self._tracked is None else TRACKED_BLOCK
        for first, end in chunks(self.designs, size):
            results = self._block({address: column[first:end] for address, column in self.columns.items()}, first)
            assembled[first:end], passed[first:end] = results[VALID_COUNT], results[PASSED] > 0
            if self.margins is not None:
                self.margins[first:end] = results[MARGIN]
            for summary, into in values.items():
                into[first:end] = results[summary.name]
                if not self.manner.partial:
                    into[first:end][~passed[first:end]] = np.nan
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
        if self.progress is not None and done > self._reported:
            self._reported = done
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
        """The outputs of a block, (designs, n) each; stored in the current checkpoints."""
        return checkpointed(lambda: self._curves_found(names, part, first), lambda: (self.own, part, *names))

    def _curves_found(self, names: Sequence[str], part: Mapping[str, Floats], first: int) -> dict[str, Floats]:
        passed = self._block(part, first)[PASSED] > 0
        alone = np.isin(np.arange(first, first + len(passed)), list(self.alone))
        values = np.full((len(passed), len(names), self.positions.count), np.nan)
        if (chosen := passed & ~alone).any():
            values[chosen] = self._stored(names, {a: column[chosen] for a, column in part.items()})
        for k in np.flatnonzero(passed & alone).tolist():
            motion = motion_alone(self.traced, changes_of(part, k))
            found = outputs_alone(motion, (self.quantities[name] for name in names))
            values[k] = np.stack([*found.values()])[:, places_in(motion, self.positions)]
        return {name: values[:, k] for k, name in enumerate(names)}

    def _stored(self, names: Sequence[str], part: Mapping[str, Floats]) -> Floats:
        """Outputs (designs, names, n) of designs that pass the cycle together."""
        assert self._loaded is not None
        quantities, program = self._curve_program(tuple(names))
        numbers, states, _, _ = self._known(self._loaded, program, part)
        inputs, n, tables = self.positions.arrays, self.positions.count, self._loaded.loads.tables
        code = None if self.manner.backend == "numpy" else compile_program(program)
        if code is None:
            found = NumpyProgram(program).run_designs(numbers, inputs, states, length=n, tables=tables)
        else:
            threads = self.manner.threads or cores()
            found = code.store(numbers, inputs, states, threads=threads, length=n, tables=tables)
        return np.stack([q.shown(found[:, k]) for k, q in enumerate(quantities)], axis=1)

    def _curve_program(self, names: tuple[str, ...]) -> tuple[list[Quantity], Program]:
        """What a program stores of some outputs, and it; what is tracked are its fields."""
        if names not in self._programs:
            assert self._loaded is not None
            quantities = list(self._loaded.traced.quantities(names).values())
            carriers = {each.name: each.carrier for each in quantities}
            program = Program.of(self._loaded.traced.solver.motion.trace, carriers)
            self._programs[names] = quantities, program
        return self._programs[names]

    @cached_property
    def _input(self) -> Floats:
        rows = [rows[0] for rows in self.positions.coordinates.values()]
        return rows[0] if rows else np.zeros(1)

    @cached_property
    def own(self) -> str:
        """What all blocks depend on."""
        known = self.reductions, self.positions.count, self.manner.partial, self.manner.backend
        return identity(dump(replace(self.mechanism, optimize={})), *known)

    def _block(self, part: Mapping[str, Floats], first: int) -> Results:
        """The results of a block, with what they have of single designs; stored in the current checkpoints."""

        def found() -> tuple[Results, dict[int, str], list[int]]:
            unloaded, alone = dict(self.unloaded), set(self.alone)
            results = self._in_pieces(part, first)
            new = {k - first: why for k, why in self.unloaded.items() if k not in unloaded}
            return results, new, [k - first for k in self.alone - alone]

        results, unloaded, alone = checkpointed(found, lambda: (self.own, part))
        self.unloaded |= {first + k: why for k, why in unloaded.items()}
        self.alone |= {first + k for k in alone}
        return results

    def _in_pieces(self, part: Mapping[str, Floats], first: int) -> Results:
        """The results of a block; in pieces of a short time each, where somebody asks how far it is. Loads that are
        found for many designs at once are found so fast that a block is one piece."""
        if self.progress is None or (self._under_loads and self._loaded is not None):
            return self._computed(part, first)
        pieces, count = [], len(next(iter(part.values())))
        self.backend = self.manner.backend
        if self.backend == "auto" and count * self.positions.count >= WORTH_COMPILING and available():
            self.backend = "llvm"  # as it serves the full block
        for low, high in paced(count):
            pieces.append(self._computed({a: c[low:high] for a, c in part.items()}, first + low))
            self.tell(first + high)
        return {name: np.concatenate([each[name] for each in pieces]) for name in pieces[0]}

    def _computed(self, part: Mapping[str, Floats], first: int) -> Results:
        """The number of positions, whether each design passes, and all summaries, by name."""
        count = len(next(iter(part.values())))
        if self._loaded is None:
            results: Results = {each.name: np.full(count, np.nan) for each in self.asked}
            results |= {name: np.zeros(count, dtype=np.int64) for name in (VALID_COUNT, PASSED)}
            alone = np.arange(count)
        else:
            results, alone = self._together(self._loaded, part)
        for k in alone.tolist():
            self.alone.add(first + k)
            for name, value in self._alone(changes_of(part, k), first + k).items():
                results[name][k] = value
        return results

    def _alone(self, changes: Mapping[str, float], number: int) -> dict[str, float]:
        """The same of one design as a machine by itself; why it has no forces is stored under its ``number``."""
        found: dict[str, float] = {PASSED: False, **{each.name: np.nan for each in self.asked}}
        try:
            motion = motion_alone(self.traced, changes)
            partly = self.manner.partial or motion.breaks or motion.modes
            reached = motion.ok if partly else motion.outcome_codes == 0
            found[VALID_COUNT] = int(reached.sum())
            outputs = outputs_alone(motion, self._reduced.values())
            places = places_in(motion, self.positions)
            for each in self.asked:
                values = outputs[each.output][places]
                found[each.name] = summary_of(each, values, motion.ok[places], self._input)
            found[PASSED] = motion.complete
        except LinkwrightError as error:
            self.unloaded[number] = error.sentence
        return found

    @cached_property
    def _loaded(self) -> LoadedCycle | None:
        """What the cycles of designs are found with together; None where each is found alone."""
        if self.traced.nominal.modes:
            return None
        return loaded_cycle(self.traced, self.columns, self.program.fields)

    @cached_property
    def _tracked(self) -> TrackedStates | None:
        """What tracks groups without closed form, and counts turns; None where nothing must be."""
        if not self._state_dependent or self._loaded is None:
            return None
        solver, compiled = self._loaded.traced.solver, self.manner.backend != "numpy"
        return tracked_states(self.traced.nominal, solver, compiled)

    @cached_property
    def _of_all(self) -> Program:
        """The program of all designs together, in which loads are traced; tracked states are given per design and
        position."""
        assert self._loaded is not None
        traced = self._loaded.traced
        more: dict[str, Scalar | bool] = dict(self._loaded.doubts)
        if self._tracked is not None:
            motion = traced.solver.motion
            more[VALID] = motion.trace.logic("and", motion.valid, self._tracked.on_path)
        return traced.program(traced.quantities(self._reduced), more)

    def _known(
        self, loaded: LoadedCycle, program: Program, part: Mapping[str, Floats]
    ) -> tuple[Floats, Mapping[str, Floats], Floats | None, FoundLimits | None]:
        """What a program takes of the designs of a block: numbers and states; margins of these, limits of loads."""
        threads = self.manner.threads or cores()
        states, margin = ({}, None) if self._tracked is None else self._tracked.of(part, threads)
        limits = loaded.solve(part)
        return (loaded.table(program.parameters, part, limits.numbers if limits else {}), states, margin, limits)

    def _together(self, loaded: LoadedCycle, part: Mapping[str, Floats]) -> tuple[Results, Indices]:
        """The results of a block, and the numbers of the designs that are to be found alone.

        That are those of which loads, limits or friction are not certain, and those that touch a change point between
        two positions or cannot pass there; if asked for in part, all that do not pass.
        """
        table, states, margin, limits = self._known(loaded, self._of_all, part)
        wanted = [*self.reductions, *(Reduction(name, "sum") for name in loaded.doubts)]
        found = summaries(self._of_all, wanted, VALID).evaluate(
            table,
            self.positions.arrays,
            states,
            tables=loaded.loads.tables,
            threads=self.manner.threads,
            backend=self.backend,
        )
        count = np.asarray(found[VALID_COUNT])
        complete = count == self.positions.count
        results: Results = {VALID_COUNT: found[VALID_COUNT], PASSED: complete.astype(np.int64)}
        for each in self.asked:
            results[each.name] = finished(each, self.quantities[each.output], found, self._input)
        if margin is not None:
            results[MARGIN] = margin
        alone = complete & loaded.doubtful(found, limits) | self._touching(found, part, complete)
        return results, np.flatnonzero(alone | (self.manner.partial & ~complete & (count > 0)))

    def _touching(self, found: Results, part: Mapping[str, Floats], complete: Flags) -> Flags:
        """Which designs of a block that reach the ``complete`` cycle touch a change point between two positions, or
        cannot pass there."""
        touching = np.zeros(len(complete), dtype=np.bool_)
        if not self._state_dependent and self.positions.count >= 3:
            with np.errstate(invalid="ignore"):
                near = np.flatnonzero(complete & (found[f"{NEAREST}.min"] < near_enough(self.positions)))
            if len(near):
                near = near[self._change_points.designs({a: c[near] for a, c in part.items()})]
            touching[near] = True
        return touching

    @cached_property
    def _change_points(self) -> ChangePoints:
        return ChangePoints(self.traced, self.backend)
