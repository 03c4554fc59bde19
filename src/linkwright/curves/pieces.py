"""Signals of many designs as polynomials on pieces of their cycles: sizes, means, integrals, extremes.

Every piece has sixteen Gauss points; one that its polynomial does not meet, and that matters for what is asked, is
halved (Trefethen, Approximation Theory and Approximation Practice, ch. 8 and 18). Pieces of all designs lie behind
each other, by design and time, so that designs may have as many as each needs: what belongs to a design is
``reduceat`` over its pieces. Arrays are (POINTS, signals, pieces).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Flags, Floats, Indices, begins
from linkwright.curves.polynomials import HIDDEN, LAST, NODES, POINTS, SLACK, TO_ENDS, UP_TO, WEIGHTS, product

#: Columns that are the times, s, of a piece's ends.
LOW, HIGH = "low", "high"
#: A piece is met where its last orders are below this share of the signal's size.
MET = 1e-11
#: Sizes of signals of one dimension differ by less than this share, or the small one is rounding of the large one.
SIZE_SHARE = 1e-4
#: From values at the nodes to the last three orders and the mean.
LAST_AND_MEAN = np.vstack([LAST, WEIGHTS])
#: A piece that is not met to this share of the signal's size may hide what no node of it sees.
BLIND = 1e-4
#: Halvings of a piece, and the share of a cycle below which it is halved no more.
HALVINGS, NARROW = 44, 1e-13
#: More pieces of a design than these, besides four for each of the first ones, that are unmet at once are noise,
#: which no halving smooths.
CROWD = 96
#: So are more than twice as many as in the first halvings, besides a few.
EARLY, MANY = 6, 8
#: Narrower than this share of a cycle, a piece counts by its width where a signal is wanted everywhere.
WIDE = 1.0 / 12.0


Columns = Mapping[str, Floats]
Number = TypeVar("Number", bound=np.generic)


class Signals(Protocol):
    """What gives values at nodes of pieces, (nodes, signals, pieces)."""

    def __call__(self, columns: Columns, nodes: Floats) -> Floats: ...


@dataclass(frozen=True)
class Wanted:
    """What pieces must be met for: signals ``even`` everywhere, sides (signal, sign) near their extremes.

    ``same_dimension``: numbers of signals of one dimension, whose sizes are compared; ``joined``: neighbours meet
    each other too, but at ends of stretches.
    """

    even: tuple[int, ...] = ()
    sides: tuple[tuple[int, float], ...] = ()
    met: float = MET
    same_dimension: Sequence[Indices] = ()
    crowd: int = CROWD
    wide: float = WIDE
    joined: bool = False


@dataclass(frozen=True)
class Layout:
    """Stretches of cycles in which pieces lie, by design and time; ``columns(stretch, first, last)``: what formulas
    take of pieces between two shares of their stretches."""

    design: Indices
    designs: int
    columns: Callable[[Indices, Floats, Floats], dict[str, Floats]]


@dataclass
class _Batch:
    """Pieces of one evaluation: ``place`` (stretch, first, last), ``stats`` (4, signals, pieces), ``columns``, and
    where their values lie."""

    stretch: Indices
    first: Floats
    last: Floats
    chunk: Indices
    column: Indices
    stats: Floats
    columns: dict[str, Floats]
    unmet: Flags = field(default_factory=lambda: np.empty(0, dtype=np.bool_))

    def taken(self, chosen: Indices | Flags) -> _Batch:
        """Some of the pieces."""
        return _Batch(
            self.stretch[chosen],
            self.first[chosen],
            self.last[chosen],
            self.chunk[chosen],
            self.column[chosen],
            self.stats[:, :, chosen],
            {name: each[chosen] for name, each in self.columns.items()},
            self.unmet[chosen],
        )


class Pieces:
    """Signals on pieces of a layout and on the halves of those that are not met.

    ``stretch``, ``first`` and ``last`` share of it, ``design``: (pieces,); ``top``, ``bottom``, ``rough`` (size of
    the last orders), ``mean_values`` (mean): (signals, pieces); ``size``: (signals, designs); ``unmet`` (designs,): a
    piece that matters is not met, and is halved no more.
    """

    def __init__(
        self, signals: Signals, layout: Layout, stretch: Indices, first: Floats, last: Floats, wanted: Wanted
    ) -> None:
        self.designs, self.wanted = layout.designs, wanted
        self._chunks: list[Floats] = []
        self._signals = np.array([k for k, _ in wanted.sides], dtype=np.intp)
        self._below = np.array([sign < 0.0 for _, sign in wanted.sides], dtype=np.intp)
        self._best = np.full((len(wanted.sides), self.designs), -np.inf)
        self._owner, self._length = layout.design, np.ones(self.designs)
        self._noise = np.zeros((len(wanted.even) + len(wanted.sides), self.designs), dtype=np.bool_)
        self.size: Floats = np.empty(0)
        done, most = list[_Batch](), np.zeros(self.designs, dtype=np.intp)
        crowd = wanted.crowd + 4 * np.bincount(layout.design[stretch], minlength=self.designs)
        for turn in range(HALVINGS):
            batch = self._evaluated(signals, layout.columns(stretch, first, last), stretch, first, last)
            done.append(batch)
            if turn + 1 == HALVINGS or not batch.unmet.any():
                break
            design = layout.design[stretch]
            count = np.bincount(design[batch.unmet], minlength=self.designs)
            if turn < EARLY:
                most = np.maximum(most, count)
            bearable = crowd if turn < EARLY else np.minimum(crowd, 2 * most + MANY)
            if (count > bearable).any():
                batch.unmet, count = self._without_noise(design, bearable)
            halved = batch.unmet & (count <= bearable)[design]
            if not halved.any():
                break
            done[-1] = batch.taken(~halved)
            stretch, first, last = np.repeat(stretch[halved], 2), first[halved], last[halved]
            middle = 0.5 * (first + last)
            first, last = np.stack([first, middle], axis=1).ravel(), np.stack([middle, last], axis=1).ravel()
        self._take(done[0] if len(done) == 1 else _joined(done))

    def _take(self, batch: _Batch) -> None:
        self.stretch, self.first, self.last, self.columns = (batch.stretch, batch.first, batch.last, batch.columns)
        self._chunk, self._column = batch.chunk, batch.column
        self.top, self.bottom, self.rough, self.mean_values = batch.stats
        self.design = self._owner[self.stretch]
        self.starts = np.searchsorted(self.design, np.arange(self.designs))
        self.width = self.columns[HIGH] - self.columns[LOW]
        self.period = self.total(self.width)
        self.unmet = self._noise.any(axis=0)
        self.unmet |= np.bincount(self.design[batch.unmet], minlength=self.designs) > 0

    def _evaluated(
        self, signals: Signals, columns: dict[str, Floats], stretch: Indices, first: Floats, last: Floats
    ) -> _Batch:
        """New pieces with what is asked of their values, and which of them are not met."""
        values = signals(columns, NODES)
        number = len(self._chunks)
        self._chunks.append(values)
        flat, shape, design = values.reshape(POINTS, -1), values.shape[1:], self._owner[stretch]
        stats = np.empty((4, *shape))
        values.max(axis=0, out=stats[0]), values.min(axis=0, out=stats[1])
        orders = product(LAST_AND_MEAN, flat).reshape(-1, *shape)
        np.abs(orders[:3]).max(axis=0, out=stats[2])
        stats[3], (top, bottom, rough) = orders[3], stats[:3]
        if self.wanted.joined:
            left, right = product(TO_ENDS, flat).reshape(2, *shape)
            same = (stretch[1:] == stretch[:-1]) & (first[1:] == last[:-1])
            with np.errstate(invalid="ignore"):
                gap = np.abs(left[:, 1:] - right[:, :-1]) * same
            for side in (rough[:, 1:], rough[:, :-1]):
                np.maximum(side, gap, out=side)
        ways = np.stack([top, -bottom])
        highest = ways[self._below, self._signals]
        starts = begins(design)
        there, width = design[starts], columns[HIGH] - columns[LOW]
        if not number:
            self.size = np.full((shape[0], self.designs), -np.inf)
            self._length[there] = np.add.reduceat(width, starts)
        for known, new in ((self.size, ways.max(axis=0)), (self._best, highest)):
            known[:, there] = np.maximum(known[:, there], np.maximum.reduceat(new, starts, axis=1))
        unmet = self._unmet(design, width, stats[:3], highest)
        places = np.full(len(design), number), np.arange(len(design))
        return _Batch(stretch, first, last, *places, stats, columns, unmet)

    def _unmet(self, design: Indices, width: Floats, stats: Floats, highest: Floats) -> Flags:
        """Pieces that are not met, and matter."""
        limit, share = self.wanted.met * self._sizes(), width / self._length[design]
        found, coarse = np.zeros(len(design), dtype=np.bool_), (stats[2] > limit[:, design]).any(axis=0)
        at = np.flatnonzero(coarse & (share > NARROW) & self.passed[design])
        self._last = at, np.empty((len(self._noise), 0), dtype=np.bool_)
        if not len(at):
            return found
        limit, even, own = limit[:, design[at]], [*self.wanted.even], self._signals
        top, bottom, rough = stats[:, :, at]
        matters = rough[even] * np.minimum(1.0, share[at] / self.wanted.wide) > limit[even]
        reach = highest[:, at] + SLACK * (top - bottom)[own] + HIDDEN * rough[own]
        near = (reach >= self._best[:, design[at]]) | (rough[own] * self.wanted.met > BLIND * limit[own])
        unmet = np.concatenate([matters, near & (rough > limit)[own]]) & ~self._noise[:, design[at]]
        self._last = at, unmet
        found[at] = unmet.any(axis=0)
        return found

    def _without_noise(self, design: Indices, bearable: Indices) -> tuple[Flags, Indices]:
        """The last pieces that are unmet for other signals than those that more pieces than bearable do not meet, and
        how many these are, (designs,): noise of one signal is no reason to leave another one unmet."""
        at, unmet = self._last
        counts = [np.bincount(design[at[row]], minlength=self.designs) for row in unmet]
        self._noise |= np.stack(counts) > bearable
        found = np.zeros(len(design), dtype=np.bool_)
        found[at] = (unmet & ~self._noise[:, design[at]]).any(axis=0)
        return found, np.bincount(design[found], minlength=self.designs)

    @property
    def passed(self) -> Flags:
        """Designs whose signals are numbers everywhere, (designs,)."""
        return np.asarray(np.isfinite(self.size).all(axis=0))

    def _sizes(self) -> Floats:
        """Sizes of the signals, at least a share of the largest of their dimension."""
        if not self.wanted.same_dimension:
            return self.size
        found = self.size.copy()
        for rows in self.wanted.same_dimension:
            found[rows] = np.maximum(found[rows], SIZE_SHARE * self.size[rows].max(axis=0))
        return found

    def values(self, signals: Indices | int, pieces: Indices | None = None) -> Floats:
        """Values (POINTS, k) of signals, of each in one of the pieces, or of one in all of them."""
        pieces = np.arange(len(self.stretch)) if pieces is None else pieces
        signals = np.broadcast_to(signals, pieces.shape)
        if len(self._chunks) == 1:
            return self._chunks[0][:, signals, self._column[pieces]]
        found, chunk, column = np.empty((POINTS, len(pieces))), self._chunk[pieces], self._column[pieces]
        for number, values in enumerate(self._chunks):
            mine = np.flatnonzero(chunk == number)
            found[:, mine] = values[:, signals[mine], column[mine]]
        return found

    # by design ------------------------------------------------------------------------------------------
    def each(self, of_designs: NDArray[Number]) -> NDArray[Number]:
        """What belongs to a design, at its pieces."""
        return of_designs[..., self.design]

    def total(self, of_pieces: Floats) -> Floats:
        """Sums over the pieces of every design."""
        return np.add.reduceat(of_pieces, self.starts, axis=-1)

    def most(self, of_pieces: Floats) -> Floats:
        """The largest over the pieces of every design."""
        return np.maximum.reduceat(of_pieces, self.starts, axis=-1)

    # means ----------------------------------------------------------------------------------------------
    def mean(self, k: int | list[int]) -> Floats:
        """The mean over time of a signal, (designs,), or of some."""
        return self.total(self.mean_values[k] * self.width) / self.period

    def mean_square(self, k: int) -> Floats:
        """The mean over time of its square, (designs,)."""
        return self.total(WEIGHTS @ self.values(k) ** 2 * self.width) / self.period

    def excess(self, k: int, mean: Floats) -> Floats:
        """The integral over time of what a signal lacks of its mean, up to every node, (POINTS, pieces)."""
        lack = (self.each(mean) - self.values(k)) * self.width
        return np.asarray(self._before(WEIGHTS @ lack) + product(UP_TO, lack))

    def _before(self, of_pieces: Floats) -> Floats:
        """Sums over the pieces of the same design before each, (pieces,)."""
        number = np.arange(len(of_pieces)) - self.starts[self.design]
        rows = np.zeros((self.designs, int(number.max(initial=0)) + 1))
        rows[self.design, number] = of_pieces
        return np.asarray((np.cumsum(rows, axis=1) - rows)[self.design, number])

    def through_excess(self, k: int, mean: Floats, weight: Floats) -> tuple[Floats, Floats]:
        """From derivatives (POINTS, pieces) by the excess at the nodes those by the signal there, and by the widths
        of the pieces; the mean changes with both."""
        mean_values = weight.sum(axis=0)
        after = self.each(self.total(mean_values)) - self._before(mean_values) - mean_values
        upto = product(UP_TO.T, weight) + WEIGHTS[:, None] * after
        lack = self.each(mean) - self.values(k)
        by_mean = self.total((upto * self.width).sum(axis=0))
        share = self.each(by_mean / self.period)
        by_signal = WEIGHTS[:, None] * self.width * share - upto * self.width
        return by_signal, (upto * lack).sum(axis=0) - (WEIGHTS @ lack) * share

    def contenders(
        self, sides: Sequence[tuple[int, float]], parts: Sequence[Flags | None]
    ) -> tuple[Floats, Indices, Indices]:
        """Values (POINTS, k) times the sign of all sides on the pieces that may hold their largest one, with the
        number of the side and the piece; every piece where nothing is a number.

        ``parts``: the pieces in which a side is asked for, None for all.
        """
        signals = np.array([k for k, _ in sides], dtype=np.intp)
        signs = np.array([sign for _, sign in sides])
        highest = np.where(signs[:, None] > 0.0, self.top[signals], -self.bottom[signals])
        for n, part in enumerate(parts):
            if part is not None:
                highest[n] = np.where(part, highest[n], -np.inf)
        reach = highest + SLACK * (self.top - self.bottom)[signals] + HIDDEN * self.rough[signals]
        side, piece = np.nonzero(~(reach < self.each(self.most(highest))))
        return self.values(signals[side], piece) * signs[side], side, piece

    def unresolved(self, signals: Indices, pieces: Indices) -> Flags:
        """Whether the polynomial of a signal does not meet it in a piece, so that its values between nodes are
        none of the signal's."""
        limit = self.wanted.met * self._sizes()
        return np.asarray(self.rough[signals, pieces] > limit[signals, self.design[pieces]])


def _joined(batches: Sequence[_Batch]) -> _Batch:
    """All pieces by stretch and share."""

    def row(name: str) -> Any:
        return np.concatenate([getattr(each, name) for each in batches])

    columns = {name: np.concatenate([each.columns[name] for each in batches]) for name in batches[0].columns}
    stretch, first, last, chunk, column, unmet = map(row, ("stretch", "first", "last", "chunk", "column", "unmet"))
    stats = np.concatenate([each.stats for each in batches], axis=2)
    found = _Batch(stretch, first, last, chunk, column, stats, columns, unmet)
    return found.taken(np.lexsort((first, stretch)))
