"""Systems of forces: resultant, moment, wrench, equilibrant; unknown magnitudes from the equilibrium of a point."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import number, shown
from linkwright.core.table import Block, Row
from linkwright.equations.matrix import system
from linkwright.equations.reading import measured, normal
from linkwright.equations.steps import Step
from linkwright.errors import Finding, fault
from linkwright.fields.base import file_key
from linkwright.parts.base import Problem, Result, signed
from linkwright.parts.statics.forces import (
    COUPLES,
    FORCES,
    LINES,
    PAIRS,
    ZERO,
    Along,
    Components,
    Force,
    direction_angles,
    spatial,
)
from linkwright.words import Message, Translate, _, pgettext

#: Singular values, and sums that stay, below this share of the largest count as zero.
SINGULAR = 1e-10
#: What the numbers are called.
LABELS: Mapping[str, Message] = {
    "along": _("component along the line"),
    "across": _("component across it"),
    "pitch": _("pitch h"),
    "couple": _("couple along R"),
    "to_line": _("angle to the line"),
}


@dataclass(frozen=True)
class ForceSystem(Problem):
    """Forces (N) at points (m) and couples (N·m); moments are taken ``about`` a point (m).

    ``components`` of forces along lines, ``angles`` between two forces. Forces of unknown magnitude, through one
    point with all others, are those that hold this point in equilibrium.
    """

    kind: ClassVar[str] = "forces"
    forces: Mapping[str, Force] = file_key(FORCES, dict)
    couples: Mapping[str, tuple[float, ...]] = file_key(COUPLES, dict)
    about: tuple[float, ...] = file_key(
        Components("length", doc="point about which moments are taken; default: the origin"), (0.0, 0.0, 0.0)
    )
    components: Mapping[str, Along] = file_key(LINES, dict)
    angles: Mapping[str, tuple[str, ...]] = file_key(PAIRS, dict)
    name: str = ""
    source: str = ""

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Names of the forces whose magnitude is to be found."""
        return tuple(name for name, each in self.forces.items() if each.unknown)

    def findings(self) -> list[Finding]:
        found = [each for name, one in self.forces.items() for each in one.findings(f"forces.{name}")]
        if not self.forces and not self.couples:
            found.append(
                fault("no_forces", "forces", _("there is no force"), _("write forces: {{F1: [0 N, 40 N, 60 N]}}"))
            )
        found += self._asked()
        if not found and self.unknowns:
            found = point_findings(self)
        return found

    def _asked(self) -> list[Finding]:
        """What is wrong with components and angles that are asked for."""
        found, known = [], tuple(self.forces)
        for name, line in self.components.items():
            key = f"components.{name}"
            found += line.line_findings(key) or (
                []
                if line.directed
                else [
                    fault(
                        "line_form",
                        key,
                        _("the line has no direction, or more than one"),
                        _("give direction: [2, 3, 6], or two points from: and to:"),
                    )
                ]
            )
            if line.of and line.of not in self.forces:
                found.append(
                    fault(
                        "no_force",
                        f"{key}.of",
                        _('there is no force "{name}"'),
                        _("name one of {known}"),
                        name=line.of,
                        known=known,
                    )
                )
        for name, pair in self.angles.items():
            found += [
                fault(
                    "no_force",
                    f"angles.{name}",
                    _('there is no force "{name}"'),
                    _("name one of {known}"),
                    name=each,
                    known=known,
                )
                for each in pair
                if each not in self.forces
            ]
            if len(pair) != 2:
                found.append(
                    fault(
                        "pair",
                        f"angles.{name}",
                        _("an angle lies between two forces, here are {count}"),
                        _("write [F1, F2]"),
                        count=len(pair),
                    )
                )
        return found

    def solve(self) -> Resultant | PointEquilibrium:
        """The resultant; with unknown magnitudes these, from equilibrium. Raises ModelError with all findings."""
        self.require()
        if self.unknowns:
            return PointEquilibrium(self)
        return Resultant(self)


