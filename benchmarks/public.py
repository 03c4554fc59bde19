"""W3 through the public API: new dimensions each time, results as objects."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count

import numpy as np

from benchmarks import by_numpy
from benchmarks.cases import Work
from benchmarks.kernels_alone import HAND, C, c_run
from benchmarks.timing import Candidate
from linkwright.designs.prepared import Prepared, prepare
from linkwright.formula.llvm_backend import available

COMPILED, NUMPY_ROUTE = "prepare(…).solve, compiled", "prepare(…).solve, NumPy"
VARIED = ("pitman.length", "rocker.length", "toggle.length", "jaw.length")
_COLUMNS = (4, 5, 9, 10)


def candidates(work: Work) -> list[Candidate]:
    """The prepared mechanism on both routes, C and NumPy with the same change of dimensions."""
    found = []
    if available():
        found.append(Candidate(COMPILED, _solving(prepared(work, "llvm"))))
    found.append(Candidate(NUMPY_ROUTE, _solving(prepared(work, "numpy"))))
    found.append(Candidate(HAND, _by_hand(work)))
    from benchmarks import by_c

    if by_c.compiler():
        found.append(Candidate(C, c_run("sixbar", work)[0]))
    return found


def prepared(work: Work, backend: str) -> Prepared:
    """The crusher prepared with four lengths to vary."""
    return prepare(work.mechanism, vary=VARIED, steps=work.positions.count, backend=backend)  # type: ignore[arg-type]


def _solving(ready: Prepared) -> Callable[[], object]:
    known = ready.mechanism.dimensions()
    turn = count()

    def run() -> object:
        factor = 1.0 + 1e-9 * (next(turn) % 1000)
        forces = ready.solve({name: known[name] * factor for name in VARIED})
        return forces.reaction("O5", on="jaw"), forces.input_torque, forces.motion.point("C").velocity

    return run


def _by_hand(work: Work) -> Callable[[], object]:
    cosine, sine, design = work.cosine, work.sine, work.nominal()
    lengths = design[list(_COLUMNS)]
    turn = count()

    def run() -> object:
        changed = design.copy()
        changed[list(_COLUMNS)] = lengths * (1.0 + 1e-9 * (next(turn) % 1000))
        rows = by_numpy.sixbar(cosine, sine, changed.tolist())
        return np.stack(rows[38:40], axis=1), rows[40], np.stack(rows[10:12], axis=1)

    return run


def disagreement(work: Work) -> dict[str, float]:
    """Largest difference from NumPy by hand of what is taken from the result, as a share of its largest value."""
    truth = _by_hand(work)()
    ways = {NUMPY_ROUTE: "numpy", **({COMPILED: "llvm"} if available() else {})}
    found = {}
    for way, backend in ways.items():
        ours = _solving(prepared(work, backend))()
        pairs = zip(ours, truth, strict=True)  # type: ignore[call-overload]
        found[way] = max(float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs)
    return found
