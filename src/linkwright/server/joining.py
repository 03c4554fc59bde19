"""Joints as they are made of what is there: points merged, links welded at a pin, bars split."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from typing import Any

from linkwright.core.expressions import is_literal
from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.files.write import flow
from linkwright.joints.weld import WeldJoint
from linkwright.server import request
from linkwright.server.draft import Draft, length
from linkwright.server.drawn import new_point, put_point
from linkwright.server.entries import texts, word
from linkwright.server.geometry import Values, heading, shape
from linkwright.server.links import fresh_link
from linkwright.server.references import points_of_entry, references, scalars
from linkwright.server.removing import remove_drives, take_fixed
from linkwright.server.sizes import angle, remeasure
from linkwright.units import number
from linkwright.words import _


def merge(draft: Draft, action: Mapping[str, Any]) -> None:
    """Makes two points one joint, where the second stands, or the one that is fixed; lengths follow, locked ones
    hold."""
    source, target = request.name(action, "from"), request.name(action, "into")
    draft.complete([source, target])
    fixed = draft.picture()["fixed"]
    if source in fixed and target not in fixed:
        source, target = target, source
    draft.where(source)
    draft.where(target)
    both = [name for name, points in draft.picture()["links"].items() if {source, target} <= {*points}]
    slots = [joint for _unused, joint in draft.section("joints") or () if isinstance(joint, MappingNode)]
    if source == target or both or any({source, target} == {word(j, "at"), word(j, "through")} for j in slots):
        raise LinkwrightError(
            _("{from_} and {into} are points of one link", code="studio.one_link", from_=source, into=target)
        )
    joined = [name for name, points in draft.picture()["links"].items() if source in points]
    _rename_point(draft, [*joined, "frame"], source, target)
    for section in ("drawing", "assembly", "joints"):
        if (found := draft.section(section)) is not None and found.get(source) is not None:
            draft.take_out(section, source)
    if source in draft.picture()["fixed"]:
        take_fixed(draft, source)
    locked = request.names(action, "locked") if "locked" in action else []
    at = {name: complex(*place) for name, place in draft.shown()["points"].items()}
    for name in joined:
        if not any(each.startswith(f"{name}.") for each in locked):
            remeasure(draft, name, at)


def _rename_point(draft: Draft, links: list[str], old: str, new: str) -> None:
    """Names a point of links otherwise wherever joints, loads, drives and the links name it."""
    nodes = [node for link in links for _unused, _unused2, node in references(draft, link, old)]
    for link in links:
        if link != "frame":
            nodes += [node for node in points_of_entry(draft.link(link)) if node.text == old]
    drives = [draft.section("driver"), *(drive for _unused, drive in draft.section("drivers") or ())]
    for drive in drives:
        about = drive.get("about") if isinstance(drive, MappingNode) else None
        nodes += [each for each in scalars(about) if each.text == old] if about is not None else []
    for node in sorted({node.start: node for node in nodes}.values(), key=lambda each: -each.start):
        draft.write(node, flow(node.text.removesuffix(old) + new))


def weld(draft: Draft, action: Mapping[str, Any]) -> None:
    """Makes the links at a joint one, at the angle in which they are drawn, a single link one with the frame; or lets
    them turn again."""
    point = request.name(action, "point")
    draft.complete([point])
    for name, joint in list(draft.section("joints") or ()):
        if isinstance(joint, MappingNode) and word(joint, "kind") == WeldJoint.kind and word(joint, "at") == point:
            draft.take_out("joints", name)
    if not action.get("on", True):
        return
    shown = draft.picture()
    links = [name for name, points in shown["links"].items() if point in points]
    links = ["frame", *links] if point in shown["fixed"] and len(links) == 1 else links
    draft.complete([each for link in links if link != "frame" for each in shown["links"][link]])
    at = {name: complex(*place) for name, place in draft.shown()["points"].items()}
    ways = {link: way for link in links if (way := heading(draft.root, link, at)) is not None}
    if len(ways) < 2 or len(ways) < len(links):
        raise LinkwrightError(
            _("there are no two links with a drawn direction at {point}", code="studio.no_weld", point=point)
        )
    if (words := draft.section("assembly")) is not None and words.get(point) is not None:
        draft.take_out("assembly", point)
    if "frame" in ways:
        remove_drives(draft, point)
    first, *others = ways
    for other in others:
        turn = angle(cmath.phase(ways[other] / ways[first]))
        draft.put_new("joints", "weld", {"kind": WeldJoint.kind, "links": [first, other], "at": point, "angle": turn})


def split(draft: Draft, action: Mapping[str, Any]) -> None:
    """A bar as two bars that are pinned together at a point between its ends; its mass is shared by their lengths."""
    name = request.name(action, "link")
    entry, ends = draft.link(name), texts(draft.link(name).get("points"))
    if len(ends) != 2 or draft.picture()["links"][name] != ends:
        raise LinkwrightError(_("{link!r} is no bar of two points", code="studio.no_bar", link=name))
    for key, joint in draft.section("joints") or ():
        if isinstance(joint, MappingNode) and word(joint, "guide") == name:
            raise LinkwrightError(
                _(
                    "{link!r} carries the guide {name!r}, and cannot be split",
                    code="studio.split_guide",
                    link=name,
                    name=key,
                )
            )
    draft.complete(ends)
    first, last = ends
    point = request.name(action, "point") if "point" in action else new_point(draft)
    if point not in draft.picture()["points"]:
        put_point(draft, point, complex(*request.place(action, "at")))
    start, middle, end = (draft.where(each) for each in (first, point, last))
    one, two = abs(middle - start), abs(end - middle)
    if not one or not two:
        raise LinkwrightError(_("{link!r} cannot be split at its end", code="studio.split_end", link=name))
    other = fresh_link(draft)
    _hand_over(draft, name, last, other)
    entry = draft.link(name)
    mass, sized = entry.get("mass"), shape(Values(draft.root), entry) is not None
    parts = {name: ([first, point], one), other: ([point, last], two)}
    weight = Values(draft.root).of(mass, "mass") if mass is not None and is_literal(word(entry, "mass")) else None
    for each, (points, size) in parts.items():
        more = {"length": length(size, draft.step)} if sized else {}
        if weight:
            share = weight * size / (one + two)
            more |= {"mass": f"{number(share, 4)} kg", "inertia": f"{number(share * size**2 / 12, 4)} kg·m²"}
        draft.put("links", each, {"points": points, **more})
    draft.made.append(other)


def _hand_over(draft: Draft, link: str, point: str, other: str) -> None:
    """Gives joints, loads and the drive at a link's point to another link."""
    places = [(section, name) for section, name, _unused in references(draft, link, point)]
    for section, name in dict.fromkeys(places):
        entry = (draft.section(section) or MappingNode(0, 0, 0, 0)).get(name)
        for node in sorted(scalars(entry) if entry is not None else (), key=lambda each: -each.start):
            if node.text == link or node.text == f"{link}.{point}":
                draft.write(node, flow(other + node.text.removeprefix(link)))
    drive = draft.section("driver")
    if drive is not None and word(drive, "turn") == link and word(drive, "about") == point:
        draft.write_key(drive, "turn", flow(other))
