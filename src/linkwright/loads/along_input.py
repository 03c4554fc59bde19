"""Magnitudes of loads as traced values: expressions, ramps, tables and parts of strokes, within their phases.

For mechanisms with one turning driver of constant speed over one closed turn. What is found per design before, the
inputs of limit positions and the values there, enters as numbers; so do the numbers of a load that are no dimensions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from linkwright.core.expression_tree import Number
from linkwright.core.expressions import Expression, traced
from linkwright.engine.trace import Mask, Scalar, Value, absolute, floor, maximum, minimum, select, sign
from linkwright.fields.signals import InputPhase, MovingPhase, Output, SwingPhase, Table
from linkwright.loads.base import Load
from linkwright.loads.formulas import denominators, output_named
from linkwright.loads.phases import NEAR, TURN

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism


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
        """A parameter of the model, ``t``, ``input`` or an output."""
        ...

    def dimension(self, field: str) -> Scalar:
        """A quantity of the load."""
        ...

    def constant(self, field: str) -> Scalar:
        """A number of the load that is no dimension."""
        ...

    def known_phase(self) -> tuple[Mask, Scalar] | None:
        """Whether the load acts and the share of its phase that is passed, where these are known per position."""
        ...

    def limit(self, output: Output, kind: str) -> Scalar:
        """The input, rad, at which an output has its only ``max`` or ``min``."""
        ...

    def limit_value(self, output: Output, kind: str) -> Scalar:
        """The output there."""
        ...

    def output(self, output: Output) -> Scalar:
        """An output; angles are continuous over the cycle."""
        ...

    def angle_between(self, a: str, b: str) -> Scalar:
        """Angle of link b against link a, rad, continuous over the cycle."""
        ...

    def lookup(self, x: Scalar) -> Scalar:
        """The load's table at a place."""
        ...


def followed(load: Load, mechanism: Mechanism) -> bool:
    """Whether the magnitude of a load can be traced.

    Not where a kind finds it in a way of its own, and where an expression divides by an output, which may go through
    zero between two positions.
    """
    if type(load).from_cycle is not Load.from_cycle:
        return type(load).traced is not Load.traced
    given = getattr(load, "magnitude", None)
    if isinstance(given, Expression):
        found = [output_named(n, mechanism) for n in given.names - {*mechanism.parameters, "t", "input"}]
        divides = any(not isinstance(each, Number) for each in denominators(given.tree))
        return None not in found and not (found and divides)
    return True


def outputs_of(load: Load, mechanism: Mechanism) -> tuple[Output, ...]:
    """The outputs whose values the magnitude of a load takes."""
    given, table, phase = (getattr(load, name, None) for name in ("magnitude", "table", "phase"))
    found: list[Output] = []
    if isinstance(given, Expression):
        named = [output_named(n, mechanism) for n in given.names - {*mechanism.parameters, "t", "input"}]
        found += [each for each in named if each is not None]
    if isinstance(table, Table) and isinstance(table.over, Output):
        found.append(table.over)
    if isinstance(phase, SwingPhase) and phase.part is not None:
        found.append(phase.output)
    return tuple(dict.fromkeys(found))


def angles_of(load: Load, mechanism: Mechanism) -> dict[tuple[str, str], float | None]:
    """The links a, b of which it takes the angle of b against a, with the angle (rad) near which that begins; None:
    as the motion has it."""
    found: dict[tuple[str, str], float | None] = {}
    for output in outputs_of(load, mechanism):
        if output.kind == "angle":
            found["frame", output.owner] = None
    return found | ({} if load.twist is None else {load.twist[0]: load.twist[1]})


def followed_by(load: Load, mechanism: Mechanism) -> tuple[Output, ...]:
    """The same, and the output by which its phase goes."""
    phase = getattr(load, "phase", None)
    own = (phase.output,) if isinstance(phase, MovingPhase | SwingPhase) else ()
    return (*own, *outputs_of(load, mechanism))


def constants(load: Load) -> dict[str, float]:
    """Numbers of a load that are no dimensions, by the names that ``Course.constant`` takes."""
    found: dict[str, float] = {}
    table, phase = getattr(load, "table", None), getattr(load, "phase", None)
    if isinstance(table, Table):
        found |= {"first": table.x[0], "last": table.x[-1]}
    if isinstance(phase, SwingPhase) and phase.part is not None:
        found |= {f"part.{k}": amount.value for k, amount in enumerate(phase.part.amounts)}
    return found


