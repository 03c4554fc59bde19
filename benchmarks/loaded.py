"""Sweeps of machines with their process loads, and of all their design numbers, beside that of a plain six-bar."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import linkwright as lw
from benchmarks.cases import sixbar
from benchmarks.sweeps import SweepWork
from benchmarks.timing import Candidate
from linkwright.core.outputs import Output
from linkwright.cycle_programs.metric_cycle import MetricCycle, metric_cycle
from linkwright.cycle_programs.terms import Asked
from linkwright.kinematics.cycle import over_cycle
from linkwright.metrics import METRICS
from linkwright.metrics.wanted import wanted
from linkwright.study.sweep_run import Manner, SweepRun

PLAIN, ALL, STUDIED = (
    "six-bar without load, six metrics",
    "crusher with its load, all design numbers",
    "study of the crusher",
)
LOADED, CONVEYOR, UNLOADED = (
    "crusher with its load, the same six",
    "conveyor with its load, five metrics",
    "conveyor without",
)
_PINS = ("O1 on crank", "O3 on rocker", "O5 on jaw", "C on toggle")
_CRUSHER = ("driver.effort max", *(f"reaction {pin} max" for pin in _PINS), "C.acceleration max")
_CONVEYOR = (
    "driver.effort max",
    "driver.effort rms",
    "reaction O on crank max",
    "F.velocity max",
    "F.acceleration max",
)


class LoadedWork:
    """Designs of two machines of the gallery with one length changed, one thread."""

    def __init__(self, designs: int, steps: int) -> None:
        self.designs, self.steps = designs, steps
        self.plain = SweepWork("sixbar", sixbar(steps), designs)
        self.crusher = lw.load("gallery:jaw_crusher_sixbar")
        self.conveyor = lw.load("gallery:swing_conveyor")
        random = np.random.default_rng(0)
        factors = random.uniform(0.99, 1.01, designs)
        self.columns = {"pitman.length": self.crusher.dimension("pitman.length") * factors}
        self.rods = {"rod.length": self.conveyor.dimension("rod.length") * factors}
        names = [name for name, metric in METRICS.items() if not metric.on_request]
        asked = Asked(Output("angle", "jaw"), 0.02)
        cycle = metric_cycle(self.crusher, self.columns, [*names, "flywheel"], asked=asked)
        assert cycle is not None
        self.cycle: MetricCycle = cycle
        self.names = [each.name for each in cycle.terms if each.name in METRICS]

    def candidates(self) -> list[Candidate]:
        """One call each."""
        bare = replace(self.conveyor, loads={})
        runs = {
            LOADED: self._run(self.crusher, self.columns, _CRUSHER),
            CONVEYOR: self._run(self.conveyor, self.rods, _CONVEYOR),
            UNLOADED: self._run(bare, self.rods, _CONVEYOR),
        }
        return [
            Candidate(PLAIN, lambda: self.plain.ours(self.plain.table, "llvm", 1)),
            Candidate(
                ALL, lambda: self.cycle.evaluate(self.columns, threads=1), note=f"{len(self.cycle.terms)}"
            ),
            *(Candidate(name, run.swept) for name, run in runs.items()),
            Candidate(
                STUDIED, lambda: lw.study(self.crusher, self.columns, metrics=self.names), note="two threads"
            ),
        ]

    def _run(
        self, mechanism: lw.Mechanism, columns: dict[str, np.ndarray], asked: tuple[str, ...]
    ) -> SweepRun:
        positions = over_cycle(mechanism, self.steps)
        return SweepRun(mechanism, columns, wanted(asked), positions, Manner(threads=1, backend="llvm"))
