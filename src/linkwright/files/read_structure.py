"""The sections ``frame``, ``links``, ``drawing`` and ``joints`` of a model file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from linkwright.fields.mass import FROM_SHAPE
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence, below
from linkwright.fields.reading import Names, Place
from linkwright.fields.references import Coordinates, sliding
from linkwright.files.node_reader import NAME, as_meant, meant_kind
from linkwright.files.read_construction import shape_points_known
from linkwright.files.reader import Reader
from linkwright.joints.base import IMPLIED, JOINTS, Entry, Joint, implied_joint
from linkwright.mechanism.link import FRAME_FIELDS, LINK_FIELDS, Geometry, Link, Vec, from_drawing
from linkwright.registry import PROBABLE, nearest, offered
from linkwright.words import _
from linkwright.words.message import together

#: Links of a model, at most; more than that no machine has, and none is answered quickly.
MOST_LINKS = 1000


def legible(node: Node | None) -> bool:
    """Whether all points that a link's node may have can be read from it, each once."""
    points = as_meant(node, LINK_FIELDS).get("points") if isinstance(node, MappingNode) else None
    if isinstance(points, Sequence):
        names = [item.text for item in points.items if isinstance(item, Scalar) and NAME.fullmatch(item.text)]
        return len(points.items) == len(names) == len(set(names))
    return isinstance(points, MappingNode)


def scan_points(node: Node | None) -> tuple[str, ...]:
    """The points that a link's node names, whatever else is wrong with it."""
    if not isinstance(node, MappingNode):
        return ()
    node, found = as_meant(node, LINK_FIELDS), list[str]()
    for key in ("points", "also"):
        part = node.get(key)
        if isinstance(part, MappingNode):
            found += [entry.key.text for entry in part.entries]
        elif isinstance(part, Sequence) and key == "points":
            found += [item.text for item in part.items if isinstance(item, Scalar)]
    return tuple(dict.fromkeys(found))


def read_frame(reader: Reader, node: Node | None) -> Link:
    """The frame with its points."""
    if node is None:
        reader.finding(
            None, "frame", _("the model has no frame"), "missing-key", _("add frame: {{points: {{O1: [0 m, 0 m]}}}}")
        )
        return Link("frame", "coordinates", {})
    points = below(node, "points")
    if isinstance(points, Sequence):
        reader.finding(
            points,
            "frame.points",
            _("the frame's points have no coordinates"),
            "type",
            _("write points: {{O1: [0 m, 0 m], …}}"),
        )
        return Link("frame", "coordinates", {})
    found = reader.table(node, Place("frame", "frame"), FRAME_FIELDS) or {}
    placed = {name: place for name, place in (found.get("points") or {}).items() if place is not None}
    shape = found.get("shape")
    if not shape_points_known(reader, node, "frame", shape):
        shape = None
    return Link("frame", "coordinates", placed, shape=shape)


def read_drawing(reader: Reader, node: Node | None, frame: Link) -> dict[str, Vec]:
    """Coordinates of the assembled drawing in frame axes."""
    if node is None:
        return {}
    with reader.plain_numbers(_("a drawing")):
        found = Coordinates().read(reader, node, Place("drawing", "drawing"), {}) or {}
    everywhere = list(dict.fromkeys(point for points in reader.names.links.values() for point in points))
    drawing: dict[str, Vec] = {}
    for name, place in found.items():
        value = below(node, name)
        if name not in everywhere and reader.names.listed:
            near = offered(name, everywhere, _("add it to the points of a link, or remove it from the drawing"))
            reader.finding(
                value or node,
                f"drawing.{name}",
                _('no link has the drawn point "{name}"'),
                "unknown-name",
                near,
                name=name,
            )
            continue
        if not reader.known(value or node, f"drawing.{name}", _("point"), name, everywhere) or place is None:
            continue
        fixed = frame.points.get(name)
        if fixed is not None and reader.names.owners(name) == ["frame"] and math.dist(fixed, place) > 1e-9:
            reader.finding(
                value,
                f"drawing.{name}",
                _('"{name}" is a point of the frame with other coordinates'),
                "conflict",
                _("leave it out of the drawing"),
                name=name,
            )
        drawing[name] = place
    return drawing


def read_links(reader: Reader, node: Node | None, frame: Link, drawing: Mapping[str, Vec]) -> dict[str, Link]:
    """All moving links, in the file's order."""
    if node is None:
        reader.finding(
            None,
            "links",
            _("the model has no links"),
            "missing-key",
            _("add links: {{crank: {{points: [O1, A], length: 0.1 m}}}}"),
        )
        return {}
    mapping = reader.mapping(node, "links")
    if mapping is None:
        return {}
    if not mapping.entries:
        reader.finding(
            node,
            "links",
            _("there is no link"),
            "missing-key",
            _("add one, such as crank: {{points: [O1, A], length: 0.1 m}}"),
        )
    if len(mapping.entries) > MOST_LINKS:
        message = _("a model of {count} links; at most {most} are read", count=len(mapping.entries), most=MOST_LINKS)
        reader.error(node, "links", message, _("split it up into machines of their own"), "many")
        return {}
    links: dict[str, Link] = {}
    known_points = {**frame.points, **drawing}
    for entry in mapping.entries:
        name = reader.name(entry.key, f"links.{entry.key.text}", _("link"))
        if name == "frame":
            reader.finding(
                entry.key,
                "links.frame",
                _("the frame is listed among the links"),
                "name",
                _("move it out of links, to a section of its own: frame: {{points: {{O1: [0 m, 0 m]}}}}"),
            )
        elif name in ("gravity", "loads", "parameters", "cycle"):
            reader.finding(
                entry.key,
                f"links.{name}",
                _('"{name}" cannot be the name of a link'),
                "name",
                _("choose another name"),
                name=name,
            )
        elif name is not None:
            link = _read_link(reader, entry.value, name, known_points)
            if link is not None:
                links[name] = link
    return links


