"""Sentences for positions that cannot be reached, and for what a motion passes or not."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Indices
from linkwright.core.outputs import row_name
from linkwright.core.quantity import shown
from linkwright.drivers.rocking import Rocking
from linkwright.kinematics.change_points import closes
from linkwright.kinematics.cycle import FEW, MOST, cycle_turns, not_back, together
from linkwright.kinematics.motion import Motion, Outcome
from linkwright.kinematics.passing import ChangePointCrossing
from linkwright.kinematics.positions import Positions, coordinate_text
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import number
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.elements import Group
    from linkwright.kinematics.tracked_branch import Stop


#: A position this near (rad, m) to where a way ends is itself singular.
ON_LIMIT = 1e-6
#: Pins this near, as share of the mechanism's size, are at one place.
AT_ONE_PLACE = 1e-9
#: Digits, of rad or m, to which the end of a tracked path is reported.
KNOWN = 6


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


_PASSAGES = {
    "change": _("change point of group ({links}) at {where}: the motion goes on smoothly", code="cycle.change"),
    "meeting": _(
        "the outer pins of group ({links}) meet at {where}, where it could turn freely: the motion goes on smoothly",
        code="cycle.meeting",
    ),
    "end": _(
        "change point of group ({links}) at {where}: the groups without closed form that "
        "hang on it cannot be tracked through it, so the motion ends there",
        code="cycle.end",
    ),
    "pole": _(
        "the guides of group ({links}) become parallel at {where}: the mechanism cannot pass there", code="cycle.pole"
    ),
    "gap": _(
        "group ({links}) cannot be assembled in a short stretch at {where}, between two "
        "positions: the mechanism cannot pass there",
        code="cycle.gap",
    ),
}
_OUTCOMES = {
    "lost": _(
        "group {signature} ({links}) cannot be tracked to this position: it is out of reach "
        "or beyond a singular position",
        code="outcome.lost",
    ),
    "stopped": _(
        "group {signature} ({links}) cannot be tracked to this position: on the way it becomes singular at {where}",
        code="outcome.stopped",
    ),
    "singular": _(
        "group {signature} ({links}) is at a singular position (dead point or change point), "
        "where its motion is not determined by the driver",
        code="outcome.singular",
    ),
    "coinciding": _(
        "the two outer pins of group {signature} ({links}) are at one place, so that the "
        "group can turn freely about them",
        code="outcome.coinciding",
    ),
    "apart": _("group {signature} ({links}) cannot be assembled: {reason}", code="outcome.apart"),
}


def turn_notes(motion: Motion) -> tuple[Message, ...]:
    """How many turns of the drivers the cycle of a mechanism with wheels takes, if not one, or that it never ends."""
    positions, mechanism = motion.positions, motion.mechanism
    if not positions.cycle or not (mechanism.cycle is None or mechanism.cycle.natural):
        return ()
    if notes := _rock_notes(mechanism):
        return notes
    if positions.period is not None:
        turns, driver = cycle_turns(mechanism, positions.period)
        if turns == 1:
            return ()
        message = (
            _("the cycle is {turns} turns of {driver!r}: only then are all wheels back", code="cycle.turns")
            if turns > together(mechanism)
            else _(
                "the cycle is {turns} turns of {driver!r}: only then are all drivers back",
                code="cycle.turns_of_drivers",
            )
        )
        return (message.format(turns=turns, driver=driver),)
    if (count := together(mechanism)) > FEW:
        return (_drivers_not_back(mechanism, count),)
    return (
        (
            _(
                "the wheels or racks do not come back to where they began within {most} turns, so "
                "one turn of the driver is taken as an open cycle",
                most=MOST,
            ),
        )
        if mechanism.higher and not_back(mechanism)
        else ()
    )


def _rock_notes(mechanism: Mechanism) -> tuple[Message, ...]:
    """That a driver in a cycle that rocks turns, as it finds no limit."""
    return tuple(
        _(
            "the {link} can turn fully, so it turns instead of rocking; to rock it, give two "
            "coordinates, as in cycle: {{rock: [-30 deg, 30 deg]}}",
            code="cycle.rock_turns",
            link=driver.link,
        )
        for driver in mechanism.drivers.values()
        if isinstance(driver.law, Rocking) and driver.law.ends is None
    )


def _drivers_not_back(mechanism: Mechanism, count: float) -> Message:
    """That drivers of several speeds are back together only after many turns, or not even then."""
    natural, driver = max((d.law.natural_duration() or 0.0, name) for name, d in mechanism.drivers.items())
    if math.isinf(count):
        return _(
            "the drivers are not back together within {most} turns of {driver!r}, so one of "
            "these is taken as an open cycle",
            code="cycle.drivers_never_back",
            most=MOST,
            driver=driver,
        )
    return _(
        "all drivers are back only after {turns} turns of {driver!r}, so one of these is "
        "taken as an open cycle; cycle: {{duration: {duration} s}} takes them all",
        code="cycle.drivers_apart",
        turns=int(count),
        driver=driver,
        duration=number(count * natural, 9),
    )


def branch_notes(motion: Motion) -> tuple[Message, ...]:
    """That tracked groups do not come back to their start."""
    way = motion.tracked
    return (
        ()
        if way is None or way.returns is not False
        else (
            _(
                "after one cycle the groups without closed form are in another assembly than at its "
                "start: the motion does not repeat after one cycle",
                code="cycle.not_back",
            ),
        )
    )


def passage_notes(passing: Sequence[ChangePointCrossing], positions: Positions) -> tuple[Message, ...]:
    """What the user should know about change points and gaps between positions."""
    messages = [_passage_note(p, positions) for p in passing]
    if positions.closed and not closes(passing):
        messages.append(
            _(
                "after one cycle the mechanism is in its other assembly mode: the motion repeats after two cycles",
                code="cycle.two_cycles",
            )
        )
    return tuple(dict.fromkeys(messages))


def _passage_note(p: ChangePointCrossing, positions: Positions) -> Message:
    name = next(iter(positions.coordinates))
    where = f"{name} = {shown(float(p.at), 'angle' if positions.rotary[name] else 'length')}"
    return _PASSAGES[p.kind].format(links=tuple(p.group.split("+")), where=where)


class _Facts:
    """Numbers of the failing groups at the failed positions."""

    def __init__(self, motion: Motion, failed: Indices) -> None:
        self.motion = motion
        self.groups = motion.structure.groups
        names = [
            row_name("fact", group.name, on=fact)
            for group in self.groups
            for fact in motion.solver.motion.placed[group.name].facts
        ]
        values = motion.solver.evaluate(tuple(names), motion.positions, motion.states, motion.modes, motion.design)
        self.values = {name: row[failed] for name, row in zip(names, values, strict=True)}

    def outcome(self, place: int, index: int) -> Outcome:
        code = self.motion.outcome_codes[index]
        if code == 0 or not np.isfinite(code):
            return Outcome(
                False,
                _(
                    "the way from the first position to this one is barred by a position out of reach",
                    code="outcome.barred",
                ),
                None,
                "barred",
            )
        group = self.groups[int(abs(code)) - 1]
        for joint in self.motion.mechanism.joints.values():
            misfit = joint.misfit(self.motion.mechanism) if set(joint.joined) & set(group.links) else None
            if misfit is not None:
                message = _("the pair {joint!r} does not fit: {reason}", joint=joint.name, reason=misfit)
                return Outcome(False, message, group.name, "misfit")
        placed = self.motion.solver.motion.placed[group.name]
        if placed.dyad is None:
            return self._lost(group, index)
        facts = {name: float(self.values[row_name("fact", group.name, on=name)][place]) for name in placed.facts}
        if code < 0:
            together = facts.get("distance²", math.inf) < (AT_ONE_PLACE * self.motion.mechanism.size) ** 2
            message = _of("coinciding" if together else "singular", group)
            return Outcome(False, message, group.name, "singular")
        reason = placed.dyad.explain(facts)
        return Outcome(False, _of("apart", group, reason=reason), group.name, "unreachable")

    def _lost(self, group: Group, index: int) -> Outcome:
        """A group without closed form: where the way to the position ends, and at which group."""
        way = self.motion.tracked
        if way is None or way.stop_of[index] < 0:
            return Outcome(False, _of("lost", group), group.name, "unreachable")
        stop = way.stops[way.stop_of[index]]
        group = next(each for each in self.groups if each.name == stop.group)
        rows = self.motion.positions
        names = list(rows.coordinates)
        here = np.array([rows.coordinates[name][0][index] for name in names])
        if (np.abs(here - stop.inputs) < ON_LIMIT).all():
            return Outcome(False, _of("singular", group), group.name, "singular")
        return Outcome(False, way_stopped(self.motion, group, stop), group.name, "unreachable")


def way_stopped(motion: Motion, group: Group, stop: Stop) -> Message:
    """Where the way of a group without closed form ends."""
    rotary = motion.positions.rotary
    where = ", ".join(
        coordinate_text(name, float(q), rotary[name])
        for name, q in zip(motion.positions.coordinates, np.round(stop.inputs, KNOWN) + 0.0, strict=True)
    )
    return _of("stopped", group, where=where)


def _of(key: str, group: Group, **values: object) -> Message:
    """The message about a group."""
    return _OUTCOMES[key].format(signature=group.signature, links=group.links, **values)


def input_at(motion: Motion, index: int) -> str:
    """The drivers' coordinates at a position, in words."""
    parts = [
        coordinate_text(name, float(q[index]), motion.positions.rotary[name]) for name, q in motion.inputs.items()
    ]
    return _("input {parts}", parts=tuple(parts)) if parts else _("its only position", code="motion.only_position")
