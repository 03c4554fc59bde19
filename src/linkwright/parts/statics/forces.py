"""Systems of forces in the plane and in space: resultant, moment, wrench, equilibrant."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.errors import Finding
from linkwright.fields.base import Quantities, Quantity, Text, given, quantity_schema
from linkwright.fields.nodes import Node
from linkwright.fields.nodes import Sequence as SequenceNode
from linkwright.fields.reading import Place, Reader
from linkwright.parts.base import Block, Problem, Result, Row, Value, fault, number, put, shown, signed
from linkwright.parts.fields import Either, Listed, Named, Table
from linkwright.words import Say
from linkwright.worked.page import Step
from linkwright.worked.written import measured

if TYPE_CHECKING:
    from linkwright.parts.statics.point import PointEquilibrium

#: A sum smaller than this share of its largest part is zero but for rounding.
ZERO = 1e-12


def spatial(vector: ArrayLike) -> Floats:
    """Three components of two or three."""
    found = np.asarray(vector, dtype=float)
    return np.concatenate([found, np.zeros(3 - len(found))])


@dataclass(frozen=True)
class Components(Quantities):
    """Two or three components."""

    def shape(self) -> dict[str, object]:
        return {**super().shape(), "minItems": 2, "maxItems": 3}


@dataclass(frozen=True)
class Direction(Components):
    """A vector of any length, or in the plane its angle from the x-axis."""

    def read(
        self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]
    ) -> tuple[float, ...] | None:
        if isinstance(node, SequenceNode):
            return super().read(reader, node, place, given)
        angle = reader.quantity(node, place, "angle")
        if angle is None:
            return None
        return tuple(0.0 if abs(c) < ZERO else c for c in (math.cos(angle), math.sin(angle)))

    def shape(self) -> dict[str, object]:
        return {"anyOf": [super().shape(), quantity_schema("angle")]}


DIRECTION = Direction(
    "dimensionless", key="direction", old="along", form="[2, 3, 6]",
    doc="direction: a vector of any length, or in the plane an angle from the x-axis",
)  # fmt: skip
START = Components("length", key="from", doc="a point of the line of action, instead of a direction")
END = Components("length", key="to", doc="the point of this line to which the force points")


class Line:
    """A direction: a vector ``along`` of any length, or the way from the point ``start`` to the point ``end``, m."""

    along: tuple[float, ...]
    start: tuple[float, ...]
    end: tuple[float, ...]

    @property
    def directed(self) -> bool:
        """Whether a direction is given."""
        return bool(self.along or self.start or self.end)

    @property
    def way(self) -> Floats:
        """Unit vector of the given direction, (3,)."""
        way = spatial(self.along) if self.along else spatial(self.end) - spatial(self.start)
        return np.asarray(way / np.linalg.norm(way))

    def line_findings(self, key: str) -> list[Finding]:
        """What is wrong with the direction."""
        found = [
            fault("statics.components", f"{key}.{word}", count=len(vector))
            for word, vector in (("direction", self.along), ("from", self.start), ("to", self.end))
            if vector and len(vector) not in (2, 3)
        ]
        if found:
            return found
        if bool(self.start) != bool(self.end) or (self.along and self.start):
            return [fault("statics.line_form", key)]
        if self.along and not any(self.along):
            return [fault("statics.no_direction", f"{key}.direction")]
        if self.start and np.array_equal(spatial(self.start), spatial(self.end)):
            return [fault("statics.no_direction", f"{key}.to")]
        return []


@dataclass(frozen=True)
class Force(Line):
    """A force: its components ``force`` (2 or 3) N, or its ``size`` N ``along`` a direction; ``at`` (2 or 3) m.

    The direction may be given by two points of the line of action, from ``start`` to ``end``. A force with a
    direction alone has an unknown magnitude, which equilibrium gives.
    """

    force: tuple[float, ...] = given(Components("force", doc="components"), ())
    size: float | None = given(
        Quantity("force", key="magnitude", old="size", doc="magnitude, with direction; unknown unless given"),
        None,
    )
    along: tuple[float, ...] = given(DIRECTION, ())
    at: tuple[float, ...] = given(
        Components("length", doc="point of application, the origin unless given"), (0.0, 0.0)
    )
    start: tuple[float, ...] = given(START, ())
    end: tuple[float, ...] = given(END, ())

    @property
    def unknown(self) -> bool:
        """Whether its magnitude is to be found."""
        return self.size is None and not self.force

    @property
    def vector(self) -> Floats:
        """Components, (3,) N; of an unknown force zero."""
        if self.force:
            return spatial(self.force)
        return (self.size or 0.0) * self.unit

    @property
    def unit(self) -> Floats:
        """Unit vector of its direction, (3,); zero without a direction."""
        if self.directed:
            return self.way
        size = float(np.linalg.norm(spatial(self.force)))
        return spatial(self.force) / (size or 1.0)

    @property
    def place(self) -> Floats:
        """Point of application, (3,) m."""
        return spatial(self.at)

    def findings(self, key: str) -> list[Finding]:
        """What is wrong with it."""
        found = []
        if bool(self.force) == self.directed or (self.force and self.size is not None):
            found.append(fault("statics.force_form", key))
        found += self.line_findings(key)
        for name, vector in (("force", self.force), ("at", self.at)):
            if vector and len(vector) not in (2, 3):
                found.append(fault("statics.components", f"{key}.{name}", count=len(vector)))
        return found


@dataclass(frozen=True)
class ForceField(Either):
    """A force as ``[Fx, Fy, Fz]``, or as a table with its place, or with its magnitude and direction."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, given)
        return Force(force=found) if isinstance(found, tuple) else found


