"""Planes in which wheels run: those that mesh share one, and a wheel is several discs where one plane has no room."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from itertools import combinations, product
from typing import TypeVar

Runner = TypeVar("Runner", bound=Hashable)


def planes_of(
    pairs: Sequence[tuple[Runner, Runner]], collide: Callable[[Runner, Runner], bool]
) -> list[tuple[Runner, ...]]:
    """Planes such that both of each pair are in one of them, and no two that ``collide`` and are no pair.

    A pair joins its planes into one where that has room, else one of the two gets a disc in the plane of the other,
    else both get one in a new plane: of a differential, each mesh has a plane of its own.
    """
    known = {frozenset(pair) for pair in pairs}

    def has_room(members: Sequence[Runner]) -> bool:
        return not any(
            collide(a, b) for a, b in combinations(dict.fromkeys(members), 2) if frozenset((a, b)) not in known
        )

    planes: list[tuple[Runner, ...]] = []
    for a, b in pairs:
        if any(a in plane and b in plane for plane in planes):
            continue
        first, second = ([plane for plane in planes if each in plane] for each in (a, b))
        whole = [(p, q) for p, q in product(first or [(a,)], second or [(b,)]) if p is not q and has_room((*p, *q))]
        joining = whole or [(p, (b,)) for p in first if has_room((*p, b))]
        joining = joining or [(q, (a,)) for q in second if has_room((*q, a))] or [((a,), (b,))]
        p, q = joining[0]
        planes = [each for each in planes if each is not p and each is not q] + [(*p, *q)]
    return planes
