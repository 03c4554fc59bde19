"""A hydraulic or pneumatic cylinder, or an electric one of given force."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar

from linkwright.actuators.base import ACTUATORS, AlongLine, Report
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site, Wrench
from linkwright.formula.trace import Scalar, select
from linkwright.words import _


@ACTUATORS.register("cylinder")
@dataclass(frozen=True, kw_only=True)
class Cylinder(AlongLine):
    """A cylinder between two points, or along a guide: it pushes with the force F, in N, positive where it extends.

    F = ``force``, or F = pressure·π·bore²/4 - rod_pressure·π·(bore² - rod²)/4: the ``pressure`` (Pa) on the side of
    the piston, the ``rod_pressure`` on that of the rod, both above that of the air.

    ``largest_speed`` (m/s): the speed to which the flow limits it; the force falls with the speed in its own sense
    along a line, to zero there. ``stroke``: the shortest and the longest distance of the two points, or displacement
    of the guide, in m; what ends the motion there are end stops.

    Source: Norton, Design of Machinery, chapter 11 (dynamic force analysis).
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (*AlongLine.exactly_one, ("force", "bore"))
    force: float | None = base.quantity("force", default=None, doc=_("force, positive where it extends"))
    bore: float | None = base.quantity("length", above=0, default=None, doc=_("diameter of the piston"))
    rod: float | None = base.quantity("length", minimum=0, default=None, doc=_("diameter of the rod (default 0)"))
    pressure: float | None = base.quantity(
        "pressure", minimum=0, default=None, doc=_("pressure on the side of the piston (default 0)")
    )
    rod_pressure: float | None = base.quantity(
        "pressure", minimum=0, default=None, doc=_("pressure on the side of the rod (default 0)")
    )
    largest_speed: float | None = base.quantity(
        "velocity", above=0, default=None, doc=_("speed at which its force falls to zero (default: no limit)")
    )
    stroke: tuple[float, float] | None = base.values(
        "length", names=("min", "max"), default=None, doc=_("[shortest, longest] of the cylinder")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        bore, pressures = values.get("bore"), [values.get(key) for key in ("pressure", "rod_pressure")]
        if bore is None:
            for key in ("rod", "pressure", "rod_pressure"):
                if values.get(key) is not None:
                    problem = _("{key_} does not go with force", code="actuators.with_force", key_=key)
                    report(key, problem, _("give bore instead of force, or remove it"))
        elif pressures == [None, None]:
            problem = _("no pressure is given", code="actuators.no_pressure")
            report("", problem, _("add pressure, or rod_pressure"))
        if bore is not None and (values.get("rod") or 0.0) >= bore:
            problem = _("the rod is not thinner than the piston", code="actuators.thick_rod")
            report("rod", problem, _("exchange rod and bore, or check their units"))
        stroke = values.get("stroke")
        if stroke is not None and stroke[0] >= stroke[1]:
            problem = _("the first end of the stroke is not below the second", code="actuators.stroke_exchanged")
            report("stroke", problem, _("exchange them"))

    def wrenches(self, site: Site) -> list[Wrench]:
        force = self._thrust(site)
        if self.largest_speed is not None:
            rate = self.rate(site)
            ahead = select(force < 0.0, -rate, rate)
            force = force * select(ahead > 0.0, 1.0 - ahead / site.dimension("largest_speed"), 1.0)
        return self.acting(site, self.within_times(site, force))

    def _thrust(self, site: Site) -> Scalar:
        """The force at rest."""
        if self.force is not None:
            return site.dimension("force")
        piston = 0.25 * pi * site.dimension("bore") * site.dimension("bore")
        ring = piston if self.rod is None else piston - 0.25 * pi * site.dimension("rod") * site.dimension("rod")
        push = 0.0 if self.pressure is None else site.dimension("pressure") * piston
        pull = 0.0 if self.rod_pressure is None else site.dimension("rod_pressure") * ring
        return push - pull
