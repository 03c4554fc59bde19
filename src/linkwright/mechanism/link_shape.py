"""The plate of a link: its outline in the link's axes, with the holes that are bored for its pins."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from linkwright.errors import LinkwrightError
from linkwright.mechanism.construction import MATERIALS, LinkShape, Material, ShapeKind
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.shapes.shape import Piece, Shape, bar, disc, polygon
from linkwright.words import _

#: A size by the name of its link or pin, m.
Sizes = Callable[[str], float] | Mapping[str, float]
#: Points are in line that are not farther off it than this share of their extent.
IN_LINE = 1e-9


def link_shape(mechanism: Mechanism, link: str, width: Sizes, pin_radius: Sizes) -> Shape:
    """The outline of a link's plate, the frame's included, with a hole for every pin of the link.

    ``width`` by the name of a link, for one whose shape has no width of its own, and ``pin_radius`` by the name of a
    pin, m: the nominal one, without the fit; a pin of radius 0 has no hole. Raises LinkwrightError for a link that
    takes no room (``shape: none``).
    """
    body = mechanism.link(link)
    own = LinkShape() if body.shape is None else body.shape
    breadth = own.width or (_size(width, link) if needs_width(body) else 0.0)
    return replace(_plate(body, own, breadth), holes=pin_holes(mechanism, link, pin_radius))


def shape_kind(link: Link) -> ShapeKind:
    """What the shape of a link is: as its file says, else a bar of points in line, a plate of others."""
    if link.shape is not None and link.shape.kind is not None:
        return link.shape.kind
    return "bar" if in_line([complex(*each) for each in link.points.values()]) else "plate"


def needs_width(link: Link) -> bool:
    """Whether the plate of a link has a width."""
    return shape_kind(link) in ("bar", "plate", "path")


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


def in_line(points: list[complex]) -> bool:
    """Whether points lie on one line."""
    first, last = ends(points)
    way = last - first
    return all(abs((way.conjugate() * (each - first)).imag) <= IN_LINE * abs(way) ** 2 for each in points)


def ends(points: list[complex]) -> tuple[complex, complex]:
    """The two ends of points that are in line; of others two that are far apart."""
    first = max(points, key=lambda each: abs(each - points[0]))
    last = max(points, key=lambda each: abs(each - first))
    return (first, last) if points.index(first) <= points.index(last) else (last, first)


def path_of(link: Link, shape: LinkShape) -> list[complex]:
    """The places through which a bar or a path goes, m, in the link's axes."""
    if shape.through:
        return [complex(*(link.points[each] if isinstance(each, str) else each)) for each in shape.through]
    points = [complex(*each) for each in link.points.values()]
    if not in_line(points):
        return points
    first, last = ends(points)
    return sorted(dict.fromkeys(points), key=lambda each: ((last - first).conjugate() * (each - first)).real)


def hull(points: list[complex]) -> list[complex]:
    """The corners of the convex hull, counter-clockwise (Andrew's monotone chain); two of points in line."""

    def chain(order: list[complex]) -> list[complex]:
        found: list[complex] = []
        for each in order:
            while len(found) > 1 and ((found[-1] - found[-2]).conjugate() * (each - found[-1])).imag <= 0.0:
                found.pop()
            found.append(each)
        return found[:-1]

    order = sorted(dict.fromkeys(points), key=lambda each: (each.real, each.imag))
    return chain(order) + chain(order[::-1]) if len(order) > 1 else order


def _plate(link: Link, shape: LinkShape, width: float) -> Shape:
    kind = shape_kind(link)
    points = [complex(*each) for each in link.points.values()]
    match kind:
        case "none":
            raise LinkwrightError(
                _('the link "{link}" takes no room (shape: none)', code="shapes.none", link=link.name)
            )
        case "disc":
            return disc(points[0], shape.radius or 0.0)
        case "outline":
            outer, *holes = ([complex(*each) for each in ring] for ring in shape.rings)
            return polygon(outer, holes)
        case "plate" if not in_line(points):
            import numpy as np

            return Shape((Piece((np.array(hull(points)),), 0.5 * width, filled=True),))
    return bar(path_of(link, shape), width)


def _size(sizes: Sizes, name: str) -> float:
    return sizes[name] if isinstance(sizes, Mapping) else sizes(name)
