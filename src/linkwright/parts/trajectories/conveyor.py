"""What a swinging conveyor does to its load: rest, sliding forward and back, throw, by a mechanism's motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from linkwright.analysis import Analysis
from linkwright.core.arguments import CURVE_STEPS
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.core.table import PERCENT, Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, LinkwrightError, fault
from linkwright.fields.base import Quantity, Text, file_key
from linkwright.fields.tables import Integer
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Result
from linkwright.parts.fields import MECHANISM, OfMechanism
from linkwright.parts.trajectories.transport import FLIGHT, MODES, Transported, Trough, transport
from linkwright.words import Message, Translate, _

#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "displacement": _("displacement per cycle"),
    "throw_number": _("throw number max(−a_n)/|g_n|"),
    "needed_friction": _("minimum friction that keeps the load at rest"),
}
#: What the load does, in words.
MODE_NAMES = {
    "rest": _("rest"),
    "forward": _("sliding forward"),
    "backward": _("sliding back"),
    "flight": _("flight"),
}


@dataclass(frozen=True)
class Conveyor(OfMechanism):
    """The ``link`` of a ``mechanism`` is a trough that does not turn; its surface rises by ``incline`` rad along +x.

    ``friction`` at rest, ``sliding_friction`` in motion (the same unless given).
    """

    kind: ClassVar[str] = "throw"
    mechanism: Mechanism = file_key(MECHANISM)
    link: str = file_key(Text(doc="the link that is the trough"))
    friction: float = file_key(Quantity("dimensionless", minimum=0.0, doc="coefficient of friction at rest"))
    sliding_friction: float | None = file_key(
        Quantity("dimensionless", minimum=0.0, doc="in motion; default: as at rest"), None
    )
    incline: float = file_key(Quantity("angle", doc="how much the surface rises along +x; default: 0"), 0.0)
    steps: int = file_key(Integer(36, doc="positions over the cycle; default: 720"), CURVE_STEPS)
    name: str = ""
    source: str = ""

    @cached_property
    def motion(self) -> Motion:
        """Motion over the cycle; raises LinkwrightError."""
        return solve_motion(self.mechanism, steps=self.steps)

    def findings(self) -> list[Finding]:
        if self.link not in self.mechanism.links:
            known = ", ".join(self.mechanism.links)
            return [
                fault(
                    "no_link",
                    "link",
                    _('there is no link "{link}"'),
                    _("one of: {known}"),
                    link=self.link,
                    known=known,
                )
            ]
        try:
            motion = self.motion
        except LinkwrightError as error:
            return [
                fault(
                    "thrower",
                    "mechanism",
                    _("the mechanism cannot be solved: {why}"),
                    _("mend the model or the names (linkwright check)"),
                    why=error.sentence,
                )
            ]
        found = []
        if not motion.positions.closed or np.ptp(np.diff(motion.time)) > 1e-9 * abs(float(motion.time[1])):
            found.append(
                fault(
                    "uneven",
                    "mechanism",
                    _("the cycle is not closed or not even in time"),
                    _("drive the mechanism at constant speed over full turns"),
                )
            )
        turning = np.abs(motion.link(self.link).angular_velocity).max()
        if turning * abs(float(motion.time[-1])) > 1e-6:
            found.append(
                fault(
                    "turns",
                    "link",
                    _("the trough {link} turns"),
                    _("choose a trough that keeps its direction: a slider, or a parallelogram's coupler"),
                    link=self.link,
                )
            )
        gravity = np.hypot(*self.mechanism.gravity)
        if not gravity or self.gravity[1] >= 0:
            found.append(
                fault(
                    "no_gravity",
                    "mechanism",
                    _("no gravity presses the load on the trough"),
                    _("give the mechanism gravity: [0, -9.81 m/s²], and an incline below 90°"),
                )
            )
        if (self.sliding_friction or 0.0) > self.friction:
            found.append(
                fault(
                    "friction_order",
                    "sliding_friction",
                    _("friction in motion is larger than at rest"),
                    _("give a sliding_friction of at most friction"),
                )
            )
        return found

    @property
    def axes(self) -> tuple[Floats, Floats]:
        """Unit vectors along the surface and away from it."""
        c, s = math.cos(self.incline), math.sin(self.incline)
        return np.array([c, s]), np.array([-s, c])

    @property
    def gravity(self) -> tuple[float, float]:
        """Gravity along and across the surface, m/s²."""
        along, across = self.axes
        return float(along @ self.mechanism.gravity), float(across @ self.mechanism.gravity)

    def accelerations(self, motion: Motion) -> tuple[Floats, Floats]:
        """Those of the trough along and across the surface, (n,) m/s²."""
        along, across = self.axes
        point = next(iter(self.mechanism.links[self.link].points))
        a = motion.point(f"{self.link}.{point}").acceleration
        return a @ along, a @ across

    @property
    def trough(self) -> Trough:
        """The trough's motion in numbers."""
        period = float(self.motion.time[1] - self.motion.time[0]) * len(self.motion.time)
        sliding = self.friction if self.sliding_friction is None else self.sliding_friction
        return Trough(*self.accelerations(self.motion), period, self.gravity, self.friction, sliding)

    def solve(self) -> Transport:
        """The load's steady motion. Raises ModelError with all findings."""
        self.require()
        return Transport(self, transport(self.trough))


