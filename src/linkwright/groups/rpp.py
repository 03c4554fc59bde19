"""RPP: a known guide, a known pin, and a guide between the two links."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.formula.trace import Scalar, reciprocal
from linkwright.groups.base import DYADS, Chain, Solved
from linkwright.words import Message, _


@DYADS.register("RPP")
class RPP:
    """Both links keep the direction of the outer guide; two slides carry the second link's pin to Q.

    C + s1 n1 + s2 n2 = Q: s1 = (f × n2) / (n1 × n2), s2 = (n1 × f) / (n1 × n2), f = Q - C. One mode. The
    angle between the slides is fixed; singular if they are parallel (rppk of the teaching texts).
    """

    signature = "RPP"
    pattern = ("PP", "")
    words = ("", "")

    def solve(self, a: Chain, b: Chain, mode: Scalar) -> Solved:
        n1, n2 = a.directions
        f = b.anchor - a.anchor
        sine = n1.cross(n2)
        inverse = reciprocal(sine)
        return Solved(
            coordinates=(f.cross(n2) * inverse, n1.cross(f) * inverse),
            inverse_determinant=inverse,
            square=sine * sine,
            scale=1.0,
            facts={"sine": sine},
        )

    def at_end(self, facts: Mapping[str, float]) -> Message:
        return _("has its guides parallel", code="range.parallel")

    def explain(self, facts: Mapping[str, float]) -> Message:
        return _(
            "the two slides are parallel (sine of the angle between them {sine})",
            code="outcome.rpp_parallel",
            sine=f"{facts['sine']:.1e}",
        )
