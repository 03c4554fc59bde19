"""Copies of links: with their points, and the joints, loads and actuators between them, shifted or mirrored."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from typing import Any, TypeGuard

from linkwright.core.data import Plain
from linkwright.core.expressions import amount, is_literal
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.server.drawn import all_points, new_point
from linkwright.server.entries import fresh, word
from linkwright.server.outline import outlined
from linkwright.server.references import named
from linkwright.server.sizes import angle
from linkwright.words import _

#: Keys whose words are points of the link beside them; values that change their sign in a mirror.
POINTS = ("at", "through", "along", "normal_to", "direction")
TURNED = ("angle", "offset", "block_angle", "phase", "in_link", "free_angle")
SIDES = {"left": "right", "right": "left"}


class _Copy:
    """New names of links and points, and where these go."""

    def __init__(self, draft: Draft, source: Draft, links: list[str], points: list[str], mirror: str) -> None:
        self.mirror = mirror
        fixed = source.picture()["fixed"]
        taken = draft.taken
        self.links: dict[str, str] = {}
        for name in links:
            self.links[name] = _numbered(name, {*taken, *self.links.values()})
        self.points: dict[str, str] = {}
        for name in points:
            known = {*all_points(draft), *self.points.values()}
            stem = re.match(r"\D*", name)
            new = new_point(draft, name in fixed, stem[0] if name in fixed and stem else "", known)
            self.points[name] = new

    def link(self, entry: MappingNode) -> Plain:
        """A link's entry with the new names of its points."""
        data: Plain = outlined(entry)
        for key in ("points", "also"):
            if isinstance(data.get(key), dict):
                data[key] = {self.points[name]: self.place(place) for name, place in data[key].items()}
            elif key in data:
                data[key] = [self.points.get(name, name) for name in data[key]]
        centre = data.get("mass_centre")
        if centre is not None:
            data["mass_centre"] = self.place(centre) if isinstance(centre, list) else self.points.get(centre, centre)
        if "angle" in data:
            data["angle"] = self.sign(data["angle"])
        if isinstance(data.get("shape"), dict):
            data["shape"] = {key: self.of_shape(key, value) for key, value in data["shape"].items()}
        return data

    def of_shape(self, key: str, value: Any) -> Any:
        """A value of a link's shape: points by their new names, places and outlines mirrored."""
        if key == "through" and isinstance(value, list):
            return [self.place(each) if isinstance(each, list) else self.points.get(each, each) for each in value]
        if key == "outline" and isinstance(value, list):
            return [self.place(each) for each in value]
        return [self.of_shape("outline", each) for each in value] if key == "holes" else value

    def place(self, place: Any) -> Any:
        """Coordinates in a link's axes."""
        return [place[0], self.sign(place[1])] if isinstance(place, list) and len(place) == 2 else place

    def sign(self, text: Any) -> Any:
        """A number that changes its sign in a mirror."""
        if not self.mirror or not isinstance(text, str) or text.strip() in ("0", ""):
            return text
        if is_literal(text):
            return text[1:].strip() if text.startswith("-") else text if text.startswith("0 ") else f"-{text}"
        return f"-({text})"

    def heading(self, text: str) -> str:
        """A direction in space."""
        if self.mirror != "x":
            return str(self.sign(text))
        try:
            return angle(math.remainder(math.pi - amount(text, "angle"), 2 * math.pi))
        except QuantityError:
            return f"180 deg - ({text})"

    def element(self, entry: MappingNode) -> Plain:
        """An entry of the joints, loads or actuators."""
        data: Plain = outlined(entry)
        space = data.get("guide", "frame") == "frame"
        return {key: self._value(key, value, space=space) for key, value in data.items()}

    def actuator(self, entry: MappingNode) -> Plain:
        """An entry of the actuators: a constant torque turns round in a mirror."""
        data = self.element(entry)
        turned = {"torque": self.sign(data["torque"])} if data["kind"] == "constant" and "torque" in data else {}
        return {**data, **turned}

    def _value(self, key: str, value: Any, *, space: bool) -> Any:
        if isinstance(value, list):
            if key == "components":
                return [
                    self.sign(each) if axis == self.mirror else each for axis, each in zip("xy", value, strict=True)
                ]
            return [self._value(key, each, space=space) for each in value]
        if not isinstance(value, str) or key == "kind":
            return value
        link, dot, point = value.partition(".")
        if dot and (link in self.links or link == "frame") and point in self.points:
            return f"{self.links.get(link, link)}.{self.points[point]}"
        if key in POINTS and value in self.points:
            return self.points[value]
        if key not in POINTS and value in self.links:
            return self.links[value]
        if key == "direction":
            return self.heading(value) if space else self.sign(value)
        if key in TURNED or (key in ("magnitude", "ramp") and _is_torque(value)):
            return self.sign(value)
        return SIDES.get(value, value) if self.mirror and key == "side" else value


