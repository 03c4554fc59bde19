"""Summaries of many designs of one program."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from linkwright.engine.cycle import CycleProgram
from linkwright.engine.program import Program
from linkwright.engine.reductions import VALID_COUNT, Kind, Reduction, Results
from linkwright.engine.stage import Stage
from linkwright.engine.summaries import Arrays, Backend
from linkwright.engine.table import Tables


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
    """Reductions of a program's outputs over the positions, for every design, by a cycle program of one stage.

    ``parameters``: (designs, parameters); ``start``: (designs, states), where the program carries states; ``length``:
    of the positions, where no input is an array.
    """
    wanted = tuple(r if isinstance(r, Reduction) else Reduction(*r) for r in reductions)
    table = np.asarray(parameters, dtype=np.float64)
    if start is not None:
        begin = np.asarray(start, dtype=np.float64)
        table = np.hstack([table, np.broadcast_to(begin, (len(table), begin.shape[-1]))])
    steps = None if positions or fields else length
    starts = {name: f"start:{name}" for name in program.states if start is not None}
    named = {r.name: r for r in wanted}
    stage = Stage(program, named, valid, VALID_COUNT, steps=steps, starts=starts)
    cycle = CycleProgram((stage,), (*program.parameters, *starts.values()))
    return cycle.evaluate(table, positions, fields, tables=tables, threads=threads, backend=backend)
