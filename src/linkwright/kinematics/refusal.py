"""Why a motion is refused: where positions cannot be reached, and how far its drivers can go."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.kinematics.input_range import input_range
from linkwright.kinematics.motion import Motion, Outcome, PositionError
from linkwright.kinematics.reach_messages import input_at, way_stopped
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

_CHANGE = _(
    "change the dimensions, the assembly or the range of the input (cycle: rock, or cycle: {{from: …, "
    "to: …}}), or ask for marked outcomes"
)


def _not_passed(motion: Motion) -> PositionError:
    """The error for a cycle that is barred between two positions, though all of them are reached from both sides."""
    barred = Outcome(False, _("the way is barred between two positions"), None, "barred")
    way, reasons = motion.tracked, (barred, *motion.notes)
    if way is not None and way.stops:
        group = next(each for each in motion.structure.groups if each.name == way.stops[0].group)
        reasons = (barred, way_stopped(motion, group, way.stops[0]), *motion.notes)
    message = _(
        "{name!r} cannot pass its cycle: {reasons}; {advice}",
        code="motion.not_passed",
        name=motion.mechanism.name,
        reasons=reasons,
        advice=_CHANGE,
    )
    return PositionError(message, (), barred)


def refusal(motion: Motion) -> PositionError:
    """The error for a motion of which some positions cannot be reached, or that is barred between two of them."""
    failed = np.flatnonzero(~motion.ok)
    if not len(failed):
        return _not_passed(motion)
    first = int(failed[0])
    outcome = motion.outcomes[first]
    where = input_at(motion, first)
    if len(failed) > 1:
        where = _("{where} ({failed} of {steps} positions fail)", where=where, failed=len(failed), steps=motion.steps)
    links = next((each.links for each in motion.structure.groups if each.name == outcome.group), ())
    reasons = list(motion.notes) if outcome.kind == "barred" else range_sentence(motion.mechanism, tuple(links))
    message = (
        _("{name!r} cannot be solved at {where}: {sentence}; {reasons}; {advice}", code="motion.refused_told")
        if reasons
        else _("{name!r} cannot be solved at {where}: {sentence}; {advice}", code="motion.refused")
    ).format(name=motion.mechanism.name, where=where, sentence=outcome, reasons=reasons, advice=_CHANGE)
    return PositionError(message, tuple(int(i) for i in failed), outcome)


def range_sentence(mechanism: Mechanism, links: Sequence[str] = ()) -> str:
    """A driver's range as a sentence for a refusal; empty where there is none to tell. Never raises.

    Of several drivers it is that of the first whose range the group of ``links`` ends, the others at their start.
    """
    for driver in mechanism.drivers:
        try:
            found = input_range(mechanism, driver)
        except (LinkwrightError, ArithmeticError, ValueError):
            continue
        if len(mechanism.drivers) == 1:
            return found.explain()
        groups = [end.group for end in (found.low, found.high) if end is not None]
        if any(isinstance(each, Message) and each.values.get("links") == tuple(links) for each in groups):
            return _(
                "with the other drivers at their start {reason}", code="range.others_still", reason=found.explain()
            )
    return ""
