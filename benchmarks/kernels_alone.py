"""W2 and W3: one design over a cycle, all outputs stored."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from benchmarks import by_c, by_numpy
from benchmarks.cases import Floats, Work
from benchmarks.timing import Candidate
from linkwright.formula.llvm_backend import CompiledProgram, address_of, aligned, compile_program
from linkwright.formula.machine_code import OF_ONE_ADDRESS
from linkwright.formula.numpy_backend import NumpyProgram

COMPILED, NUMPY_ROUTE, C, HAND = "linkwright, compiled", "linkwright, NumPy route", "C", "NumPy by hand"
CHECKED = "linkwright, compiled, arguments checked"


def c_run(name: str, work: Work) -> tuple[Callable[[], object], Floats]:
    """The C kernel's call for the nominal design, and where it stores."""
    out = aligned((len(work.outputs), work.positions.count))
    return by_c.kernel(name, work.cosine, work.sine, work.nominal(), out), out


def bare_call(
    compiled: CompiledProgram,
    numbers: Floats,
    positions: Mapping[str, Floats],
    out: Floats,
    fields: Mapping[str, Floats] | None = None,
) -> Callable[[], None]:
    """The code on arrays that are read and written where they lie, without a further look."""
    entry, block, _ = compiled.one_by_one(numbers, positions, out, fields=fields or {})
    function, address = OF_ONE_ADDRESS(entry), address_of(block)

    def run(kept: object = (compiled, numbers, positions, out, fields, block)) -> None:
        function(address)

    return run


def candidates(name: str, work: Work) -> list[Candidate]:
    """Ours, C and NumPy for ``fourbar`` or ``sixbar``."""
    program = work.program()
    arrays = {key: work.positions.arrays[key] for key in program.positions}
    numbers = work.table(program, work.nominal()[None, :])[0]
    compiled = compile_program(program)
    found: list[Candidate] = []
    if compiled is not None:
        out = aligned((len(program.outputs), work.positions.count))
        found.append(Candidate(COMPILED, bare_call(compiled, numbers, arrays, out)))
        found.append(Candidate(CHECKED, partial(compiled.repeated(arrays), numbers)))
    if by_c.compiler():
        found.append(Candidate(C, c_run(name, work)[0]))
    evaluator = NumpyProgram(program)
    found.append(Candidate(NUMPY_ROUTE, partial(evaluator.run, numbers, arrays)))
    by_hand = getattr(by_numpy, name)
    found.append(Candidate(HAND, partial(by_hand, work.cosine, work.sine, work.nominal())))
    return found


def disagreement(name: str, work: Work) -> dict[str, float]:
    """Largest difference of each way's outputs from NumPy by hand, as a share of the output's largest value."""
    truth = np.array(getattr(by_numpy, name)(work.cosine, work.sine, work.nominal()))
    program = work.program()
    numbers = work.table(program, work.nominal()[None, :])[0]
    arrays = {key: work.positions.arrays[key] for key in program.positions}
    ways = {NUMPY_ROUTE: np.asarray(NumpyProgram(program).run(numbers, arrays))}
    compiled = compile_program(program)
    if compiled is not None:
        ways[COMPILED] = compiled.repeated(arrays)(numbers)
    if by_c.compiler():
        run, ways[C] = c_run(name, work)
        run()
    largest = np.abs(truth).max(axis=1)
    return {
        way: float((np.abs(rows[: len(truth)] - truth).max(axis=1) / largest).max()) for way, rows in ways.items()
    }
