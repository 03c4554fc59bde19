"""Equations of all joints over the coordinates of all links, with their derivatives.

Coordinates of a link are the place of its origin and its angle; all lengths are divided by the size of the
mechanism, so that rows and columns compare.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.outputs import row_names
from linkwright.joints.lower import SlidingJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.geometry import mechanism_size
from linkwright.mechanism.mechanism import Mechanism

Numbers = NDArray[Any]
Parts = Mapping[str, Sequence[Any]]


@dataclass(frozen=True)
class Row:
    """One scalar equation: its joint, what it holds (``place`` or ``rotation``), its value, its derivatives."""

    joint: str
    holds: str
    value: Any
    parts: Parts


class ConstraintSystem:
    """Equations of the joints of a mechanism over (x, y, θ) of every link.

    A pin of several links holds each of them to the first one, in the ``order`` given or that of the file.

    Works on complex numbers as well, for exact derivatives by complex steps.
    """

    def __init__(self, mechanism: Mechanism, order: Mapping[str, int] | None = None) -> None:
        number = order or {}
        self.mechanism = mechanism
        self.links = list(mechanism.links)
        self.size = mechanism_size(mechanism)
        self._rest: dict[str, float] = {}
        self._first = {name: 3 * i for i, name in enumerate(self.links)}
        self._joints = [
            (joint, tuple(sorted(joint.joined, key=lambda link: number.get(link, 0))))
            for joint in mechanism.joints.values()
        ]

    @property
    def freedoms(self) -> int:
        """Three of every link."""
        return 3 * len(self.links)

    def rows(self, x: Numbers) -> list[Row]:
        """All equations at some coordinates."""
        poses = {"frame": Place(0.0, 0.0, 0.0)}
        poses |= {name: Place(*x[i : i + 3]) for name, i in self._first.items()}
        return [row for joint, kept in self._joints for row in joint.rows(self, kept, poses)]

    def residual(self, x: Numbers) -> Numbers:
        """Values of the equations; lengths over the size."""
        return np.array([row.value for row in self.rows(x)])

    def jacobian(self, x: Numbers) -> Numbers:
        """Derivatives of the equations, (equations, freedoms)."""
        return self.matrix(self.rows(x))

    def matrix(self, rows: Sequence[Row]) -> Numbers:
        """The derivatives of some equations as a matrix."""
        kind = complex if any(isinstance(row.value, complex) for row in rows) else float
        entries = np.zeros((len(rows), self.freedoms), dtype=kind)
        for entry, row in zip(entries, rows, strict=True):
            for link, part in row.parts.items():
                if link in self._first:
                    entry[self._first[link] : self._first[link] + 3] += part
        return entries

    def driver_row(self, name: str, x: Numbers) -> Row:
        """A driver's coordinate (rad, or m over the size) with its derivatives."""
        driver = self.mechanism.drivers[name]
        joint: Any = self.mechanism.joints[driver.joint]
        poses = {"frame": Place(0.0, 0.0, 0.0)}
        poses |= {link: Place(*x[i : i + 3]) for link, i in self._first.items()}
        if joint.coordinate == "slide":
            return self.along(joint, poses, across=False)
        a, b = driver.relative_to, driver.link
        return Row(joint.name, "driver", poses[b].angle - poses[a].angle, {a: (0, 0, -1.0), b: (0, 0, 1.0)})

    def kept(self, joint: str, gap: Any, parts: Parts) -> Row:
        """The row of a higher pair: ``gap``, over the size where it is a length, keeps the value that it has where it
        is first seen; ``parts``: its derivatives by (x, y, θ) of its links."""
        rest = self._rest.setdefault(joint, float(np.real(gap)))
        return Row(joint, "rolling", gap - rest, parts)

    def local(self, link: str, point: str) -> tuple[float, float]:
        """A point in the axes of its link, over the size."""
        x, y = self.mechanism.link(link).points[point]
        return x / self.size, y / self.size

    def pin(self, joint: str, a: str, b: str, point: str, poses: Mapping[str, Place]) -> Iterable[Row]:
        (ax, ay), (bx, by) = (poses[link].arm(self.local(link, point)) for link in (a, b))
        p, q = poses[a], poses[b]
        yield Row(joint, "place", p.x + ax - q.x - bx, {a: (1.0, 0.0, -ay), b: (-1.0, 0.0, by)})
        yield Row(joint, "place", p.y + ay - q.y - by, {a: (0.0, 1.0, ax), b: (0.0, -1.0, -bx)})

    @staticmethod
    def rotation(joint: str, a: str, b: str, turn: float, poses: Mapping[str, Place]) -> Row:
        difference = poses[b].angle - poses[a].angle - turn
        c = np.cos(difference)
        return Row(joint, "rotation", np.sin(difference), {a: (0.0, 0.0, -c), b: (0.0, 0.0, c)})

    def along(self, joint: SlidingJoint, poses: Mapping[str, Place], *, across: bool) -> Row:
        """The block's place along the guide, or its distance across it."""
        guide, block = poses[joint.guide], poses[joint.block]
        direction = joint.direction + (0.5 * math.pi if across else 0.0)
        nx, ny = guide.arm((math.cos(direction), math.sin(direction)))
        tx, ty = guide.arm(self.local(joint.guide, joint.through))
        bx, by = block.arm(self.local(joint.block, joint.at))
        gx, gy = block.x + bx - guide.x - tx, block.y + by - guide.y - ty
        value = nx * gx + ny * gy - (joint.offset / self.size if across else 0.0)
        turned = nx * ty - ny * tx + nx * gy - ny * gx
        parts = {joint.guide: (-nx, -ny, turned), joint.block: (nx, ny, ny * bx - nx * by)}
        return Row(joint.name, "place", value, parts)


