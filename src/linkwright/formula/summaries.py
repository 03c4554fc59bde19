"""Summaries of a program's outputs over the positions, for many designs at once, on the back end asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.reductions import Accumulation, Reduction, Results, accumulate
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.table import Tables
from linkwright.formula.threads import cores, spread_over

if TYPE_CHECKING:
    from linkwright.formula.llvm_backend import CompiledProgram

Backend = Literal["auto", "numpy", "llvm"]
BACKENDS: tuple[Backend, ...] = ("auto", "numpy", "llvm")
Arrays = Mapping[str, ArrayLike]

#: Below this number of configurations NumPy has answered before a program is compiled.
WORTH_COMPILING = 20_000
#: From this number of designs on, what is the same for all of them is found beforehand.
_WORTH_PARTING = 4
#: Lines of a program that Python has evaluated before NumPy or a compiled one is called.
_SHORT = 120
_NUMPY_CHUNK = 1 << 18
#: Configurations of a block.
_BLOCK = 1 << 26


class How(TypedDict, total=False):
    """``tables``: those that a program looks up; ``threads``: None for all cores."""

    tables: Tables | None
    threads: int | None
    backend: Backend


@dataclass(frozen=True)
class Run:
    """How and over what a program is evaluated: ``length`` positions, ``threads`` threads."""

    positions: Arrays
    length: int
    tables: Tables | None
    threads: int
    backend: Backend


class Summaries:
    """Reductions of a program's outputs over the positions, and the number of valid ones as ``valid.count``.

    ``valid``: the truth output that says which positions enter; without an output of this name all do.
    """

    def __init__(self, program: Program, reductions: Sequence[Reduction], valid: str | None = "valid") -> None:
        self.program, self.parameters = program, program.parameters
        judged = valid if valid in program.output_names else None
        self._accumulation = Accumulation(program, tuple(reductions), judged)

    @cached_property
    def _places(self) -> list[int] | None:
        """The columns that are taken; None for all."""
        taken = self._accumulation.parameters
        return None if taken == self.parameters else [self.parameters.index(name) for name in taken]

    def evaluate(
        self, table: ArrayLike, positions: Arrays | None = None, fields: Arrays | None = None, **how: Unpack[How]
    ) -> Results:
        """The summaries by their names, (designs,) each.

        ``table``: (designs, parameters); ``positions``: (n,) per name; ``fields``: (designs, n) per name;
        ``tables``: those that the program looks up. ``threads``: None for all cores; results do not depend on it.
        ``backend`` ``auto`` compiles where that pays and llvmlite is there. Memory does not grow with the designs,
        but for fields and results. Raises ValueError for unknown back ends, missing inputs and wrong shapes.
        """
        return in_blocks(self._found, _BLOCK, self.parameters, table, positions, fields, **how)

    def _found(self, numbers: Floats, fields: Arrays, run: Run) -> Results:
        own = numbers if self._places is None else np.ascontiguousarray(numbers[:, self._places])
        return reduced(self._accumulation, own, fields, run)


def summaries(program: Program, reductions: Sequence[Reduction], valid: str | None = "valid") -> Summaries:
    """Those of a program, cached for it."""
    key = (*reductions, valid)
    return _summaries.get(program, key, lambda: Summaries(program, reductions, valid))


_summaries: Recent[Program, Summaries] = Recent(64)


def in_blocks(
    find: Callable[[Floats, Arrays, Run], Results],
    size: int,
    parameters: Sequence[str],
    table: ArrayLike,
    positions: Arrays | None,
    fields: Arrays | None,
    *,
    tables: Tables | None = None,
    threads: int | None = None,
    backend: Backend = "auto",
) -> Results:
    """What is found of some designs after the other, from their numbers (designs, parameters) and their fields;
    ``size``: most configurations of one block."""
    if backend not in BACKENDS:
        raise ValueError(f"there is no back end '{backend}': use auto, numpy or llvm")
    numbers = np.ascontiguousarray(table, dtype=np.float64)
    if numbers.ndim != 2 or numbers.shape[1] != len(parameters):
        wanted = ", ".join(parameters)
        raise ValueError(f"the table must have the columns {wanted}, not the shape {numbers.shape}")
    columns = {name: np.ascontiguousarray(a, dtype=np.float64) for name, a in (fields or {}).items()}
    lengths = {int(np.shape(array)[-1]) for array in (*(positions or {}).values(), *columns.values())}
    if len(lengths) != 1:
        raise ValueError(f"inputs over the positions must have one length, but have {sorted(lengths)}")
    n = lengths.pop()
    run = Run(positions or {}, n, tables, cores() if threads is None else threads, backend)
    several = max(1, size // max(n, 1))
    parts = [
        find(numbers[k : k + several], {name: each[k : k + several] for name, each in columns.items()}, run)
        for k in range(0, len(numbers) or 1, several)
    ]
    return parts[0] if len(parts) == 1 else {name: np.concatenate([p[name] for p in parts]) for name in parts[0]}


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
    outputs = scalar.step((), [float(np.asarray(columns[name])[0]) for name in program.positions])
    return np.array(outputs)[:, None]


_short: Recent[Program, ScalarProgram] = Recent(64)


def reduced(accumulation: Accumulation, table: Floats, fields: Arrays, run: Run) -> Results:
    """Reductions of some designs, by their own names, on the back end that is asked for.

    ``table``: (designs, parameters) in the order of ``accumulation.parameters``.
    """
    if len(table) >= _WORTH_PARTING and accumulation.split_by_design is not None:
        alone, accumulation = accumulation.split_by_design
        rows = numpy_program(alone).run((), run.positions, length=run.length, tables=run.tables)
        found = dict(zip(alone.output_names, rows, strict=True))
        run = Run({**run.positions, **found}, run.length, run.tables, run.threads, run.backend)
    compiled = code_for(accumulation.program, accumulation, run, len(table))
    if compiled is None:
        return _by_numpy(accumulation, table, fields, run)
    return compiled.sweep(table, run.positions, fields, threads=run.threads, length=run.length, tables=run.tables)


def code_for(program: Program, accumulation: Accumulation | None, run: Run, designs: int) -> CompiledProgram | None:
    """The compiled program; None where NumPy is asked for, is all there is, or has answered before."""
    if run.backend == "numpy" or (run.backend == "auto" and designs * run.length < WORTH_COMPILING):
        return None
    from linkwright.formula.llvm_backend import compile_program

    compiled = compile_program(program, accumulation)
    if compiled is None and run.backend == "llvm":
        raise ValueError("llvmlite cannot be loaded: install it, or use the numpy back end")
    return compiled


def _by_numpy(accumulation: Accumulation, table: Floats, fields: Arrays, run: Run) -> Results:
    """In blocks that fit the cache."""
    evaluator = numpy_program(accumulation.needed)
    names = accumulation.needed.output_names
    sums, n = accumulation.start(len(table)), run.length
    count = len(accumulation.needed.parameters)

    def work(first: int, end: int) -> None:
        rows = {name: np.asarray(array)[first:end] for name, array in fields.items()}
        part, numbers = sums[first:end], table[first:end, :count]
        blocks = evaluator.blocks(numbers, run.positions, rows, length=n, tables=run.tables)
        for designs, columns, outputs in blocks:
            with np.errstate(all="ignore"):
                accumulate(accumulation, part[designs], outputs, names, columns.start)

    spread_over(len(table), max(1, _NUMPY_CHUNK // max(n, 1)), run.threads, work)
    return accumulation.finish(sums, n)