@dataclass(frozen=True, repr=False)
class Resultant(Result):
    """What a system of forces amounts to.

    ``force`` R = Σ F and ``moment`` M = Σ (r − r0) × F + Σ C about the point r0 (N, N·m, (3,) each). The wrench is
    the same system reduced to the force R along its ``axis`` and the couple ``pitch``·R along it, with
    pitch h = R·M/R² and a point of the axis r0 + R × M/R² (Poinsot; Beer and Johnston, Vector Mechanics, ch. 3).
    """

    labels: ClassVar[Mapping[str, Message]] = LABELS
    system: ForceSystem

    @cached_property
    def force(self) -> Floats:
        """R, (3,) N; a sum that is zero but for rounding is zero."""
        vectors = [each.vector for each in self.system.forces.values()]
        return _tidy(np.sum(vectors, axis=0) if vectors else np.zeros(3), vectors)

    @cached_property
    def moment(self) -> Floats:
        """M about the point, (3,) N·m."""
        about = spatial(self.system.about)
        parts = [np.cross(each.place - about, each.vector) for each in self.system.forces.values()]
        parts += [spatial(each) for each in self.system.couples.values()]
        return _tidy(np.sum(parts, axis=0), parts)

    @property
    def size(self) -> float:
        """|R|, N."""
        return float(np.linalg.norm(self.force))

    @property
    def angles(self) -> Floats:
        """Direction angles of R, (3,) rad."""
        return direction_angles(self.force)

    @property
    def equilibrant(self) -> Floats:
        """The force (3,) N that holds the forces in balance."""
        return -self.force

    @property
    def pitch(self) -> float:
        """h = R·M/R², m; NaN without a force."""
        return float(self.force @ self.moment / self.size**2) if self.size else math.nan

    @property
    def axis_point(self) -> Floats:
        """The point of the wrench's axis nearest to the point of moments, (3,) m; NaN without a force."""
        if not self.size:
            return np.full(3, np.nan)
        return np.asarray(spatial(self.system.about) + np.cross(self.force, self.moment) / self.size**2)

    @property
    def balanced(self) -> bool:
        """Whether forces and moments sum to zero."""
        return not self.force.any() and not self.moment.any()

    def blocks(self, translate: Translate) -> list[Block]:
        blocks = [Block("resultant", _("Resultant R"), _vector_rows("R", self.force, self.size, self.angles))]
        moment = [Row("M", m, "torque", f"M{axis}") for axis, m in zip("xyz", self.moment, strict=True)]
        blocks.append(Block("moment", _("Moment about the chosen point"), moment))
        if self.size:
            place = [Row("axis", p, "length", f"{axis}0") for axis, p in zip("xyz", self.axis_point, strict=True)]
            wrench = [*place, Row("pitch", self.pitch, "length")]
            wrench.append(Row("couple", self.pitch * self.size, "torque"))
            blocks.append(Block("wrench", _("Wrench: force along an axis with a couple about it"), wrench))
        against = _vector_rows("E", self.equilibrant, self.size, direction_angles(self.equilibrant))
        remark = () if not self.balanced else (_("The system is in equilibrium."),)
        blocks.append(Block("equilibrant", _("Equilibrant E = −R"), against, remark))
        vectors = {name: each.vector for name, each in self.system.forces.items()}
        return [*blocks, *asked_blocks(self.system, vectors, self.force, translate)]

    def steps(self, translate: Translate) -> list[Step]:
        sums, about, wrench = (
            Step(str(i), translate(title))
            for i, title in enumerate((_("Resultant"), _("Moment"), _("Reduction to a wrench")), 1)
        )
        for name, each in self.system.forces.items():
            if each.size is not None:
                unit = ", ".join(number(u) for u in each.unit)
                vector = ", ".join(number(u) for u in each.vector)
                sums.law(f"{name} = {measured(shown(each.size, 'force'))}·({unit}) = ({vector})", "N")
        for i, axis in enumerate("xyz"):
            parts = [each.vector[i] for each in self.system.forces.values()]
            names = " + ".join(f"{name}{axis}" for name in self.system.forces)
            sums.put(f"R{axis}", names, self.force[i], "force", numbers=signed(parts))
        sums.put("R", "√(Rx² + Ry² + Rz²)", self.size, "force")
        for axis, angle, greek in zip("xyz", self.angles, "αβγ", strict=True):
            if self.size:
                sums.put(greek, f"arccos(R{axis}/R)", float(angle), "angle")
        self._moment_step(about, translate)
        if self.size:
            wrench.put("h", "R·M/R²", self.pitch, "length")
            for i, axis in enumerate("xyz"):
                wrench.put(f"{axis}0", f"{axis} + (R × M)_{axis}/R²", float(self.axis_point[i]), "length")
        else:
            wrench.note(
                translate(
                    _("The system is in equilibrium.")
                    if self.balanced
                    else _("There is no resultant force: the system is a couple.")
                )
            )
        found = [sums, about, wrench]
        vectors = {name: each.vector for name, each in self.system.forces.items()}
        return [*found, *asked_steps(self.system, vectors, self.force, translate, len(found))]

    def _moment_step(self, step: Step, translate: Translate) -> None:
        about = spatial(self.system.about)
        step.note(translate(_("moments about the point ({place})", place=", ".join(f"{number(c)} m" for c in about))))
        parts = [np.cross(each.place - about, each.vector) for each in self.system.forces.values()]
        parts += [spatial(each) for each in self.system.couples.values()]
        formulas = ("Σ (y·Fz − z·Fy)", "Σ (z·Fx − x·Fz)", "Σ (x·Fy − y·Fx)")
        for i, (axis, formula) in enumerate(zip("xyz", formulas, strict=True)):
            step.put(f"M{axis}", formula, self.moment[i], "torque", numbers=signed([p[i] for p in parts]))


