"""First positions of many designs with groups that Newton's method solves: continuation from the known design."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.engine.trace import Scalar
from linkwright.kinematics.size import mechanism_size
from linkwright.kinematics.trace import trace_motion
from linkwright.study.traced import Traced

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: Newton steps of one attempt, the square of the correction that they must come to, the largest change of a
#: coordinate (rad, or part of the size) in one attempt, and the smallest share of the way.
ITERATIONS = 4
CONVERGED = 1e-22
LARGEST_CHANGE = 0.15
SMALLEST_SHARE = 1.0 / 1024


def start_states(traced: Traced, columns: Mapping[str, Floats]) -> dict[str, Floats]:
    """Chain coordinates (designs,) by name at the first position; NaN for designs that are not reached.

    From the mechanism as it is, every design is approached on a straight line in the varied dimensions, with
    Newton's steps at each stage; a stage that fails, or moves a coordinate too far for the assembly mode to be
    certain, is halved.
    """
    return _Approach(traced, columns).states()


class _Approach:
    """All designs side by side, each with its own share of the way."""

    def __init__(self, traced: Traced, columns: Mapping[str, Floats]) -> None:
        solver = traced.solver
        motion = trace_motion(
            traced.mechanism, solver.structure, free=solver.manner.free, rates=False, iterations=ITERATIONS
        )
        residual: Scalar = 0.0
        for placed in motion.placed.values():
            residual = residual + placed.residual
        self.names = tuple(motion.next_states)
        self.evaluator = NumpyProgram(Program.of(motion.trace, {**motion.next_states, "residual": residual}))
        program = self.evaluator.program
        self.goal = traced.table(program, columns)
        self.begin = traced.numbers(program)
        self.inputs = {name: row[:1] for name, row in traced.positions.arrays.items()}
        size = mechanism_size(motion.mechanism)
        self.scale = np.array([size if name.endswith(".s") else 1.0 for name in self.names])
        known = solver.states(traced.positions)
        self.first = np.array([known[name][0] for name in self.names])

    def states(self) -> dict[str, Floats]:
        designs = len(self.goal)
        state = np.repeat(self.first[None, :], designs, axis=0)
        done, share = np.zeros(designs), np.ones(designs)
        active = np.ones(designs, dtype=bool)
        while active.any():
            rows = np.flatnonzero(active)
            ahead = np.minimum(done[rows] + share[rows], 1.0)
            moved, good = self._newton(rows, ahead, state[rows])
            came = rows[good]
            state[came], done[came] = moved[good], ahead[good]
            share[came] *= 2.0
            share[rows[~good]] *= 0.5
            active[rows] = (done[rows] < 1.0) & (share[rows] >= SMALLEST_SHARE)
        state[done < 1.0] = np.nan
        return {name: state[:, place] for place, name in enumerate(self.names)}

    def _newton(self, rows: NDArray[np.intp], share: Floats, state: Floats) -> tuple[Floats, Mask]:
        table = self.begin + share[:, None] * (self.goal[rows] - self.begin)
        new, residual = self._evaluate(table, state)
        new, residual = self._evaluate(table, new)
        with np.errstate(invalid="ignore"):
            change = (np.abs(new - state) / self.scale).max(axis=1)
            return new, (residual < CONVERGED) & (change <= LARGEST_CHANGE)

    def _evaluate(self, table: Floats, state: Floats) -> tuple[Floats, Floats]:
        states = {name: state[:, place : place + 1] for place, name in enumerate(self.names)}
        found = self.evaluator.run_designs(table, self.inputs, {}, states, length=1)
        return found[:, :-1, 0], found[:, -1, 0]
