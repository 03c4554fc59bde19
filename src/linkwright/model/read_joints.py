"""The section ``joints`` of a model file, and the pins that follow from points with the same name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.joints.base import JOINTS, Joint
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.revolute import RevoluteJoint
from linkwright.joints.weld import WeldJoint
from linkwright.model.fields import Field, Quantity, Schema, Text, quantity_schema, written_quantity
from linkwright.model.mechanism import Link
from linkwright.model.nodes import Mapping as MappingNode
from linkwright.model.nodes import Node, Scalar, Sequence
from linkwright.model.plain_reader import Place
from linkwright.model.reader import Reader
from linkwright.model.reference_fields import LinkName, PointName
from linkwright.words.sentence import Sentence, together


@dataclass(frozen=True)
class Direction(Field):
    """Direction of a guide: an angle in the guide link's axes, or two points [P, Q] of it."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        if isinstance(node, Sequence):
            return reader.ray(node, place, given.get("guide"))
        return reader.quantity(node, place, "angle")

    def shape(self) -> Schema:
        pair = {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}
        return {"anyOf": [*quantity_schema("angle")["anyOf"], pair], "x-dimension": "angle"}

    def written(self, value: Any) -> Any:
        return written_quantity(value, "angle") if isinstance(value, float) else list(value)


@dataclass(frozen=True)
class LinkNames(Field):
    """Two different links [a, b]."""

    def read(
        self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]
    ) -> tuple[str, str] | None:
        items = reader.items(node, place, 2, "[a, b]")
        if items is None:
            return None
        names = [LinkName().read(reader, item, place, given) for item in items]
        first, second = names
        if first is None or second is None:
            return None
        if first == second:
            reader.error(
                node,
                place,
                Sentence("model.both_links", first=first),
                Sentence("model.two_links"),
                "reference",
            )
            return None
        return first, second

    def shape(self) -> Schema:
        return {
            "type": "array",
            "items": {"type": "string", "x-reference": "link"},
            "minItems": 2,
            "maxItems": 2,
        }


_FRICTION = Quantity("dimensionless", minimum=0, doc="coefficient of Coulomb friction (default 0)")
JOINT_FIELDS: Mapping[str, Mapping[str, Field]] = {
    "revolute": {
        "pin_radius": Quantity("length", above=0, doc="radius of the pin"),
        "friction": _FRICTION,
    },
    "prismatic": {
        "guide": LinkName(required=True, doc="the link that carries the guide"),
        "through": PointName("guide", required=True, doc="point of the guide link on the guide line"),
        "direction": Direction(
            required=True, doc="direction: an angle in the guide link's axes, or two points [P, Q]"
        ),
        "block": LinkName(required=True, doc="the link that slides"),
        "at": PointName("block", required=True, doc="point of the block that follows the line"),
        "offset": Quantity(
            "length", doc="normal distance of the point from the line, left positive (default 0)"
        ),
        "block_angle": Quantity("angle", doc="direction of the line in the block's axes (default 0)"),
        "friction": _FRICTION,
    },
    "weld": {
        "links": LinkNames(required=True, doc="the two links [a, b]"),
        "at": Text(required=True, doc="their common point"),
        "angle": Quantity("angle", doc="angle of b's x axis to a's (default 0)"),
    },
}


def scan_joints(reader: Reader, node: Node | None) -> None:
    """Fill the reader's names with the implied pins and the explicit joints."""
    declared = (
        [(key, value) for key, value in node if isinstance(value, MappingNode)]
        if isinstance(node, MappingNode)
        else []
    )
    reader.names.pins = _implied_pins(reader.names.links, [value for _, value in declared])
    reader.names.joints = dict.fromkeys(reader.names.pins, "revolute")
    for key, value in declared:
        kind = _word(value, "kind")
        if kind in ("prismatic", "weld"):
            reader.names.joints[key] = kind


def _word(node: MappingNode, key: str) -> str:
    value = node.get(key)
    return value.text if isinstance(value, Scalar) else ""


def _implied_pins(
    links: Mapping[str, tuple[str, ...]], joints: list[MappingNode]
) -> dict[str, tuple[str, ...]]:
    holders: dict[str, list[str]] = {}
    for link, points in links.items():
        for point in points:
            holders.setdefault(point, []).append(link)
    for joint in joints:
        kind, at = _word(joint, "kind"), _word(joint, "at")
        if (
            kind == "prismatic"
            and at == _word(joint, "through")
            and _word(joint, "guide") in holders.get(at, ())
        ):
            holders[at].remove(_word(joint, "guide"))
        elif kind == "weld":
            welded = joint.get("links")
            names = (
                [item.text for item in welded.items if isinstance(item, Scalar)]
                if isinstance(welded, Sequence)
                else []
            )
            if len(names) == 2 and set(names) <= set(holders.get(at, ())):
                holders[at].remove(names[1])
    return {point: tuple(owners) for point, owners in holders.items() if len(owners) > 1}


