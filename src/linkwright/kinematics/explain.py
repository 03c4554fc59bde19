"""Sentences for positions that cannot be reached."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from linkwright.kinematics.outcome import Outcome, PositionError
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.structure.group import Group


def explain(motion: Motion) -> list[Outcome]:
    """What became of every position of a motion."""
    found = [Outcome(True)] * motion.steps
    failed = np.flatnonzero(~motion.ok)
    if not len(failed):
        return found
    facts = _Facts(motion, failed)
    for place, index in enumerate(failed):
        found[index] = facts.outcome(place, int(index))
    return found


class _Facts:
    """Numbers of the failing groups at the failed positions."""

    def __init__(self, motion: Motion, failed: NDArray[np.intp]) -> None:
        self.motion = motion
        self.groups = motion.structure.groups
        names = [
            f"fact:{group.name}|{fact}"
            for group in self.groups
            for fact in motion.solver.motion.placed[group.name].facts
        ]
        values = motion.solver.evaluate(
            tuple(names), motion.positions, motion.states, motion.modes, motion.design
        )
        self.values = {name: row[failed] for name, row in zip(names, values, strict=True)}

    def outcome(self, place: int, index: int) -> Outcome:
        code = self.motion.outcome_codes[index]
        if code == 0 or not np.isfinite(code):
            return Outcome(False, Sentence("outcome.barred"), None, "barred")
        group = self.groups[int(abs(code)) - 1]
        placed = self.motion.solver.motion.placed[group.name]
        if placed.dyad is None:
            return Outcome(False, _of("lost", group), group.name, "unreachable")
        if code < 0:
            return Outcome(False, _of("singular", group), group.name, "singular")
        facts = {name: float(self.values[f"fact:{group.name}|{name}"][place]) for name in placed.facts}
        reason = placed.dyad.explain(facts)
        return Outcome(False, _of("apart", group, reason=reason), group.name, "unreachable")


def _of(key: str, group: Group, **values: object) -> Sentence:
    """What is to be said of a group."""
    return Sentence(f"outcome.{key}", signature=group.signature, links=group.links, **values)


def refusal(motion: Motion) -> PositionError:
    """The error for a motion of which some positions cannot be reached."""
    from linkwright.kinematics.input_range import range_sentence

    failed = np.flatnonzero(~motion.ok)
    first = int(failed[0])
    outcome = motion.outcomes[first]
    where = _where(motion, first)
    others = f" ({len(failed)} of {motion.steps} positions fail)" if len(failed) > 1 else ""
    more = "; ".join(motion.notes) if outcome.kind == "barred" else range_sentence(motion.mechanism)
    told = f"; {more}" if more else ""
    advice = (
        "change the dimensions, the assembly or the range of the input (cycle: {from: …, to: …}), "
        "or ask for marked outcomes"
    )
    return PositionError(
        f"{motion.mechanism.name!r} cannot be solved at {where}{others}: {outcome.sentence}{told}; {advice}",
        tuple(int(i) for i in failed),
        outcome,
    )


def _where(motion: Motion, index: int) -> str:
    parts = []
    for name, q in motion.inputs.items():
        rotary = motion.positions.rotary[name]
        value = f"{np.degrees(q[index]):.6g}°" if rotary else f"{q[index]:.6g} m"
        parts.append(f"{name} = {value}")
    return "input " + ", ".join(parts) if parts else "its only position"
