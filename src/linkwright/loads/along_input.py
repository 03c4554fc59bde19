"""Magnitudes of loads that follow the input, or an output's way between its limits, as traced values.

For mechanisms with one turning driver of constant speed over one closed turn, where everything is a function of the
input. What is found per design before, the inputs of the limits, enters as a number.
"""

from __future__ import annotations

from typing import Protocol

from linkwright.engine.trace import Mask, Scalar, absolute, floor, maximum, minimum, select, sign
from linkwright.loads.base import Load
from linkwright.loads.phases import NEAR, TURN
from linkwright.model.expressions import Expression
from linkwright.model.signal_fields import InputPhase, Output, SwingPhase
from linkwright.model.traced_expressions import traced


class Course(Protocol):
    """What such a magnitude sees of the mechanism."""

    @property
    def input(self) -> Scalar:
        """The driver's coordinate, rad."""
        ...

    @property
    def speed(self) -> Scalar:
        """Its rate, rad/s."""
        ...

    def named(self, name: str) -> Scalar:
        """A parameter of the model, ``t`` or ``input``."""
        ...

    def dimension(self, field: str) -> Scalar:
        """A quantity of the load."""
        ...

    def limit(self, output: Output, kind: str) -> Scalar:
        """The input, rad, at which an output has its only ``max`` or ``min``."""
        ...


def follows_input(load: Load, parameters: frozenset[str]) -> bool:
    """Whether the magnitude of a load is of this kind; ``parameters``: names of the model's."""
    if type(load).from_cycle is not Load.from_cycle or getattr(load, "table", None) is not None:
        return False
    phase, magnitude = getattr(load, "phase", None), getattr(load, "magnitude", None)
    if isinstance(phase, SwingPhase):
        if phase.part is not None:
            return False
    elif not (phase is None or isinstance(phase, InputPhase)):
        return False
    return not isinstance(magnitude, Expression) or magnitude.names <= parameters | {"t", "input"}


def magnitude(load: Load, course: Course) -> Scalar:
    """The magnitude of a load that follows the input; zero outside its phase."""
    acts, share = _phase(load, course)
    given = getattr(load, "magnitude", None)
    if getattr(load, "ramp", None) is not None:
        first, last = course.dimension("ramp.0"), course.dimension("ramp.1")
        size: Scalar = first + (last - first) * share
    elif isinstance(given, Expression):
        size = traced(given, course.named)
    else:
        size = 1.0 if given is None else course.dimension("magnitude")
    return select(acts, size, 0.0)


def _phase(load: Load, course: Course) -> tuple[Mask, Scalar]:
    """Whether the load acts, and the share of its phase that is passed."""
    phase = getattr(load, "phase", None)
    match phase:
        case InputPhase():
            return _between(course)
        case SwingPhase():
            sense = sign(course.speed)
            begin, end = (course.limit(phase.output, kind) for kind in (phase.start, phase.end))
            return _within(sense * (course.input - begin), turned(sense * (end - begin)))
    return True, 0.0


def _between(course: Course) -> tuple[Mask, Scalar]:
    """An interval of the input, modulo one turn; from the larger to the smaller end through the turn's end."""
    start, end = course.dimension("phase.input.0"), course.dimension("phase.input.1")
    gap = end - start
    through = turned(gap)
    through = select(through <= 0.0, TURN, through)
    length = select(gap < 0.0, select(course.speed > 0.0, through, gap), gap)
    acts, share = _within(course.input - minimum(start, start + length), absolute(length))
    return acts, select(length > 0.0, share, 1.0 - share)


def _within(gone: Scalar, length: Scalar) -> tuple[Mask, Scalar]:
    """Whether what is gone of a turn lies within a length, and its share; the ends belong to it."""
    way = turned(gone)
    passed = select(way > TURN * (1.0 - NEAR), way - TURN, way)
    return passed <= length + NEAR * TURN, minimum(maximum(passed / length, 0.0), 1.0)


def turned(angle: Scalar) -> Scalar:
    """An angle modulo one turn, 0 to 2π."""
    return angle - TURN * floor(angle / TURN)
