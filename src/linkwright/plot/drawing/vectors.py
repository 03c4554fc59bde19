"""Velocities, accelerations and forces as arrows, each kind to one scale with a legend."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from linkwright.errors import RequestError
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.weld import WeldJoint
from linkwright.kinematics.names import canonical, find_point
from linkwright.plot.drawing.view import View
from linkwright.plot.svg.element import Floats
from linkwright.plot.symbols.base import SYMBOLS, Shape, joined

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces
    from linkwright.model.mechanism import Mechanism

LONGEST = 120.0
_PREFIXES = (("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("µ", 1e-6))


@dataclass(frozen=True)
class Vectors:
    """Vectors of one kind at all positions: feet (n, 2) m and values (n, 2) by name.

    ``toward``: the arrow's point, not its foot, is at the place (a load that presses on a link).
    """

    kind: str
    unit: str
    style: str
    feet: Mapping[str, Floats]
    values: Mapping[str, Floats]
    toward: bool = False

    def largest(self, indices: Sequence[int]) -> float:
        """Size of the largest vector at some positions."""
        sizes = [np.hypot(v[indices, 0], v[indices, 1]) for v in self.values.values()]
        good = [float(each[np.isfinite(each)].max(initial=0.0)) for each in sizes]
        return max(good, default=0.0)

    def ends(self, name: str, index: int, view: View, scale: float) -> tuple[Floats, Floats] | None:
        """Foot and point of an arrow on the paper; None where the vector is not known."""
        foot, value = view.paper(self.feet[name][index]), self.values[name][index] * (scale, -scale)
        if not np.isfinite([*foot, *value]).all():
            return None
        return (foot - value, foot) if self.toward else (foot, foot + value)

    def shape(self, index: int, view: View, scale: float) -> Shape:
        """All arrows at one position; ``scale``: units of the paper per SI unit."""
        ends = [each for name in self.values if (each := self.ends(name, index, view, scale)) is not None]
        return joined(
            SYMBOLS["arrow"](start=tuple(map(float, a)), end=tuple(map(float, b)), style=self.style)
            for a, b in ends
        )


def scale_of(families: Iterable[Vectors], indices: Sequence[int]) -> float:
    """Units of the paper per SI unit so that the largest vector of the families is LONGEST."""
    largest = max((family.largest(indices) for family in families), default=0.0)
    return LONGEST / largest if largest > 0 else 0.0


def round_length(scale: float) -> float:
    """A round value (1, 2 or 5 and zeros) whose arrow is at most half of the longest one."""
    raw = 0.5 * LONGEST / scale
    power = 10.0 ** math.floor(math.log10(raw))
    return max(k * power for k in (1.0, 2.0, 5.0) if k * power <= raw * 1.0000001)


def with_unit(value: float, unit: str) -> str:
    """``20 kN``: a round value with a prefix before N, none before other units."""
    if unit != "N":
        return f"{value:.12g} {unit}"
    prefix, factor = next((each for each in _PREFIXES if abs(value) >= each[1] * 0.999999), _PREFIXES[-1])
    return f"{value / factor:.12g} {prefix}{unit}"


def point_vectors(motion: Motion, names: Iterable[str], kind: str) -> Vectors:
    """Velocities or accelerations of points."""
    unit, style = {"velocity": ("m/s", "lw-velocity"), "acceleration": ("m/s²", "lw-acceleration")}[kind]
    found = {name: motion.point(name) for name in names}
    return Vectors(
        kind,
        unit,
        style,
        {name: each.position for name, each in found.items()},
        {name: each.velocity if kind == "velocity" else each.acceleration for name, each in found.items()},
    )


def all_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Every point that moves, once."""
    keys = (canonical(mechanism, link.name, p) for link in mechanism.links.values() for p in link.points)
    return tuple(dict.fromkeys(key for key in keys if key not in mechanism.frame.points))


def reactions(forces: Forces, names: Sequence[str] | None) -> Vectors:
    """Forces that joints exert on links: ``B`` on the last link of the joint, ``rocker.B`` on that link."""
    joints = forces.mechanism.joints
    asked = tuple(joints) if names is None else tuple(names)
    feet: dict[str, Floats] = {}
    values: dict[str, Floats] = {}
    for name in asked:
        link, joint = name.split(".", 1) if "." in name else (None, name)
        if joint not in joints:
            forces.reaction(joint)
        on = link or joints[joint].joined[-1]
        feet[name] = _joint_place(forces.motion, joint, on)
        values[name] = forces.reaction(joint, on=on)
    return Vectors("force", "N", "lw-force", feet, values)


def _joint_place(motion: Motion, joint: str, on: str) -> Floats:
    found = motion.mechanism.joints[joint]
    if isinstance(found, PrismaticJoint | WeldJoint):
        return _position(motion, f"{found.joined[1]}.{found.at}")
    return _position(motion, f"{on}.{joint}")


def _position(motion: Motion, name: str) -> Floats:
    link, point = find_point(motion.mechanism, name)
    if link == "frame":
        return np.tile(np.array(motion.mechanism.frame.points[point]), (motion.steps, 1))
    return motion.point(name).position


def loads(forces: Forces) -> Vectors:
    """Resultants of the file's loads, their points where they act."""
    found = {name: forces.load(name) for name in forces.mechanism.loads}
    return Vectors(
        "load",
        "N",
        "lw-load",
        {name: each.place for name, each in found.items()},
        {name: each.force for name, each in found.items()},
        toward=True,
    )


def same_motion(motion: Motion, forces: Forces) -> None:
    """Refuse forces that belong to another motion."""
    if forces.motion is not motion:
        raise RequestError(
            "the forces belong to another motion than the one that is drawn; draw forces.motion, or solve the forces "
            "of this motion"
        )
