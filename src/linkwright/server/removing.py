"""What is taken off the paper: links with what depends on them, pins whose links come apart, points, loads."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Scalar, Sequence, below
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.server.entries import fresh, texts, word
from linkwright.server.forms import link_entry
from linkwright.server.references import named, owner_of_plate, points_of_entry, references
from linkwright.words import _

NEEDED = _("{name} needs the fixed point {point}; remove {name} first", code="studio.point_of")


def remove(draft: Draft, action: Mapping[str, Any]) -> str:
    """Takes a link, a joint or a load out, and gives a sentence about the rest; or several items without a word."""
    said = ""
    if "items" in action:
        _remove_items(draft, request.mappings(action, "items"))
    else:
        removed = _REMOVED.get(request.text(action, "what")) or request.refuse("what", "name")
        said = removed(draft, request.name(action, "name"))
    _remove_lost_stops(draft)
    _keep_run(draft)
    return said


def _remove_items(draft: Draft, items: list[dict[str, Any]]) -> None:
    """Takes items out, those first that others take along; what is gone by then is no fault."""
    for kind, (there, take) in _ITEMS.items():
        for item in items:
            if request.text(item, "kind") not in _ITEMS:
                request.refuse("kind", "name")
            if item["kind"] == kind and (there(draft, name := request.name(item, "name")) or len(items) == 1):
                take(draft, name)


def _pair(draft: Draft, name: str) -> None:
    """An entry of the joints: with a guide its block, where that is nothing but the block."""
    joints = draft.section("joints")
    joint = joints.get(name) if joints is not None else None
    if not isinstance(joint, MappingNode):
        raise LinkwrightError(_("there is no joint {name!r} in the text", code="studio.no_joint", name=name))
    block = word(joint, "block")
    if len(draft.picture()["links"].get(block, ())) == 1:
        _link(draft, block)
        return
    draft.take_out("joints", name)
    _remove_what_names(draft, {name})
    _take_through(draft, joint)
    _remove_unused(draft)


def _take_through(draft: Draft, joint: MappingNode) -> None:
    """The point of the frame that was there for a guide alone."""
    shown, through = draft.picture(), word(joint, "through")
    ends = [point for points in shown["links"].values() for point in points]
    if word(joint, "guide") == "frame" and through not in ends and not any(references(draft, "frame", through)):
        take_fixed(draft, through)


def _driver(draft: Draft, name: str) -> None:
    if (drivers := draft.section("drivers")) is not None and drivers.get(name) is not None:
        draft.take_out("drivers", name)
    elif draft.section("driver") is not None:
        draft.cut_top("driver")


def _in(section: str) -> Callable[[Draft, str], bool]:
    return lambda draft, name: (found := draft.section(section)) is not None and found.get(name) is not None


def _is_point(draft: Draft, name: str) -> bool:
    shown = draft.picture()
    return name in shown["points"] or any(name in points for points in shown["links"].values())


def _load(draft: Draft, name: str) -> str:
    loads = draft.section("loads")
    if loads is None or loads.get(name) is None:
        raise LinkwrightError(_("there is no load {name!r} in the text", code="studio.no_load", name=name))
    draft.take_out("loads", name)
    return _("Load {name} removed.", code="studio.load_gone", name=name)


def _entry(section: str) -> Callable[[Draft, str], object]:
    return lambda draft, name: draft.take_out(section, name)


def _link(draft: Draft, name: str) -> str:
    """A link with its joints, loads and drivers, and the assembly of pins that are left with one link."""
    draft.link(name)
    draft.take_out("links", name)
    _remove_what_names(draft, {name})
    _remove_unused(draft)
    return _("{name} removed, with the joints, loads and drives on it.", name=name)


def _joint(draft: Draft, point: str) -> str:
    """A pin: its links come apart. A block goes with its guide, a point that joins nothing out of its link."""
    shown = draft.picture()
    links = [name for name, points in shown["links"].items() if point in points]
    block = next((name for name in links if len(shown["links"][name]) == 1), None)
    if block is not None:
        return _link(draft, block)
    joined = ["frame", *links] if point in shown["fixed"] else links
    if len(joined) < 2:
        return _point(draft, point, links)
    for section in ("joints", "assembly"):
        if (found := draft.section(section)) is not None and found.get(point) is not None:
            draft.take_out(section, point)
    for name, joint in list(draft.section("joints") or ()):
        if isinstance(joint, MappingNode) and word(joint, "at") == point and joint.get("links") is not None:
            draft.take_out("joints", name)
    driven = remove_drives(draft, point)
    named = {link: _renamed(draft, link, point) for link in joined[1:]}
    separated = tuple(_("point {point} of {link}", link=link, point=new) for link, new in named.items())
    named_links = tuple(_("frame", code="nouns.frame") if link == "frame" else link for link in joined)
    gone = _(
        "Pin {point} removed: {links} are no longer joined there ({points}); drag them apart with Move.",
        code="studio.pin_gone",
        point=point,
        links=named_links,
        points=separated,
    )
    return (
        _(
            "{first} {second}",
            code="studio.both",
            first=gone,
            second=_("The drive about it is gone as well.", code="studio.drive_gone"),
        )
        if driven
        else gone
    )


def remove_drives(draft: Draft, point: str) -> bool:
    """Takes the drives about a pin out; whether there were any."""
    before = draft.text
    for name, driver in list(draft.section("drivers") or ()):
        if isinstance(driver, MappingNode) and word(driver, "about") == point:
            draft.take_out("drivers", name)
    alone = draft.section("driver")
    if alone is not None and word(alone, "about") == point:
        draft.cut_top("driver")
    return draft.text != before


def _point(draft: Draft, point: str, links: list[str]) -> str:
    """A point that joins nothing: of the frame, of one link or of none."""
    for link in links:
        _take_off(draft, point, link)
    if not links:
        for _unused, name, _unused2 in references(draft, "frame", point):
            raise LinkwrightError(NEEDED.format(point=point, name=name))
        take_fixed(draft, point)
    _remove_unused(draft)
    return _("Point {point} removed.", point=point)


def _take_off(draft: Draft, point: str, link: str) -> None:
    """A point off a link, with joints and loads there; raises LinkwrightError for one that gives it its lengths."""
    entry = draft.link(link)
    points, also = entry.get("points"), entry.get("also")
    places = also if isinstance(also, MappingNode) and also.get(point) is not None else points
    if isinstance(places, MappingNode) and (places is also or len(places.entries) > 2):
        if len(places.entries) == 1:
            draft.cut(entry, "also")
        else:
            draft.cut(places, point)
    elif isinstance(points, Sequence) and len(points.items) > 2 and _drawn(entry):
        draft.write(points, flow([each for each in texts(points) if each != point]))
    elif len(left := [each for each in draft.picture()["links"][link] if each != point]) > 1 and _all_drawn(
        draft, left
    ):
        _reform(draft, link, left)
    else:
        raise LinkwrightError(
            _(
                "{point} is an end that gives {link} its length; click the link itself to remove it",
                code="studio.end_of_link",
                point=point,
                link=link,
            )
        )
    if word(draft.link(link), "mass_centre") == point:
        draft.cut(draft.link(link), "mass_centre")
    _leave_path(draft, link, point)
    gone = dict.fromkeys((section, name) for section, name, _unused in references(draft, link, point))
    for section, name in gone:
        draft.take_out(section, name)
    _remove_what_names(draft, {name for section, name in gone if section == "joints"})


def _leave_path(draft: Draft, link: str, point: str) -> None:
    """A point out of the path along which a link is bent; the link's shape with its last but one."""
    through = below(draft.link(link), "shape", "through")
    if not isinstance(through, Sequence):
        return
    rest = [each for each in through.items if not (isinstance(each, Scalar) and each.text == point)]
    if len(rest) < 2:
        draft.cut(draft.link(link), "shape")
    elif len(rest) < len(through.items):
        draft.write(through, f"[{', '.join(draft.text[each.start : each.end].strip() for each in rest)}]")


