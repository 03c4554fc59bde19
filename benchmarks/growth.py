"""Chains of n dyads: how the time of every step from the model to the numbers grows with n."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

import linkwright as lw
from benchmarks.timing import Candidate, Rounds, in_turns
from linkwright.formula import machine_code
from linkwright.formula.ir_kernel import ENTRY, kernel
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Lines, Program
from linkwright.formula.reductions import Accumulation, Reduction
from linkwright.formula.summaries import summaries
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.trace import MotionTrace, trace_motion
from linkwright.kinetostatics.trace import trace_forces
from linkwright.topology import structure

STRUCTURE, TRACE, COMPILE, EVALUATE = "structure", "trace", "compile", "evaluate"
EFFORT = "effort"
_DESIGNS = 8


def chain(dyads: int) -> str:
    """A crank that drives four-bars one behind another, as a model file."""
    pivots = ", ".join(f"Q{k}: [{k + 1} m, 0 m]" for k in range(dyads))
    links = [
        f"  rod{k}: {{points: [P{k}, B{k}], length: 1 m, mass: 2 kg, inertia: 0.1 kg·m²}}\n"
        f"  rocker{k}: {{points: [Q{k}, B{k}], length: 0.8 m, mass: 3 kg, inertia: 0.2 kg·m², "
        f"also: {{P{k + 1}: [0.3 m, 0 m]}}}}\n"
        for k in range(dyads)
    ]
    modes = ", ".join(f"B{k}: left" for k in range(dyads))
    return (
        f"format: 1\nname: Chain of {dyads} dyads\nframe:\n  points: {{O: [0 m, 0 m], {pivots}}}\n"
        f"links:\n  crank: {{points: [O, P0], length: 0.3 m}}\n{''.join(links)}"
        f"assembly: {{{modes}}}\ndriver: {{turn: crank, about: O, speed: 60 rpm}}\n"
    )


class Chain:
    """One chain, with what every step takes from the step before."""

    def __init__(self, dyads: int, steps: int) -> None:
        self.dyads = dyads
        self.mechanism = lw.loads(chain(dyads))
        self.structure = structure(self.mechanism)
        self.program = self.traced()
        solver = MotionSolver(self.mechanism)
        known = solver.nominal.parameters
        self.table = np.tile([known[name] for name in self.program.parameters], (_DESIGNS, 1))
        self.arrays = over_cycle(self.mechanism, steps).arrays

    def traced(self) -> Program:
        """The driver's torque and the valid positions as a program."""
        motion: MotionTrace = trace_motion(self.mechanism, self.structure)
        effort = next(iter(trace_forces(motion, inertia=True, along_input=frozenset()).efforts.values()))
        return Program.of(motion.trace, {EFFORT: effort, "valid": motion.valid})

    def compiled(self) -> machine_code.Loaded:
        """Machine code of its largest and mean torque, nothing kept from before."""
        wanted = (Reduction(EFFORT, "max"), Reduction(EFFORT, "rms"))
        accumulation = Accumulation(self.program, wanted, "valid")
        lines = Lines.of(accumulation.needed)
        code = machine_code.object_code(*kernel(lines, machine_code.host().width, accumulation))
        return machine_code.Loaded(code, ENTRY)

    def evaluated(self, backend: str = "llvm") -> object:
        """Largest and mean torque of some designs."""
        wanted = [Reduction(EFFORT, "max"), Reduction(EFFORT, "rms")]
        cycle = summaries(self.program, wanted)
        return cycle.evaluate(self.table, self.arrays, threads=1, backend=backend)  # type: ignore[arg-type]

    def candidates(self) -> list[Candidate]:
        """Every step of this chain."""
        steps: dict[str, Callable[[], object]] = {
            STRUCTURE: partial(structure, self.mechanism),
            TRACE: self.traced,
            EVALUATE: partial(self.evaluated, "llvm" if available() else "numpy"),
        }
        if available():
            steps[COMPILE] = self.compiled
        return [Candidate(_named(what, self.dyads), run) for what, run in steps.items()]


def _named(what: str, dyads: int) -> str:
    return f"{what}, {dyads} dyads"


def measure(counts: tuple[int, ...], steps: int, rounds: int, slice_s: float) -> Rounds:
    """All steps of all chains in turns."""
    chains = [Chain(count, steps) for count in counts]
    return in_turns([each for one in chains for each in one.candidates()], rounds, slice_s)


def exponent(rounds: Rounds, what: str, few: int, many: int) -> float:
    """p where the time grows as n to the power p between two lengths."""
    return math.log(rounds.best_ratio(_named(what, many), _named(what, few))) / math.log(many / few)


def table(rounds: Rounds, counts: tuple[int, ...]) -> tuple[list[str], list[list[str]]]:
    """Milliseconds, shortest rounds, by step and number of dyads."""
    present = [what for what in (STRUCTURE, TRACE, COMPILE, EVALUATE) if _named(what, counts[0]) in rounds]
    rows = [
        [what, *(f"{1e3 * rounds.timings[_named(what, count)].best:.3g}" for count in counts)] for what in present
    ]
    return ["best, ms", *(f"{count} dyads" for count in counts)], rows


def compile_time(rounds: Rounds, dyads: int) -> float:
    """Seconds of the shortest round."""
    return rounds.timings[_named(COMPILE, dyads)].best
