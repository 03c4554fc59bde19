"""What of a text's loads, masses, guides and drives can be drawn before it is a model."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress

from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.joints.base import JOINTS
from linkwright.server.entries import section, texts, word

#: Keys that give a load its size, and of what dimension it is, by its kind.
_SIZES = ("magnitude", "ramp", "stiffness", "damping")
_DIMENSIONS = {"force": "force", "torque": "torque", "pressure": "pressure"}
#: How a force is directed, by the key that says it.
_HELD = {"direction": "space", "components": "space", "in_link": "link", "along": "ray", "normal_to": "ray"}


def applied(root: Node) -> Plain:
    """Loads, ``gravity`` (m/s², None: none), ``masses`` of links, ``guides`` (joints along which a block slides) and
    ``drives``."""
    return {
        "loads": {name: _load(entry) for name, entry in _entries(root, "loads")},
        "gravity": _numbers(root.get("gravity") if isinstance(root, MappingNode) else None, "acceleration") or None,
        "masses": {name: _mass(link) for name, link in _entries(root, "links") if link.get("mass") is not None},
        "guides": {name: _guide(joint) for name, joint in _entries(root, "joints") if _slides(joint)},
        "drives": {name: _drive(entry) for name, entry in _driving(root)},
    }


def _entries(root: Node, key: str) -> Iterator[tuple[str, MappingNode]]:
    for name, entry in section(root, key) or ():
        if isinstance(entry, MappingNode):
            yield name, entry


def _load(load: MappingNode) -> Plain:
    """A load as it is drawn.

    ``angle``: direction of a force in space (rad); ``turn``: in the axes of its link; ``ray``: two points of the link
    along which (``normal``: along whose left normal) it acts; ``held``: in what the direction stays. ``ends``: points
    between which it acts, ``between`` with their links. ``magnitude``: SI, None where it is no plain number.
    """
    components = _numbers(load.get("components"), "force")
    ends, links = texts(load.get("between")), texts(load.get("links"))
    angle, magnitude = _quantity(load.get("direction"), "angle"), _magnitude(load)
    if components:
        angle, magnitude = math.atan2(components[1], components[0]), math.hypot(*components)
    size = " ".join(filter(None, (word(load, key) for key in ("magnitude", "stiffness", "damping"))))
    return {
        "kind": word(load, "kind"),
        "on": word(load, "on"),
        "at": word(load, "at"),
        "angle": angle,
        "ends": [end.split(".")[-1] for end in ends or links],
        "size": size or ", ".join(texts(load.get("components")) or texts(load.get("ramp"))),
        "held": next((held for key, held in _HELD.items() if load.get(key) is not None), word(load, "opposes")),
        "turn": _quantity(load.get("in_link"), "angle"),
        "ray": texts(load.get("along")) or texts(load.get("normal_to")),
        "normal": load.get("normal_to") is not None,
        "between": [end.split(".", 1) for end in ends if "." in end],
        "links": links,
        "joint": word(load, "joint"),
        "magnitude": magnitude,
        "stiffness": _quantity(load.get("stiffness"), "stiffness"),
        "preload": _quantity(load.get("preload"), "force"),
        "always": load.get("phase") is None,
    }


def _magnitude(load: MappingNode) -> float | None:
    """Largest size that is written as a number, with its sign."""
    dimension = _DIMENSIONS.get(word(load, "kind"))
    if dimension is None:
        return None
    plain = _quantity(load.get("magnitude"), dimension)
    return plain if plain is not None else max(_numbers(load.get("ramp"), dimension), key=abs, default=None)


def _mass(link: MappingNode) -> Plain:
    """Mass (kg) and where its centre is: a point's name, coordinates in the link's axes (m), or None: midway."""
    centre = link.get("mass_centre")
    place = _numbers(centre, "length")
    return {
        "mass": _quantity(link.get("mass"), "mass"),
        "size": word(link, "mass"),
        "centre": centre.text if isinstance(centre, Scalar) else place or None,
    }


def _slides(joint: MappingNode) -> bool:
    kind = word(joint, "kind")
    return kind in JOINTS and JOINTS[kind].coordinate == "slide"


def _guide(joint: MappingNode) -> Plain:
    """``direction``: rad in the axes of the guide's link, None where ``ray``, two points of it, gives it."""
    direction = joint.get("direction")
    return {
        **{key: word(joint, key) for key in ("guide", "through", "block", "at")},
        "direction": _quantity(direction, "angle"),
        "ray": texts(direction),
    }


def _driving(root: Node) -> Iterator[tuple[str, MappingNode]]:
    single = section(root, "driver")
    if single is not None:
        yield "driver", single
    yield from _entries(root, "drivers")


def _drive(entry: MappingNode) -> Plain:
    """The link that is turned and its pin, or the joint along which it slides; its speed as written and in SI."""
    kind = "angular_velocity" if entry.get("turn") is not None else "velocity"
    words = {key: word(entry, key) for key in ("turn", "about", "slide", "speed")}
    return {**words, "rate": _quantity(entry.get("speed"), kind)}


def _quantity(node: Node | None, dimension: str) -> float | None:
    return _read(node.text, dimension) if isinstance(node, Scalar) else None


def _numbers(node: Node | None, dimension: str) -> list[float]:
    """The SI values of a list; none where one of them is no plain number."""
    found = [_read(text, dimension) for text in texts(node)]
    return [each for each in found if each is not None] if None not in found else []


def _read(text: str, dimension: str) -> float | None:
    with suppress(QuantityError, ValueError):
        return amount(text, dimension)
    return None
