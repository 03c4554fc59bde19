"""Chain coordinates of groups without closed form, followed from the drawing through all positions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.engine.program import Program
from linkwright.engine.scalar_backend import ScalarProgram
from linkwright.kinematics.assembly import Assembly, AssemblyError
from linkwright.kinematics.cycle import Floats, Positions
from linkwright.kinematics.groups import state_name
from linkwright.kinematics.size import mechanism_size
from linkwright.kinematics.trace import MotionTrace, trace_motion
from linkwright.model.mechanism import Mechanism
from linkwright.structure.group import Structure

#: Newton steps of one attempt, and the largest change of a coordinate (rad, or part of the mechanism's size)
#: that one attempt may bring, so that it does not slip into another assembly mode.
ITERATIONS = 4
LARGEST_CHANGE = 0.15
CONVERGED = 1e-22
SMALLEST_SHARE = 1.0 / 4096


@dataclass
class Follower:
    """Follows the coordinates step by step; a step that fails is halved."""

    mechanism: Mechanism
    structure: Structure
    assembly: Assembly
    parameters: Mapping[str, float]
    free: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        self.motion = trace_motion(
            self.mechanism, self.structure, free=self.free, rates=False, iterations=ITERATIONS
        )
        self.program = _follow_program(self.motion)
        self.scalar = ScalarProgram(self.program)
        self.size = mechanism_size(self.mechanism)
        self.values = [self.parameters[name] for name in self.program.parameters]
        self.names = self.program.states
        self.linear = {
            f"{state_name(group, step)}.s"
            for group in self.structure.groups
            if all(step.kind == "prismatic" for step in group.unknowns)
            for step in group.unknowns
        }

    def follow(self, positions: Positions) -> dict[str, Floats]:
        """States (n,) by name at every position; NaN where the way to it is barred."""
        n = positions.count
        found = np.full((len(self.names), n), math.nan)
        first = self._from_drawing(positions)
        if first is None:
            return dict(zip(self.names, found, strict=True))
        found[:, 0] = first
        reached = self._walk(positions, found, range(1, n))
        if positions.closed and reached < n - 1:
            self._walk(positions, found, range(n - 1, reached, -1))
        return dict(zip(self.names, found, strict=True))

    def _walk(self, positions: Positions, found: Floats, order: Sequence[int]) -> int:
        """Fills columns in the given order, from column 0 on, until the way is barred; the last one reached."""
        here = 0
        state = [float(x) for x in found[:, 0]]
        for there in order:
            moved = self.step(positions, here, there, state)
            if moved is None:
                break
            state = moved
            found[:, there] = state
            here = there
        return here

    def step(self, positions: Positions, a: int, b: int, state: list[float]) -> list[float] | None:
        """From position a to position b, in parts as small as it takes."""
        done, share = 0.0, 1.0
        while done < 1.0:
            share = min(share, 1.0 - done)
            moved = self._newton(_inputs(positions.between(a, b, done + share)), state)
            if moved is None:
                share /= 2
                if share < SMALLEST_SHARE:
                    return None
                continue
            state, done, share = moved, done + share, share * 2
        return state

    def _newton(
        self, inputs: Mapping[str, float], state: list[float], limit: float = LARGEST_CHANGE
    ) -> list[float] | None:
        outputs, new = self._evaluate(inputs, state)
        if outputs[0] >= CONVERGED:
            outputs, new = self._evaluate(inputs, new)
        if not outputs[0] < CONVERGED or not self._change(state, new) <= limit:
            return None
        return new

    def _evaluate(
        self, inputs: Mapping[str, float], state: Sequence[float]
    ) -> tuple[list[float], list[float]]:
        return self.scalar.step(self.values, [inputs[name] for name in self.program.positions], state)

    def _change(self, old: Sequence[float], new: Sequence[float]) -> float:
        largest = 0.0
        for name, a, b in zip(self.names, old, new, strict=True):
            if name in self.linear:
                continue
            scale = self.size if name.endswith(".s") else 1.0
            change = abs(b - a) / scale
            largest = max(largest, change) if change == change else math.inf
        return largest

    def _from_drawing(self, positions: Positions) -> list[float] | None:
        """The state at the first position, reached from the drawing."""
        inputs = self.assembly.inputs
        drawn = _named(inputs)
        state = [self.assembly.states[name] for name in self.names]
        for _ in range(12):
            outputs, new = self._evaluate(drawn, state)
            state = new
            if outputs[0] < CONVERGED:
                break
        else:
            raise AssemblyError(
                f"{self.mechanism.name!r}: the group without closed form cannot be put together near its drawing "
                f"(input {', '.join(f'{name} = {q:.6g}' for name, q in inputs.items())}); check the drawing's "
                "coordinates against the lengths"
            )
        start = {name: rows[0][:1] for name, rows in positions.coordinates.items()}
        both = {
            name: (np.array([inputs[name], first[0]]), np.zeros(2), np.zeros(2))
            for name, first in start.items()
        }
        way = Positions(np.zeros(2), both, positions.rotary, False, None)
        return self.step(way, 0, 1, state)


def _follow_program(motion: MotionTrace) -> Program:
    total = 0.0
    for placed in motion.placed.values():
        total = total + placed.residual  # type: ignore[assignment]
    return Program.of(motion.trace, {"residual": total}, motion.next_states)


def _inputs(positions: Positions) -> dict[str, float]:
    return {name: float(row[0]) for name, row in positions.arrays.items()}


def _named(inputs: Mapping[str, float]) -> dict[str, float]:
    values: dict[str, float] = {}
    for name, q in inputs.items():
        values |= {f"cos:{name}": math.cos(q), f"sin:{name}": math.sin(q), f"slide:{name}": q}
    return values
