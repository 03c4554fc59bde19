"""PRP: two known guides, and a pin between the two sliders."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.formula.trace import Scalar, reciprocal
from linkwright.groups.base import DYADS, Chain, Solved
from linkwright.words import Message, _


@DYADS.register("PRP")
class PRP:
    """The inner pin lies where the pin's two paths cross: A + s1 n1 = B + s2 n2.

    s1 = (f × n2) / (n1 × n2), s2 = (f × n1) / (n1 × n2), f = B - A. One mode. Singular for parallel
    guides (prpk of the teaching texts).
    """

    signature = "PRP"
    pattern = ("P", "P")
    words = ("", "")

    def solve(self, a: Chain, b: Chain, mode: Scalar) -> Solved:
        n1, n2 = a.directions[0], b.directions[0]
        f = b.anchor - a.anchor
        sine = n1.cross(n2)
        inverse = reciprocal(sine)
        return Solved(
            coordinates=(f.cross(n2) * inverse, f.cross(n1) * inverse),
            inverse_determinant=-inverse,
            square=sine * sine,
            scale=1.0,
            facts={"sine": sine},
        )

    def at_end(self, facts: Mapping[str, float]) -> Message:
        return _("has its guides parallel", code="range.parallel")

    def explain(self, facts: Mapping[str, float]) -> Message:
        return _(
            "the two guides are parallel (sine of the angle between them {sine})",
            code="outcome.prp_parallel",
            sine=f"{facts['sine']:.1e}",
        )
