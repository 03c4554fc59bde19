"""Summaries of many designs of one structure: a cycle program of one stage."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from linkwright.engine.cycle import CycleProgram, Progress
from linkwright.engine.program import Program
from linkwright.engine.recent import Recent
from linkwright.engine.reductions import VALID_COUNT, Kind, Reduction, Results
from linkwright.engine.stage import Arrays, Backend, Stage
from linkwright.engine.table import Tables

__all__ = ["VALID_COUNT", "Backend", "Progress", "Reduction", "Results", "sweep"]


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
    after: Program | None = None,
    threads: int | None = None,
    backend: Backend = "auto",
) -> Results:
    """Reductions of a program's outputs over the positions, for every design.

    ``parameters``: (designs, parameters) in the order of ``program.parameters``. ``positions``:
    (n,) per name; ``fields``: (designs, n) per name; ``start``: (designs, states), where the
    program carries states; ``length``: n, where no input is an array. The rest as for
    :class:`~linkwright.engine.stage.Stage` and :meth:`CycleProgram.evaluate`.

    Returns ``output.kind`` (``output.at_max.of``) to an array (designs,), the outputs of ``after`` by
    their names, and the number of valid positions as ``valid.count``; for a design without a valid
    position NaN, position number -1, sum and count 0. Raises ValueError for unknown outputs, kinds or
    back ends and missing inputs.
    """
    wanted = tuple(r if isinstance(r, Reduction) else Reduction(*r) for r in reductions)
    table = np.ascontiguousarray(parameters, dtype=np.float64)
    count = len(program.parameters)
    if table.ndim != 2 or table.shape[1] != count:
        raise ValueError(f"parameters must have the shape (designs, {count}), but have {table.shape}")
    if start is not None:
        begin = np.asarray(start, dtype=np.float64)
        table = np.hstack([table, np.broadcast_to(begin, (len(table), begin.shape[-1]))])
    steps = None if positions or fields else length
    key = (wanted, valid, id(after), steps, start is not None)
    cycle = _cycles.get(program, key, lambda: _cycle(program, wanted, valid, after, steps, start is not None))
    return cycle.evaluate(table, positions, fields, tables=tables, threads=threads, backend=backend)


def _cycle(
    program: Program,
    reductions: tuple[Reduction, ...],
    valid: str | None,
    after: Program | None,
    steps: int | None,
    started: bool,
) -> CycleProgram:
    starts = {name: f"start:{name}" for name in program.states if started}
    named = {r.name: r for r in reductions}
    stage = Stage(program, named, after, valid, VALID_COUNT, steps=steps, starts=starts)
    return CycleProgram((stage,), (*program.parameters, *starts.values()))


_cycles: Recent[Program, CycleProgram] = Recent(64)
