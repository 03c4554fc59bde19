"""Diameters of pins from what they carry: pressure, seat, shear, bending.

A pin is fixed in one link, the frame if that is on it, and the others turn on it, one next to the other. Formulas
after Roloff/Matek, Maschinenelemente, sections 9.2 and 9.3 (pins between plates, and pins held at one end).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from linkwright.equations.steps import Step
from linkwright.sizing.allowed import PIN
from linkwright.sizing.peaks import Largest
from linkwright.sizing.preferred import PINS, ROUNDING, at_least
from linkwright.words import Message, Translate, _, pgettext

#: What the diameter of a pin follows from.
PIN_CRITERIA: Mapping[str, Message] = {
    "pressure": pgettext("sizing", "pressure"),
    "seat": pgettext("sizing", "pressure at the edge of the seat"),
    "shear": pgettext("sizing", "shear"),
    "bending": pgettext("sizing", "bending"),
    "proportion": pgettext("sizing", "half of the plate"),
}


@dataclass(frozen=True, eq=False)
class OnPin:
    """A link on a pin: its largest force, N, the ``thickness`` of its plate, m, whether it ``turns`` on the pin, and
    the pressure, Pa, that is allowed there."""

    link: str
    peak: Largest
    thickness: float
    turns: bool
    limit: float

    @property
    def force(self) -> float:
        """Its largest force, N."""
        return self.peak.value

    @property
    def diameter(self) -> float:
        """The diameter at which the pressure is the allowed one, m."""
        return self.force / (self.thickness * self.limit)


@dataclass(frozen=True)
class Seat:
    """Where a pin is fixed: the link, the thickness of its plate, m, and the pressure, Pa, that is allowed there."""

    link: str
    thickness: float
    limit: float


@dataclass(frozen=True, eq=False)
class PinLoad:
    """What a pin carries that is fixed in its ``seat``.

    ``links``: the others, the one with the smallest force first, as if it were next to the seat: any other order
    bends the pin less; ``washer``: thickness between two plates, m; ``both``: whether it is held on both sides of
    them; ``safety`` factor against yield.
    """

    name: str
    seat: Seat
    links: tuple[OnPin, ...]
    washer: float
    both: bool
    safety: float

    @property
    def force(self) -> float:
        """The sum of the largest forces, N: no less than the resultant."""
        return sum(each.force for each in self.links)

    @property
    def planes(self) -> int:
        """In how many sections the pin is sheared: two where one link runs between two supports."""
        return 2 if self.both and len(self.links) == 1 else 1

    @cached_property
    def arms(self) -> tuple[float, ...]:
        """Distances of the middles of the plates from the face of the seat, m."""
        found, face = [], 0.0
        for each in self.links:
            found.append(face + self.washer + 0.5 * each.thickness)
            face += self.washer + each.thickness
        return tuple(found)

    @property
    def span(self) -> float:
        """Distance of the middles of both supports, m."""
        return sum(self.washer + each.thickness for each in self.links) + self.washer + self.seat.thickness

    @property
    def moment(self) -> float:
        """The largest bending moment, N·m: at the face of the seat, or between two supports with all force in the
        middle."""
        if self.both:
            return 0.25 * self.force * self.span
        return sum(each.force * arm for each, arm in zip(self.links, self.arms, strict=True))

    @property
    def pressed(self) -> OnPin:
        """The link that asks for the largest diameter by its pressure."""
        return max(self.links, key=lambda each: each.diameter)

    @property
    def edge_force(self) -> float:
        """Pressure at the edge of the seat times the diameter, N/m: F·(6 l + 4 s)/s² of a pin held at one end by a
        seat of length s, with the force F at the distance l from it; F/(2 s) of one held at both."""
        seat = self.seat.thickness
        if self.both:
            return self.force / (self.planes * seat)
        return (6.0 * self.moment + 4.0 * self.force * seat) / seat**2

    @property
    def stress(self) -> float:
        """Allowed bending stress of the pin, Pa."""
        return PIN.strength / self.safety

    @property
    def shear(self) -> float:
        """Allowed shear stress of the pin, Pa: 1/√3 of the normal one (von Mises)."""
        return self.stress / math.sqrt(3.0)

    def needs(self) -> dict[str, float]:
        """The diameters, m, that the criteria ask for."""
        return {
            "pressure": self.pressed.diameter,
            "bending": (32.0 * self.moment / (math.pi * self.stress)) ** (1.0 / 3.0),
            "shear": math.sqrt(4.0 * self.force / (self.planes * math.pi * self.shear)),
            "seat": self.edge_force / self.seat.limit,
            "proportion": 0.5 * min(self.seat.thickness, *(each.thickness for each in self.links)),
        }


@dataclass(frozen=True, eq=False)
class PinSize:
    """A pin with its ``diameter``, m; ``given``: whether the file gives it; ``needs``: diameters by criterion, m."""

    load: PinLoad
    needs: Mapping[str, float]
    diameter: float
    given: bool

    @classmethod
    def of(cls, load: PinLoad, given: float | None) -> PinSize:
        """The size of a pin."""
        needs = load.needs()
        return cls(load, needs, given or at_least(max(needs.values()), PINS), given is not None)

    @property
    def criterion(self) -> str:
        """The criterion that asks for the largest diameter."""
        return max(self.needs, key=self.needs.__getitem__)

    @property
    def pressure(self) -> float:
        """Pressure of the link that asks for the largest diameter by it, Pa."""
        link = self.load.pressed
        return link.force / (self.diameter * link.thickness)

    @property
    def suffices(self) -> bool:
        """Whether the diameter meets all criteria of strength."""
        asked = max(each for name, each in self.needs.items() if name != "proportion")
        return self.diameter >= asked * (1.0 - ROUNDING)

    def step(self, number: str, translate: Translate) -> Step:
        """The way to the diameter."""
        load = self.load
        step = Step(number, translate(_("Pin {pin}, fixed in {link}", pin=load.name, link=load.seat.link)))
        self._put_pressure(step, translate)
        self._put_bending(step, translate)
        two = load.planes == 2
        step.note(translate(_("Shear in two sections") if two else _("Shear in one section")))
        step.put("τ_max", "σ_max/√3", load.shear, "pressure")
        step.put("n", "", float(load.planes))
        step.put("d_3", "√(4·F_Σ/(n·π·τ_max))", self.needs["shear"], "length")
        self._put_seat(step, translate)
        step.note(translate(_("At least half of the thinnest plate; then the next preferred diameter")))
        step.put("d_5", "", self.needs["proportion"], "length")
        step.put("d", "", self.diameter, "length")
        step.put("p", "F/(d·t)", self.pressure, "pressure")
        return step

    def _put_pressure(self, step: Step, translate: Translate) -> None:
        link = self.load.pressed
        if link.turns:
            text = _("Pressure of {link}, which turns on the pin{at}", link=link.link, at=link.peak.at)
        else:
            text = _("Pressure of {link}, which does not turn on the pin{at}", link=link.link, at=link.peak.at)
        step.note(translate(text))
        step.put("F", "", link.force, "force")
        step.put("t", "", link.thickness, "length")
        step.put("p_max", "", link.limit, "pressure")
        step.put("d_1", "F/(t·p_max)", self.needs["pressure"], "length")

    def _put_bending(self, step: Step, translate: Translate) -> None:
        load = self.load
        if load.both:
            step.note(translate(_("Bending between two supports, with all force in the middle")))
        else:
            step.note(translate(_("Bending at the face of the seat, the largest forces farthest from it")))
        forces = {f"F_{k}": (each.force, "force") for k, each in enumerate(load.links, 1)}
        step.put("F_Σ", " + ".join(forces), load.force, "force", of=forces)
        if load.both:
            step.put("L", "", load.span, "length")
            step.put("M", "F_Σ·L/4", load.moment, "torque")
        else:
            arms = {f"l_{k}": (arm, "length") for k, arm in enumerate(load.arms, 1)}
            terms = " + ".join(f"{force}·{arm}" for force, arm in zip(forces, arms, strict=True))
            step.put("M", terms, load.moment, "torque", of={**forces, **arms})
        step.put("σ_max", "", load.stress, "pressure")
        step.put("d_2", "(32·M/(π·σ_max))^(1/3)", self.needs["bending"], "length")

    def _put_seat(self, step: Step, translate: Translate) -> None:
        load = self.load
        step.note(translate(_("Pressure at the edge of the seat in {link}", link=load.seat.link)))
        step.put("s", "", load.seat.thickness, "length")
        step.put("p_s", "", load.seat.limit, "pressure")
        formula = "F_Σ/(n·s·p_s)" if load.both else "(6·M + 4·F_Σ·s)/(s^2·p_s)"
        step.put("d_4", formula, self.needs["seat"], "length")
