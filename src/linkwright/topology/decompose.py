"""Assur groups by the block triangular form of the link-freedom/constraint graph.

A maximum matching gives every equation the freedom that it determines; the strongly connected
components of the dependence between bodies are the Assur groups, and their order is the solving
order (Dulmage and Mendelsohn 1958; Assur 1913; Galletti, Mech. Mach. Theory 21, 1986).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Set

from linkwright.core.arguments import require
from linkwright.drivers.base import Driver
from linkwright.elements.topology import Connection, Group
from linkwright.joints.base import Joint
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure
from linkwright.topology.chains import make_group
from linkwright.topology.constraints import FRAME, ConstraintGraph
from linkwright.topology.matching import components, maximum_matching
from linkwright.topology.mobility import counts, explain_excess, explain_free, grubler, islands
from linkwright.topology.trains import gear_trains


def structure(mechanism: Mechanism) -> Structure:
    """Mobility and Assur groups of a mechanism with its drivers, in solving order.

    Raises:
        StructureError: the drivers do not determine the motion, or determine it more than once.
    """
    require(mechanism, Mechanism)
    graph = ConstraintGraph.of(mechanism)
    numbers = counts(mechanism)
    order = _solving_order(mechanism, graph, grubler(numbers) + len(graph.redundant))
    grouping = Grouping(mechanism, frozenset(graph.redundant))
    groups = [grouping.next_group(links) for links in order]
    return Structure(
        grubler=grubler(numbers),
        redundant=tuple(graph.redundant),
        drivers=tuple(mechanism.drivers),
        groups=tuple(groups),
        counts=numbers,
        trains=gear_trains(mechanism),
        passive=tuple(name for name in graph.redundant if mechanism.joints[name].higher),
        parts=tuple(tuple(part) for part in islands(mechanism)),
        turned={
            name: (driver.link, driver.joint, driver.relative_to)
            for name, driver in mechanism.drivers.items()
            if driver.law.rotary
        },
    )


def _solving_order(mechanism: Mechanism, graph: ConstraintGraph, mobility: int) -> list[list[str]]:
    """Sets of links that are solved together, in order."""
    choices = graph.choices()
    _, owners = graph.places()
    place_of, row_of = maximum_matching(choices, len(owners))
    _refuse_excess(mechanism, graph, choices, place_of, row_of, mobility)
    _refuse_free(mechanism, choices, row_of, owners, mobility)
    bodies = list(graph.freedoms)
    number = {body: i for i, body in enumerate(bodies)}
    successors: list[list[int]] = [[] for _ in bodies]
    for row, place in enumerate(place_of):
        determined = number[owners[place]]
        successors[determined] += [number[body] for body in graph.equations[row].bodies]
    file_order = {name: i for i, name in enumerate(mechanism.links)}
    found = []
    for component in components(successors):
        links = [bodies[i] for i in component if bodies[i] in file_order]
        if links:
            found.append(sorted(links, key=file_order.__getitem__))
    return found


def _refuse_excess(
    mechanism: Mechanism,
    graph: ConstraintGraph,
    choices: list[list[int]],
    place_of: list[int],
    row_of: list[int],
    mobility: int,
) -> None:
    unmatched = [row for row, place in enumerate(place_of) if place < 0]
    if not unmatched:
        return
    rows, stack = set(unmatched), list(unmatched)
    while stack:
        for place in choices[stack.pop()]:
            if (other := row_of[place]) >= 0 and other not in rows:
                rows.add(other)
                stack.append(other)
    bodies = _distinct(body for row in sorted(rows) for body in graph.equations[row].bodies)
    links = [body for body in bodies if body in mechanism.links]
    sources = _distinct(graph.equations[row].source for row in unmatched)
    raise explain_excess(mechanism, sources, links, mobility)


def _refuse_free(
    mechanism: Mechanism, choices: list[list[int]], row_of: list[int], owners: list[str], mobility: int
) -> None:
    free = [place for place, row in enumerate(row_of) if row < 0]
    if not free:
        return
    reached, stack = set(free), list(free)
    rows_at: dict[int, list[int]] = {}
    for row, places in enumerate(choices):
        for place in places:
            rows_at.setdefault(place, []).append(row)
    matched = {row: place for place, row in enumerate(row_of) if row >= 0}
    while stack:
        for row in rows_at.get(stack.pop(), []):
            place = matched[row]
            if place not in reached:
                reached.add(place)
                stack.append(place)
    bodies = _distinct(owners[place] for place in sorted(reached))
    raise explain_free(mechanism, [body for body in bodies if body in mechanism.links], len(free), mobility)


class Grouping:
    """Makes the groups one after the other, each with the joints that hang it on the links before."""

    def __init__(self, mechanism: Mechanism, redundant: frozenset[str]) -> None:
        self.redundant = redundant
        self.joints = list(mechanism.joints.values())
        self.numbers: dict[str, list[int]] = {}
        self.grounded: set[str] = set()
        for number, joint in enumerate(self.joints):
            for link in dict.fromkeys((*joint.joined, *joint.turning)):
                self.numbers.setdefault(link, []).append(number)
            if FRAME in joint.joined:
                self.grounded.update(joint.joined)
        self.drivers: dict[str, list[Driver]] = {}
        for driver in mechanism.drivers.values():
            self.drivers.setdefault(driver.joint, []).append(driver)
        self.solved = {FRAME: 0}

    def next_group(self, links: list[str]) -> Group:
        """The group of these links."""
        numbers = sorted({number for link in links for number in self.numbers.get(link, ())})
        mine = frozenset(links)
        connections = [c for number in numbers for c in self._connections(self.joints[number], mine)]
        group = make_group(links, connections, self.solved.keys())
        for link in links:
            self.solved[link] = len(self.solved)
        return group

    def _connections(self, joint: Joint, links: Set[str]) -> Iterator[Connection]:
        """A joint as pairs of links, for the group of ``links``: not before all that it ties to each other are in the
        group or solved."""
        if joint.coordinate == "turn":
            yield from self._on_pin(joint, links)
            return
        tied = joint.turning if joint.rotations_only else joint.joined
        idle = joint.rotations_only and (joint.name in self.redundant or links.isdisjoint(tied))
        if not idle and all(link in links or link in self.solved for link in tied):
            a, b = joint.joined
            driver = next((driver.name for driver in self.drivers.get(joint.name, ())), None)
            yield joint.between(a, b, driver)

    def _on_pin(self, joint: Joint, links: Set[str]) -> Iterator[Connection]:
        """The links of a pin on the frame, or on a link next to it, if one of them is solved."""
        mine = [link for link in joint.joined if link in links]
        pairs = {frozenset((d.link, d.relative_to)): d.name for d in self.drivers.get(joint.name, ())}
        present = self._firm(joint.joined) + mine
        used: list[str] = []
        for pair, driver in pairs.items():
            if pair <= set(present) and any(link in links for link in pair):
                a, b = sorted(pair, key=present.index)
                used.append(b)
                yield joint.between(a, b, driver)
        base = present[0]
        for link in mine:
            if link != base and link not in used:
                yield joint.between(base, link)

    def _firm(self, joined: Iterable[str]) -> list[str]:
        """Those of some links that are solved before: the frame first, then those next to it."""
        before = sorted((link for link in joined if link in self.solved), key=self.solved.__getitem__)
        return sorted(before, key=lambda link: (link != FRAME, link not in self.grounded))


def _distinct(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
