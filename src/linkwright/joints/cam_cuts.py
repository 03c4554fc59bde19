"""The traced rows of cams: a follower on a guide, and one on a pivot."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from linkwright.core.dataclass import dataclass
from linkwright.engine.trace import Scalar, acos, angle, asin, select, sqrt
from linkwright.engine.vector import ZERO, Vec
from linkwright.joints.base import Angles, Cut, Poses, States
from linkwright.joints.lower import SlidingJoint
from linkwright.joints.pose import Pose

if TYPE_CHECKING:
    from linkwright.elements.topology import Connection
    from linkwright.joints.cam import CamJoint
    from linkwright.kinematics.dimensions import Dimensions
    from linkwright.laws.traced import LiftCurve
    from linkwright.mechanism.mechanism import Mechanism

_TURN = 2 * math.pi
Lift = tuple[Scalar, Scalar, Scalar]


@dataclass(frozen=True)
class Geometry:
    """How a follower is held, as numbers: ``along`` its way in the carrier's and ``own`` in its own axes (rad; of a
    pivot: to the cam's centre, to ``at``), ``start`` d (m) or ψ₀ (rad), ``scale`` m per unit of the coordinate;
    ``reach`` positive where follower and base circle meet; ``aside``: of ``at`` to the left of the way through the
    cam's centre, ``ahead``: where it is along the way when a guide's displacement is 0 (m); ``least`` and ``most``:
    between them base radii reach (m)."""

    along: float
    own: float
    start: float
    scale: float
    reach: float
    aside: float = 0.0
    ahead: float = 0.0
    least: float = 0.0
    most: float = math.inf

    @classmethod
    def of(cls, joint: CamJoint, mechanism: Mechanism) -> Geometry:
        """From the points of the model."""
        radius = joint.base_radius + (joint.roller_radius if joint.touch == "roller" else 0.0)
        at = complex(*mechanism.link(joint.follower).points[joint.at])
        carrier = mechanism.link(joint.carrier).points
        centre = complex(*carrier[joint.centre])
        guide = mechanism.guides.get(joint.holder)
        if guide is not None:
            return cls._guided(joint, guide, mechanism, radius, at, centre)
        line = centre - complex(*carrier[joint.holder])
        arm = at - complex(*mechanism.link(joint.follower).points[joint.holder])
        c, length = abs(line), abs(arm)
        flat = joint.touch == "flat"
        reached, whole = (radius, c) if flat else (c * c + length**2 - radius**2, 2 * c * length)
        share = reached / whole if c and length else math.inf
        met = min(max(share, -1.0), 1.0)
        start = math.asin(met) if flat else math.acos(met)
        least, most = (0.0, c) if flat else (abs(c - length), c + length)
        own, beyond = cmath.phase(arm), radius - joint.base_radius
        limits = {"least": max(least - beyond, 0.0), "most": most - beyond}
        return cls(cmath.phase(line), own, start, c if flat else length, 1.0 - abs(share), **limits)

    @classmethod
    def _guided(
        cls,
        joint: CamJoint,
        guide: SlidingJoint,
        mechanism: Mechanism,
        radius: float,
        at: complex,
        centre: complex,
    ) -> Geometry:
        outward = guide.block == joint.follower
        on_guide, on_block = guide.direction, guide.block_angle
        along, own = (on_guide, on_block) if outward else (on_block + math.pi, on_guide + math.pi)
        ends = (guide.through, guide.at) if outward else (guide.at, guide.through)
        held = complex(*mechanism.link(joint.carrier).points[ends[0]]) - centre
        reached = at - complex(*mechanism.link(joint.follower).points[ends[1]])
        seen = held * cmath.exp(-1j * along) + reached * cmath.exp(-1j * own)
        side = seen.imag + guide.offset * (1 if outward else -1)
        if joint.touch == "flat":
            return cls(along, own, radius, 1.0, radius, side, seen.real)
        square = radius**2 - side**2
        least = max(abs(side) - radius + joint.base_radius, 0.0)
        return cls(along, own, math.sqrt(max(square, 0.0)), 1.0, square, side, seen.real, least)


def cut(joint: CamJoint, connection: Connection, dimensions: Dimensions) -> Cut:
    """The traced row of a cam."""
    turned = _Turned(joint.lift, dimensions.unit(f"{joint.name}.phase").conjugate, joint.sense)
    centre = dimensions.point(joint.cam, joint.centre)
    at = dimensions.point(joint.follower, joint.at)
    radius = joint.radius(dimensions)
    guide = dimensions.mechanism.guides.get(joint.holder)
    if guide is not None:
        on_guide, on_block = guide.slide_direction(dimensions), dimensions.unit(f"{guide.name}.block_angle")
        own, there = (on_block, on_guide) if guide.block == joint.follower else (-on_guide, -on_block)
        return GuidedCut(connection, turned, centre, at, own, own.turn(there.conjugate), radius, joint.touch)
    pivot = dimensions.point(joint.follower, joint.holder)
    line = dimensions.point(joint.carrier, joint.centre) - dimensions.point(joint.carrier, joint.holder)
    return SwingingCut(
        connection,
        turned,
        centre,
        at,
        pivot,
        line,
        joint.carrier,
        radius,
        joint.touch,
        1.0 if joint.side == "left" else -1.0,
        joint.half_turns,
    )


@dataclass(frozen=True)
class _Turned:
    """The lift over the angle of the cam against a reference direction; ``back``: minus the phase."""

    lift: LiftCurve
    back: Vec
    sense: float

    def __call__(self, cam: Pose, reference: Vec) -> Lift:
        """f, and its first two derivatives by the cam's rotation against the reference."""
        way = cam.direction.turn(reference.conjugate).turn(self.back)
        phi = angle(way.y, way.x) * self.sense
        f, first, second = self.lift.traced(select(phi < 0.0, phi + _TURN, phi))
        return f, first * self.sense, second


