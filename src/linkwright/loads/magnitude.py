"""How large a load is: a number, an expression, a ramp or a table, within its phase; every formula once.

The same lines serve traced values (:class:`linkwright.kinetostatics.load_site.TracedSite`), where what is found of
the cycle before enters as numbers, and arrays of positions (:class:`linkwright.loads.over_cycle.CycleCourse`).
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

from linkwright.core.expression_tree import Number
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.engine.table import Table as Curve
from linkwright.engine.trace import Mask, Scalar, absolute, floor, maximum, minimum, select, sign
from linkwright.fields.signals import InputPhase, MovingPhase, SwingPhase, Table
from linkwright.loads.base import Load
from linkwright.loads.formulas import denominators, output_named
from linkwright.loads.phases import NEAR, TURN

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism


class Course(Protocol):
    """What such a magnitude sees of the mechanism."""

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

    def known_phase(self) -> tuple[Mask, Scalar] | None:
        """Whether the load acts and the share of its phase that is passed, where these are known per position."""
        ...

    def stroke(self, phase: MovingPhase | SwingPhase) -> tuple[Mask, Scalar]:
        """Whether an output goes from one limit to the other, ends included, and the share of the input's way there
        that is passed."""
        ...

    def moving(self, phase: MovingPhase) -> tuple[Mask, Scalar]:
        """The same without the ends, where the output is at rest."""
        ...

    def limit_value(self, output: Output, kind: str) -> Scalar:
        """The output at the limit of a kind that belongs to this stroke."""
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


class Turning(Course, Protocol):
    """The same of a cycle over which an output has one limit of each kind: by the input, rad, of a driver that turns
    at constant speed, else by the time, s."""

    @property
    def along(self) -> Scalar:
        """The input, or the time."""
        ...

    @property
    def sense(self) -> Scalar:
        """1 where that grows, -1 where it falls."""
        ...

    @property
    def lap(self) -> Scalar:
        """How far that goes in the cycle; twice as far where it does not close."""
        ...

    def limit(self, output: Output, kind: str) -> Scalar:
        """Where along it has it."""
        ...

    def share_of_input(self, phase: MovingPhase | SwingPhase, share: Scalar) -> Scalar:
        """The share of the input's way between limits that is passed, from that along."""
        ...


def followed(load: Load, mechanism: Mechanism) -> bool:
    """Whether the magnitude of a load can be traced.

    Not where a kind finds it in a way of its own, where an expression divides by an output, which may go through
    zero between two positions, and where an interval of the input is longer than a turn.
    """
    interval = interval_of_turn(load)
    long = interval is not None and abs(interval.end - interval.start) > TURN + NEAR
    if long or not has_formula(load):
        return False
    given = getattr(load, "magnitude", None)
    if isinstance(given, Expression):
        found = [output_named(n, mechanism) for n in given.names - {*mechanism.parameters, "t", "input"}]
        return None not in found and not (found and divides(load))
    return True


def interval_of_turn(load: Load) -> InputPhase | None:
    """The interval of the input's turn in which a load acts, which no design may have longer than the turn."""
    phase = getattr(load, "phase", None)
    return phase if isinstance(phase, InputPhase) and phase.across == "angle" else None


def divides(load: Load) -> bool:
    """Whether the expression of a load divides by what is no number."""
    given = getattr(load, "magnitude", None)
    divisors = denominators(given.tree) if isinstance(given, Expression) else ()
    return any(not isinstance(each, Number) for each in divisors)


def by_rate(load: Load) -> Output | None:
    """The output by the sign of whose rate alone a load acts; None for those that go by something else."""
    phase = getattr(load, "phase", None)
    if isinstance(phase, MovingPhase) and getattr(load, "ramp", None) is None:
        return phase.output
    return None


def by_limits(load: Load) -> bool:
    """Whether a load acts between limits of an output."""
    phase = getattr(load, "phase", None)
    return isinstance(phase, MovingPhase | SwingPhase) and by_rate(load) is None


def through_end(load: Load) -> bool:
    """Whether the interval of the input in which a load acts goes through the end of a turn."""
    interval = interval_of_turn(load)
    return interval is not None and interval.end < interval.start


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


def has_formula(load: Load) -> bool:
    """Whether the magnitude of a load has a formula, of its own or as one of those here."""
    return type(load).from_cycle is Load.from_cycle or type(load).traced is not Load.traced


def is_constant(load: Load) -> bool:
    """Whether the magnitude of a load is one number at all positions."""
    if not has_formula(load) or type(load).traced is not Load.traced:
        return False
    return getattr(load, "phase", None) is None and isinstance(getattr(load, "magnitude", None), float)


def magnitude(load: Load, course: Course) -> Scalar:
    """The magnitude of a load; zero outside its phase, NaN where a table or a part of a stroke is too short."""
    own = load.traced(course)
    if own is not None:
        return own
    acts, share, exists = phase_passed(load, course)
    return select(exists, select(acts, within_phase(load, course, share), 0.0), float("nan"))


