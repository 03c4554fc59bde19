"""One stage of a cycle program: a program at all positions of some designs, and what is made of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.reductions import VALID_COUNT, Accumulation, Reduction, Results
from linkwright.engine.replay import across_designs
from linkwright.engine.summaries import Run, code_for, over_designs, reduced


@dataclass(frozen=True, eq=False)
class Stage:
    """A program over the positions; its results are cycle values, which later stages take as parameters.

    ``reductions``: by the name of the result. ``valid``: the truth output that
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
        return Accumulation(self.program, tuple(self.reductions.values()), judged)

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
        return (*self.reductions, *([self.count] if self.count else []))

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
        if self.count:
            results[self.count] = found[VALID_COUNT]
        valid = np.asarray(found[VALID_COUNT])
        return results, (valid != run.length) if self.complete else np.zeros(len(valid), dtype=np.bool_)

    @cached_property
    def formulas(self) -> Program | None:
        """The program over the designs, where it is nothing but formulas of each design's numbers."""
        accumulation = self.accumulation
        needed = accumulation.needed
        plain = not (needed.positions or needed.fields or needed.states or accumulation.valid)
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


def blank(results: Results, failed: Flags) -> None:
    """Take the results of failed designs away (in place)."""
    if failed.any():
        for values in results.values():
            values[failed] = np.nan if values.dtype == np.float64 else -1
