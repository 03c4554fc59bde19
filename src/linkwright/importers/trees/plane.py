"""The plane in which a spatial model moves: normal to its hinges, along its slides."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.importers.layout import Remarks
from linkwright.words import _

#: Inclination (rad) of axes up to which a model is planar as its numbers are rounded, and up to which it counts as
#: planar with a warning.
ROUNDED, INCLINED = 2e-5, 2e-3


@dataclass(frozen=True)
class Frame:
    """Axes in space: ``turn`` (3, 3) and ``origin`` (3,) m."""

    turn: Floats = field(default_factory=lambda: np.eye(3))
    origin: Floats = field(default_factory=lambda: np.zeros(3))

    def place(self, point: Floats) -> Floats:
        """A point of these axes in space."""
        return np.asarray(self.origin + self.turn @ point)

    def then(self, xyz: Sequence[float], rpy: Sequence[float]) -> Frame:
        """Axes that lie in these ones, as URDF writes them: turned about x, then y, then z, which stay."""
        from scipy.spatial.transform import Rotation

        turned = Rotation.from_euler("xyz", rpy).as_matrix()
        return Frame(self.turn @ turned, self.place(np.array(xyz, dtype=float)))


@dataclass(frozen=True)
class Axis:
    """The axis of a hinge or slide in the reference pose: unit vector (3,)."""

    name: str
    slides: bool
    direction: Floats
    line: int = 0


@dataclass(frozen=True)
class Plane:
    """Unit vectors (3,): ``right`` and ``up`` in the plane, and its ``normal``, about which turns are positive."""

    right: Floats
    up: Floats
    normal: Floats

    def place(self, point: Floats) -> complex:
        """A place or a vector in the plane."""
        return complex(float(self.right @ point), float(self.up @ point))

    def sense(self, axis: Floats) -> float:
        """1 where a turn about the axis is counter-clockwise in the plane, else -1."""
        return 1.0 if float(self.normal @ axis) > 0 else -1.0

    def along(self, axis: Floats) -> complex:
        """The direction of a slide, of length 1."""
        found = self.place(axis)
        return found / abs(found)

    def inertia(self, tensor: Floats) -> float:
        """The moment of an inertia tensor (3, 3) about the normal."""
        return float(self.normal @ tensor @ self.normal)


def plane_of(axes: Sequence[Axis], remarks: Remarks) -> Plane | None:
    """The plane normal to all hinges, in which all slides lie; None, with an error among the remarks: there is none.

    Drawn as one looks at it: z up where the plane is upright, else y; x to the right.
    """
    normal = _normal(axes)
    if normal is None:
        message = _("there are no hinges, and no slides of two directions: nothing moves in a plane")
        remarks.remark("error", message, _("a planar machine has hinges with parallel axes"), "import.no_plane")
        return None
    spatial, worst = [], 0.0
    for axis in axes:
        dot = min(1.0, abs(float(axis.direction @ normal)))
        off = math.asin(dot) if axis.slides else math.asin(min(1.0, _length(np.cross(axis.direction, normal))))
        if off > INCLINED:
            spatial.append(axis)
        worst = max(worst, off)
    if spatial:
        message = _(
            "the model moves in space: {names} are not parallel to the other hinges, or slide out of their plane",
            names=tuple(each.name for each in spatial),
        )
        remedy = _("give the planar part of the model alone: parallel hinges, and slides across them")
        remarks.remark("error", message, remedy, "import.spatial", line=spatial[0].line, key=spatial[0].name)
        return None
    if worst > ROUNDED:
        message = _("axes are inclined by up to {angle:.2g}°; the model is read as planar", angle=math.degrees(worst))
        remarks.remark("warning", message, _("make the hinges parallel where it matters"), "import.inclined")
    return _upright(normal)


def _normal(axes: Sequence[Axis]) -> Floats | None:
    """The direction to which most hinges are parallel; without hinges the one normal to the slides."""
    hinges = [each.direction for each in axes if not each.slides]
    if hinges:
        alike = [sum(_length(np.cross(one, other)) < INCLINED for other in hinges) for one in hinges]
        return hinges[int(np.argmax(alike))]
    slides = [each.direction for each in axes]
    for other in slides[1:]:
        across = np.cross(slides[0], other)
        if _length(across) > INCLINED:
            return np.asarray(across / _length(across))
    return None


def _upright(normal: Floats) -> Plane:
    """The plane with its axes; directions along the model's own axes stay exact."""
    normal = _exact(normal)
    if abs(normal[2]) > 0.9:
        normal, up = normal * np.sign(normal[2]), np.array([0.0, 1.0, 0.0])
    else:
        up = np.array([0.0, 0.0, 1.0])
    up = _exact(up - normal * (normal @ up))
    right = _exact(np.cross(up, normal))
    if right[int(np.argmax(np.abs(right)))] < 0:
        normal, right = -normal, -right
    return Plane(right + 0.0, up + 0.0, normal + 0.0)


def _exact(vector: Floats) -> Floats:
    """A unit vector without the rounding of axes along the model's own."""
    unit = vector / _length(vector)
    return np.asarray(
        np.where(np.abs(np.abs(unit) - 1) < ROUNDED**2, np.sign(unit), np.where(np.abs(unit) < 1e-9, 0.0, unit))
    )


def _length(vector: Floats) -> float:
    return float(np.sqrt(vector @ vector))
