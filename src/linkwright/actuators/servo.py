"""A servo motor with its controller of the speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from linkwright.actuators.base import ACTUATORS, Report
from linkwright.actuators.motor import Motor, Rating
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site
from linkwright.formula.trace import Scalar, absolute, maximum, minimum, select
from linkwright.words import _


@ACTUATORS.register("servo")
@dataclass(frozen=True, kw_only=True)
class ServoMotor(Motor):
    """A servo motor that holds its ``speed`` (rad/s) within its limits: T = gain·(speed - ω), at most ±limit, in N·m.

    The limit is the ``peak`` torque; beyond the speed ``knee`` it falls along a line to the ``continuous`` torque at
    the ``largest_speed``. Faster than that the motor does not drive, it only brakes. The continuous torque is what
    the root mean square of the torque may reach in the long run; it limits nothing in the motion.

    ``ramp``: time in which the wanted speed rises from zero, from the time ``from`` on.
    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, chapter 7.
    """

    controlled: ClassVar[bool] = True
    continuous: float = base.quantity("torque", above=0, doc=_("torque that it gives all the time"))
    peak: float = base.quantity("torque", above=0, doc=_("torque that it gives for a short time"))
    largest_speed: float = base.quantity("angular_velocity", above=0, doc=_("largest speed of the motor"))
    speed: float = base.quantity("angular_velocity", doc=_("speed of the motor that the controller holds"))
    gain: float = base.quantity(
        "torsional_damping", above=0, doc=_("torque of the controller per difference of the speed")
    )
    knee: float | None = base.quantity(
        "angular_velocity", above=0, default=None, doc=_("speed from which the peak torque falls (default: none)")
    )
    ramp: float | None = base.quantity(
        "time", above=0, default=None, doc=_("time in which the wanted speed rises from zero (default: at once)")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        if values["peak"] < values["continuous"]:
            problem = _("the peak torque is below the continuous torque", code="actuators.peak_below")
            report("peak", problem, _("exchange them, or check their units"))
        if abs(values["speed"]) > values["largest_speed"]:
            problem = _("the wanted speed is above the largest speed", code="actuators.servo_too_fast")
            report("speed", problem, _("lower it, or change the ratio of the gear"))
        if (values.get("knee") or 0.0) >= values["largest_speed"]:
            problem = _("the knee is not below the largest speed", code="actuators.knee_beyond")
            report("knee", problem, _("give a smaller speed, or remove it"))

    @property
    def rating(self) -> Rating:
        return Rating(self.continuous, self.peak, self.largest_speed)

    def at_limit(self) -> Self:
        stiff = 1e9 * self.peak / self.largest_speed
        return replace(self, speed=self.largest_speed, gain=stiff, ramp=None)

    def at_speed(self, speed: float, stiffness: float) -> Self:
        return replace(self, speed=speed, gain=stiffness * self.peak / self.largest_speed)

    def torque(self, site: Site, speed: Scalar) -> Scalar:
        limit, largest = self._limit(site, speed), site.dimension("largest_speed")
        wanted = site.dimension("gain") * (self._wanted(site) - speed)
        found = minimum(maximum(wanted, -limit), limit)
        return select(absolute(speed) > largest, select(found * speed > 0.0, 0.0, found), found)

    def _limit(self, site: Site, speed: Scalar) -> Scalar:
        """The torque that it has at a speed."""
        peak = site.dimension("peak")
        if self.knee is None:
            return peak
        knee, continuous = site.dimension("knee"), site.dimension("continuous")
        share = (absolute(speed) - knee) / (site.dimension("largest_speed") - knee)
        return peak - (peak - continuous) * minimum(maximum(share, 0.0), 1.0)

    def _wanted(self, site: Site) -> Scalar:
        """The speed that the controller wants."""
        speed = site.dimension("speed")
        if self.ramp is None:
            return speed
        begun = site.time if self.begin is None else site.time - site.dimension("from")
        return speed * minimum(maximum(begun / site.dimension("ramp"), 0.0), 1.0)
