"""W4: many designs, summaries only."""

from __future__ import annotations

from functools import partial

import numpy as np

from benchmarks import by_c, by_numpy
from benchmarks.cases import Floats, Work, fourbar_designs, fourbar_metrics, sixbar_designs, sixbar_metrics
from benchmarks.kernels_alone import COMPILED, HAND, C
from benchmarks.timing import Candidate
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.summaries import Backend, summaries

TWO, NUMPY_ROUTE = "linkwright, compiled, two threads", "linkwright, NumPy route"
#: The share of the designs that slow candidates do.
_FEW = 0.02


class SweepWork:
    """A program, its reductions and designs, for ``fourbar`` or ``sixbar``."""

    def __init__(self, name: str, work: Work, count: int) -> None:
        self.name, self.work = name, work
        four = name == "fourbar"
        metrics = fourbar_metrics(work.solver.outputs) if four else sixbar_metrics(work)
        self.program: Program = work.reduced(metrics)
        self.reductions = [Reduction(metric, "min" if metric == "transmission" else "max") for metric in metrics]
        self.designs: Floats = fourbar_designs(count) if four else sixbar_designs(work, count)
        self.table = work.table(self.program, self.designs)
        self.arrays = {key: work.positions.arrays[key] for key in self.program.positions}

    def ours(self, table: Floats, backend: Backend, threads: int) -> dict[str, Floats]:
        """Summaries by the package."""
        cycle = summaries(self.program, self.reductions)
        return cycle.evaluate(table, self.arrays, threads=threads, backend=backend)  # type: ignore[return-value]

    def few(self) -> int:
        """Number of designs for slow candidates."""
        return max(1, min(len(self.designs), max(64, int(_FEW * len(self.designs)))))

    def by_hand(self, designs: Floats) -> Floats:
        """Summaries by NumPy."""
        function = by_numpy.fourbar_sweep if self.name == "fourbar" else by_numpy.sixbar_sweep
        return function(self.work.cosine, self.work.sine, designs, 8)

    def by_c(self) -> tuple[object, Floats]:
        """A call of the C kernel, and where it stores."""
        out = np.empty((len(self.designs), len(self.reductions)))
        return by_c.kernel(f"{self.name}_sweep", self.work.cosine, self.work.sine, self.designs, out), out

    def candidates(self) -> list[Candidate]:
        """Ours on one and two threads and by NumPy, C, NumPy by hand."""
        found: list[Candidate] = []
        few = self.few()
        share = few / len(self.designs)
        if available():
            found.append(Candidate(COMPILED, partial(self.ours, self.table, "llvm", 1)))
            found.append(Candidate(TWO, partial(self.ours, self.table, "llvm", 2)))
        if by_c.compiler():
            found.append(Candidate(C, self.by_c()[0]))  # type: ignore[arg-type]
        note = f"{few} designs, scaled" if share < 1 else ""
        found.append(Candidate(NUMPY_ROUTE, partial(self.ours, self.table[:few], "numpy", 1), share, note))
        found.append(Candidate(HAND, partial(self.by_hand, self.designs[:few]), share, note))
        return found

    def disagreement(self) -> dict[str, float]:
        """Largest difference of each way's summaries from NumPy by hand, relative."""
        few = self.few()
        truth = self.by_hand(self.designs[:few])
        backends: tuple[Backend, ...] = ("numpy", "llvm") if available() else ("numpy",)
        ways: dict[str, Floats] = {}
        for backend in backends:
            results = self.ours(self.table[:few], backend, 1)
            assert (results["valid.count"] == self.work.positions.count).all()
            ways[backend] = np.stack([results[each.name] for each in self.reductions], axis=1)
        if by_c.compiler():
            run, out = self.by_c()
            run()  # type: ignore[operator]
            ways[C] = out[:few]
        return {way: float((np.abs(rows - truth) / np.abs(truth)).max()) for way, rows in ways.items()}