def _tidy(total: Floats, parts: list[Floats]) -> Floats:
    largest = max((float(np.abs(part).max()) for part in parts), default=0.0)
    return np.where(np.abs(total) <= ZERO * largest, 0.0, total)


def _vector_rows(symbol: str, vector: Floats, size: float, angles: Floats) -> list[Row]:
    rows = [Row("component", c, "force", f"{symbol}{axis}") for axis, c in zip("xyz", vector, strict=True)]
    rows.append(Row("size", size, "force", f"|{symbol}|"))
    if size:
        rows += [Row(g, float(a), "angle", g) for g, a in zip("αβγ", angles, strict=True)]
    return rows


def _asked_for(
    system: ForceSystem, vectors: Mapping[str, Floats], resultant: Floats
) -> tuple[list[tuple[str, Along, str, Floats]], list[tuple[str, str, str]]]:
    """Lines with the name and the vector that is resolved along them, and pairs of forces."""
    lines = [
        (name, line, line.of or "R", vectors[line.of] if line.of else resultant)
        for name, line in system.components.items()
    ]
    return lines, [(name, first, second) for name, (first, second) in system.angles.items()]


def asked_blocks(
    system: ForceSystem, vectors: Mapping[str, Floats], resultant: Floats, translate: Translate
) -> list[Block]:
    """Components along lines, with what is left across them, and angles between forces."""
    lines, pairs = _asked_for(system, vectors, resultant)
    found = []
    for name, line, of, vector in lines:
        along = float(vector @ line.way)
        rest = vector - along * line.way
        rows = [Row("along", along, "force"), Row("across", float(np.linalg.norm(rest)), "force")]
        rows += [Row("part", c, "force", f"{name}.{axis}") for axis, c in zip("xyz", along * line.way, strict=True)]
        if np.any(vector):
            rows.append(Row("to_line", angle_between(vector, line.way), "angle"))
        found.append(Block(f"component {name}", _("Component of {of} along {name}", of=of, name=name), rows))
    angles = [
        Row(name, angle_between(vectors[a], vectors[b]), "angle", f"{name}: {a}, {b}")
        for name, a, b in pairs
        if np.any(vectors[a]) and np.any(vectors[b])
    ]
    return [*found, *([Block("angles", _("Angles between forces"), angles)] if angles else [])]


def angle_between(first: Floats, second: Floats) -> float:
    """Angle between two vectors (3,), rad, exact for small ones as well."""
    return math.atan2(float(np.linalg.norm(np.cross(first, second))), float(first @ second))


