"""The plate of a link: what it is by its points and its shape, its outline in the link's axes, its material."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.plane import convex_hull
from linkwright.errors import LinkwrightError
from linkwright.mechanism.construction import Construction, LinkShape, Material, ShapeKind
from linkwright.mechanism.link import Link
from linkwright.shapes.shape import Piece, Shape, bar, disc, polygon
from linkwright.words import _

#: Points are in line that are not farther off it than this share of their extent.
IN_LINE = 1e-9


def plate(link: Link, width: float) -> Shape:
    """The outline of a link's plate without holes; ``width``, m: of one whose shape has none of its own.

    Raises LinkwrightError for a link that takes no room (``shape: none``).
    """
    shape, kind = link.shape or LinkShape(), shape_kind(link)
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
        case "plate":
            return around(points, shape.width or width)
    return bar(path_of(link, shape), shape.width or width)


def around(points: Sequence[complex], width: float) -> Shape:
    """The convex hull of points, widened by half a width (m): a bar where they are in line, a disc about one."""
    if in_line(points):
        return bar(dict.fromkeys(ends(points)), width)
    return Shape((Piece((convex_hull(np.array(points)),), 0.5 * width, filled=True),))


def material_of(link: Link, construction: Construction | None) -> Material:
    """The material of a link's plate: its own, else that of the construction, else steel."""
    return (link.shape and link.shape.material) or (construction or Construction()).material


def shape_kind(link: Link) -> ShapeKind:
    """What the shape of a link is: as its file says, else a bar of points in line, a plate of others."""
    if link.shape is not None and link.shape.kind is not None:
        return link.shape.kind
    return "bar" if in_line([complex(*each) for each in link.points.values()]) else "plate"


def needs_width(link: Link) -> bool:
    """Whether the plate of a link has a width."""
    return shape_kind(link) in ("bar", "plate", "path")


def in_line(points: Sequence[complex]) -> bool:
    """Whether points lie on one line."""
    first, last = ends(points)
    way = last - first
    return all(abs((way.conjugate() * (each - first)).imag) <= IN_LINE * abs(way) ** 2 for each in points)


def ends(points: Sequence[complex]) -> tuple[complex, complex]:
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
