"""A text that need not be a model yet: entries put in and taken out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.files.compose import compose
from linkwright.files.model_file import read_text
from linkwright.files.write import Document, content_end, flow, scalar
from linkwright.server.entries import extent, fresh, section
from linkwright.server.picture import completed, picture_of
from linkwright.words import _

#: Drawings below this size have finer steps, of this at least, m.
SMALL, FINEST = 0.03, 1e-8


class Draft(Document):
    """A text that need not be a model yet: what is written into it is not checked.

    ``places``: where points stand that no drawing gives, m.
    """

    def __init__(self, text: str, places: Mapping[str, list[float]] | None = None) -> None:
        self.name, self.text = "model", text.removeprefix("\ufeff")
        self.places = dict(places or {})
        #: Names of new elements, in the order in which they were made.
        self.made: list[str] = []
        #: New names of elements: kind, from, to.
        self.renamed: list[dict[str, str]] = []
        self._tree_of: tuple[str, Node | None] = "", None
        self._picture_of: tuple[str, Plain] | None = None

    def picture(self) -> Plain:
        """What can be drawn by the text alone; read, not changed."""
        if self._picture_of is None or self._picture_of[0] != self.text:
            self._picture_of = self.text, picture_of(self.root)
        return self._picture_of[1]

    def shown(self) -> Plain:
        """What can be drawn, with the points that no drawing gives."""
        found = self.picture()
        return {**found, "points": {**self.places, **found["points"]}}

    @property
    def taken(self) -> set[str]:
        """Names of links and joints, which share them."""
        return {*self.picture()["links"], *(key for key, _unused in self.section("joints") or ())}

    @property
    def step(self) -> float:
        """What drawn coordinates and measured lengths are multiples of, m: 0.1 mm, less in a machine below 30 mm."""
        size = extent(self.shown()["points"].values())
        return 1e-4 if not 0 < size < SMALL else max(FINEST, 10.0 ** (math.floor(math.log10(size / SMALL)) - 4))

    def where(self, point: str) -> complex:
        """Where a point is drawn, m; raises LinkwrightError where nothing tells."""
        places = self.shown()["points"]
        if point not in places:
            raise LinkwrightError(
                _("there is no place for the point {name!r} on the paper", code="studio.no_point", name=point)
            )
        return complex(*places[point])

    def complete(self, points: Iterable[str]) -> None:
        """Finds where points of links stand that nothing draws, where the text makes a machine."""
        shown = self.shown()
        used = {point for each in shown["links"].values() for point in each}
        if set(points) & used <= set(shown["points"]):
            return
        mechanism, _unused = read_text(self.text, self.name)
        if mechanism is not None:
            from linkwright.kinematics.solve import solve_motion

            with suppress(LinkwrightError):
                self.places |= completed(shown, solve_motion(mechanism))["points"]

    def draw(self, point: str, place: complex, *, fixed: bool | None = None, fine: bool = False) -> None:
        """Writes where a point stands; ``fixed``: in the frame (None: where it is), ``fine``: in tenths of a step."""
        written = coordinates(place, self.step * (0.1 if fine else 1.0))
        if not (point in self.picture()["fixed"] if fixed is None else fixed):
            self.put("drawing", point, written)
            return
        points = section(self.root, "frame", "points")
        if points is None:
            self.put("frame", "points", {point: written})
        else:
            self.write_key(points, point, flow(written))

    @property
    def root(self) -> MappingNode:
        """The tree; raises LinkwrightError for a text that has none."""
        if self._tree_of[0] != self.text:
            self._tree_of = self.text, compose(self.text)[0]
        root = self._tree_of[1]
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

    def put_new(self, section: str, stem: str, value: Any) -> str:
        """Write an entry of a section under the first of stem1, stem2, … that is free, which it gives."""
        name = fresh(stem, [key for key, _unused in self.section(section) or ()])
        self.put(section, name, value)
        self.made.append(name)
        return name

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
    """What of a text can be drawn before it is a model."""
    return Draft(text).picture()


def length(value: float, step: float) -> str:
    """A length or coordinate (m) as a multiple of a step."""
    digits = max(0, -math.floor(math.log10(step) + 3 + 1e-9))
    text = f"{round(value / step) * step * 1e3:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return f"{'0' if text == '-0' else text} mm"


def coordinates(place: complex, step: float) -> list[str]:
    """Coordinates (m) of a place."""
    return [length(each, step) for each in (place.real, place.imag)]


def _block(entries: Mapping[str, Any], indent: str) -> list[str]:
    lines = []
    for key, value in entries.items():
        if isinstance(value, Mapping) and value:
            lines += [f"{indent}{scalar(str(key))}:", *_block(value, indent + "  ")]
        else:
            lines.append(f"{indent}{scalar(str(key))}: {flow(value)}")
    return lines
