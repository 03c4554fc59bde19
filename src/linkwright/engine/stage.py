"""One stage of a cycle program: a program at all positions of some designs, and what is made of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.recently_made import Recent
from linkwright.engine.reductions import VALID_COUNT, Accumulation, Reduction, Results, accumulate
from linkwright.engine.replay import across_designs
from linkwright.engine.scalar_backend import ScalarProgram
from linkwright.engine.table import Tables
from linkwright.engine.threads import spread_over

if TYPE_CHECKING:
    from linkwright.engine.llvm_backend import CompiledProgram

Backend = Literal["auto", "numpy", "llvm"]
BACKENDS: tuple[Backend, ...] = ("auto", "numpy", "llvm")
Arrays = Mapping[str, ArrayLike]

#: Below this number of configurations NumPy has answered before a program is compiled.
WORTH_COMPILING = 20_000
#: As many configurations, or more, count the designs of a position where states go on to the next one.
_IN_TURN = 64
#: From this number of designs on, what is the same for all of them is found beforehand.
_WORTH_PARTING = 4
#: Lines of a program that Python has evaluated before NumPy or a compiled one is called.
_SHORT = 120
_NUMPY_CHUNK = 1 << 18


@dataclass(frozen=True)
class Run:
    """How and over what a stage is evaluated: ``length`` positions, ``threads`` threads."""

    positions: Arrays
    length: int
    tables: Tables | None
    threads: int
    backend: Backend


@dataclass(frozen=True, eq=False)
class Stage:
    """A program over the positions; its results are cycle values, which later stages take as parameters.

    ``reductions``: by the name of the result. ``after``: a program per design behind them, whose outputs
    are results (see :class:`~linkwright.engine.reductions.Accumulation`). ``valid``: the truth output that
    says which positions enter; without an output of this name all do. ``count``: the name of the result
    that is the number of valid positions, if wanted. ``complete``: a design with a position that is not
    valid has no results from here on: NaN, or -1 for position numbers and counts.

    ``steps``: the stage has no positions but is an iteration of so many steps; a program with states takes
    their first values from ``starts``: a dimension, a cycle value, or a number, by the name of the state.
    ``keep``: outputs that later stages take as fields of the same name. ``roots``: what an iteration
    solves, by the name of the state: the output that it brings to zero. Derivatives need it: they are
    those of the solution (implicit function theorem), not of the steps.
    """

    program: Program
    reductions: Mapping[str, Reduction] = field(default_factory=dict)
    after: Program | None = None
    valid: str | None = "valid"
    count: str = ""
    complete: bool = False
    steps: int | None = None
    starts: Mapping[str, str | float] = field(default_factory=dict)
    keep: tuple[str, ...] = ()
    roots: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def accumulation(self) -> Accumulation:
        """The accumulators of the stage. Raises ValueError for outputs and kinds that do not exist."""
        judged = self.valid if self.valid in self.program.output_names else None
        return Accumulation(self.program, tuple(self.reductions.values()), judged, self.after)

    @cached_property
    def kept(self) -> Program:
        """The program of the outputs that later stages take as fields."""
        return self.program.only(list(self.keep))

    def manner(self, run: Run) -> Run:
        """The same manner over this stage's own positions."""
        if self.steps is None:
            return run
        return Run({}, self.steps, run.tables, run.threads, run.backend)

    @property
    def results(self) -> tuple[str, ...]:
        """Names of the results."""
        following = self.after.output_names if self.after is not None else ()
        return (*self.reductions, *following, *([self.count] if self.count else []))

    @property
    def parameters(self) -> tuple[str, ...]:
        """What it takes of every design."""
        started = [self.starts[name] for name in self.program.states if name in self.starts]
        kept = self.kept.parameters if self.keep else ()
        named = [name for name in started if isinstance(name, str)]
        return tuple(dict.fromkeys([*self.accumulation.parameters, *kept, *named]))

    def evaluate(
        self, table: Floats, fields: Mapping[str, Floats], start: Floats | None, run: Run
    ) -> tuple[Results, Flags]:
        """Results of some designs, and which of them have none from here on.

        ``table``: in the order of ``accumulation.parameters``; ``start``: of ``accumulation.needed.states``.
        """
        if self.formulas is not None:
            return self._by_formulas(self.formulas, table, run), np.zeros(len(table), dtype=np.bool_)
        own = {name: fields[name] for name in self.accumulation.needed.fields if name in fields}
        found = reduced(self.accumulation, table, own, start, run)
        results = {name: found[r.name] for name, r in self.reductions.items()}
        results |= {name: found[name] for name in (self.after.output_names if self.after else ())}
        if self.count:
            results[self.count] = found[VALID_COUNT]
        valid = np.asarray(found[VALID_COUNT])
        return results, (valid != run.length) if self.complete else np.zeros(len(valid), dtype=np.bool_)

    @cached_property
    def formulas(self) -> Program | None:
        """The program over the designs, where it is nothing but formulas of each design's numbers."""
        accumulation = self.accumulation
        needed = accumulation.needed
        plain = not (needed.positions or needed.fields or needed.states or self.after or accumulation.valid)
        taken = all(reduction.kind in _OF_ONE and not reduction.of for reduction in accumulation.reductions)
        return across_designs(needed) if self.steps == 1 and plain and taken and not self.count else None

    def _by_formulas(self, formulas: Program, table: Floats, run: Run) -> Results:
        columns = dict(zip(self.accumulation.parameters, table.T, strict=True))
        found = dict(
            zip(formulas.output_names, over_designs(formulas, columns, len(table), run), strict=True)
        )
        return {name: np.array(found[reduction.output]) for name, reduction in self.reductions.items()}

    def fields(
        self, table: Floats, fields: Mapping[str, Floats], start: Floats | None, run: Run
    ) -> dict[str, Floats]:
        """The outputs to keep, (designs, n) each; inputs in the order of ``kept.parameters``, ``.states``."""
        compiled = code_for(self.kept, None, run, len(table))
        if compiled is not None:
            found = compiled.store(
                table,
                run.positions,
                fields,
                start=start,
                threads=run.threads,
                length=run.length,
                tables=run.tables,
            )
        else:
            found = numpy_program(self.kept).run_designs(
                table, run.positions, fields, start=start, length=run.length, tables=run.tables
            )
        return {name: found[:, place] for place, name in enumerate(self.keep)}


