"""A straight beam on any supports under forces, couples and line loads."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.quantity import number, shown
from linkwright.core.search import first_largest
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.errors import Finding, fault
from linkwright.fields.base import Quantities, Quantity, file_key
from linkwright.fields.tables import Flag, Listed, Named, Table
from linkwright.parts.base import Problem, Result, signed
from linkwright.parts.beams.components import (
    MATERIAL,
    BeamLoad,
    BeamSupport,
    Material,
    Section,
    SectionStep,
    section_field,
)
from linkwright.parts.beams.elastic import (
    DistributedLoad,
    ElasticLine,
    Point,
    SupportCondition,
    balance_laws,
    free_motions,
    line_moment,
    polynomial_text,
    rounded,
    solve_line,
)
from linkwright.parts.statics.body import plain_motions
from linkwright.units import GRAVITY
from linkwright.words import Message, Translate, _

QUANTITIES = ("shear", "moment", "slope", "deflection")
DIMENSIONS = {"shear": "force", "moment": "torque", "slope": "slope", "deflection": "length"}
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "stress": _("largest bending stress |M|/W"),
    "safety": _("safety against the strength"),
    "needed_modulus": _("needed section modulus"),
}
#: What goes along a beam, in words.
QUANTITY_NAMES = {
    "shear": _("shear force V"),
    "moment": _("bending moment M"),
    "slope": _("slope θ"),
    "deflection": _("deflection w"),
}
EXTREMES = {"least": _("least"), "largest": _("largest")}


@dataclass(frozen=True)
class Beam(Problem):
    """A beam of ``length`` (m) with a ``section`` of a ``material``, supports and loads by name, x from its left end.

    ``steps``: other sections from places on; ``hinges``: places without bending moment; ``own_weight``: with the
    material's density, downwards; ``safety``: against the material's strength.
    """

    kind: ClassVar[str] = "beam"
    length: float = file_key(Quantity("length", above=0.0, doc="length of the beam"))
    material: Material = file_key(MATERIAL)
    section: Section = file_key(
        section_field("cross section: IPE 100, {rectangle: [b, h]}, {circle: [d]}, {second_moment: 2e-5 m⁴}")
    )
    supports: Mapping[str, BeamSupport] = file_key(
        Named(Table.of(BeamSupport), _("support"), doc="supports by name: {kind: pinned, at: 0 m}")
    )
    loads: Mapping[str, BeamLoad] = file_key(
        Named(
            Table.of(BeamLoad),
            _("load"),
            doc="by name: {force: -2 kN, at: 1 m}, {line: -1 kN/m, from: 0 m}, {couple: …}",
        ),
        dict,
    )
    steps: tuple[SectionStep, ...] = file_key(
        Listed(Table.of(SectionStep), "[{from: 1 m, section: …}]", doc="other sections from places on"), ()
    )
    hinges: tuple[float, ...] = file_key(Quantities("length", doc="places of hinges within the beam"), ())
    own_weight: bool = file_key(Flag(doc="true: with the weight of the beam itself"), False)
    safety: float | None = file_key(
        Quantity("dimensionless", above=0.0, doc="safety against the strength, for the needed section"), None
    )
    name: str = ""
    source: str = ""

    def findings(self) -> list[Finding]:
        found = [each for name, load in self.loads.items() for each in self._load_findings(name, load)]
        places = {f"supports.{name}.at": each.at for name, each in self.supports.items()}
        places |= {f"hinges.{i}": x for i, x in enumerate(self.hinges)}
        places |= {f"steps.{i}.from": each.start for i, each in enumerate(self.steps)}
        found += [
            fault(
                "outside",
                key,
                _("{x} lies outside the beam, which is {length} long"),
                _("give a place between 0 and the length"),
                x=shown(x, "length"),
                length=shown(self.length, "length"),
            )
            for key, x in places.items()
            if not 0.0 <= x <= self.length
        ]
        for name, support in self.supports.items():
            if support.kind == "spring" and not (support.stiffness or support.torsional_stiffness):
                found.append(
                    fault(
                        "no_stiffness",
                        f"supports.{name}",
                        _("the spring has no stiffness"),
                        _("give stiffness: 50 kN/m, or torsional_stiffness"),
                    )
                )
        if self.own_weight and (self.material.density is None or self.section.area is None):
            found.append(
                fault(
                    "no_weight",
                    "own_weight",
                    _("the own weight needs the material's density and the section's area"),
                    _("give them, or leave own_weight out"),
                )
            )
        if self.safety is not None and self.material.strength is None:
            found.append(
                fault(
                    "no_strength",
                    "safety",
                    _("the material has no strength"),
                    _("give its strength, or leave safety out"),
                )
            )
        return found or [
            fault(
                "can_move",
                "supports",
                _("too few supports: the beam can {how}"),
                _("add a support, or fix one"),
                how=self._motion(motion),
            )
            for motion in plain_motions(free_motions(self.length, self._holds(), sorted(self.hinges)))
        ]

    def _load_findings(self, name: str, load: BeamLoad) -> list[Finding]:
        kinds = [each for each in ("force", "couple", "line") if getattr(load, each) is not None]
        key = f"loads.{name}"
        if len(kinds) != 1 or (kinds[0] != "line" and load.at is None):
            return [
                fault(
                    "load_form",
                    key,
                    _("the load is neither complete nor unique"),
                    _(
                        "write {{force: -2 kN, at: 1 m}}, {{couple: 900 N·m, at: 1 m}} or {{line: -1 kN/m, "
                        "from: 0 m, to: 1 m}}"
                    ),
                )
            ]
        end = self.length if load.end is None else load.end
        places = {"from": load.start, "to": end} if kinds[0] == "line" else {"at": load.at or 0.0}
        found = [
            fault(
                "outside",
                f"{key}.{word}",
                _("{x} lies outside the beam, which is {length} long"),
                _("give a place between 0 and the length"),
                x=shown(x, "length"),
                length=shown(self.length, "length"),
            )
            for word, x in places.items()
            if not 0.0 <= x <= self.length * (1 + 1e-12)
        ]
        if kinds[0] == "line" and not found and end <= load.start:
            found.append(
                fault(
                    "empty_line",
                    f"{key}.to",
                    _("the line load ends where it begins, or before"),
                    _("give to a value above from"),
                )
            )
        return found

    def _motion(self, motion: Floats) -> Message:
        """A motion that the supports leave, in words; ``motion`` is (w over length, slope, kinks)."""
        kinks = [x for x, kink in zip(sorted(self.hinges), motion[2:], strict=True) if abs(kink) > 1e-9]
        if kinks:
            return _(
                "fold at the hinge at {places}", code="beam.folds", places=tuple(shown(x, "length") for x in kinks)
            )
        if abs(motion[1]) < 1e-9:
            return _("move up and down", code="beam.shifts")
        return _(
            "turn about x = {place}", code="beam.turns", place=shown(-motion[0] / motion[1] * self.length, "length")
        )

    def _holds(self) -> list[SupportCondition]:
        return [each.hold for each in self.supports.values()]

    def solve(self) -> BeamLine:
        """The elastic line. Raises ModelError with all findings, also where the supports are too few."""
        self.require()
        points, spreads = self._loads()
        sections = [(0.0, self.section), *sorted((s.start, s.section) for s in self.steps)]
        rigidity = [(start, section.second_moment * self.material.modulus) for start, section in sections]
        line = solve_line(self.length, rigidity, self._holds(), points, spreads, sorted(self.hinges))
        return BeamLine(self, line, tuple(sections))

    def _loads(self) -> tuple[list[Point], list[DistributedLoad]]:
        points, spreads = [], []
        for load in self.loads.values():
            if load.line is not None:
                end = self.length if load.end is None else min(load.end, self.length)
                spreads.append(DistributedLoad(load.start, end, load.line[0], load.line[-1]))
            else:
                points.append(Point(load.at or 0.0, load.force or 0.0, load.couple or 0.0))
        if self.own_weight:
            starts = [0.0, *sorted(s.start for s in self.steps), self.length]
            sections = [self.section, *(s.section for s in sorted(self.steps, key=lambda s: s.start))]
            for a, b, section in zip(starts[:-1], starts[1:], sections, strict=True):
                weight = -GRAVITY * (self.material.density or 0.0) * (section.area or 0.0)
                spreads.append(DistributedLoad(a, b, weight, weight))
        return points, spreads


@dataclass(frozen=True, repr=False)
class BeamLine(Result):
    """Reactions, shear force, bending moment, slope and deflection of a beam, exact for the Euler–Bernoulli beam.

    ``shear(x)`` N, ``moment(x)`` N·m, ``slope(x)`` rad, ``deflection(x)`` m take places (n,) m; at jumps they give
    the value on the right, with ``side="left"`` that on the left. ``extremes(quantity)``: place and value of the
    minimum and the maximum.
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    beam: Beam
    line: ElasticLine
    sections: tuple[tuple[float, Section], ...]

    def shear(self, x: ArrayLike, side: str = "right") -> Floats:
        """Shear force V, N: the sum of all forces left of x."""
        return self.line.value("shear", x, side)

    def moment(self, x: ArrayLike, side: str = "right") -> Floats:
        """Bending moment M, N·m, positive where the beam sags."""
        return self.line.value("moment", x, side)

    def slope(self, x: ArrayLike, side: str = "right") -> Floats:
        """Slope w', rad."""
        return self.line.value("slope", x, side)

    def deflection(self, x: ArrayLike) -> Floats:
        """Deflection w, m, upwards positive."""
        return self.line.value("deflection", x)

    def extremes(self, quantity: str) -> tuple[tuple[float, float], tuple[float, float]]:
        """(place, value) of the minimum and of the maximum shear, moment, slope or deflection."""
        return self.line.extremes(quantity)

    def largest(self, quantity: str) -> tuple[float, float]:
        """(place, value) of the value that is largest in size."""
        return _first_largest(self.extremes(quantity))

    @cached_property
    def reactions(self) -> dict[str, tuple[float, float]]:
        """Force (N, up) and couple (N·m) of every support by name."""
        size = max((abs(c) for pair in self.line.reactions for c in pair), default=0.0)
        tidy = [tuple(0.0 if abs(c) < 1e-13 * size else c for c in pair) for pair in self.line.reactions]
        return dict(zip(self.beam.supports, tidy, strict=True))  # type: ignore[arg-type]

    @cached_property
    def stress(self) -> tuple[float, float] | None:
        """(place, value) of the largest bending stress |M|/W, Pa; None where a section has no modulus."""
        found = []
        for i, (start, section) in enumerate(self.sections):
            if section.modulus is None:
                return None
            end = self.sections[i + 1][0] if i + 1 < len(self.sections) else self.beam.length
            inside = [s for s in self.line.segments if start - 1e-12 <= s.start and s.end <= end * (1 + 1e-12)]
            place, moment = _first_largest(ElasticLine(tuple(inside), ()).extremes("moment"))
            found.append((place, abs(moment) / section.modulus))
        return _first_largest(found)

    @property
    def safety(self) -> float | None:
        """Strength over the largest stress; None where one of them is not known or there is no stress."""
        strength = self.beam.material.strength
        return None if strength is None or not self.stress or not self.stress[1] else strength / self.stress[1]

    @property
    def needed_modulus(self) -> float | None:
        """Section modulus, m³, that the largest moment needs at the wanted safety (1 unless given)."""
        strength = self.beam.material.strength
        return None if strength is None else abs(self.largest("moment")[1]) * (self.beam.safety or 1.0) / strength

    def columns(self) -> dict[str, Floats]:
        """x and the four quantities; places of jumps stand twice, left value first."""
        ends = [segment.start for segment in self.line.segments] + [self.beam.length]
        x = np.concatenate([np.linspace(a, b, 49) for a, b in pairwise(ends)])
        side = np.zeros(len(x), dtype=bool)
        side[48::49] = True
        names = {
            "shear": "shear [N]",
            "moment": "moment [N·m]",
            "slope": "slope [rad]",
            "deflection": "deflection [m]",
        }
        found = {"x [m]": x}
        for quantity, name in names.items():
            found[name] = np.where(side, self.line.value(quantity, x, "left"), self.line.value(quantity, x))
        return found

    def blocks(self, translate: Translate) -> list[Block]:
        rows = []
        for name, (force, couple) in self.reactions.items():
            kind = self.beam.supports[name].kind
            if kind != "guided":
                rows.append(Row(f"{name}.force", force, "force", f"{name} F"))
            if kind in ("fixed", "guided") or self.beam.supports[name].torsional_stiffness:
                rows.append(Row(f"{name}.couple", couple, "torque", f"{name} M"))
        found = [Block("reactions", _("Reactions (force up, couple counter-clockwise)"), rows)]
        extremes = []
        for quantity in QUANTITIES:
            for word, (x, value) in zip(("least", "largest"), self.extremes(quantity), strict=True):
                label = f"{translate(QUANTITY_NAMES[quantity])}, {translate(EXTREMES[word])}"
                note = _("at x = {x}", x=shown(x, "length"))
                extremes.append(Row(f"{word}_{quantity}", value, DIMENSIONS[quantity], label, note))
        found.append(Block("extremes", _("Extremes"), extremes))
        found.append(Block("places", _("Key points"), self._places(translate)))
        strength = self._strength(translate)
        return [*found, Block("strength", _("Strength"), strength)] if strength else found

    def _places(self, translate: Translate) -> list[Row]:
        """Moment and deflection where segments meet."""
        rows = []
        for x in [*(segment.start for segment in self.line.segments), self.beam.length]:
            at = shown(x, "length")
            left, right = float(self.moment(x, "left")[0]), float(self.moment(x)[0])
            jump = abs(right - left) > 1e-9 * max(abs(left), abs(right), 1e-300)
            if jump and 0 < x < self.beam.length:
                rows.append(Row(f"moment_before_{x:g}", left, "torque", f"M({at}⁻)"))
                rows.append(Row(f"moment_behind_{x:g}", right, "torque", f"M({at}⁺)"))
            else:
                rows.append(Row(f"moment_{x:g}", left if x else right, "torque", f"M({at})"))
            rows.append(Row(f"slope_{x:g}", float(self.slope(x)[0]), "slope", f"θ({at})"))
            rows.append(Row(f"deflection_{x:g}", float(self.deflection(x)[0]), "length", f"w({at})"))
        return rows

    def _strength(self, translate: Translate) -> list[Row]:
        rows = []
        if self.stress is not None:
            rows.append(
                Row("stress", self.stress[1], "pressure", "", _("at x = {x}", x=shown(self.stress[0], "length")))
            )
        if self.safety is not None:
            rows.append(Row("safety", self.safety))
        if self.needed_modulus is not None:
            rows.append(Row("needed_modulus", self.needed_modulus, "section_modulus"))
        return rows

    def steps(self, translate: Translate) -> list[Step]:
        return [self._balance_step(translate), self._segment_step(translate), self._extreme_step(translate)]

    def _balance_step(self, translate: Translate) -> Step:
        """Reactions, and both equations of equilibrium with them."""
        step = Step("1", translate(_("Reactions and equilibrium")))
        holds = {name: each.hold for name, each in self.beam.supports.items()}
        unknown = sum(h.deflection + h.slope for h in holds.values())
        degree = unknown - 2 - len(self.beam.hinges)
        step.note(
            translate(
                (
                    _("Equilibrium alone gives the reactions.")
                    if degree <= 0
                    else _("Statically indeterminate to degree {degree}: the stiffness decides with equilibrium.")
                ).format(degree=degree)
            )
        )
        points, spreads = self.beam._loads()
        balance_laws(step, holds, self.beam.length, points, spreads)
        for name, (force, couple) in self.reactions.items():
            if force or self.beam.supports[name].kind != "guided":
                step.put(f"{name}.F", "", force, "force")
            if couple:
                step.put(f"{name}.M", "", couple, "torque")
        step.note(translate(_("Proof by the sums over all forces, and moments about x = 0:")))
        forces = [f for f, _unused in self.reactions.values()] + [p.force for p in points]
        forces += [(s.first + s.last) / 2 * (s.end - s.start) for s in spreads]
        step.put("ΣF", "", rounded(forces), "force", numbers=signed(forces, "force"))
        moments = [
            c + f * s.at for (f, c), s in zip(self.reactions.values(), self.beam.supports.values(), strict=True)
        ]
        moments += [p.couple + p.force * p.x for p in points]
        moments += [line_moment(s) for s in spreads]
        step.put("ΣM(0)", "", rounded(moments), "torque", numbers=signed(moments, "torque"))
        return step

    def _segment_step(self, translate: Translate) -> Step:
        """The polynomials of every segment."""
        step = Step(
            "2",
            translate(
                _("Shear force, moment, slope and deflection, segment by segment (ξ from the segment's start)")
            ),
        )
        largest = {quantity: self._largest_coefficient(quantity) for quantity in QUANTITIES}
        for segment in self.line.segments:
            step.note(
                translate(
                    _(
                        "from {start} to {end}, EI = {rigidity} N·m²",
                        start=shown(segment.start, "length"),
                        end=shown(segment.end, "length"),
                        rigidity=number(segment.rigidity),
                    )
                )
            )
            for symbol, quantity, unit in (
                ("V", "shear", "N"),
                ("M", "moment", "N·m"),
                ("θ", "slope", "rad"),
                ("w", "deflection", "m"),
            ):
                polynomial = getattr(segment, quantity).coef
                text = polynomial_text(polynomial, largest[quantity], segment.end - segment.start)
                step.law(f"{symbol}(ξ) = {text}", unit)
        return step

    def _largest_coefficient(self, quantity: str) -> float:
        """The largest term of a quantity's polynomials over the beam, the scale of rounding."""
        return max(
            float(np.abs(p.coef * (each.end - each.start) ** np.arange(len(p.coef))).max())
            for each in self.line.segments
            for p in [getattr(each, quantity)]
        )

    def _extreme_step(self, translate: Translate) -> Step:
        step = Step("3", translate(_("Extremes")))
        for symbol, quantity, zero in (("V", "shear", "q"), ("M", "moment", "V"), ("w", "deflection", "θ")):
            x, value = self.largest(quantity)
            step.note(
                translate(
                    _(
                        "{symbol} is largest in size where {zero} = 0 or at an end or jump: x = {x}",
                        symbol=symbol,
                        zero=zero,
                        x=shown(x, "length"),
                    )
                )
            )
            step.put(f"{symbol}_max", "", value, DIMENSIONS[quantity])
        step.known["Re"] = (self.beam.material.strength or 0.0, "pressure")
        if self.stress is not None and self.stress[1]:
            x, stress = self.stress
            moment = max((float(self.moment(x, side)[0]) for side in ("left", "right")), key=abs)
            of = {"M": (abs(moment), "torque"), "W": (abs(moment) / stress, "section_modulus")}
            step.put("σ", "M/W", stress, "pressure", of=of)
        if self.safety is not None and self.stress is not None:
            step.put("S", "Re/σ", self.safety, of={"σ": (self.stress[1], "pressure")})
        if self.needed_modulus is not None:
            step.known |= {"M_max": (abs(self.largest("moment")[1]), "torque"), "S": self.beam.safety or 1.0}
            step.put("W_min", "M_max·S/Re", self.needed_modulus, "section_modulus")
        return step


def _first_largest(found: Iterable[tuple[float, float]]) -> tuple[float, float]:
    """Of pairs (place, value) the value of largest size, of equal ones the first."""
    ordered = sorted(found)
    return ordered[first_largest(np.abs([value for _unused, value in ordered]))]
