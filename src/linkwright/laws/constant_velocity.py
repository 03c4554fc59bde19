"""Constant velocity."""

from __future__ import annotations

from typing import Any, ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.laws.base import MOTION_LAWS, MotionLaw


@MOTION_LAWS.register("constant_velocity")
@dataclass(frozen=True)
class ConstantVelocity(MotionLaw):
    """s = u: for passages between motions of the same velocity; beside a dwell the velocity jumps."""

    source: ClassVar[str] = "VDI 2143-1; Norton, Cam Design and Manufacturing Handbook, ch. 2"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        none = 0.0 * u
        return u + none, none + 1.0, none, none
