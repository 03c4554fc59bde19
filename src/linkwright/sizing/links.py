"""Widths of links from what they carry: eyes, stress, buckling."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.equations.steps import Step
from linkwright.parts.beams.cut import LinkCut
from linkwright.sizing.allowed import Allowed
from linkwright.sizing.peaks import Largest
from linkwright.sizing.preferred import WIDTHS, at_least
from linkwright.sizing.sections import (
    buckling_stress,
    eye_width,
    gross_width,
    limit_slenderness,
    net_stress,
    net_width,
    slenderness,
)
from linkwright.words import Message, Translate, _, pgettext

#: What the width of a link follows from.
LINK_CRITERIA: Mapping[str, Message] = {
    "eye": pgettext("sizing", "eye"),
    "stress": pgettext("sizing", "stress"),
    "buckling": pgettext("sizing", "buckling"),
    "proportion": pgettext("sizing", "thickness"),
}
#: Slenderness of members that are only pulled, and of those that are pressed, should not be larger: AISC 360,
#: sections D1 and E2.
SLENDEREST_PULLED, SLENDEREST_PRESSED = 300.0, 200.0


@dataclass(frozen=True, eq=False)
class Section:
    """The cross section at which the stress asks for the largest width.

    ``normal`` N, positive in tension, ``moment`` N·m, at ``place`` m along the axis, with a hole of diameter ``bore``
    m there; ``at``: where in the cycle.
    """

    normal: float
    moment: float
    place: float
    bore: float
    at: str

    def width(self, thickness: float, stress: float) -> float:
        """The width that keeps the stress, m."""
        sizes = np.array([abs(self.normal)]), np.array([abs(self.moment)])
        if self.bore:
            return float(net_width(*sizes, self.bore, thickness, stress)[0])
        return float(gross_width(*sizes, thickness, stress)[0])

    def stress(self, width: float, thickness: float) -> float:
        """The stress at a width, Pa."""
        sizes = np.array([abs(self.normal)]), np.array([abs(self.moment)])
        return float(net_stress(*sizes, self.bore, np.array([width]), thickness)[0])


@dataclass(frozen=True, eq=False)
class LinkLoad:
    """What a link of a ``thickness`` (m) carries.

    ``eyes``: the largest force on every pin, N, with the diameter of its hole, m; ``length`` m: None of a link
    without one, with the worst ``section``, the largest ``compression``, N, and the largest ``moment``, N·m.
    """

    name: str
    thickness: float
    eyes: Mapping[str, tuple[Largest, float]]
    length: float | None = None
    section: Section | None = None
    compression: Largest | None = None
    moment: Largest | None = None

    @property
    def force(self) -> float:
        """The largest force on a pin, N."""
        return max((peak.value for peak, _bore in self.eyes.values()), default=0.0)

    @property
    def pressed(self) -> Largest | None:
        """The largest compression if it is more than rounding."""
        most = self.compression
        return most if most is not None and most.value > 1e-9 * max(self.force, 1e-300) else None

    @property
    def slenderest(self) -> float:
        """The largest slenderness that it should have."""
        return SLENDEREST_PULLED if self.pressed is None else SLENDEREST_PRESSED

    def worst_eye(self, allowed: Allowed) -> str:
        """The pin whose eye asks for the largest width."""
        return max(self.eyes, key=lambda name: self._eye(name, allowed))

    def _eye(self, pin: str, allowed: Allowed) -> float:
        peak, bore = self.eyes[pin]
        return eye_width(peak.value, bore, self.thickness, allowed.stress)

    def needs(self, allowed: Allowed) -> dict[str, float]:
        """The widths, m, that the criteria ask for."""
        found = {}
        if self.eyes:
            found["eye"] = self._eye(self.worst_eye(allowed), allowed)
        if self.section is not None:
            found["stress"] = self.section.width(self.thickness, allowed.stress)
        if (pressed := self.pressed) is not None:
            most = self._buckling_stress(self.thickness, allowed)
            found["buckling"] = pressed.value * allowed.buckling / (self.thickness * most)
        if found:
            found["proportion"] = self.thickness
        return found

    def _buckling_stress(self, smaller_side: float, allowed: Allowed) -> float:
        material = allowed.material
        return buckling_stress(slenderness(self.length or 0.0, smaller_side), material.strength, material.modulus)

    def safeties(self, width: float, allowed: Allowed) -> dict[str, float]:
        """Safety against yield, and against buckling divided by how much more is asked for there, at a width, m."""
        strength, found = allowed.material.strength, {}
        if self.eyes:
            peak, bore = self.eyes[self.worst_eye(allowed)]
            left = max(width - 7.0 * bore / 3.0, 0.0)
            found["eye"] = left * self.thickness * strength / max(peak.value, 1e-300)
        if self.section is not None:
            stress = self.section.stress(width, self.thickness) if width > self.section.bore else np.inf
            found["stress"] = strength / max(stress, 1e-300)
        if (pressed := self.pressed) is not None:
            most = self._buckling_stress(min(width, self.thickness), allowed) * width * self.thickness
            found["buckling"] = most / pressed.value * allowed.safety / allowed.buckling
        return found


def needed_widths(cut: LinkCut, bore: Floats, thickness: float, stress: float) -> Floats:
    """Widths (n, k), m, that the stress asks for at every position and station, with holes ``bore`` (k,) there."""
    normal, moment = np.abs(cut.normal), np.abs(cut.moment)
    found = gross_width(normal, moment, thickness, stress)
    at = np.flatnonzero(bore > 0.0)
    found[:, at] = net_width(normal[:, at], moment[:, at], bore[at], thickness, stress)
    return found


@dataclass(frozen=True, eq=False)
class LinkSize:
    """A link with its ``width``, m; ``given``: whether the file gives it; ``needs``: widths by criterion, m."""

    load: LinkLoad
    allowed: Allowed
    needs: Mapping[str, float]
    width: float
    given: bool
    safeties: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, load: LinkLoad, allowed: Allowed, given: float | None) -> LinkSize:
        """The size of a link that has any criteria."""
        needs = load.needs(allowed)
        width = given or at_least(max(needs.values()), WIDTHS)
        return cls(load, allowed, needs, width, given is not None, load.safeties(width, allowed))

    @property
    def criterion(self) -> str:
        """The criterion that asks for the largest width."""
        return max(self.needs, key=self.needs.__getitem__)

    @property
    def safety(self) -> float:
        """The smallest safety factor; that of buckling counts in proportion to what is asked for."""
        return min(self.safeties.values(), default=np.inf)

    @property
    def suffices(self) -> bool:
        """Whether the width meets all criteria."""
        return self.safety >= self.allowed.safety * (1.0 - 1e-9)

    def step(self, number: str, translate: Translate) -> Step:
        """The way to the width."""
        load, allowed = self.load, self.allowed
        step = Step(number, translate(_("Link {link}", link=load.name)))
        step.put("t", "", load.thickness, "length")
        step.put("σ_max", "", allowed.stress, "pressure")
        if load.eyes:
            self._put_eye(step, translate)
        if load.section is not None:
            self._put_stress(step, load.section, translate)
        if "buckling" in self.needs:
            self._put_buckling(step, translate)
        step.note(translate(_("Chosen as the next preferred width")))
        step.put("w", "", self.width, "length")
        return step

    def _put_eye(self, step: Step, translate: Translate) -> None:
        pin = self.load.worst_eye(self.allowed)
        peak, bore = self.load.eyes[pin]
        text = _("Eye around the pin {pin}{at}", pin=pin, at=peak.at)
        step.note(translate(text))
        step.put("F", "", peak.value, "force")
        step.put("d", "", bore, "length")
        step.put("w_1", "F/(t·σ_max) + 7·d/3", self.needs["eye"], "length")

    def _put_stress(self, step: Step, section: Section, translate: Translate) -> None:
        text = _("Normal force and bending moment in the section that asks for most{at}", at=section.at)
        step.note(translate(text))
        step.put("s", "", section.place, "length")
        step.put("N", "", abs(section.normal), "force")
        step.put("M", "", abs(section.moment), "torque")
        if section.bore:
            step.put("d_s", "", section.bore, "length")
            step.law("N/(t·(w_2 − d_s)) + 6·M·w_2/(t·(w_2^3 − d_s^3)) = σ_max")
            step.put("w_2", "", self.needs["stress"], "length")
        else:
            formula = "(N + √(N^2 + 24·M·t·σ_max))/(2·t·σ_max)"
            step.put("w_2", formula, self.needs["stress"], "length")

    def _put_buckling(self, step: Step, translate: Translate) -> None:
        load, allowed = self.load, self.allowed
        assert load.length is not None and load.compression is not None
        text = _(
            "Buckling under the largest compression{at}: out of the plane, where the plate is weaker than in it",
            at=load.compression.at,
        )
        step.note(translate(text))
        material, length = allowed.material, load.length
        ratio = slenderness(length, load.thickness)
        limit = limit_slenderness(material.strength, material.modulus)
        step.put("F_c", "", load.compression.value, "force")
        step.put("L", "", length, "length")
        step.put("E", "", material.modulus, "pressure")
        step.put("Re", "", material.strength, "pressure")
        step.put("λ", "√12·L/t", ratio)
        step.put("λ_1", "π·√(2·E/Re)", limit)
        most = buckling_stress(ratio, material.strength, material.modulus)
        step.put("σ_k", "π^2·E/λ^2" if ratio >= limit else "Re·(1 − Re·λ^2/(4·π^2·E))", most, "pressure")
        step.put("S_k", "", allowed.buckling)
        step.put("w_3", "F_c·S_k/(t·σ_k)", self.needs["buckling"], "length")
