"""A torque between two links."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, Load, Magnitude, Output
from linkwright.applied_loads.site import Mechanism, Site, Wrench
from linkwright.core.outputs import RelativeAngle
from linkwright.formula.trace import select
from linkwright.words import _


@LOADS.register("torque")
@dataclass(frozen=True, kw_only=True)
class Torque(Load):
    """A torque M on the link ``on``, N·m, counter-clockwise positive, and -M on the link ``against``.

    Magnitude, one of: ``magnitude``, a number or an expression; ``ramp`` [M0, M1], linear in the input over
    the phase; ``table``. With ``opposes: velocity`` a positive magnitude acts against the rotation of ``on``
    relative to ``against``, M = -magnitude sign(ω), zero at rest (where ω is rounding of zero). Outside ``phase``
    it is zero.

    Source: Norton, Design of Machinery, chapter 11 (dynamic force analysis).
    """

    exactly_one: ClassVar[tuple[tuple[str, ...], ...]] = (("magnitude", "ramp", "table"),)
    on: str = base.link(moving=True, doc=_("the link on which the torque acts"))
    against: str = base.link(default="frame", doc=_("the link that takes the opposite torque (default: frame)"))
    opposes: str | None = base.word(
        "velocity", default=None, doc=_("velocity: against the rotation of on relative to against")
    )
    magnitude: Magnitude = base.magnitude("torque")

    @classmethod
    def check(cls, values: Mapping[str, Any], report: Callable[[str, str, str], None]) -> None:
        if values.get("on") is not None and values.get("on") == values.get("against"):
            report(
                "against",
                _(
                    'the torque acts on and against the same link "{link}"',
                    code="loads.same_links",
                    link=values["on"],
                ),
                _("name another link"),
            )

    def wrenches(self, site: Site) -> list[Wrench]:
        moment = site.magnitude()
        if self.opposes is not None:
            omega = site.turning(self.on, self.against)
            moment = moment * select(omega > 0.0, -1.0, select(omega < 0.0, 1.0, 0.0))
        return [Wrench(self.on, torque=moment), Wrench(self.against, torque=-moment)]

    def reverses(self, mechanism: Mechanism) -> Output | RelativeAngle | None:
        """With the rotation that it opposes."""
        if self.opposes is None:
            return None
        return Output("angle", self.on) if self.against == "frame" else RelativeAngle(self.against, self.on)
