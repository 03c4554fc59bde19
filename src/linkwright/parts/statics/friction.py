"""Belts, ropes and band brakes about a drum, and wedges under a guided load, at the limit of slipping."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantity, file_key
from linkwright.parts.base import Problem, Result
from linkwright.words import Message, Translate, _, pgettext

#: Largest μ θ: e^(μθ) stays a number, with all of its digits.
GRIP = 300.0
#: What the numbers are called.
BELT_LABELS: Mapping[str, Message] = {
    "tight": _("tight side T1"),
    "slack": _("slack side T2"),
    "pull": _("T1 − T2"),
    "ratio": _("ratio of tensions e^(μθ)"),
    "torque": pgettext("statics", "torque"),
    "power": _("power"),
}


@dataclass(frozen=True)
class Belt(Problem):
    """``friction`` μ over the angle ``wrap`` (rad); ``groove`` the full angle of a V groove (rad).

    One of: the ``tight`` side's tension (N), the ``slack`` side's (N), the ``torque`` (N·m) on the drum of
    ``radius`` (m). With ``mass`` per length (kg/m) and ``speed`` (m/s) the centrifugal tension m v² is taken off.
    """

    kind: ClassVar[str] = "belt"
    friction: float = file_key(Quantity("dimensionless", above=0.0, doc="coefficient of friction"))
    wrap: float = file_key(Quantity("angle", above=0.0, doc="angle of contact; several turns are allowed"))
    groove: float | None = file_key(
        Quantity("angle", above=0.0, doc="full angle of a V groove; a flat belt unless given"), None
    )
    tight: float | None = file_key(Quantity("force", above=0.0, doc="tension of the tight side"), None)
    slack: float | None = file_key(Quantity("force", above=0.0, doc="tension of the slack side"), None)
    torque: float | None = file_key(Quantity("torque", above=0.0, doc="torque on the drum"), None)
    radius: float | None = file_key(Quantity("length", above=0.0, doc="radius of the drum"), None)
    mass: float = file_key(Quantity("linear_density", minimum=0.0, doc="mass per length"), 0.0)
    speed: float = file_key(Quantity("velocity", minimum=0.0, doc="belt speed"), 0.0)
    name: str = ""
    source: str = ""

    @property
    def effective_friction(self) -> float:
        """μ, in a V groove μ/sin(α/2)."""
        return self.friction if self.groove is None else self.friction / math.sin(self.groove / 2)

    @property
    def ratio(self) -> float:
        """Euler and Eytelwein: (T1 − m v²)/(T2 − m v²) = e^(μ θ)."""
        return math.exp(self.effective_friction * self.wrap)

    @property
    def centrifugal(self) -> float:
        """m v², N."""
        return self.mass * self.speed**2

    def findings(self) -> list[Finding]:
        found = []
        names = [name for name in ("tight", "slack", "torque") if getattr(self, name) is not None]
        if len(names) != 1:
            found.append(
                fault(
                    "belt_choice",
                    names[1] if names else "",
                    _("{count} of tight, slack and torque are given"),
                    pgettext("statics", "give exactly one of them"),
                    count=len(names),
                )
            )
        if self.torque is not None and self.radius is None:
            found.append(
                fault(
                    "belt_radius",
                    "radius",
                    _("a torque alone does not tell the forces"),
                    _("give the radius of the drum"),
                )
            )
        if self.groove is not None and self.groove >= math.pi:
            found.append(
                fault(
                    "groove",
                    "groove",
                    _("a groove must be narrower than 180°"),
                    _("leave it out for a flat belt, or give an angle such as 38 deg"),
                )
            )
        if not found and self.effective_friction * self.wrap > GRIP:
            found.append(
                fault(
                    "belt_grip",
                    "wrap",
                    _("the belt is wound so often that e^(μθ) is beyond all bounds"),
                    _("give an angle of contact below {most}°"),
                    most=math.degrees(GRIP / self.effective_friction),
                )
            )
        for side in ("tight", "slack"):
            tension = getattr(self, side)
            if tension is not None and tension <= self.centrifugal:
                found.append(
                    fault(
                        "flung_off",
                        side,
                        _("the tension {tension} N does not exceed the centrifugal tension m·v² = {flung} N"),
                        _("a belt as fast as this leaves the drum: give more tension or less speed"),
                        tension=tension,
                        flung=self.centrifugal,
                    )
                )
        return found

    def solve(self) -> BeltTensions:
        """The tensions. Raises ModelError with all findings."""
        self.require()
        flung, e = self.centrifugal, self.ratio
        if self.tight is not None:
            slack = (self.tight - flung) / e + flung
            return BeltTensions(self, self.tight, slack)
        if self.slack is not None:
            return BeltTensions(self, (self.slack - flung) * e + flung, self.slack)
        pull = (self.torque or 0.0) / (self.radius or 1.0)
        grip = self.effective_friction * self.wrap
        return BeltTensions(self, flung - pull / math.expm1(-grip), flung + pull / math.expm1(grip))


@dataclass(frozen=True, repr=False)
class BeltTensions(Result):
    """Tensions ``tight`` T1 and ``slack`` T2, N, at the limit of slipping."""

    labels: ClassVar[Mapping[str, Message]] = BELT_LABELS
    belt: Belt
    tight: float
    slack: float

    @property
    def pull(self) -> float:
        """T1 − T2, the largest force that friction passes on, N."""
        return self.tight - self.slack

    def columns(self) -> dict[str, Floats]:
        """Tension along the contact, from the slack side."""
        angle = np.linspace(0.0, self.belt.wrap, 181)
        flung = self.belt.centrifugal
        tension = (self.slack - flung) * np.exp(self.belt.effective_friction * angle) + flung
        return {"angle [rad]": angle, "tension [N]": tension}

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [
            Row("tight", self.tight, "force"),
            Row("slack", self.slack, "force"),
            Row("pull", self.pull, "force"),
            Row("ratio", self.belt.ratio),
        ]
        if self.belt.radius:
            rows.append(Row("torque", self.pull * self.belt.radius, "torque"))
        if self.belt.speed:
            rows.append(Row("power", self.pull * self.belt.speed, "power"))
        return [Block("belt", "", rows)]

    def steps(self, translate: Translate) -> list[Step]:
        belt, step = self.belt, Step("1", translate(_("Belt friction (Euler, Eytelwein)")))
        mu = "μ" if belt.groove is None else "μ'"
        if belt.groove is not None:
            step.known |= {"μ": belt.friction, "α": (belt.groove, "angle")}
            step.put("μ'", "μ/sin(α/2)", belt.effective_friction)
        step.put("q", f"e^({mu}·θ)", belt.ratio, of={mu: belt.effective_friction, "θ": belt.wrap})
        step.known |= {"r": (belt.radius or 0.0, "length"), "v": (belt.speed, "velocity")}
        if belt.centrifugal:
            step.put("Tc", "m·v²", belt.centrifugal, "force", of={"m": (belt.mass, "linear_density")})
        self._tensions(step)
        step.known |= {"T1": (self.tight, "force"), "T2": (self.slack, "force")}
        if belt.torque is None:
            step.put("F", "T1 − T2", self.pull, "force")
        if belt.radius is not None and belt.torque is None:
            step.put("M", "F·r", self.pull * belt.radius, "torque")
        if belt.speed:
            step.put("P", "F·v", self.pull * belt.speed, "power")
        return [step]

    def _tensions(self, step: Step) -> None:
        """The two tensions from what is given: one of them, or the torque."""
        belt, flung = self.belt, "Tc + " if self.belt.centrifugal else ""
        above = ("(", " − Tc)") if flung else ("", "")
        if belt.tight is not None:
            known = {"T1": (self.tight, "force")}
            step.put("T2", f"{flung}{above[0]}T1{above[1]}/q", self.slack, "force", of=known)
        elif belt.slack is not None:
            known = {"T2": (self.slack, "force")}
            step.put("T1", f"{flung}{above[0]}T2{above[1]}·q", self.tight, "force", of=known)
        else:
            step.put("F", "M/r", self.pull, "force", of={"M": (belt.torque or 0.0, "torque")})
            step.put("T1", f"{flung}F·q/(q − 1)", self.tight, "force")
            step.put("T2", f"{flung}F/(q − 1)", self.slack, "force")


#: What the numbers are called.
WEDGE_LABELS: Mapping[str, Message] = {
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

    labels: ClassVar[Mapping[str, Message]] = WEDGE_LABELS
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

    def blocks(self, translate: Translate) -> list[Block]:
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

    def steps(self, translate: Translate) -> list[Step]:
        step = Step("1", translate(_("Force polygons of load and wedge")))
        step.known |= {"Q": (self.wedge.load, "force"), "α": (self.wedge.angle, "angle")}
        for index, angle in zip(("", "f", "w"), self.wedge.friction_angles, strict=True):
            step.put(f"ρ{index}", f"arctan μ{index}", angle, "angle", of={f"μ{index}": math.tan(angle)})
        step.note(translate(_("Raising: friction acts against the way up.")))
        step.put("R", "Q·cos ρw/cos(α + ρ + ρw)", self.wedge.between(1), "force")
        step.put("P_up", "R·sin(α + ρ + ρf)/cos ρf", self.raising, "force")
        step.note(translate(_("Lowering: all friction angles change their signs.")))
        step.put("R", "Q·cos ρw/cos(|α − ρ| − ρw)", self.wedge.between(-1), "force")
        step.put("P_down", "R·sin(α − ρ − ρf)/cos ρf", self.lowering, "force")
        step.put("η", "Q·tan α/P_up", self.efficiency)
        step.note(
            translate(
                _("The wedge locks itself: it must be pulled out.")
                if self.locks
                else _("The wedge does not lock: the load drives it out unless it is held.")
            )
        )
        return [step]