@dataclass(frozen=True)
class GuidedCut(Cut):
    """A follower on a guide: n·(P - C) - d - f = 0; its force is given at the cam's centre C, with a couple f' λ."""

    turned: _Turned
    centre: Vec
    at: Vec
    way: Vec
    reference: Vec
    radius: Scalar
    touch: str

    def _at(self, poses: Poses) -> tuple[Vec, Vec, Scalar, Lift]:
        """n, P - C, the offset e to the right of n, and the lift."""
        follower, cam = (poses[end] for end in self.ends)
        n = follower.spin(self.way)
        gap = follower.point(self.at) - cam.point(self.centre)
        return n, gap, gap.cross(n), self.turned(cam, follower.spin(self.reference))

    def residual(self, poses: Poses, angles: Angles) -> list[Scalar]:
        n, gap, offset, lift = self._at(poses)
        height = self.radius if self.touch == "flat" else sqrt(self.radius * self.radius - offset * offset)
        return [n.dot(gap) - height - lift[0]]

    def column(self, shift: Vec, turn: Scalar, end: str, poses: Poses) -> list[Scalar]:
        n, _, _, lift = self._at(poses)
        sign = 1.0 if end == self.on else -1.0
        return [(n.dot(shift) + lift[1] * turn) * sign]

    def drift(self, states: States) -> list[Scalar]:
        follower, cam = (states[end] for end in self.ends)
        n, _, _, lift = self._at({end: states[end].pose for end in self.ends})
        arm = cam.pose.point(self.centre) - follower.pose.place
        gap = follower.velocity_at(arm) - cam.velocity_of(self.centre)
        return [n.dot(gap) - lift[1] * (cam.omega - follower.omega)]

    def bend(self, states: States) -> list[Scalar]:
        follower, cam = (states[end] for end in self.ends)
        n, gap, _, lift = self._at({end: states[end].pose for end in self.ends})
        rate = follower.velocity_of(self.at) - cam.velocity_of(self.centre)
        second = follower.acceleration_of(self.at) - cam.acceleration_of(self.centre)
        w, spin = follower.omega, cam.omega - follower.omega
        moved = n.dot(second) + n.perp.dot(gap * follower.alpha + rate * (2.0 * w)) - n.dot(gap) * (w * w)
        return [moved - lift[2] * (spin * spin) - lift[1] * (cam.alpha - follower.alpha)]

    def place(self, end: str, poses: Poses) -> Vec:
        return poses[self.connection.b].point(self.centre)

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Poses) -> tuple[Vec, Scalar]:
        n, _, _, lift = self._at(poses)
        force, couple = n * multipliers[0], lift[1] * multipliers[0]
        return (force, couple) if end == self.on else (-force, -couple)

    def pressing(
        self, multipliers: Sequence[Scalar], poses: Poses, size: Callable[[Scalar], Scalar]
    ) -> Vec | None:
        if self.touch == "flat":
            return None
        n, gap, offset, lift = self._at(poses)
        return n.perp * (multipliers[0] * (lift[1] - offset) / n.dot(gap))


