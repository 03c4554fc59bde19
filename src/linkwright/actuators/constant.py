"""A constant torque or force, such as that of a hand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from linkwright.actuators.base import ACTUATORS, AlongCoordinate, Report, check_effort
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site, Wrench
from linkwright.words import _


@ACTUATORS.register("constant")
@dataclass(frozen=True, kw_only=True)
class ConstantEffort(AlongCoordinate):
    """A constant ``torque`` (N·m) on a link, or a constant ``force`` (N) along a guide or between two points.

    A torque is positive counter-clockwise on the link ``on``, against ``against``; a force is positive where it
    pushes the block of the guide ``along`` in the direction of the guide, or the two points ``between`` apart.
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (*AlongCoordinate.exactly_one, ("torque", "force"))
    torque: float | None = base.quantity(
        "torque", default=None, doc=_("torque on the link, counter-clockwise positive")
    )
    force: float | None = base.quantity(
        "force", default=None, doc=_("force along the guide, or that pushes the two points apart")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        check_effort(values, report)

    def wrenches(self, site: Site) -> list[Wrench]:
        effort = site.dimension("torque" if self.rotary else "force")
        return self.acting(site, self.within_times(site, effort))
