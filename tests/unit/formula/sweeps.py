"""Summaries of many designs of one program."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.numpy_backend import numpy_program
from linkwright.formula.program import Program
from linkwright.formula.reductions import Accumulation, Kind, Reduction, Results, accumulate
from linkwright.formula.summaries import Arrays, Backend, Summaries
from linkwright.formula.table import Tables


def sweep(
    program: Program,
    parameters: ArrayLike,
    positions: Arrays,
    reductions: Sequence[Reduction | tuple[str, Kind]],
    *,
    fields: Arrays | None = None,
    start: ArrayLike | None = None,
    length: int | None = None,
    tables: Tables | None = None,
    valid: str | None = "valid",
    threads: int | None = None,
    backend: Backend = "auto",
) -> Results:
    """Reductions of a program's outputs over the positions, for every design.

    ``parameters``: (designs, parameters); ``start``: (designs, states), where the program carries states; ``length``:
    of the positions, where no input is an array.
    """
    wanted = tuple(r if isinstance(r, Reduction) else Reduction(*r) for r in reductions)
    if start is None:
        sums = Summaries(program, wanted, valid)
        return sums.evaluate(parameters, positions, fields, tables=tables, threads=threads, backend=backend)
    table = np.asarray(parameters, dtype=np.float64)
    accumulation = Accumulation(program, wanted, valid if valid in program.output_names else None)
    own = np.ascontiguousarray(table[:, [program.parameters.index(name) for name in accumulation.parameters]])
    compiled = None if backend == "numpy" else compile_program(program, accumulation)
    if compiled is not None:
        return compiled.sweep(own, positions, fields or {}, start=start, length=length, tables=tables)
    evaluator, count = numpy_program(accumulation.needed), length or np.size(next(iter(positions.values())))
    sums, names = accumulation.start(len(table)), accumulation.needed.output_names
    own = own[:, : len(accumulation.needed.parameters)]
    for part, columns, outputs in evaluator.blocks(
        own, positions, fields or {}, start=start, length=count, tables=tables
    ):
        accumulate(accumulation, sums[part], outputs, names, columns.start)
    return accumulation.finish(sums, count)
