"""Closed polygons: whether they cross, which lies within which, and what boxes overlap."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Indices
from linkwright.shapes.distance import contains, from_sides
from linkwright.shapes.loop import Edge, Loop
from linkwright.shapes.shape import polygon

#: Turn (sine) below which a corner is none, and the cosine below which a side turns back on the one before it.
STRAIGHT, BACK = 1e-12, -1.0 + 1e-9


def overlapping(low: Complexes, high: Complexes) -> tuple[Indices, Indices]:
    """Pairs of boxes (k,) that overlap or touch: numbers of the one and of the other."""
    order = np.argsort(low.real, kind="stable")
    # of all that begin further right those overlap in x that begin before a box ends
    counts = np.searchsorted(low.real[order], high.real[order], side="right") - np.arange(len(order)) - 1
    one = np.repeat(np.arange(len(order)), counts)
    other = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(counts) - counts, counts)
    first, second = order[one], order[other]
    both = (low.imag[first] <= high.imag[second]) & (low.imag[second] <= high.imag[first])
    return first[both], second[both]


def clear_of_each_other(rings: Sequence[Complexes], near: float) -> bool:
    """Whether no two sides of some rings come nearer to each other than ``near`` (m) but those that follow each
    other, of which none turns back."""
    start = np.concatenate(rings)
    end = np.concatenate([np.roll(ring, -1) for ring in rings])
    after = np.concatenate(
        [np.roll(np.arange(len(ring)), -1) + first for ring, first in zip(rings, _firsts(rings), strict=True)]
    )
    way = end - start
    length = np.abs(way)
    if length.min() <= near or ((way.conj() * way[after]).real < BACK * length * length[after]).any():
        return False
    corner = near * (1 + 1j)
    low, high = (each(start.real, end.real) + 1j * each(start.imag, end.imag) for each in (np.minimum, np.maximum))
    one, other = overlapping(low - corner, high + corner)
    apart = (after[one] != other) & (after[other] != one)
    one, other = one[apart], other[apart]
    sides = ((start[one], way[one]), (start[other], way[other]))
    if (_across(*sides[0], *sides[1]) & _across(*sides[1], *sides[0])).any():
        return False
    places = ((*sides[0], start[other]), (*sides[0], end[other]), (*sides[1], start[one]), (*sides[1], end[one]))
    return all(bool((np.abs(from_sides(*each)) > near).all()) for each in places)


def loops_of(rings: Sequence[Complexes]) -> list[Loop]:
    """Loops along rings that are clear of each other: those within an even number of others counter-clockwise first,
    each kind in order of size, the others clockwise."""
    found = []
    for number, ring in enumerate(rings):
        others = (polygon(other) for other in (*rings[:number], *rings[number + 1 :]))
        depth = sum(bool(contains(other, ring[:1])[0]) for other in others)
        loop = Loop(tuple(map(Edge, ring.tolist(), np.roll(ring, -1).tolist())))
        found.append(loop if (loop.area > 0.0) == (depth % 2 == 0) else loop.reversed)
    return sorted(found, key=lambda loop: (loop.area < 0.0, -abs(loop.area)))


def bent(ring: Complexes, near: float) -> Complexes:
    """The corners of a ring at which it bends, without those at the place of the one before."""
    ring = ring[np.abs(np.roll(ring, 1) - ring) > near]
    before, behind = ring - np.roll(ring, 1), np.roll(ring, -1) - ring
    turn = before.conj() * behind
    return np.asarray(ring[(np.abs(turn.imag) > STRAIGHT * np.abs(turn)) | (turn.real < 0.0)])


def _firsts(rings: Sequence[Complexes]) -> list[int]:
    return [*accumulate(map(len, rings[:-1]), initial=0)]


def _across(start: Complexes, way: Complexes, other: Complexes, along: Complexes) -> Flags:
    """Whether sides have both ends of others on different sides of their lines."""
    from_start = (way.conj() * (other - start)).imag
    return np.asarray(from_start * (way.conj() * (other + along - start)).imag < 0.0)