def read_joints(reader: Reader, node: Node | None, links: Mapping[str, Link]) -> dict[str, Joint]:
    """All joints: implied pins in order of first appearance, then the explicit ones."""
    joints: dict[str, Joint] = {pin: RevoluteJoint(pin, owners) for pin, owners in reader.names.pins.items()}
    mapping = None if node is None else reader.mapping(node, "joints")
    for entry in mapping.entries if mapping else []:
        name = reader.name(entry.key, f"joints.{entry.key.text}", "joint")
        joint = None if name is None else _read_joint(reader, entry.value, name, links)
        if joint is None or name is None:
            continue
        if name in joints and not isinstance(joint, RevoluteJoint):
            reader.error(
                entry.key,
                f"joints.{name}",
                Sentence("model.pin_has_name", name=name),
                Sentence("model.rename_joint"),
                "duplicate",
            )
        elif name in links:
            reader.error(
                entry.key,
                f"joints.{name}",
                Sentence("model.link_has_name", name=name),
                Sentence("model.rename_one"),
                "duplicate",
            )
        joints[name] = joint
    return joints


def _read_joint(reader: Reader, node: Node, name: str, links: Mapping[str, Link]) -> Joint | None:
    place = Place(f"joints.{name}", name)
    mapping = reader.mapping(node, place)
    if mapping is None:
        return None
    kind_node = mapping.get("kind")
    if kind_node is None:
        reader.error(
            node,
            place.child("kind"),
            Sentence("model.joint_no_kind"),
            Sentence("model.add_kind", kinds=tuple(JOINTS)),
            "missing-key",
        )
        return None
    kind = reader.word(kind_node, place.child("kind"), tuple(JOINTS))
    if kind is None:
        return None
    before = reader.error_count
    given = reader.table(mapping, place, {"kind": Text(), **JOINT_FIELDS[kind]})
    if given is None or reader.error_count > before:
        return None
    values = {key: value for key, value in given.items() if key != "kind" and value is not None}
    if kind == "prismatic":
        return _prismatic(reader, mapping, place, name, values, links)
    return (
        _weld(reader, mapping, place, name, values)
        if kind == "weld"
        else _pin(reader, node, place, name, values)
    )


def _pin(reader: Reader, node: Node, place: Place, name: str, values: Mapping[str, Any]) -> Joint | None:
    owners = reader.names.pins.get(name)
    if owners is None:
        reader.known(node, place, "pin", name, list(reader.names.pins))
        return None
    return RevoluteJoint(name, owners, **values)


def _prismatic(
    reader: Reader,
    node: MappingNode,
    place: Place,
    name: str,
    values: dict[str, Any],
    links: Mapping[str, Link],
) -> Joint | None:
    guide = values["guide"]
    if guide == values["block"]:
        reader.error(
            node.get("block"),
            place.child("block"),
            Sentence("model.guide_is_block", guide=guide),
            Sentence("model.two_links"),
            "reference",
        )
        return None
    point = values["at"]
    others = [owner for owner in reader.names.owners(point) if owner not in (guide, values["block"])]
    if point == values["through"] and others:
        reader.error(
            node.get("at"),
            place.child("at"),
            Sentence("model.point_on_both", point=point, others=tuple(others)),
            Sentence("model.rename_point"),
            "ambiguous",
        )
        return None
    direction = values.pop("direction")
    if isinstance(direction, float):
        return PrismaticJoint(name, direction=direction, direction_points=None, **values)
    joint = PrismaticJoint(name, direction=0.0, direction_points=direction, **values)
    if guide not in links:
        return joint
    first, second = (links[guide].points.get(each) for each in direction)
    if first is None or second is None:
        return joint
    if math.dist(first, second) == 0:
        reader.error(
            node.get("direction"),
            place.child("direction"),
            Sentence("model.same_place", points=together(direction)),
            Sentence("model.points_apart"),
            "range",
        )
    return joint.aligned(links[guide].points)


def _weld(reader: Reader, node: MappingNode, place: Place, name: str, values: dict[str, Any]) -> Joint | None:
    if all(
        reader.point_of(node.get("at") or node, place.child("at"), values["at"], link)
        for link in values["links"]
    ):
        return WeldJoint(name, **values)
    return None
