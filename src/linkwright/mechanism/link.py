"""Links with their points, and where the points are in a link's axes: one function for floats and traced values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal, TypeVar

from linkwright.fields.base import Field, Quantities, Quantity
from linkwright.fields.body import BODY_FIELDS
from linkwright.fields.references import Coordinates, LinkPoints
from linkwright.fields.shape_of_link import LinkShape, ShapeField
from linkwright.words import _

T = TypeVar("T")
Vec = tuple[float, float]
Pair = tuple[Any, Any]
Geometry = Literal["length", "bent", "coordinates", "drawing", "point"]

LINK_FIELDS: Mapping[str, Field] = {
    "points": LinkPoints(required=True, doc=_("the link's points: [A, B], or {{A: [x, y], …}} in its own axes")),
    "length": Quantity("length", above=0, doc=_("distance from the first point to the second")),
    "lengths": Quantities("length", count=2, above=0, doc=_("bent link: first to second, first to third point")),
    "angle": Quantity("angle", doc=_("bent link: angle from the first length to the second")),
    "also": Coordinates(doc=_("further points, by coordinates in the link's axes")),
    **BODY_FIELDS,
}
FRAME_FIELDS: Mapping[str, Field] = {
    "points": Coordinates(required=True, doc=_("fixed points: {{O1: [0 m, 0 m], …}}")),
    "shape": ShapeField(doc=_("shape of the frame's plate: a word, or a table (default: bar, or plate)")),
}


@dataclass(frozen=True)
class Link:
    """A rigid link with named points in its own axes (m), mass (kg) and moment of inertia about its centre
    (kg·m²).

    ``geometry`` says how the user gave it: ``length`` (two points), ``bent`` (two lengths and an angle),
    ``coordinates``, ``drawing`` (from the coordinates of an assembled drawing), ``point`` (one point, at
    the origin).
    ``points`` holds all points in order, those of ``also`` last. ``mass_centre`` may name one of them;
    None means the default: midway between the first two points, or at the only one. ``colour``: in which it is
    drawn, a name or #rrggbb; empty for that of all lines. ``shape``: of its plate, None for the usual one;
    ``mass_from_shape``: whether mass, inertia and mass centre follow from it.
    """

    name: str
    geometry: Geometry
    points: Mapping[str, Vec]
    lengths: tuple[float, ...] = ()
    angle: float = 0.0
    mass: float = 0.0
    inertia: float = 0.0
    mass_centre: Vec | str | None = None
    colour: str = ""
    shape: LinkShape | None = None
    mass_from_shape: bool = False

    def fields(self) -> Mapping[str, Field]:
        """What a file may say about the link."""
        return FRAME_FIELDS if self.name == "frame" else LINK_FIELDS

    @property
    def centre(self) -> Vec:
        """Mass centre in the link's axes, m."""
        x, y = centre(self, self.points, self.dimensions().__getitem__)
        return float(x), float(y)

    @cached_property
    def reach(self) -> float:
        """The largest coordinate of a point, m."""
        return max((abs(each) for place in self.points.values() for each in place), default=0.0)

    @cached_property
    def coinciding(self) -> tuple[int, ...]:
        """Of points at one place the number of the first, none where all are distinct."""
        first, places = dict[Vec, int](), self.points.values()
        if len(set(places)) == len(places):
            return ()
        return tuple([first.setdefault(place, i) for i, place in enumerate(places)])

    def geometry_dimensions(self) -> dict[str, float]:
        """Addresses of the dimensions that place the points, with their SI values."""
        found: dict[str, float] = {}
        for index, (point, (x, y)) in enumerate(self.points.items()):
            addresses = point_addresses(self, index, point)
            if addresses is not None:
                found.update(zip(addresses, (x, y), strict=True))
            elif index == 1:
                found[second_point_address(self, point)] = self.lengths[0] if self.lengths else x
            elif index == 2:
                found[f"{self.name}.lengths.1"], found[f"{self.name}.angle"] = self.lengths[1], self.angle
        return found

    def dimensions(self) -> dict[str, float]:
        """Addresses of all dimensions of the link with their SI values."""
        found = self.geometry_dimensions()
        if self.shape is not None:
            found |= {f"{self.name}.shape{end}": value for end, value in self.shape.dimensions().items()}
        if self.name == "frame":
            return found
        found[f"{self.name}.mass"], found[f"{self.name}.inertia"] = self.mass, self.inertia
        if isinstance(self.mass_centre, tuple):
            found[f"{self.name}.mass_centre.x"], found[f"{self.name}.mass_centre.y"] = self.mass_centre
        return found

    def with_dimensions(self, value: Callable[[str], float]) -> Link:
        """The same link with the values that ``value`` gives for the addresses of ``dimensions``."""
        name = self.name
        lengths: tuple[float, ...] = ()
        if self.geometry == "length":
            lengths = (value(f"{name}.length"),)
        elif self.geometry == "bent":
            lengths = (value(f"{name}.lengths.0"), value(f"{name}.lengths.1"))
        moved = {
            point: (float(x), float(y)) for point, (x, y) in local_points(self, value, math.cos, math.sin).items()
        }
        angle = value(f"{name}.angle") if self.geometry == "bent" else self.angle
        shape = self.shape and self.shape.with_dimensions(lambda end: value(f"{name}.shape{end}"))
        changed = replace(self, points=moved, lengths=lengths, angle=angle, shape=shape)
        if name == "frame":
            return changed
        centre = self.mass_centre
        if isinstance(centre, tuple):
            centre = value(f"{name}.mass_centre.x"), value(f"{name}.mass_centre.y")
        mass, inertia = value(f"{name}.mass"), value(f"{name}.inertia")
        return replace(changed, mass=mass, inertia=inertia, mass_centre=centre)


