"""The involute function and its inverse.

inv α = tan α − α is the angle at the base circle between the start of an involute and its point of the pressure angle
α, at the radius r = r_b / cos α (DIN 3960; Litvin, Gear Geometry and Applied Theory, chapter 10).
"""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats


def involute(angle: float) -> float:
    """inv α = tan α − α, rad; near zero by its series, where the difference would lose digits."""
    if abs(angle) < 0.02:
        square = angle * angle
        return angle * square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0)))
    return math.tan(angle) - angle


def angle_of_involute(value: float) -> float:
    """The pressure angle α in [0, π/2) with inv α = value ≥ 0, by Newton's steps from above; exact to rounding."""
    if value < 0:
        raise ValueError(f"an involute function is not negative, and {value} is")
    if value == 0:
        return 0.0
    angle: float = min((3.0 * value) ** (1.0 / 3.0), math.atan(value + 0.5 * math.pi))
    for _ in range(60):
        step = (involute(angle) - value) / math.tan(angle) ** 2
        angle -= step
        if abs(step) <= 1e-16 * angle:
            break
    return angle


def involute_at(radii: Floats, base_radius: float) -> Floats:
    """inv α at radii (n,) not below the base radius, rad."""
    tangent = np.sqrt(np.maximum((radii / base_radius) ** 2 - 1.0, 0.0))
    return np.asarray(tangent - np.arctan(tangent))
