"""The revolute joint: any number of links on one pin."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from linkwright.joints.base import JOINTS, Joint


@JOINTS.register("revolute")
@dataclass(frozen=True)
class RevoluteJoint(Joint):
    """A pin through the point ``name`` of every link in ``links`` (two or more, in the order of the file).

    Coordinate: angle of the second link's x axis against the first's, in rad, counter-clockwise positive.
    ``pin_radius`` in m (None: not given), ``friction`` the dimensionless coefficient of Coulomb friction.
    """

    kind: ClassVar[str] = "revolute"
    freedoms: ClassVar[int] = 1
    links: tuple[str, ...]
    pin_radius: float | None = None
    friction: float = 0.0

    @property
    def joined(self) -> tuple[str, ...]:
        return self.links

    def dimensions(self) -> Mapping[str, float]:
        given = {f"{self.name}.friction": self.friction} if self.friction else {}
        return given if self.pin_radius is None else {f"{self.name}.pin_radius": self.pin_radius, **given}

    def with_dimensions(self, value: Callable[[str], float]) -> RevoluteJoint:
        radius = None if self.pin_radius is None else value(f"{self.name}.pin_radius")
        return replace(
            self, pin_radius=radius, friction=value(f"{self.name}.friction") if self.friction else 0.0
        )
