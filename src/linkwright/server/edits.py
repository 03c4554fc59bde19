"""Changes of a model's text by drawing: entries put in, values written and taken out, everything else as it was."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from linkwright import units
from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.files.document import Document
from linkwright.files.model_file import read_text
from linkwright.files.write import flow
from linkwright.joints.gear import GearPair
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.server.draft import Draft, fresh, picture, texts
from linkwright.server.drawn_contacts import add_cam, add_rack
from linkwright.units import number

#: Drawn coordinates are whole multiples of this, m.
_FINEST = 1e-4


def edited(text: str, action: Mapping[str, Any]) -> str:
    """The text after one action of drawing.

    ``do``: ``point`` (name, at, fixed), ``link`` (name, points), ``driver`` (link, about, speed), ``guide`` (link,
    at, angle), ``slot`` (along, at), ``gear`` (links, teeth), ``cam`` (cam, at, lift), ``rack`` (pinion, rack),
    ``mass`` (link, mass), ``load`` (link, at, force), ``optimize`` (section), ``remove`` (link or point); ``places``
    (m) of points that no drawing gives. Raises LinkwrightError for an action that the text does not admit.
    """
    draft = Draft(text, dict(action.get("places") or {}))
    act = _ACTIONS.get(str(action.get("do")))
    if act is None:
        raise LinkwrightError("studio.no_action", name=str(action.get("do")))
    act(draft, action)
    return draft.text


def _coordinates(at: Any) -> list[str]:
    return [
        f"{number(round(float(x) / _FINEST) / 10)} mm" if abs(float(x)) >= _FINEST / 2 else "0 mm" for x in at
    ]


def _point(draft: Draft, action: Mapping[str, Any]) -> None:
    place = _coordinates(action["at"])
    if not action.get("fixed"):
        draft.put("drawing", action["name"], place)
        return
    frame = draft.section("frame")
    points = frame.get("points") if frame is not None else None
    if not isinstance(points, MappingNode):
        draft.put("frame", "points", {action["name"]: place})
    else:
        draft.write_key(points, action["name"], flow(place))


def _link(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link through points; ``places`` (m) of those that no drawing gives, which become part of it."""
    known = picture(draft.text)["points"]
    for point, place in dict(action.get("places") or {}).items():
        if point not in known:
            _point(draft, {"name": point, "at": place})
    draft.put("links", action["name"], {"points": list(action["points"])})


def _driver(draft: Draft, action: Mapping[str, Any]) -> None:
    speed = action.get("speed", "60 rpm")
    draft.put_top("driver", {"turn": action["link"], "about": action["about"], "speed": speed})


