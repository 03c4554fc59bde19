"""A three-phase induction motor by its rated data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt
from typing import Any

from linkwright.actuators.base import ACTUATORS, Report
from linkwright.actuators.motor import Motor, Rating
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site
from linkwright.formula import trace
from linkwright.formula.trace import Scalar, minimum, select
from linkwright.words import _


@ACTUATORS.register("induction")
@dataclass(frozen=True, kw_only=True)
class InductionMotor(Motor):
    """An induction motor on the mains, by Kloss' formula: T = 2·Tk/(s/sk + sk/s), in N·m.

    With the slip s = 1 - ω/ω0 (``synchronous`` speed ω0), the breakdown torque Tk = ``pull_out``·Tn and the breakdown
    slip sk = sn·(m + √(m² - 1)), m = ``pull_out``, so that the curve passes through the rated point: torque Tn =
    ``power``/``speed`` at the rated ``speed``. Above ω0 it brakes as a generator.

    ``starting``: torque at rest over Tn, where the rotor has deep bars and Kloss' formula gives less; beyond the
    breakdown slip the difference grows as ((s - sk)/(1 - sk))². ``star_until``: up to this time it is connected in
    star, with a third of the torque (star-delta start).

    Source: Kloss, Drehmoment und Schlüpfung des Drehstrommotors, Arch. f. Elektrotechnik 5 (1916), 59–87.
    """

    power: float = base.quantity("power", above=0, doc=_("rated power"))
    speed: float = base.quantity("angular_velocity", above=0, doc=_("rated speed"))
    synchronous: float = base.quantity("angular_velocity", above=0, doc=_("synchronous speed: 1500 rpm, 3000 rpm"))
    pull_out: float = base.quantity("dimensionless", above=1, doc=_("breakdown torque over rated torque"))
    starting: float | None = base.quantity(
        "dimensionless", above=0, default=None, doc=_("torque at rest over rated torque (default: by Kloss' formula)")
    )
    star_until: float | None = base.quantity(
        "time", above=0, default=None, doc=_("time up to which it is connected in star (default: not)")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        speed, synchronous, m = values["speed"], values["synchronous"], values["pull_out"]
        if speed >= synchronous:
            problem = _("the rated speed is not below the synchronous speed", code="actuators.rated_speed")
            report("speed", problem, _("give the rated speed of the data sheet, such as 1455 rpm at 1500 rpm"))
        elif values.get("starting") is not None and (1.0 - speed / synchronous) * (m + sqrt(m * m - 1.0)) >= 1.0:
            problem = _(
                "the breakdown slip is {slip:.3g}, so the torque at rest follows from Kloss' formula",
                code="actuators.breakdown_slip",
                slip=(1.0 - speed / synchronous) * (m + sqrt(m * m - 1.0)),
            )
            report("starting", problem, _("remove it, or check speed and pull_out"))

    @property
    def rating(self) -> Rating:
        rated = self.power / self.speed
        return Rating(rated, self.pull_out * rated, None, self.speed)

    def torque(self, site: Site, speed: Scalar) -> Scalar:
        rated, ratio = site.dimension("power") / site.dimension("speed"), site.dimension("pull_out")
        synchronous = site.dimension("synchronous")
        slip, rated_slip = 1.0 - speed / synchronous, 1.0 - site.dimension("speed") / synchronous
        breakdown = rated_slip * (ratio + trace.sqrt(ratio * ratio - 1.0))

        def kloss(s: Scalar) -> Scalar:
            return 2.0 * ratio * rated * s * breakdown / (s * s + breakdown * breakdown)

        found = kloss(slip)
        if self.starting is not None:
            beyond = (minimum(slip, 1.0) - breakdown) / (1.0 - breakdown)
            more = (site.dimension("starting") * rated - kloss(1.0)) * beyond * beyond
            found = found + select(slip > breakdown, more, 0.0)
        if self.star_until is not None:
            found = found * select(site.time < site.dimension("star_until"), 1.0 / 3.0, 1.0)
        return found
