"""What all motors have in common: the gear between motor and machine, and the inertia of the rotor."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast

from linkwright.actuators.base import AlongCoordinate, Report
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site, Wrench
from linkwright.fields.tables import Flag
from linkwright.formula.late_import import numpy as np
from linkwright.formula.trace import Scalar, select, sign
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.core.arrays import Floats

flag = base.declares(Flag)


@dataclass(frozen=True)
class Rating:
    """What a motor may be asked for, None where that is not known: ``continuous`` torque (RMS, N·m) and ``peak``
    torque, ``largest_speed`` and the ``rated_speed``, rad/s, at which it is meant to run."""

    continuous: float | None = None
    peak: float | None = None
    largest_speed: float | None = None
    rated_speed: float | None = None

    @property
    def power(self) -> float:
        """Continuous torque times the speed at which it is meant to run, W; 0 where they are not known."""
        return (self.continuous or 0.0) * (self.rated_speed or self.largest_speed or 0.0)


@dataclass(frozen=True, kw_only=True)
class Motor(AlongCoordinate):
    """A motor that turns a link through a gear, or that pushes along a guide or between two points by a screw or a
    rack.

    The motor's speed is ``ratio`` i times that of the link, of a guide or two points i/``lead`` times (lead: m/rad);
    a negative ratio turns it round. It drives in the sense of its driver's nominal speed where it acts on a driven
    coordinate, else in the positive sense; its own speed and torque count as positive in that sense.

    With the motor's torque T the torque on the link is i·T·η where power flows to the machine, i·T/η where it flows
    back (``efficiency`` η); the rotor's ``inertia`` J adds i²·J to the link's. A ``self_locking`` gear (a worm) lets
    the motor drive only: wherever the motor does not, it holds with the torque ``holding``. ``controlled``: whether a
    controller decides how much of its torque it gives.
    """

    controlled: ClassVar[bool] = False

    ratio: float | None = base.quantity(
        "dimensionless", nonzero=True, default=None, doc=_("speed of the motor over that of the link (default 1)")
    )
    lead: float | None = base.quantity(
        "length_per_angle",
        above=0,
        default=None,
        doc=_("with along or between: travel per turn of the screw or pinion"),
    )
    efficiency: float | None = base.quantity(
        "dimensionless", above=0, maximum=1, default=None, doc=_("efficiency of the gear (default 1)")
    )
    inertia: float | None = base.quantity(
        "inertia", minimum=0, default=None, doc=_("moment of inertia of the rotor, on the motor's side (default 0)")
    )
    self_locking: bool = flag(default=False, doc=_("whether the gear, a worm, cannot be driven by the machine"))
    holding: float | None = base.quantity(
        "torque", above=0, default=None, doc=_("torque on the link up to which a self-locking gear holds it")
    )

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Report) -> None:
        super().check(values, report)
        straight = values.get("on") is None
        if straight and values.get("lead") is None:
            problem = _("a motor that pushes along a line has no lead", code="actuators.no_lead")
            report("", problem, _("add lead: the travel per turn, such as 5 mm/rev"))
        if not straight and values.get("lead") is not None:
            problem = _("a lead does not go with a link that turns", code="actuators.lead_of_link")
            report("lead", problem, _("write ratio: … instead"))
        if values.get("self_locking") and values.get("holding") is None:
            problem = _("nothing says how much a self-locking gear holds", code="actuators.no_holding")
            report("self_locking", problem, _("add holding: the torque on the link up to which it locks"))
        if values.get("holding") is not None and not values.get("self_locking"):
            problem = _("holding goes with self_locking", code="actuators.holding_alone")
            report("holding", problem, _("add self_locking: true, or remove it"))
        if values.get("between") is not None and values.get("inertia"):
            problem = _("a rotor's inertia needs a link or a guide", code="actuators.inertia_between")
            report("inertia", problem, _("write on: LINK or along: GUIDE instead of between, or remove it"))

    @property
    def rating(self) -> Rating:
        """What it may be asked for by its own data."""
        return Rating()

    def at_speed(self, speed: float, stiffness: float) -> Self:
        """The same with its controller, if it has one, set to a speed (rad/s), with a gain of ``stiffness`` times its
        peak torque over its largest speed."""
        return self

    @abstractmethod
    def torque(self, site: Site, speed: Scalar) -> Scalar:
        """The motor's torque, N·m, at its speed, rad/s, both in the sense in which it drives."""

    def torque_at(self, speed: Floats, time: Floats | float = math.inf) -> Floats:
        """The motor's torque, N·m, at speeds of the motor, rad/s, (n,), and times, s, by default long after the
        start; on the motor's side of the gear, while it acts."""
        site: Any = _AtTime(self, time)
        torque: Any = self.torque(site, cast(Any, speed))
        return np.asarray(torque + 0.0 * speed)

    def motor_speed(self, site: Site) -> Scalar:
        """The motor's speed, rad/s, in the sense in which it drives."""
        return self.sense(site) * self._transmission(site) * self.rate(site)

    def wrenches(self, site: Site) -> list[Wrench]:
        i, speed = self._transmission(site), self.motor_speed(site)
        torque = self.torque(site, speed)

        def chosen(ahead: tuple[Scalar, Scalar], back: tuple[Scalar, Scalar]) -> Scalar:
            """Of what holds where it turns ahead or back the first while it drives, the second while it is driven.

            By the speed and the torque, not by the power, which at rest would not tell one side from the other.
            """
            return select(speed > 0.0, select(torque > 0.0, *ahead), select(torque > 0.0, *reversed(back)))

        effort, otherwise = self.sense(site) * i * torque, cast(Scalar, 0.0)
        if self.efficiency is not None:
            eta = site.dimension("efficiency")
            effort = effort * chosen((eta, 1.0 / eta), (eta, 1.0 / eta))
        if self.self_locking:
            held = self._held(site)
            effort = effort + chosen((0.0, -held), (0.0, held))
            otherwise = select(speed > 0.0, -held, held)
        found = self.acting(site, self.within_times(site, effort, otherwise))
        return found + self._rotor(site, i) if self.inertia is not None else found

    def _transmission(self, site: Site) -> Scalar:
        """Speed of the motor over the rate of the coordinate, dimensionless or rad/m."""
        ratio = 1.0 if self.ratio is None else site.dimension("ratio")
        return ratio if self.lead is None else ratio / site.dimension("lead")

    def _held(self, site: Site) -> Scalar:
        """The friction of a gear that locks, against a motion in which the motor turns ahead; of a screw the torque
        is on its nut's drive."""
        holding = self.sense(site) * site.dimension("holding")
        if self.ratio is not None:
            holding = holding * sign(site.dimension("ratio"))
        return holding if self.lead is None else holding / site.dimension("lead")

    def _rotor(self, site: Site, i: Scalar) -> list[Wrench]:
        """The wrenches of the rotor's inertia. Its speed is i times that of the link, and that of a moving link
        ``against`` which carries it; that of a screw lies in the plane and does not couple with its carrier."""
        moment = site.dimension("inertia") * i * self.second(site)
        if self.on is None or self.against == "frame":
            return self.acting(site, -(i * moment))
        moment = moment + site.dimension("inertia") * site.turning_second(self.against, "frame")
        return [*self.acting(site, -(i * moment)), Wrench(self.against, torque=-moment)]


class _AtTime:
    """What a motor's torque takes of a site besides the speed: its dimensions, and the time, s."""

    def __init__(self, motor: Motor, time: Floats | float) -> None:
        self._address, self._dimensions, self.time = f"{motor.section}.{motor.name}.", motor.dimensions(), time

    def dimension(self, field: str) -> float:
        return self._dimensions[self._address + field]
