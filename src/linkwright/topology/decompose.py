"""Assur groups by the block triangular form of the link-freedom/constraint graph.

A maximum matching gives every equation the freedom that it determines; the strongly connected
components of the dependence between bodies are the Assur groups, and their order is the solving
order (Dulmage and Mendelsohn 1958; Assur 1913; Galletti, Mech. Mach. Theory 21, 1986).
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from heapq import heappop, heappush

from linkwright.core.arguments import require
from linkwright.drivers.base import Driver
from linkwright.elements import Connection, Group, TreeJoint
from linkwright.joints.base import Joint
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.analysis import Structure
from linkwright.topology.constraints import FRAME, ConstraintGraph, gear_trains
from linkwright.topology.mobility import counts, explain_excess, explain_free, grubler, islands


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
    if free:
        raise explain_free(mechanism, _free_links(mechanism, choices, row_of, owners), len(free), mobility)


def free_links(mechanism: Mechanism) -> list[str]:
    """The links whose motion nothing determines; none of a mechanism that is determined more than once."""
    graph = ConstraintGraph.of(mechanism)
    choices = graph.choices()
    _, owners = graph.places()
    place_of, row_of = maximum_matching(choices, len(owners))
    return [] if -1 in place_of else _free_links(mechanism, choices, row_of, owners)


def _free_links(mechanism: Mechanism, choices: list[list[int]], row_of: list[int], owners: list[str]) -> list[str]:
    free = [place for place, row in enumerate(row_of) if row < 0]
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
    return [body for body in bodies if body in mechanism.links]


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


SOLVED = ""
#: The five dyads by their letters outer, inner, outer, read from either end.
DYADS = {"RRR": "RRR", "RRP": "RRP", "PRR": "RRP", "RPR": "RPR", "PRP": "PRP", "RPP": "RPP", "PPR": "RPP"}


def make_group(links: Sequence[str], connections: Sequence[Connection], solved: Set[str]) -> Group:
    """A group from its links and joints: spanning chains, cuts, class, order and signature."""
    ranked = sorted(connections, key=lambda c: _rank(c, solved))
    chosen, cuts = _spanning(ranked, solved)
    tree = _rooted(chosen, solved)
    signature, assur_class, order = _classify(links, connections, solved)
    return Group(
        name="+".join(links),
        links=tuple(links),
        tree=tuple(tree),
        cuts=tuple(cuts),
        signature=signature,
        assur_class=assur_class,
        assur_order=order,
    )


def _rank(connection: Connection, solved: Set[str]) -> int:
    """Rigid and driven joints hang first, then guides; of the pins the outer ones: the rest is cut."""
    if connection.higher:
        return 5
    if connection.rigid:
        return 0
    if connection.driver is not None:
        return 1
    if connection.slides:
        return 2
    return 3 if connection.a in solved or connection.b in solved else 4


def _spanning(ranked: Sequence[Connection], solved: Set[str]) -> tuple[list[Connection], list[Connection]]:
    parent: dict[str, str] = {}

    def root(name: str) -> str:
        name = SOLVED if name in solved else name
        while (above := parent.get(name, name)) != name:
            parent[name] = parent.get(above, above)
            name = above
        return name

    chosen, cuts = [], []
    for connection in ranked:
        a, b = root(connection.a), root(connection.b)
        if a == b or connection.higher:
            cuts.append(connection)
        else:
            parent[max(a, b)] = min(a, b)
            chosen.append(connection)
    return chosen, cuts


def _rooted(chosen: Sequence[Connection], solved: Set[str]) -> list[TreeJoint]:
    """The chosen joints, each from a link that is already placed to the next, parents first."""
    at: dict[str, list[int]] = {}
    ready: list[int] = []
    for number, connection in enumerate(chosen):
        for link in (connection.a, connection.b):
            if link in solved:
                heappush(ready, number)
            else:
                at.setdefault(link, []).append(number)
    placed: set[str] = set()
    tree: list[TreeJoint] = []
    while ready:
        connection = chosen[heappop(ready)]
        if all(link in solved or link in placed for link in (connection.a, connection.b)):
            continue
        parent = connection.a if connection.a in solved or connection.a in placed else connection.b
        child = connection.other(parent)
        tree.append(TreeJoint(connection, parent, child))
        placed.add(child)
        for number in at[child]:
            heappush(ready, number)
    return tree


def _classify(links: Sequence[str], connections: Sequence[Connection], solved: Set[str]) -> tuple[str, int, int]:
    """Signature, class and order; links held together by a driver or a weld count as one."""
    merged = _merge(links, connections)
    free = [c for c in connections if c.driver is None and not c.rigid]
    if not free:
        drivers = [c for c in connections if c.driver is not None]
        return "".join(c.letter for c in drivers) or "W", 1, 1
    outer = [c for c in free if c.a in solved or c.b in solved]
    inner = [c for c in free if c not in outer]
    bodies = sorted(set(merged.values()), key=list(merged.values()).index)
    if len(bodies) == 2 and len(outer) == 2 and len(inner) == 1:
        ends = sorted(outer, key=lambda c: bodies.index(merged[c.b if c.a in solved else c.a]))
        letters = ends[0].letter + inner[0].letter + ends[1].letter
        return DYADS.get(letters, letters), 2, 2
    if len(bodies) == 1 and len(outer) == 2 and sum(c.higher for c in outer) == 1:
        return "".join(c.letter for c in sorted(outer, key=lambda c: c.higher)), 2, 2
    size = max(_most_joints(bodies, free, merged), _largest_contour(bodies, inner, merged))
    letters = "".join(c.letter for c in inner) + "-" + "".join(c.letter for c in outer)
    return letters, max(size, 1), len(outer)


def _merge(links: Sequence[str], connections: Sequence[Connection]) -> dict[str, str]:
    """The body that every link belongs to once drivers hold still."""
    body = {link: link for link in links}
    for c in connections:
        if (c.driver is not None or c.rigid) and c.a in body and c.b in body:
            old, new = body[c.b], body[c.a]
            body = {link: new if name == old else name for link, name in body.items()}
    return body


def _most_joints(bodies: Sequence[str], joints: Sequence[Connection], merged: dict[str, str]) -> int:
    counted = Counter(body for c in joints for body in {merged.get(c.a), merged.get(c.b)})
    return max(counted[body] for body in bodies)


def _largest_contour(bodies: Sequence[str], inner: Sequence[Connection], merged: dict[str, str]) -> int:
    """Sides of the largest of the shortest closed contours of links through each inner joint."""
    edges = [(merged[c.a], merged[c.b]) for c in inner]
    neighbours: dict[str, list[tuple[int, str]]] = {body: [] for body in bodies}
    for number, (a, b) in enumerate(edges):
        neighbours[a].append((number, b))
        neighbours[b].append((number, a))
    return max((_contour(neighbours, skipped, *edge) for skipped, edge in enumerate(edges)), default=0)


def _contour(neighbours: Mapping[str, Sequence[tuple[int, str]]], skipped: int, start: str, goal: str) -> int:
    """Links on the shortest way between two links without the joint between them; 0 if there is none."""
    distance = {start: 1}
    queue = deque([start])
    while queue and goal not in distance:
        body = queue.popleft()
        for number, other in neighbours[body]:
            if number != skipped and other not in distance:
                distance[other] = distance[body] + 1
                queue.append(other)
    return distance.get(goal, 0)
