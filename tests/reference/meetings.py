"""Places of bars by elementary geometry."""

from __future__ import annotations

from math import atan2, hypot, sqrt

from tests.reference.multibody import Vec


def circle_meeting(p: Vec, r: float, q: Vec, s: float, left: bool) -> Vec:
    """Intersection of two circles, left or right of the ray from p to q."""
    d = hypot(q[0] - p[0], q[1] - p[1])
    a = (d * d + r * r - s * s) / (2 * d)
    h = sqrt(r * r - a * a) * (1 if left else -1)
    ux, uy = (q[0] - p[0]) / d, (q[1] - p[1]) / d
    return p[0] + a * ux - h * uy, p[1] + a * uy + h * ux


def placed(p: Vec, q: Vec) -> tuple[float, float, float]:
    return p[0], p[1], atan2(q[1] - p[1], q[0] - p[0])
