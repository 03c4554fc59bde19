"""RRR: two links between two known pins."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt as root_of

from linkwright.core.quantity import shown
from linkwright.formula.trace import Scalar, reciprocal, sqrt
from linkwright.groups.base import DYADS, Chain, Solved
from linkwright.joints.pose import Rotor
from linkwright.words import Message, _


@DYADS.register("RRR")
class RRR:
    """Outer pins P and Q, links of lengths r1 = PB and r2 = QB.

    With d = Q - P, t = d·d + r1² - r2²: B - P = (t d + mode √(4 r1² d·d - t²) d⊥) / (2 d·d), the same root
    being twice the determinant of the rate and force equations. Modes: B on the left or right of the ray
    P→Q. Out of reach if |d| > r1 + r2 or |d| < |r1 - r2| (Suh & Radcliffe, Kinematics and Mechanisms
    Design, ch. 4; rrrk of the teaching texts).
    """

    signature = "RRR"
    pattern = ("R", "R")
    words = ("left", "right")

    def solve(self, a: Chain, b: Chain, mode: Scalar) -> Solved:
        assert a.arm is not None and b.arm is not None
        d = b.anchor - a.anchor
        dd = d.square
        r1, r2 = a.arm.square, b.arm.square
        t = dd + (r1 - r2)
        scale = (4.0 * r1) * dd
        square = scale - t * t
        root = sqrt(square)
        inverse = reciprocal(dd * root)
        half = 0.5 * (inverse * root)
        along, across = t * half, (mode * root) * half
        u = d * along + d.perp * across
        return Solved(
            coordinates=(Rotor(u, a.arm), Rotor(u - d, b.arm)),
            inverse_determinant=(-2.0 * mode) * (inverse * dd),
            square=square,
            scale=scale,
            facts={"distance²": dd, "first²": r1, "second²": r2},
        )

    def at_end(self, facts: Mapping[str, float]) -> Message:
        distance, r1, r2 = (root_of(max(facts[key], 0.0)) for key in ("distance²", "first²", "second²"))
        stretched = abs(distance - r1 - r2) < abs(distance - abs(r1 - r2))
        return _("is stretched", code="range.stretched") if stretched else _("is folded", code="range.folded")

    def explain(self, facts: Mapping[str, float]) -> Message:
        distance, r1, r2 = (root_of(max(facts[key], 0.0)) for key in ("distance²", "first²", "second²"))
        far = distance > r1 + r2
        reach = r1 + r2 if far else abs(r1 - r2)
        return (
            _(
                "the distance of the outer pins is {distance}, links of {first} and {second} reach {reach}: "
                "{missing} missing",
                code="outcome.rrr_far",
            )
            if far
            else _(
                "the distance of the outer pins is {distance}, links of {first} and {second} need at least "
                "{reach}: {missing} too close",
                code="outcome.rrr_near",
            )
        ).format(
            distance=shown(distance, "length", 7),
            first=shown(r1, "length", 7),
            second=shown(r2, "length", 7),
            reach=shown(reach, "length", 7),
            missing=shown(distance - reach if far else reach - distance, "length", 7),
        )
