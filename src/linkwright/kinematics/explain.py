"""Sentences for positions that cannot be reached."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from linkwright.kinematics.outcome import Outcome, PositionError

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion

FINE = Outcome(True)


def explain(motion: Motion) -> list[Outcome]:
    """What became of every position of a motion."""
    found = [FINE] * motion.steps
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
            sentence = "the way from the first position to this one is barred by a position out of reach"
            return Outcome(False, sentence, None, "barred")
        group = self.groups[int(abs(code)) - 1]
        placed = self.motion.solver.motion.placed[group.name]
        who = f"group {group.signature} ({', '.join(group.links)})"
        if placed.dyad is None:
            sentence = (
                f"{who} cannot be followed to this position: it is out of reach or beyond a singular position"
            )
            return Outcome(False, sentence, group.name, "unreachable")
        facts = {name: float(self.values[f"fact:{group.name}|{name}"][place]) for name in placed.facts}
        if code < 0:
            sentence = (
                f"{who} is at a singular position (dead point or change point), where its motion is not "
                "determined by the driver"
            )
            return Outcome(False, sentence, group.name, "singular")
        return Outcome(
            False, f"{who} cannot be assembled: {placed.dyad.explain(facts)}", group.name, "unreachable"
        )


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
