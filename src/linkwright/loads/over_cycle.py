"""Magnitudes of loads over arrays of positions, and when loads act; each place without a value found and named."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.expressions import Expression
from linkwright.core.outputs import Output
from linkwright.engine.late_import import numpy as np
from linkwright.errors import LinkwrightError, with_remedy
from linkwright.fields.signals import InputPhase, MovingPhase, SwingPhase, Table
from linkwright.loads.formulas import named_column, refuse_formula
from linkwright.loads.magnitude import constants, curve_of, part_ends, phase_passed, place_in, within_phase
from linkwright.loads.phases import NEAR, TURN, Stretch, place_on, strokes
from linkwright.loads.signals import Signals, column, input_dimension, shown
from linkwright.words.sentence import Sentence, together

if TYPE_CHECKING:
    from linkwright.loads.base import Load


@dataclass(frozen=True)
class Activity:
    """``where`` (n,) a load acts; ``share`` (n,) of its phase that is passed, 0 to 1."""

    where: Flags
    share: Floats


class CycleCourse:
    """What the magnitude of a load sees, as arrays (n,) over the positions of signals; see
    :class:`linkwright.loads.magnitude.Course`."""

    def __init__(self, load: Load, signals: Signals) -> None:
        self.load = load
        self.signals = signals
        self._dimensions = load.dimensions()
        self._constants = constants(load)
        self._ends: dict[str, Floats] = {}

    @property
    def input(self) -> Any:
        return self.signals.input

    @property
    def rotary(self) -> bool:
        return self.signals.rotary

    @property
    def heading(self) -> float:
        return float(self.signals.heading)

    def named(self, name: str) -> Any:
        return named_column(name, self.signals)

    def dimension(self, field: str) -> float:
        return self._dimensions[f"loads.{self.load.name}.{field}"]

    def constant(self, field: str) -> float:
        return self._constants[field]

    def known_phase(self) -> None:
        return None

    def output(self, output: Output) -> Any:
        return self.signals.output(output)[0]

    def angle_between(self, a: str, b: str) -> Any:
        assert self.load.twist is not None
        return self.signals.angle_between(a, b, near=self.load.twist[1])

    def lookup(self, x: Any) -> Any:
        return curve_of(self.load.table)(x)  # type: ignore[attr-defined]

    def limit_value(self, output: Output, kind: str) -> Any:
        return self._ends[kind]

    def moving(self, phase: MovingPhase) -> tuple[Any, Any]:
        rate = self.signals.output(phase.output)[1]
        where = rate > 0 if phase.direction == "increasing" else rate < 0
        if not self._ramp:
            return where, 0.0
        between, share = self.stroke(phase)
        return where & between, share

    def stroke(self, phase: MovingPhase | SwingPhase) -> tuple[Any, Any]:
        count = len(self.signals.time)
        where, share = np.zeros(count, dtype=bool), np.zeros(count)
        for each in strokes(phase, self.signals):
            rise = each.end[1] - each.begin[1]
            if self._ramp and abs(rise) < NEAR * (1.0 + abs(each.end[1])):
                raise LinkwrightError("loads.ramp_without_length", output=phase.output)
            inside, passed = place_on(each, self.signals)
            where, share = where | inside, np.where(inside, passed, share)
            if isinstance(phase, SwingPhase) and phase.part is not None:
                self._meet(each, inside, phase)
        return where, share

    @property
    def _ramp(self) -> bool:
        return getattr(self.load, "ramp", None) is not None

    def _meet(self, stretch: Stretch, inside: Flags, phase: SwingPhase) -> None:
        turns: Any = 0.0
        if phase.output.kind == "angle" and abs(stretch.values[1] - stretch.values[0]) < TURN:
            turns = np.round((self.output(phase.output) - 0.5 * sum(stretch.values)) / TURN)
        for kind, value in zip((phase.start, phase.end), stretch.values, strict=True):
            self._ends[kind] = np.where(inside, value + TURN * turns, self._ends.get(kind, value))


def evaluate(load: Load, signals: Signals) -> Floats:
    """:func:`magnitudes`, with errors that name the load."""
    try:
        return magnitudes(load, signals)
    except LinkwrightError as error:
        raise LinkwrightError("loads.of_load", name=load.name, cause=error) from None


def magnitudes(load: Load, signals: Signals) -> Floats:
    """Magnitude of a load at every position, (n,), in SI; zero outside its phase.

    A load with a phase but without any magnitude (a force by its components) gives 1 within the phase.

    Raises:
        LinkwrightError: an expression that has no finite value, a table that does not cover the positions, or
            a phase whose limit positions do not exist.
    """
    found = load.from_cycle(signals)
    return _evaluated(load, CycleCourse(load, signals)) if found is None else found


def activity(load: Load, signals: Signals) -> Activity:
    """When a load acts, and the share of its phase where that is one of a ramp.

    Raises LinkwrightError where the phase does not exist in the cycle.
    """
    return _activity(load, CycleCourse(load, signals))


def _activity(load: Load, course: CycleCourse) -> Activity:
    phase, count = getattr(load, "phase", None), len(course.signals.time)
    if isinstance(phase, InputPhase):
        _refuse_interval(phase, course.signals)
    with np.errstate(all="ignore"):
        passed: tuple[Any, Any, Any] = phase_passed(load, course)
    acts, share, exists = passed
    if isinstance(phase, SwingPhase) and not np.all(exists):
        raise LinkwrightError(_part_too_long(phase, course, int(np.argmin(exists))))
    return Activity(np.broadcast_to(acts, (count,)), column(share, count))


def _evaluated(load: Load, course: CycleCourse) -> Floats:
    own = load.traced(course)
    if own is not None:
        return column(own, len(course.signals.time))
    if getattr(load, "ramp", None) is not None and getattr(load, "phase", None) is None:
        raise LinkwrightError(with_remedy(Sentence("loads.ramp_without_phase"), Sentence("loads.add_phase")))
    active = _activity(load, course)
    where = active.where & course.signals.ok
    with np.errstate(all="ignore"):
        try:
            share: Any = active.share
            found = column(within_phase(load, course, share), len(where))
        except ZeroDivisionError:
            found = np.full(len(where), np.nan)
    given, table = getattr(load, "magnitude", None), getattr(load, "table", None)
    if isinstance(given, Expression):
        refuse_formula(given, course.signals, where, found)
    if isinstance(table, Table):
        _refuse_table(table, course, where)
    return np.where(where, found, 0.0)


def _refuse_interval(phase: InputPhase, signals: Signals) -> None:
    if not signals.rotary:
        return
    start, end, length = phase.start, phase.end, phase.end - phase.start
    if length < 0 and signals.heading == 0:
        key = "loads.phase_to_and_fro"
    elif length > TURN + NEAR or (length < -TURN - NEAR and signals.heading < 0):
        key = "loads.phase_too_long"
    else:
        return
    raise LinkwrightError(key, start=shown(start, "angle"), end=shown(end, "angle"))


def _part_too_long(phase: SwingPhase, course: CycleCourse, index: int) -> str:
    assert phase.part is not None
    ends: tuple[Any, Any, Any] = part_ends(phase, course)
    stroke = float(abs(ends[2][index]))
    dimension = phase.output.dimension
    return Sentence(
        "loads.part_too_long",
        part=Sentence(f"loads.part_{phase.part.word}"),
        amounts=" + ".join(shown(each.way(stroke), dimension) for each in phase.part.amounts),
        output=phase.output,
        stroke=shown(stroke, dimension),
    )


def _refuse_table(table: Table, course: CycleCourse, where: Flags) -> None:
    """Raises LinkwrightError with the range that is missing where a table does not cover the positions ``where``."""
    place: tuple[Any, Any] = place_in(table, course)
    short, first, last = place[0][where & place[1]], table.x[0], table.x[-1]
    if not len(short):
        return
    if isinstance(table.over, Output):
        dimension = table.over.dimension
    else:
        dimension = "time" if table.over == "time" else input_dimension(course.signals)
    ranges = []
    if (short < first).any():
        low = shown(float(short.min()), dimension)
        ranges.append(Sentence("loads.stretch", low=low, high=shown(first, dimension)))
    if (short > last).any():
        high = shown(float(short.max()), dimension)
        ranges.append(Sentence("loads.stretch", low=shown(last, dimension), high=high))
    raise LinkwrightError(
        "loads.table_too_short",
        over=table.over,
        first=shown(first, dimension),
        last=shown(last, dimension),
        ranges=together(ranges),
    )
