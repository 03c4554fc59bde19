"""Strokes: an output's way from one limit position to the other, parts of it, and laps of the input."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, Protocol

from linkwright.applied_loads.signals import BetweenLimits, FullCycle, Limit, Signals, input_dimension
from linkwright.core.outputs import Output
from linkwright.core.quantity import shown
from linkwright.errors import LinkwrightError
from linkwright.formula.late_import import numpy as np
from linkwright.formula.trace import Mask, Scalar, floor, maximum, minimum, select
from linkwright.words import _, pgettext

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats

TURN = 2 * math.pi
#: Positions this near to the end of a phase (rad, m, or share of the cycle's time) are at it but for rounding.
NEAR = 1e-12
#: Limits nearer to the outermost ones than this share of the way are outermost, too.
EQUAL_VALUES = 1e-9
PartWord = Literal["first", "last", "free"]


@dataclass(frozen=True)
class Amount:
    """A share of a stroke, 0 to 1, or a length of it (m or rad)."""

    value: float
    share: bool

    def way(self, stroke: float) -> float:
        """Its length in a stroke (m or rad)."""
        return self.value * stroke if self.share else self.value


@dataclass(frozen=True)
class StrokePart:
    """``first`` or ``last`` amount of a stroke, or all but the ``free`` amounts at its beginning and its end."""

    word: PartWord
    amounts: tuple[Amount, ...]


# found at times ------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Stretch:
    """One way of an output from a limit to another; times and inputs go on through the cycle's end."""

    begin: Limit
    end: Limit

    @property
    def rise(self) -> float:
        """How far the input goes."""
        return self.end.input - self.begin.input

    def place(self, signals: Signals) -> tuple[Flags, Floats]:
        """Whether the positions lie in it, ends included, and the share of the input's way that is passed; (n,)
        each."""
        length, full_cycle = self.end.time - self.begin.time, signals.full_cycle
        since, gained = signals.time - self.begin.time, signals.input - self.begin.input
        slack = NEAR * (full_cycle.period or length)
        if full_cycle.period is not None:
            laps = np.floor((since + slack) / full_cycle.period)
            since, gained = since - laps * full_cycle.period, gained - laps * full_cycle.drift
        return (since >= -slack) & (since <= length + slack), np.clip(gained / self.rise, 0.0, 1.0)


_LIMITS = {"max": pgettext("loads", "max"), "min": pgettext("loads", "min")}


def strokes(phase: BetweenLimits, signals: Signals) -> list[Stretch]:
    """The ways of a phase within the cycle. Raises LinkwrightError where it has none."""
    limits = signals.limits(phase.output)
    if not limits:
        raise LinkwrightError(
            _(
                "the output '{output}' never reverses within the cycle, so it has no limit "
                "positions; choose an output that swings, or give the phase by the input: {{input: "
                "[a, b]}}",
                code="loads.never_reverses",
                output=phase.output,
            )
        )
    extreme = outermost(limits) if phase.outermost else limits
    found = stretches(extreme, phase.start, phase.end, signals.full_cycle)
    if found or not phase.outermost:
        return found
    dimension = input_dimension(signals)
    places = tuple(
        _("{kind} at input {input}", kind=_LIMITS[each.kind], input=shown(each.input, dimension)) for each in extreme
    )
    ends = {name: _LIMITS[kind] for name, kind in (("start", phase.start), ("end", phase.end))}
    raise LinkwrightError(
        _(
            "the output '{output}' does not go from its {start} to its {end} within the cycle "
            "(it has its {places}); let the cycle hold both, or exchange from and to",
            code="loads.no_such_swing",
        ).format(output=phase.output, places=places, **ends)
    )


def outermost(limits: Sequence[Limit]) -> list[Limit]:
    """Of all reversals those with the largest and the smallest value of the output."""
    values = [each.value for each in limits]
    slack = EQUAL_VALUES * (max(values) - min(values))
    best = {
        "max": max((each.value for each in limits if each.kind == "max"), default=np.inf) - slack,
        "min": min((each.value for each in limits if each.kind == "min"), default=-np.inf) + slack,
    }
    return [
        each for each in limits if (each.value >= best["max"] if each.kind == "max" else each.value <= best["min"])
    ]


def stretches(limits: Sequence[Limit], start: str, end: str, full_cycle: FullCycle) -> list[Stretch]:
    """From each limit of one kind to the other kind's next one, across the end of a cycle that closes."""
    found = []
    for index, last in enumerate(limits):
        first = limits[index - 1]
        if (first.kind, last.kind) != (start, end) or (index == 0 and full_cycle.period is None):
            continue
        period, drift = (full_cycle.period or 0.0, full_cycle.drift) if index == 0 else (0.0, 0.0)
        found.append(Stretch(replace(first, time=first.time - period, input=first.input - drift), last))
    return found


# found along laps ----------------------------------------------------------------------------------
class Turning(Protocol):
    """A cycle in which an output has one limit of each kind: ``along`` the input (rad) of a driver that turns at
    constant speed, else along the time (s); ``sense``: 1 where that grows, -1 where it falls; ``lap``: how far that
    goes in the cycle, twice as far where it does not close."""

    @property
    def along(self) -> Scalar: ...
    @property
    def sense(self) -> Scalar: ...
    @property
    def lap(self) -> Scalar: ...

    def limit(self, output: Output, kind: str) -> Scalar:
        """Where along it an output has its limit."""
        ...

    def share_of_input(self, phase: BetweenLimits, share: Scalar) -> Scalar:
        """The share of the input's way between limits that is passed, from that along."""
        ...


def stroke_of_turn(course: Turning, phase: BetweenLimits) -> tuple[Mask, Scalar]:
    """Whether an output goes from one limit to the other, ends included, and the share of the input's way there."""
    acts, share = within(*_way(course, phase), course.lap)
    return acts, course.share_of_input(phase, share)


def moving_of_turn(course: Turning, phase: BetweenLimits) -> tuple[Mask, Scalar]:
    """The same without the ends, where the output is at rest."""
    gone, length = _way(course, phase)
    way, near = turned(gone, course.lap), NEAR * course.lap
    return (way > near) & (way < length - near), course.share_of_input(phase, way / length)


def _way(course: Turning, phase: BetweenLimits) -> tuple[Scalar, Scalar]:
    """Way since one limit of an output, and from there to the other one."""
    sense = course.sense
    begin, until = (course.limit(phase.output, kind) for kind in (phase.start, phase.end))
    return sense * (course.along - begin), turned(sense * (until - begin), course.lap)


def within(gone: Scalar, length: Scalar, lap: Scalar = TURN) -> tuple[Mask, Scalar]:
    """Whether what is gone of a lap lies within a length, and its share; the ends belong to it."""
    way, near = turned(gone, lap), NEAR * lap
    passed = select(way > lap - near, way - lap, way)
    return passed <= length + near, share_of(passed / length)


def share_of(ratio: Scalar) -> Scalar:
    """A ratio, from 0 to 1."""
    return minimum(maximum(ratio, 0.0), 1.0)


def turned(angle: Scalar, lap: Scalar = TURN) -> Scalar:
    """An angle modulo one lap, by default one turn: from 0 to that, rad."""
    return angle - lap * floor(angle / lap)
