"""The course of the input: its drivers' coordinates at any time, and its stretches between cuts, of many designs."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Protocol

import numpy as np

from linkwright.core.arrays import Floats, Indices, begins
from linkwright.core.inputs import driven, turned
from linkwright.drivers.base import Driver
from linkwright.errors import LinkwrightError
from linkwright.formula.trace import Scalar, Trace, cos, sin
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import Positions
from linkwright.mechanism.mechanism import Mechanism

#: A closed cycle of a driver that turns steadily is looked at from here on, as share of it, lest places of symmetric
#: machines fall on the ends of pieces.
BEGIN = 0.0038710
#: Share of the cycle by which it may differ from an integer number of turns.
FULL_TURN = 1e-9
#: Times among which the way of a law is measured.
LOOKS = 361
#: Share by which a dimension is changed to see whether times and inputs follow from it.
_NUDGE = 1e-3


@dataclass(frozen=True)
class Course:
    """From ``begin``, s, for a ``duration``, s; ``closed``: whether the first position follows the last.

    ``turns``: full turns of the only driver, at constant speed, that a closed cycle has; 0 for any other course,
    whose times no dimension moves.
    """

    drivers: tuple[Driver, ...]
    begin: float
    duration: float
    closed: bool
    turns: int
    seam: bool = False

    @classmethod
    def of(cls, mechanism: Mechanism, positions: Positions, *, seam: bool = False) -> Course:
        """That of positions along the drivers' laws; ``seam``: something goes by the time or by the turns of the
        input, which begin anew with every cycle."""
        times, drivers = positions.around, tuple(mechanism.drivers.values())
        begin, end = float(times.min()), float(times.max())
        law, turns = drivers[0].law, 0
        if positions.closed and len(drivers) == 1 and law.rotary and (speed := law.constant_speed):
            share = abs(speed) * (end - begin) / (2.0 * pi)
            turns = round(share) if abs(share - round(share)) <= FULL_TURN * share else 0
        return cls(drivers, begin, end - begin, positions.closed, turns, seam)

    @property
    def first(self) -> Driver:
        """The first driver."""
        return self.drivers[0]

    @property
    def key(self) -> Hashable:
        """What its formulas depend on, as long as its drivers are there."""
        names = tuple(driver.name for driver in self.drivers)
        if self.turns:
            return (*names, True)
        return (*names, *(id(driver.law) for driver in self.drivers), self.begin, self.duration)

    @property
    def origin(self) -> float:
        """Where it is looked at from, as share of the cycle after its beginning."""
        return BEGIN if self.turns and not self.seam else 0.0

    @cached_property
    def laps(self) -> float:
        """How many turns the driver makes that turns most, to and fro; at least one."""
        if self.turns:
            return float(self.turns)
        time, found = self.begin + self.duration * np.linspace(0.0, 1.0, LOOKS), 1.0
        for driver in self.drivers:
            if driver.law.rotary:
                found = max(found, float(np.abs(np.diff(driver.law.coordinate(time)[0])).sum()) / (2.0 * pi))
        return found

    @cached_property
    def breaks(self) -> Floats:
        """Times, s, within the course, both ends among them, at which a driver's law goes over to another formula;
        none of one that turns steadily."""
        if self.turns:
            return np.array([self.begin, self.begin + self.duration]) if self.seam else np.empty(0)
        end = self.begin + self.duration
        inner = [driver.law.breaks(self.begin, end) for driver in self.drivers]
        every = np.unique(np.concatenate([[self.begin, end], *inner]))
        every = every[(every >= self.begin) & (every <= end)]
        return np.asarray(every[np.append(True, np.diff(every) > 1e-12 * self.duration)])

    def inputs(self, t: Trace, time: Scalar, varied: frozenset[str]) -> dict[str, Scalar]:
        """The inputs of programs at a traced time; the first driver's coordinate is ``input``."""
        found: dict[str, Scalar] = {"time": time}
        for driver in self.drivers:
            if self.turns:
                start, speed = (
                    (t.position if name in varied else t.parameter)(name)
                    for name in (f"{driver.name}.start", f"{driver.name}.speed")
                )
                q = start + speed * time
                found |= turned(driver.name, q, cos, sin)
            else:
                q, rate, second = driver.law.traced(time, self.begin, self.begin + self.duration)
                found |= driven(driver.name, driver.law.rotary, (q, rate, second), cos, sin)
            found.setdefault("input", q)
        return found


