"""RPR: two known pins, and a guide between the two links."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt as root_of

from linkwright.core.quantity import shown
from linkwright.formula.trace import Scalar, reciprocal, sqrt
from linkwright.groups.base import DYADS, Chain, Solved
from linkwright.joints.pose import Rotor
from linkwright.words import Message, _


@DYADS.register("RPR")
class RPR:
    """Outer pins P and Q; the links slide on each other along the direction m of the first link.

    With d = Q - P and e the distance across the guide between the pins (sum of both offsets):
    length along the guide ρ = mode √(d·d - e²), and the guide's direction is d (ρ - i e) / d·d as complex
    numbers. Modes: the block ahead of or behind the foot of the perpendicular along the guide. Out of
    reach if |d| < |e| (rprk of the teaching texts).
    """

    signature = "RPR"
    pattern = ("RP", "")
    words = ("forward", "backward")

    def solve(self, a: Chain, b: Chain, mode: Scalar) -> Solved:
        assert a.arm is not None
        m = a.directions[0]
        d = b.anchor - a.anchor
        dd = d.square
        e = m.cross(a.arm)
        square = dd - e * e
        root = sqrt(square)
        inverse = reciprocal(dd * root)
        along = mode * root
        scaled = inverse * root
        n = d * (along * scaled) - d.perp * (e * scaled)
        return Solved(
            coordinates=(Rotor(n, m), along - m.dot(a.arm)),
            inverse_determinant=(-mode) * (inverse * dd),
            square=square,
            scale=dd,
            facts={"distance²": dd, "offset": e},
        )

    def at_end(self, facts: Mapping[str, float]) -> Message:
        return _("has its outer pins as close as the offset of the guide allows", code="range.closest")

    def explain(self, facts: Mapping[str, float]) -> Message:
        distance, offset = root_of(max(facts["distance²"], 0.0)), abs(facts["offset"])
        return _(
            "the distance of the outer pins is {distance}, the guide needs {offset} across its "
            "direction: {missing} too close",
            code="outcome.rpr_near",
            distance=shown(distance, "length", 7),
            offset=shown(offset, "length", 7),
            missing=shown(offset - distance, "length", 7),
        )
