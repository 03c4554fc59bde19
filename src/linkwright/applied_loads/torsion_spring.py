"""A torsion spring between two links."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, Load, Magnitude
from linkwright.applied_loads.site import Site, Wrench
from linkwright.applied_loads.sizes import Twist
from linkwright.words import _


@LOADS.register("torsion_spring")
@dataclass(frozen=True, kw_only=True)
class TorsionSpring(Load):
    """A torsion spring between links [a, b]: torque on b is M = -(M0 + k·(φ - φ0)), in N·m, and -M on a.

    φ is the angle of b's x axis against a's, counter-clockwise positive (rad). ``stiffness`` k (N·m/rad);
    ``free_angle`` φ0 (rad, default 0); ``preload`` M0 (N·m, default 0), the torque at the free angle. Where
    the cycle begins φ is within half a turn of φ0; from there it is continuous, so that the spring winds
    up. The frame's x axis is that of the drawing.

    Energy k·(φ - φ0)²/2 + M0·(φ - φ0). Source: Norton, Design of Machinery, chapter 10 (dynamics fundamentals).
    """

    links: tuple[str, str] = base.links(doc=_("[a, b]: the two links between which it acts"))
    stiffness: float = base.quantity("torsional_stiffness", minimum=0, doc=_("torque per angle"))
    free_angle: float = base.quantity("angle", default=0.0, doc=_("angle of b against a without twist (default 0)"))
    preload: float = base.quantity("torque", default=0.0, doc=_("torque at the free angle (default 0)"))

    @property
    def magnitude(self) -> Magnitude:
        """The angle φ of link b against link a, rad."""
        return Magnitude(Twist(*self.links, self.free_angle))

    def wrenches(self, site: Site) -> list[Wrench]:
        a, b = self.links
        twist = site.magnitude() - site.dimension("free_angle")
        moment = site.dimension("preload") + site.dimension("stiffness") * twist
        return [Wrench(a, torque=moment), Wrench(b, torque=-moment)]
