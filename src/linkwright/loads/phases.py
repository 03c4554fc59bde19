"""Phases of the cycle in which loads act: when, and how far a phase has gone; for arrays and traced values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self

from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import Output
from linkwright.engine.late_import import numpy as np
from linkwright.engine.trace import Mask, Scalar, absolute, maximum, minimum, select, sign
from linkwright.loads.course import Course
from linkwright.loads.faults import interval_fault, part_fault
from linkwright.loads.signals import Signals, times_of_inputs
from linkwright.loads.strokes import (
    NEAR,
    TURN,
    BetweenLimits,
    LimitKind,
    StrokePart,
    share_of,
    turned,
    within,
)
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats


class Phase(ABC):
    """When a load acts."""

    @abstractmethod
    def passed(self, course: Course, ramp: bool) -> tuple[Mask, Scalar, Mask]:
        """Whether the load acts, the share of the phase that is passed, at least for a ``ramp``, and whether there is
        such a phase."""

    @property
    def traceable(self) -> bool:
        """Whether its formula holds as it is."""
        return True

    @property
    def fallible(self) -> bool:
        """Whether designs may have no such phase."""
        return False

    @property
    def through_end(self) -> bool:
        """Whether it goes through the end of a turn of the input."""
        return False

    @property
    def outputs(self) -> tuple[Output, ...]:
        """The output that it goes by."""
        return ()

    @property
    def valued(self) -> tuple[Output, ...]:
        """The outputs whose values it takes."""
        return ()

    def limits(self, ramp: bool) -> BetweenLimits | None:
        """The limits of an output between which the load acts; None where it goes by something else."""
        return None

    def rate(self, ramp: bool) -> Output | None:
        """The output by the sign of whose rate alone the load acts; None where it goes by something else."""
        return None

    @property
    def constants(self) -> Mapping[str, float]:
        """Its numbers that are no dimensions, by the names that ``Course.constant`` takes."""
        return {}

    def ends(self, signals: Signals) -> tuple[Floats, bool]:
        """Times, s, at which it begins or ends, as far as these are known beforehand, perhaps whole cycles away; and
        whether these are all."""
        return np.empty(0), True

    def fault(self, signals: Signals, course: Course, exists: Flags) -> Sentence | None:
        """What keeps the cycle from having such a phase."""
        return None

    def dimensions(self) -> dict[str, float]:
        """Its dimensions by the suffixes of its address."""
        return {}

    def with_dimensions(self, value: Callable[[str], float]) -> Self:
        """The same with other values of its dimensions, by suffix."""
        return self


@dataclass(frozen=True)
class Always(Phase):
    """The whole cycle."""

    def passed(self, course: Course, ramp: bool) -> tuple[Mask, Scalar, Mask]:
        return True, 0.0, True


@dataclass(frozen=True)
class InputPhase(Phase):
    """While the first driver's coordinate is between ``start`` and ``end`` (rad or m; angles modulo one
    turn)."""

    start: float
    end: float
    across: str = "angle"  # dimension of both

    def passed(self, course: Course, ramp: bool) -> tuple[Mask, Scalar, Mask]:
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

    @property
    def traceable(self) -> bool:
        return not self.fallible or abs(self.end - self.start) <= TURN + NEAR

    @property
    def fallible(self) -> bool:
        return self.across == "angle"

    @property
    def through_end(self) -> bool:
        return self.across == "angle" and self.end < self.start

    def ends(self, signals: Signals) -> tuple[Floats, bool]:
        found = times_of_inputs(np.array([self.start, self.end]), signals)
        return (np.empty(0), False) if found is None else (found, True)

    def fault(self, signals: Signals, course: Course, exists: Flags) -> Sentence | None:
        return interval_fault(self.start, self.end, signals)

    def dimensions(self) -> dict[str, float]:
        return {".input.0": self.start, ".input.1": self.end}

    def with_dimensions(self, value: Callable[[str], float]) -> InputPhase:
        return InputPhase(value(".input.0"), value(".input.1"), self.across)


@dataclass(frozen=True)
class MovingPhase(Phase):
    """While an output increases or decreases; a ramp runs from limit to limit."""

    output: Output
    direction: Literal["increasing", "decreasing"]
    part: ClassVar[None] = None
    outermost: ClassVar[bool] = False

    @property
    def start(self) -> LimitKind:
        """The limit at which that begins."""
        return "min" if self.direction == "increasing" else "max"

    @property
    def end(self) -> LimitKind:
        """The limit at which it ends."""
        return "max" if self.direction == "increasing" else "min"

    def passed(self, course: Course, ramp: bool) -> tuple[Mask, Scalar, Mask]:
        return (*course.moving(self, ramp), True)

    @property
    def outputs(self) -> tuple[Output, ...]:
        return (self.output,)

    def limits(self, ramp: bool) -> BetweenLimits | None:
        return self if ramp else None

    def rate(self, ramp: bool) -> Output | None:
        return None if ramp else self.output

    def ends(self, signals: Signals) -> tuple[Floats, bool]:
        return np.array([limit.time for limit in signals.limits(self.output)]), True


@dataclass(frozen=True)
class SwingPhase(Phase):
    """While an output goes from one of its limits to the other, both found by the program; ``part`` of that."""

    output: Output
    start: LimitKind
    end: LimitKind
    part: StrokePart | None = None
    outermost: ClassVar[bool] = True

    def passed(self, course: Course, ramp: bool) -> tuple[Mask, Scalar, Mask]:
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
        """Where the part begins and ends, as ways from the beginning, and the whole stroke with its sign."""
        assert self.part is not None
        stroke = course.limit_value(self.output, self.end) - course.limit_value(self.output, self.start)
        size = absolute(stroke)
        ways = [
            course.constant(f"part.{k}") * (size if amount.share else 1.0)
            for k, amount in enumerate(self.part.amounts)
        ]
        if self.part.word == "first":
            return 0.0, ways[0], stroke
        if self.part.word == "last":
            return size - ways[0], size, stroke
        return ways[0], size - ways[-1], stroke

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
    def fallible(self) -> bool:
        return self.part is not None

    @property
    def outputs(self) -> tuple[Output, ...]:
        return (self.output,)

    @property
    def valued(self) -> tuple[Output, ...]:
        return () if self.part is None else (self.output,)

    def limits(self, ramp: bool) -> BetweenLimits:
        return self

    @property
    def constants(self) -> Mapping[str, float]:
        amounts = () if self.part is None else self.part.amounts
        return {f"part.{k}": amount.value for k, amount in enumerate(amounts)}

    def ends(self, signals: Signals) -> tuple[Floats, bool]:
        return np.array([limit.time for limit in signals.limits(self.output)]), self.part is None

    def fault(self, signals: Signals, course: Course, exists: Flags) -> Sentence | None:
        if self.part is None or np.all(exists):
            return None
        ends: tuple[Any, Any, Any] = self.part_ends(course)
        return part_fault(self.output, self.part, float(abs(ends[2][int(np.argmin(exists))])))
