"""A viscous torsion damper between two links."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, Load
from linkwright.applied_loads.site import Site, Wrench
from linkwright.words import _


@LOADS.register("torsion_damper")
@dataclass(frozen=True, kw_only=True)
class TorsionDamper(Load):
    """A viscous torsion damper between links [a, b]: torque on b is M = -c·(ω_b - ω_a), in N·m, and -M on a.

    ``damping`` c (N·m·s/rad); angular velocities in rad/s, counter-clockwise positive. It never gives power
    back. Source: Norton, Design of Machinery, chapter 10 (dynamics fundamentals).
    """

    links: tuple[str, str] = base.links(doc=_("[a, b]: the two links between which it acts"))
    damping: float = base.quantity("torsional_damping", minimum=0, doc=_("torque per angular velocity"))

    def wrenches(self, site: Site) -> list[Wrench]:
        a, b = self.links
        moment = site.dimension("damping") * (site.omega(b) - site.omega(a))
        return [Wrench(a, torque=moment), Wrench(b, torque=-moment)]