def _guide(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block on a fixed guide through a point's place in the drawing."""
    shown = draft.shown()
    through = fresh("G", [*shown["points"], *shown["fixed"]])
    _point(draft, {"name": through, "at": shown["points"][action["at"]], "fixed": True})
    angle = f"{number(round(float(action['angle']), 3))} deg"
    draft.put_new("joints", "guide", {
        "kind": PrismaticJoint.kind, "guide": "frame", "through": through, "direction": angle,
        "block": action["link"], "at": action["at"],
    })  # fmt: skip


def _slot(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block that slides along a moving link, from its first point to its last, at a point beside or on it."""
    shown = draft.shown()
    ends = shown["links"].get(action["along"], [])
    if len(ends) < 2 or not all(point in shown["points"] for point in (*ends, action["at"])):
        raise LinkwrightError("studio.no_slot", name=str(action["along"]))
    (ax, ay), (bx, by), (x, y) = (shown["points"][point] for point in (ends[0], ends[-1], action["at"]))
    across = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / math.dist((ax, ay), (bx, by))
    block = fresh("slider", list(shown["links"]))
    _link(draft, {"name": block, "points": [action["at"]]})
    entry = {
        "kind": PrismaticJoint.kind, "guide": action["along"], "through": ends[0], "direction": [ends[0], ends[-1]],
        "block": block, "at": action["at"],
    }  # fmt: skip
    if abs(across) >= _FINEST / 2:
        entry["offset"] = _coordinates([across])[0]
    draft.put_new("joints", "slot", entry)


def _gear(draft: Draft, action: Mapping[str, Any]) -> None:
    """Two links as gears with numbers of teeth ``20:40``."""
    teeth = [each.strip() for each in str(action["teeth"]).split(":")]
    if len(teeth) != 2 or not all(each.isdigit() and int(each) for each in teeth):
        raise LinkwrightError("studio.no_teeth", text=str(action["teeth"]))
    entry = {"kind": GearPair.kind, "links": list(action["links"]), "teeth": [int(z) for z in teeth]}
    draft.put_new("joints", "mesh", entry)


def _optimize(draft: Draft, action: Mapping[str, Any]) -> None:
    """The section that says what varies, what is made least and what is kept; none at all where nothing varies."""
    draft.put_section("optimize", dict(action["section"]))


def _mass(draft: Draft, action: Mapping[str, Any]) -> None:
    links = draft.section("links")
    link = links.get(action["link"]) if links is not None else None
    if not isinstance(link, MappingNode):
        raise LinkwrightError("studio.no_link", name=str(action["link"]))
    draft.write_key(link, "mass", action["mass"])


def _load(draft: Draft, action: Mapping[str, Any]) -> None:
    draft.put_new("loads", "load", {
        "kind": "force", "on": action["link"], "at": action["at"], "direction": "-90 deg",
        "magnitude": action["force"],
    })  # fmt: skip


#: Keys of joints and loads whose words are no links.
_NO_LINKS = ("kind", "at", "through")


def _remove(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link with what stands on it: joints, loads, drivers, assembly; or a point that no link has."""
    name = str(action["name"])
    if action.get("what") == "link":
        if name not in picture(draft.text)["links"]:
            raise LinkwrightError("studio.no_link", name=name)
        draft.take_out("links", name)
        _remove_what_names(draft, name)
    links = picture(draft.text)["links"].values()
    used = {point for points in links for point in points}
    for point, _ in list(draft.section("drawing") or ()):
        if point not in used:
            draft.take_out("drawing", point)
    frame = draft.section("frame")
    points = frame.get("points") if frame is not None else None
    if (
        action.get("what") == "point"
        and name not in used
        and isinstance(points, MappingNode)
        and points.get(name)
    ):
        kept = {key: texts(place) for key, place in points if key != name}
        draft.put("frame", "points", kept)


def _remove_what_names(draft: Draft, link: str) -> None:
    """Joints, loads and drivers of a link that is gone, and words about their joints and pins of no two links."""
    gone = {link}
    for section in ("joints", "loads", "drivers"):
        for key, node in list(draft.section(section) or ()):
            if gone & set(_named(node)):
                draft.take_out(section, key)
                gone |= {key} if section == "joints" else set()
    driver = draft.root.get("driver")
    if driver is not None and gone & set(_named(driver)):
        draft.cut_top("driver")
    shown = picture(draft.text)
    ends = [*shown["fixed"], *(point for points in shown["links"].values() for point in points)]
    names = {"frame", *shown["links"]}
    joints = [key for key, node in draft.section("joints") or () if names & set(_named(node))]
    for section in ("assembly", "joints"):
        for key, _ in list(draft.section(section) or ()):
            if ends.count(key) < 2 and key not in joints:
                draft.take_out(section, key)


def _named(node: Node) -> Iterator[str]:
    """What may be links among the words of an entry: of ``link.point`` the link."""
    if isinstance(node, Scalar):
        yield node.text.split(".")[0]
    for each in node.items if isinstance(node, Sequence) else ():
        yield from _named(each)
    for key, value in node if isinstance(node, MappingNode) else ():
        if key not in _NO_LINKS:
            yield from _named(value)


_ACTIONS: dict[str, Callable[[Draft, Mapping[str, Any]], None]] = {
    "point": _point, "link": _link, "driver": _driver, "guide": _guide, "mass": _mass, "load": _load,
    "slot": _slot, "gear": _gear, "cam": add_cam, "rack": add_rack, "optimize": _optimize,
    "remove": _remove,
}  # fmt: skip


def with_values(text: str, values: Mapping[str, float]) -> str:
    """The text with changed dimensions (SI): numbers written where they stand, drawn links by their drawing.

    Raises LinkwrightError where the file has no place for one.
    """
    from linkwright.page.dimensions import dimensions

    document = Document(text, "model", read_text)
    mechanism = document.mechanism.with_dimensions(values)
    drawn = [name for name, link in mechanism.links.items() if link.geometry == "drawing"]
    rest = {address: value for address, value in values.items() if address.split(".")[0] not in drawn}
    known = {each.address: each for each in dimensions(document, set(rest))}
    for address, value in rest.items():
        if address in known:
            said = f"{number(value / known[address].factor, 10)} {known[address].unit}"
        else:
            said = f"{number(value)} {units.si_symbol(_kind(document, address))}"
        document.set(address, said.strip())
    if len(rest) == len(values):
        return document.text
    from linkwright.kinematics.solve import solve_motion
    from linkwright.mechanism.drawing import Drawing

    drawing = Drawing(document.mechanism)
    at = {name: drawing.driver(name) for name in mechanism.drivers}
    motion = solve_motion(mechanism, at={name: 0.0 if q is None else q for name, q in at.items()})
    draft = Draft(document.text)
    for point in mechanism.drawing:
        x, y = motion.point(point).position[0]
        draft.put("drawing", point, [f"{number(float(1e3 * each), 10)} mm" for each in (x, y)])
    return draft.text


def _kind(document: Document, address: str) -> units.Dimension:
    from linkwright.study.ranges import dimension_of

    return dimension_of(document.mechanism, address) or units.NONE