def _read_link(reader: Reader, node: Node, name: str, drawing: Mapping[str, Vec]) -> Link | None:
    place = Place(f"links.{name}", name)
    before = reader.error_count
    values = reader.table(node, place, LINK_FIELDS)
    if values is None or values.get("points") is None:
        return None
    points = values["points"]
    if not points:
        if reader.error_count == before:
            reader.finding(
                node, place.child("points"), _("the link has no points"), "missing-key", _("list them: [A, B]")
            )
        return None
    assert isinstance(node, MappingNode)
    placed = _place_points(reader, node, place, values, drawing) if reader.error_count == before else None
    if placed is None:
        return None
    geometry, coordinates, lengths = placed
    for point, position in (values.get("also") or {}).items():
        if point in coordinates:
            reader.finding(
                node.get("also"),
                place.child("also"),
                _('duplicate point "{point}"'),
                "duplicate",
                _("remove one"),
                point=point,
            )
        coordinates[point] = position
    _coincident(reader, node, place, coordinates)
    centre = values.get("mass_centre")
    if isinstance(centre, str) and not reader.point_of(
        node.get("mass_centre") or node, place.child("mass_centre"), centre, name
    ):
        return None
    if not shape_points_known(reader, node, name, values.get("shape")):
        return None
    from_shape = values.get("mass") == FROM_SHAPE
    return Link(
        name,
        geometry,
        coordinates,
        lengths,
        values.get("angle") or 0.0,
        0.0 if from_shape else values.get("mass") or 0.0,
        values.get("inertia") or 0.0,
        centre,
        values.get("colour") or "",
        values.get("shape"),
        from_shape,
    )


_Placed = tuple[Geometry, dict[str, Vec], tuple[float, ...]]


def _place_points(
    reader: Reader, node: MappingNode, place: Place, values: Mapping[str, Any], drawing: Mapping[str, Vec]
) -> _Placed | None:
    """The form of the geometry, and the points it places."""
    points = values["points"]
    sizes = [key for key in ("length", "lengths", "angle") if key in values]
    wanted = None
    if isinstance(points, dict):
        if sizes:
            wanted = (
                _("{size} is set in addition to coordinates", size=sizes[0]),
                _("remove it, or list the points as [A, B]"),
            )
        else:
            return "coordinates", dict(points), ()
    elif len(points) == 1:
        if sizes:
            wanted = (_("a link with one point has a {size}", size=sizes[0]), _("list its two points, or remove it"))
        else:
            return "point", {points[0]: (0.0, 0.0)}, ()
    elif sizes == ["length"]:
        if len(points) == 2:
            return "length", {points[0]: (0.0, 0.0), points[1]: (values["length"], 0.0)}, (values["length"],)
        wanted = (
            _("{count} points, but one length", code="model.one_length", count=len(points)),
            _("keep two in points and put the others under also: {{P: [x, y]}}, or give lengths and angle"),
        )
    elif not sizes:
        return _from_drawing(reader, node, place, points, drawing)
    elif sizes == ["lengths", "angle"] and len(points) == 3:
        return _bent(values)
    else:
        wanted = (
            _("{sizes} with {count} points", sizes=together(sizes), count=len(points)),
            _("two points take length; three take lengths: [l1, l2] and angle; others go under also"),
        )
    reader.error(node.get(sizes[0]), place.child(sizes[0]), *wanted, "geometry")
    return None


def _bent(values: Mapping[str, Any]) -> _Placed:
    first, second = values["lengths"]
    corner, one, two = values["points"]
    angle = values["angle"]
    arm = second * math.cos(angle), second * math.sin(angle)
    return "bent", {corner: (0.0, 0.0), one: (first, 0.0), two: arm}, (first, second)


def _from_drawing(
    reader: Reader, node: MappingNode, place: Place, points: list[str], drawing: Mapping[str, Vec]
) -> _Placed | None:
    missing = [point for point in points if point not in drawing]
    if missing:
        form = _("length: 0.5 m") if len(points) == 2 else _("lengths: [0.3 m, 0.4 m] and angle: 30 deg")
        reader.finding(
            node,
            place,
            _("the link has no dimensions, and the drawing no place of {missing}"),
            "missing-key",
            _("give {form}, coordinates of its points, or add {missing} to drawing"),
            missing=tuple(missing),
            form=form,
        )
        return None
    if drawing[points[0]] == drawing[points[1]]:
        reader.finding(
            node,
            place,
            _("{first} and {second} are at the same place in the drawing"),
            "range",
            _("move one"),
            first=points[0],
            second=points[1],
        )
        return None
    return "drawing", from_drawing(points, drawing), ()


def _coincident(reader: Reader, node: Node, place: Place, points: Mapping[str, Vec | None]) -> None:
    first_at: dict[Vec, str] = {}
    for name, position in points.items():
        if position is not None and position in first_at:
            reader.finding(
                node,
                place,
                _("the points {first_at} and {name} are at the same place"),
                "coincident",
                _("give them different coordinates unless that is meant"),
                severity="warning",
                first_at=first_at[position],
                name=name,
            )
        elif position is not None:
            first_at[position] = name


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
