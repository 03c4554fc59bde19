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
#: coordinate (rad, or part of the size) in one attempt and in the first one, the largest distance from what was
#: expected as share of the change, and the smallest share of the way.
ITERATIONS = 4
CONVERGED = 1e-22
LARGEST_CHANGE, FIRST_CHANGE = 0.15, 0.02
EXPECTED = 0.1
SMALLEST_SHARE = 1.0 / 4096


def start_states(traced: Traced, columns: Mapping[str, Floats]) -> dict[str, Floats]:
    """Chain coordinates (designs,) by name at the first position; NaN for designs that are not reached.

    From the mechanism as it is, every design is approached on a straight line in the varied dimensions, with
    Newton's steps at each stage from what the last two stages let expect. A stage that fails, that changes the sign
    of a group's determinant, or that ends far from what was expected, is halved.
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
        outputs = {**motion.next_states, "residual": residual}
        groups = [(name, placed) for name, placed in motion.placed.items() if placed.coordinates]
        outputs |= {f"determinant:{name}": placed.determinant for name, placed in groups}
        self.evaluator = NumpyProgram(Program.of(motion.trace, outputs))
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
        slope = np.full_like(state, np.nan)
        sign = np.sign(self._evaluate(self.begin[None, :], state[:1])[2])
        done, share = np.zeros(designs), np.ones(designs)
        active = np.ones(designs, dtype=bool)
        while active.any():
            rows = np.flatnonzero(active)
            ahead = np.minimum(done[rows] + share[rows], 1.0)
            moved, good = self._newton(
                rows, ahead, state[rows], slope[rows] * (ahead - done[rows])[:, None], sign
            )
            came = rows[good]
            slope[came] = (moved[good] - state[came]) / (ahead[good] - done[came])[:, None]
            state[came], done[came] = moved[good], ahead[good]
            share[came] *= 2.0
            share[rows[~good]] *= 0.5
            active[rows] = (done[rows] < 1.0) & (share[rows] >= SMALLEST_SHARE)
        state[done < 1.0] = np.nan
        return {name: state[:, place] for place, name in enumerate(self.names)}

    def _newton(
        self, rows: NDArray[np.intp], share: Floats, state: Floats, expected: Floats, sign: Floats
    ) -> tuple[Floats, Mask]:
        """States at a share of the way, and which of them are certain; ``expected`` changes are NaN at first."""
        table = self.begin + share[:, None] * (self.goal[rows] - self.begin)
        known = np.asarray(np.isfinite(expected).all(axis=1))
        start = self._unit(state + np.where(known[:, None], expected, 0.0))
        new, _, _ = self._evaluate(table, start)
        new, residual, determinants = self._evaluate(table, new)
        with np.errstate(invalid="ignore"):
            change = (np.abs(new - state) / self.scale).max(axis=1)
            off = (np.abs(new - start) / self.scale).max(axis=1)
            near = np.where(known, off <= EXPECTED * change + 1e-9, change <= FIRST_CHANGE)
            kept = np.asarray(np.sign(determinants) == sign).all(axis=1)
            good: Mask = np.asarray((residual < CONVERGED) & (change <= LARGEST_CHANGE) & near & kept)
            return new, good

    def _unit(self, state: Floats) -> Floats:
        """The same with directions of unit length."""
        for place, name in enumerate(self.names):
            if name.endswith(".x"):
                state[:, place : place + 2] /= np.hypot(state[:, place], state[:, place + 1])[:, None]
        return state

    def _evaluate(self, table: Floats, state: Floats) -> tuple[Floats, Floats, Floats]:
        """Next states, residuals and determinants of the groups."""
        states = {name: state[:, place : place + 1] for place, name in enumerate(self.names)}
        found = self.evaluator.run_designs(table, self.inputs, {}, states, length=1)[:, :, 0]
        n = len(self.names)
        return found[:, :n], found[:, n], found[:, n + 1 :]
