"""A spring between two points."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, LinkPoint, Load
from linkwright.applied_loads.site import Site, Wrench
from linkwright.formula.trace import select, sqrt
from linkwright.words import _


@LOADS.register("spring")
@dataclass(frozen=True, kw_only=True)
class Spring(Load):
    """A linear spring between two points: tension F = F0 + k·(L - L0), in N, positive where it pulls its
    ends together.

    ``stiffness`` k (N/m); ``free_length`` L0 (m, default 0); ``preload`` F0 (N, default 0), the tension at
    the free length; L (m) is the distance of the ends. It pulls and pushes. Both ends feel it, on the frame
    as well.

    At L = 0 the spring has no direction: the part k·(vector between the ends) vanishes, and the rest,
    F0 - k·L0, is taken as zero there, the mean over all directions.
    Energy k·(L - L0)²/2 + F0·(L - L0). Source: Norton, Design of Machinery, chapter 10 (dynamics fundamentals).
    """

    between: tuple[LinkPoint, LinkPoint] = base.points(doc=_("its two ends, [link.point, link.point]"))
    stiffness: float = base.quantity("stiffness", minimum=0, doc=_("force per elongation"))
    free_length: float = base.quantity(
        "length", minimum=0, default=0.0, doc=_("length without elongation (default 0)")
    )
    preload: float = base.quantity("force", default=0.0, doc=_("tension at the free length (default 0)"))

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
        base.check_between(values, report)

    def wrenches(self, site: Site) -> list[Wrench]:
        a, b = self.between
        start, end = site.place(a.link, a.point), site.place(b.link, b.point)
        between = end - start
        stiffness = site.dimension("stiffness")
        steady = site.dimension("preload") - stiffness * site.dimension("free_length")
        square = between.square
        separated = square > 0.0
        inverse = select(separated, 1.0 / sqrt(select(separated, square, 1.0)), 0.0)
        pull = between * stiffness + between * (steady * inverse)
        return [Wrench(a.link, pull, start), Wrench(b.link, -pull, end)]
