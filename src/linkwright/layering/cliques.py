"""Bodies and heads of which at most one is in a layer: larger sets give linear programs closer bounds."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from linkwright.layering.problem import Part, Problem

#: A body or its heads.
Piece = tuple[str, Part]


def cliques(problem: Problem) -> Iterator[tuple[Piece, ...]]:
    """Sets of pieces that are apart in pairs, so that every pair of the problem is in one of them; each is as large
    as it can be, found by taking in first what is apart from most."""
    apart = _apart(problem)
    by_degree = sorted(apart, key=lambda piece: -len(apart[piece]))
    covered: set[frozenset[Piece]] = set()
    for each in problem.apart:
        pair = (each.first, each.parts[0]), (each.second, each.parts[1])
        if frozenset(pair) in covered:
            continue
        found = list(dict.fromkeys(pair))
        common = apart[pair[0]] & apart[pair[1]]
        for piece in by_degree:
            if piece in common:
                found.append(piece)
                common &= apart[piece]
        covered |= {frozenset(both) for both in combinations(found, 2)}
        yield tuple(found)


def _apart(problem: Problem) -> dict[Piece, set[Piece]]:
    """What each piece is apart from: by the demands, a body from its own heads, and these from its plates."""
    found: dict[Piece, set[Piece]] = {}

    def add(one: Piece, other: Piece) -> None:
        found.setdefault(one, set()).add(other)
        found.setdefault(other, set()).add(one)

    for each in problem.apart:
        add((each.first, each.parts[0]), (each.second, each.parts[1]))
    for name, part in [*found]:
        if part == "heads":
            for own in (name, *problem.bodies[name]):
                if own in problem.bodies and own not in problem.walls:
                    add((name, "heads"), (own, "body"))
    return found
