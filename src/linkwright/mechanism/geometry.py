"""Where the points of a link are in its own axes: one function for floats and for traced values."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Link, Mechanism

T = TypeVar("T")
Pair = tuple[Any, Any]


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


def from_drawing(
    points: Sequence[str], drawing: Mapping[str, tuple[float, float]]
) -> dict[str, tuple[float, float]]:
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
    """Mass centre (m) in the link's axes: as given, at the point named, else midway between the first two points (one
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


def mechanism_size(mechanism: Mechanism) -> float:
    """A power of two in metres, not below the largest coordinate, offset or stroke.

    A power of two, so that dividing by it does not round, and so that small changes of a design do not change it.
    """
    reach = [link.reach for link in (mechanism.frame, *mechanism.links.values())]
    reach += [abs(c) for point in mechanism.drawing.values() for c in point]
    reach += [abs(getattr(joint, "offset", 0.0)) for joint in mechanism.joints.values()]
    for driver in mechanism.drivers.values():
        if mechanism.joints[driver.joint].coordinate == "slide":
            reach.append(abs(driver.law.at(0.0)))
    largest = max(reach)
    return 2.0 ** math.frexp(largest)[1] if largest > 0.0 else 1.0


def ground_place(mechanism: Mechanism, link: str, point: str) -> complex:
    """Where a point of the frame, or of a link that is welded to it, stands in frame axes: x + iy, m."""
    turn, shift = _ground_poses(mechanism)[link]
    return shift + turn * complex(*mechanism.link(link).points[point])


def _ground_poses(mechanism: Mechanism) -> dict[str, tuple[complex, complex]]:
    """Unit turn and shift of the axes of the frame and of every link that is welded to it, also through others."""
    poses = {"frame": (1.0 + 0j, 0j)}
    open_ends = ["frame"]
    while open_ends:
        held = open_ends.pop()
        for weld in mechanism.welds.values():
            other = next((each for each in weld.joined if each not in poses), None)
            if held not in weld.joined or other is None:
                continue
            turn = poses[held][0] * cmath.rect(1.0, weld.turn_of(other, mechanism))
            at = poses[held][1] + poses[held][0] * complex(*mechanism.link(held).points[weld.at])
            poses[other] = (turn, at - turn * complex(*mechanism.link(other).points[weld.at]))
            open_ends.append(other)
    return poses
