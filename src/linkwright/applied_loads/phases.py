"""Phases of the cycle in which loads act: when, and how far a phase has gone; for arrays and traced values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from linkwright.applied_loads.faults import interval_fault, part_fault
from linkwright.applied_loads.signals import Course, LimitKind, Signals, times_of_inputs
from linkwright.applied_loads.strokes import NEAR, TURN, StrokePart, share_of, turned, within
from linkwright.core.outputs import Output
from linkwright.formula.late_import import numpy as np
from linkwright.formula.trace import Mask, Scalar, absolute, maximum, minimum, select, sign
from linkwright.words import Message

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats

#: Whether a load acts, the share of the phase that is passed, and whether there is such a phase.
Passed = tuple[Mask, Scalar, Mask]


class Phase(ABC):
    """When a load acts.

    ``numbers``: its dimensions by the suffixes of their addresses, as attributes.
    """

    numbers: ClassVar[Mapping[str, str]] = {}

    @abstractmethod
    def passed(self, course: Course, ramp: bool) -> Passed:
        """How far it has gone; the share at least for a ``ramp``."""

    @property
    def outputs(self) -> tuple[Output, ...]:
        """The output that it goes by."""
        return ()

    @property
    def in_part(self) -> bool:
        """Whether it goes by the value of that output."""
        return False

    @property
    def constants(self) -> Mapping[str, float]:
        """Its numbers that are no dimensions, by the names that ``Course.constant`` takes."""
        return {}

    def ends(self, signals: Signals) -> tuple[Floats, bool]:
        """Times, s, at which it begins or ends, as far as these are known beforehand, perhaps several cycles away;
        and whether these are all."""
        limits = [limit.time for output in self.outputs for limit in signals.limits(output)]
        return np.array(limits), not self.in_part

    def fault(self, signals: Signals, course: Course, exists: Flags) -> Message | None:
        """What keeps the cycle from having such a phase."""
        return None


@dataclass(frozen=True)
class Always(Phase):
    """All of the cycle."""

    def passed(self, course: Course, ramp: bool) -> Passed:
        return True, 0.0, True


@dataclass(frozen=True)
class InputPhase(Phase):
    """While the first driver's coordinate is between ``start`` and ``end`` (rad or m; angles modulo one
    turn)."""

    numbers: ClassVar[Mapping[str, str]] = {".input.0": "start", ".input.1": "end"}
    start: float
    end: float
    across: str = "angle"  # dimension of both

    def passed(self, course: Course, ramp: bool) -> Passed:
        """A closed interval; of angles from the larger to the smaller end through the end of the turn where the input
        grows. There is none longer than a turn."""
        start, end = course.dimension("phase.input.0"), course.dimension("phase.input.1")
        gap = end - start
        if not course.rotary:
            low, high = minimum(start, end) - NEAR, maximum(start, end) + NEAR
            inside = (course.input >= low) & (course.input <= high)
            return inside, share_of((course.input - start) / gap), True
        through = turned(gap)
        through = select(through <= 0.0, TURN, through)
        length = select(gap < 0.0, select(course.heading > 0.0, through, gap), gap)
        acts, share = within(course.input - minimum(start, start + length), absolute(length))
        return acts, select(length > 0.0, share, 1.0 - share), absolute(gap) <= TURN + NEAR

    def ends(self, signals: Signals) -> tuple[Floats, bool]:
        found = times_of_inputs(np.array([self.start, self.end]), signals)
        return (np.empty(0), False) if found is None else (found, True)

    def fault(self, signals: Signals, course: Course, exists: Flags) -> Message | None:
        return interval_fault(self.start, self.end, signals)


@dataclass(frozen=True)
class MovingPhase(Phase):
    """While an output increases or decreases; a ramp runs from limit to limit."""

    output: Output
    direction: Literal["increasing", "decreasing"]
    outermost: ClassVar[bool] = False

    @property
    def start(self) -> LimitKind:
        """The limit at which that begins."""
        return "min" if self.direction == "increasing" else "max"

    @property
    def end(self) -> LimitKind:
        """The limit at which it ends."""
        return "max" if self.direction == "increasing" else "min"

    def passed(self, course: Course, ramp: bool) -> Passed:
        return (*course.moving(self, ramp), True)

    @property
    def outputs(self) -> tuple[Output, ...]:
        return (self.output,)


@dataclass(frozen=True)
class SwingPhase(Phase):
    """While an output goes from one of its limits to the other, both found by the program; ``part`` of that."""

    output: Output
    start: LimitKind
    end: LimitKind
    part: StrokePart | None = None
    outermost: ClassVar[bool] = True

    def passed(self, course: Course, ramp: bool) -> Passed:
        """In a part of the stroke where the output itself is there; there is none in a stroke too short for it."""
        acts, share = course.stroke(self, ramp)
        if self.part is None:
            return acts, share, True
        begin, end, stroke = self.part_ends(course)
        slack = NEAR * absolute(stroke)
        gone = (course.output(self.output) - course.limit_value(self.output, self.start)) * sign(stroke)
        fits = (begin >= -slack) & (end <= absolute(stroke) + slack) & (begin < end)
        inside = acts & (gone >= begin - slack) & (gone <= end + slack)
        return inside, share_of((gone - begin) / (end - begin)), fits

    def part_ends(self, course: Course) -> tuple[Scalar, Scalar, Scalar]:
        """Where the part begins and ends, as distances from the beginning, and the full stroke with its sign."""
        assert self.part is not None
        stroke = course.limit_value(self.output, self.end) - course.limit_value(self.output, self.start)
        size = absolute(stroke)
        distances = [
            course.constant(f"part.{k}") * (size if amount.share else 1.0)
            for k, amount in enumerate(self.part.amounts)
        ]
        if self.part.word == "first":
            return 0.0, distances[0], stroke
        if self.part.word == "last":
            return size - distances[0], size, stroke
        return distances[0], size - distances[-1], stroke

    @property
    def part_edges(self) -> tuple[int, ...]:
        """Which ends of the part, 0 and 1, lie between the limit positions."""
        if self.part is None:
            return ()
        amounts = self.part.amounts
        if self.part.word == "free":
            return tuple(which for which, each in enumerate((amounts[0], amounts[-1])) if each.value)
        if amounts[0].share and amounts[0].value == 1.0:
            return ()
        return (1,) if self.part.word == "first" else (0,)

    @property
    def outputs(self) -> tuple[Output, ...]:
        return (self.output,)

    @property
    def in_part(self) -> bool:
        return self.part is not None

    @property
    def constants(self) -> Mapping[str, float]:
        amounts = () if self.part is None else self.part.amounts
        return {f"part.{k}": amount.value for k, amount in enumerate(amounts)}

    def fault(self, signals: Signals, course: Course, exists: Flags) -> Message | None:
        if self.part is None or np.all(exists):
            return None
        ends: tuple[Any, Any, Any] = self.part_ends(course)
        return part_fault(self.output, self.part, float(abs(ends[2][int(np.argmin(exists))])))
