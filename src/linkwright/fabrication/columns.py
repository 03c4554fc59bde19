"""The axes of a machine side by side: in which order, and what lies between them in every layer.

A section through all pins, developed into one plane, shows what is on each pin. Links are bars from pin to pin; the
order of the pins is that in which bars get least in each other's way.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

#: What a break in a bar costs, in gaps between columns by which bars are longer.
_BREAK = 4.0
#: What it costs that two columns are not in their first order.
_TURNED = 0.02


@dataclass(frozen=True)
class Column:
    """An axis: what stands on it between two heights, m, as a pin, a post or a block."""

    name: str
    low: float
    high: float


@dataclass(frozen=True)
class Bar:
    """A plate between two heights, m, and the numbers of the columns in which it is."""

    name: str
    low: float
    high: float
    columns: frozenset[int]

    def meets(self, other: Bar | Column) -> bool:
        """Whether both have heights in common."""
        return self.low < other.high - 1e-9 and other.low < self.high - 1e-9


@dataclass(frozen=True)
class Piece:
    """A piece of a bar between the columns at two places in the order; whether it breaks off to the left of the first
    and to the right of the last one."""

    bar: Bar
    first: int
    last: int
    broken_left: bool
    broken_right: bool


@dataclass(frozen=True, eq=False)
class Development:
    """Columns in an ``order``, and the bars between them; the numbers of the columns are their first order."""

    columns: Sequence[Column]
    bars: Sequence[Bar]
    order: tuple[int, ...]

    def places(self, bar: Bar) -> list[int]:
        """Where in the order the columns of a bar are, from left to right."""
        return [k for k, column in enumerate(self.order) if column in bar.columns]

    def clear(self, bar: Bar, one: int, other: int) -> bool:
        """Whether nothing is in a bar's way between two places in the order."""
        between = self.order[one + 1 : other]
        others = (each for each in self.bars if each.meets(bar) and each is not bar)
        return not any(bar.meets(self.columns[k]) for k in between) and not any(
            each.columns.intersection(between) for each in others
        )

    @property
    def cost(self) -> float:
        """How far apart the columns of bars are, and how often bars break."""
        cost = 0.0
        for bar in self.bars:
            for one, other in pairwise(self.places(bar)):
                cost += other - one
                cost += 0.0 if other == one + 1 or self.clear(bar, one, other) else _BREAK
        turned = sum(one > other for one, other in combinations(self.order, 2))
        return cost + _TURNED * turned

    def pieces(self) -> Iterator[Piece]:
        """The bars in pieces: each goes on to its next column where nothing is in its way."""
        for bar in self.bars:
            own = self.places(bar)
            first, left = own[0], False
            for one, other in pairwise(own):
                if not self.clear(bar, one, other):
                    yield Piece(bar, first, one, left, True)
                    first, left = other, True
            yield Piece(bar, first, own[-1], left, False)

    def improved(self) -> Development:
        """The order in which bars break least, found by moving one column at a time."""
        found, cost = self, self.cost
        while True:
            options = list(found._moved())
            costs = [each.cost for each in options]
            if not costs or min(costs) >= cost - 1e-9:
                return found
            cost = min(costs)
            found = options[costs.index(cost)]

    def _moved(self) -> Iterator[Development]:
        """The same with one column elsewhere."""
        for column in self.order:
            rest = [each for each in self.order if each != column]
            for k in range(len(self.order)):
                yield Development(self.columns, self.bars, (*rest[:k], column, *rest[k:]))
