"""The weld: two links made one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from linkwright.joints.base import JOINTS, Joint


@JOINTS.register("weld")
@dataclass(frozen=True)
class WeldJoint(Joint):
    """Links (a, b) fixed to each other at their common point ``at``, b's x axis at ``angle`` (rad) to a's."""

    kind: ClassVar[str] = "weld"
    freedoms: ClassVar[int] = 0
    links: tuple[str, str]
    at: str
    angle: float = 0.0

    @property
    def joined(self) -> tuple[str, ...]:
        return self.links

    def dimensions(self) -> Mapping[str, float]:
        return {f"{self.name}.angle": self.angle}

    def with_dimensions(self, value: Callable[[str], float]) -> WeldJoint:
        return replace(self, angle=value(f"{self.name}.angle"))
