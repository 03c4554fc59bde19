"""When loads act: ways from one event to another, whether pieces lie in them, and how far they have gone there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.events.stretches import Span


class Ends(Protocol):
    """Events at which strokes begin or end, (k,) by design and time."""

    design: Indices
    time: Floats
    bar: Floats


class Reversals(Ends, Protocol):
    """Such that go up or down."""

    rising: Flags


@dataclass(frozen=True)
class Strokes:
    """From events ``begin`` of a family ``start`` to events ``end`` of a family ``finish``, numbers (k,), by design
    and time."""

    span: Span
    start: Ends
    finish: Ends
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

    def __init__(self, events: Ends, period: Floats, span: Span) -> None:
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


def between(start: Ends, finish: Ends, span: Span) -> Strokes:
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


def _next(start: Ends, finish: Ends, span: Span) -> tuple[Indices, Flags]:
    """Of one family's events the following ones of another, of the same design and around cycles that close."""
    if not len(finish.time):
        return np.zeros(len(start.time), dtype=np.intp), np.zeros(len(start.time), dtype=np.bool_)
    keys, asked = span.order(finish.design, finish.time), span.order(start.design, start.time)
    after = np.searchsorted(keys, asked, "right")
    first, last = (np.searchsorted(finish.design, start.design, side) for side in ("left", "right"))
    found = np.where(after < last, after, first if span.course.closed else len(finish.time))
    has = (first < last) & (found < last)
    return np.minimum(found, len(finish.time) - 1), has