FORCES = Named(
    ForceField(Components("force", form="[0 N, 40 N, 60 N]"), Table.of(Force)),
    "force",
    doc="forces by name: [Fx, Fy, Fz], {magnitude: …, direction: […]}, or {direction: […]} where it is sought",
)
COUPLES = Named(
    Components("torque"), "couple", doc="couples by name: [Mx, My, Mz]; in the plane [0 N·m, 0 N·m, M]"
)


@dataclass(frozen=True)
class Along(Line):
    """A line along which a force is resolved: ``of`` the name of a force, of the resultant unless given."""

    along: tuple[float, ...] = given(DIRECTION, ())
    start: tuple[float, ...] = given(START, ())
    end: tuple[float, ...] = given(END, ())
    of: str = given(Text(doc="name of the force, the resultant unless given"), "")


LINES = Named(
    Table.of(Along),
    "direction",
    doc="lines along which a force is resolved, by name: {of: F, direction: [2, 3, 6]}",
)
PAIRS = Named(Listed(Text(), "[F1, F2]"), "angle", doc="angles between two forces, by name: [F1, F2]")


def direction_angles(vector: Floats) -> Floats:
    """Angles (3,) rad of a vector against the axes x, y, z; NaN for a vector without direction."""
    size = float(np.linalg.norm(vector))
    return np.arccos(np.clip(vector / size, -1.0, 1.0)) if size else np.full(3, np.nan)


