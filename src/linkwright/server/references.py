"""Where a text names a link or a point: joints, loads, actuators, drives, the link itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from linkwright.actuators.base import ACTUATORS
from linkwright.applied_loads.base import LOADS
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence, below
from linkwright.joints.base import JOINTS
from linkwright.server.draft import Draft
from linkwright.server.entries import texts, word

#: Keys of joints, loads and actuators whose words are no links.
NO_LINKS = ("kind", "at", "through")


def points_of_entry(link: MappingNode) -> Iterator[Scalar]:
    """The words of a link's entry that name its points."""
    keys = ("points",), ("also",), ("mass_centre",), ("shape", "through")
    for node in (below(link, *each) for each in keys):
        if isinstance(node, MappingNode):
            yield from (entry.key for entry in node.entries)
        elif node is not None:
            yield from scalars(node)


def references(draft: Draft, link: str, point: str) -> Iterator[tuple[str, str, Scalar]]:
    """Where joints, loads and actuators name a link's point: section, name, word."""
    kinds: dict[str, dict[str, Mapping[str, object]]] = {
        "joints": {kind: JOINTS[kind].fields() for kind in JOINTS},
        "loads": {kind: LOADS[kind].fields() for kind in LOADS},
        "actuators": {kind: ACTUATORS[kind].fields() for kind in ACTUATORS},
    }
    for section, known in kinds.items():
        for name, entry in draft.section(section) or ():
            if not isinstance(entry, MappingNode):
                continue
            fields: Mapping[str, object] = known.get(word(entry, "kind"), {})
            for key, node in entry:
                owner = getattr(fields.get(key), "of", None)
                own = owner is not None and word(entry, owner) == link
                own = own or (key == "at" and owner is None and link in texts(entry.get("links")))
                for each in scalars(node):
                    if each.text == f"{link}.{point}" or (own and each.text == point):
                        yield section, name, each


def named(node: Node) -> Iterator[str]:
    """What may be links among the words of an entry: of ``link.point`` the link."""
    if isinstance(node, MappingNode):
        for key, value in node:
            if key not in NO_LINKS:
                yield from named(value)
    else:
        yield from (each.text.split(".")[0] for each in scalars(node))


def owner_of_plate(plate: str) -> str:
    """The link or joint after which a plate is named: ``crank``, ``guide slide``."""
    return plate.rpartition(" ")[2]


def scalars(node: Node) -> Iterator[Scalar]:
    if isinstance(node, Scalar):
        yield node
    for each in node.items if isinstance(node, Sequence) else ():
        yield from scalars(each)
    for _unused, value in node if isinstance(node, MappingNode) else ():
        yield from scalars(value)
