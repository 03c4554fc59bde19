"""RRP: a link on a known pin, and a slider on a known guide."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt as root_of

from linkwright.core.quantity import shown
from linkwright.formula.trace import Scalar, reciprocal, sqrt
from linkwright.groups.base import DYADS, Chain, Solved
from linkwright.joints.pose import Rotor
from linkwright.words import Message, _


@DYADS.register("RRP")
class RRP:
    """Outer pin P, link of length r to the inner pin B, which the slider carries along the direction n.

    With f = P - B(0), h = n × f (distance of P from the pin's path): s = f·n + mode √(r² - h²).
    Modes: B ahead of or behind the foot of the perpendicular from P along the guide's direction: along n, and
    against n if the slider carries the guide. Out of reach if |h| > r (rrpk of the teaching texts).
    """

    signature = "RRP"
    pattern = ("R", "P")
    words = ("forward", "backward")

    def solve(self, a: Chain, b: Chain, mode: Scalar) -> Solved:
        assert a.arm is not None
        n = b.directions[0]
        f = a.anchor - b.anchor
        h = n.cross(f)
        rr = a.arm.square
        square = rr - h * h
        root = mode * sqrt(square)
        if b.senses[0] < 0.0:
            root = -root
        u = n * root - n.perp * h
        return Solved(
            coordinates=(Rotor(u, a.arm), f.dot(n) + root),
            inverse_determinant=reciprocal(root),
            square=square,
            scale=rr,
            facts={"height": h, "length²": rr},
        )

    def at_end(self, facts: Mapping[str, float]) -> Message:
        return _("has its link perpendicular to the guide", code="range.perpendicular")

    def explain(self, facts: Mapping[str, float]) -> Message:
        height, length = abs(facts["height"]), root_of(max(facts["length²"], 0.0))
        return _(
            "the outer pin is {height} from the path of the slider's pin, the link reaches "
            "{length}: {missing} missing",
            code="outcome.rrp_far",
            height=shown(height, "length", 7),
            length=shown(length, "length", 7),
            missing=shown(height - length, "length", 7),
        )
