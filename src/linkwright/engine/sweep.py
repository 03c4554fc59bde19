"""Summaries of many designs of one structure, in fixed memory, on all cores."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.engine.numpy_backend import numpy_program
from linkwright.engine.program import Program
from linkwright.engine.recent import Recent
from linkwright.engine.reductions import VALID_COUNT, Accumulation, Kind, Reduction, accumulate
from linkwright.engine.table import Tables
from linkwright.engine.threads import chunks, cores, spread_over

Backend = Literal["auto", "numpy", "llvm"]
Floats = NDArray[np.float64]
Arrays = Mapping[str, ArrayLike]
Results = dict[str, NDArray[np.float64] | NDArray[np.int64]]
Progress = Callable[[int, int], None]

__all__ = ["VALID_COUNT", "Reduction", "sweep", "sweep_numpy"]

#: Below this number of configurations NumPy has answered before a program is compiled.
_WORTH_COMPILING = 20_000
#: Configurations between two reports of progress.
_REPORT = 1 << 23
_NUMPY_CHUNK = 1 << 18


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
    progress: Progress | None = None,
) -> Results:
    """Reductions of a program's outputs over the positions, for every design.

    ``parameters``: (designs, parameters) in the order of ``program.parameters``. ``positions``:
    (n,) per name; ``fields``: (designs, n) per name; ``start``: (designs, states), where the
    program carries states; ``length``: n, where no input is an array; ``tables``: those that the program
    looks up. ``valid``: the truth output that says which positions enter; without
    an output of this name all do. ``after``: a program per design, evaluated once its positions
    are through (see :class:`~linkwright.engine.reductions.Accumulation`). ``threads``: None for
    all cores; results do not depend on it. ``progress(done, designs)`` is called now and then;
    what it raises stops the sweep, as the keyboard's interrupt does. ``backend`` ``auto``
    compiles where that pays and llvmlite is there.

    Returns ``output.kind`` to an array (designs,), the outputs of ``after`` by their names, and
    the number of valid positions as ``valid.count``; for a design without a valid position NaN,
    position number -1, sum and count 0. Raises ValueError for unknown outputs, kinds or back
    ends and missing inputs.
    """
    table = np.ascontiguousarray(parameters, dtype=np.float64)
    wanted = tuple(r if isinstance(r, Reduction) else Reduction(*r) for r in reductions)
    judged = valid if valid in program.output_names else None
    accumulation = _accumulations.get(
        program, (wanted, judged, id(after)), lambda: Accumulation(program, wanted, judged, after)
    )
    given = {name: np.ascontiguousarray(a, dtype=np.float64) for name, a in (fields or {}).items()}
    n = _length(positions, given, length)
    run = _runner(accumulation, backend, len(table) * n)
    count = cores() if threads is None else threads
    parts: list[Results] = []
    for first, end in chunks(len(table), max(1, _REPORT // max(n, 1))):
        rows = {name: array[first:end] for name, array in given.items()}
        begin = None if start is None else _rows(start, len(table))[first:end]
        parts.append(
            run(_for_needed(accumulation, table[first:end]), positions, rows, begin, count, n, tables)
        )
        if progress is not None:
            progress(end, len(table))
    if not parts:
        return accumulation.finish(accumulation.start(0), n)
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def sweep_numpy(
    accumulation: Accumulation,
    table: Floats,
    positions: Arrays,
    fields: Arrays,
    start: ArrayLike | None = None,
    threads: int = 1,
    length: int | None = None,
    tables: Tables | None = None,
) -> Results:
    """The same as a compiled program's ``sweep``, by NumPy in blocks that fit the cache.

    ``table``: (designs, parameters) in the order of ``accumulation.parameters``.
    """
    evaluator = numpy_program(accumulation.needed)
    names = accumulation.needed.output_names
    sums = accumulation.start(len(table))
    n = _length(positions, fields, length)
    begin = None if start is None else _rows(start, len(table))
    count = len(accumulation.needed.parameters)

    def work(first: int, end: int) -> None:
        rows = {name: np.asarray(array)[first:end] for name, array in fields.items()}
        own = None if begin is None else begin[first:end]
        part, numbers = sums[first:end], table[first:end, :count]
        blocks = evaluator.blocks(numbers, positions, rows, start=own, length=n, tables=tables)
        for designs, columns, outputs in blocks:
            with np.errstate(all="ignore"):
                accumulate(accumulation, part[designs], outputs, names, columns.start)

    spread_over(len(table), max(1, _NUMPY_CHUNK // max(n, 1)), threads, work)
    if accumulation.following is not None:
        _follow(accumulation, accumulation.following, table, sums, n, tables)
    return accumulation.finish(sums, n)


def _follow(
    accumulation: Accumulation, after: Program, table: Floats, sums: Floats, n: int, tables: Tables | None
) -> None:
    """Evaluate what follows the positions into its columns of ``sums``."""
    inputs = np.empty((len(table), len(after.parameters)))
    for column, name in enumerate(after.parameters):
        origin, place = accumulation.source(name)
        if origin == "count":
            inputs[:, column] = n
        else:
            inputs[:, column] = (table if origin == "parameter" else sums)[:, place]
    outputs = numpy_program(after).run_designs(inputs, {}, length=1, tables=tables)
    sums[:, len(accumulation.steps) :] = outputs[:, :, 0]


_accumulations: Recent[Program, Accumulation] = Recent(64)
_Run = Callable[[Floats, Arrays, Arrays, ArrayLike | None, int, int, "Tables | None"], Results]


def _runner(accumulation: Accumulation, backend: Backend, configurations: int) -> _Run:
    if backend not in ("auto", "numpy", "llvm"):
        raise ValueError(f"there is no back end '{backend}': use auto, numpy or llvm")
    if backend == "llvm" or (backend == "auto" and configurations >= _WORTH_COMPILING):
        from linkwright.engine.llvm_backend import compile_program

        compiled = compile_program(
            accumulation.program, accumulation.reductions, accumulation.valid, accumulation.after
        )
        if compiled is not None:
            return lambda table, positions, fields, start, threads, n, tables: compiled.sweep(
                table, positions, fields, start=start, threads=threads, length=n, tables=tables
            )
        if backend == "llvm":
            raise ValueError("llvmlite cannot be loaded: install it, or use the numpy back end")
    return lambda *inputs: sweep_numpy(accumulation, *inputs)


def _for_needed(accumulation: Accumulation, table: Floats) -> Floats:
    """The columns of the parameters that the reduced outputs depend on."""
    program, needed = accumulation.program, accumulation.parameters
    if table.ndim != 2 or table.shape[1] != len(program.parameters):
        wanted = len(program.parameters)
        raise ValueError(f"parameters must have the shape (designs, {wanted}), but have {table.shape}")
    if needed == program.parameters:
        return table
    return np.ascontiguousarray(table[:, [program.parameters.index(name) for name in needed]])


def _length(positions: Arrays, fields: Arrays, length: int | None) -> int:
    lengths = {int(np.shape(array)[-1]) for array in (*positions.values(), *fields.values())}
    if length is not None:
        lengths.add(length)
    if len(lengths) != 1:
        raise ValueError(f"inputs over the positions must have one length, but have {sorted(lengths)}")
    return lengths.pop()


def _rows(start: ArrayLike, designs: int) -> Floats:
    given = np.asarray(start, dtype=np.float64)
    return np.broadcast_to(given, (designs, given.shape[-1]))
