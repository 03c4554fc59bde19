"""Limit positions: where an output of a motion reverses, to machine precision in the input."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from math import pi
from typing import NamedTuple

import numpy as np

from linkwright.applied_loads.signals import Limit, LimitKind
from linkwright.core.arguments import require
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.outputs import Output, kind_of, row_name
from linkwright.core.search import first_largest
from linkwright.errors import RequestError
from linkwright.events.course import Course, Span, Stretches
from linkwright.events.events import events
from linkwright.events.formula import ROW, Known
from linkwright.events.solved_again import SolvedAgain, kink_rows, of_bounded_rate, of_kinks, of_rate, solved_at
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.between_positions import Between, Reach
from linkwright.kinematics.motion import TURN, Motion
from linkwright.kinematics.names import place_meant, program_names
from linkwright.words import _

#: An output whose largest rate is below this share of the mechanism's does not move.
CONSTANT = 1e-10
#: Below this quality of a group rounding hides where a rate is zero: the limit is put on the change point.
BLURRED = 1e-10
#: A rate of this share of the largest one is not zero, but changes its sign through infinity.
POLE = 1e-3
#: Where a group cannot be computed at its change point, the mean at this share of the cycle on both sides is taken.
NEAR_SHARE = 3e-7
#: A way back of less than this share of the travel is what the digits of a table leave open, not a reversal.
MINIMUM_TRAVEL = 1e-7
#: Share of a stretch that is reached by which its ends are left out.
SHORTER = 1e-10
#: Positions this near to a limit, as share of the cycle, are at it.
ROUNDING = 1e-12
ONE = {ROW: np.zeros(1)}
NO_NUMBERS = Known({})


@dataclass(frozen=True)
class LimitPosition(Limit):
    """A reversal of an output.

    ``input``: the first driver's coordinate (rad or m); ``time`` s; ``value`` of the output (rad or m); ``kind``
    ``max`` or ``min`` (a reversal from growing to falling as time goes on, or the other way); ``index``: the
    last position of the motion before it, or at it.
    """

    index: int


def limit_positions(motion: Motion, output: Output | str) -> tuple[LimitPosition, ...]:
    """All positions within a motion where an output's rate is zero and changes its sign, in order of the motion.

    Exact to rounding in the input, independent of the steps. In a closed cycle the way from the last position to the
    first counts as well; the ends of an open one are no limits, nor is a rate that touches zero without changing its
    sign. Of a rest between opposite motions it is the middle. A way there and back of less than a ten millionth of
    the output's travel (a rest from a table of numbers with few digits) counts as none.

    Args:
        motion: positions along the drivers' laws, such as a cycle.
        output: an output, or its text: ``jaw`` (angle of a link; displacement of a block on the frame),
            ``C.x``, ``jaw.D.y``, ``guide`` (displacement).

    Raises:
        LinkwrightError: there is no such output, or the positions do not follow the drivers' laws in time.
    """
    require(motion, Motion)
    found = output if isinstance(output, Output) else place_meant(motion.mechanism, str(output))
    if motion.steps < 3 or not motion.mechanism.drivers:
        return ()
    return motion.cached(("limits", found), lambda: _limits(motion, found))


def _limits(motion: Motion, output: Output) -> tuple[LimitPosition, ...]:
    """Of positions in no order the limits by increasing time."""
    limits, order = _Reversals(motion.in_order(), output).limits(), motion.order
    if order is None:
        return limits
    return tuple(replace(each, index=int(order[each.index])) for each in limits)


def bend_times(motion: Motion) -> Floats:
    """Times of a motion, s, at which it passes change points, or a joint goes over to another formula."""
    return np.concatenate([cuts for _unused, cuts in _Way(motion).cut])


def limits_of(motion: Motion, output: str | None = None) -> tuple[LimitPosition, ...]:
    """The reversals of an output with its largest and its smallest value, exact in the input.

    ``output``: a link, a guide or a point's coordinate; by default the last link or block on the frame, in
    solving order, that goes to and fro. Raises LinkwrightError where nothing turns back.
    """
    name = output or _last_to_and_fro(motion)
    found = limit_positions(motion, name)
    if not found:
        raise RequestError(
            _(
                '"{name}" does not turn back in this motion, so it has no limit positions',
                code="picture.no_limit_positions",
                name=name,
            )
        )
    values = np.array([each.value for each in found])
    high, low = found[first_largest(values)], found[first_largest(-values)]
    return (high,) if high is low else (high, low)


def _last_to_and_fro(motion: Motion) -> str:
    joints = motion.mechanism.joints
    driven = {driver.joint for driver in motion.mechanism.drivers.values()}
    for group in reversed(motion.structure.groups):
        for link in reversed(group.links):
            for name, joint in joints.items():
                if name in driven or not {"frame", link} <= set(joint.joined):
                    continue
                if joint.coordinate == "slide":
                    return name
                angle = motion.link(link).angle
                if np.nanmax(angle) - np.nanmin(angle) < 1.9 * pi:
                    return link
    raise RequestError(
        _(
            'no link of "{name}" on the frame goes to and fro, so there are no limit positions; '
            "name a link or a guide, such as limits:coupler",
            code="picture.none_to_and_fro",
            name=motion.mechanism.name,
        )
    )


class _Way:
    """A motion on the stretches that are reached, cut where it goes over from one formula to another."""

    def __init__(self, motion: Motion) -> None:
        self.motion, self.between = motion, Between(motion)
        self.reach = Reach(motion, self.between)
        self.complete = motion.complete or self.reach.complete
        course = Course.of(motion.mechanism, motion.positions)
        if course.closed and not self.between.closes:
            last = float(motion.time[-1]) - course.begin
            course = replace(course, duration=last, closed=False, turns=0)
        self.course = course

    @property
    def parts(self) -> list[Stretches]:
        """The cycle, or every stretch that is reached, with these cuts."""
        return [Stretches(one_span(course), [], cuts) for course, cuts in self.cut]

    @property
    def cut(self) -> list[tuple[Course, Floats]]:
        """The same as courses with the times, s, of their cuts."""
        found: list[tuple[Course, Floats]] = self.motion.cached(
            "cuts", lambda: [(each, self._cuts(each)) for each in self._courses()]
        )
        return found

    def _courses(self) -> list[Course]:
        if self.complete:
            return [self.course]
        found = []
        for begin, end in self.reach.stretches:
            less = SHORTER * (end - begin)
            if end > begin:
                found.append(Course(self.course.drivers, begin + less, end - begin - 2.0 * less, False, 0))
        return found

    def _cuts(self, course: Course) -> Floats:
        """Times, s, of change points, and at which joints go over to another formula."""
        found = [self.reach.changes]
        bending = [each.kinks for each in self.motion.mechanism.joints.values() if each.kinks is not None]
        for kinks in bending:
            rows, phase = kink_rows(kinks), self.motion.mechanism.dimension(kinks.phase)
            signals = SolvedAgain(self.between, self.reach, rows, of_kinks(kinks, phase), len(kinks.angles))
            for k, each in enumerate(events(signals, NO_NUMBERS, ONE, Stretches(one_span(course), []))):
                cosines, _unused = of_kinks(kinks, phase, cosines=True)(self.rows(rows, each.time))
                found.append(each.time[cosines[k] > 0.0])
        time = np.concatenate(found)
        return np.asarray(
            time[(time >= course.begin) & (time <= course.begin + (1.0 + course.origin) * course.duration)]
        )

    def rows(self, names: tuple[str, ...], time: Floats) -> Floats:
        """Rows of the program at some times, s."""
        return solved_at(self.between, self.reach, names, time)

    def in_cycle(self, time: Floats) -> Floats:
        """Times, s, in the cycle or way that is asked."""
        begin, period = self.course.begin, self.motion.positions.period
        if period is None:
            return time
        gone = (time - begin) % period
        return np.asarray(begin + np.where(gone >= period * (1.0 - 1e-15), 0.0, gone))


class _Found(NamedTuple):
    """Times, s, of reversals, whether the output grows from there on, and the rows that give its value."""

    time: Floats
    rising: Flags
    rows: Floats


def one_span(course: Course) -> Span:
    """That of one machine."""
    return Span(course, np.array([course.duration]), np.zeros(1))


class _Reversals:
    """The reversals of one output of a motion."""

    def __init__(self, motion: Motion, output: Output) -> None:
        self.motion, self.output = motion, output
        courses = motion.solver.programs.courses
        if output not in courses:
            courses[output] = program_names(motion.mechanism, output)
        self.value_names, self.rate_names = courses[output]
        self.counted = output.kind == "angle" and motion.link(output.owner).counted
        if self.counted:
            self.value_names = (row_name("turned_angle", output.owner),)
        self.way = _Way(motion)
        self.law = next(iter(motion.mechanism.drivers.values())).law

    @property
    def found(self) -> _Found:
        """In no order."""
        return self.motion.cached(("reversals", self.output), self._search)

    def _search(self) -> _Found:
        rate = np.abs(self.motion.rows.fetch(self.rate_names[:1], self.motion.evaluate)[0])
        largest = float(np.fmax.reduce(rate, initial=0.0))
        if largest <= CONSTANT * self._fastest():
            return _Found(np.empty(0), np.empty(0, dtype=np.bool_), np.empty((len(self.value_names), 0)))
        way = self.way
        made = of_rate if way.complete else of_bounded_rate(float(np.nanmedian(rate[rate > CONSTANT * largest])))
        rates = SolvedAgain(way.between, way.reach, self.rate_names, made)
        parts = [(each, events(rates, NO_NUMBERS, ONE, each)[0]) for each in way.parts]
        time = np.concatenate([np.empty(0), *(each.time for _unused, each in parts)])
        rising = np.concatenate([np.empty(0, dtype=np.bool_), *(each.rising for _unused, each in parts)])
        inside = np.concatenate([rising[:0], *(_inside(each.time, stretches) for stretches, each in parts)])
        tied = np.concatenate([rising[:0], *(each.edges[0] >= 0 for _unused, each in parts)])
        time, moved = self._on_changes(time)
        rows = way.rows((*self.rate_names[:1], *self.value_names), time)
        accepted = inside & (tied | moved | (np.abs(rows[0]) <= POLE * largest))
        return _Found(time[accepted], rising[accepted], rows[1:, accepted])

    def _on_changes(self, time: Floats) -> tuple[Floats, Flags]:
        """Times, s, of reversals (of those that rounding hides near change points the times of these), and which
        are."""
        way, time = self.way, self.way.in_cycle(time)
        if not len(way.reach.changes) or not len(time):
            return time, np.zeros(len(time), dtype=np.bool_)
        changes = way.in_cycle(way.reach.changes)
        blurred = way.between.quality(way.reach.before(time), time) < BLURRED
        return np.where(blurred, changes[np.abs(time[:, None] - changes).argmin(axis=1)], time), blurred

    def _fastest(self) -> float:
        """The largest rate in the mechanism, in the dimension of the output's."""
        rows, size = self.motion.rows, self.motion.mechanism.size
        turning, moving = (
            _largest(rows.values[each]) for each in _speeds.get(rows.index, None, lambda: _rows_of(rows.index))
        )
        speed = max(turning, moving / size)
        return speed if self.output.kind == "angle" else speed * size

    # positions --------------------------------------------------------------------------------------
    def limits(self) -> tuple[LimitPosition, ...]:
        """With values and the positions before, in the order of the motion."""
        time, rising, rows = self.found
        if not len(time):
            return ()
        known = self.motion.time[: self.motion.positions.count - self.motion.positions.repeated]
        direction = 1.0 if known[-1] >= known[0] else -1.0
        order = np.argsort(direction * time, kind="stable")
        time, rising, rows = time[order], rising[order], rows[:, order]
        near = ROUNDING * self.way.course.duration
        before = np.searchsorted(direction * known, direction * time + near, "right") - 1
        before = np.maximum(before, 0)
        value = self._values(rows, time, before)
        limits = [
            LimitPosition(self.law.at(at), at, is_, _kind(up), k)
            for at, is_, up, k in zip(time.tolist(), value, rising, before.tolist(), strict=True)
        ]
        return self._without_ripple(limits) if len(limits) > 2 else tuple(limits)

    def _values(self, rows: Floats, time: Floats, before: Indices) -> list[float]:
        """The output at some times, s, from both sides of such at which it cannot be computed."""
        found = self._output(rows, before)
        way = NEAR_SHARE * self.way.course.duration
        for k in np.flatnonzero(~np.isfinite(found)):
            around = self.way.rows(self.value_names, time[k] + np.array([-way, way]))
            found[k] = self._output(around, before[[k, k]]).mean()
        return found.tolist()  # type: ignore[no-any-return]

    def _output(self, rows: Floats, before: Indices) -> Floats:
        """The output from the rows that give its value, angles continuous from the positions ``before``."""
        if self.output.kind != "angle":
            return np.array(rows[0])
        if self.counted:
            return np.asarray(rows[0] - self.motion.link(self.output.owner).turns_before)
        angle = self.motion.link(self.output.owner).angle
        near: Floats = np.asarray(angle[before])
        raw = np.arctan2(rows[1], rows[0])
        if not np.isfinite(near).all():
            known = np.flatnonzero(np.isfinite(angle))
            near = angle[known[np.abs(np.subtract.outer(known, before)).argmin(axis=0)]]
        return np.asarray(raw + TURN * np.round((near - raw) / TURN))

    def _without_ripple(self, found: list[LimitPosition]) -> tuple[LimitPosition, ...]:
        """Without the pairs of reversals between which the output goes next to nowhere."""
        minimum_travel = MINIMUM_TRAVEL * float(np.ptp([each.value for each in found]))
        while len(found) > 2:
            ring = [*found, found[0]] if self.way.course.closed else found
            ways = [abs(b.value - a.value) for a, b in pairwise(ring)]
            if min(ways) >= minimum_travel:
                break
            k = ways.index(min(ways))
            del found[k], found[k % len(found)]
        return tuple(found)


def _inside(time: Floats, stretches: Stretches) -> Flags:
    """Which times, s, are not the ends of a way that does not close."""
    course = stretches.span.course
    way = time - course.begin
    near = ROUNDING * course.duration
    return np.asarray(((way > near) & (way < course.duration - near)) | course.closed)


def _kind(rising: bool) -> LimitKind:
    return "min" if rising else "max"


#: Numbers of the stored rows that are angular velocities, and velocities.
_speeds: Recent[Mapping[str, int], tuple[list[int], list[int]]] = Recent(64)


def _rows_of(index: Mapping[str, int]) -> tuple[list[int], list[int]]:
    turning, moving = (
        [k for name, k in index.items() if kind_of(name) == kind] for kind in ("angular_velocity", "velocity")
    )
    return turning, moving


def _largest(values: Floats) -> float:
    """The largest size among values, of which some may be NaN; zero for none."""
    return float(np.fmax.reduce(np.abs(values), axis=None, initial=0.0))