def magnitude(load: Load, course: Course) -> Scalar:
    """The magnitude of a load; zero outside its phase, NaN where a table or a part of a stroke is too short."""
    own = load.traced(course)
    if own is not None:
        return own
    acts, share, exists = _phase(load, course)
    given, table = getattr(load, "magnitude", None), getattr(load, "table", None)
    if getattr(load, "ramp", None) is not None:
        first, last = course.dimension("ramp.0"), course.dimension("ramp.1")
        size: Scalar = first + (last - first) * share
    elif isinstance(given, Expression):
        size = traced(given, course.named)
    elif isinstance(table, Table):
        size = _interpolated(table, course)
    else:
        size = 1.0 if given is None else course.dimension("magnitude")
    return select(exists, select(acts, size, 0.0), float("nan"))


def _interpolated(table: Table, course: Course) -> Scalar:
    over = table.over
    x = course.output(over) if isinstance(over, Output) else course.named("t" if over == "time" else "input")
    first, last = course.constant("first"), course.constant("last")
    span = last - first
    if (over.dimension if isinstance(over, Output) else table.across) == "angle" and over != "time":
        turns = floor(span / TURN + 0.5)
        whole = TURN * maximum(1.0, turns)
        gone = x - first - whole * floor((x - first) / whole)
        moved = first + select(gone > whole - NEAR, gone - whole, gone)
        x = select(span > TURN, select(absolute(span - whole) > NEAR, x, moved), moved)
    slack = NEAR * span
    found = select(x >= first - slack, course.lookup(x), float("nan"))
    return select(x <= last + slack, found, float("nan"))


def _phase(load: Load, course: Course) -> tuple[Mask, Scalar, Mask]:
    """Whether the load acts, the share of its phase that is passed, and whether there is such a phase."""
    known = course.known_phase()
    if known is not None:
        return (*known, True)
    phase = getattr(load, "phase", None)
    match phase:
        case InputPhase():
            return (*_between(course), True)
        case MovingPhase():
            ends = ("min", "max") if phase.direction == "increasing" else ("max", "min")
            gone, length = _way(course, phase.output, *ends)
            way = turned(gone)
            inside = _both(way > NEAR * TURN, way < length - NEAR * TURN)
            return inside, way / length, True
        case SwingPhase():
            gone, length = _way(course, phase.output, phase.start, phase.end)
            acts, share = _within(gone, length)
            return (acts, share, True) if phase.part is None else _in_part(phase, acts, course)
    return True, 0.0, True


def _way(course: Course, output: Output, start: str, end: str) -> tuple[Scalar, Scalar]:
    """Way of the input since one limit of an output, and from there to the other one, rad."""
    sense = sign(course.speed)
    begin, until = course.limit(output, start), course.limit(output, end)
    return sense * (course.input - begin), turned(sense * (until - begin))


def part_ends(phase: SwingPhase, course: Course) -> tuple[Scalar, Scalar, Scalar]:
    """Of a part of a stroke: where it begins and ends, as ways from the beginning, and the whole stroke with its
    sign."""
    part = phase.part
    assert part is not None
    stroke = course.limit_value(phase.output, phase.end) - course.limit_value(phase.output, phase.start)
    size = absolute(stroke)
    ways = [
        course.constant(f"part.{k}") * (size if amount.share else 1.0)
        for k, amount in enumerate(part.amounts)
    ]
    if part.word == "first":
        return 0.0, ways[0], stroke
    if part.word == "last":
        return size - ways[0], size, stroke
    return ways[0], size - ways[-1], stroke


def _in_part(phase: SwingPhase, acts: Mask, course: Course) -> tuple[Mask, Scalar, Mask]:
    """Where the output itself is in a part of its stroke; there is none where the stroke is too short for it."""
    begin, end, stroke = part_ends(phase, course)
    size = absolute(stroke)
    slack = NEAR * size
    gone = (course.output(phase.output) - course.limit_value(phase.output, phase.start)) * sign(stroke)
    fits = _both(_both(begin >= -slack, end <= size + slack), begin < end)
    inside = _both(_both(acts, gone >= begin - slack), gone <= end + slack)
    return inside, (gone - begin) / (end - begin), fits


def _both(a: Mask, b: Mask) -> Mask:
    if isinstance(a, Value) and isinstance(b, Value):
        return a & b
    return (b if a else False) if isinstance(a, bool) else (a if b else False)


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
