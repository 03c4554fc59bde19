"""Arrays by the kind of their numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Integers = NDArray[np.int64]
Indices = NDArray[np.intp]
Flags = NDArray[np.bool_]
#: Share of the largest size of some values within which two of them are equal: which is larger is rounding.
EQUAL = 1e-12


def begins(owner: Indices) -> Indices:
    """The number of the first of every run of equal owners."""
    first = np.ones(len(owner), dtype=np.bool_)
    np.not_equal(owner[1:], owner[:-1], out=first[1:])
    return first.nonzero()[0]


def runs(flags: Flags) -> list[tuple[int, int]]:
    """The numbers of the first and the last one of every run of true ones."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    return [(first, end - 1) for first, end in edges.reshape(-1, 2).tolist()]


def largest(values: Floats) -> float:
    """Largest size of the numbers that are finite; 0 where there is none."""
    return float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
