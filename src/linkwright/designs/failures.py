"""Designs that cannot move, or that touch a change point: how many, at which group, why.

At a change point the square under a dyad's root comes down to zero and rises again, in a gap it falls below. Small
minima over the positions are refined in all designs together, by sections of the stretch between the neighbouring
positions. Where guides become parallel their sine changes its sign.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.inputs import Input, turned
from linkwright.core.outputs import Output
from linkwright.core.search import lowest
from linkwright.designs.metrics_of_designs import changes_of, sentence_of
from linkwright.designs.traced_outputs import Traced
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.summaries import Backend, Run, code_for, summaries
from linkwright.kinematics.assembly import modal_groups
from linkwright.kinematics.change_points import MEETING, TOUCH
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.passing import NEAR
from linkwright.kinematics.positions import Positions
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: Where designs fail that fail at no group.
PLACES = {
    "barred": _("between two positions", code="study.between_positions"),
    "unfit": _("at wheels off their distance", code="study.at_wheels"),
}
BY_LOADS = _("by loads or metrics", code="study.by_loads")


@dataclass(frozen=True)
class Failure:
    """Designs that fail for one reason.

    ``group``: the first group that fails (None where it is a load, or is unknown); ``kind``: ``unreachable``,
    ``singular``, ``barred`` (between two positions), ``unfit`` (wheels off their distance), ``load`` or
    ``followed``; ``designs``: their numbers; ``example``: what happens to the first one.
    """

    group: str | None
    kind: str
    designs: Indices
    example: str

    @property
    def count(self) -> int:
        """How many designs fail in this way."""
        return len(self.designs)

    @property
    def place(self) -> Message:
        """Where they fail: at a group, between two positions, at wheels, or by what is asked of them."""
        if self.group is not None:
            return _("at the group ({group})", group=tuple(self.group.split("+")))
        return PLACES.get(self.kind, BY_LOADS)


def explained(
    mechanism: Mechanism,
    varied: Mapping[str, Floats],
    ok: Flags,
    positions: int,
    unloaded: Mapping[int, str],
    limit: int,
) -> tuple[Failure, ...]:
    """The reasons of all failing designs, the most frequent first."""
    failing = np.flatnonzero(~ok)
    failing = failing[~np.isin(failing, list(unloaded))][:limit]
    found = []
    if unloaded:
        numbers = np.array(sorted(unloaded), dtype=np.intp)
        found.append(Failure(None, "load", numbers, unloaded[int(numbers[0])]))
    if len(failing):
        unfit = _misfits(mechanism, {address: column[failing] for address, column in varied.items()})
        if unfit:
            first = min(unfit)
            found.append(Failure(None, "unfit", failing[sorted(unfit)], unfit[first]))
            failing = np.delete(failing, sorted(unfit))
    if len(failing):
        columns = {address: column[failing] for address, column in varied.items()}
        found += _by_group(mechanism, columns, failing, positions)
    return tuple(sorted(found, key=lambda failure: -failure.count))


def _misfits(mechanism: Mechanism, columns: Mapping[str, Floats]) -> dict[int, Message]:
    """What does not fit of pairs of wheels, by the number of the design."""
    if not mechanism.higher:
        return {}
    found: dict[int, Message] = {}
    for design in range(len(next(iter(columns.values())))):
        changed = mechanism.with_dimensions(changes_of(columns, design))
        for joint in changed.joints.values():
            if (why := joint.misfit(changed)) is not None:
                found.setdefault(design, why)
    return found


def _by_group(mechanism: Mechanism, columns: Mapping[str, Floats], numbers: Indices, count: int) -> list[Failure]:
    """Each design under the group that fails at most of its positions."""
    traced = _traced(mechanism, columns, count)
    if traced.solver.motion.next_states:
        groups = (g.name for g in traced.solver.structure.groups if traced.solver.motion.placed[g.name].next_states)
        sentence = sentence_of(traced, changes_of(columns, 0))
        return [Failure(next(groups, None), "followed", numbers, sentence)]
    flags = traced.failure_flags()
    program = Program.of(traced.solver.motion.trace, flags)
    wanted = [Reduction(name, "sum") for name in program.output_names]
    table = traced.table(program, columns)
    results = summaries(program, wanted, None).evaluate(table, traced.positions.arrays)
    sums = np.array([results[reduction.name] for reduction in wanted] or [np.zeros(len(numbers))], dtype=float)
    worst = np.argmax(sums, axis=0)
    found = []
    between = np.flatnonzero(sums.max(axis=0) == 0)
    if len(between):
        sentence = sentence_of(traced, changes_of(columns, int(between[0])))
        found.append(Failure(None, "barred", numbers[between], sentence))
        worst[between] = -1
    for place in np.unique(worst[worst >= 0]):
        mine = np.flatnonzero(worst == place)
        flag = Output.of_row(wanted[place].output)
        sentence = sentence_of(traced, changes_of(columns, int(mine[0])))
        found.append(Failure(flag.owner, flag.kind, numbers[mine], sentence))
    return found


def _traced(mechanism: Mechanism, columns: Mapping[str, Floats], count: int) -> Traced:
    positions = over_cycle(mechanism, count)
    if positions.count != count:
        positions = over_cycle(mechanism, count - 1)
    return Traced(mechanism, columns, positions)


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
    for name, (q, *_rates) in positions.coordinates.items():
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
