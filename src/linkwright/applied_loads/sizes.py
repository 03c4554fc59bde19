"""Sizes of loads: a number, an expression, a ramp or a table; one formula each, for arrays and traced values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from linkwright.applied_loads.faults import formula_fault, table_fault
from linkwright.applied_loads.signals import Course, Signals, place_named, times_of_inputs
from linkwright.applied_loads.site import Mechanism
from linkwright.applied_loads.strokes import TURN
from linkwright.core.expression_tree import Number, denominators
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.formula.late_import import numpy as np
from linkwright.formula.table import Table as Curve
from linkwright.formula.trace import Mask, Scalar, absolute, floor, maximum, select
from linkwright.words import Message

if TYPE_CHECKING:
    from linkwright.core.arrays import Flags, Floats


#: Beyond its ends by this share of its length, or rad, a table still holds.
COVERED = 1e-9


class Size(ABC):
    """How large a load is while it acts.

    ``key``: of a file; ``numbers``: its dimensions by the suffixes of their addresses, as attributes; ``ramp``:
    whether it goes by the share of the phase that is passed; ``fallible``: whether it may have no value somewhere.
    """

    key: ClassVar[str] = ""
    numbers: ClassVar[Mapping[str, str]] = {}
    ramp: ClassVar[bool] = False
    fallible: ClassVar[bool] = False

    @abstractmethod
    def at(self, course: Course, share: Scalar) -> Scalar:
        """The size where a share of the phase is passed; NaN where there is none."""

    def outputs(self, mechanism: Mechanism) -> tuple[Output | None, ...]:
        """The outputs whose values it takes; None for one that is unknown."""
        return ()

    @property
    def divides(self) -> bool:
        """Whether it divides by what is no number."""
        return False

    @property
    def constants(self) -> Mapping[str, float]:
        """Its numbers that are no dimensions, by the names that ``Course.constant`` takes."""
        return {}

    @property
    def curve(self) -> Curve | None:
        """What ``Course.lookup`` looks up."""
        return None

    def kinks(self, signals: Signals) -> Floats:
        """Times, s, of its kinks, as far as these are known beforehand; perhaps several cycles away."""
        return np.empty(0)

    def fault(self, signals: Signals, course: Course, where: Flags, found: Floats) -> Message | None:
        """What keeps the values ``found`` from being finite at the positions ``where`` they are needed."""
        return None


@dataclass(frozen=True)
class One(Size):
    """No size: the load is set in full (a force by its components)."""

    def at(self, course: Course, share: Scalar) -> Scalar:
        return 1.0


@dataclass(frozen=True)
class Constant(Size):
    """One number, SI."""

    key: ClassVar[str] = "magnitude"
    numbers: ClassVar[Mapping[str, str]] = {"": "value"}
    value: float

    def at(self, course: Course, share: Scalar) -> Scalar:
        return course.dimension("magnitude")


@dataclass(frozen=True)
class Formula(Size):
    """An expression of parameters, ``t``, ``input`` and outputs."""

    key: ClassVar[str] = "magnitude"
    fallible: ClassVar[bool] = True
    expression: Expression

    def at(self, course: Course, share: Scalar) -> Scalar:
        found: Scalar = self.expression.over({name: course.named(name) for name in self.expression.names})
        return found

    def outputs(self, mechanism: Mechanism) -> tuple[Output | None, ...]:
        names = self.expression.names - {*mechanism.parameters, "t", "input"}
        return tuple(place_named(name, mechanism) for name in names)

    @property
    def divides(self) -> bool:
        return any(not isinstance(each, Number) for each in denominators(self.expression.tree))

    def fault(self, signals: Signals, course: Course, where: Flags, found: Floats) -> Message | None:
        return formula_fault(self.expression, signals, where, found)


@dataclass(frozen=True)
class Ramp(Size):
    """From one number to another, SI, over the phase."""

    key: ClassVar[str] = "ramp"
    numbers: ClassVar[Mapping[str, str]] = {".0": "start", ".1": "end"}
    ramp: ClassVar[bool] = True
    start: float
    end: float

    def at(self, course: Course, share: Scalar) -> Scalar:
        first, last = course.dimension("ramp.0"), course.dimension("ramp.1")
        return first + (last - first) * share


@dataclass(frozen=True)
class Table(Size):
    """Values ``y`` at increasing ``x`` of ``over``: the input, the time, or an output.

    ``linear``: straight lines between them; ``cubic``: a spline with continuous second derivative, its ends "not a
    knot"; ``periodic``: one that goes on from its end as from its beginning, over full turns of an angle.
    """

    key: ClassVar[str] = "table"
    fallible: ClassVar[bool] = True
    over: Literal["input", "time"] | Output
    x: tuple[float, ...]
    y: tuple[float, ...]
    across: str = "angle"  # dimension of x
    interpolation: Literal["linear", "cubic", "periodic"] = "linear"

    def at(self, course: Course, share: Scalar) -> Scalar:
        x, missing = self._place(course)
        return select(missing, float("nan"), course.lookup(x))

    def _place(self, course: Course) -> tuple[Scalar, Mask]:
        """Where it is looked up, and whether it does not reach there.

        Angles count modulo one turn; a table over several full turns repeats after them.
        """
        over = self.over
        x = course.output(over) if isinstance(over, Output) else course.named("t" if over == "time" else "input")
        first, last = course.constant("first"), course.constant("last")
        span = last - first
        if (over.dimension if isinstance(over, Output) else self.across) == "angle" and over != "time":
            span_of_turns = TURN * maximum(1.0, floor(span / TURN + 0.5))
            gone = x - first - span_of_turns * floor((x - first) / span_of_turns)
            moved = first + select(gone > span_of_turns - COVERED, gone - span_of_turns, gone)
            x = select(span > TURN, select(absolute(span - span_of_turns) > COVERED, x, moved), moved)
        slack = COVERED * span
        return x, (x < first - slack) | (x > last + slack)

    def outputs(self, mechanism: Mechanism) -> tuple[Output | None, ...]:
        return (self.over,) if isinstance(self.over, Output) else ()

    @property
    def constants(self) -> Mapping[str, float]:
        return {"first": self.x[0], "last": self.x[-1]}

    @property
    def curve(self) -> Curve:
        return _curve(self)

    @property
    def known_at(self) -> tuple[float, ...]:
        """Its places of the input or the time, which are known beforehand."""
        return () if isinstance(self.over, Output) else self.x

    def kinks(self, signals: Signals) -> Floats:
        knots = np.array(self.known_at)
        found = knots if self.over == "time" or not len(knots) else times_of_inputs(knots, signals)
        return np.empty(0) if found is None else found

    def fault(self, signals: Signals, course: Course, where: Flags, found: Floats) -> Message | None:
        place: tuple[Any, Any] = self._place(course)
        short = place[0][where & place[1]]
        return table_fault(self.over, (self.x[0], self.x[-1]), short, signals) if len(short) else None


@lru_cache(256)
def _curve(table: Table) -> Curve:
    if table.interpolation == "linear":
        return Curve.linear(table.x, table.y)
    return Curve.spline(table.x, table.y, periodic=table.interpolation == "periodic")


@dataclass(frozen=True)
class Twist(Size):
    """The angle of link ``b`` against link ``a``, rad, with its turns; near an angle where the cycle begins."""

    a: str
    b: str
    near: float

    def at(self, course: Course, share: Scalar) -> Scalar:
        return course.angle_between(self.a, self.b, self.near)


@dataclass(frozen=True)
class OverCycle(Size):
    """What a kind finds at all positions in a way of its own, ``values``; no formula gives it."""

    values: Callable[[Signals], Floats]

    def at(self, course: Course, share: Scalar) -> Scalar:
        raise NotImplementedError

    def outputs(self, mechanism: Mechanism) -> tuple[Output | None, ...]:
        return (None,)
