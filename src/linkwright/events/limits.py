"""Limit positions of an output in the cycles of many designs, and its values there."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices, begins
from linkwright.curves.pieces import LOW
from linkwright.events.events import AT, Events
from linkwright.events.formula import Formula
from linkwright.events.stretches import Span

#: Limits nearer to the outermost ones than this share of the way are outermost, too.
EQUAL_VALUES = 1e-9


class Limits:
    """``events``: the limits; ``value`` (k,) of the output there, rad or m; ``bar``: derivatives by the values,
    gathered on the way back."""

    def __init__(self, events: Events, value: Formula | None, span: Span) -> None:
        self.events, self._formula, self.span = events, value, span
        count = len(events.time)
        self.value: Floats = np.zeros(count)
        if value is not None and count:
            self.value = value.run(events.known, events.columns(), AT)[0, 0].copy()
        self.bar = np.zeros(count + 1)
        self.outermost = {"max": self._best(1.0), "min": self._best(-1.0)}

    def _best(self, sign: float) -> Indices:
        """Of every design the first limit with the largest of sign · value; -1 where it has none."""
        design, every = self.events.design, np.arange(self.span.count)
        ours = np.flatnonzero(self.events.rising == (sign < 0.0))
        value = sign * self.value[ours]
        ours = ours[np.lexsort((-value, design[ours]))]
        first = np.searchsorted(design[ours], every)
        has = np.append(design[ours], -1)[first] == every
        return np.where(has, np.append(ours, -1)[first], -1)

    @cached_property
    def first(self) -> dict[str, Indices]:
        """Of every design the first in time of the limits that are outermost, by kinds; -1 where it has none."""
        return {kind: self._first(kind) for kind in self.outermost}

    def _first(self, kind: str) -> Indices:
        events, found = self.events, np.full(self.span.count, -1)
        ours = np.flatnonzero(self.is_outermost & (events.rising == (kind == "min")))
        begin = (events.time[ours] - self.span.begin) / self.span.period[events.design[ours]]
        ours = ours[np.lexsort((begin - np.floor(begin + 1e-12), events.design[ours]))]
        owner = events.design[ours]
        one = begins(owner)
        found[owner[one]] = ours[one]
        return found

    @property
    def complete(self) -> Flags:
        """Designs that have limits of both kinds, (designs,)."""
        return (self.outermost["max"] >= 0) & (self.outermost["min"] >= 0)

    def single(self, *, outermost: bool) -> Flags:
        """Designs with one limit of each kind, or one outermost one, (designs,)."""
        design, rising = self.events.design, self.events.rising
        counted = self.is_outermost if outermost else np.ones_like(rising)
        sides = [np.bincount(design[counted & (rising == kind)], minlength=self.span.count) for kind in (False, True)]
        return np.asarray((sides[0] == 1) & (sides[1] == 1))

    @cached_property
    def is_outermost(self) -> Flags:
        """Which limits have the largest or the smallest value, (k,); such as are equal to a share of the way
        count."""
        value, design = np.append(self.value, np.nan), self.events.design
        high, low = (value[self.outermost[kind]][design] for kind in ("max", "min"))
        with np.errstate(invalid="ignore"):
            slack = np.nan_to_num(EQUAL_VALUES * (high - low))
            outer = np.where(self.events.rising, self.value <= low + slack, self.value >= high - slack)
        return np.asarray(outer)

    def at(self, kind: str) -> Floats:
        """The outermost value of a kind, (designs,); NaN without one."""
        return np.append(self.value, np.nan)[self.outermost[kind]]

    def time(self, kind: str) -> Floats:
        """When it is there first, (designs,) s."""
        return np.append(self.events.time, np.nan)[self.first[kind]]

    def rising_at(self, design: Indices, time: Floats) -> Flags:
        """Whether the output grows at times, s; of designs without limits false."""
        events = self.events
        if not len(events.time):
            return np.zeros(len(time), dtype=np.bool_)
        keys = self.span.order(events.design, events.time)
        found = np.searchsorted(keys, self.span.order(design, time), "right") - 1
        before = np.searchsorted(events.design, design)
        last = np.searchsorted(events.design, design, "right") - 1
        ahead = found < before
        found = np.where(ahead, last if self.span.course.closed else before, found)
        found = np.clip(found, 0, len(events.time) - 1)
        grows = events.rising[found] ^ (ahead & (not self.span.course.closed))
        return np.asarray(grows & (last >= before))

    def pull(self) -> tuple[Indices, dict[str, Floats]]:
        """From derivatives by the values those by the times, and by the columns of the designs."""
        if self._formula is None or not self.bar[:-1].any():
            return self.events.design[:0], {}
        bars = self._formula.vjp(self.events.known, self.events.columns(), AT, {"value": self.bar[None, :-1]})
        self.events.bar += bars.pop(LOW, 0.0)
        return self.events.design, bars
