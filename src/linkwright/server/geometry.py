"""What the sizes of a text say about its links before it is a model: points in their axes, guides."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from linkwright.core.expressions import is_literal, parse_any, parse_as
from linkwright.errors import QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.joints.base import JOINTS
from linkwright.server.entries import points_of, section, texts, word

if TYPE_CHECKING:
    from linkwright import units


class Values:
    """The values of a text's quantities, which may be expressions of its parameters."""

    def __init__(self, root: MappingNode) -> None:
        self._values: dict[str, float] = {}
        self._kinds: dict[str, units.Dimension] = {}
        waiting = {name: node.text for name, node in section(root, "parameters") or () if isinstance(node, Scalar)}
        before = -1
        while waiting and before != len(waiting):
            before = len(waiting)
            for name, text in list(waiting.items()):
                with suppress(QuantityError):
                    found = parse_any(text, self._kinds)
                    self._values[name] = found.evaluate(self._values)
                    self._kinds[name] = found.dimension(self._kinds)
                    del waiting[name]

    def of(self, node: Node | None, dimension: str) -> float | None:
        """A quantity, SI; None where it cannot be read."""
        if isinstance(node, Scalar):
            with suppress(QuantityError):
                return parse_as(node.text, dimension, self._kinds).evaluate(self._values)
        return None

    def place(self, node: Node | None) -> complex | None:
        """A pair of coordinates, m."""
        items = node.items if isinstance(node, Sequence) else []
        found = [self.of(each, "length") for each in items]
        if len(found) != 2 or found[0] is None or found[1] is None:
            return None
        return complex(found[0], found[1])


def plain(node: Node | None) -> bool:
    """Whether what a node says is a number with its unit, or numbers, that can give way to others."""
    items = node.items if isinstance(node, Sequence) else [node]
    return all(isinstance(each, Scalar) and is_literal(each.text, {}) for each in items)


@dataclass(frozen=True)
class Shape:
    """Points of a link in its axes, m, in the order of the entry; ``form``: length, bent, point or coordinates."""

    form: str
    points: Mapping[str, complex]


def shape(values: Values, link: Node | None) -> Shape | None:
    """The shape of a link that its sizes give; None where only the drawing does, or they cannot be read."""
    if not isinstance(link, MappingNode):
        return None
    points = link.get("points")
    if isinstance(points, MappingNode):
        found, form = _coordinates(values, points), "coordinates"
    else:
        found, form = _listed(values, link, texts(points))
    also = _coordinates(values, section(link, "also") or MappingNode(0, 0, 0, 0))
    return None if found is None or also is None else Shape(form, {**found, **also})


def _listed(values: Values, link: MappingNode, names: list[str]) -> tuple[dict[str, complex] | None, str]:
    if len(names) == 1:
        return {names[0]: 0j}, "point"
    if len(names) == 2:
        length = values.of(link.get("length"), "length")
        return ({names[0]: 0j, names[1]: complex(length)} if length else None), "length"
    lengths, angle = link.get("lengths"), values.of(link.get("angle"), "angle")
    sides = [values.of(each, "length") for each in lengths.items] if isinstance(lengths, Sequence) else []
    if len(names) != 3 or len(sides) != 2 or angle is None or not sides[0] or not sides[1]:
        return None, ""
    return {names[0]: 0j, names[1]: complex(sides[0]), names[2]: cmath.rect(sides[1], angle)}, "bent"


def _coordinates(values: Values, node: MappingNode) -> dict[str, complex] | None:
    found = {name: values.place(each) for name, each in node}
    places = {name: place for name, place in found.items() if place is not None}
    return places if len(places) == len(found) else None


@dataclass(frozen=True)
class Line:
    """A line on which a point of a block stays: through a point of the guide's link, in a direction (rad) of the
    frame or from one point of the guide to another, at a distance to its left."""

    name: str
    guide: str
    through: str
    direction: float | tuple[str, str]
    block: str
    at: str
    offset: float
    block_angle: float


def lines(values: Values, root: MappingNode) -> Iterator[Line]:
    """The guides whose direction is known: an angle of a guide on the frame, or two points."""
    for name, joint in section(root, "joints") or ():
        if not isinstance(joint, MappingNode) or word(joint, "kind") not in JOINTS:
            continue
        if JOINTS[word(joint, "kind")].coordinate != "slide":
            continue
        ends, angle = texts(joint.get("direction")), values.of(joint.get("direction"), "angle")
        offset = values.of(joint.get("offset"), "length") or 0.0
        direction = (ends[0], ends[1]) if len(ends) == 2 else angle if word(joint, "guide") == "frame" else None
        if direction is not None:
            guide, through, block, at = (word(joint, key) for key in ("guide", "through", "block", "at"))
            turned = values.of(joint.get("block_angle"), "angle") or 0.0
            yield Line(name, guide, through, direction, block, at, offset, turned)


def heading(root: MappingNode, link: str, at: Mapping[str, complex]) -> complex | None:
    """Direction of a link's x axis with points at places, as a unit vector; of a block that of its guide."""
    if link == "frame":
        return 1.0 + 0j
    values = Values(root)
    entry = section(root, "links", link)
    local = shape(values, entry)
    names = list(local.points) if local is not None else points_of(entry)
    if len(names) > 1 and all(each in at for each in names[:2]):
        way = at[names[1]] - at[names[0]]
        own = local.points[names[1]] - local.points[names[0]] if local is not None else 1.0
        turned = way / own if own else 0.0
        return turned / abs(turned) if abs(turned) else None
    for line in lines(values, root):
        if line.block == link:
            if isinstance(line.direction, float):
                return cmath.rect(1.0, line.direction - line.block_angle)
            if all(each in at for each in line.direction):
                way = at[line.direction[1]] - at[line.direction[0]]
                return way / abs(way) * cmath.rect(1.0, -line.block_angle) if abs(way) else None
    return None
