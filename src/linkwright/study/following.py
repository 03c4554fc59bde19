"""Designs with groups that Newton's method solves: followed side by side from position to position."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.program import Program
from linkwright.engine.reductions import Reduction
from linkwright.engine.sweep import Backend, Results
from linkwright.engine.sweep import sweep as engine_sweep
from linkwright.engine.trace import Scalar, select
from linkwright.kinematics.cycle import Positions, over_cycle
from linkwright.kinematics.size import mechanism_size
from linkwright.kinematics.step_rule import StepRule
from linkwright.study.starts import start_states
from linkwright.study.traced import NEAREST, VALID, Traced
from linkwright.study.vary import positions_steps

Floats = NDArray[np.float64]

#: Newton steps per position; the change of a coordinate (rad, or share of the mechanism's size) in one step to which
#: the known design is refined.
ITERATIONS = 4
WANTED = 0.1
#: The output that tells how far a step is from being refused.
MARGIN = "branch margin"
#: What fails is tried once more with this many times as many positions.
FINER = 8


class Following:
    """A program that carries the chain coordinates, and whether the way so far was passed.

    Where a step is larger than the assembly mode allows, positions are put between; only the asked ones count.
    A design is followed forwards; positions behind a barred one count as not reached.
    """

    def __init__(self, traced: Traced, names: Iterable[str]) -> None:
        self.traced = traced
        self.names = tuple(dict.fromkeys(names))
        self.finer = self._needed()
        self.ways: dict[int, _Way] = {}

    def block(
        self,
        columns: Mapping[str, Floats],
        wanted: Sequence[Reduction],
        threads: int | None,
        backend: Backend,
    ) -> Results:
        """Reductions (designs,) of designs with the given columns."""
        results = self._way(self.finer).reduced(columns, wanted, threads, backend)
        failed = np.flatnonzero(results["valid.count"] != self.traced.positions.count)
        if len(failed):
            part = {address: column[failed] for address, column in columns.items()}
            again = self._way(self.finer * FINER).reduced(part, wanted, threads, backend)
            for name, column in again.items():
                results[name][failed] = column
        return results

    def _way(self, finer: int) -> _Way:
        if finer not in self.ways:
            self.ways[finer] = _Way(self.traced, self.names, finer)
        return self.ways[finer]

    def _needed(self) -> int:
        """How much finer the positions must be for the known design."""
        known = self.traced.solver.states(self.traced.positions)
        size = mechanism_size(self.traced.mechanism)
        largest = 0.0
        for name, row in known.items():
            change = np.abs(np.diff(row)) / (size if name.endswith(".s") else 1.0)
            largest = max(largest, float(np.nanmax(change, initial=0.0)))
        return max(1, int(np.ceil(largest / WANTED)))


class _Way:
    """The program over positions that are ``finer`` times as many as asked."""

    def __init__(self, traced: Traced, names: tuple[str, ...], finer: int) -> None:
        self.finer = finer
        mechanism, asked = traced.mechanism, traced.positions
        self.positions: Positions = over_cycle(mechanism, positions_steps(asked) * finer)
        self.traced = Traced(mechanism, traced.solver.manner.free, self.positions, iterations=ITERATIONS)
        self.asked = traced
        count = self.positions.count
        step = self.positions.time[1] - self.positions.time[0] if count > 1 else 0.0
        self.arrays = {
            **self.positions.arrays,
            "counted": _counted(count, finer),
            "step": np.full(count, step),
        }
        quantities = self.traced.quantities(names)
        motion = self.traced.solver.motion
        trace = motion.trace
        self.rule = StepRule(motion, trace.position("step"))
        passed = trace.logic("and", motion.valid, trace.compare("less", 0.5, trace.state("alive")))
        passed = trace.logic("and", passed, self.rule.kept)
        counts = trace.logic("and", passed, trace.compare("less", 0.5, trace.position("counted")))
        outputs: dict[str, Scalar | bool] = {name: each.carrier for name, each in quantities.items()}
        following = {**self.rule.following, "alive": select(passed, 1.0, 0.0)}
        outputs |= {NEAREST: self.traced.nearest, VALID: counts, MARGIN: self.rule.margin}
        self.program = Program.of(trace, outputs, following)

    def reduced(
        self,
        columns: Mapping[str, Floats],
        wanted: Sequence[Reduction],
        threads: int | None,
        backend: Backend,
    ) -> Results:
        start = start_states(self.asked, columns)
        designs = len(next(iter(columns.values())))
        begin = {**self.rule.begin, "alive": 1.0}
        start |= {
            name: start[value] if isinstance(value, str) else np.full(designs, value)
            for name, value in begin.items()
        }
        found = engine_sweep(
            self.program,
            self.traced.table(self.program, columns),
            self.arrays,
            wanted,
            start=np.stack([start[name] for name in self.program.states], axis=1),
            valid=VALID,
            threads=threads,
            backend=_quicker(backend),
        )
        for name, column in found.items():
            if name.endswith((".argmin", ".argmax")):
                found[name] = np.where(column < 0, column, column // self.finer)
        return found


def _quicker(backend: Backend) -> Backend:
    """Compiled code where it is there: position after position NumPy has only a few designs to work on."""
    from linkwright.engine.machine_code import available

    return "llvm" if backend == "auto" and available() else backend


def _counted(count: int, finer: int) -> Floats:
    """1 at the positions that were asked for, 0 at those between."""
    marks = np.zeros(count)
    marks[::finer] = 1.0
    return marks