def moves(mechanism: Mechanism, address: str, steps: int) -> bool:
    """Whether times or inputs of the cycle follow from a dimension."""
    value = mechanism.dimension(address)
    for factor in (1.0 + _NUDGE, 1.0 - _NUDGE):
        try:
            changed = mechanism.with_dimensions({address: factor * value if value else factor - 1.0})
            return over_cycle(changed, steps).key != over_cycle(mechanism, steps).key
        except LinkwrightError:
            continue
    return True


#: Nearer to each other, as share of the cycle, two cuts are one.
SAME = 1e-11
_NONE: Floats = np.empty(0)


@dataclass(frozen=True)
class Span:
    """The cycles of some designs: all begin at the ``begin``, s, of a course; ``period`` (designs,), s, and ``bar``,
    derivatives by the periods, gathered on the way back."""

    course: Course
    period: Floats
    bar: Floats

    @property
    def count(self) -> int:
        """Number of designs."""
        return len(self.period)

    @property
    def begin(self) -> float:
        """Where all of them begin, s."""
        return self.course.begin

    def order(self, design: Indices, time: Floats) -> Floats:
        """Numbers that grow with the design, and in it with the time since the start of its cycle."""
        share = (time - self.begin) / self.period[design] - self.course.origin
        return np.asarray(2.0 * design + (share - np.floor(share) if self.course.closed else share))

    def within(self, design: Indices, time: Floats) -> Floats:
        """The same times in the cycle that starts there."""
        if not self.course.closed:
            return time
        share = (time - self.begin) / self.period[design] - self.course.origin
        return np.asarray(time - np.floor(share) * self.period[design])


class Cuts(Protocol):
    """Times at which cycles are cut, (k,) by design, with what is wanted differentiated by them."""

    design: Indices
    time: Floats
    bar: Floats


