"""Drivers between two points: as barrel, rod and guide in the links and joints of a model, before these are read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from linkwright.drivers.base import LAWS
from linkwright.drivers.cylinder import CYLINDER_FIELDS, Cylinder, barrel_name, rod_name
from linkwright.errors import Finding
from linkwright.fields.body import BODY_FIELDS
from linkwright.fields.nodes import Entry, Node, Scalar, Sequence
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.reading import Place
from linkwright.fields.references import LinkPoint
from linkwright.files.node_reader import NAME, as_meant
from linkwright.files.read_structure import scan_points
from linkwright.files.reader import Reader
from linkwright.words import _


def with_cylinders(root: MappingNode) -> tuple[MappingNode, tuple[str, ...]]:
    """The root with the links and the joint of every driver between two points, and the names of these drivers.

    One whose points are not there, or whose names others have, stays as it is: its reading says what is wrong.
    """
    links, joints = (dict(_section(root, each)) for each in ("links", "joints"))
    frame = root.get("frame")
    places = set(scan_points(frame)).union(*map(scan_points, links.values()))
    new_links, new_joints, found = list[Entry](), list[Entry](), list[str]()
    for key, node in _drivers(root):
        name, ends = key.text, _ends(node)
        made = (barrel_name(name), rod_name(name))
        if ends is None or not NAME.fullmatch(name) or name in (*joints, *places, *links) or {*made} & {*links}:
            continue
        if ends[0] == ends[1] or not set(ends) <= places:
            continue
        for link, end, body in zip(made, ends, ("barrel", "rod"), strict=True):
            new_links.append(Entry(replace(key, text=link), _link(node, end, body)))
        new_joints.append(Entry(key, _joint(key, name, ends)))
        found.append(name)
    if not found:
        return root, ()
    return _with(_with(root, "links", new_links), "joints", new_joints), tuple(found)


def read_cylinder(
    reader: Reader, node: MappingNode, place: Place, name: str, between: tuple[LinkPoint, LinkPoint], stroke: object
) -> Cylinder | None:
    """The cylinder of a driver, or None after a finding about its points or its names."""
    made = (barrel_name(name), rod_name(name))
    at = node.get("between")
    owners = [{*reader.names.pins.get(end.point, ()), end.link} - {*made} for end in between]
    shared = owners[0] & owners[1]
    if shared:
        reader.finding(
            at,
            place.child("between"),
            _('{points} are both on the link "{link}", so that their distance does not change'),
            "reference",
            _("name points of two links that move against each other"),
            points=tuple(map(str, between)),
            link=sorted(shared)[0],
        )
        return None
    if name not in reader.cylinders:
        taken = next((each for each in (name, *made) if each in {*reader.names.links, *reader.names.joints}), name)
        reader.finding(
            at,
            place.child("between"),
            _(
                'a driver between two points makes the links "{barrel}" and "{rod}" and the joint "{name}", and '
                'there is a link, joint or point "{taken}" already'
            ),
            "duplicate",
            _("rename one of them"),
            barrel=made[0],
            rod=made[1],
            name=name,
            taken=taken,
        )
        return None
    for end, link in zip(between, made, strict=True):
        if not {end.link, link} <= set(reader.names.pins.get(end.point, ())):
            reader.finding(
                at,
                place.child("between"),
                _('the cylinder cannot be pinned to the point "{end}", which a guide or a weld has for another link'),
                "reference",
                _('give the link "{link}" a point of its own there'),
                end=str(end),
                link=end.link,
            )
            return None
    return Cylinder(between, stroke)  # type: ignore[arg-type]


def as_written(finding: Finding, cylinders: tuple[str, ...]) -> Finding:
    """A finding about the links and the joint of a cylinder with the key that the file has."""
    for name in cylinders:
        owner = "driver" if name == "driver" else f"drivers.{name}"
        keys = {f"links.{barrel_name(name)}": f"{owner}.barrel", f"links.{rod_name(name)}": f"{owner}.rod"}
        keys[f"joints.{name}"] = owner
        for made, key in keys.items():
            if re.match(rf"{re.escape(made)}(\.|$)", finding.key):
                return replace(finding, key=key + finding.key.removeprefix(made))
    return finding


def _drivers(root: MappingNode) -> Iterator[tuple[Scalar, MappingNode]]:
    """Names and tables of all drivers; the only one is named ``driver``."""
    keys = [*CYLINDER_FIELDS, "turn", "slide", *LAWS]
    for entry in root.entries:
        if entry.key.text == "driver" and isinstance(entry.value, MappingNode):
            yield entry.key, as_meant(entry.value, keys)
        elif entry.key.text == "drivers" and isinstance(entry.value, MappingNode):
            for each in entry.value.entries:
                if isinstance(each.value, MappingNode):
                    yield each.key, as_meant(each.value, keys)


def _section(root: MappingNode, name: str) -> list[tuple[str, Node]]:
    section = root.get(name)
    return list(section) if isinstance(section, MappingNode) else []


def _ends(node: MappingNode) -> tuple[str, str] | None:
    """The names of the two points, without their links."""
    between = node.get("between")
    if not isinstance(between, Sequence) or node.get("turn") is not None or node.get("slide") is not None:
        return None
    texts = [each.text.rpartition(".")[2] for each in between.items if isinstance(each, Scalar)]
    return (texts[0], texts[1]) if len(texts) == len(between.items) == 2 else None


def _link(node: MappingNode, point: str, body: str) -> MappingNode:
    """The table of barrel or rod as that of a link with one point."""
    own = node.get(body)
    at = node if not isinstance(own, MappingNode) else own
    entries = [_entry(at, "points", Sequence(at.line, at.column, at.start, at.end, [_word(at, point)], flow=True))]
    if isinstance(own, MappingNode):
        entries += [each for each in as_meant(own, BODY_FIELDS).entries if each.key.text in BODY_FIELDS]
    return MappingNode(at.line, at.column, at.start, at.end, entries, at.flow)


def _joint(at: Scalar, name: str, ends: tuple[str, str]) -> MappingNode:
    words = {
        "kind": "prismatic",
        "guide": barrel_name(name),
        "through": ends[0],
        "direction": "0",
        "block": rod_name(name),
        "at": ends[1],
    }
    entries = [_entry(at, key, _word(at, word)) for key, word in words.items()]
    return MappingNode(at.line, at.column, at.start, at.end, entries, flow=True)


def _entry(at: Node, key: str, value: Node) -> Entry:
    return Entry(_word(at, key), value)


def _word(at: Node, text: str) -> Scalar:
    return Scalar(at.line, at.column, at.start, at.end, text)


def _with(root: MappingNode, section: str, more: list[Entry]) -> MappingNode:
    """The root with more entries in a section, which is added where it is not there."""
    node = root.get(section)
    if node is None:
        added = MappingNode(root.line, root.column, root.start, root.end, more)
        return replace(root, entries=[*root.entries, _entry(root, section, added)])
    if not isinstance(node, MappingNode):
        return root
    grown = replace(node, entries=[*node.entries, *more])
    entries = [Entry(each.key, grown) if each.value is node else each for each in root.entries]
    return replace(root, entries=entries)
