"""Which of many designs touch a change point between two positions.

There the square under a dyad's root comes down to zero and rises again. Small minima over the positions are refined
in all designs together, by sections of the stretch between the neighbouring positions.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.core.search import lowest
from linkwright.engine.numpy_backend import NumpyProgram
from linkwright.engine.program import Program
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.change_points import NEAR, TOUCH
from linkwright.study.traced import Traced

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

#: Designs whose positions are evaluated together.
BLOCK = 4096


class Touching:
    """Looks for change points of one mechanism's designs."""

    def __init__(self, traced: Traced) -> None:
        self.traced = traced
        placed = traced.solver.motion.placed
        self.groups = tuple(modal_groups(traced.solver.structure))
        qualities = {name: placed[name].quality for name in self.groups}
        program = Program.of(traced.solver.motion.trace, qualities)
        nodes = tuple(node._replace(op="field") if node.op == "position" else node for node in program.nodes)
        self.along = NumpyProgram(program)
        self.anywhere = NumpyProgram(Program(nodes, program.outputs))

    def designs(self, columns: Mapping[str, Floats]) -> Numbers:
        """Numbers of the designs that touch a change point between two positions."""
        count = len(next(iter(columns.values())))
        found = [
            first + self._block({a: column[first : first + BLOCK] for a, column in columns.items()})
            for first in range(0, count, BLOCK)
        ]
        return np.concatenate(found) if found else np.empty(0, dtype=np.intp)

    def _block(self, columns: Mapping[str, Floats]) -> Numbers:
        table = self.traced.table(self.along.program, columns)
        quality = self.along.run_designs(
            table, self.traced.positions.arrays, length=self.traced.positions.count
        )
        before, after = np.roll(quality, 1, axis=2), np.roll(quality, -1, axis=2)
        valleys = (np.abs(quality) < NEAR) & (quality <= before) & (quality < after)
        if not self.traced.positions.closed:
            valleys[:, :, [0, -1]] = False
        design, group, place = np.nonzero(valleys)
        if not len(design):
            return design
        least = self._refined(self.traced.table(self.anywhere.program, columns)[design], group, place)
        return np.unique(design[np.abs(least) <= TOUCH])

    def _refined(self, table: Floats, group: Numbers, place: Numbers) -> Floats:
        """The smallest value of each group's quality between the neighbours of a position."""
        rows = np.arange(len(place))

        def quality(share: Floats) -> Floats:
            inputs = self._inputs(place, share)
            found = self.anywhere.run_designs(table, {}, inputs, length=share.shape[1])
            return np.asarray(found[rows, group])

        return lowest(quality, np.zeros(len(place)), np.ones(len(place)))[1]

    def _inputs(self, place: Numbers, share: Floats) -> dict[str, Floats]:
        """Inputs at shares of the way from the position before to the one after."""
        positions = self.traced.positions
        inputs: dict[str, Floats] = {}
        for name, (q, _, _) in positions.coordinates.items():
            step = q[1] - q[0] if positions.rotary[name] else 0.0
            ends = (q[0] - step, q[-1] + step) if positions.rotary[name] else (q[-1], q[0])
            around = np.concatenate([ends[:1], q, ends[1:]])
            a, b = around[place][:, None], around[place + 2][:, None]
            value = a + share * (b - a)
            inputs |= {f"cos:{name}": np.cos(value), f"sin:{name}": np.sin(value), f"slide:{name}": value}
        return inputs