class Stretches:
    """``design``, ``begin`` and ``length``, s, of all stretches, by design and time, around cycles that close.

    ``more``: times, s, at which all are cut; ``edge`` and ``after``: numbers of the cuts at both ends among those of
    all ``families``; -1 where no family moves the end.
    """

    def __init__(self, span: Span, families: Sequence[Cuts], more: Floats = _NONE) -> None:
        self.span, self.families = span, tuple(families)
        course, every = span.course, np.arange(span.count)
        fixed = np.append(course.breaks[:-1] if course.closed else course.breaks, more)
        design = [each.design for each in families] + [np.repeat(every, len(fixed))]
        time = [each.time for each in families] + [np.tile(fixed, span.count)]
        moving = sum(len(each.time) for each in families)
        owner, at = np.concatenate(design), np.concatenate(time)
        number = np.where(np.arange(len(owner)) < moving, np.arange(len(owner)), -1)
        without = every[np.bincount(owner, minlength=span.count) == 0]
        owner = np.concatenate([owner, without])
        at = np.concatenate([at, span.begin + course.origin * span.period[without]])
        number = np.concatenate([number, np.full(len(without), -1)])
        at = span.within(owner, at)
        order = np.lexsort((number >= 0, at, owner))
        owner, at, number = owner[order], at[order], number[order]
        if len(owner) > span.count:
            distinct = np.ones(len(owner), dtype=np.bool_)
            distinct[1:] = (owner[1:] != owner[:-1]) | (at[1:] - at[:-1] > SAME * span.period[owner[1:]])
            owner, at, number = owner[distinct], at[distinct], number[distinct]
        begin = begins(owner)
        last = np.append(begin[1:], len(owner)) - 1
        after = np.arange(1, len(owner) + 1)
        after[last] = begin
        lap = np.where(after <= np.arange(len(owner)), span.period[owner], 0.0)
        self.design, self.begin, self.length = owner, at, at[after] + lap - at
        self.edge, self.after, self.lap = number, number[after], lap > 0.0
        if not course.closed:
            inner = np.ones(len(owner), dtype=np.bool_)
            inner[last] = False
            for name in ("design", "begin", "length", "edge", "after", "lap"):
                setattr(self, name, getattr(self, name)[inner])

    def first_pieces(self, each: float) -> tuple[Indices, Floats, Floats]:
        """Stretch and shares of pieces of equal length in their stretches, ``each`` of a lap of the input."""
        design = self.design
        share = self.length / self.span.period[design]
        count = np.maximum(1, np.ceil(each * self.span.course.laps * share - 1e-9)).astype(np.intp)
        stretch = np.repeat(np.arange(len(design)), count)
        k = np.arange(len(stretch)) - np.repeat(np.cumsum(count) - count, count)
        return stretch, k / count[stretch], (k + 1) / count[stretch]

    def ends(self, stretch: Indices, first: Floats, last: Floats) -> tuple[Floats, Floats]:
        """Times, s, of pieces between two shares of their stretches."""
        begin, length = self.begin[stretch], self.length[stretch]
        return begin + first * length, begin + last * length

    def move(self, stretch: Indices, first: Floats, last: Floats, low: Floats, high: Floats) -> None:
        """From derivatives by the ends of pieces, ``low`` and ``high``, those by the cuts and by the periods."""
        by_edge, by_after = low * (1.0 - first) + high * (1.0 - last), low * first + high * last
        edge, after, origin = self.edge[stretch], self.after[stretch], self.span.course.origin
        self.move_edges(edge, by_edge)
        self.move_edges(after, by_after)
        laps = np.where(edge < 0, origin * by_edge, 0.0)
        laps += (np.where(after < 0, origin, 0.0) + self.lap[stretch]) * by_after
        np.add.at(self.span.bar, self.design[stretch], laps)

    def move_edges(self, edge: Indices, bars: Floats) -> None:
        """Adds derivatives by cuts of some numbers."""
        flat = np.zeros(sum(len(each.time) for each in self.families) + 1)
        np.add.at(flat, edge, bars)
        place = 0
        for each in self.families:
            each.bar += flat[place : place + len(each.time)]
            place += len(each.time)


@dataclass
class AtInput:
    """When the input has a ``value`` (designs,), rad, and comes back to it after so many turns, ``every``: (k,) by
    design.

    ``address``: of the dimension that the value is; ``bar``: derivatives by the times.
    """

    span: Span
    value: Floats
    every: int
    address: str
    speed: Floats
    start: Floats

    def __post_init__(self) -> None:
        course, period = self.span.course, self.span.period
        laps = course.turns // self.every if course.turns % self.every == 0 else 1
        turn = 2.0 * pi * self.every / np.abs(self.speed)
        first = (self.value - self.start) / self.speed
        first = first - np.floor((first - course.begin) / turn) * turn
        time = first[:, None] + turn[:, None] * np.arange(laps)
        self.design: Indices = np.repeat(np.arange(len(period)), laps)
        at = self.span.within(self.design, time.ravel())
        order = np.lexsort((at, self.design))
        self.time: Floats = at[order]
        self.bar: Floats = np.zeros(len(at))

    def pull(self, driver: str) -> tuple[Indices, Mapping[str, Floats]]:
        """Derivatives by the dimensions of the designs that are the driver's and the value."""
        by_value = self.bar / self.speed[self.design]
        found = {f"{driver}.start": -by_value, f"{driver}.speed": -by_value * self.time}
        return self.design, {**found, self.address: by_value}
