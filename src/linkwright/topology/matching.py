"""Maximum matching and strongly connected components of small sparse graphs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence


def maximum_matching(choices: Sequence[Sequence[int]], places: int) -> tuple[list[int], list[int]]:
    """Gives every row one of its possible places, as many rows as can be.

    Augmenting paths (Kuhn 1955). Returns the place of each row and the row of each place, -1 for none.
    """
    place_of = [-1] * len(choices)
    row_of = [-1] * places
    for row in range(len(choices)):
        _augment(row, choices, place_of, row_of)
    return place_of, row_of


def _augment(start: int, choices: Sequence[Sequence[int]], place_of: list[int], row_of: list[int]) -> None:
    """Breadth-first search for a free place, then the exchange along the path."""
    came_from: dict[int, int] = {}
    rows = [start]
    for row in rows:
        for place in choices[row]:
            if place in came_from:
                continue
            came_from[place] = row
            if row_of[place] < 0:
                _exchange(place, start, came_from, place_of, row_of)
                return
            rows.append(row_of[place])


def _exchange(place: int, start: int, came_from: Mapping[int, int], place_of: list[int], row_of: list[int]) -> None:
    while True:
        row = came_from[place]
        previous = place_of[row]
        place_of[row], row_of[place] = place, row
        if row == start:
            return
        place = previous


def components(successors: Sequence[Sequence[int]]) -> list[list[int]]:
    """Strongly connected components (Tarjan 1972), each after the ones that it points to."""
    search = _Search(successors)
    for vertex in range(len(successors)):
        if search.order[vertex] < 0:
            search.visit(vertex)
    return search.found


class _Search:
    """State of Tarjan's depth-first search."""

    def __init__(self, successors: Sequence[Sequence[int]]) -> None:
        self.successors = successors
        self.order = [-1] * len(successors)
        self.low = [0] * len(successors)
        self.stack: list[int] = []
        self.on_stack = [False] * len(successors)
        self.count = 0
        self.found: list[list[int]] = []

    def visit(self, root: int) -> None:
        work = [(root, iter(self.successors[root]))]
        self._enter(root)
        while work:
            vertex, neighbours = work[-1]
            for other in neighbours:
                if self.order[other] < 0:
                    self._enter(other)
                    work.append((other, iter(self.successors[other])))
                    break
                if self.on_stack[other]:
                    self.low[vertex] = min(self.low[vertex], self.order[other])
            else:
                work.pop()
                if work:
                    parent = work[-1][0]
                    self.low[parent] = min(self.low[parent], self.low[vertex])
                if self.low[vertex] == self.order[vertex]:
                    self._close(vertex)

    def _enter(self, vertex: int) -> None:
        self.order[vertex] = self.low[vertex] = self.count
        self.count += 1
        self.stack.append(vertex)
        self.on_stack[vertex] = True

    def _close(self, vertex: int) -> None:
        component = []
        while True:
            other = self.stack.pop()
            self.on_stack[other] = False
            component.append(other)
            if other == vertex:
                break
        self.found.append(sorted(component))
