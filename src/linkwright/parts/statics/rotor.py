"""A rigid rotor: counterweights in one plane (static balancing) or in two (dynamic balancing)."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantity, file_key
from linkwright.fields.tables import Named, Table
from linkwright.parts.base import Problem, Result, signed
from linkwright.words import Message, Translate, _

#: What is left of the unbalances of a rotor that is balanced, as share of their sizes.
ROUNDING = 1e-12
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "unbalance": _("unbalance U = Σ m·r"),
    "counterweight": _("counterweight m_b"),
    "mass_radius_arm": _("Σ m·r·z about the plane"),
    "direction": _("direction of U"),
    "seat": _("angle of the counterweight θ_b"),
    "rotating_force": _("rotating force without it ω²·U"),
    "rotating_couple": _("rotating couple ω²·Σ m·r·z"),
}


@dataclass(frozen=True)
class HeavyPoint:
    """A ``mass`` (kg) whose centre lies ``at`` a place along the shaft (m), at ``radius`` (m) and ``angle`` (rad)."""

    mass: float = file_key(Quantity("mass", above=0.0, doc="mass"))
    radius: float = file_key(Quantity("length", above=0.0, doc="distance of its centre from the axis"))
    angle: float = file_key(Quantity("angle", doc="angle of its centre about the axis"))
    at: float = file_key(Quantity("length", doc="its place along the shaft"), 0.0)

    @property
    def product(self) -> complex:
        """Mass times radius with its direction, kg·m."""
        return cmath.rect(self.mass * self.radius, self.angle)


@dataclass(frozen=True)
class BalancingPlane:
    """A plane ``at`` a place along the shaft (m), with counterweights at a ``radius`` (m)."""

    radius: float = file_key(Quantity("length", above=0.0, doc="radius at which the counterweight sits"))
    at: float = file_key(Quantity("length", doc="its place along the shaft"), 0.0)


@dataclass(frozen=True)
class Rotor(Problem):
    """``masses`` off the axis of a rotor, balanced in one or two ``planes``; with a ``speed`` (rad/s) also forces."""

    kind: ClassVar[str] = "rotor"
    masses: Mapping[str, HeavyPoint] = file_key(
        Named(
            Table.of(HeavyPoint),
            _("mass"),
            doc="masses by name: {mass: 10 kg, radius: 400 mm, angle: 120 deg, at: 0 mm}",
        )
    )
    planes: Mapping[str, BalancingPlane] = file_key(
        Named(
            Table.of(BalancingPlane),
            _("plane"),
            doc="one or two planes of counterweights by name: {at: 0 mm, radius: 500 mm}",
        )
    )
    speed: float = file_key(Quantity("angular_velocity", minimum=0.0, doc="speed, for the forces"), 0.0)
    name: str = ""
    source: str = ""

    def findings(self) -> list[Finding]:
        found = (
            []
            if self.masses
            else [
                fault(
                    "rotor_masses",
                    "masses",
                    _("the rotor has no mass off its axis"),
                    _("write masses: {{m1: {{mass: 10 kg, radius: 400 mm, angle: 120 deg, at: 0 mm}}}}"),
                )
            ]
        )
        places = [plane.at for plane in self.planes.values()]
        if len(places) not in (1, 2):
            found.append(
                fault(
                    "rotor_planes",
                    "planes",
                    _("{count} planes are given for the counterweights"),
                    _("give one (static balancing) or two (dynamic balancing)"),
                    count=len(places),
                )
            )
        elif len(set(places)) < len(places):
            found.append(
                fault(
                    "rotor_place",
                    f"planes.{list(self.planes)[1]}.at",
                    _("both planes lie at the same place along the shaft"),
                    _("give them different places at:, or one plane alone"),
                )
            )
        return found

    def solve(self) -> RotorBalance:
        """The counterweights. Raises ModelError with all findings."""
        self.require()
        return RotorBalance(self)


@dataclass(frozen=True, repr=False)
class RotorBalance(Result):
    """Unbalances of the planes and the counterweights against them; ``left``: what one plane cannot balance."""

    labels: ClassVar[Mapping[str, Message]] = LABELS
    rotor: Rotor

    def share(self, plane: str, at: float) -> float:
        """How much of a mass at a place along the shaft a plane carries."""
        others = [each.at for name, each in self.rotor.planes.items() if name != plane]
        return (others[0] - at) / (others[0] - self.rotor.planes[plane].at) if others else 1.0

    @cached_property
    def unbalances(self) -> dict[str, complex]:
        """Sum of m r of all masses as each plane carries it, kg·m."""
        masses = self.rotor.masses.values()
        return {
            name: self._rounded(sum(each.product * self.share(name, each.at) for each in masses))
            for name in self.rotor.planes
        }

    def _rounded(self, value: complex, arm: float = 1.0) -> complex:
        size = max(abs(each.product) for each in self.rotor.masses.values())
        return 0j if abs(value) <= ROUNDING * size * arm else value

    @cached_property
    def counterweights(self) -> dict[str, complex]:
        """Their masses, kg, with the directions in which they sit."""
        return {name: -each / self.rotor.planes[name].radius for name, each in self.unbalances.items()}

    @cached_property
    def left(self) -> complex:
        """Sum of m r z about the only plane, kg·m²: its couple ω² times that stays; zero with two planes."""
        if len(self.rotor.planes) == 2:
            return 0j
        (plane,) = self.rotor.planes.values()
        arms = [each.at - plane.at for each in self.rotor.masses.values()]
        moment = sum(each.product * arm for each, arm in zip(self.rotor.masses.values(), arms, strict=True))
        return self._rounded(moment, max(map(abs, arms)))

    def blocks(self, translate: Translate) -> list[Block]:
        blocks = []
        for name, unbalance in self.unbalances.items():
            weight = self.counterweights[name]
            rows = [Row("unbalance", abs(unbalance), "mass_radius"), Row("counterweight", abs(weight), "mass")]
            if unbalance:
                rows.insert(1, Row("direction", _angle(unbalance), "angle"))
                rows.append(Row("seat", _angle(weight), "angle"))
            if self.rotor.speed:
                rows.append(Row("rotating_force", abs(unbalance) * self.rotor.speed**2, "force"))
            blocks.append(Block(f"plane {name}", _("Plane {name}", name=name), rows))
        if self.left:
            rows = [Row("mass_radius_arm", abs(self.left), "inertia")]
            if self.rotor.speed:
                rows.append(Row("rotating_couple", abs(self.left) * self.rotor.speed**2, "torque"))
            blocks.append(
                Block(
                    "left",
                    _("Remaining: the couple of masses outside the plane"),
                    rows,
                    [_("One plane balances statically; two planes take the couple too.")],
                )
            )
        return blocks

    def steps(self, translate: Translate) -> list[Step]:
        found = []
        for count, (name, unbalance) in enumerate(self.unbalances.items(), 1):
            step = Step(str(count), translate(_("Plane {name}", name=name)))
            if len(self.unbalances) > 1:
                step.note(
                    translate(
                        _(
                            "Every mass is replaced by parts in both planes; z is its place, z0 that of the "
                            "plane, z' that of the other plane:"
                        )
                    )
                )
                step.law("k = (z' − z)/(z' − z0)")
            for mass, each in self.rotor.masses.items():
                share = self.share(name, each.at) + 0.0  # no -0
                step.known |= {"m": (each.mass, "mass"), "r": (each.radius, "length"), "k": share}
                step.put(
                    f"(m·r)_{mass}",
                    "m·r·k" if len(self.unbalances) > 1 else "m·r",
                    each.mass * each.radius * share,
                    "mass_radius",
                )
            shares = [each.product * self.share(name, each.at) for each in self.rotor.masses.values()]
            for axis, of, parts in (
                ("x", "cos", [each.real for each in shares]),
                ("y", "sin", [each.imag for each in shares]),
            ):
                total = unbalance.real if axis == "x" else unbalance.imag
                step.put(
                    f"U{axis}",
                    f"Σ m·r·{'k·' if len(self.unbalances) > 1 else ''}{of} θ",
                    total,
                    "mass_radius",
                    numbers=signed(parts),
                )
            step.put("U", "√(Ux² + Uy²)", abs(unbalance), "mass_radius")
            radius = self.rotor.planes[name].radius
            step.put("m_b", "U/r_b", abs(self.counterweights[name]), "mass", of={"r_b": (radius, "length")})
            if unbalance:
                plain = {"Ux": unbalance.real, "Uy": unbalance.imag}
                step.put("θ_b", "atan2(−Uy, −Ux)", _angle(self.counterweights[name]), "angle", of=plain)
            found.append(step)
        return found


def _angle(value: complex) -> float:
    """Direction from 0 to a turn, rad."""
    return cmath.phase(value) % (2.0 * cmath.pi)
