"""The section ``joints`` of a model file, and the pins that follow from points with the same name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Names, Place
from linkwright.fields.references import sliding
from linkwright.files.node_reader import as_meant, meant_kind
from linkwright.files.reader import Reader
from linkwright.joints.base import IMPLIED, JOINTS, Entry, Joint, implied_joint
from linkwright.mechanism.link import Link
from linkwright.registry import PROBABLE, nearest
from linkwright.words import _
from linkwright.words.sentence import together


def scan_joints(reader: Reader, node: Node | None) -> None:
    """Fill the reader's names with the implied pins and the explicit joints."""
    declared = (
        [(key, as_meant(value, ["kind"])) for key, value in node if isinstance(value, MappingNode)]
        if isinstance(node, MappingNode)
        else []
    )
    reader.names.pins = _implied_pins(reader.names, [value for _unused, value in declared])
    reader.names.joints = dict.fromkeys(reader.names.pins, IMPLIED)
    slides: list[tuple[str, str, str]] = []
    for key, value in declared:
        kind = meant_kind(value.get("kind"), JOINTS)
        if kind is not None and kind != IMPLIED:
            reader.names.joints[key] = kind
            reader.names.blocks.setdefault(_word(value, "block"), key)
            if JOINTS[kind].coordinate == "slide":
                slides.append((key, _word(value, "guide"), _word(value, "block")))
    reader.names.sliding = sliding(slides, reader.names.links)


def _word(node: MappingNode, key: str) -> str:
    value = node.get(key)
    return value.text if isinstance(value, Scalar) else ""


def _words(node: MappingNode) -> dict[str, str | list[str]]:
    """The entry's words and lists of words."""
    found: dict[str, str | list[str]] = {}
    for key, value in node:
        if isinstance(value, Scalar):
            found[key] = value.text
        elif isinstance(value, Sequence):
            found[key] = [item.text for item in value.items if isinstance(item, Scalar)]
    return found


def _implied_pins(names: Names, joints: list[MappingNode]) -> dict[str, tuple[str, ...]]:
    holders: dict[str, list[str]] = {}
    for link, points in names.links.items():
        for point in points:
            holders.setdefault(point, []).append(link)
    for joint in joints:
        kind = meant_kind(joint.get("kind"), JOINTS)
        point, shared = (JOINTS[kind].unpinned(_words(joint)) if kind else None) or ("", ())
        if shared and set(shared) <= set(holders.get(point, ())):
            holders[point].remove(shared[-1])
            names.welded |= {shared[-1]: shared[0]} if len(shared) > 1 else {}
    return {point: tuple(owners) for point, owners in holders.items() if len(owners) > 1}


def read_joints(reader: Reader, node: Node | None, links: Mapping[str, Link]) -> dict[str, Joint]:
    """All joints: implied pins in order of first appearance, then the explicit ones."""
    joints = {pin: implied_joint(pin, owners) for pin, owners in reader.names.pins.items()}
    mapping = None if node is None else reader.mapping(node, "joints")
    for entry in mapping.entries if mapping else []:
        name = reader.name(entry.key, f"joints.{entry.key.text}", _("joint"))
        joint = None if name is None else _read_joint(reader, entry.value, name, links)
        if joint is None or name is None:
            continue
        if name in joints and joint.kind != IMPLIED:
            reader.finding(
                entry.key,
                f"joints.{name}",
                _('the pin at the point "{name}" has this name already'),
                "duplicate",
                _("rename the joint"),
                name=name,
            )
        elif name in links:
            reader.finding(
                entry.key,
                f"joints.{name}",
                _('a link has the name "{name}" already'),
                "duplicate",
                _("rename one of them"),
                name=name,
            )
        joints[name] = joint
    return joints


def _of_points(reader: Reader, table: MappingNode, place: Place) -> MappingNode:
    """A pin's table without the keys that would say what it joins or where, which are one finding."""
    known, names, pin = ["kind", *JOINTS[IMPLIED].fields()], reader.names, place.address
    points = {point for each in names.links.values() for point in each}
    point_keys = [
        entry
        for entry in table.entries
        if nearest(entry.key.text[:100], known, PROBABLE) is None
        and (words := _texts(entry.value))
        and words <= {*names.links, *points}
    ]
    if point_keys:
        joined = [link for link in names.links if any(link in _texts(each.value) for each in point_keys)]
        lacking = [each for each in joined if pin not in names.links[each]]
        remedy = (
            _(
                'remove it, and name a point of {links} "{pin}": points: [{pin}, …]',
                code="model.pin_name_points",
                pin=pin,
                links=together(lacking),
            )
            if lacking
            else _('remove it: they have the point "{pin}" already')
        )
        keys = tuple(each.key.text for each in point_keys)
        at = place.child(point_keys[0].key.text)
        reader.finding(
            point_keys[0].key,
            at,
            _("a pin joins the links that have a point of its name, and takes no key {keys}"),
            "unknown-key",
            remedy,
            pin=pin,
            keys=keys,
        )
    return replace(table, entries=[each for each in table.entries if each not in point_keys])


def _texts(node: Node) -> set[str]:
    """The word or words of a value; none where there is anything else."""
    items = node.items if isinstance(node, Sequence) else [node]
    texts = [each.text for each in items if isinstance(each, Scalar)]
    return set(texts) if len(texts) == len(items) else set()


def _read_joint(reader: Reader, node: Node, name: str, links: Mapping[str, Link]) -> Joint | None:
    place = Place(f"joints.{name}", name)
    before = reader.error_count
    if isinstance(node, MappingNode) and meant_kind(as_meant(node, ["kind"]).get("kind"), JOINTS) == IMPLIED:
        node = _of_points(reader, node, place)
    found = reader.of_kind(node, place, JOINTS, _("the joint has no kind"), _("add kind: one of {kinds}"))
    if found is None or reader.error_count > before:
        return None
    mapping, cls, values = found
    return cls.read(Entry(reader, mapping, place, name, values, links))
