"""A direct-current motor with permanent magnets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from linkwright.actuators.base import ACTUATORS, Report
from linkwright.actuators.motor import Motor
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site
from linkwright.formula.trace import Scalar, maximum, minimum
from linkwright.words import _


@ACTUATORS.register("dc")
@dataclass(frozen=True, kw_only=True)
class DirectCurrentMotor(Motor):
    """A direct-current motor: T = k·I with the current I = (U - k·ω)/R, at most ``current``, in N·m.

    ``voltage`` U (V), ``constant`` k (N·m/A, the same as V·s/rad), ``resistance`` R (ohm). Or by its ``stall_torque``
    k·U/R and its ``no_load_speed`` U/k (rad/s): T = stall torque·(1 - ω/no-load speed).

    The current follows the voltage at once: its inductance is left out. Switched off it gives no torque.
    Source: Fitzgerald, Kingsley, Umans, Electric Machinery, chapter on DC machines.
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (*Motor.exactly_one, ("voltage", "stall_torque"))
    voltage: float | None = base.quantity("voltage", above=0, default=None, doc=_("voltage of the supply"))
    constant: float | None = base.quantity(
        "torque_per_current", above=0, default=None, doc=_("torque per current of the motor")
    )
    resistance: float | None = base.quantity(
        "resistance", above=0, default=None, doc=_("resistance of armature and supply")
    )
    current: float | None = base.quantity(
        "current", above=0, default=None, doc=_("limit of the current (default: none)")
    )
    stall_torque: float | None = base.quantity("torque", above=0, default=None, doc=_("torque at rest"))
    no_load_speed: float | None = base.quantity(
        "angular_velocity", above=0, default=None, doc=_("speed without a load")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        electric = values.get("voltage") is not None
        needed = _ELECTRIC if electric else _MECHANICAL
        foreign = ("no_load_speed",) if electric else ("constant", "resistance", "current")
        for key in needed:
            if values.get(key) is None:
                problem = _("{key_} is missing", code="actuators.dc_missing", key_=key)
                report("", problem, _("give {words} together", words=needed))
        for key in foreign:
            if values.get(key) is not None:
                problem = _("{key_} does not go with {other}", code="actuators.dc_foreign", key_=key, other=needed[0])
                report(key, problem, _("remove it"))

    def torque(self, site: Site, speed: Scalar) -> Scalar:
        if self.voltage is None:
            return site.dimension("stall_torque") * (1.0 - speed / site.dimension("no_load_speed"))
        k = site.dimension("constant")
        current = (site.dimension("voltage") - k * speed) / site.dimension("resistance")
        if self.current is not None:
            limit = site.dimension("current")
            current = minimum(maximum(current, -limit), limit)
        return k * current


_ELECTRIC = ("voltage", "constant", "resistance")
_MECHANICAL = ("stall_torque", "no_load_speed")
