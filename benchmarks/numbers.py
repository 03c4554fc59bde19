"""Design numbers of one crusher and of many, beside the hand-written NumPy cycle of its motion and forces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

import linkwright as lw
from benchmarks import by_numpy
from benchmarks.cases import sixbar
from benchmarks.kernels_alone import HAND
from benchmarks.timing import Candidate
from linkwright.cycle_programs.metric_cycle import MetricCycle, metric_cycle
from linkwright.kinematics.motion import Rows
from linkwright.metrics import METRICS

METRICS_OF, RUNNING, COMPARED, STUDIED = (
    "metrics",
    "steady_running",
    "compare of two",
    "design numbers of many",
)
EDITED, PREPARED, UNLOADED, BY_NUMPY = (
    "an edited value solved again",
    "prepared, solved",
    "prepared without load, solved",
    "prepared without load, solved by NumPy",
)
LINK = "pitman.length"


class NumbersWork:
    """The gallery's six-bar crusher with its load between limit positions."""

    def __init__(self, designs: int, steps: int) -> None:
        self.mechanism, self.steps = lw.load("gallery:jaw_crusher_sixbar"), steps
        self.length, self.edits = self.mechanism.dimension(LINK), 0
        self.forces = lw.solve_forces(self.mechanism, steps=steps)
        self.work = sixbar(steps)
        self.names = [name for name, metric in METRICS.items() if not metric.on_request]
        cycle = metric_cycle(self.mechanism, [LINK], self.names)
        assert cycle is not None
        self.cycle: MetricCycle = cycle
        random = np.random.default_rng(0)
        self.columns = {LINK: self.length * random.uniform(0.99, 1.01, designs)}
        self.other = self.mechanism.with_dimensions({LINK: 1.01 * self.length})
        self.prepared = lw.prepare(self.mechanism, vary=[LINK], steps=steps)
        bare = replace(self.mechanism, loads={})
        self.bare = lw.prepare(bare, vary=[LINK], steps=steps)
        self.by_numpy = lw.prepare(bare, vary=[LINK], steps=steps, backend="numpy")

    def candidates(self) -> list[Candidate]:
        """One call each; many designs count as one by their share."""
        nominal = self.work.nominal()
        runs: dict[str, Callable[[], object]] = {
            HAND: lambda: by_numpy.sixbar(self.work.cosine, self.work.sine, nominal),
            METRICS_OF: lambda: lw.metrics(self._fresh()),
            RUNNING: lambda: lw.steady_running(self._fresh(), fluctuation=0.02),
            COMPARED: lambda: lw.compare([self.mechanism, self.other], steps=self.steps).text(),
            EDITED: lambda: lw.solve_forces(
                self.mechanism.with_dimensions({LINK: self._edit()}), steps=self.steps
            ),
            PREPARED: lambda: self.prepared.solve({LINK: self._edit()}),
            UNLOADED: lambda: self.bare.solve({LINK: self._edit()}),
            BY_NUMPY: lambda: self.by_numpy.solve({LINK: self._edit()}),
        }
        count = len(self.columns[LINK])
        many = Candidate(
            STUDIED, lambda: self.cycle.evaluate(self.columns, threads=1), count, f"{self.told}, a design"
        )
        return [*(Candidate(name, run) for name, run in runs.items()), many]

    @property
    def told(self) -> str:
        """How many numbers."""
        return f"{len(self.cycle.terms)} of them"

    def _edit(self) -> float:
        self.edits += 1
        return self.length * (1.0 + 1e-6 * self.edits)

    def _fresh(self) -> lw.Forces:
        """The forces again, so that nothing is known of them and of their motion."""
        motion = self.forces.motion
        return lw.solve_forces(replace(motion, rows=Rows(motion.rows.values, motion.rows.index)))

    def disagreement(self) -> float:
        """Largest relative difference of the numbers of many designs from those of one alone."""
        found = self.cycle.evaluate({LINK: self.columns[LINK][:1]})
        design = self.mechanism.with_dimensions({LINK: float(self.columns[LINK][0])})
        table = lw.metrics(lw.solve_forces(design))
        gaps = []
        for term in self.cycle.terms:
            values = [row.value for row in table[term.name]]
            one = (
                min(values) if term.better == "higher" else max(values, key=abs) if term.better else values[0]
            )
            gaps.append(abs(float(found.values[term.name][0]) / one - 1.0))
        return max(gaps)
