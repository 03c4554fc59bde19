"""Bending of a mechanism's link under its joint forces, loads, weight and inertia, over the cycle."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from linkwright.analysis import Analysis
from linkwright.core.arguments import STEPS
from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, LinkwrightError, fault
from linkwright.fields.base import Quantity, Text, file_key
from linkwright.fields.tables import Integer, Listed
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Result
from linkwright.parts.beams.axis import LinkAxis, PointForce, SpreadMass
from linkwright.parts.beams.components import MATERIAL, Material, Section, require_modulus, section_field
from linkwright.parts.beams.cut import STRAIGHT, LinkCut, LinkLine
from linkwright.parts.beams.elastic import polynomial_text
from linkwright.parts.fields import MECHANISM, OfMechanism
from linkwright.words import Message, Translate, _

#: What is the largest over the cycle, with its dimension.
LARGEST = {
    "largest_moment": "torque",
    "largest_normal": "force",
    "largest_stress": "pressure",
    "largest_deflection": "length",
}
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "largest_moment": _("largest bending moment"),
    "largest_normal": _("largest normal force"),
    "largest_stress": _("largest stress |N|/A + |M|/W"),
    "largest_deflection": _("largest deflection, from the line between the ends"),
    "closure": _("gap of forces at the far end"),
    "safety": _("safety against the strength"),
    "needed_modulus": _("needed section modulus"),
}


@dataclass(frozen=True)
class LinkBending(OfMechanism):
    """The ``link`` of a ``mechanism`` with one ``section`` along its length; ``safety`` wanted at least.

    ``axis``: names of the points through which the link's axis runs, in their order; straight unless given.
    """

    kind: ClassVar[str] = "link_bending"
    mechanism: Mechanism = file_key(MECHANISM)
    link: str = file_key(Text(doc="name of the link"))
    material: Material = file_key(MATERIAL)
    section: Section = file_key(section_field("cross section, bent in the plane of the mechanism"))
    safety: float = file_key(
        Quantity("dimensionless", above=0.0, doc="safety against the strength, for the needed section"), 1.0
    )
    steps: int = file_key(Integer(1, doc="positions over the cycle; default: 360"), STEPS)
    axis: tuple[str, ...] = file_key(
        Listed(Text(), "[A, B, C]", doc="points through which a bent link's axis runs; default: straight"), ()
    )
    name: str = ""
    source: str = ""

    def findings(self) -> list[Finding]:
        links = self.mechanism.links
        if self.link not in links:
            return [
                fault(
                    "no_link",
                    "link",
                    _('there is no link "{link}" in {mechanism}'),
                    _("one of: {links}"),
                    link=self.link,
                    mechanism=self.mechanism.name,
                    links=", ".join(links),
                )
            ]
        link = links[self.link]
        if len(link.points) < 2:
            return [
                fault(
                    "one_point",
                    "link",
                    _("the link {link} has no length: it has one point"),
                    _("choose a link with two points or more"),
                    link=self.link,
                )
            ]
        strange = [name for name in self.axis if name not in link.points]
        if strange or len(set(self.axis)) < len(self.axis) or len(self.axis) == 1:
            known = ", ".join(link.points)
            return [
                fault(
                    "axis",
                    "axis",
                    _("the axis of {link} cannot run through {names}"),
                    _("name two or more of its points, each once, in their order: {known}"),
                    link=self.link,
                    names=", ".join(strange or self.axis),
                    known=known,
                )
            ]
        found = require_modulus(self.section)
        off = self._off_axis(link)
        if off:
            found.append(
                fault(
                    "crooked",
                    "link",
                    _("the points or the mass centre of {link} do not lie on its axis ({names})"),
                    _("name the points through which it runs: axis: [A, B, C]"),
                    link=self.link,
                    names=", ".join(off),
                )
            )
        elif SpreadMass(self.link_axis, link).gap > STRAIGHT:
            found.append(
                fault(
                    "mass_off",
                    "link",
                    _("mass, centre and inertia of {link} cannot lie along its axis"),
                    _("correct them, or lay the axis through more points: axis: [A, B, C]"),
                    link=self.link,
                )
            )
        return found

    @property
    def link_axis(self) -> LinkAxis:
        """The axis along which the link is cut."""
        return LinkAxis.of(self.mechanism.links[self.link], self.axis)

    def _off_axis(self, link: Link) -> list[str]:
        """Names of points, and of the mass centre of a straight link with mass, that do not lie on the axis."""
        places = {**link.points, **({"mass_centre": link.centre} if link.mass and not self.axis else {})}
        gaps = self.link_axis.nearest(np.array(list(places.values())))[1]
        return [name for name, gap in zip(places, gaps, strict=True) if gap > STRAIGHT * self.link_axis.length]

    def solve(self) -> LinkStress:
        """Stress over the cycle. Raises ModelError with all findings, and where the cycle is not passed."""
        self.require()
        try:
            forces = solve_forces(self.mechanism, steps=self.steps)
        except LinkwrightError as error:
            from linkwright.errors import ModelError

            raise ModelError(
                [
                    fault(
                        "not_passed",
                        "mechanism",
                        _("the mechanism does not pass its cycle: {why}"),
                        _("mend the model first (linkwright check)"),
                        why=error.sentence,
                    )
                ]
            ) from None
        return LinkStress(self, forces)


def _summed(steps: Floats) -> Floats:
    """Sums from zero on along the second axis."""
    return np.concatenate([np.zeros_like(steps[:, :1]), np.cumsum(steps, axis=1)], axis=1)


@dataclass(frozen=True, repr=False)
class LinkStress(Result):
    """Bending moment, shear and normal force along a link at every position of the cycle, and what they mean.

    The link's mass is spread along its axis (see :class:`SpreadMass`). So joint forces, loads, weight and −ρ(s)·a(s)
    are in exact balance: beyond the last point no force is left (``closure``). With the cut at s, V(s) = Σ F below
    across the axis, M(s) = Σ F·(s − s_k) − Σ C, both with the line loads; N is positive in tension. Stress
    |N|/A + |M|/W, that of a straight bar at corners as well.

    ``stations`` (k,) m along the link, those of forces twice (left and right); ``moment``, ``shear``, ``normal``
    (n, k).
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    problem: LinkBending
    forces: Forces

    @property
    def link(self) -> Link:
        """The link."""
        return self.problem.mechanism.links[self.problem.link]

    @cached_property
    def axis(self) -> LinkAxis:
        """The axis along which the link is cut."""
        return self.problem.link_axis

    @cached_property
    def line(self) -> LinkLine:
        """The axis with its stations, and the mass along it."""
        return LinkLine(self.link, self.axis)

    @cached_property
    def cut(self) -> LinkCut:
        """The link cut across its axis."""
        return LinkCut(self.forces, self.line)

    @property
    def mass(self) -> SpreadMass:
        """The link's mass along its axis."""
        return self.line.mass

    @property
    def point_forces(self) -> list[PointForce]:
        """All that acts at points."""
        return self.cut.point_forces

    @property
    def stations(self) -> Floats:
        """Places along the axis (k,), m, every point of the link twice."""
        return self.line.stations

    @cached_property
    def deflection(self) -> Floats:
        """How far every station moves by bending and stretching, (n, k, 2) m along and across the axis there.

        Against the line from the first to the last corner, whose ends stay on it: du/ds = θ n + N/(E A) t,
        dθ/ds = M/(E I).
        """
        points, along, across = self.line.directions
        section, modulus = self.problem.section, self.problem.material.modulus
        bend, shear = (
            self.moment / (modulus * section.second_moment),
            self.shear / (modulus * section.second_moment),
        )
        h = np.diff(self.stations)
        turn = _summed(0.5 * h * (bend[:, 1:] + bend[:, :-1]) + h**2 / 12 * (shear[:, :-1] - shear[:, 1:]))
        rise = 0.5 * h * (turn[:, 1:] + turn[:, :-1]) + h**2 / 12 * (bend[:, :-1] - bend[:, 1:])
        strain = self.normal / (modulus * (section.area or math.inf))
        stretch = 0.5 * h * (strain[:, 1:] + strain[:, :-1])
        moved = _summed(rise[:, :, None] * across[1:] + stretch[:, :, None] * along[1:])
        chord = points[-1] - points[0]
        if chord @ chord > 0.0:
            aside = np.array([-chord[1], chord[0]])
            arms = points - points[0]
            held = -(moved[:, -1] @ aside) / (chord @ chord)
            moved = moved + held[:, None, None] * np.stack([-arms[:, 1], arms[:, 0]], axis=1)
        return np.stack([(moved * along).sum(axis=2), (moved * across).sum(axis=2)], axis=2)

    @property
    def shear(self) -> Floats:
        """V (n, k), N."""
        return self.cut.shear

    @property
    def moment(self) -> Floats:
        """M (n, k), N·m."""
        return self.cut.moment

    @property
    def normal(self) -> Floats:
        """N (n, k), N, tension positive."""
        return self.cut.normal

    @cached_property
    def stress(self) -> Floats:
        """|N|/A + |M|/W, (n, k) Pa."""
        section = self.problem.section
        return np.abs(self.normal) / (section.area or 1.0) + np.abs(self.moment) / (section.modulus or 1.0)

    @property
    def closure(self) -> float:
        """Largest force (N) left beyond the last point: zero but for rounding."""
        return self.cut.closure

    def worst(self, values: Floats) -> tuple[int, int]:
        """Position and station of the largest size."""
        index = np.unravel_index(int(np.abs(values).argmax()), values.shape)
        return int(index[0]), int(index[1])

    def numbers(self, key: str) -> Floats:
        """What a largest value is of, (n, k)."""
        if key == "largest_deflection":
            return np.hypot(self.deflection[:, :, 0], self.deflection[:, :, 1])
        return {"largest_moment": self.moment, "largest_normal": self.normal, "largest_stress": self.stress}[key]

    @cached_property
    def peaks(self) -> Mapping[str, tuple[LinkStress, int, int]]:
        """The largest sizes over the cycle, found between the positions: the link there, position and station."""
        analysis = Analysis.of(self.forces)
        found = {key: (size := self._size(key), analysis.extreme(size, "max", of="forces")) for key in LARGEST}
        wanted = [(size, each.time, each.value) for size, each in found.values() if each and each.exact]
        if len(wanted) < len(found):
            return {key: (self, *self.worst(self.numbers(key))) for key in found}
        forces, places = analysis.resolver.forces_at(wanted)
        there = LinkStress(self.problem, forces)
        stations = (int(np.abs(there.numbers(key)[i]).argmax()) for key, i in zip(found, places, strict=True))
        return {key: (there, i, k) for key, i, k in zip(found, places, stations, strict=True)}

    def _size(self, key: str) -> Callable[[Motion | Forces], Floats]:
        return lambda forces: np.abs(LinkStress(self.problem, forces).numbers(key)).max(axis=1)  # type: ignore[arg-type]

    def largest(self, key: str) -> float:
        """One of them, with its sign."""
        found, i, k = self.peaks[key]
        return float(found.numbers(key)[i, k])

    @property
    def safety(self) -> float | None:
        """Strength over the largest stress."""
        strength = self.problem.material.strength
        return None if strength is None else strength / self.largest("largest_stress")

    @property
    def needed_modulus(self) -> float | None:
        """W (m³) with which the largest stress of bending alone keeps the wanted safety."""
        strength = self.problem.material.strength
        return None if strength is None else abs(self.largest("largest_moment")) * self.problem.safety / strength

    def columns(self) -> dict[str, Floats]:
        """Over the cycle: input, the largest moment and normal force by size, the largest stress and deflection."""
        return {
            "input": self.forces.motion.input,
            "moment [N·m]": np.abs(self.moment).max(axis=1),
            "normal [N]": np.abs(self.normal).max(axis=1),
            "stress [Pa]": self.stress.max(axis=1),
            "deflection [m]": np.hypot(self.deflection[:, :, 0], self.deflection[:, :, 1]).max(axis=1),
        }

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [self._row(key, translate) for key in LARGEST if key != "largest_deflection"]
        if self.safety is not None and self.needed_modulus is not None:
            rows += [Row("safety", self.safety), Row("needed_modulus", self.needed_modulus, "section_modulus")]
        rows.append(self._row("largest_deflection", translate))
        rows.append(Row("closure", self.closure, "force", remainder=True))
        return [Block("cycle", _("Largest values over the cycle"), rows, self._remarks(translate))]

    def _row(self, key: str, translate: Translate) -> Row:
        found, i, k = self.peaks[key]
        note = _("at {at}, x = {x}", at=found._input(i), x=shown(self.stations[k], "length"))
        return Row(key, self.largest(key), LARGEST[key], "", note)

    def _input(self, index: int) -> str:
        turning = next(iter(self.forces.motion.positions.rotary.values()), True)
        return shown(float(self.forces.motion.input[index]), "angle" if turning else "length")

    def _remarks(self, translate: Translate) -> list[str]:
        found = []
        a, b = self.mass.span
        if (a, b) != (0.0, self.axis.length):
            found.append(
                translate(
                    _(
                        "The inertia of {link} is smaller than that of an even bar: its mass is spread "
                        "evenly from {start} to {end}.",
                        link=self.problem.link,
                        start=shown(a, "length"),
                        end=shown(b, "length"),
                    )
                )
            )
        if self.mass.density(np.linspace(a, b, 101)).min() < -1e-9 * max(self.link.mass, 1e-300) / (b - a):
            found.append(
                translate(
                    _(
                        "Mass, centre and inertia of {link} cannot be spread along it without a negative "
                        "density: the mass does not lie along the line, and the moments between the points "
                        "are approximate.",
                        link=self.problem.link,
                    )
                )
            )
        if any(each.name == "loads" for each in self.point_forces):
            found.append(
                translate(
                    _(
                        "The loads on {link} act as their resultant where its line meets the axis.",
                        link=self.problem.link,
                    )
                )
            )
        return found

    def steps(self, translate: Translate) -> list[Step]:
        there, i, k = self.peaks["largest_stress"]
        step = Step("1", translate(_("Position with the largest stress: {at}", at=there._input(i))))
        a, b = self.mass.span
        density = np.asarray(self.mass.density.coef, dtype=float)
        largest = np.abs(density * (b - a) ** np.arange(len(density))).max()
        text = polynomial_text(density, largest, b - a).replace("ξ", "s")
        step.note(translate(_("Mass along the link with the same mass, centre and inertia")))
        step.law(f"ρ(s) = {text}", "kg/m")
        step.note(translate(_("Forces on the link in its own axes (along, across)")))
        for each in there.point_forces:
            where, (x, y) = shown(float(each.place[i]), "length"), each.force[i].tolist()
            values = f"({shown(x, 'force')}, {shown(y, 'force')})"
            step.note(f"{each.name}, s = {where}: {values}, {shown(float(each.couple[i]), 'torque')}")
        cut = Step(
            "2", translate(_("Cut at s: the forces on the part below s balance V, M and N (inertia −ρ·a included)"))
        )
        cut.put("s", "", float(self.stations[k]), "length")
        cut.put("V", "Σ F + ∫ q ds", float(there.shear[i, k]), "force")
        cut.put("M", "Σ F·(s − s_k) − Σ C + ∫∫ q ds²", float(there.moment[i, k]), "torque")
        cut.put("N", "−Σ F − ∫ p ds", float(there.normal[i, k]), "force")
        section, strength = self.problem.section, self.problem.material.strength or 0.0
        of = {
            "N": (abs(float(there.normal[i, k])), "force"),
            "A": (section.area or 0.0, "section_area"),
            "M": (abs(float(there.moment[i, k])), "torque"),
            "W": (section.modulus or 0.0, "section_modulus"),
        }
        cut.put("σ", "|N|/A + |M|/W", float(there.stress[i, k]), "pressure", of=of)
        if self.safety is not None and self.needed_modulus is not None:
            cut.put("S", "Re/σ", self.safety, of={"Re": (strength, "pressure")})
            cut.known |= {"M_max": (abs(self.largest("largest_moment")), "torque"), "S": self.problem.safety}
            cut.put("W_min", "M_max·S/Re", self.needed_modulus, "section_modulus")
        return [step, cut]
