"""Events: where a signal changes its sign over the cycles of many designs, all found at once.

The signal is looked at on polynomial pieces, which are halved until they meet it; places where it is rounding of
zero decide nothing. Between two places that do, in one stretch without cuts, Newton's steps of the formula itself
find the root; elsewhere the sign changes at a cut, or over a rest, of which the middle counts. What is found is flat:
so many events as there are, by design and time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import field

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.core.dataclass import dataclass
from linkwright.curves.pieces import HIGH, LOW, Layout, Pieces, Wanted
from linkwright.curves.polynomials import LOOKS, TO_LOOKS, product, turning_points
from linkwright.events.formula import Formula, Known, Pointwise
from linkwright.events.stretches import Stretches

#: Pieces of a lap to begin with, and to what share of its size they meet a signal.
PIECES, MET = 6, 1e-5
#: Share of a signal's size up to which it is rounding of zero.
NOTHING = 1e-11
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

    def kept(self, chosen: Indices | Flags) -> Events:
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
    found = _Search(formula, known, designs, stretches, curve, loaded).found()
    return [
        Events(formula, known, name, designs, stretches, *found.of(k), loaded)
        for k, name in enumerate(formula.outputs)
    ]


@dataclass(frozen=True)
class _Found:
    """Events of all signals behind each other, in order of signal, design and time."""

    signal: Indices
    design: Indices
    time: Floats
    rising: Flags
    edges: Indices
    within: Floats

    def of(self, k: int) -> tuple[Indices, Floats, Flags, Indices, Floats]:
        """Those of one signal."""
        first, last = np.searchsorted(self.signal, [k, k + 1])
        part = slice(first, last)
        return self.design[part], self.time[part], self.rising[part], self.edges[:, part], self.within[part]


@dataclass(frozen=True)
class _Brackets:
    """Pairs of places between which a signal changes its sign: ``piece`` of the left one, times, a first guess."""

    signal: Indices
    piece: Indices
    left: Floats
    right: Floats
    guess: Floats
    rising: Flags

    def __add__(self, other: _Brackets) -> _Brackets:
        names = ("signal", "piece", "left", "right", "guess", "rising")
        return _Brackets(*(np.concatenate([getattr(self, name), getattr(other, name)]) for name in names))

    def taken(self, chosen: Flags | Indices) -> _Brackets:
        names = ("signal", "piece", "left", "right", "guess", "rising")
        return _Brackets(*(getattr(self, name)[chosen] for name in names))


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

    def found(self) -> _Found:
        """All of them."""
        curve = self.curve
        with np.errstate(invalid="ignore"):
            span = 0.5 * (curve.top - curve.bottom)
            near = (curve.top >= -span) & (curve.bottom <= span)
        signal, piece = np.nonzero(near)
        looks = product(TO_LOOKS, curve.values(signal, piece))
        brackets, edges = self._changes(near, signal, piece, looks)
        free = edges[0] < 0
        roots = brackets.taken(free) + self._hidden(signal, piece, looks)
        time = np.append(self._polished(roots), self._at_edges(edges[:, ~free]))
        roots = roots + brackets.taken(~free)
        tied = np.append(np.full((2, len(roots.piece) - int((~free).sum())), -1), edges[:, ~free], axis=1)
        design = curve.design[roots.piece]
        time = self.stretches.span.within(design, time)
        lap = self.stretches.span.period[design]
        middle = self.low[roots.piece] + 0.5 * self.width[roots.piece]
        middle = (
            middle - np.round((middle - time) / lap) * lap if self.stretches.span.course.closed else middle
        )
        order = np.lexsort((time, design, roots.signal))
        return _Found(
            roots.signal[order],
            design[order],
            time[order],
            roots.rising[order],
            tied[:, order],
            middle[order],
        )

    def _changes(
        self, near: Flags, signal: Indices, piece: Indices, looks: Floats
    ) -> tuple[_Brackets, Indices]:
        """Neighbours among the places that decide with different signs, and the stretches before and after the cut,
        or the rest, that lies between them; -1 where none does."""
        curve = self.curve
        nothing = NOTHING * np.maximum(curve.size, 0.0)
        self._make_sure(signal, piece, looks, nothing)
        decided = np.where(np.abs(looks) > nothing[signal, curve.design[piece]], looks, 0.0)
        last = _last_decided(decided)
        columns = np.arange(len(piece))
        values = np.where(last >= 0, decided[np.maximum(last, 0), columns], 0.0)
        place, row = np.nonzero(values[1:] * values[:-1] < 0.0)
        before = last[place, row]
        inner = self._bracket(
            signal[row],
            (piece[row], before),
            (piece[row], place + 1),
            values[place, row],
            values[place + 1, row],
        )
        first = (decided != 0.0).argmax(axis=0)
        begins = np.where(np.abs(curve.whole) > nothing[:, curve.design], curve.whole, 0.0)
        ends = begins.copy()
        at_begin, at_end = (np.full(near.shape, len(LOOKS) // 2) for _ in range(2))
        begins[signal, piece], ends[signal, piece] = decided[first, columns], values[-1]
        at_begin[signal, piece], at_end[signal, piece] = first, np.maximum(last[-1], 0)
        sig, at = np.nonzero(begins != 0.0)
        here, there, lap = self._following(sig * curve.designs + curve.design[at])
        a, b = ends[sig[here], at[here]], begins[sig[there], at[there]]
        changed = a * b < 0.0
        here, there, lap, a, b = here[changed], there[changed], lap[changed], a[changed], b[changed]
        left = at[here], at_end[sig[here], at[here]]
        right = at[there], at_begin[sig[there], at[there]]
        outer = self._bracket(sig[here], left, right, a, b, lap * curve.period[curve.design[at[there]]])
        edges = self._edges_between(at[here], at[there], lap)
        return inner + outer, np.append(np.full((2, len(row)), -1), edges, axis=1)

    def _bracket(
        self,
        signal: Indices,
        before: tuple[Indices, Indices],
        after: tuple[Indices, Indices],
        a: Floats,
        b: Floats,
        later: Floats | float = 0.0,
    ) -> _Brackets:
        """Between two looks of pieces, each with its piece and number, with the values there; ``later``, s, the
        second."""
        left, right = (
            self.low[at] + 0.5 * self.width[at] * (1.0 + LOOKS[look]) for at, look in (before, after)
        )
        right = right + later
        return _Brackets(signal, before[0], left, right, left + (right - left) * a / (a - b), b > 0.0)

    def _make_sure(self, signal: Indices, piece: Indices, looks: Floats, nothing: Floats) -> None:
        """Values so small that the polynomials leave their signs open are replaced by those of the formula."""
        curve, size = self.curve, np.abs(looks)
        open_ = (size <= OPEN * curve.rough[signal, piece]) & (size > nothing[signal, curve.design[piece]])
        look, row = np.nonzero(open_)
        if len(row):
            time = self.low[piece[row]] + 0.5 * self.width[piece[row]] * (1.0 + LOOKS[look])
            there = self._at(self.formula, piece[row], time)
            looks[look, row] = there[signal[row], np.arange(len(row))]

    def _following(self, owner: Indices) -> tuple[Indices, Indices, Floats]:
        """Neighbours (k,) of the same signal and design, around cycles that close, and whether the second is a lap
        on."""
        here = np.arange(len(owner))
        begins = np.flatnonzero(np.append(True, owner[1:] != owner[:-1])[: len(owner)])
        last = np.append(begins[1:], len(owner))[: len(begins)] - 1
        there, lap = here + 1, np.zeros(len(owner))
        there[last], lap[last] = begins, 1.0
        if self.stretches.span.course.closed:
            return here, there, lap
        kept = lap == 0.0
        return here[kept], there[kept], lap[kept]

    def _edges_between(self, left: Indices, right: Indices, lap: Floats) -> Indices:
        """Stretches whose beginnings are the first and the last cut between two pieces, (2, k); -1 in one stretch."""
        stretch, design = self.curve.stretch, self.stretches.design
        before, after = stretch[left], stretch[right]
        counts = np.bincount(design, minlength=self.stretches.span.count)
        alone = (before == after) & ((lap == 0.0) | ((counts[design[before]] == 1) & (self.stretches.edge[before] < 0)
                                                     & bool(self.stretches.span.course.turns)))  # fmt: skip
        first = np.searchsorted(design, design[before])
        following = first + (before + 1 - first) % counts[design[before]]
        return np.where(alone, -1, np.stack([following, after]))

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
            return _Brackets(signal, piece, low, high, low, above)
        x = turning_points(self.curve.values(signal, piece), low, high, LOOKS[place + 1])
        time, left, right = (
            self.low[piece] + 0.5 * self.width[piece] * (1.0 + each) for each in (x, low, high)
        )
        value = self._at(self.formula, piece, time)[signal, np.arange(len(piece))]
        nothing = NOTHING * self.curve.size[signal, self.curve.design[piece]]
        passed = np.flatnonzero(((value > 0.0) != above) & (np.abs(value) > nothing))
        signal, piece, above, time = signal[passed], piece[passed], above[passed], time[passed]
        left, right = left[passed], right[passed]
        both = _Brackets(signal, piece, left, time, 0.5 * (left + time), ~above)
        return both + _Brackets(signal, piece, time, right, 0.5 * (time + right), above)

    def _at(self, formula: Pointwise, piece: Indices, time: Floats) -> Floats:
        """Outputs (outputs, k) of a formula at times, s, one in each of some pieces."""
        design = self.curve.design[piece]
        columns = at_times(self.designs, design, time)
        if self.loaded is not None:
            columns |= self.loaded(design, time, self.low[piece] + 0.5 * self.width[piece])
        found: Floats = formula.run(self.known, columns, AT)[0]
        return found

    def _polished(self, brackets: _Brackets) -> Floats:
        """Roots by Newton's steps within their brackets, all at once."""
        left, right, time, rising = brackets.left, brackets.right, brackets.guess, brackets.rising
        width, rows, open_ = right - left, np.arange(len(left)), np.ones(len(left), dtype=np.bool_)
        for _ in range(STEPS if len(left) else 0):
            found = self._at(self.formula.with_slope, brackets.piece, time)
            g, slope = found[2 * brackets.signal, rows], found[2 * brackets.signal + 1, rows]
            beyond = (g >= 0.0) == rising
            left, right = np.where(beyond, left, time), np.where(beyond, time, right)
            with np.errstate(divide="ignore", invalid="ignore"):
                newton = time - g / slope
            newton = np.where((newton >= left) & (newton <= right), newton, 0.5 * (left + right))
            newton = np.where(open_, newton, time)
            moved, time = np.abs(newton - time), newton
            open_ &= ~(moved <= NEAR * width)
            if not open_.any():
                break
        return time


def _last_decided(values: Floats) -> Indices:
    """The number of the last value at or before each that is not zero, in every column; -1 before the first one."""
    rows = np.where(values != 0.0, np.arange(len(values))[:, None], -1)
    return np.maximum.accumulate(rows, axis=0) if (rows < 0).any() else rows
