"""A brake, or a clutch to a fixed part: dry friction of constant size."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from linkwright.actuators.base import ACTUATORS, AlongCoordinate, Report, check_effort
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site, Wrench
from linkwright.formula.trace import select
from linkwright.words import _


@ACTUATORS.register("brake")
@dataclass(frozen=True, kw_only=True)
class Brake(AlongCoordinate):
    """A brake of constant friction (Coulomb): ``torque`` (N·m) against the rotation of ``on`` relative to
    ``against``, or ``force`` (N) against the sliding along a guide or the motion of two points from each other.

    M = -torque·sign(ω). At rest it holds with up to this torque.
    Source: Norton, Design of Machinery, chapter 10 (dynamics fundamentals).
    """

    drives: ClassVar[bool] = False
    brakes: ClassVar[bool] = True
    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (*AlongCoordinate.exactly_one, ("torque", "force"))
    torque: float | None = base.quantity("torque", minimum=0, default=None, doc=_("torque of friction"))
    force: float | None = base.quantity("force", minimum=0, default=None, doc=_("force of friction"))

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        check_effort(values, report)

    def wrenches(self, site: Site) -> list[Wrench]:
        friction, rate = site.dimension("torque" if self.rotary else "force"), self.rate(site)
        against = select(rate > 0.0, -friction, select(rate < 0.0, friction, 0.0))
        return self.acting(site, self.within_times(site, against))
