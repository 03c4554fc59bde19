"""Double harmonic motion."""

from __future__ import annotations

from math import pi
from typing import Any, ClassVar

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.laws.base import MOTION_LAWS, MotionLaw


@MOTION_LAWS.register("double_harmonic")
@dataclass(frozen=True)
class DoubleHarmonic(MotionLaw):
    """s = (1 - cos πu)/2 - (1 - cos 2πu)/8: from rest to a turn, for a rise that a fall follows at once."""

    source: ClassVar[str] = "Rothbart, Cam Design Handbook, ch. 3"
    formula = r"\frac{1-\cos\left(\pi\,u\right)}{2}-\frac{1-\cos\left(2\,\pi\,u\right)}{8}"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        c, s = np.cos(pi * u), np.sin(pi * u)
        c2, s2 = np.cos(2 * pi * u), np.sin(2 * pi * u)
        return (
            0.5 * (1 - c) - 0.125 * (1 - c2),
            0.5 * pi * s - 0.25 * pi * s2,
            0.5 * pi**2 * (c - c2),
            0.5 * pi**3 * (-s + 2 * s2),
        )
