"""The plate of a link: its outline in the link's axes, with the holes that are bored for its pins."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from linkwright.mechanism.construction import MATERIALS, Material
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.plate import ends, hull, in_line, needs_width, path_of, plate, shape_kind
from linkwright.shapes.shape import Shape

__all__ = [
    "ends",
    "hull",
    "in_line",
    "link_shape",
    "material_of",
    "needs_width",
    "path_of",
    "pin_holes",
    "plate",
    "shape_kind",
]

#: A size by the name of its link or pin, m.
Sizes = Callable[[str], float] | Mapping[str, float]


def link_shape(mechanism: Mechanism, link: str, width: Sizes, pin_radius: Sizes) -> Shape:
    """The outline of a link's plate, the frame's included, with a hole for every pin of the link.

    ``width`` by the name of a link, for one whose shape has no width of its own, and ``pin_radius`` by the name of a
    pin, m: the nominal one, without the fit; a pin of radius 0 has no hole. Raises LinkwrightError for a link that
    takes no room (``shape: none``).
    """
    body = mechanism.link(link)
    own = None if body.shape is None else body.shape.width
    breadth = _size(width, link) if needs_width(body) and own is None else 0.0
    return replace(plate(body, breadth), holes=pin_holes(mechanism, link, pin_radius))


def material_of(mechanism: Mechanism, link: str) -> Material:
    """The material of a link's plate: its own, else that of the construction, else steel."""
    shape, construction = mechanism.link(link).shape, mechanism.construction
    own = None if shape is None else shape.material
    return own or (MATERIALS["steel"] if construction is None else construction.material)


def pin_holes(mechanism: Mechanism, link: str, pin_radius: Sizes) -> tuple[tuple[complex, float], ...]:
    """Centre (m, in the link's axes) and radius (m) of the hole of every pin of a link."""
    points = mechanism.link(link).points
    pins = (name for name, pin in mechanism.pins.items() if link in pin.joined)
    found = [(complex(*points[name]), _size(pin_radius, name)) for name in pins]
    return tuple((centre, radius) for centre, radius in found if radius > 0.0)


def _size(sizes: Sizes, name: str) -> float:
    return sizes[name] if isinstance(sizes, Mapping) else sizes(name)
