"""A text that need not be a model yet: entries put in and taken out, and what of it can be drawn."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.files.compose import compose
from linkwright.files.write import Document, content_end, flow, scalar
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion


class Draft(Document):
    """A text that need not be a model yet: what is written into it is not checked.

    ``places``: where points stand that no drawing gives, m.
    """

    def __init__(self, text: str, places: Mapping[str, list[float]] | None = None) -> None:
        self.name, self.text = "model", text.removeprefix("\ufeff")
        self._places = dict(places or {})

    def shown(self) -> Plain:
        """What can be drawn, with the points that no drawing gives."""
        found = picture(self.text)
        return {**found, "points": {**self._places, **found["points"]}}

    @property
    def root(self) -> MappingNode:
        """The tree; raises LinkwrightError for a text that has none."""
        root, _unused = compose(self.text)
        if root is None:
            return MappingNode(0, 0, 0, 0)
        if not isinstance(root, MappingNode):
            raise LinkwrightError(
                _(
                    "the text is a list or a single value; begin with keys such as frame and links",
                    code="studio.no_mapping",
                )
            )
        if root.flow:
            raise LinkwrightError(
                _(
                    "this text is one mapping in braces; drawing goes into files that are written line "
                    "by line, so write this one so, or begin a new one",
                    code="studio.braces",
                )
            )
        return root

    def section(self, name: str) -> MappingNode | None:
        """The mapping behind a key of the top."""
        found = self.root.get(name)
        return found if isinstance(found, MappingNode) else None

    def link(self, name: str) -> MappingNode:
        """The entry of a link; raises LinkwrightError where there is none."""
        links = self.section("links")
        found = links.get(name) if links is not None else None
        if not isinstance(found, MappingNode):
            raise LinkwrightError(_("there is no link {name!r} in the text", code="studio.no_link", name=name))
        return found

    def put(self, section: str, key: str, value: Any) -> None:
        """Write an entry of a section, which is added at the end where it is missing."""
        found = self.section(section)
        if found is None:
            self._append(f"{section}:\n  {scalar(key)}: {flow(value)}")
        else:
            self.write_key(found, key, flow(value))

    def put_new(self, section: str, stem: str, value: Any) -> None:
        """Write an entry of a section under the first of stem1, stem2, … that is free."""
        self.put(section, fresh(stem, [key for key, _unused in self.section(section) or ()]), value)

    def write_key(self, node: MappingNode, key: str, text: str) -> None:
        """Writes a text as what a key of a mapping has."""
        if (old := node.get(key)) is not None:
            self.write(old, text)
        else:
            self.text = self._added(self.text, node, scalar(key), text).made(self.text)

    def write(self, node: Node, text: str) -> None:
        """Writes a text in place of a node."""
        start, end = node.start, node.end
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
            self.write(old, flow(value))

    def put_section(self, key: str, entries: Mapping[str, Any]) -> None:
        """Write a complete section, a line for each entry, those of mappings below them; without entries it goes."""
        old = next((entry for entry in self.root.entries if entry.key.text == key), None)
        if not entries:
            if old is not None:
                self.cut_top(key)
            return
        text = "\n".join([f"{key}:", *_block(entries, "  ")])
        if old is None:
            self._append(text)
            return
        self.text = self.text[: old.key.start] + text + self.text[content_end(old) :]

    def take_out(self, section: str, key: str) -> None:
        """Take an entry out of a section, and the section with its last entry."""
        found = self.section(section)
        if found is None or len(found.entries) == 1:
            self.cut_top(section)
        else:
            self.cut(found, key)

    def cut(self, found: MappingNode, key: str) -> None:
        """Take one of several entries out of a mapping."""
        place = [entry.key.text for entry in found.entries].index(key)
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

    def cut_top(self, key: str) -> None:
        """Take a key of the top out."""
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
    """What of a text can be drawn before it is a model: points (m), links with their points, fixed points, driver,
    loads with the points or links that they act on and the direction of a force (rad)."""
    draft = Draft(text)
    frame = draft.section("frame")
    fixed = _places(frame.get("points") if frame is not None else None)
    links = {}
    for name, link in draft.section("links") or ():
        points = link.get("points") if isinstance(link, MappingNode) else None
        names = [name for name, _unused in points] if isinstance(points, MappingNode) else texts(points)
        also = link.get("also") if isinstance(link, MappingNode) else None
        links[name] = [*names, *(point for point, _unused in also)] if isinstance(also, MappingNode) else names
    driver = draft.section("driver")
    turned = driver.get("turn") if driver is not None else None
    loads = [(name, load) for name, load in draft.section("loads") or () if isinstance(load, MappingNode)]
    return {
        "points": {**_places(draft.root.get("drawing")), **fixed},
        "fixed": list(fixed),
        "links": links,
        "driver": turned.text if isinstance(turned, Scalar) else None,
        "guided": [
            each.text
            for _unused, joint in draft.section("joints") or ()
            if isinstance(joint, MappingNode)
            and joint.get("block") is not None
            and isinstance(each := joint.get("at"), Scalar)
        ],
        "loads": {name: _load(load) for name, load in loads},
    }


def _load(load: MappingNode) -> Plain:
    """A load as it is drawn: its words, the link and point that it acts on, its direction in space (rad)."""
    angle, components = None, texts(load.get("components"))
    with suppress(QuantityError, ValueError):
        x, y = (amount(each, "force") for each in components) if components else (0.0, 0.0)
        angle = math.atan2(y, x) if components else amount(word(load, "direction"), "angle")
    ends = texts(load.get("between")) or texts(load.get("links"))
    size = " ".join(filter(None, (word(load, key) for key in ("magnitude", "stiffness", "damping")))) or components
    return {
        "kind": word(load, "kind"),
        "on": word(load, "on"),
        "at": word(load, "at"),
        "angle": angle,
        "ends": [end.split(".")[-1] for end in ends],
        "size": size if isinstance(size, str) else ", ".join(size),
    }


def completed(shown: Plain, motion: Motion) -> Plain:
    """What can be drawn, with the points that no drawing gives where the solved machine has them (``placed``)."""
    missing = {point for points in shown["links"].values() for point in points} - set(shown["points"])
    if not missing:
        return shown
    places, there = {}, _as_drawn(motion)
    for point in sorted(missing):
        keys = [f"{link}.{point}" for link, points in shown["links"].items() if point in points]
        known = next((key for key in (point, *keys) if key in there.point_names()), None)
        if known is not None:
            places[point] = [float(each) for each in there.point(known).position[0]]
    return {**shown, "points": {**shown["points"], **places}, "placed": list(places)}


def _as_drawn(motion: Motion) -> Motion:
    """The machine in the position of its drawing, where that can be had; else from its first position on."""
    from linkwright.kinematics.solve import solve_motion
    from linkwright.mechanism.drawing import Drawing

    drawing = Drawing(motion.mechanism)
    names = motion.mechanism.drivers
    at = {name: q for name in names if (q := drawing.driver(name)) is not None}
    if at and len(at) == len(names):
        with suppress(LinkwrightError):
            return solve_motion(motion.mechanism, at=at)
    return motion


def word(entry: MappingNode, key: str) -> str:
    """The text of a key; "" where there is none."""
    node = entry.get(key)
    return node.text if isinstance(node, Scalar) else ""


def fresh(stem: str, known: Iterable[str]) -> str:
    """The first of stem1, stem2, … that is not known."""
    place, taken = 1, set(known)
    while f"{stem}{place}" in taken:
        place += 1
    return f"{stem}{place}"


def texts(node: Node | None) -> list[str]:
    """The scalars of a list."""
    items = node.items if isinstance(node, Sequence) else []
    return [each.text for each in items if isinstance(each, Scalar)]


def _places(node: Node | None) -> dict[str, list[float]]:
    found = {}
    for name, place in node if isinstance(node, MappingNode) else ():
        try:
            found[name] = [amount(text, "length") for text in texts(place)]
        except QuantityError:
            continue
    return {name: place for name, place in found.items() if len(place) == 2}


def _block(entries: Mapping[str, Any], indent: str) -> list[str]:
    lines = []
    for key, value in entries.items():
        if isinstance(value, Mapping) and value:
            lines += [f"{indent}{scalar(str(key))}:", *_block(value, indent + "  ")]
        else:
            lines.append(f"{indent}{scalar(str(key))}: {flow(value)}")
    return lines