def asked_steps(
    system: ForceSystem, vectors: Mapping[str, Floats], resultant: Floats, translate: Translate, count: int
) -> list[Step]:
    """Dot products of what :func:`asked_blocks` shows."""
    lines, pairs = _asked_for(system, vectors, resultant)
    found: list[Step] = []
    for name, line, of, vector in lines:
        step = Step(str(count + len(found) + 1), translate(_("Component of {of} along {name}", of=of, name=name)))
        step.law(f"e = ({', '.join(number(float(c)) for c in line.way)})")
        numbers = dot_text(vector, line.way)
        along = float(vector @ line.way)
        step.put("F_along", f"{of}·e", along, "force", numbers=numbers)
        step.known[normal(of)] = (float(np.linalg.norm(vector)), "force")
        step.put("F_across", f"√({of}² − F_along²)", float(np.linalg.norm(vector - along * line.way)), "force")
        if np.any(vector):
            step.put("φ", f"arccos(F_along/{of})", angle_between(vector, line.way), "angle")
        found.append(step)
    for name, a, b in pairs:
        if not (np.any(vectors[a]) and np.any(vectors[b])):
            continue
        step = Step(
            str(count + len(found) + 1),
            translate(_("Angle {name} between {first} and {second}", name=name, first=a, second=b)),
        )
        step.law(f"{a}·{b} = {dot_text(vectors[a], vectors[b])} = {number(float(vectors[a] @ vectors[b]))}", "N²")
        sizes = "·".join(number(float(np.linalg.norm(vectors[each]))) for each in (a, b))
        numbers = f"arccos({number(float(vectors[a] @ vectors[b]))}/({sizes}))"
        step.put(
            "φ", f"arccos({a}·{b}/(|{a}|·|{b}|))", angle_between(vectors[a], vectors[b]), "angle", numbers=numbers
        )
        found.append(step)
    return found


def dot_text(first: Floats, second: Floats) -> str:
    """A dot product with its numbers: ``3·0.6 + 4·0.8``."""
    parts = [(float(a), float(b)) for a, b in zip(first, second, strict=True) if a and b]
    texts = [f"{number(a)}·{number(b) if b > 0 else f'({number(b)})'}" for a, b in parts]
    return " + ".join(f"({text})" if text.startswith("-") and k else text for k, text in enumerate(texts)) or "0"


def point_findings(system: ForceSystem) -> list[Finding]:
    """Why equilibrium cannot tell the unknown magnitudes of a system."""
    places = [each.place for each in system.forces.values()]
    if system.couples or any(not np.array_equal(each, places[0]) for each in places):
        return [
            fault(
                "one_point",
                "couples" if system.couples else "forces",
                _("the forces do not act through one point, as they must where a magnitude is sought"),
                _("leave out at: and couples, or calculate it as a rigid_body with supports"),
            )
        ]
    a, b, names = _matrix(system)
    sizes = np.linalg.svd(a, compute_uv=False)
    rank = int((sizes > SINGULAR * sizes[0]).sum())
    if rank < len(names):
        return [
            fault(
                "point_unknown",
                "forces",
                _("{count} unknown magnitudes ({names}) in {equations} independent equations of equilibrium"),
                _("give some of the magnitudes, or directions that are not parallel or in one plane"),
                count=len(names),
                equations=rank,
                names=names,
            )
        ]
    found = np.linalg.lstsq(a, b, rcond=None)[0]
    if np.abs(a @ found - b).max() > SINGULAR * max(float(np.abs(b).max()), float(np.abs(found).max())):
        left = b - a @ found
        return [
            fault(
                "point_open",
                "forces",
                _("no magnitudes of {names} hold the point in equilibrium: {left} N stay unbalanced"),
                _("add a force with another direction, or mend the directions"),
                names=names,
                left=f"({', '.join(number(float(c)) for c in left)})",
            )
        ]
    return []


def _matrix(system: ForceSystem) -> tuple[Floats, Floats, tuple[str, ...]]:
    """A (2 or 3, n), B and the names of the unknowns of A·X = B; two rows where all lies in the plane."""
    names = system.unknowns
    a = np.array([system.forces[name].unit for name in names]).T
    b = -np.sum([each.vector for each in system.forces.values()], axis=0)
    flat = not a[2].any() and not any(each.vector[2] for each in system.forces.values())
    return (a[:2], b[:2], names) if flat else (a, b, names)


