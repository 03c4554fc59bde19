"""Events: where a signal changes its sign over the cycles of many designs, all found at once, and limit positions.

The signal is looked at on polynomial pieces, which are halved until they meet it; places where it is rounding of
zero decide nothing. Between two places that do, in one stretch without cuts, Newton's steps of the formula itself
find the root; elsewhere the sign changes at a cut, or over a rest, of which the middle counts. What is found is flat:
so many events as there are, by design and time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices, begins
from linkwright.curves.pieces import HIGH, LOW, Layout, Pieces, Wanted
from linkwright.curves.polynomials import LOOKS, TO_LOOKS, product, turning_points
from linkwright.events.course import Span, Stretches
from linkwright.events.formula import Formula, Known, Pointwise

#: Pieces of a lap to begin with, and to what share of its size they meet a signal.
PIECES, MET = 6, 1e-5
#: Share of a signal's size up to which it is rounding of zero.
ZERO_TOLERANCE = 1e-11
#: Newton's steps at most; one of this share of the bracket is the last, as what is left is its square.
STEPS, NEAR = 60, 1e-7
#: A turn this near to zero, as share of the signal's size in its piece, may hide two roots between two looks.
HIDDEN = 0.02
#: A value of a polynomial below so many times the size of its last orders may have the wrong sign.
OPEN = 8.0
AT = np.zeros(1)
Designs = Mapping[str, Floats]
#: What loads do in pieces of unit length that begin at some times of designs, as they do at a place nearby.
Loaded = Callable[[Indices, Floats, Floats], dict[str, Floats]]


def at_times(designs: Designs, design: Indices, time: Floats) -> dict[str, Floats]:
    """Columns of pieces of unit length that begin at some times: derivatives by the place are those by the time."""
    return {name: each[design] for name, each in designs.items()} | {LOW: time, HIGH: time + 1.0}


@dataclass
class Events:
    """Changes of sign of one output of a formula: ``design``, ``time`` (s), ``rising`` (from below to above zero),
    (k,).

    ``edges`` (2, k): the cuts between which an event lies that is no root, -1 of roots; ``bar``: derivatives by the
    times, gathered on the way back; ``within``: a place of the piece in which it was found, s.
    """

    formula: Pointwise
    known: Known
    name: str
    designs: Designs
    stretches: Stretches
    design: Indices
    time: Floats
    rising: Flags
    edges: Indices
    within: Floats
    loaded: Loaded | None = None
    bar: Floats = field(init=False)

    def __post_init__(self) -> None:
        self.bar = np.zeros(len(self.time))

    def columns(self, chosen: Indices | slice = slice(None)) -> dict[str, Floats]:
        """Pieces that begin at the events."""
        design, time = self.design[chosen], self.time[chosen]
        loads = self.loaded(design, time, self.within[chosen]) if self.loaded else {}
        return at_times(self.designs, design, time) | loads

    def selected(self, chosen: Indices | Flags) -> Events:
        """Some of them, with bars of their own."""
        parts = (self.design[chosen], self.time[chosen], self.rising[chosen], self.edges[:, chosen])
        return Events(
            self.formula,
            self.known,
            self.name,
            self.designs,
            self.stretches,
            *parts,
            self.within[chosen],
            self.loaded,
        )

    def pull(self) -> tuple[Indices, dict[str, Floats], Indices]:
        """By the implicit function theorem, dx/dp = -g_p / g_x, derivatives by the columns of the designs, of the
        roots of these numbers; what lies at cuts goes on to these."""
        roots = np.flatnonzero(self.edges[0] < 0)
        if len(roots) < len(self.time):
            tied = np.flatnonzero(self.edges[0] >= 0)
            for edge in self.edges:
                self.stretches.move_edges(self.stretches.edge[edge[tied]], 0.5 * self.bar[tied])
            span, design = self.stretches.span, self.design[tied]
            middle = self.stretches.begin[self.edges[:, tied]].mean(axis=0)
            halves = np.round(2.0 * (self.time[tied] - middle) / span.period[design])
            np.add.at(span.bar, design, 0.5 * halves * self.bar[tied])
        columns = self.columns(roots)
        assert isinstance(self.formula, Formula)
        slope = self.formula.with_slope.run(self.known, columns, AT)[0, 2 * self.formula.place[self.name] + 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            weight = np.where(self.bar[roots] == 0.0, 0.0, -self.bar[roots] / slope)
        return self.design[roots], self.formula.vjp(self.known, columns, AT, {self.name: weight[None]}), roots


def events(
    formula: Pointwise, known: Known, designs: Designs, stretches: Stretches, loaded: Loaded | None = None
) -> list[Events]:
    """All changes of sign of every output of a formula over the cycles of designs; ``loaded``: of one that takes
    loads."""
    span = stretches.span

    def columns(stretch: Indices, first: Floats, last: Floats) -> dict[str, Floats]:
        design = stretches.design[stretch]
        low, high = stretches.ends(stretch, first, last)
        found = {name: each[design] for name, each in designs.items()} | {LOW: low, HIGH: high}
        if loaded is not None:
            middle = 0.5 * (low + high)
            found |= loaded(design, low, middle)
        return found

    layout = Layout(stretches.design, span.count, columns)
    wanted = Wanted(even=tuple(range(len(formula.outputs))), met=MET)
    run = lambda columns, nodes: formula.run(known, columns, nodes)  # noqa: E731
    curve = Pieces(run, layout, *stretches.first_pieces(PIECES), wanted)
    return _Search(formula, known, designs, stretches, curve, loaded).found()


class _Brackets(NamedTuple):
    """Pairs of places between which a signal changes its sign: ``piece`` of the left one, times, a first guess;
    ``edges`` as of :class:`Events`."""

    signal: Indices
    piece: Indices
    left: Floats
    right: Floats
    guess: Floats
    rising: Flags
    edges: Indices

    def joined(self, other: _Brackets) -> _Brackets:
        """Both."""
        if not len(other.piece):
            return self
        return _Brackets(*(np.concatenate(each, axis=-1) for each in zip(self, other, strict=True)))


class _Search:
    """The search for the changes of sign of a formula's outputs on pieces that meet them."""

    def __init__(
        self,
        formula: Pointwise,
        known: Known,
        designs: Designs,
        stretches: Stretches,
        curve: Pieces,
        loaded: Loaded | None,
    ) -> None:
        self.formula, self.known, self.designs = formula, known, designs
        self.stretches, self.curve, self.loaded = stretches, curve, loaded
        self.low, self.width = curve.columns[LOW], curve.width

    def found(self) -> list[Events]:
        """Those of every signal, by design and time."""
        curve, span = self.curve, self.stretches.span
        with np.errstate(invalid="ignore"):
            half = 0.5 * (curve.top - curve.bottom)
            near = (curve.top >= -half) & (curve.bottom <= half)
        signal, piece = np.nonzero(near)
        looks = product(TO_LOOKS, curve.values(signal, piece))
        brackets = self._changes(near, signal, piece, looks).joined(self._hidden(signal, piece, looks))
        design, edges = curve.design[brackets.piece], brackets.edges
        time = span.within(design, self._polished(brackets))
        middle = self.low[brackets.piece] + 0.5 * self.width[brackets.piece]
        if span.course.closed:
            middle -= np.round((middle - time) / span.period[design]) * span.period[design]
        order = np.lexsort((time, design, brackets.signal))
        ends = np.searchsorted(brackets.signal[order], np.arange(len(self.formula.outputs) + 1)).tolist()
        found = []
        for name, own in zip(self.formula.outputs, (order[a:b] for a, b in pairwise(ends)), strict=True):
            columns = design[own], time[own], brackets.rising[own], edges[:, own], middle[own]
            common = self.formula, self.known, name, self.designs, self.stretches
            found.append(Events(*common, *columns, self.loaded))
        return found

    def _changes(self, near: Flags, signal: Indices, piece: Indices, looks: Floats) -> _Brackets:
        """Neighbours among the places that decide with different signs, and the stretches before and after the cut,
        or the rest, that lies between them; -1 where none does."""
        curve = self.curve
        nothing = ZERO_TOLERANCE * np.maximum(curve.size, 0.0)
        self._make_sure(signal, piece, looks, nothing)
        values = np.repeat(curve.mean_values[:, :, None], len(LOOKS), axis=2)
        values[near] = looks.T
        decided = (np.abs(values) > nothing[:, curve.design, None]).ravel()
        places = np.arange(values.size) if decided.all() else np.flatnonzero(decided)
        value = values.ravel()[places]
        here, there, lap = self._changed(places, value)
        a, b = value[here], value[there]
        (sig, at, first), (_, to, last) = (np.unravel_index(places[each], values.shape) for each in (here, there))
        first, last = (np.where(near[sig, each], look, len(LOOKS) // 2) for each, look in ((at, first), (to, last)))
        left, right = (
            self.low[each] + 0.5 * self.width[each] * (1.0 + LOOKS[look]) for each, look in ((at, first), (to, last))
        )
        right = right + lap * curve.period[curve.design[to]]
        edges, guess = self._edges_between(at, to, lap), left + (right - left) * a / (a - b)
        if (edges >= 0).any():
            guess = np.where(edges[0] < 0, guess, self._at_edges(edges))
        return _Brackets(sig, at, left, right, guess, b > 0.0, edges)

    def _changed(self, places: Indices, value: Floats) -> tuple[Indices, Indices, Floats]:
        """Neighbours of the same signal and design, around cycles that close, among places (k,) of looks, between
        which the sign changes, and whether the second is a lap on."""
        curve, closed = self.curve, self.stretches.span.course.closed
        signals, pieces = curve.mean_values.shape
        begins = ((np.arange(signals)[:, None] * pieces + curve.starts) * len(LOOKS)).ravel()
        first = np.searchsorted(places, begins)
        last = np.append(first[1:], len(places)) - 1
        inner = np.flatnonzero(value[1:] * value[:-1] < 0.0)
        inner = inner[last[np.searchsorted(first, inner, "right") - 1] != inner]
        outer = np.flatnonzero((last > first) & closed)
        outer = outer[value[last[outer]] * value[first[outer]] < 0.0]
        lap = np.append(np.zeros(len(inner)), np.ones(len(outer)))
        return np.append(inner, last[outer]), np.append(inner + 1, first[outer]), lap

    def _make_sure(self, signal: Indices, piece: Indices, looks: Floats, nothing: Floats) -> None:
        """Values so small that the polynomials leave their signs open are replaced by those of the formula."""
        curve, size = self.curve, np.abs(looks)
        open_ = (size <= OPEN * curve.rough[signal, piece]) & (size > nothing[signal, curve.design[piece]])
        look, row = np.nonzero(open_)
        if len(row):
            time = self.low[piece[row]] + 0.5 * self.width[piece[row]] * (1.0 + LOOKS[look])
            there = self._at(self.formula, piece[row], time)
            looks[look, row] = there[signal[row], np.arange(len(row))]

    def _edges_between(self, left: Indices, right: Indices, lap: Floats) -> Indices:
        """Stretches whose beginnings are the first and the last cut between two pieces, (2, k); -1 in one stretch."""
        stretch, design = self.curve.stretch, self.stretches.design
        before, after = stretch[left], stretch[right]
        if np.array_equal(before, after) and not lap.any():
            return np.full((2, len(left)), -1)
        counts = np.bincount(design, minlength=self.stretches.span.count)
        alone = (before == after) & (
            (lap == 0.0)
            | (
                (counts[design[before]] == 1)
                & (self.stretches.edge[before] < 0)
                & bool(self.stretches.span.course.turns)
            )
        )
        first = np.searchsorted(design, design[before])
        after_it = first + (before + 1 - first) % counts[design[before]]
        return np.where(alone, -1, np.stack([after_it, after]))

    def _at_edges(self, edges: Indices) -> Floats:
        """Times of cuts, or of the middles between two of them, s."""
        begin, span = self.stretches.begin, self.stretches.span
        first, last = begin[edges[0]], begin[edges[1]]
        period = span.period[self.stretches.design[edges[0]]]
        return np.asarray(first + 0.5 * np.where(last < first, last + period - first, last - first))

    def _hidden(self, signal: Indices, piece: Indices, looks: Floats) -> _Brackets:
        """Two roots between looks of the same sign: where the polynomial turns near zero, and the formula passes
        it."""
        here = looks[1:-1]
        size = np.abs(looks).max(axis=0, initial=0.0)
        near = (np.abs(here) <= np.abs(looks[:-2])) & (np.abs(here) <= np.abs(looks[2:]))
        near &= (np.abs(here) < HIDDEN * size) & (here * looks[:-2] > 0.0) & (here * looks[2:] > 0.0)
        place, row = np.nonzero(near)
        signal, piece, above = signal[row], piece[row], here[place, row] > 0.0
        low, high = LOOKS[place], LOOKS[place + 2]
        if not len(piece):
            return _Brackets(signal, piece, low, high, low, above, np.empty((2, 0), dtype=np.intp))
        x = turning_points(self.curve.values(signal, piece), low, high, LOOKS[place + 1])
        time, left, right = (self.low[piece] + 0.5 * self.width[piece] * (1.0 + each) for each in (x, low, high))
        value = self._at(self.formula, piece, time)[signal, np.arange(len(piece))]
        nothing = ZERO_TOLERANCE * self.curve.size[signal, self.curve.design[piece]]
        passed = np.flatnonzero(((value > 0.0) != above) & (np.abs(value) > nothing))
        signal, piece, above, time = signal[passed], piece[passed], above[passed], time[passed]
        left, right, edges = left[passed], right[passed], np.full((2, len(passed)), -1)
        first = _Brackets(signal, piece, left, time, 0.5 * (left + time), ~above, edges)
        return first.joined(_Brackets(signal, piece, time, right, 0.5 * (time + right), above, edges))

    def _at(self, formula: Pointwise, piece: Indices, time: Floats) -> Floats:
        """Outputs (outputs, k) of a formula at times, s, one in each of some pieces."""
        design = self.curve.design[piece]
        columns = at_times(self.designs, design, time)
        if self.loaded is not None:
            columns |= self.loaded(design, time, self.low[piece] + 0.5 * self.width[piece])
        found: Floats = formula.run(self.known, columns, AT)[0]
        return found

    def _polished(self, brackets: _Brackets) -> Floats:
        """Roots by Newton's steps within their brackets, all at once; the guesses of those at cuts."""
        left, right, time, rising = brackets.left, brackets.right, brackets.guess, brackets.rising
        width, rows, open_ = right - left, np.arange(len(left)), brackets.edges[0] < 0
        for _ in range(STEPS if open_.any() else 0):
            found = self._at(self.formula.with_slope, brackets.piece, time)
            g, slope = found[2 * brackets.signal, rows], found[2 * brackets.signal + 1, rows]
            beyond = (g >= 0.0) == rising
            left, right = np.where(beyond, left, time), np.where(beyond, time, right)
            with np.errstate(divide="ignore", invalid="ignore"):
                newton = time - g / slope
            newton = np.where((newton >= left) & (newton <= right), newton, 0.5 * (left + right))
            before, time = time, np.where(open_, newton, time)
            moved = np.abs(time - before)
            open_ &= ~(moved <= NEAR * width)
            if not open_.any():
                break
        return time


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
