"""Lower pairs as drawings, exports and metrics see them: what turns, what slides, what holds two links."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from linkwright.elements import Drawing, Model
from linkwright.errors import LinkwrightError
from linkwright.formula.trace import Scalar
from linkwright.joints.base import Joint
from linkwright.joints.ends import Ends
from linkwright.words import _


@dataclass(frozen=True)
class TurningJoint(Joint):
    """A pin through the point ``name`` of every link in ``links`` (two or more, in the order of the file).

    Coordinate: angle of the second link's x axis against the first's, in rad, counter-clockwise positive.
    ``pin_radius`` in m (None: not set), ``friction`` the dimensionless coefficient of Coulomb friction.
    """

    freedoms: ClassVar[int] = 1
    coordinate: ClassVar[str] = "turn"
    links: tuple[str, ...]
    pin_radius: float | None = None
    friction: float = 0.0

    @property
    def joined(self) -> tuple[str, ...]:
        return self.links

    @property
    def friction_arm(self) -> float:
        if self.friction and self.pin_radius is None:
            raise LinkwrightError(
                _(
                    "joints.{name}: friction needs the pin's radius; add pin_radius, such as pin_radius: 20 mm",
                    code="forces.needs_pin_radius",
                    name=self.name,
                )
            )
        return self.friction * (self.pin_radius or 0.0)


class TyingJoint(Joint):
    """Two links that do not turn against each other."""

    couples: ClassVar[bool] = True

    @property
    def ties(self) -> tuple[str, ...]:
        return self.joined

    def rotation_sum(self, drawing: Drawing) -> tuple[Mapping[str, float], float]:
        a, b = self.joined
        return {b: 1.0, a: -1.0}, -self.turn_of(b, drawing.mechanism)


@dataclass(frozen=True)
class SlidingJoint(TyingJoint):
    """A guide line fixed in link ``guide`` and a block, link ``block``, that slides along it without turning.

    The line goes through the point ``through`` of the guide link; its direction is the angle ``direction``
    (rad, in that link's axes), with ``direction_points`` (P, Q) that from P to Q of that link.
    The point ``at`` of the block stays at the normal distance ``offset`` (m, left of the direction positive)
    from the line. ``block_angle`` (rad) is the direction of the line in the block's axes.
    Coordinate: displacement s of ``at`` from ``through`` along the direction, in m.
    """

    freedoms: ClassVar[int] = 1
    coordinate: ClassVar[str] = "slide"
    reported_on: ClassVar[int] = 1
    guide: str
    through: str
    direction: float
    direction_points: tuple[str, str] | None
    block: str
    at: str
    offset: float = 0.0
    block_angle: float = 0.0
    friction: float = 0.0

    @property
    def joined(self) -> tuple[str, ...]:
        return (self.guide, self.block)

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.block, self.at),)

    def point_on(self, link: str) -> str:
        return self.through if link == self.guide else self.at

    @property
    def friction_arm(self) -> float:
        return self.friction

    def displacement(self, at: Ends) -> Scalar:
        """Place of the block's point along the guide's line, m."""
        gap = at.point(self.block, self.at) - at.point(self.guide, self.through)
        return at.vector(self.guide, self.slide_direction(at.dimensions)).dot(gap)

    def turn_of(self, child: str, mechanism: Model) -> float:
        turn = self.direction - self.block_angle
        return turn if child == self.block else -turn


@dataclass(frozen=True)
class RigidJoint(TyingJoint):
    """Links (a, b) fixed to each other at their common point ``at``, b's x axis at ``angle`` (rad) to a's."""

    freedoms: ClassVar[int] = 0
    links: tuple[str, str]
    at: str
    angle: float = 0.0

    @property
    def joined(self) -> tuple[str, ...]:
        return self.links

    @property
    def seats(self) -> tuple[tuple[str, str], ...]:
        return ((self.links[-1], self.at),)

    def point_on(self, link: str) -> str:
        return self.at

    def turn_of(self, child: str, mechanism: Model) -> float:
        return self.angle if child == self.links[1] else -self.angle
