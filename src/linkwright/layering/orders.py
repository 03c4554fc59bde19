"""Whether there are layers at all, however many: orders of plates above each other that do not contradict.

Every demand says that one of two differences of layers is large enough: this body above that one, or that one above
this. What is known of the differences are longest paths in a graph, as in the disjunctive temporal problem (Stergiou
and Koubarakis, Backtracking algorithms for disjunctions of temporal constraints, Artificial Intelligence 120, 2000);
the search decides first what has led to most contradictions (Boussemart et al., ECAI 2004).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from time import monotonic
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.layering.problem import Part, Problem

#: That the second of two ends is at least so many layers above the first.
Difference = tuple[int, int, int]
#: Layers from the first end plus the second number to the third end plus the fourth number.
Interval = tuple[int, int, int, int]
NO_LAYER: Interval = (0, 0, 0, 0)


class Undecided(Exception):
    """The time is over before a search has found layers or proved that there are none."""


def any_layers(problem: Problem, until: float) -> dict[str, int] | None:
    """Some layers of all plates, seldom the fewest; None where there are none.

    Raises:
        Undecided: it is later than ``until`` (s, of the monotonic clock).
    """
    ends = Ends(problem)
    known = np.full((ends.count, ends.count), -np.inf)
    np.fill_diagonal(known, 0.0)
    for each in ends.certain():
        _learn(known, each)
    choices = [*ends.choices()]
    if any(not each for each in choices) or (known + known.T > 0.0).any():
        return None
    found = _Search(choices, until).solved(known)
    return None if found is None else {name: int(found[0, i]) for name, i in ends.plates.items()}


def _learn(known: Floats, difference: Difference) -> None:
    """Longest paths with one more edge."""
    low, high, least = difference
    np.maximum(known, known[:, low, None] + (least + known[high]), out=known)


@dataclass(frozen=True)
class Ends:
    """The unknown layers of a problem by number: the base, plates (of those that are level the first one), and of
    bodies between several plates the lowest and the highest one."""

    problem: Problem

    @cached_property
    def _groups(self) -> dict[str, int]:
        base = self.problem.leader.get(self.problem.base, "")
        return {name: i for i, name in enumerate(dict.fromkeys([base, *self.problem.leader.values()]))}

    @cached_property
    def plates(self) -> dict[str, int]:
        """Numbers of the plates that are in one layer."""
        return {plate: self._groups[first] for plate, first in self.problem.leader.items()}

    @cached_property
    def _reaching(self) -> dict[str, int]:
        reaching = (name for name, plates in self.problem.spans.items() if len(plates) > 1)
        return {name: len(self._groups) + 2 * i for i, name in enumerate(reaching)}

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self._groups) + 2 * len(self._reaching)

    def lowest(self, body: str) -> int:
        """The number of the lower end of a body."""
        return self._reaching[body] if body in self._reaching else self._groups[self.problem.spans[body][0]]

    def highest(self, body: str) -> int:
        """The number of the upper end of a body."""
        return self._reaching[body] + 1 if body in self._reaching else self._groups[self.problem.spans[body][0]]

    def certain(self) -> Iterator[Difference]:
        """Differences without a choice."""
        problem = self.problem
        cover = self._groups[problem.leader[problem.cover]] if problem.cover else 0
        at_base = {self.plates[plate] for plate, layer in problem.fixed.items() if layer == 0}
        for number in range(1, len(self._groups)):
            yield 0, number, 0 if number in at_base else 1
            if cover and number != cover:
                yield number, cover, 1
        for plate, layer in problem.fixed.items():
            if layer is not None:
                yield 0, self.plates[plate], layer
                yield self.plates[plate], 0, -layer
        for body, low in self._reaching.items():
            for plate in problem.spans[body]:
                yield low, self._groups[plate], 0
                yield self._groups[plate], low + 1, 0
        for body in self._free_of_walls():
            for number in range(len(self._groups)):
                yield number, self.highest(body), 0

    def choices(self) -> Iterator[list[Difference]]:
        """Differences of which at least one is to hold: one of the plates is the lowest, one the highest; of two
        bodies that are apart one is above the other."""
        for body, low in self._reaching.items():
            plates = [self._groups[each] for each in self.problem.spans[body]]
            yield [(plate, low, 0) for plate in plates]
            yield [(low + 1, plate, 0) for plate in plates]
        for each in self.problem.apart:
            first, second = zip((each.first, each.second), each.parts, strict=True)
            for one, other in product(self._intervals(*first), self._intervals(*second)):
                if one and other:
                    yield [_above(one, other), _above(other, one)]
                elif self.problem.cover or (one or other or NO_LAYER)[1] < 1:
                    yield []

    def _free_of_walls(self) -> Iterator[str]:
        """Bodies whose upper head is above a wall, which it can be if nothing covers the highest layer."""
        spans, cover = self.problem.spans, self.problem.leader.get(self.problem.cover)
        for each in self.problem.apart:
            names = each.first, each.second
            for body, part, other in zip(names, each.parts, reversed(names), strict=True):
                if part == "heads" and spans[body] and cover not in spans[body] and not spans[other]:
                    yield body

    def _intervals(self, body: str, part: Part) -> list[Interval | None]:
        """The layers of a body itself, or those of its heads: none below the base nor above the cover. None for all
        layers."""
        plates, leader = self.problem.spans[body], self.problem.leader
        if not plates:
            return [None] if part == "body" else []
        low, high = self.lowest(body), self.highest(body)
        if part == "body":
            return [(low, 0, high, 0)]
        heads: list[Interval | None] = []
        if leader.get(self.problem.base) not in plates:
            heads.append((low, -1, low, -1))
        if leader.get(self.problem.cover) not in plates:
            heads.append((high, 1, high, 1))
        return heads


def _above(one: Interval, other: Interval) -> Difference:
    """That an interval of layers lies above another one."""
    return other[2], one[0], 1 + other[3] - one[1]


class _Search:
    """A search through choices, depth first."""

    def __init__(self, choices: list[list[Difference]], until: float) -> None:
        self.until = until
        self.owner = np.repeat(np.arange(len(choices)), [len(each) for each in choices])
        options = [each for some in choices for each in some]
        self.low, self.high, self.least = np.array(options, dtype=int).reshape(-1, 3).T
        self.failures = np.ones(len(choices))

    def solved(self, known: Floats) -> Floats | None:
        """Longest paths with one difference of each choice; None where there is no such choice."""
        stack = [known]
        while stack:
            if monotonic() > self.until:
                raise Undecided
            known = stack.pop()
            open_ = self._propagated(known)
            if open_ is None:
                continue
            if not open_.any():
                return known
            stack += self._branches(known, open_)[::-1]
        return None

    def _propagated(self, known: Floats) -> Any:
        """How many differences each choice has left, 0 of one that holds; None where one has none. What has no
        alternative is learned."""
        while True:
            possible = known[self.high, self.low] + self.least <= 0.0
            holds = known[self.low, self.high] >= self.least
            left = np.bincount(self.owner[possible], minlength=len(self.failures))
            if not left.all():
                self.failures[left == 0] += 1.0
                return None
            left[self.owner[holds]] = 0
            forced = np.flatnonzero(possible & (left[self.owner] == 1))
            if not len(forced):
                return left
            for option in forced:
                low, high, least = self.low[option], self.high[option], self.least[option]
                if known[high, low] + least > 0.0:
                    self.failures[self.owner[option]] += 1.0
                    return None
                if known[low, high] < least:
                    _learn(known, (low, high, least))

    def _branches(self, known: Floats, left: Any) -> list[Floats]:
        """One state for every difference of a choice, each without those before it."""
        choice = np.where(left > 0, left / self.failures, np.inf).argmin()
        options = np.flatnonzero((self.owner == choice) & (known[self.high, self.low] + self.least <= 0.0))
        heights = known[0, self.low[options]] + self.least[options]
        found = []
        for option in options[np.argsort(heights, kind="stable")]:
            low, high, least = self.low[option], self.high[option], self.least[option]
            if known[high, low] + least > 0.0:
                continue
            state = known.copy()
            _learn(state, (low, high, least))
            found.append(state)
            if known[low, high] + 1 - least > 0.0:
                break
            _learn(known, (high, low, 1 - least))
        return found
