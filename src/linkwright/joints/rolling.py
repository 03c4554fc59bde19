"""Wheels that roll on each other without slipping."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from linkwright.core.dataclass import dataclass
from linkwright.fields.base import Field
from linkwright.joints.base import JOINTS
from linkwright.joints.gear import GearPair


@JOINTS.register("rolling")
@dataclass(frozen=True)
class RollingPair(GearPair):
    """Two wheels on one carrier that roll on each other without slipping, by their ``radii`` or ``ratio``.

    The row of a gear pair; its multiplier is the force along the common tangent that friction must supply. What
    presses the wheels together is a matter of the carrier and of its loads.
    """

    kind: ClassVar[str] = "rolling"
    letter: ClassVar[str] = "O"
    toothed: ClassVar[bool] = False
    pressure_angle: float = 0.0

    @classmethod
    def fields(cls) -> Mapping[str, Field]:
        return {
            key: field
            for key, field in super().fields().items()
            if key not in ("teeth", "module", "pressure_angle")
        }

    @classmethod
    def sizes(cls) -> tuple[str, ...]:
        return ("radii", "ratio")