def _is_torque(text: str) -> bool:
    with suppress(QuantityError):
        return amount(text, "torque") != 0
    return False


def paste(draft: Draft, action: Mapping[str, Any]) -> None:
    """Copies of items, moved by a shift, mirrored before about their middle: x from left to right, y upside down.

    ``of``: the text that they are taken from, where that is another one, as of what has been cut.
    """
    source = Draft(request.text(action, "of")) if "of" in action else draft
    items, shift = request.mappings(action, "items"), complex(*request.place(action, "shift"))
    mirror = request.text(action, "mirror", "") if action.get("mirror") else ""
    if mirror not in ("", "x", "y"):
        request.refuse("mirror", "name")
    links = _links(source, items)
    shown = source.picture()
    points = list(dict.fromkeys(point for link in links for point in shown["links"][link]))
    chosen = [request.name(item, "name") for item in items if item.get("kind") == "point"]
    points += [name for name in dict.fromkeys(chosen) if name in shown["fixed"] and name not in points]
    inside = [(key, each) for key, each in source.section("joints") or () if _within(each, source, links)]
    loads = [each for _unused, each in source.section("loads") or () if _within(each, source, links)]
    acting = [each for _unused, each in source.section("actuators") or () if _within(each, source, links)]
    for _unused, joint in inside:
        through = word(joint, "through")
        if word(joint, "guide") == "frame" and through not in points:
            points.append(through)
    if not points:
        raise LinkwrightError(_("there is nothing to copy", code="studio.no_copy"))
    source.complete(points)
    copy = _Copy(draft, source, links, points, mirror)
    _draw(draft, source, copy, _moved([source.where(each) for each in points], mirror, shift))
    for old, new in copy.links.items():
        draft.put("links", new, copy.link(source.link(old)))
        draft.made.append(new)
    for key, joint in inside:
        draft.put("joints", *_joint(draft, copy, key, copy.element(joint)))
    for load in loads:
        draft.put_new("loads", word(load, "kind") or "load", copy.element(load))
    for actuator in acting:
        if actuator.get("along") is None:
            draft.put_new("actuators", word(actuator, "kind") or "actuator", copy.actuator(actuator))
    for old, new in copy.points.items():
        how = word(source.section("assembly") or MappingNode(0, 0, 0, 0), old)
        if how:
            draft.put("assembly", new, SIDES.get(how, how) if mirror else how)


def _links(draft: Draft, items: list[dict[str, Any]]) -> list[str]:
    """The links that are copied: those chosen, blocks of chosen pairs, and blocks on points of chosen links."""
    shown = draft.picture()["links"]
    found = []
    for item in items:
        name = request.name(item, "name")
        if item.get("kind") == "link":
            draft.link(name)
            found.append(name)
    pairs = [item["name"] for item in items if item.get("kind") == "pair"]
    points = {point for link in found for point in shown[link]}
    for key, joint in draft.section("joints") or ():
        if not isinstance(joint, MappingNode):
            continue
        block = word(joint, "block")
        if len(shown.get(block, ())) == 1 and (key in pairs or points & set(shown[block])):
            found += [block] if word(joint, "guide") in ("frame", *found) else []
    return list(dict.fromkeys(found))


def _within(entry: Node, draft: Draft, links: Collection[str]) -> TypeGuard[MappingNode]:
    """Whether an entry is about chosen links, and no others but the frame."""
    if not isinstance(entry, MappingNode):
        return False
    about = set(named(entry)) & {*draft.picture()["links"]}
    return bool(about) and about <= set(links)


def _moved(places: list[complex], mirror: str, shift: complex) -> Callable[[complex], complex]:
    """Where a place of the original is in the copy."""
    x = [each.real for each in places]
    y = [each.imag for each in places]
    middle = complex(min(x) + max(x), min(y) + max(y))

    def moved(at: complex) -> complex:
        if mirror == "x":
            at = complex(middle.real - at.real, at.imag)
        elif mirror == "y":
            at = complex(at.real, middle.imag - at.imag)
        return at + shift

    return moved


def _draw(draft: Draft, source: Draft, copy: _Copy, moved: Callable[[complex], complex]) -> None:
    fixed = source.picture()["fixed"]
    for old, new in copy.points.items():
        draft.draw(new, moved(source.where(old)), fixed=old in fixed, fine=True)
        draft.made.append(new)


def _joint(draft: Draft, copy: _Copy, key: str, entry: Plain) -> tuple[str, Plain]:
    """A joint's new name with its entry: of a pin that of its point."""
    if key in copy.points:
        return copy.points[key], entry
    name = _numbered(key, {*(each for each, _unused in draft.section("joints") or ()), *draft.picture()["links"]})
    draft.made.append(name)
    return name, entry


def _numbered(name: str, taken: Collection[str]) -> str:
    """The name with the first number that is free."""
    stem = name.rstrip("0123456789") or name
    return fresh(stem, {*taken, f"{stem}1"})
