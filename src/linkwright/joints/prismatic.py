"""The prismatic joint: a block on a straight guide."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from linkwright.joints.base import JOINTS, Joint


@JOINTS.register("prismatic")
@dataclass(frozen=True)
class PrismaticJoint(Joint):
    """A guide line fixed in link ``guide`` and a block, link ``block``, that slides along it without turning.

    The line goes through the point ``through`` of the guide link; its direction is the angle ``direction``
    (rad, in that link's axes) or, with ``direction_points`` (P, Q), the direction from P to Q of that link.
    The point ``at`` of the block stays at the normal distance ``offset`` (m, left of the direction positive)
    from the line. ``block_angle`` (rad) is the direction of the line in the block's axes.
    Coordinate: displacement s of ``at`` from ``through`` along the direction, in m.
    """

    kind: ClassVar[str] = "prismatic"
    freedoms: ClassVar[int] = 1
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

    def dimensions(self) -> Mapping[str, float]:
        found = {f"{self.name}.offset": self.offset, f"{self.name}.block_angle": self.block_angle}
        if self.direction_points is None:
            found[f"{self.name}.direction"] = self.direction
        if self.friction:
            found[f"{self.name}.friction"] = self.friction
        return found

    def with_dimensions(self, value: Callable[[str], float]) -> PrismaticJoint:
        new = {address.removeprefix(f"{self.name}."): value(address) for address in self.dimensions()}
        return replace(self, **new)  # type: ignore[arg-type]

    def aligned(self, points: Mapping[str, tuple[float, float]]) -> PrismaticJoint:
        if self.direction_points is None:
            return self
        (px, py), (qx, qy) = (points[name] for name in self.direction_points)
        return replace(self, direction=math.atan2(qy - py, qx - px))
