"""A force at a point of a link."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, Load, Magnitude, Output
from linkwright.applied_loads.site import Mechanism, Site, Wrench
from linkwright.errors import LinkwrightError
from linkwright.formula.linear_algebra import Vec
from linkwright.words import _


@LOADS.register("force")
@dataclass(frozen=True, kw_only=True)
class Force(Load):
    """A force on the link ``on`` at its point ``at``, in N: F = magnitude · unit vector of its direction.

    Direction, one of: ``direction``, an angle (rad) fixed in space; ``in_link``, an angle in the axes of
    ``on``; ``normal_to`` [P, Q], along the left normal of the ray from P to Q of ``on``; ``along`` [P, Q],
    along that ray; ``opposes: velocity``, against the velocity of ``at`` in the frame, F = -magnitude v/|v|,
    zero at rest (where v is rounding of zero). Magnitude, one of: ``magnitude``, a number or an expression; ``ramp``
    [q0, q1], linear in the input over the phase (over the output's way where the phase is a part of its
    stroke); ``table``. A negative magnitude reverses the force. Instead of both:
    ``components`` [Fx, Fy] in frame axes. Outside ``phase`` the force is zero. The frame takes no part:
    whatever presses is outside the machine.

    Raises LinkwrightError where P and Q of a ray coincide, which then has no direction.
    Source: Norton, Design of Machinery, chapter 11 (dynamic force analysis).
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("direction", "in_link", "normal_to", "along", "opposes", "components"),
        ("magnitude", "ramp", "table", "components"),
    )
    on: str = base.link(moving=True, doc=_("the link on which the force acts"))
    at: str = base.point_of("on", doc=_("the point of the link at which it acts"))
    direction: float | None = base.quantity("angle", default=None, doc=_("direction, fixed in space"))
    in_link: float | None = base.quantity("angle", default=None, doc=_("direction in the axes of the link"))
    normal_to: tuple[str, str] | None = base.ray(
        "on", default=None, doc=_("[P, Q]: along the left normal of the ray P→Q")
    )
    along: tuple[str, str] | None = base.ray("on", default=None, doc=_("[P, Q]: along the ray P→Q"))
    opposes: str | None = base.word("velocity", default=None, doc=_("velocity: against the velocity of the point"))
    components: tuple[float, float] | None = base.values(
        "force", names=("x", "y"), default=None, doc=_("[Fx, Fy] in frame axes, instead of direction and magnitude")
    )
    magnitude: Magnitude = base.magnitude("force")

    def wrenches(self, site: Site) -> list[Wrench]:
        return [Wrench(self.on, self._force(site), site.place(self.on, self.at))]

    def _force(self, site: Site) -> Vec:
        if self.components is None:
            return self._unit(site) * site.magnitude()
        return Vec(site.dimension("components.x"), site.dimension("components.y")) * site.magnitude()

    def _unit(self, site: Site) -> Vec:
        if self.direction is not None:
            return site.direction(site.dimension("direction"))
        if self.in_link is not None:
            return site.axis(self.on).turn(site.direction(site.dimension("in_link")))
        if self.opposes is not None:
            return -site.heading_of(self.on, self.at)
        p, q = self.normal_to or self.along or (self.at, self.at)
        points = site.motion.mechanism.link(self.on).points
        if points[p] == points[q]:
            raise LinkwrightError(
                _(
                    "loads.{name}: the points {p} and {q} of {on} coincide, so the ray {p}→{q} has no "
                    "direction; name two points with different positions",
                    code="loads.no_ray",
                    name=self.name,
                    p=p,
                    q=q,
                    on=self.on,
                )
            )
        ray = site.place(self.on, q) - site.place(self.on, p)
        unit = ray * (1.0 / site.distance(self.on, p, q))
        return unit.perp if self.normal_to else unit

    def reverses(self, mechanism: Mechanism) -> Output | None:
        """With the motion on the frame of its link, or of one pinned there; no other point stops in general."""
        if self.opposes is None:
            return None
        pin = mechanism.joints.get(self.at)
        pinned = () if pin is None or pin.coordinate != "turn" or self.on not in pin.joined else pin.joined
        for link in (self.on, *pinned):
            for name, joint in mechanism.joints.items():
                if {"frame", link} <= set(joint.joined) and joint.coordinate and link != "frame":
                    turns = joint.coordinate == "turn"
                    return Output("angle", link) if turns else Output("displacement", name)
        return None
