"""Value and reverse gradient of objectives against the value alone, many designs at once."""

from __future__ import annotations

from functools import partial

import numpy as np

from benchmarks.cases import Floats, Work, fourbar_designs, sixbar_designs
from benchmarks.timing import Candidate
from linkwright.formula.gradient import Gradient
from linkwright.formula.linear_algebra import Vec
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.summaries import summaries

VALUE, BOTH = "value", "value and gradient"


class GradientWork:
    """The path error of the four-bar's coupler point, or a force objective of the six-bar."""

    def __init__(self, name: str, work: Work, count: int) -> None:
        self.work = work
        four = name == "fourbar"
        self.program: Program = self._path_error() if four else self._forces()
        designs = fourbar_designs(count) if four else sixbar_designs(work, count)
        self.wrt = tuple(each for each in self.program.parameters if not each.startswith(("mode:", "driver.")))
        self.gradient = Gradient(self.program, Reduction("objective", "mean"), self.wrt)
        self.table = work.table(self.program, designs)
        own = [self.program.parameters.index(each) for each in self.gradient.parameters]
        self.own_table = np.ascontiguousarray(self.table[:, own])
        self.arrays = {key: array for key, array in self._arrays().items() if key in self.program.positions}
        self.backend = "llvm" if available() else "numpy"

    def _arrays(self) -> dict[str, Floats]:
        turn = np.linspace(0.0, 2.0 * np.pi, self.work.positions.count, endpoint=False)
        target = {"target:x": 1.0 + 0.8 * np.cos(turn), "target:y": 1.5 + 0.4 * np.sin(turn)}
        return {**self.work.positions.arrays, **target}

    def _path_error(self) -> Program:
        """Distance squared of the coupler point from a point of a given path."""
        trace = self.work.solver.motion.trace
        target = Vec(trace.position("target:x"), trace.position("target:y"))
        point = self.work.solver.outputs.point("coupler.P")[0]
        return self.work.reduced({"objective": (point - target).square})

    def _forces(self) -> Program:
        """Torque squared, and 0.01 m² times the squares of the reactions at the three fixed pins."""
        torque = self.work.value("effort:driver")
        pins = (("O1", "crank"), ("O3", "rocker"), ("O5", "jaw"))
        total = torque * torque
        for joint, link in pins:
            total = total + 0.01 * self.work.forces.forces.reaction(joint, link).square
        return self.work.reduced({"objective": total})

    def value(self) -> Floats:
        """Objective of every design, (designs,)."""
        reduction = Reduction("objective", "mean")
        found = summaries(self.program, [reduction]).evaluate(
            self.table,
            self.arrays,
            threads=1,
            backend=self.backend,  # type: ignore[arg-type]
        )
        return np.asarray(found[reduction.name], dtype=np.float64)

    def both(self) -> tuple[Floats, Floats]:
        """Objective (designs,) and gradient (designs, wrt)."""
        return self.gradient.evaluate(self.own_table, self.arrays, threads=1, backend=self.backend)  # type: ignore[arg-type]

    def candidates(self) -> list[Candidate]:
        """Value alone, and with its gradient."""
        return [Candidate(VALUE, partial(self.value)), Candidate(BOTH, partial(self.both))]

    def disagreement(self) -> float:
        """Largest gap between the gradient and central differences, as a share of the gradient's size."""
        exact = self.both()[1]
        table, worst = self.table.copy(), 0.0
        scale = np.abs(exact).max(axis=1)
        for column, name in enumerate(self.wrt):
            place = self.program.parameters.index(name)
            step = 1e-6 * np.maximum(1.0, np.abs(table[:, place]))
            sides = []
            for sign in (1.0, -1.0):
                self.table = table.copy()
                self.table[:, place] += sign * step
                sides.append(self.value())
            differences = (sides[0] - sides[1]) / (2.0 * step)
            worst = max(worst, float((np.abs(differences - exact[:, column]) / scale).max()))
        self.table = table
        return worst