@dataclass(frozen=True)
class ForceSystem(Problem):
    """Forces (N) at points (m) and couples (N·m); moments are taken ``about`` a point (m).

    ``components`` of forces along lines, ``angles`` between two forces. Forces of unknown magnitude, through one
    point with all others, are those that hold this point in equilibrium.
    """

    kind: ClassVar[str] = "forces"
    forces: Mapping[str, Force] = given(FORCES, dict)
    couples: Mapping[str, tuple[float, ...]] = given(COUPLES, dict)
    about: tuple[float, ...] = given(
        Components("length", doc="point about which moments are taken, the origin unless given"),
        (0.0, 0.0, 0.0),
    )
    components: Mapping[str, Along] = given(LINES, dict)
    angles: Mapping[str, tuple[str, ...]] = given(PAIRS, dict)
    name: str = ""
    source: str = ""

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Names of the forces whose magnitude is to be found."""
        return tuple(name for name, each in self.forces.items() if each.unknown)

    def findings(self) -> list[Finding]:
        found = [each for name, one in self.forces.items() for each in one.findings(f"forces.{name}")]
        if not self.forces and not self.couples:
            found.append(fault("statics.no_forces", "forces"))
        found += self._asked()
        if not found and self.unknowns:
            from linkwright.parts.statics.point import point_findings

            found = point_findings(self)
        return found

    def _asked(self) -> list[Finding]:
        """What is wrong with components and angles that are asked for."""
        found, known = [], tuple(self.forces)
        for name, line in self.components.items():
            key = f"components.{name}"
            found += line.line_findings(key) or ([] if line.directed else [fault("statics.line_form", key)])
            if line.of and line.of not in self.forces:
                found.append(fault("statics.no_force", f"{key}.of", name=line.of, known=known))
        for name, pair in self.angles.items():
            found += [fault("statics.no_force", f"angles.{name}", name=each, known=known)
                      for each in pair if each not in self.forces]  # fmt: skip
            if len(pair) != 2:
                found.append(fault("statics.pair", f"angles.{name}", count=len(pair)))
        return found

    def solve(self) -> Resultant | PointEquilibrium:
        """The resultant; with unknown magnitudes these, from equilibrium. Raises ModelError with all findings."""
        self.require()
        if self.unknowns:
            from linkwright.parts.statics.point import PointEquilibrium

            return PointEquilibrium(self)
        return Resultant(self)


@dataclass(frozen=True, repr=False)
class Resultant(Result):
    """What a system of forces amounts to.

    ``force`` R = Σ F and ``moment`` M = Σ (r − r0) × F + Σ C about the point r0 (N, N·m, (3,) each). The wrench is
    the same system reduced to the force R along its ``axis`` and the couple ``pitch``·R along it, with
    pitch h = R·M/R² and a point of the axis r0 + R × M/R² (Poinsot; Beer and Johnston, Vector Mechanics, ch. 3).
    """

    area: ClassVar[str] = "statics"
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

    def blocks(self, say: Say) -> list[Block]:
        blocks = [
            Block(
                "resultant", say("statics.resultant"), _vector_rows("R", self.force, self.size, self.angles)
            )
        ]
        moment = [Row("M", m, "torque", f"M{axis}") for axis, m in zip("xyz", self.moment, strict=True)]
        blocks.append(Block("moment", say("statics.moment"), moment))
        if self.size:
            place = [
                Row("axis", p, "length", f"{axis}0") for axis, p in zip("xyz", self.axis_point, strict=True)
            ]
            wrench = [*place, Row("pitch", self.pitch, "length")]
            wrench.append(Row("couple", self.pitch * self.size, "torque"))
            blocks.append(Block("wrench", say("statics.wrench"), wrench))
        against = _vector_rows("E", self.equilibrant, self.size, direction_angles(self.equilibrant))
        remark = () if not self.balanced else (say("statics.balanced"),)
        blocks.append(Block("equilibrant", say("statics.equilibrant"), against, remark))
        vectors = {name: each.vector for name, each in self.system.forces.items()}
        return [*blocks, *asked_blocks(self.system, vectors, self.force, say)]

    def steps(self, say: Say) -> list[Step]:
        sums, about, wrench = (Step(str(i + 1), say(f"statics.step_{i + 1}")) for i in range(3))
        for name, each in self.system.forces.items():
            if each.size is not None:
                unit = ", ".join(number(u) for u in each.unit)
                vector = ", ".join(number(u) for u in each.vector)
                sums.law(f"{name} = {measured(shown(each.size, 'force'))}·({unit}) = ({vector})", "N")
        for i, axis in enumerate("xyz"):
            parts = [each.vector[i] for each in self.system.forces.values()]
            names = " + ".join(f"{name}{axis}" for name in self.system.forces)
            put(sums, f"R{axis}", names, self.force[i], "force", numbers=signed(parts))
        of: dict[str, Value] = {
            f"R{axis}": (float(c), "force") for axis, c in zip("xyz", self.force, strict=True)
        }
        put(sums, "R", "√(Rx² + Ry² + Rz²)", self.size, "force", of=of)
        of["R"] = (self.size, "force")
        for axis, angle, greek in zip("xyz", self.angles, "αβγ", strict=True):
            if self.size:
                put(sums, greek, f"arccos(R{axis}/R)", float(angle), "angle", of=of)
        self._moment_step(about, say)
        if self.size:
            put(wrench, "h", "R·M/R²", self.pitch, "length")
            for i, axis in enumerate("xyz"):
                put(wrench, f"{axis}0", f"{axis} + (R × M)_{axis}/R²", float(self.axis_point[i]), "length")
        else:
            wrench.say(say("statics.balanced" if self.balanced else "statics.pure_couple"))
        found = [sums, about, wrench]
        vectors = {name: each.vector for name, each in self.system.forces.items()}
        return [*found, *asked_steps(self.system, vectors, self.force, say, len(found))]

    def _moment_step(self, step: Step, say: Say) -> None:
        about = spatial(self.system.about)
        step.say(say("statics.about", place=", ".join(f"{number(c)} m" for c in about)))
        parts = [np.cross(each.place - about, each.vector) for each in self.system.forces.values()]
        parts += [spatial(each) for each in self.system.couples.values()]
        formulas = ("Σ (y·Fz − z·Fy)", "Σ (z·Fx − x·Fz)", "Σ (x·Fy − y·Fx)")
        for i, (axis, formula) in enumerate(zip("xyz", formulas, strict=True)):
            put(step, f"M{axis}", formula, self.moment[i], "torque", numbers=signed([p[i] for p in parts]))


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
    system: ForceSystem, vectors: Mapping[str, Floats], resultant: Floats, say: Say
) -> list[Block]:
    """Components along lines, with what is left across them, and angles between forces."""
    lines, pairs = _asked_for(system, vectors, resultant)
    found = []
    for name, line, of, vector in lines:
        along = float(vector @ line.way)
        rest = vector - along * line.way
        rows = [Row("along", along, "force"), Row("across", float(np.linalg.norm(rest)), "force")]
        rows += [
            Row("part", c, "force", f"{name}.{axis}") for axis, c in zip("xyz", along * line.way, strict=True)
        ]
        if np.any(vector):
            rows.append(Row("to_line", angle_between(vector, line.way), "angle"))
        found.append(Block(f"component {name}", say("statics.component", of=of, name=name), rows))
    angles = [
        Row(name, angle_between(vectors[a], vectors[b]), "angle", f"{name}: {a}, {b}")
        for name, a, b in pairs
        if np.any(vectors[a]) and np.any(vectors[b])
    ]
    return [*found, *([Block("angles", say("statics.angles"), angles)] if angles else [])]


def angle_between(first: Floats, second: Floats) -> float:
    """Angle between two vectors (3,), rad, exact for small ones as well."""
    return math.atan2(float(np.linalg.norm(np.cross(first, second))), float(first @ second))


def asked_steps(
    system: ForceSystem, vectors: Mapping[str, Floats], resultant: Floats, say: Say, count: int
) -> list[Step]:
    """Dot products of what :func:`asked_blocks` shows."""
    lines, pairs = _asked_for(system, vectors, resultant)
    found: list[Step] = []
    for name, line, of, vector in lines:
        step = Step(str(count + len(found) + 1), say("statics.component", of=of, name=name))
        step.law(f"e = ({', '.join(number(float(c)) for c in line.way)})")
        numbers = dot_text(vector, line.way)
        along = float(vector @ line.way)
        put(step, "F_along", f"{of}·e", along, "force", numbers=numbers)
        of_size: dict[str, Value] = {
            of: (float(np.linalg.norm(vector)), "force"),
            "F_along": (along, "force"),
        }
        put(step, "F_across", f"√({of}² − F_along²)", float(np.linalg.norm(vector - along * line.way)), "force",
            of=of_size)  # fmt: skip
        if np.any(vector):
            put(step, "φ", f"arccos(F_along/{of})", angle_between(vector, line.way), "angle", of=of_size)
        found.append(step)
    for name, a, b in pairs:
        if not (np.any(vectors[a]) and np.any(vectors[b])):
            continue
        step = Step(str(count + len(found) + 1), say("statics.angle_of", name=name, first=a, second=b))
        step.law(
            f"{a}·{b} = {dot_text(vectors[a], vectors[b])} = {number(float(vectors[a] @ vectors[b]))}", "N²"
        )
        sizes = "·".join(number(float(np.linalg.norm(vectors[each]))) for each in (a, b))
        numbers = f"arccos({number(float(vectors[a] @ vectors[b]))}/({sizes}))"
        put(step, "φ", f"arccos({a}·{b}/(|{a}|·|{b}|))", angle_between(vectors[a], vectors[b]), "angle",
            numbers=numbers)  # fmt: skip
        found.append(step)
    return found


def dot_text(first: Floats, second: Floats) -> str:
    """A dot product with its numbers: ``3·0.6 + 4·0.8``."""
    parts = [(float(a), float(b)) for a, b in zip(first, second, strict=True) if a and b]
    texts = [f"{number(a)}·{number(b) if b > 0 else f'({number(b)})'}" for a, b in parts]
    return (
        " + ".join(f"({text})" if text.startswith("-") and k else text for k, text in enumerate(texts)) or "0"
    )
