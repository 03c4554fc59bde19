"""A group cut into open chains that hang from links solved before, and its class and signature."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Mapping, Sequence, Set
from heapq import heappop, heappush

from linkwright.elements.topology import Connection, Group, TreeJoint

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