def within_phase(load: Load, course: Course, share: Scalar) -> Scalar:
    """The magnitude where the load acts, with a share of its phase passed; NaN beyond a table."""
    given, table = getattr(load, "magnitude", None), getattr(load, "table", None)
    if getattr(load, "ramp", None) is not None:
        first, last = course.dimension("ramp.0"), course.dimension("ramp.1")
        return first + (last - first) * share
    if isinstance(given, Expression):
        found: Scalar = given.over({name: course.named(name) for name in given.names})
        return found
    if isinstance(table, Table):
        x, missing = place_in(table, course)
        return select(missing, float("nan"), course.lookup(x))
    return 1.0 if given is None else course.dimension("magnitude")


@lru_cache(256)
def curve_of(table: Table) -> Curve:
    """The curve through a load's table."""
    if table.interpolation == "linear":
        return Curve.linear(table.x, table.y)
    return Curve.spline(table.x, table.y, periodic=table.interpolation == "periodic")


def place_in(table: Table, course: Course) -> tuple[Scalar, Mask]:
    """Where a table is looked up, and whether it does not reach there.

    Angles count modulo one turn; a table over several whole turns repeats after them.
    """
    over = table.over
    x = course.output(over) if isinstance(over, Output) else course.named("t" if over == "time" else "input")
    first, last = course.constant("first"), course.constant("last")
    span = last - first
    if (over.dimension if isinstance(over, Output) else table.across) == "angle" and over != "time":
        whole = TURN * maximum(1.0, floor(span / TURN + 0.5))
        gone = x - first - whole * floor((x - first) / whole)
        moved = first + select(gone > whole - NEAR, gone - whole, gone)
        x = select(span > TURN, select(absolute(span - whole) > NEAR, x, moved), moved)
    slack = NEAR * span
    return x, (x < first - slack) | (x > last + slack)


def phase_passed(load: Load, course: Course) -> tuple[Mask, Scalar, Mask]:
    """Whether the load acts, the share of its phase that is passed, and whether there is such a phase."""
    known = course.known_phase()
    if known is not None:
        return (*known, True)
    phase = getattr(load, "phase", None)
    match phase:
        case InputPhase():
            return _between(course)
        case MovingPhase():
            return (*course.moving(phase), True)
        case SwingPhase():
            acts, share = course.stroke(phase)
            return (acts, share, True) if phase.part is None else _in_part(phase, acts, course)
    return True, 0.0, True


def stroke_of_turn(course: Turning, phase: MovingPhase | SwingPhase) -> tuple[Mask, Scalar]:
    """``Course.stroke`` by the limits of a lap."""
    acts, share = _within(*_way(course, phase), course.lap)
    return acts, course.share_of_input(phase, share)


def moving_of_turn(course: Turning, phase: MovingPhase) -> tuple[Mask, Scalar]:
    """``Course.moving`` by the limits of a lap."""
    gone, length = _way(course, phase)
    way, near = turned(gone, course.lap), NEAR * course.lap
    return (way > near) & (way < length - near), course.share_of_input(phase, way / length)


def _way(course: Turning, phase: MovingPhase | SwingPhase) -> tuple[Scalar, Scalar]:
    """Way since one limit of an output, and from there to the other one."""
    sense = course.sense
    begin, until = (course.limit(phase.output, kind) for kind in (phase.start, phase.end))
    return sense * (course.along - begin), turned(sense * (until - begin), course.lap)


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
    slack = NEAR * absolute(stroke)
    gone = (course.output(phase.output) - course.limit_value(phase.output, phase.start)) * sign(stroke)
    fits = (begin >= -slack) & (end <= absolute(stroke) + slack) & (begin < end)
    inside = acts & (gone >= begin - slack) & (gone <= end + slack)
    return inside, share_of((gone - begin) / (end - begin)), fits


def _between(course: Course) -> tuple[Mask, Scalar, Mask]:
    """A closed interval of the input; of angles modulo one turn, from the larger to the smaller end through the
    end of the turn where the input grows. There is none longer than a turn."""
    start, end = course.dimension("phase.input.0"), course.dimension("phase.input.1")
    gap = end - start
    if not course.rotary:
        inside = (course.input >= minimum(start, end) - NEAR) & (course.input <= maximum(start, end) + NEAR)
        return inside, share_of((course.input - start) / gap), True
    through = turned(gap)
    through = select(through <= 0.0, TURN, through)
    length = select(gap < 0.0, select(course.heading > 0.0, through, gap), gap)
    acts, share = _within(course.input - minimum(start, start + length), absolute(length))
    return acts, select(length > 0.0, share, 1.0 - share), absolute(gap) <= TURN + NEAR


def _within(gone: Scalar, length: Scalar, lap: Scalar = TURN) -> tuple[Mask, Scalar]:
    """Whether what is gone of a lap lies within a length, and its share; the ends belong to it."""
    way, near = turned(gone, lap), NEAR * lap
    passed = select(way > lap - near, way - lap, way)
    return passed <= length + near, share_of(passed / length)


def share_of(ratio: Scalar) -> Scalar:
    """A ratio, from 0 to 1."""
    return minimum(maximum(ratio, 0.0), 1.0)


def turned(angle: Scalar, lap: Scalar = TURN) -> Scalar:
    """An angle modulo one lap, of one turn unless given: from 0 to that, rad."""
    return angle - lap * floor(angle / lap)
