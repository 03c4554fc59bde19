"""Stored outputs by name, and further ones evaluated when somebody asks."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from linkwright.core.frozen import locked

Floats = NDArray[np.float64]


class Rows:
    """``values`` (outputs, n) with the row number of every name in ``index``; ``extra`` rows by name."""

    __slots__ = ("extra", "index", "values")

    def __init__(self, values: Floats, index: Mapping[str, int]) -> None:
        self.values = values
        self.index = index
        self.extra: dict[str, Floats] = {}

    def row(self, name: str) -> Floats:
        """A stored row, (n,)."""
        return locked(self.values[self.index[name]])

    def pair(self, names: tuple[str, str], evaluate: Callable[[tuple[str, ...]], Floats]) -> Floats:
        """The two components of a vector output, (n, 2); a view of the stored rows where they lie together."""
        first = self.index.get(names[0])
        if first is not None and self.index.get(names[1]) == first + 1:
            return locked(self.values[first : first + 2].T)
        return locked(np.stack(self.fetch(names, evaluate), axis=1))

    def fetch(self, names: tuple[str, ...], evaluate: Callable[[tuple[str, ...]], Floats]) -> list[Floats]:
        """The rows of some outputs, (n,) each; ``evaluate`` supplies those that are not stored."""
        missing = tuple(name for name in names if name not in self.index and name not in self.extra)
        if missing:
            self.extra.update(zip(missing, map(locked, evaluate(missing)), strict=True))
        return [self.row(name) if name in self.index else self.extra[name] for name in names]
