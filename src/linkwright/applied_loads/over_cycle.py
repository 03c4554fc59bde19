"""Magnitudes of loads over arrays of positions, and when loads act; each place without a value found and named."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.phases import Always
from linkwright.applied_loads.signals import BetweenLimits, Signals, column, named_column
from linkwright.applied_loads.sizes import OverCycle
from linkwright.applied_loads.strokes import EQUAL_VALUES, TURN, Stretch, strokes
from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import Output
from linkwright.errors import LinkwrightError, with_remedy
from linkwright.formula.late_import import numpy as np
from linkwright.words import _


@dataclass(frozen=True)
class Activity:
    """``where`` (n,) a load acts; ``share`` (n,) of its phase that is passed, 0 to 1."""

    where: Flags
    share: Floats


def evaluate(load: Load, signals: Signals) -> Floats:
    """:func:`magnitudes`, with errors that name the load."""
    try:
        return magnitudes(load, signals)
    except LinkwrightError as error:
        raise LinkwrightError(_("loads.{name}: {cause}", name=load.name, cause=error)) from None


def magnitudes(load: Load, signals: Signals) -> Floats:
    """Magnitude of a load at every position, (n,), in SI; zero outside its phase.

    A load with a phase but without any size (a force by its components) gives 1 within the phase.

    Raises:
        LinkwrightError: an expression that has no finite value, a table that does not cover the positions, or
            a phase whose limit positions do not exist.
    """
    magnitude = load.magnitude
    if isinstance(magnitude.size, OverCycle):
        return magnitude.size.values(signals)
    if magnitude.size.ramp and isinstance(magnitude.phase, Always):
        raise LinkwrightError(
            with_remedy(
                _("a ramp needs a phase, and there is none", code="loads.ramp_without_phase"),
                _("add phase: {{input: [from, to]}} or another"),
            )
        )
    course = CycleCourse(load, signals)
    active, count = course.activity(), len(signals.time)
    where = active.where & signals.ok
    share: Any = active.share
    with np.errstate(all="ignore"):
        try:
            found = column(magnitude.size.at(course, share), count)
        except ZeroDivisionError:
            found = np.full(count, np.nan)
    if fault := magnitude.size.fault(signals, course, where, found):
        raise LinkwrightError(fault)
    return np.where(where, found, 0.0)


def activity(load: Load, signals: Signals) -> Activity:
    """When a load acts, and the share of its phase where that is one of a ramp.

    Raises LinkwrightError where the phase does not exist in the cycle.
    """
    return CycleCourse(load, signals).activity()


def switch_times(load: Load, signals: Signals) -> tuple[Floats, bool]:
    """Times, s, at which a load begins or ends to act or its size bends, and whether these are all of them.

    Known beforehand: limit positions, and inputs of one driver of constant speed. Times may lie an integer number of
    cycles away.
    """
    ends, complete = load.magnitude.phase.ends(signals)
    return np.append(ends, load.magnitude.size.kinks(signals)), complete


class CycleCourse:
    """What the magnitude of a load sees, as arrays (n,) over the positions of signals; see
    :class:`linkwright.applied_loads.signals.Course`."""

    def __init__(self, load: Load, signals: Signals) -> None:
        self.magnitude, self.signals = load.magnitude, signals
        self._address, self._dimensions = f"loads.{load.name}.", load.dimensions()
        self._constants = self.magnitude.constants
        self._ends: dict[str, Floats] = {}

    def activity(self) -> Activity:
        """When the load acts."""
        phase, count = self.magnitude.phase, len(self.signals.time)
        with np.errstate(all="ignore"):
            passed: tuple[Any, Any, Any] = phase.passed(self, self.magnitude.size.ramp)
        acts, share, exists = passed
        if fault := phase.fault(self.signals, self, exists):
            raise LinkwrightError(fault)
        return Activity(np.broadcast_to(acts, (count,)), column(share, count))

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
        return self._dimensions[self._address + field]

    def constant(self, field: str) -> float:
        return self._constants[field]

    def output(self, output: Output) -> Any:
        return self.signals.output(output)[0]

    def angle_between(self, a: str, b: str, near: float) -> Any:
        return self.signals.angle_between(a, b, near=near)

    def lookup(self, x: Any) -> Any:
        curve: Any = self.magnitude.size.curve
        return curve(x)

    def limit_value(self, output: Output, kind: str) -> Any:
        return self._ends[kind]

    def moving(self, phase: BetweenLimits, ramp: bool) -> tuple[Any, Any]:
        rate = self.signals.output(phase.output)[1]
        where = rate > 0 if phase.end == "max" else rate < 0
        if not ramp:
            return where, 0.0
        between, share = self.stroke(phase, ramp)
        return where & between, share

    def stroke(self, phase: BetweenLimits, ramp: bool) -> tuple[Any, Any]:
        count = len(self.signals.time)
        where, share = np.zeros(count, dtype=bool), np.zeros(count)
        for each in strokes(phase, self.signals):
            if ramp and abs(each.rise) < EQUAL_VALUES * (1.0 + abs(each.end.input)):
                raise LinkwrightError(
                    _(
                        "the input is the same at both limit positions of '{output}', so a ramp over the "
                        "input has no length; give a table over {output} instead",
                        code="loads.ramp_without_length",
                        output=phase.output,
                    )
                )
            inside, passed = each.place(self.signals)
            where, share = where | inside, np.where(inside, passed, share)
            if phase.in_part:
                self._store_limits(each, inside, phase.output)
        return where, share

    def _store_limits(self, stretch: Stretch, inside: Flags, output: Output) -> None:
        """Stores the output at the limits of the stroke in which positions lie, with the turns of an angle."""
        first, last = stretch.begin.value, stretch.end.value
        turns: Any = 0.0
        if output.kind == "angle" and abs(last - first) < TURN:
            turns = np.round((self.output(output) - 0.5 * (first + last)) / TURN)
        for each in (stretch.begin, stretch.end):
            known = self._ends.get(each.kind, each.value)
            self._ends[each.kind] = np.where(inside, each.value + TURN * turns, known)
