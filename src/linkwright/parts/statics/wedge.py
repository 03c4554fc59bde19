"""A wedge under a guided load: the push that raises it, the pull or push that lowers it, self-locking."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.rows import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantity, file_key
from linkwright.parts.base import Problem, Result
from linkwright.words import Message, Translate, _, pgettext

#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "raising": _("push that raises the load"),
    "lowering": _("push that lets it sink"),
    "efficiency": pgettext("statics", "efficiency"),
}


@dataclass(frozen=True)
class Wedge(Problem):
    """A wedge of ``angle`` (rad) pushed on a level floor lifts a ``load`` (N) that a vertical wall guides.

    ``friction``: coefficient on the slope; ``floor`` and ``wall``: on the floor and on the wall, the same as on the
    slope unless given.
    """

    kind: ClassVar[str] = "wedge"
    load: float = file_key(Quantity("force", above=0.0, doc="load to be raised"))
    angle: float = file_key(Quantity("angle", above=0.0, doc="angle of the wedge"))
    friction: float = file_key(Quantity("dimensionless", minimum=0.0, doc="coefficient of friction on the slope"))
    floor: float | None = file_key(
        Quantity("dimensionless", minimum=0.0, doc="on the floor; default: as on the slope"), None
    )
    wall: float | None = file_key(
        Quantity("dimensionless", minimum=0.0, doc="on the guiding wall; default: as on the slope"), None
    )
    name: str = ""
    source: str = ""

    @property
    def friction_angles(self) -> tuple[float, float, float]:
        """ρ on slope, floor and wall, rad."""
        coefficients = (self.friction, self.floor, self.wall)
        return tuple(math.atan(self.friction if c is None else c) for c in coefficients)  # type: ignore[return-value]

    def push(self, sense: int = 1, load: float | None = None) -> float:
        """Push on the wedge (N) while the load rises (``sense`` 1) or sinks (-1).

        R = Q cos ρw/cos(α + ρ + ρw), P = R sin(α + ρ + ρf)/cos ρf; for sinking the friction angles are
        negative, and where α < ρ the wedge that is pulled out takes the load to the other side of its guide, whose
        friction holds the load as well: ``R = Q cos ρw/cos(|α - ρ| - ρw)``.
        """
        slope, floor, _unused = (sense * angle for angle in self.friction_angles)
        return self.between(sense, load) * math.sin(self.angle + slope + floor) / math.cos(floor)

    def between(self, sense: int = 1, load: float | None = None) -> float:
        """Force R on the slope between wedge and load (N), as in :meth:`push`."""
        slope, _unused, wall = (sense * angle for angle in self.friction_angles)
        wall = math.copysign(wall, sense * (self.angle + slope))
        return (self.load if load is None else load) * math.cos(wall) / math.cos(self.angle + slope + wall)

    def findings(self) -> list[Finding]:
        if self.angle >= math.pi / 2:
            return [
                fault("wedge_angle", "angle", _("a wedge of 90° or more lifts nothing"), _("give an angle below 90°"))
            ]
        slope, _unused, wall = self.friction_angles
        if self.angle + slope + wall >= math.pi / 2:
            return [
                fault(
                    "wedge_stuck",
                    "friction",
                    _("no push raises the load: α + ρ + ρw = {sum}° reaches 90°"),
                    _("take a smaller angle or less friction"),
                    sum=math.degrees(self.angle + slope + wall),
                )
            ]
        return []

    def solve(self) -> WedgeForces:
        """The forces. Raises ModelError with all findings."""
        self.require()
        return WedgeForces(self)


@dataclass(frozen=True, repr=False)
class WedgeForces(Result):
    """``raising`` and ``lowering`` push on the wedge, N; a negative one is a pull: the wedge locks itself."""

    labels: ClassVar[Mapping[str, Message]] = LABELS
    wedge: Wedge

    @property
    def raising(self) -> float:
        """Push that raises the load, N."""
        return self.wedge.push(1)

    @property
    def lowering(self) -> float:
        """Push that just lets the load sink, N."""
        return self.wedge.push(-1)

    @property
    def efficiency(self) -> float:
        """Useful work over work of the push: Q tan α/P."""
        return self.wedge.load * math.tan(self.wedge.angle) / self.raising

    @property
    def locks(self) -> bool:
        """Whether the load cannot drive the wedge out: α ≤ ρ slope + ρ floor."""
        return self.lowering <= 0.0

    def columns(self) -> dict[str, Floats]:
        """Push over the wedge's angle."""
        slope, _unused, wall = self.wedge.friction_angles
        angles = np.linspace(0.0, min(2 * self.wedge.angle, 0.98 * (math.pi / 2 - slope - wall)), 181)
        wedges = [Wedge(self.wedge.load, a, self.wedge.friction, self.wedge.floor, self.wedge.wall) for a in angles]
        return {
            "angle [rad]": angles,
            "raising [N]": np.array([each.push(1) for each in wedges]),
            "lowering [N]": np.array([each.push(-1) for each in wedges]),
        }

    def blocks(self, say: Translate) -> list[Block]:
        rows = [
            Row("raising", self.raising, "force"),
            Row("lowering", self.lowering, "force"),
            Row("efficiency", self.efficiency),
        ]
        return [
            Block(
                "wedge",
                "",
                rows,
                [
                    _("The wedge locks itself: it must be pulled out.")
                    if self.locks
                    else _("The wedge does not lock: the load drives it out unless it is held.")
                ],
            )
        ]

    def steps(self, say: Translate) -> list[Step]:
        step = Step("1", say(_("Force polygons of load and wedge")))
        step.known |= {"Q": (self.wedge.load, "force"), "α": (self.wedge.angle, "angle")}
        for index, angle in zip(("", "f", "w"), self.wedge.friction_angles, strict=True):
            step.put(f"ρ{index}", f"arctan μ{index}", angle, "angle", of={f"μ{index}": math.tan(angle)})
        step.say(say(_("Raising: friction acts against the way up.")))
        step.put("R", "Q·cos ρw/cos(α + ρ + ρw)", self.wedge.between(1), "force")
        step.put("P_up", "R·sin(α + ρ + ρf)/cos ρf", self.raising, "force")
        step.say(say(_("Lowering: all friction angles change their signs.")))
        step.put("R", "Q·cos ρw/cos(|α − ρ| − ρw)", self.wedge.between(-1), "force")
        step.put("P_down", "R·sin(α − ρ − ρf)/cos ρf", self.lowering, "force")
        step.put("η", "Q·tan α/P_up", self.efficiency)
        step.say(
            say(
                _("The wedge locks itself: it must be pulled out.")
                if self.locks
                else _("The wedge does not lock: the load drives it out unless it is held.")
            )
        )
        return [step]
