"""Designs that cannot move: how many, at which group, why."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import Output
from linkwright.designs.one_by_one import changes_of, sentence_of
from linkwright.designs.traced_outputs import Traced
from linkwright.formula.program import Program
from linkwright.formula.reductions import Reduction
from linkwright.formula.summaries import summaries
from linkwright.kinematics.cycle import over_cycle
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