def local_points(
    link: Link, dimension: Callable[[str], T], cos: Callable[[T], T], sin: Callable[[T], T]
) -> dict[str, tuple[T | float, T | float]]:
    """Coordinates (m) of each point of a link in its axes, from the dimensions by their addresses.

    length: first point (0, 0), second (length, 0).  bent: first (0, 0), second (l0, 0), third
    l1·(cos angle, sin angle).  drawing: first (0, 0), second (x, 0).  point: the only listed point at (0, 0).
    All further points, and all points of ``coordinates``, by their coordinates. Structural zeros are the
    float 0.0.
    """
    points: dict[str, tuple[T | float, T | float]] = {}
    for index, point in enumerate(link.points):
        addresses = point_addresses(link, index, point)
        if addresses is not None:
            points[point] = (dimension(addresses[0]), dimension(addresses[1]))
        elif index == 0:
            points[point] = (0.0, 0.0)
        elif index == 1:
            points[point] = (dimension(second_point_address(link, point)), 0.0)
        else:
            length, angle = dimension(f"{link.name}.lengths.1"), dimension(f"{link.name}.angle")
            points[point] = (length * cos(angle), length * sin(angle))  # type: ignore[operator]
    return points


STRUCTURAL_POINTS: Mapping[str, int] = {"length": 2, "bent": 3, "drawing": 2, "point": 1, "coordinates": 0}


def point_addresses(link: Link, index: int, point: str) -> tuple[str, str] | None:
    """Addresses of the coordinates of the link's point number ``index``; None where the geometry places
    it."""
    if index < STRUCTURAL_POINTS[link.geometry]:
        return None
    return f"{link.name}.{point}.x", f"{link.name}.{point}.y"


def second_point_address(link: Link, point: str) -> str:
    """Address of the distance from the first point to the second, where the geometry places the second."""
    by_geometry = {"length": f"{link.name}.length", "bent": f"{link.name}.lengths.0"}
    return by_geometry.get(link.geometry, f"{link.name}.{point}.x")


def from_drawing(points: Sequence[str], drawing: Mapping[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """Coordinates in axes from the first point to the second, from those of an assembled drawing (m)."""
    origin, second = drawing[points[0]], drawing[points[1]]
    length = math.dist(origin, second)
    ux, uy = (second[0] - origin[0]) / length, (second[1] - origin[1]) / length
    local = {points[0]: (0.0, 0.0), points[1]: (length, 0.0)}
    for point in points[2:]:
        dx, dy = drawing[point][0] - origin[0], drawing[point][1] - origin[1]
        local[point] = ux * dx + uy * dy, ux * dy - uy * dx
    return local


def centre(link: Link, points: Mapping[str, Pair], dimension: Callable[[str], Any]) -> Pair:
    """Mass centre (m) in the link's axes: as set, at the point named, else midway between the first two points (one
    point: at it)."""
    if isinstance(link.mass_centre, str):
        return points[link.mass_centre]
    if link.mass_centre is not None:
        return dimension(f"{link.name}.mass_centre.x"), dimension(f"{link.name}.mass_centre.y")
    first, *others = list(points.values())[:2] or [(0.0, 0.0)]
    if not others:
        return first
    second = others[0]
    return _middle(first[0], second[0]), _middle(first[1], second[1])


def _middle(a: Any, b: Any) -> Any:
    """Half of a + b, without adding a structural zero."""
    if isinstance(a, float) and a == 0.0:
        return 0.5 * b
    if isinstance(b, float) and b == 0.0:
        return 0.5 * a
    return 0.5 * (a + b)
