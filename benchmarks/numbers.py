"""Metrics of one crusher, beside the hand-written NumPy cycle of its motion and forces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

import linkwright as lw
from benchmarks import by_numpy
from benchmarks.cases import sixbar
from benchmarks.cycles import METRICS
from benchmarks.kernels_alone import HAND
from benchmarks.timing import Candidate
from linkwright.kinematics.motion import Rows

METRICS_OF, RUNNING, COMPARED = "metrics", "steady_running", "compare of two"
EDITED, PREPARED, UNLOADED, BY_NUMPY = (
    "an edited value solved again",
    "prepared, solved",
    "prepared without load, solved",
    "prepared without load, solved by NumPy",
)
LINK = "pitman.length"


class NumbersWork:
    """The gallery's six-bar crusher with its load between limit positions."""

    def __init__(self, steps: int) -> None:
        self.mechanism, self.steps = lw.load("gallery:jaw_crusher_sixbar"), steps
        self.length, self.edits = self.mechanism.dimension(LINK), 0
        self.forces = lw.solve_forces(self.mechanism, steps=steps)
        self.work = sixbar(steps)
        self.other = self.mechanism.with_dimensions({LINK: 1.01 * self.length})
        self.prepared = lw.prepare(self.mechanism, vary=[LINK], steps=steps)
        bare = replace(self.mechanism, loads={})
        self.bare = lw.prepare(bare, vary=[LINK], steps=steps)
        self.by_numpy = lw.prepare(bare, vary=[LINK], steps=steps, backend="numpy")

    def candidates(self) -> list[Candidate]:
        """One call each."""
        nominal = self.work.nominal()
        runs: dict[str, Callable[[], object]] = {
            HAND: lambda: by_numpy.sixbar(self.work.cosine, self.work.sine, nominal),
            METRICS_OF: lambda: lw.metrics(self._fresh()),
            RUNNING: lambda: lw.steady_running(self._fresh(), fluctuation=0.02),
            COMPARED: lambda: lw.compare([self.mechanism, self.other], steps=self.steps).text(),
            EDITED: lambda: lw.solve_forces(self.mechanism.with_dimensions({LINK: self._edit()}), steps=self.steps),
            PREPARED: lambda: self.prepared.solve({LINK: self._edit()}),
            UNLOADED: lambda: self.bare.solve({LINK: self._edit()}),
            BY_NUMPY: lambda: self.by_numpy.solve({LINK: self._edit()}),
        }
        return [Candidate(name, run) for name, run in runs.items()]

    def _edit(self) -> float:
        self.edits += 1
        return self.length * (1.0 + 1e-6 * self.edits)

    def _fresh(self) -> lw.Forces:
        """The forces again, so that nothing is known of them and of their motion."""
        motion = self.forces.motion
        return lw.solve_forces(replace(motion, rows=Rows(motion.rows.values, motion.rows.index)))

    def disagreement(self) -> float:
        """Largest relative difference of the numbers of many designs from those of one alone."""
        table = lw.metrics(self.forces)
        names = [name for name in METRICS if name in table.names]
        found = lw.sweep(self.mechanism, {LINK: np.array([self.length])}, outputs=names, threads=1)
        return max(abs(float(found[name][0]) / table.value(name) - 1.0) for name in names)