@dataclass(frozen=True, repr=False)
class PointEquilibrium(Result):
    """Magnitudes of the unknown forces, N, from ΣF = 0 as A·X = B: the columns of A are their unit vectors, B is the
    sum of the known forces turned round (Beer and Johnston, Vector Mechanics, ch. 2). A negative one acts against its
    direction."""

    labels: ClassVar[Mapping[str, Message]] = LABELS
    system: ForceSystem

    @property
    def matrix(self) -> tuple[Floats, Floats]:
        """A (2 or 3, n) and B, N."""
        a, b, _unused = _matrix(self.system)
        return a, b

    @cached_property
    def magnitudes(self) -> dict[str, float]:
        """Unknown magnitudes by name, N."""
        a, b, names = _matrix(self.system)
        found = np.linalg.lstsq(a, b, rcond=None)[0]
        largest = max(float(np.abs(found).max()), float(np.abs(b).max()))
        return dict(zip(names, np.where(np.abs(found) < SINGULAR * largest, 0.0, found).tolist(), strict=True))

    @property
    def vectors(self) -> dict[str, Floats]:
        """All forces by name, (3,) N."""
        found = self.magnitudes
        return {
            name: found[name] * each.unit if name in found else each.vector
            for name, each in self.system.forces.items()
        }

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [Row(name, value, "force", name) for name, value in self.magnitudes.items()]
        remarks = [
            _("{name} acts against its direction.", name=name) for name, value in self.magnitudes.items() if value < 0
        ]
        parts = [
            Row("component", float(c), "force", f"{name}.{axis}")
            for name in self.magnitudes
            for axis, c in zip("xyz"[: len(self.matrix[1])], self.vectors[name], strict=False)
        ]
        found = [Block("magnitudes", _("Unknown magnitudes"), rows, remarks)]
        found.append(Block("components", _("Their components"), parts))
        return [*found, *asked_blocks(self.system, self.vectors, np.zeros(3), translate)]

    def steps(self, translate: Translate) -> list[Step]:
        a, b = self.matrix
        directions, sums, solved = (
            Step(str(i), translate(title))
            for i, title in enumerate(
                (_("Directions and known forces"), _("Equilibrium of the point"), pgettext("statics", "Solution")), 1
            )
        )
        for name, each in self.system.forces.items():
            unit = ", ".join(number(float(c)) for c in each.unit[: len(b)])
            if each.unknown:
                directions.law(f"e_{name} = ({unit})")
            else:
                vector = ", ".join(number(float(c)) for c in each.vector[: len(b)])
                directions.law(f"{name} = ({vector})", "N")
        rows = tuple(f"ΣF{axis}" for axis in "xyz"[: len(b)])
        for i, row in enumerate(rows):
            sums.law(f"{row} = {_row(a[i], list(self.magnitudes), -b[i])} = 0")
        solved.note(translate(_("In matrix form A·X = B:")))
        solved.items.append(system(a, list(self.magnitudes), b, rows))
        for name, value in self.magnitudes.items():
            solved.put(name, "", value, "force")
            if value < 0:
                solved.note(translate(_("{name} acts against its direction.", name=name)))
        found = [directions, sums, solved]
        return [*found, *asked_steps(self.system, self.vectors, np.zeros(3), translate, len(found))]


def _row(coefficients: Floats, names: list[str], known: float) -> str:
    """Coefficients times unknowns and what is known, as a sum."""
    text = ""
    for c, name in zip(coefficients.tolist(), names, strict=True):
        if c:
            text += f" {'−' if c < 0 else '+'} {'' if abs(c) == 1.0 else number(abs(c)) + '·'}{name}"
    rest = signed([known])
    text += "" if rest == "0" else f" − {rest[1:]}" if rest.startswith("−") else f" + {rest}"
    text = text.strip()
    return f"−{text[2:]}" if text.startswith("−") else text.removeprefix("+ ") or "0"
