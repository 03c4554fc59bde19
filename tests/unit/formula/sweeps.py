"""Summaries of many designs of one program."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from linkwright.formula.program import Program
from linkwright.formula.reductions import Accumulation, Kind, Reduction, Results
from linkwright.formula.summaries import Arrays, Backend, Run, Summaries, reduced
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
    taken = [program.parameters.index(name) for name in accumulation.parameters]
    count = length or len(np.asarray(next(iter(positions.values()))))
    begin = np.broadcast_to(np.asarray(start, dtype=np.float64), (len(table), len(program.states)))
    run = Run(positions, count, tables, threads or 1, backend)
    return reduced(accumulation, np.ascontiguousarray(table[:, taken]), fields or {}, begin, run)
