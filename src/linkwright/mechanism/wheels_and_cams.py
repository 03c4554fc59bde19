"""Sizes of wheels as their pairs tell them, and shapes of cams: pitch curve, profile, and the follower's part."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import singledispatch
from math import pi
from typing import TYPE_CHECKING

from linkwright.formula.late_import import numpy as np
from linkwright.joints.base import Joint
from linkwright.joints.cam import CamJoint
from linkwright.joints.cam_geometry import Geometry
from linkwright.joints.gear import GearPair
from linkwright.joints.rack import RackPair
from linkwright.joints.toothed import WheelPair
from linkwright.mechanism.mechanism import Mechanism

if TYPE_CHECKING:
    from linkwright.core.arrays import Complexes, Floats


@dataclass(frozen=True)
class WheelSizes:
    """A pair with wheels on its ``links``: ``teeth``, pitch ``radii`` (m), centre ``distance``
    (m), ``ratio`` on the carrier, ``module`` (m) and ``pressure_angle`` (rad), as far as it has them; ``involute``:
    whether these are two gears whose teeth follow from number and module."""

    links: tuple[str, ...]
    teeth: tuple[float, ...] | None
    radii: tuple[float, ...]
    distance: float | None = None
    ratio: float | None = None
    module: float | None = None
    pressure_angle: float | None = None
    involute: bool = False


@singledispatch
def wheel_sizes(joint: Joint, mechanism: Mechanism) -> WheelSizes | None:
    """The sizes of a pair with wheels; None of any other joint."""
    return None


@wheel_sizes.register
def of_wheels(joint: WheelPair, mechanism: Mechanism) -> WheelSizes:
    """Sizes of two wheels on a carrier."""
    radii = tuple(abs(each) for each in joint.arms(mechanism))
    return WheelSizes(joint.links, joint.teeth, radii, abs(joint.line(mechanism)), joint.transmission)


@wheel_sizes.register
def _(joint: GearPair, mechanism: Mechanism) -> WheelSizes:
    sizes, angle = of_wheels(joint, mechanism), joint.pressure_angle
    return replace(sizes, module=joint.module, pressure_angle=angle, involute=joint.involute)


@wheel_sizes.register
def _(joint: RackPair, mechanism: Mechanism) -> WheelSizes:
    teeth, angle = None if joint.teeth is None else (joint.teeth,), joint.pressure_angle
    return WheelSizes(joint.joined, teeth, (joint.radius,), module=joint.module, pressure_angle=angle)


def disc_radii(joint: Joint, mechanism: Mechanism) -> Mapping[str, float]:
    """How far the wheels and cams of a joint reach from their centres, m, by the names of their links."""
    if isinstance(joint, CamJoint):
        return {joint.cam: CamShape.of(joint, mechanism).reach} if joint.centre else {}
    sizes = wheel_sizes(joint, mechanism)
    return {} if sizes is None else dict(zip(sizes.links, sizes.radii, strict=False))


#: Complexes of a drawn curve over a turn of the cam; how far a face goes on beyond its contacts, as a share.
POINTS, BEYOND = 720, 0.1


@dataclass(frozen=True)
class CamShape:
    """Points are complex numbers, m, in the axes of the link that is named; angles φ (n,) are the cam's.

    While the cam rests, the carrier turns about its ``centre`` by -φ times the sense and its phase back: the trace
    point draws the pitch curve, a roller's circle or the flat face envelops the profile (Norton, Cam Design and
    Manufacturing Handbook, ch. 9).
    """

    joint: CamJoint
    geometry: Geometry
    centre: complex
    line: float
    arm: float
    at: complex
    pivot: complex

    @classmethod
    def of(cls, joint: CamJoint, mechanism: Mechanism) -> CamShape:
        """From the points of the model; ``line``, ``arm``: lengths from a pivot to the centre and to ``at``."""
        at = complex(*mechanism.link(joint.follower).points[joint.at])
        centre = complex(*mechanism.link(joint.cam).points[joint.centre])
        line = arm = 0.0
        pivot = at
        if joint.side:
            pivot = complex(*mechanism.link(joint.follower).points[joint.holder])
            ends = (mechanism.link(joint.carrier).points[each] for each in (joint.centre, joint.holder))
            a, b = (complex(*each) for each in ends)
            line, arm = abs(a - b), abs(at - pivot)
        return cls(joint, joint.geometry(mechanism), centre, line, arm, at, pivot)

    @property
    def _side(self) -> float:
        return 1.0 if self.joint.side == "left" else -1.0

    def _back(self, phi: Floats) -> Complexes:
        """What turns directions from the carrier's axes into the cam's."""
        return np.asarray(np.exp(-1j * (self.joint.phase + self.joint.sense * phi)))

    def pitch(self, phi: Floats) -> Complexes:
        """The pitch curve: places of the roller's centre or the edge, in the cam's axes."""
        return self.centre + self._trace(phi)[0] * self._back(phi)

    def _trace(self, phi: Floats) -> tuple[Complexes, Complexes]:
        """``at`` from the cam's centre in the carrier's axes, and its derivative by φ."""
        f, rate, _ = self.joint.lift.curves(phi)
        found, way = self.geometry, cmath.exp(1j * self.geometry.along)
        if not self.joint.side:
            return way * (found.start + f + 1j * found.aside), way * rate
        swung = self.arm * way * np.exp(1j * self._side * (found.start + f))
        return swung - self.line * way, 1j * self._side * rate * swung

    def profile(self, phi: Floats, *, outer: bool = False) -> Complexes:
        """Where cam and follower touch at φ, in the cam's axes; ``outer``: on the other wall of a groove."""
        if self.joint.touch == "flat":
            normal, support, slope = self._support(phi)
            return self.centre + (support + 1j * slope) * normal * self._back(phi)
        place, rate = self._trace(phi)
        along = rate - 1j * self.joint.sense * place
        outward = 1j * self.joint.sense * along / np.abs(along)
        gap = self.joint.roller_radius * (-1.0 if outer else 1.0)
        return self.centre + (place - gap * outward) * self._back(phi)

    def _support(self, phi: Floats) -> tuple[Complexes, Floats, Floats]:
        """Of a flat face: its normal in the carrier's axes, its distance from the centre, and how that grows with the
        normal's direction in the cam's axes."""
        f, rate, _ = self.joint.lift.curves(phi)
        way, sense = cmath.exp(1j * self.geometry.along), self.joint.sense
        if not self.joint.side:
            return np.full(len(phi), way), self.joint.base_radius + f, -sense * rate
        psi = self.geometry.start + f
        normal = 1j * self._side * way * np.exp(1j * self._side * psi)
        return normal, self.line * np.sin(psi), self.line * np.cos(psi) * rate / (self._side * rate - sense)

    def face(self) -> tuple[complex, complex]:
        """Ends of the flat face in the follower's axes: as far as it is used, and a little more."""
        phi = full_turn()
        normal, support, slope = self._support(phi)
        own = cmath.exp(1j * self.geometry.own)
        if self.joint.side:
            contact = (support + 1j * slope) * normal + self.line * cmath.exp(1j * self.geometry.along)
            places = (contact * (1j * self._side * normal.conj())).real
            start, along, further = self.pivot, own, self.arm
        else:
            places, start, along, further = slope - self.geometry.aside, self.at, 1j * own, 0.0
        low, high = min(float(places.min()), further), max(float(places.max()), further)
        more = BEYOND * max(high - low, self.joint.base_radius)
        return start + along * (low - more), start + along * (high + more)

    @property
    def reach(self) -> float:
        """The largest distance of the profile from the centre, m."""
        return float(np.abs(self.profile(full_turn()) - self.centre).max())


def full_turn() -> Floats:
    """Angles of a cam over a turn at which its curves are drawn, rad."""
    return np.linspace(0.0, 2.0 * pi, POINTS, endpoint=False, dtype=np.float64)