def _leave_layers(draft: Draft, gone: set[str]) -> None:
    """The layers of plates of links and joints that are gone."""
    made = draft.section("construction")
    layers = made.get("layers") if made is not None else None
    for key, _unused in list(layers) if isinstance(layers, MappingNode) else ():
        if owner_of_plate(key) in gone:
            now = below(draft.section("construction"), "layers")
            assert isinstance(now, MappingNode)
            if len(now.entries) > 1:
                draft.cut(now, key)
            else:
                draft.take_out("construction", "layers")


def _all_drawn(draft: Draft, points: list[str]) -> bool:
    draft.complete(points)
    return set(points) <= set(draft.shown()["points"])


def _reform(draft: Draft, link: str, points: list[str]) -> None:
    """Writes a link anew that goes through the points that are left of it; masses and shapes stay."""
    entry = draft.link(link)
    kept = {
        key: draft.text[node.start : node.end].strip() for key, node in entry if key in ("mass", "inertia", "shape")
    }
    at = {point: draft.where(point) for point in points}
    draft.put("links", link, link_entry(draft, at))
    for key, text in kept.items():
        draft.write_key(draft.link(link), key, text)


def _renamed(draft: Draft, link: str, point: str) -> str:
    """Gives a link's point a name of its own wherever it is named."""
    shown = draft.picture()
    new = fresh(
        "P", {*shown["points"], *shown["fixed"], *(each for ends in shown["links"].values() for each in ends)}
    )
    nodes = [each for _unused, _unused2, each in references(draft, link, point)]
    nodes += [each for each in points_of_entry(draft.link(link)) if each.text == point]
    for node in sorted(nodes, key=lambda each: each.start, reverse=True):
        draft.write(node, flow(node.text.removesuffix(point) + new))
    if point in shown["points"] and (_drawn(draft.link(link)) or draft.section("drawing")):
        draft.draw(new, complex(*shown["points"][point]), fixed=False, fine=True)
    return new


