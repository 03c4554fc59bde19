"""A flywheel on a link or behind a gear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from linkwright.actuators.base import ACTUATORS, TIMES, Actuator
from linkwright.applied_loads import base
from linkwright.applied_loads.site import Site, Wrench
from linkwright.fields.base import Field
from linkwright.words import _


@ACTUATORS.register("flywheel")
@dataclass(frozen=True, kw_only=True)
class Flywheel(Actuator):
    """A flywheel of the moment of ``inertia`` J (kg·m²) on a link, or one that turns ``ratio`` i times as fast, on
    the frame: its torque on the link is -i²·J·α, in N·m.

    It acts in motion under forces only, beside the link's own inertia, which acts everywhere.
    Source: Norton, Design of Machinery, chapter 11 (controlling input torque: flywheels).
    """

    drives: ClassVar[bool] = False

    on: str = base.link(moving=True, doc=_("the link that carries or drives it"))
    inertia: float = base.quantity("inertia", above=0, doc=_("its moment of inertia"))
    ratio: float | None = base.quantity(
        "dimensionless", nonzero=True, default=None, doc=_("its speed over that of the link (default 1)")
    )

    @classmethod
    def fields(cls) -> dict[str, Field]:
        """The keys of a file by their names, without those about the time: it acts all the time."""
        return {name: each for name, each in super().fields().items() if name not in TIMES}

    def wrenches(self, site: Site) -> list[Wrench]:
        i = 1.0 if self.ratio is None else site.dimension("ratio")
        inertial = site.dimension("inertia") * i * site.turning_second(self.on, "frame")
        return [Wrench(self.on, torque=-(i * inertial)), Wrench("frame", torque=i * inertial)]