class Place:
    """Place and direction of a link."""

    __slots__ = ("angle", "c", "s", "x", "y")

    def __init__(self, x: Any, y: Any, angle: Any) -> None:
        self.x, self.y, self.angle = x, y, angle
        self.c, self.s = np.cos(angle), np.sin(angle)

    def arm(self, local: tuple[float, float]) -> tuple[Any, Any]:
        """A vector of the link's axes in frame axes."""
        return self.c * local[0] - self.s * local[1], self.s * local[0] + self.c * local[1]


def coordinates(motion: Motion, index: int) -> Floats:
    """(x, y, θ) of every link at a position, lengths over the size of the mechanism."""
    mechanism, found = motion.mechanism, []
    size, places = mechanism_size(mechanism), _first_points(mechanism)
    motion.rows.fetch(pose_outputs(mechanism), motion.evaluate)  # all in one program
    wheels = mechanism.higher
    for name, link in mechanism.links.items():
        c, s = motion.link(name).direction[index]
        px, py = next(iter(link.points.values()))
        x, y = motion.point_of(places[name]).position[index]
        found += [(x - c * px + s * py) / size, (y - s * px - c * py) / size]
        found.append(motion.link(name).angle[index] if wheels else math.atan2(s, c))
    return np.array(found)


def _first_points(mechanism: Mechanism) -> dict[str, str]:
    """The first point of every link."""
    return {
        name: canonical(mechanism, name, next(iter(link.points))) for name, link in mechanism.links.items()
    }


def pose_outputs(mechanism: Mechanism) -> tuple[str, ...]:
    """Names of the outputs that tell where every link is."""
    wanted = [
        row_names(*each)
        for name, key in _first_points(mechanism).items()
        for each in (("direction", name), ("position", key))
    ]
    return tuple(dict.fromkeys(name for pair in wanted for name in pair))


def drawn_coordinates(mechanism: Mechanism) -> Floats | None:
    drawing = Drawing(mechanism)
    if not drawing:
        return None
    size, found = mechanism_size(mechanism), []
    for name, link in mechanism.links.items():
        angle = drawing.angle(name)
        places = ((p, drawing.points.get(f"{name}.{p}", drawing.points.get(p))) for p in link.points)
        known = next(((link.points[p], place) for p, place in places if place is not None), None)
        if angle is None or known is None:
            return None
        (px, py), (x, y) = known
        c, s = math.cos(angle), math.sin(angle)
        found += [(x - c * px + s * py) / size, (y - s * px - c * py) / size, angle]
    return np.array(found)