def _drawn(link: MappingNode) -> bool:
    """Whether the drawing gives a link's lengths."""
    return isinstance(link.get("points"), Sequence) and link.get("length") is None and link.get("lengths") is None


def _remove_what_names(draft: Draft, gone: set[str]) -> None:
    """Joints, loads, actuators, stops and drivers of links and joints that are gone, words about pins of no two
    links, and points of the frame for their guides alone."""
    guided = set()
    for section in ("joints", "loads", "actuators", "stops", "drivers"):
        for key, node in list(draft.section(section) or ()):
            if gone & set(named(node)):
                draft.take_out(section, key)
                gone |= {key} if section == "joints" else set()
                if section == "joints" and isinstance(node, MappingNode) and word(node, "guide") == "frame":
                    guided.add(word(node, "through"))
    _leave_layers(draft, gone)
    driver = draft.root.get("driver")
    if driver is not None and gone & set(named(driver)):
        draft.cut_top("driver")
    shown = draft.picture()
    ends = [*shown["fixed"], *(point for points in shown["links"].values() for point in points)]
    names = {"frame", *shown["links"]}
    joints = [key for key, node in draft.section("joints") or () if names & set(named(node))]
    for section in ("assembly", "joints"):
        for key, _unused in list(draft.section(section) or ()):
            if ends.count(key) < 2 and key not in joints:
                draft.take_out(section, key)
    for point in guided:
        if ends.count(point) == 1 and not any(references(draft, "frame", point)):
            take_fixed(draft, point)


def _remove_lost_stops(draft: Draft) -> None:
    """Takes end stops out whose output is the coordinate of a point that is gone."""
    shown = draft.picture()
    points = {*shown["fixed"], *(point for ends in shown["links"].values() for point in ends)}
    for key, node in list(draft.section("stops") or ()):
        way, _unused, axis = word(node, "of").rpartition(".") if isinstance(node, MappingNode) else ("", "", "")
        point = way.removesuffix(".position").rpartition(".")[2]
        if axis in ("x", "y") and point not in points:
            draft.take_out("stops", key)


def _keep_run(draft: Draft) -> None:
    """Takes what a run says of drivers that are gone out, and all of it where there is no driver."""
    if (run := draft.section("run")) is None:
        return
    several = [name for name, _unused in draft.section("drivers") or ()]
    names = {*several, *(["driver"] if draft.root.get("driver") is not None else [])}
    if not names:
        draft.cut_top("run")
        return
    for key in ("at", "speed"):
        table = run.get(key)
        for name in [each for each, _unused in table] if isinstance(table, MappingNode) else ():
            if name not in names and (found := draft.section("run")) is not None:
                _cut_within(draft, found, key, name)


def _cut_within(draft: Draft, run: MappingNode, key: str, name: str) -> None:
    """Takes one driver's value out of a key of a run, and the key where it is the last one."""
    table = run.get(key)
    if isinstance(table, MappingNode) and len(table.entries) > 1:
        draft.cut(table, name)
    elif len(run.entries) > 1:
        draft.cut(run, key)
    else:
        draft.cut_top("run")


def _remove_unused(draft: Draft) -> None:
    """Drawn points that no link has."""
    used = {point for points in draft.picture()["links"].values() for point in points}
    for point, _unused in list(draft.section("drawing") or ()):
        if point not in used:
            draft.take_out("drawing", point)


def take_fixed(draft: Draft, point: str) -> None:
    frame = draft.section("frame")
    points = frame.get("points") if frame is not None else None
    if isinstance(points, MappingNode) and points.get(point) is not None:
        if len(points.entries) == 1:
            draft.cut_top("frame")
        else:
            draft.cut(points, point)


_ITEMS: dict[str, tuple[Callable[[Draft, str], bool], Callable[[Draft, str], object]]] = {
    "load": (_in("loads"), _load),
    "actuator": (_in("actuators"), _entry("actuators")),
    "stop": (_in("stops"), _entry("stops")),
    "driver": (lambda draft, name: draft.root.get("driver") is not None or _in("drivers")(draft, name), _driver),
    "pair": (_in("joints"), _pair),
    "link": (_in("links"), _link),
    "point": (_is_point, _joint),
}
_REMOVED = {"link": _link, "joint": _joint, "load": _load}
