"""What the magnitude of a load sees of the cycle: arrays of positions, or traced values."""

from __future__ import annotations

from typing import Protocol

from linkwright.core.outputs import Output
from linkwright.engine.trace import Mask, Scalar
from linkwright.loads.strokes import BetweenLimits


class Course(Protocol):
    """The cycle as one load sees it."""

    @property
    def input(self) -> Scalar:
        """The first driver's coordinate, rad or m."""
        ...

    @property
    def rotary(self) -> bool:
        """Whether it is an angle."""
        ...

    @property
    def heading(self) -> Scalar:
        """Above zero where it grows over the cycle, below where it falls."""
        ...

    def named(self, name: str) -> Scalar:
        """A parameter of the model, ``t``, ``input`` or an output."""
        ...

    def dimension(self, field: str) -> Scalar:
        """A quantity of the load."""
        ...

    def constant(self, field: str) -> Scalar:
        """A number of the load that is no dimension."""
        ...

    def output(self, output: Output) -> Scalar:
        """An output; angles are continuous over the cycle."""
        ...

    def angle_between(self, a: str, b: str, near: float) -> Scalar:
        """Angle of link b against link a, rad, continuous over the cycle, which begins within half a turn of
        ``near``."""
        ...

    def lookup(self, x: Scalar) -> Scalar:
        """The load's table at a place."""
        ...

    def stroke(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        """Whether an output goes from one limit to the other, ends included, and the share of the input's way there
        that is passed, of which a ``ramp`` needs the length."""
        ...

    def moving(self, phase: BetweenLimits, ramp: bool) -> tuple[Mask, Scalar]:
        """The same without the ends, where the output is at rest; the share only for a ramp."""
        ...

    def limit_value(self, output: Output, kind: str) -> Scalar:
        """The output at the limit of a kind that belongs to this stroke."""
        ...
