"""Changes of a model's text by drawing: entries put in, values written and taken out, everything else as it was."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from linkwright import units
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.files.compose import compose
from linkwright.files.document import Document
from linkwright.files.model_file import read_text
from linkwright.files.write import flow
from linkwright.joints.gear import GearPair
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.units import number
from linkwright.words.sentence import Sentence

Plain = dict[str, Any]
#: Drawn coordinates are whole multiples of this, m.
_FINEST = 1e-4


class Draft(Document):
    """A text that need not be a model yet: what is written into it is not checked."""

    def __init__(self, text: str) -> None:
        self.name, self.text = "model", text

    def _accept(self, text: str) -> None:
        self.text = text

    @property
    def root(self) -> MappingNode:
        """The tree; raises LinkwrightError for a text that has none."""
        root, _ = compose(self.text.removeprefix("\ufeff"))
        if root is None:
            return MappingNode(0, 0, 0, 0)
        if not isinstance(root, MappingNode):
            raise LinkwrightError(Sentence("studio.no_mapping"))
        return root

    def section(self, name: str) -> MappingNode | None:
        """The mapping behind a key of the top."""
        found = self.root.get(name)
        return found if isinstance(found, MappingNode) else None

    def put(self, section: str, key: str, value: Any) -> None:
        """Write an entry of a section, which is added at the end where it is missing."""
        found = self.section(section)
        if found is None:
            self._append(f"{section}:\n  {key}: {flow(value)}")
        elif (old := found.get(key)) is not None:
            self._write(old, flow(value))
        else:
            self._insert(found, key, flow(value))

    def _write(self, node: Node, text: str) -> None:
        offset = 1 if self.text.startswith("\ufeff") else 0
        start, end = node.start + offset, node.end + offset
        while end > start and self.text[end - 1] in " \r\n":
            end -= 1
        self.text = self.text[:start] + text + self.text[end:]

    def _append(self, text: str) -> None:
        self.text = self.text.rstrip("\n") + ("\n" if self.text.strip() else "") + text + "\n"

    def put_top(self, key: str, value: Any) -> None:
        """Write a key of the top."""
        old = self.root.get(key)
        if old is None:
            self._append(f"{key}: {flow(value)}")
        else:
            self._write(old, flow(value))

    def take_out(self, section: str, key: str) -> None:
        """Take an entry out of a section, and the section with its last entry."""
        found = self.section(section)
        place = [entry.key.text for entry in found.entries].index(key) if found is not None else 0
        assert found is not None
        if len(found.entries) == 1:
            self._cut_top(section)
            return
        entry = found.entries[place]
        if found.flow:
            nearby = found.entries[place + 1].key.start if place + 1 < len(found.entries) else entry.value.end
            start = entry.key.start if place + 1 < len(found.entries) else found.entries[place - 1].value.end
            self.text = self.text[:start] + self.text[nearby:]
            return
        start = self.text.rfind("\n", 0, entry.key.start) + 1
        after = found.entries[place + 1].key.start if place + 1 < len(found.entries) else entry.value.end
        end = self.text.rfind("\n", 0, after) + 1 if place + 1 < len(found.entries) else self._line_end(after)
        self.text = self.text[:start] + self.text[end:]

    def _cut_top(self, key: str) -> None:
        entries = self.root.entries
        place = [entry.key.text for entry in entries].index(key)
        start = entries[place].key.start
        end = entries[place + 1].key.start if place + 1 < len(entries) else len(self.text)
        self.text = self.text[:start] + self.text[end:]

    def _line_end(self, place: int) -> int:
        while place > 0 and self.text[place - 1] in "\r\n ":
            place -= 1
        end = self.text.find("\n", place)
        return len(self.text) if end < 0 else end + 1


def picture(text: str) -> Plain:
    """What of a text can be drawn before it is a model: points (m), links with their points, fixed points, driver."""
    draft = Draft(text)
    frame = draft.section("frame")
    fixed = _places(frame.get("points") if frame is not None else None)
    links = {}
    for name, link in draft.section("links") or ():
        points = link.get("points") if isinstance(link, MappingNode) else None
        names = [name for name, _ in points] if isinstance(points, MappingNode) else _texts(points)
        links[name] = names
    driver = draft.section("driver")
    turned = driver.get("turn") if driver is not None else None
    return {
        "points": {**_places(draft.root.get("drawing")), **fixed},
        "fixed": list(fixed),
        "links": links,
        "driver": turned.text if isinstance(turned, Scalar) else None,
        "guided": [
            each.text
            for _, joint in draft.section("joints") or ()
            if isinstance(joint, MappingNode) and isinstance(each := joint.get("at"), Scalar)
        ],
    }


def _texts(node: Node | None) -> list[str]:
    items = node.items if isinstance(node, Sequence) else []
    return [each.text for each in items if isinstance(each, Scalar)]


def _places(node: Node | None) -> dict[str, list[float]]:
    found = {}
    for name, place in node if isinstance(node, MappingNode) else ():
        try:
            found[name] = [units.parse(text, "length") for text in _texts(place)]
        except QuantityError:
            continue
    return {name: place for name, place in found.items() if len(place) == 2}


def edited(text: str, action: Mapping[str, Any]) -> str:
    """The text after one action of drawing.

    ``do``: ``point`` (name, at, fixed), ``link`` (name, points), ``driver`` (link, about, speed), ``guide`` (link,
    at, angle), ``slot`` (along, at), ``gear`` (links, teeth), ``mass`` (link, mass), ``load`` (link, at, force),
    ``remove`` (link or point). Raises LinkwrightError for an action that the text does not admit.
    """
    draft = Draft(text)
    act = _ACTIONS.get(str(action.get("do")))
    if act is None:
        raise LinkwrightError(Sentence("studio.no_action", name=str(action.get("do"))))
    act(draft, action)
    return draft.text


def _coordinates(at: Any) -> list[str]:
    return [
        f"{number(round(float(x) / _FINEST) * 0.1)} mm" if abs(float(x)) >= _FINEST / 2 else "0 mm"
        for x in at
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
    elif (old := points.get(action["name"])) is not None:
        draft._write(old, flow(place))
    else:
        draft._insert(points, action["name"], flow(place))


def _link(draft: Draft, action: Mapping[str, Any]) -> None:
    draft.put("links", action["name"], {"points": list(action["points"])})


def _driver(draft: Draft, action: Mapping[str, Any]) -> None:
    speed = action.get("speed", "60 rpm")
    draft.put_top("driver", {"turn": action["link"], "about": action["about"], "speed": speed})


def _guide(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block on a fixed guide through a point's place in the drawing."""
    shown = picture(draft.text)
    through = _fresh("G", [*shown["points"], *shown["fixed"]])
    _point(draft, {"name": through, "at": shown["points"][action["at"]], "fixed": True})
    name = _fresh("guide", [key for key, _ in draft.section("joints") or ()])
    angle = f"{number(round(float(action['angle']), 3))} deg"
    draft.put("joints", name, {
        "kind": PrismaticJoint.kind, "guide": "frame", "through": through, "direction": angle,
        "block": action["link"], "at": action["at"],
    })  # fmt: skip


