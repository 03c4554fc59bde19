"""A viscous damper between two points."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, LinkPoint, Load
from linkwright.applied_loads.site import Site, Wrench
from linkwright.formula.linear_algebra import choose
from linkwright.formula.trace import select
from linkwright.words import _


@LOADS.register("damper")
@dataclass(frozen=True, kw_only=True)
class Damper(Load):
    """A viscous damper between two points: tension F = c·dL/dt, in N, positive where it pulls its ends
    together.

    ``damping`` c (N·s/m); L (m) is the distance of the ends. Both ends feel it, on the frame as well. It
    never gives power back.

    At L = 0 the direction is that of the relative velocity, the limit as the ends pass through each other.
    Source: Norton, Design of Machinery, chapter 10 (dynamics fundamentals).
    """

    between: tuple[LinkPoint, LinkPoint] = base.points(doc=_("its two ends, [link.point, link.point]"))
    damping: float = base.quantity("damping", minimum=0, doc=_("force per speed of elongation"))

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
        base.check_between(values, report)

    def wrenches(self, site: Site) -> list[Wrench]:
        a, b = self.between
        start, end = site.place(a.link, a.point), site.place(b.link, b.point)
        between = end - start
        parting = site.velocity(b.link, b.point) - site.velocity(a.link, a.point)
        square = between.square
        separated = square > 0.0
        along = between * (between.dot(parting) / select(separated, square, 1.0))
        pull = choose(separated, along, parting) * site.dimension("damping")
        return [Wrench(a.link, pull, start), Wrench(b.link, -pull, end)]
