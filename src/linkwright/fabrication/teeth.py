"""Gears with involute teeth, each turned so that it meshes with its mates when the machine is put together.

The angle of b's x axis to the carrier's where a's has none (the joint's phase) says how two wheels stand to each
other; a tooth of the first wheel is on its link's x axis, and the others follow from pair to pair.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.gears.gear import Gear
from linkwright.gears.pair import GearPair, gear_pair
from linkwright.joints.gear import GearPair as GearJoint
from linkwright.joints.rack import RackPair
from linkwright.joints.toothed import is_integer
from linkwright.mechanism.mechanism import Mechanism
from linkwright.shapes.shape import corners_of

#: Points on each flank and fillet.
POINTS = 12


@dataclass(frozen=True)
class Wheel:
    """A gear on a link, its centre one of the link's points."""

    link: str
    point: str
    teeth: int
    internal: bool = False


@dataclass(frozen=True)
class Mesh:
    """Two gears of a machine: ``line``: direction (rad, in the carrier's axes) of the x axis of the pair, ``angles``
    of the two links when they mesh as the joint says."""

    pinion: Wheel
    wheel: Wheel
    pair: GearPair
    line: float
    angles: tuple[float, float]

    def turn_of(self, one: Wheel, other: float) -> float:
        """How far the outline of one is turned in its link's axes (rad) where that of the other is turned so far."""
        pinion, wheel = self.angles
        if one == self.wheel:
            return self.pair.wheel_angle(pinion + other - self.line) + self.line - wheel
        towards = self.pair.wheel_angle(0.0)
        return (wheel + other - self.line - towards) * self.pair.ratio + self.line - pinion

    def gear(self, one: Wheel) -> Gear:
        """The gear of one of the two."""
        return self.pair.wheel if one == self.wheel else self.pair.pinion


@dataclass(frozen=True)
class Toothed:
    """A gear on a link: its centre in the link's axes (m), and how far its outline is turned (rad)."""

    link: str
    gear: Gear
    centre: complex
    turn: float

    @property
    def corners(self) -> Complexes:
        """The outline, counter-clockwise, in the link's axes, (k,) m; all corners lie on the exact curves."""
        return np.asarray(self.centre + cmath.exp(1j * self.turn) * corners_of(self.gear.outline(POINTS)))


def toothed(mechanism: Mechanism) -> list[Toothed]:
    """The gears whose teeth follow from number, module and pressure angle."""
    meshes = list(_meshes(mechanism))
    turns: dict[Wheel, float] = {}
    found: list[Toothed] = []
    for mesh in meshes:
        if mesh.pinion not in turns:
            _go_round(meshes, mesh.pinion, turns)
        for one in (mesh.pinion, mesh.wheel):
            place = complex(*mechanism.link(one.link).points[one.point])
            gear = Toothed(one.link, mesh.gear(one), place, turns[one])
            found += [gear] if gear not in found else []
    return [*found, *_pinions(mechanism, found)]


def _go_round(meshes: Sequence[Mesh], first: Wheel, turns: dict[Wheel, float]) -> None:
    """Turns a gear, a tooth on its link's x axis, and all that mesh with it."""
    turns[first] = 0.0
    waiting = [first]
    for one in waiting:
        for mesh in meshes:
            if one in (mesh.pinion, mesh.wheel):
                mate = mesh.pinion if one == mesh.wheel else mesh.wheel
                if mate not in turns:
                    turns[mate] = mesh.turn_of(mate, turns[one])
                    waiting.append(mate)


def _meshes(mechanism: Mechanism) -> Iterator[Mesh]:
    """The pairs of gears whose teeth are known."""
    for joint in mechanism.joints.values():
        if not isinstance(joint, GearJoint) or not joint.involute or joint.teeth is None or joint.module is None:
            continue
        if not all(map(is_integer, joint.teeth)):
            continue
        internal, line = joint.transmission > 0.0, cmath.phase(joint.line(mechanism))
        a, b = (int(each) for each in joint.teeth)
        wheels = (
            Wheel(joint.links[0], joint.centres[0], a, internal and a > b),
            Wheel(joint.links[1], joint.centres[1], b, internal and b > a),
        )
        angles = (0.0, joint.phase or 0.0)
        if wheels[0].internal:
            wheels, angles = wheels[::-1], angles[::-1]
        elif internal:
            line += math.pi
        teeth = (wheels[0].teeth, wheels[1].teeth)
        pair = gear_pair(teeth, joint.module, pressure_angle=joint.pressure_angle, internal=internal)
        yield Mesh(wheels[0], wheels[1], _cleared(pair), line, angles)


def _cleared(pair: GearPair) -> GearPair:
    """The pair, the teeth of a ring shortened where they would reach below the involutes of the pinion.

    Along the line of action a ring's tip circle is L = a sin α_w + l from the foot on its base circle, l being the
    length of the tangent to the end of the pinion's involute, and d_a² = d_b² + (2 L)² (DIN 3960).
    """
    if not pair.wheel.internal:
        return pair
    pinion, wheel = pair.pinion, pair.wheel
    start = 0.5 * math.sqrt(max(pinion.form_diameter**2 - pinion.base_diameter**2, 0.0))
    across = pair.centre_distance * math.sin(pair.working_pressure_angle)
    tip = math.hypot(wheel.base_diameter, 2.0 * (across + start))
    return replace(pair, wheel=replace(wheel, tip=tip)) if tip > wheel.tip_diameter else pair


def _pinions(mechanism: Mechanism, known: Sequence[Toothed]) -> Iterator[Toothed]:
    """Pinions of racks that mesh with no gear, a tooth on their link's x axis."""
    for joint in mechanism.joints.values():
        if isinstance(joint, RackPair) and (gear := pinion_of(joint)) is not None:
            place = complex(*mechanism.link(joint.pinion).points[joint.centre])
            if not any(each.link == joint.pinion and each.gear == gear for each in known):
                yield Toothed(joint.pinion, gear, place, 0.0)


def pinion_of(joint: RackPair) -> Gear | None:
    """The pinion of a rack; None where its teeth are not known."""
    if joint.teeth is None or joint.module is None or not is_integer(joint.teeth):
        return None
    return Gear(int(joint.teeth), joint.module, pressure_angle=joint.pressure_angle)