def _slot(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block that slides along a moving link, from its first point to its last, at a point beside or on it."""
    shown = picture(draft.text)
    ends = shown["links"].get(action["along"], [])
    if len(ends) < 2 or not all(point in shown["points"] for point in (*ends, action["at"])):
        raise LinkwrightError(Sentence("studio.no_slot", name=str(action["along"])))
    (ax, ay), (bx, by), (x, y) = (shown["points"][point] for point in (ends[0], ends[-1], action["at"]))
    across = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / math.dist((ax, ay), (bx, by))
    block = _fresh("slider", list(shown["links"]))
    _link(draft, {"name": block, "points": [action["at"]]})
    entry = {
        "kind": PrismaticJoint.kind, "guide": action["along"], "through": ends[0], "direction": [ends[0], ends[-1]],
        "block": block, "at": action["at"],
    }  # fmt: skip
    if abs(across) >= _FINEST / 2:
        entry["offset"] = _coordinates([across])[0]
    draft.put("joints", _fresh("slot", [key for key, _ in draft.section("joints") or ()]), entry)


def _gear(draft: Draft, action: Mapping[str, Any]) -> None:
    """Two links as gears with numbers of teeth ``20:40``."""
    teeth = [each.strip() for each in str(action["teeth"]).split(":")]
    if len(teeth) != 2 or not all(each.isdigit() and int(each) for each in teeth):
        raise LinkwrightError(Sentence("studio.no_teeth", text=str(action["teeth"])))
    name = _fresh("mesh", [key for key, _ in draft.section("joints") or ()])
    draft.put(
        "joints",
        name,
        {"kind": GearPair.kind, "links": list(action["links"]), "teeth": [int(z) for z in teeth]},
    )


def _fresh(stem: str, known: list[str]) -> str:
    place = 1
    while f"{stem}{place}" in known:
        place += 1
    return f"{stem}{place}"


def _mass(draft: Draft, action: Mapping[str, Any]) -> None:
    links = draft.section("links")
    link = links.get(action["link"]) if links is not None else None
    if not isinstance(link, MappingNode):
        raise LinkwrightError(Sentence("studio.no_link", name=str(action["link"])))
    if (old := link.get("mass")) is not None:
        draft._write(old, action["mass"])
    else:
        draft._insert(link, "mass", action["mass"])


def _load(draft: Draft, action: Mapping[str, Any]) -> None:
    name = _fresh("load", [key for key, _ in draft.section("loads") or ()])
    draft.put("loads", name, {
        "kind": "force", "on": action["link"], "at": action["at"], "direction": "-90 deg",
        "magnitude": action["force"],
    })  # fmt: skip


def _remove(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link with the joints, loads and the driver on it; or a point that no link has."""
    name = str(action["name"])
    if action.get("what") == "link":
        draft.take_out("links", name)
        for section in ("joints", "loads"):
            for key, node in draft.section(section) or ():
                named = (
                    [value.text for _, value in node if isinstance(value, Scalar)]
                    if isinstance(node, MappingNode)
                    else []
                )
                if name in named:
                    draft.take_out(section, key)
        if picture(draft.text)["driver"] == name:
            draft._cut_top("driver")
    used = {point for points in picture(draft.text)["links"].values() for point in points}
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
        kept = {key: _texts(place) for key, place in points if key != name}
        draft.put("frame", "points", kept)


_ACTIONS: dict[str, Callable[[Draft, Mapping[str, Any]], None]] = {
    "point": _point, "link": _link, "driver": _driver, "guide": _guide, "mass": _mass, "load": _load,
    "slot": _slot, "gear": _gear,
    "remove": _remove,
}  # fmt: skip


def with_values(text: str, values: Mapping[str, float]) -> str:
    """The text with changed dimensions (SI): numbers written where they stand, drawn links by their drawing.

    Raises LinkwrightError where the file has no place for one.
    """
    document = Document(text, "model", read_text)
    mechanism = document.mechanism.with_dimensions(values)
    drawn = [name for name, link in mechanism.links.items() if link.geometry == "drawing"]
    rest = {address: value for address, value in values.items() if address.split(".")[0] not in drawn}
    for address, value in rest.items():
        dimension = units.si_symbol(_kind(document, address))
        document.set(address, f"{number(value)} {dimension}".strip())
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