#: Reductions that are the value itself where there is one position.
_OF_ONE = ("first", "last", "sum", "mean", "min", "max")


def over_designs(program: Program, columns: Mapping[str, ArrayLike], count: int, run: Run) -> Floats:
    """Outputs (outputs, designs) of a program whose positions are designs; ``columns``: (designs,) each."""
    if count == 1 and len(program.entries) <= _SHORT:
        return _one_design(program, columns, run)
    compiled = code_for(program, None, Run(columns, count, run.tables, 1, run.backend), 1)
    if compiled is None:
        return numpy_program(program).run((), columns, length=count, tables=run.tables)
    stored: Floats = compiled.store(np.empty((1, 0)), columns, length=count, tables=run.tables)[0]
    return stored


def _one_design(program: Program, columns: Mapping[str, ArrayLike], run: Run) -> Floats:
    scalar = (
        ScalarProgram(program, run.tables)
        if program.tables
        else _short.get(program, None, lambda: ScalarProgram(program))
    )
    outputs, _ = scalar.step((), [float(np.asarray(columns[name])[0]) for name in program.positions])
    return np.array(outputs)[:, None]


_short: Recent[Program, ScalarProgram] = Recent(64)


def blank(results: Results, failed: Flags) -> None:
    """Take the results of failed designs away (in place)."""
    if failed.any():
        for values in results.values():
            values[failed] = np.nan if values.dtype == np.float64 else -1


def reduced(
    accumulation: Accumulation, table: Floats, fields: Arrays, start: Floats | None, run: Run
) -> Results:
    """Reductions of some designs, by their own names, on the back end that is asked for.

    ``table``: (designs, parameters) in the order of ``accumulation.parameters``.
    """
    if len(table) >= _WORTH_PARTING and accumulation.apart is not None:
        alone, accumulation = accumulation.apart
        rows = numpy_program(alone).run((), run.positions, length=run.length, tables=run.tables)
        found = dict(zip(alone.output_names, rows, strict=True))
        run = Run({**run.positions, **found}, run.length, run.tables, run.threads, run.backend)
    compiled = code_for(accumulation.program, accumulation, run, len(table))
    if compiled is None:
        return _by_numpy(accumulation, table, fields, start, run)
    return compiled.sweep(
        table,
        run.positions,
        fields,
        start=start,
        threads=run.threads,
        length=run.length,
        tables=run.tables,
    )


def code_for(
    program: Program, accumulation: Accumulation | None, run: Run, designs: int
) -> CompiledProgram | None:
    """The compiled program; None where NumPy is asked for, is all there is, or has answered before."""
    count = max(designs, _IN_TURN) if program.states else designs
    if run.backend == "numpy" or (run.backend == "auto" and count * run.length < WORTH_COMPILING):
        return None
    from linkwright.engine.llvm_backend import compile_program

    compiled = compile_program(program, accumulation)
    if compiled is None and run.backend == "llvm":
        raise ValueError("llvmlite cannot be loaded: install it, or use the numpy back end")
    return compiled


def _by_numpy(
    accumulation: Accumulation, table: Floats, fields: Arrays, start: Floats | None, run: Run
) -> Results:
    """In blocks that fit the cache."""
    evaluator = numpy_program(accumulation.needed)
    names = accumulation.needed.output_names
    sums, n = accumulation.start(len(table)), run.length
    count = len(accumulation.needed.parameters)

    def work(first: int, end: int) -> None:
        rows = {name: np.asarray(array)[first:end] for name, array in fields.items()}
        own = None if start is None else start[first:end]
        part, numbers = sums[first:end], table[first:end, :count]
        blocks = evaluator.blocks(numbers, run.positions, rows, start=own, length=n, tables=run.tables)
        for designs, columns, outputs in blocks:
            with np.errstate(all="ignore"):
                accumulate(accumulation, part[designs], outputs, names, columns.start)

    spread_over(len(table), max(1, _NUMPY_CHUNK // max(n, 1)), run.threads, work)
    if accumulation.following is not None:
        _follow(accumulation, accumulation.following, table, sums, run)
    return accumulation.finish(sums, n)


def _follow(accumulation: Accumulation, following: Program, table: Floats, sums: Floats, run: Run) -> None:
    """Evaluate what follows the positions into its columns of ``sums``."""
    inputs = np.empty((len(table), len(following.parameters)))
    for column, name in enumerate(following.parameters):
        origin, place = accumulation.source(name)
        if origin == "count":
            inputs[:, column] = run.length
        else:
            inputs[:, column] = (table if origin == "parameter" else sums)[:, place]
    outputs = numpy_program(following).run_designs(inputs, {}, length=1, tables=run.tables)
    sums[:, len(accumulation.steps) :] = outputs[:, :, 0]