@dataclass(frozen=True)
class SwingingCut(Cut):
    """A follower on a pivot A: l (±(θ_f - θ_k + γ - δ) - ψ₀ - f) = 0 with its arm's angle γ and that δ of the line to
    the cam's centre; the couple on it is ±l λ, the contact force goes through pivot and centre of the links."""

    turned: _Turned
    centre: Vec
    at: Vec
    pivot: Vec
    line: Vec
    carrier: str
    radius: Scalar
    touch: str
    side: float
    half_turns: int

    @property
    def ends(self) -> tuple[str, ...]:
        return self.connection.a, self.connection.b, self.carrier

    @property
    def _scale(self) -> Scalar:
        return sqrt(self.line.square if self.touch == "flat" else (self.at - self.pivot).square)

    def _lift(self, poses: Poses) -> Lift:
        return self.turned(poses[self.connection.b], poses[self.carrier].direction)

    def _start(self) -> Scalar:
        c = sqrt(self.line.square)
        if self.touch == "flat":
            return asin(self.radius / c)
        arm = (self.at - self.pivot).square
        return acos((self.line.square + arm - self.radius * self.radius) / (2.0 * c * sqrt(arm)))

    def residual(self, poses: Poses, angles: Angles) -> list[Scalar]:
        between = (self.at - self.pivot).turn(self.line.conjugate).angle(self.half_turns)
        turned = angles(self.on) - angles(self.carrier) + between
        return [self._scale * (self.side * turned - self._start() - self._lift(poses)[0])]

    def _factor(self, end: str, poses: Poses) -> Scalar:
        if end == self.on:
            return self._scale * self.side
        driven = self._scale * self._lift(poses)[1]
        return -driven if end == self.connection.b else driven - self._scale * self.side

    def column(self, shift: Vec, turn: Scalar, end: str, poses: Poses) -> list[Scalar]:
        return [self._factor(end, poses) * turn]

    def drift(self, states: States) -> list[Scalar]:
        follower, cam, carrier = (states[end] for end in self.ends)
        lift = self._lift({end: states[end].pose for end in self.ends})
        moved = self.side * (follower.omega - carrier.omega) - lift[1] * (cam.omega - carrier.omega)
        return [self._scale * moved]

    def bend(self, states: States) -> list[Scalar]:
        follower, cam, carrier = (states[end] for end in self.ends)
        lift = self._lift({end: states[end].pose for end in self.ends})
        spin = cam.omega - carrier.omega
        moved = self.side * (follower.alpha - carrier.alpha) - lift[1] * (cam.alpha - carrier.alpha)
        return [self._scale * (moved - lift[2] * (spin * spin))]

    def place(self, end: str, poses: Poses) -> Vec:
        """The pivot, of the cam its centre."""
        if end == self.connection.b:
            return poses[end].point(self.centre)
        return poses[self.on].point(self.pivot)

    def force_on(self, end: str, multipliers: Sequence[Scalar], poses: Poses) -> tuple[Vec, Scalar]:
        return ZERO, self._factor(end, poses) * multipliers[0]

    def pressing(
        self, multipliers: Sequence[Scalar], poses: Poses, size: Callable[[Scalar], Scalar]
    ) -> Vec | None:
        """The contact force: its moments about pivot and centre are those of the couples."""
        follower, cam = poses[self.on], poses[self.connection.b]
        own, driven = self._factor(self.on, poses), -self._factor(self.connection.b, poses)
        pivot, centre = follower.point(self.pivot), cam.point(self.centre)
        if self.touch == "flat":
            n = follower.spin(self.at - self.pivot).perp * self.side
            return n * (multipliers[0] * (own - driven) / (centre - pivot).cross(n))
        a, b = follower.point(self.at) - pivot, follower.point(self.at) - centre
        return (b * own - a * driven) * (multipliers[0] / a.cross(b))
