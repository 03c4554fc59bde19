"""A group cut into open chains that hang from links solved before, and its class and signature."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.structure.group import Connection, Group, TreeJoint

SOLVED = ""
#: The five dyads by their letters outer, inner, outer, read from either end.
DYADS = {"RRR": "RRR", "RRP": "RRP", "PRR": "RRP", "RPR": "RPR", "PRP": "PRP", "RPP": "RPP", "PPR": "RPP"}


def make_group(
    links: Sequence[str], connections: Sequence[Connection], solved: Sequence[str], redundant: tuple[str, ...]
) -> Group:
    """A group from its links and joints: spanning chains, cuts, class, order and signature."""
    known = set(solved)
    ranked = sorted(connections, key=lambda c: _rank(c, known))
    chosen, cuts = _spanning(ranked, known)
    tree = _rooted(chosen, known)
    signature, assur_class, order = _classify(links, connections, known)
    return Group(
        name="+".join(links),
        links=tuple(links),
        tree=tuple(tree),
        cuts=tuple(cuts),
        signature=signature,
        assur_class=assur_class,
        assur_order=order,
    )


def _rank(connection: Connection, solved: set[str]) -> int:
    """Rigid and driven joints hang first, then guides; of the pins the outer ones: the rest is cut."""
    if connection.kind == "weld":
        return 0
    if connection.driver is not None:
        return 1
    if connection.kind == "prismatic":
        return 2
    return 3 if connection.a in solved or connection.b in solved else 4


def _spanning(ranked: Sequence[Connection], solved: set[str]) -> tuple[list[Connection], list[Connection]]:
    parent: dict[str, str] = {}

    def root(name: str) -> str:
        name = SOLVED if name in solved else name
        while parent.get(name, name) != name:
            name = parent[name]
        return name

    chosen, cuts = [], []
    for connection in ranked:
        a, b = root(connection.a), root(connection.b)
        if a == b:
            cuts.append(connection)
        else:
            parent[max(a, b)] = min(a, b)
            chosen.append(connection)
    return chosen, cuts


def _rooted(chosen: Sequence[Connection], solved: set[str]) -> list[TreeJoint]:
    """The chosen joints, each from a link that is already placed to the next, parents first."""
    placed = set(solved)
    waiting = list(chosen)
    tree: list[TreeJoint] = []
    while waiting:
        for connection in waiting:
            if connection.a in placed or connection.b in placed:
                parent = connection.a if connection.a in placed else connection.b
                child = connection.other(parent)
                tree.append(TreeJoint(connection, parent, child))
                placed.add(child)
                waiting.remove(connection)
                break
    return tree


def _classify(
    links: Sequence[str], connections: Sequence[Connection], solved: set[str]
) -> tuple[str, int, int]:
    """Signature, class and order; links held together by a driver or a weld count as one."""
    merged = _merge(links, connections)
    free = [c for c in connections if c.driver is None and c.kind != "weld"]
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
    size = max(_most_joints(bodies, free, merged), _largest_contour(bodies, inner, merged))
    letters = "".join(c.letter for c in inner) + "-" + "".join(c.letter for c in outer)
    return letters, max(size, 1), len(outer)


def _merge(links: Sequence[str], connections: Sequence[Connection]) -> dict[str, str]:
    """The body that every link belongs to once drivers hold still."""
    body = {link: link for link in links}
    for c in connections:
        if (c.driver is not None or c.kind == "weld") and c.a in body and c.b in body:
            old, new = body[c.b], body[c.a]
            body = {link: new if name == old else name for link, name in body.items()}
    return body


def _most_joints(bodies: Sequence[str], joints: Sequence[Connection], merged: dict[str, str]) -> int:
    return max(sum(body in (merged.get(c.a), merged.get(c.b)) for c in joints) for body in bodies)


def _largest_contour(bodies: Sequence[str], inner: Sequence[Connection], merged: dict[str, str]) -> int:
    """Sides of the largest of the shortest closed contours of links through each inner joint."""
    edges = [(merged[c.a], merged[c.b]) for c in inner]
    largest = 0
    for skipped, (start, goal) in enumerate(edges):
        distance = {start: 1}
        queue = [start]
        for body in queue:
            for i, (a, b) in enumerate(edges):
                other = b if a == body else a if b == body else None
                if i != skipped and other is not None and other not in distance:
                    distance[other] = distance[body] + 1
                    queue.append(other)
        largest = max(largest, distance.get(goal, 0))
    return largest
