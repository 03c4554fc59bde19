"""Simple harmonic motion."""

from __future__ import annotations

from math import pi
from typing import Any, ClassVar

import numpy as np

from linkwright.core.dataclass import dataclass
from linkwright.laws.base import MOTION_LAWS, MotionLaw


@MOTION_LAWS.register("simple_harmonic")
@dataclass(frozen=True)
class SimpleHarmonic(MotionLaw):
    """s = (1 - cos πu)/2: turns at both ends; beside a dwell the acceleration jumps."""

    source: ClassVar[str] = "Rothbart, Cam Design Handbook, ch. 2"
    formula = r"\frac{1-\cos\left(\pi\,u\right)}{2}"

    def curves(self, u: Any) -> tuple[Any, Any, Any, Any]:
        c, s = np.cos(pi * u), np.sin(pi * u)
        return 0.5 - 0.5 * c, 0.5 * pi * s, 0.5 * pi**2 * c, -0.5 * pi**3 * s
