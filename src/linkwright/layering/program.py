"""Layers as an integer linear program: whether a number of layers is enough, and which are best."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.layering.cliques import Piece, cliques
from linkwright.layering.problem import Problem


@dataclass(frozen=True)
class Presence:
    """How much of a body is in each layer from 0 to one above the last, as an affine function of the unknowns: the
    entries of a sparse matrix (layers, unknowns) and what is added (layers,)."""

    rows: Any
    columns: Any
    values: Any
    constant: Floats


@dataclass(frozen=True)
class Answer:
    """The layer of every plate, None where there is no answer; ``proved``: that there is none, or none better."""

    layer: Mapping[str, int] | None
    proved: bool


class Program:
    """A problem with so many layers above the base.

    Unknowns: of every plate (of those that are level the first one) and every layer 1 if it lies there; of a body
    between several plates and every layer whether it begins there or below, and whether it ends there or above. The
    latter are 0 or 1 wherever the former are, so that only these need be integers. Time-indexed, as scheduling calls
    it: bodies that are all apart from each other are one inequality in each layer.
    """

    def __init__(self, problem: Problem, layers: int) -> None:
        self.problem, self.layers = problem, layers
        self.groups = {name: i for i, name in enumerate(dict.fromkeys(problem.leader.values()))}
        reaching = (name for name, plates in problem.spans.items() if len(plates) > 1)
        self.reaching = {name: i for i, name in enumerate(reaching)}
        self.size = layers + 1
        self.count = self.size * (len(self.groups) + 2 * len(self.reaching))
        self._entries: list[tuple[Any, Any, Any]] = []
        self._low: list[Floats] = []
        self._high: list[Floats] = []
        self._rows = 0
        self._add_plates()
        for name in self.reaching:
            self._add_span(name)
        for each in cliques(problem):
            self._add_apart(each)

    def solve(self, time_limit: float) -> Answer:
        """The layers of all plates with the shortest pins, then with plates as near as can be to the frame."""
        from scipy.optimize import Bounds, LinearConstraint, milp
        from scipy.sparse import csr_array

        domains = self._domains()
        if not domains.reshape(-1, self.size).any(axis=1).all():
            return Answer(None, True)
        high = np.ones(self.count)
        high[: len(domains)] = domains
        rows, columns, values = (np.concatenate(each) for each in zip(*self._entries, strict=True))
        matrix = csr_array((values, (rows, columns)), shape=(self._rows, self.count))
        found = milp(
            self._costs(),
            constraints=LinearConstraint(matrix, np.concatenate(self._low), np.concatenate(self._high)),
            bounds=Bounds(0.0, high),
            integrality=np.arange(self.count) < len(domains),
            options={"time_limit": time_limit, "mip_rel_gap": 0.0},
        )
        if found.x is None:
            return Answer(None, found.status == 2)
        layer = found.x[: len(domains)].reshape(-1, self.size).argmax(axis=1)
        of_plate = {plate: int(layer[self.groups[first]]) for plate, first in self.problem.leader.items()}
        return Answer(of_plate, found.status == 0)

    def _domains(self) -> Floats:
        """Layers in which each group of plates may lie, 0 or 1, (groups · layers,)."""
        problem, leader = self.problem, self.problem.leader
        allowed = np.ones((len(self.groups), self.size))
        allowed[:, 0] = 0.0
        if problem.cover:
            allowed[:, -1] = 0.0
        for plate, end in ((problem.base, 0), (problem.cover, self.layers)):
            if plate:
                allowed[self.groups[leader[plate]]] = np.arange(self.size) == end
        for plate, layer in problem.fixed.items():
            if layer == 0:
                allowed[self.groups[leader[plate]], 0] = 1.0
        for plate, layer in problem.fixed.items():
            if layer is not None:
                allowed[self.groups[leader[plate]]] *= np.arange(self.size) == layer
        return allowed.ravel()

    def _costs(self) -> Floats:
        """Layers through which bodies reach, and far less the layers in which plates lie."""
        members = [*self.problem.leader.values()]
        plates = np.outer([members.count(each) for each in self.groups], np.arange(self.size)).ravel()
        spans = np.full(2 * self.size * len(self.reaching), 1.0 + self.layers * len(members))
        return np.concatenate([plates, spans])

    def _plate(self, group: str) -> Any:
        return self.size * self.groups[group] + np.arange(self.size)

    def _begun(self, name: str) -> Any:
        return self.size * (len(self.groups) + 2 * self.reaching[name]) + np.arange(self.size)

    def _unended(self, name: str) -> Any:
        return self._begun(name) + self.size

    def _add_rows(self, low: Any, high: Any, *entries: tuple[Any, Any, Any]) -> None:
        """Rows of inequalities, each with entries (row, column, value)."""
        low, high = np.broadcast_arrays(low, high)
        for rows, columns, values in entries:
            shape = np.broadcast_shapes(np.shape(rows), np.shape(columns), np.shape(values))
            parts = (np.broadcast_to(each, shape).ravel() for each in (rows, columns, values))
            rows, columns, values = parts
            self._entries.append((rows + self._rows, columns, values))
        self._low.append(np.asarray(low, dtype=float))
        self._high.append(np.asarray(high, dtype=float))
        self._rows += len(low)

    def _add_plates(self) -> None:
        """Every plate lies in one layer."""
        count = len(self.groups)
        entries = np.repeat(np.arange(count), self.size), np.arange(count * self.size), 1.0
        self._add_rows(np.ones(count), np.ones(count), entries)

    def _add_span(self, name: str) -> None:
        """Where a body begins and ends: with its lowest and its highest plate."""
        layers, begun, unended = np.arange(self.size), self._begun(name), self._unended(name)
        plates = [self._plate(group) for group in self.problem.spans[name]]
        row, reached = np.nonzero(layers[:, None] >= layers)
        for own, order in ((begun, layers), (unended[::-1], layers[::-1])):
            sums = [(row, plate[order][reached], -1.0) for plate in plates]
            for each in sums:
                self._add_rows(np.zeros(self.size), np.inf, (layers, own, 1.0), each)
            self._add_rows(np.full(self.size, -np.inf), 0.0, (layers, own, 1.0), *sums)
            later = layers[:-1]
            self._add_rows(np.zeros(self.layers), np.inf, (later, own[1:], 1.0), (later, own[:-1], -1.0))
        self._add_rows(np.ones(self.size), np.inf, (layers, begun, 1.0), (layers, unended, 1.0))
        reach = [(np.zeros(1, dtype=int), each[:, None], 1.0) for each in (begun, unended)]
        self._add_rows(np.full(1, self.size + self._mutual(self.problem.spans[name])), np.inf, *reach)

    def _mutual(self, groups: tuple[str, ...]) -> int:
        """How many of some plates are surely in different layers: a greedy choice of those apart in pairs."""
        chosen: list[str] = []
        for group in groups:
            if all(frozenset((group, other)) in self._plates_apart for other in chosen):
                chosen.append(group)
        return len(chosen)

    @cached_property
    def _plates_apart(self) -> frozenset[frozenset[str]]:
        """Pairs of groups that are never in one layer."""
        leader, spans = self.problem.leader, self.problem.spans
        special = [leader[each] for each in (self.problem.base, self.problem.cover) if each]
        found = {frozenset((one, other)) for one in special for other in self.groups}
        for each in self.problem.apart:
            one, other = spans[each.first], spans[each.second]
            if each.parts == ("body", "body") and len(one) == len(other) == 1:
                found.add(frozenset((*one, *other)))
        return frozenset(found)

    def _add_apart(self, pieces: Iterable[Piece]) -> None:
        """In every layer at most one of some bodies or heads that are all apart."""
        found = [(self._body if part == "body" else self._heads)(name) for name, part in pieces]
        entries = ((each.rows, each.columns, each.values) for each in found)
        limit = 1.0 - np.sum([each.constant for each in found], axis=0)
        self._add_rows(np.full(self.size + 1, -np.inf), limit, *entries)

    def _body(self, name: str) -> Presence:
        """Where the body itself is."""
        spans, layers = self.problem.spans[name], np.arange(self.size)
        constant = np.zeros(self.size + 1)
        if not spans:
            constant[:-1] = 1.0
            return Presence(layers[:0], layers[:0], np.zeros(0), constant)
        if len(spans) == 1:
            return Presence(layers, self._plate(spans[0]), np.ones(self.size), constant)
        constant[:-1] = -1.0
        columns = np.concatenate([self._begun(name), self._unended(name)])
        return Presence(np.tile(layers, 2), columns, np.ones(2 * self.size), constant)

    def _heads(self, name: str) -> Presence:
        """Where its heads are: in the layer below the lowest plate and in that above the highest one."""
        spans, layers = self.problem.spans[name], np.arange(self.size)
        constant, ones = np.zeros(self.size + 1), np.ones(self.size)
        above = layers + 1 if not self.problem.cover else layers[:-1] + 1
        if not spans:
            return Presence(layers[:0], layers[:0], np.zeros(0), constant)
        if len(spans) == 1:
            plate = self._plate(spans[0])
            rows, columns = np.concatenate([layers[:-1], above]), np.concatenate([plate[1:], plate[: len(above)]])
            return Presence(rows, columns, np.ones(len(rows)), constant)
        begun, unended = self._begun(name), self._unended(name)
        entries = [
            (layers[:-1], begun[1:], ones[1:]),
            (layers[:-1], begun[:-1], -ones[1:]),
            (above, unended[: len(above)], ones[: len(above)]),
            (above[: self.layers], unended[1:], -ones[1:]),
        ]
        rows, columns, values = (np.concatenate(each) for each in zip(*entries, strict=True))
        return Presence(rows, columns, values, constant)
