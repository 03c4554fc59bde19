"""Loads over the cycles of many designs: the events at which they begin and end, and what they do in a piece.

A load acts in a piece as it does in its middle, so that ends of phases need no slack. Formulas take of it the columns
``acts`` and, of a ramp, the place where its phase begins and how far it goes, along the time of an input that turns
steadily, else the input, or the output of which a phase is a part of the stroke.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.phases import SwingPhase
from linkwright.applied_loads.strokes import NEAR, TURN
from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.cycle.machine import length_name, since_name
from linkwright.events.course import Cuts, Span
from linkwright.events.events import AT, Designs, Limits, at_times
from linkwright.events.formula import Formula, Known
from linkwright.kinetostatics.load_site import acts_name

Columns = dict[str, Floats]


class Acting(ABC):
    """When one load acts; ``events``: where it begins and ends to; ``by_dimensions``: derivatives (designs,) by those
    that are its ends, gathered on the way back."""

    events: list[Cuts]

    def __init__(self, load: Load, span: Span) -> None:
        self.name, self.ramp, self.span = load.name, load.magnitude.size.ramp, span
        self.by_dimensions: dict[str, Floats] = {}

    @property
    @abstractmethod
    def missing(self) -> Flags:
        """Designs whose cycle has no such phase, (designs,)."""

    @abstractmethod
    def columns(self, design: Indices, middle: Floats) -> Columns:
        """What formulas take of pieces around some times, s."""

    @abstractmethod
    def pull(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        """From derivatives by these columns those by the events and limits that they follow from."""

    def _named(self, acts: Flags, since: Floats, length: Floats) -> Columns:
        found = {acts_name(self.name): acts.astype(np.float64)}
        if self.ramp:
            found |= {since_name(self.name): since, length_name(self.name): length}
        return found

    def _bars(self, acts: Flags, by_columns: Mapping[str, Floats]) -> tuple[Floats, Floats] | None:
        """Derivatives by the beginning and the length of the phase; None where none are."""
        since, length = by_columns.get(since_name(self.name)), by_columns.get(length_name(self.name))
        if since is None or length is None:
            return None
        return np.where(acts, since, 0.0), np.where(acts, length, 0.0)


class OnStrokes(Acting):
    """From events to other ones; ``by_time``: its share goes by the time; ``backwards``: it falls from 1 to 0 as
    time goes on; ``fits``: designs that can have such a phase."""

    def __init__(
        self, load: Load, strokes: Strokes, *, by_time: bool, backwards: bool = False, fits: Flags | None = None
    ) -> None:
        super().__init__(load, strokes.span)
        self.strokes, self.by_time, self.backwards, self._fits = strokes, by_time, backwards, fits
        self.events = [strokes.start, strokes.finish]

    @property
    def missing(self) -> Flags:
        found = np.bincount(self.strokes.design, minlength=self.span.count) == 0
        return np.asarray(found if self._fits is None else found | ~self._fits)

    def columns(self, design: Indices, middle: Floats) -> Columns:
        found, acts, since = self.strokes.at(design, middle)
        if not self.ramp:
            return self._named(acts, since, since)
        begin, length = self._along(design, since), np.ones(len(design))
        if len(self.strokes.length):
            length = np.where(acts, self._along(design, since + self.strokes.length[found]) - begin, 1.0)
        if self.backwards:
            begin, length = begin + length, -length
        return self._named(acts, begin, length)

    def _along(self, design: Indices, time: Floats) -> Floats:
        """The time itself of an input that turns steadily, else the input, rad or m."""
        return time if self.by_time else self._input(time)[0]

    def _input(self, time: Floats) -> tuple[Floats, Floats]:
        """The first driver's coordinate and rate at times, s, perhaps of cycles before and after."""
        course, law = self.span.course, self.span.course.first.law
        laps, gained = np.zeros(len(time)), 0.0
        if course.closed:
            laps = np.floor((time - course.begin) / course.duration)
            gained = law.at(course.begin + course.duration) - law.at(course.begin)
        value, rate, _ = law.coordinate(time - laps * course.duration)
        return value + laps * gained, rate

    def pull(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        found, acts, since = self.strokes.at(design, middle)
        bars = self._bars(acts, by_columns)
        if bars is None or not len(self.strokes.length):
            return
        by_begin, by_end = bars[0] - bars[1], bars[1]
        if self.backwards:
            by_begin, by_end = bars[1], bars[0] - bars[1]
        if not self.by_time:
            by_begin = by_begin * self._input(since)[1]
            by_end = by_end * self._input(since + self.strokes.length[found])[1]
        period, until = self.span.period[design], since + self.strokes.length[found]
        for events, place, time, bar in (
            (self.strokes.start, self.strokes.begin[found], since, by_begin),
            (self.strokes.finish, self.strokes.end[found], until, by_end),
        ):
            np.add.at(events.bar, place, bar)
            if self.span.course.turns:
                np.add.at(self.span.bar, design, bar * np.round((time - events.time[place]) / period))


class WithinInput(Acting):
    """While an input that follows a law, or goes a part of a turn, is within an interval, angles modulo one turn.

    ``ends``: the values (designs,) of the input at both ends; ``heading``: 1 where it only grows, -1 where it only
    falls, else 0.
    """

    def __init__(self, load: Load, span: Span, ends: tuple[Floats, Floats], heading: int, events: list[Cuts]) -> None:
        super().__init__(load, span)
        self.start, last = ends
        gap, self._rotary = last - self.start, span.course.first.law.rotary
        self.fits = (np.abs(gap) <= TURN + NEAR) | (not self._rotary)
        through = gap - TURN * np.floor(gap / TURN)
        around = (gap < 0.0) & (heading > 0) & self._rotary
        self.length = np.where(around, np.where(through <= 0.0, TURN, through), gap)
        self.events = events
        self.by_dimensions = {input_end(load.name, which): np.zeros(span.count) for which in (0, 1)}

    @property
    def missing(self) -> Flags:
        return np.asarray(~self.fits)

    def columns(self, design: Indices, middle: Floats) -> Columns:
        start, length = self.start[design], self.length[design]
        course = self.span.course
        inside = middle
        if course.closed:
            inside = middle - np.floor((middle - course.begin) / course.duration) * course.duration
        gone = course.first.law.coordinate(inside)[0] - np.minimum(start, start + length)
        laps = TURN * np.floor(gone / TURN) if self._rotary else np.zeros(len(design))
        acts = (gone >= laps) & (gone - laps < np.abs(length))
        return self._named(acts, start + laps, np.where(length == 0.0, 1.0, length))

    def pull(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        acts = self.columns(design, middle)[acts_name(self.name)] > 0.5
        bars = self._bars(acts, by_columns)
        if bars is not None:
            self.pull_reach(0, design, bars[0] - bars[1])
            self.pull_reach(1, design, bars[1])

    def pull_reach(self, which: int, design: Indices, bars: Floats) -> None:
        """Enters derivatives by the ends."""
        np.add.at(self.by_dimensions[input_end(self.name, which)], design, bars)


class InPart(Acting):
    """While an output, on its way from one outermost limit to the other, is in a part of that way."""

    def __init__(
        self,
        load: Load,
        phase: SwingPhase,
        strokes: Strokes,
        limits: Limits,
        value: Formula,
        known: Known,
        designs: Designs,
    ) -> None:
        super().__init__(load, strokes.span)
        self.strokes, self.limits, self.designs = strokes, limits, designs
        self._value, self._known = value, known
        self._kinds, self._edges = (phase.start, phase.end), phase.part_edges
        first, last = limits.at(phase.start), limits.at(phase.end)
        self.shares, ways = part_of(phase)
        stroke = last - first
        self.begin = first + self.shares[0] * stroke + np.sign(stroke) * ways[0]
        self.length = first + self.shares[1] * stroke + np.sign(stroke) * ways[1] - self.begin
        beyond = 1e-9 * np.abs(stroke)
        gone = (self.begin - first) * np.sign(stroke)
        with np.errstate(invalid="ignore"):
            fits = (gone >= -beyond) & (gone + np.abs(self.length) <= np.abs(stroke) + beyond)
            self._fits = fits & (self.length * stroke > 0.0)
        self.events = [strokes.start, strokes.finish]

    @property
    def missing(self) -> Flags:
        return np.asarray(~self._fits | (np.bincount(self.strokes.design, minlength=self.span.count) == 0))

    def columns(self, design: Indices, middle: Floats) -> Columns:
        _, acts, _ = self.strokes.at(design, middle)
        value = self._value.run(self._known, at_times(self.designs, design, middle), AT)[0, 0]
        share = (value - self.begin[design]) / self.length[design]
        if 0 in self._edges:
            acts = acts & (share > 0.0)
        if 1 in self._edges:
            acts = acts & (share < 1.0)
        return self._named(acts, self.begin[design], self.length[design])

    def pull(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        acts = self.columns(design, middle)[acts_name(self.name)] > 0.5
        bars = self._bars(acts, by_columns)
        if bars is not None:
            by_length = bars[1] * (self.shares[1] - self.shares[0])
            by_last = bars[0] * self.shares[0] + by_length
            self._by_limits(design, bars[0] * (1.0 - self.shares[0]) - by_length, by_last)

    def _by_limits(self, design: Indices, by_first: Floats, by_last: Floats) -> None:
        for kind, bar in zip(self._kinds, (by_first, by_last), strict=True):
            np.add.at(self.limits.bar, self.limits.outermost[kind][design], bar)

    def reach(self, which: int) -> Floats:
        """The value of the output where the part begins (0) or ends (1), (designs,)."""
        return self.begin + which * self.length

    def pull_reach(self, which: int, design: Indices, bars: Floats) -> None:
        """From derivatives by these values those by the limits."""
        share = self.shares[which]
        self._by_limits(design, bars * (1.0 - share), bars * share)


class Never(Acting):
    """A load whose phase no design has."""

    def __init__(self, load: Load, span: Span) -> None:
        super().__init__(load, span)
        self.events = []

    @property
    def missing(self) -> Flags:
        return np.ones(self.span.count, dtype=np.bool_)

    def columns(self, design: Indices, middle: Floats) -> Columns:
        nothing = np.zeros(len(design))
        return self._named(nothing > 0.0, nothing, nothing + 1.0)

    def pull(self, design: Indices, middle: Floats, by_columns: Mapping[str, Floats]) -> None:
        """Nothing follows from it."""


def input_end(load: str, which: int) -> str:
    """The dimension that is the input at which a load begins (0) or ends (1) to act."""
    return f"loads.{load}.phase.input.{which}"


def part_of(phase: SwingPhase) -> tuple[tuple[float, float], tuple[float, float]]:
    """Where a part of a stroke begins and ends: shares of the stroke, and ways from there."""
    assert phase.part is not None
    amounts = [(a.value, 0.0) if a.share else (0.0, a.value) for a in phase.part.amounts]
    (first, way), (last, back) = amounts[0], amounts[-1]
    if phase.part.word == "first":
        return (0.0, first), (0.0, way)
    if phase.part.word == "last":
        return (1.0 - first, 1.0), (-way, 0.0)
    return (first, 1.0 - last), (way, -back)


class Reversals(Cuts, Protocol):
    """Such that go up or down."""

    rising: Flags


@dataclass(frozen=True)
class Strokes:
    """From events ``begin`` of a family ``start`` to events ``end`` of a family ``finish``, numbers (k,), by design
    and time."""

    span: Span
    start: Cuts
    finish: Cuts
    begin: Indices
    end: Indices

    @cached_property
    def design(self) -> Indices:
        """Whose they are."""
        return self.start.design[self.begin]

    @cached_property
    def since(self) -> Floats:
        """When they begin, s."""
        return self.start.time[self.begin]

    @cached_property
    def length(self) -> Floats:
        """How long they take, s."""
        gone = self.finish.time[self.end] - self.since
        if not self.span.course.closed:
            return gone
        period = self.span.period[self.design]
        return np.asarray(gone - np.floor(gone / period) * period)

    def at(self, design: Indices, time: Floats) -> tuple[Indices, Flags, Floats]:
        """Of times, s, of some designs the stroke in or after which they lie, whether they are in it, and when it
        began, perhaps in the cycle before."""
        if not len(self.begin):
            nothing = np.zeros(len(time))
            return nothing.astype(np.intp), nothing.astype(np.bool_), nothing
        own, since, length = self.design, self.since, self.length
        keys = self.span.order(own, since)
        found = np.searchsorted(keys, self.span.order(design, time), "right") - 1
        before = (found < 0) | (own[np.maximum(found, 0)] != design)
        last = np.searchsorted(own, design, "right") - 1
        found = np.maximum(np.where(before, last if self.span.course.closed else found, found), 0)
        gone = time - since[found]
        if self.span.course.closed:
            period = self.span.period[design]
            gone = gone - np.floor(gone / period) * period
        acts = (gone < length[found]) & (own[found] == design) & (gone >= 0.0)
        return found, acts, time - gone


class Repeated:
    """Events of a cycle that comes again and again, as far as they lie in the course of a ``span``: (k,) by
    design."""

    def __init__(self, events: Cuts, period: Floats, span: Span) -> None:
        self.events = events
        lap, first = period[events.design], events.time
        begin, end = span.begin, span.begin + span.period[events.design]
        low = np.ceil((begin - first) / lap).astype(np.intp)
        count = np.maximum(np.floor((end - first) / lap).astype(np.intp) - low + 1, 0)
        which = np.repeat(np.arange(len(first)), count)
        number = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
        time = first[which] + (low[which] + number) * lap[which]
        order = np.lexsort((time, events.design[which]))
        self._which: Indices = which[order]
        self.design: Indices = events.design[self._which]
        self.time: Floats = time[order]
        self.bar: Floats = np.zeros(len(order))

    def push(self) -> None:
        """Hands derivatives by the times on to the events."""
        np.add.at(self.events.bar, self._which, self.bar)


def between(start: Cuts, finish: Cuts, span: Span) -> Strokes:
    """From every event of one family to the next one of another."""
    end, has = _next(start, finish, span)
    begin = np.flatnonzero(has)
    return Strokes(span, start, finish, begin, end[begin])


def of_limits(events: Reversals, rising: tuple[bool, bool], span: Span) -> Strokes:
    """From every event of a family that rises, or falls, to the next one, where that does as is asked."""
    end, has = _next(events, events, span)
    goes = has & (events.rising == rising[0])
    begin = np.flatnonzero(goes)
    begin = begin[events.rising[end[begin]] == rising[1]]
    return Strokes(span, events, events, begin, end[begin])


def _next(start: Cuts, finish: Cuts, span: Span) -> tuple[Indices, Flags]:
    """Of one family's events the following ones of another, of the same design and around cycles that close."""
    if not len(finish.time):
        return np.zeros(len(start.time), dtype=np.intp), np.zeros(len(start.time), dtype=np.bool_)
    keys, asked = span.order(finish.design, finish.time), span.order(start.design, start.time)
    after = np.searchsorted(keys, asked, "right")
    first, last = (np.searchsorted(finish.design, start.design, side) for side in ("left", "right"))
    found = np.where(after < last, after, first if span.course.closed else len(finish.time))
    has = (first < last) & (found < last)
    return np.minimum(found, len(finish.time) - 1), has
