"""Summaries of many designs of one program."""

from collections.abc import Sequence

from numpy.typing import ArrayLike

from linkwright.formula.program import Program
from linkwright.formula.reductions import Kind, Reduction, Results
from linkwright.formula.summaries import Arrays, Backend, Summaries
from linkwright.formula.table import Tables


def sweep(
    program: Program,
    parameters: ArrayLike,
    positions: Arrays,
    reductions: Sequence[Reduction | tuple[str, Kind]],
    *,
    fields: Arrays | None = None,
    tables: Tables | None = None,
    valid: str | None = "valid",
    threads: int | None = None,
    backend: Backend = "auto",
) -> Results:
    """Reductions of a program's outputs over the positions, for every design.

    ``parameters``: (designs, parameters).
    """
    wanted = tuple(r if isinstance(r, Reduction) else Reduction(*r) for r in reductions)
    sums = Summaries(program, wanted, valid)
    return sums.evaluate(parameters, positions, fields, tables=tables, threads=threads, backend=backend)