@dataclass(frozen=True, repr=False)
class Transport(Result):
    """How a load moves over the trough, steady from cycle to cycle; relative motion, along the surface.

    Per mass: normal force N = a_n − g_n, friction for rest f = a_t − g_t, rest while |f| ≤ μ N; sliding
    s̈ = −f ∓ μ' N; throw where N would be negative; landing without bounce, its blow rubs.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    conveyor: Conveyor
    motion: Transported

    @property
    def speed(self) -> float:
        """Mean speed of transport, m/s, positive along +x."""
        return self.motion.displacement / self.conveyor.trough.period

    @property
    def shares(self) -> dict[str, float]:
        """Share of the cycle in each mode."""
        period = self.conveyor.trough.period
        return {
            mode: sum(phase.end - phase.start for phase in self.motion.phases if phase.mode == mode) / period
            for mode in MODES
        }

    @cached_property
    def needed_friction(self) -> float:
        """Minimum coefficient with which the load would stay at rest; infinite where it is thrown."""
        along, across = self.conveyor.gravity
        if self.throw_number >= 1.0:
            return math.inf
        return self._largest(lambda a, n: np.abs(a - along) / (n - across))

    @cached_property
    def throw_number(self) -> float:
        """max(−a_n)/|g_n|: the load is thrown above 1."""
        return self._largest(lambda _along, across: -across) / abs(self.conveyor.gravity[1])

    def _largest(self, of: Callable[[Floats, Floats], Floats]) -> float:
        """The largest value over the cycle of what both accelerations give."""
        conveyor = self.conveyor
        found = Analysis.of(conveyor.motion).extreme(lambda motion: of(*conveyor.accelerations(motion)), "max")
        assert found is not None
        return found.value

    def columns(self) -> dict[str, Floats]:
        m = self.motion
        return {
            "time [s]": m.time,
            "displacement [m]": m.position,
            "velocity [m/s]": m.velocity,
            "height [m]": m.height,
        }

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [
            Row("speed", self.speed, "velocity", _("mean speed of transport")),
            Row("displacement", self.motion.displacement, "length"),
            Row("throw_number", self.throw_number),
        ]
        if math.isfinite(self.needed_friction):
            rows.append(Row("needed_friction", self.needed_friction))
        rows += [Row(mode, share, label=MODE_NAMES[mode], scale=PERCENT) for mode, share in self.shares.items()]
        kind = self._input_kind
        phases = [
            Row(
                f"{i}_{phase.mode}",
                self._input(phase.start),
                kind,
                f"{i} {translate(MODE_NAMES[phase.mode])}",
                end=self._input(phase.end),
            )
            for i, phase in enumerate(self.motion.phases, 1)
        ]
        remarks = (
            []
            if self.motion.repeats
            else [_("The motion does not repeat from cycle to cycle; the mean is that of many cycles.")]
        )
        if self.throw_number <= 1 and self.needed_friction <= self.conveyor.friction:
            remarks.append(_("The load stays at rest on the trough."))
        found = [Block("transport", "", rows, remarks)]
        return [*found, Block("phases", _("Phases of one cycle"), phases[:24])]

    @property
    def _input_kind(self) -> str:
        """The dimension of the input."""
        return "angle" if next(iter(self.conveyor.motion.positions.rotary.values())) else "length"

    def _input(self, time: float) -> float:
        """The input at a time of the cycle."""
        motion = self.conveyor.motion
        period = self.conveyor.trough.period
        ends = np.append(motion.time - motion.time[0], period)
        last = motion.input[-1] + (motion.input[-1] - motion.input[-2])
        return float(np.interp(time, ends, np.append(motion.input, last)))

    def steps(self, translate: Translate) -> list[Step]:
        trough, law, found = (
            self.conveyor.trough,
            Step("1", translate(_("Forces on the load, per mass"))),
            Step("2", translate(_("Phases of one cycle"))),
        )
        law.note(translate(_("Per mass of the load: normal force n, friction f that rest would need.")))
        law.law("n = a_n − g_n; f = a_t − g_t")
        law.note(f"{translate(MODE_NAMES['rest'])}:")
        law.law("|f| ≤ μ·n")
        law.note(translate(_("sliding")) + ":")
        law.law("s̈ = −f ∓ μ'·n")
        law.put("g_n", "", trough.gravity[1], "acceleration")
        law.put("Γ", "max(−a_n)/|g_n|", self.throw_number)
        if math.isfinite(self.needed_friction):
            law.put("μ_min", "max(|f|/n)", self.needed_friction)
        for phase in self.motion.phases[:24]:
            word = translate(MODE_NAMES[phase.mode])
            ends = " … ".join(shown(self._input(time), self._input_kind, 5) for time in (phase.start, phase.end))
            found.note(f"{ends}: {word}")
        found.put("Δs", "", self.motion.displacement, "length")
        found.put("v", "Δs/T", self.speed, "velocity", of={"T": (trough.period, "time")})
        if any(phase.mode == FLIGHT for phase in self.motion.phases):
            found.note(
                translate(
                    _("The load lands without bouncing; the blow of landing rubs as a force of its size would.")
                )
            )
        return [law, found]
