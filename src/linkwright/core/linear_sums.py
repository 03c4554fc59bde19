"""Sums of quantities that are zero, each solved for one of them (Gauss)."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
#: Factors below this share of the largest one of their sum are zero.
SMALL = 1e-9


class LinearSums(Generic[Key]):
    """Quantities that others determine: ``solved`` gives their factors by these others, and a constant."""

    def __init__(self) -> None:
        self.solved: dict[Key, tuple[dict[Key, float], float]] = {}

    def add(
        self, terms: Mapping[Key, float], rest: float = 0.0, order: Callable[[Key], float] = lambda _: 0.0
    ) -> bool:
        """Adds Σ factor · quantity + ``rest`` = 0; False if it follows from the sums before.

        It is solved for the quantity of the highest ``order``, of several for the one with the largest factor, never
        for one of the order -∞.
        """
        negligible = SMALL * max(map(abs, terms.values()), default=0.0)
        left, rest = self.reduced(terms, rest)
        left = {key: factor for key, factor in left.items() if abs(factor) > negligible}
        free = [key for key in left if order(key) > -float("inf")]
        if not free:
            return False
        pivot = max(free, key=lambda key: (order(key), abs(left[key])))
        lead = left.pop(pivot)
        self.solved[pivot] = {key: -factor / lead for key, factor in left.items()}, -rest / lead
        for key, found in self.solved.items():
            if pivot in found[0]:
                self.solved[key] = self.reduced(*found)
        return True

    def reduced(self, terms: Mapping[Key, float], rest: float = 0.0) -> tuple[dict[Key, float], float]:
        """A sum with the quantities that others determine replaced by these."""
        found: dict[Key, float] = {}
        for key, factor in terms.items():
            inner, constant = self.solved.get(key, ({key: 1.0}, 0.0))
            rest += factor * constant
            for each, share in inner.items():
                found[each] = found.get(each, 0.0) + factor * share
        return found, rest
