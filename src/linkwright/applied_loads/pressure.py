"""Pressure of a gas or a process on a piston."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, Load, Magnitude
from linkwright.applied_loads.site import Site, Wrench
from linkwright.formula.trace import Scalar
from linkwright.words import _


@LOADS.register("pressure")
@dataclass(frozen=True, kw_only=True)
class Pressure(Load):
    """Pressure p on the block of a prismatic joint: force F = p·A along the guide, in N, and -F on the
    guide's link.

    p (Pa) is the pressure above that on the other side of the piston. Positive pressure pushes the block
    ``forward``, in the direction of the guide (the default), or ``backward``, against it: ``pushes``.
    ``area`` A (m²), or ``bore`` d (m), A = π·d²/4. Both forces act at the block's point. Pressure, one of:
    ``magnitude``, a number or an expression; ``ramp`` [p0, p1], linear in the input over the phase;
    ``table`` (an indicator diagram) over the input, the time or an output such as the joint's displacement.
    Outside ``phase`` it is zero; one load for each stroke gives a diagram over the displacement.

    Source: Norton, Design of Machinery, chapter 13 (engine dynamics, gas force).
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (("area", "bore"), ("magnitude", "ramp", "table"))
    joint: str = base.joint("slide", doc=_("the prismatic joint whose block is the piston"))
    area: float | None = base.quantity("area", above=0, default=None, doc=_("area of the piston"))
    bore: float | None = base.quantity("length", above=0, default=None, doc=_("diameter of the piston"))
    pushes: str = base.word(
        "forward", "backward", default="forward", doc=_("where it pushes the block (default: forward)")
    )
    magnitude: Magnitude = base.magnitude("pressure", word=_("pressure"))

    def wrenches(self, site: Site) -> list[Wrench]:
        direction, place, _ = site.guide(self.joint)
        joint = site.motion.mechanism.guides[self.joint]
        force = direction * (site.magnitude() * self._area(site))
        if self.pushes == "backward":
            force = -force
        return [Wrench(joint.block, force, place), Wrench(joint.guide, -force, place)]

    def _area(self, site: Site) -> Scalar:
        if self.area is not None:
            return site.dimension("area")
        bore = site.dimension("bore")
        return 0.25 * math.pi * (bore * bore)
