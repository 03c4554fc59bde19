"""Which of many designs touch a change point between two positions, or cannot pass there.

At a change point the square under a dyad's root comes down to zero and rises again, in a gap it falls below. Small
minima over the positions are refined in all designs together, by sections of the stretch between the neighbouring
positions. Where guides become parallel their sine changes its sign.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.core.inputs import Input, turned
from linkwright.core.search import lowest
from linkwright.designs.traced_outputs import Traced
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.summaries import Backend, Run, code_for
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.change_points import MEETING, TOUCH
from linkwright.kinematics.passing_proof import NEAR
from linkwright.kinematics.positions import Positions

#: Designs whose positions are evaluated together.
BLOCK = 4096
#: How much the quality of a group rises, at most, over the square of the way from its zero, 1/rad².
STEEP = 25.0


def _anywhere(program: Program) -> Program:
    """The same program with inputs of its own for every design."""
    nodes = tuple(node._replace(op="field") if node.op == "position" else node for node in program.nodes)
    return Program(nodes, program.outputs)


def near_enough(positions: Positions) -> float:
    """The quality of a group below which it may come to zero on the way to a neighbouring position.

    A slide that turns back moves like the cosine of an angle: its steps count as shares of half its way.
    """
    largest = 0.0
    for name, (q, *_) in positions.coordinates.items():
        unit = 1.0 if positions.rotary[name] else 0.5 * float(np.ptp(q)) or np.inf
        largest = max(largest, float(np.abs(np.diff(q)).max(initial=0.0)) / unit)
    return max(NEAR, STEEP * largest**2)


class ChangePoints:
    """Looks for change points of one mechanism's designs."""

    def __init__(self, traced: Traced, backend: Backend = "auto") -> None:
        self.traced, self.backend = traced, backend
        placed = traced.solver.motion.placed
        self.groups = tuple(modal_groups(traced.solver.structure))
        qualities = {name: placed[name].quality for name in self.groups}
        program = Program.of(traced.solver.motion.trace, qualities)
        sines = {name: each.facts["sine"] for name, each in placed.items() if "sine" in each.facts}
        self.sines = NumpyProgram(Program.of(traced.solver.motion.trace, sines)) if sines else None
        near = {name: each.facts["distance²"] for name, each in placed.items() if "distance²" in each.facts}
        pins = Program.of(traced.solver.motion.trace, {**near, **{f"quality {k}": placed[k].quality for k in near}})
        self.pins = NumpyProgram(pins) if near else None
        self.pins_anywhere = NumpyProgram(_anywhere(pins)) if near else None
        self.along = NumpyProgram(program)
        self.anywhere = NumpyProgram(_anywhere(program))

    def designs(self, columns: Mapping[str, Floats]) -> Indices:
        """Numbers of the designs that touch a change point, or may not pass, between two positions."""
        count = len(next(iter(columns.values())))
        found = [
            first + self._block({a: column[first : first + BLOCK] for a, column in columns.items()})
            for first in range(0, count, BLOCK)
        ]
        return np.concatenate(found) if found else np.empty(0, dtype=np.intp)

    def _block(self, columns: Mapping[str, Floats]) -> Indices:
        return np.unique(np.concatenate([self._low(columns), self._parallel(columns), self._meeting(columns)]))

    def _along(self, program: NumpyProgram, table: Floats) -> Floats:
        """Outputs at all positions, (designs, outputs, n); compiled where that pays."""
        arrays, count = self.traced.positions.arrays, self.traced.positions.count
        code = code_for(program.program, None, Run(arrays, count, None, 1, self.backend), len(table))
        if code is None:
            return program.run_designs(table, arrays, length=count)
        return code.store(table, arrays, length=count)

    def _meeting(self, columns: Mapping[str, Floats]) -> Indices:
        """Designs in which the outer pins of a group meet between two positions, or pass too near to each other."""
        positions = self.traced.positions
        if self.pins is None or self.pins_anywhere is None:
            return np.empty(0, dtype=np.intp)
        anywhere, groups = self.pins_anywhere, len(self.pins.program.outputs) // 2
        table = self.traced.table(self.pins.program, columns)
        square = self._along(self.pins, table)[:, :groups]
        edges = square[:, :, [-1, 0]] if positions.closed else np.full((*square.shape[:2], 2), np.inf)
        around = np.concatenate([edges[:, :, :1], square, edges[:, :, 1:]], axis=2)
        largest = square.max(axis=2, keepdims=True)
        dips = (square <= around[:, :, :-2]) & (square < around[:, :, 2:]) & (square < NEAR * largest)
        design, group, place = np.nonzero(dips)
        if not len(design):
            return design
        own = self.traced.table(anywhere.program, columns)[design]
        rows = np.arange(len(place))

        def at(share: Floats) -> Floats:
            return anywhere.run_designs(own, {}, self._inputs(place, share), length=share.shape[1])

        share, smallest = lowest(lambda s: np.asarray(at(s)[rows, group]), np.zeros(len(place)), np.ones(len(place)))
        quality = at(share[:, None])[rows, groups + group, 0]
        return np.unique(design[(quality < -TOUCH) | (smallest <= MEETING * largest[design, group, 0])])

    def _parallel(self, columns: Mapping[str, Floats]) -> Indices:
        """Designs in which guides become parallel between two positions."""
        if self.sines is None:
            return np.empty(0, dtype=np.intp)
        positions = self.traced.positions
        table = self.traced.table(self.sines.program, columns)
        sign = np.sign(self._along(self.sines, table))
        next_sign = np.roll(sign, -1, axis=2) if positions.closed else sign[:, :, [*range(1, sign.shape[2]), -1]]
        return np.flatnonzero((sign * next_sign < 0.0).any(axis=(1, 2)))

    def _low(self, columns: Mapping[str, Floats]) -> Indices:
        if not self.groups:
            return np.empty(0, dtype=np.intp)
        table = self.traced.table(self.along.program, columns)
        quality = self._along(self.along, table)
        before, after = np.roll(quality, 1, axis=2), np.roll(quality, -1, axis=2)
        if not self.traced.positions.closed:
            before[:, :, 0] = after[:, :, -1] = np.inf
        valleys = (np.abs(quality) < near_enough(self.traced.positions)) & (quality <= before) & (quality < after)
        design, group, place = np.nonzero(valleys)
        if not len(design):
            return design
        smallest = self._refined(self.traced.table(self.anywhere.program, columns)[design], group, place)
        return np.unique(design[smallest <= TOUCH])

    def _refined(self, table: Floats, group: Indices, place: Indices) -> Floats:
        """The smallest value of each group's quality between the neighbours of a position."""
        rows = np.arange(len(place))

        def quality(share: Floats) -> Floats:
            inputs = self._inputs(place, share)
            found = self.anywhere.run_designs(table, {}, inputs, length=share.shape[1])
            return np.asarray(found[rows, group])

        return lowest(quality, np.zeros(len(place)), np.ones(len(place)))[1]

    def _inputs(self, place: Indices, share: Floats) -> dict[str, Floats]:
        """Inputs at shares of the way from the position before to the one after, by the drivers' laws."""
        time, period = self.traced.positions.time, self.traced.positions.period
        step = time[1] - time[0]
        around = np.concatenate([[time[0] - step], time, [time[-1] + step]])
        a, b = around[place][:, None], around[place + 2][:, None]
        at = a + share * (b - a)
        at = np.clip(at, time.min(), time.max()) if period is None else time[0] + (at - time[0]) % period
        inputs: dict[str, Floats] = {}
        for name, driver in self.traced.mechanism.drivers.items():
            value = driver.law.coordinate(at.ravel())[0].reshape(at.shape)
            inputs |= {**turned(name, value, np.cos, np.sin), Input("slide", name).name: value}
        return inputs
