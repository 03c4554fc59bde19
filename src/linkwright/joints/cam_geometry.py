"""How the follower of a cam is held: on a guide, or on a pivot."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Protocol

from linkwright.elements import Guide, Model


class Follower(Protocol):
    """A follower on its carrier, as :class:`~linkwright.joints.cam.CamJoint` has it."""

    @property
    def follower(self) -> str: ...
    @property
    def at(self) -> str: ...
    @property
    def touch(self) -> str: ...
    @property
    def base_radius(self) -> float: ...
    @property
    def roller_radius(self) -> float: ...
    @property
    def carrier(self) -> str: ...
    @property
    def centre(self) -> str: ...
    @property
    def holder(self) -> str: ...


@dataclass(frozen=True)
class Geometry:
    """How a follower is held, as numbers: ``along`` its way in the carrier's and ``own`` in its own axes (rad; of a
    pivot: to the cam's centre, to ``at``), ``start`` d (m) or ψ₀ (rad), ``scale`` m per unit of the coordinate;
    ``reach`` positive where follower and base circle meet; ``aside``: of ``at`` to the left of the way through the
    cam's centre, ``ahead``: where it is along its path when a guide's displacement is 0 (m); ``minimum`` and
    ``maximum``: between them base radii reach (m)."""

    along: float
    own: float
    start: float
    scale: float
    reach: float
    aside: float = 0.0
    ahead: float = 0.0
    minimum: float = 0.0
    maximum: float = math.inf

    @classmethod
    def of(cls, joint: Follower, mechanism: Model) -> Geometry:
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
        reached, denominator = (radius, c) if flat else (c * c + length**2 - radius**2, 2 * c * length)
        share = reached / denominator if c and length else math.inf
        met = min(max(share, -1.0), 1.0)
        start = math.asin(met) if flat else math.acos(met)
        minimum, maximum = (0.0, c) if flat else (abs(c - length), c + length)
        own, beyond = cmath.phase(arm), radius - joint.base_radius
        limits = {"minimum": max(minimum - beyond, 0.0), "maximum": maximum - beyond}
        return cls(cmath.phase(line), own, start, c if flat else length, 1.0 - abs(share), **limits)

    @classmethod
    def _guided(
        cls, joint: Follower, guide: Guide, mechanism: Model, radius: float, at: complex, centre: complex
    ) -> Geometry:
        outward = guide.block == joint.follower
        on_guide, on_block = guide.direction, guide.block_angle
        along, own = (on_guide, on_block) if outward else (on_block + math.pi, on_guide + math.pi)
        ends = (guide.through, guide.at) if outward else (guide.at, guide.through)
        held = complex(*mechanism.link(joint.carrier).points[ends[0]]) - centre
        reached = at - complex(*mechanism.link(joint.follower).points[ends[1]])
        relative = held * cmath.exp(-1j * along) + reached * cmath.exp(-1j * own)
        side = relative.imag + guide.offset * (1 if outward else -1)
        if joint.touch == "flat":
            return cls(along, own, radius, 1.0, radius, side, relative.real)
        square = radius**2 - side**2
        minimum = max(abs(side) - radius + joint.base_radius, 0.0)
        return cls(along, own, math.sqrt(max(square, 0.0)), 1.0, square, side, relative.real, minimum)
