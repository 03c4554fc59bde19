"""Systems of forces in the plane and in space: resultant, moment, wrench, equilibrant."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.errors import Finding
from linkwright.fields.base import Place, Quantities, Quantity, Reader, given
from linkwright.fields.nodes import Node
from linkwright.parts.base import Block, Problem, Result, Row, Value, fault, number, put, shown, signed
from linkwright.parts.fields import Either, Named, Table
from linkwright.words import Say
from linkwright.worked.page import Step
from linkwright.worked.written import measured

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
class Force:
    """A force: its components ``force`` (2 or 3) N, or its ``size`` N ``along`` a direction; ``at`` (2 or 3) m."""

    force: tuple[float, ...] = given(Components("force", doc="components"), ())
    size: float | None = given(Quantity("force", doc="magnitude, with along"), None)
    along: tuple[float, ...] = given(
        Components("dimensionless", doc="direction of the force, any length"), ()
    )
    at: tuple[float, ...] = given(
        Components("length", doc="point of application, the origin unless given"), (0.0, 0.0)
    )

    @property
    def vector(self) -> Floats:
        """Components, (3,) N."""
        if self.size is None:
            return spatial(self.force)
        direction = spatial(self.along)
        return self.size * direction / np.linalg.norm(direction)

    @property
    def place(self) -> Floats:
        """Point of application, (3,) m."""
        return spatial(self.at)

    def findings(self, key: str) -> list[Finding]:
        """What is wrong with it."""
        found = []
        if (self.size is None) == (not self.force) or (self.size is not None) != bool(self.along):
            found.append(fault("statics.force_form", key))
        elif self.along and not any(self.along):
            found.append(fault("statics.no_direction", f"{key}.along"))
        for name, vector in (("force", self.force), ("along", self.along), ("at", self.at)):
            if vector and len(vector) not in (2, 3):
                found.append(fault("statics.components", f"{key}.{name}", count=len(vector)))
        return found


@dataclass(frozen=True)
class ForceField(Either):
    """A force as ``[Fx, Fy, Fz]``, or as a table with its place, or with its size and direction."""

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        found = super().read(reader, node, place, given)
        return Force(force=found) if isinstance(found, tuple) else found


FORCES = Named(
    ForceField(Components("force", form="[0 N, 40 N, 60 N]"), Table.of(Force)),
    "force",
    doc="forces by name: [Fx, Fy, Fz], or {size: …, along: […], at: […]}",
)
COUPLES = Named(
    Components("torque"), "couple", doc="couples by name: [Mx, My, Mz]; in the plane [0 N·m, 0 N·m, M]"
)


def direction_angles(vector: Floats) -> Floats:
    """Angles (3,) rad of a vector against the axes x, y, z; NaN for a vector without direction."""
    size = float(np.linalg.norm(vector))
    return np.arccos(np.clip(vector / size, -1.0, 1.0)) if size else np.full(3, np.nan)


@dataclass(frozen=True)
class ForceSystem(Problem):
    """Forces (N) at points (m) and couples (N·m); moments are taken ``about`` a point (m)."""

    kind: ClassVar[str] = "forces"
    forces: Mapping[str, Force] = given(FORCES, dict)
    couples: Mapping[str, tuple[float, ...]] = given(COUPLES, dict)
    about: tuple[float, ...] = given(
        Components("length", doc="point about which moments are taken, the origin unless given"),
        (0.0, 0.0, 0.0),
    )
    name: str = ""
    source: str = ""

    def findings(self) -> list[Finding]:
        found = [each for name, one in self.forces.items() for each in one.findings(f"forces.{name}")]
        if not self.forces and not self.couples:
            found.append(fault("statics.no_forces", "forces"))
        return found

    def solve(self) -> Resultant:
        """The resultant. Raises ModelError with all findings."""
        self.require()
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
        return blocks

    def steps(self, say: Say) -> list[Step]:
        sums, about, wrench = (Step(str(i + 1), say(f"statics.step_{i + 1}")) for i in range(3))
        for name, each in self.system.forces.items():
            if each.size is not None:
                unit = spatial(each.along) / np.linalg.norm(spatial(each.along))
                sums.law(f"{name} = {measured(shown(each.size, 'force'))}·({', '.join(number(u) for u in unit)})")
        for i, axis in enumerate("xyz"):
            parts = [each.vector[i] for each in self.system.forces.values()]
            names = " + ".join(f"{name}{axis}" for name in self.system.forces)
            put(sums, f"R{axis}", names, self.force[i], "force", numbers=signed(parts))
        of: dict[str, Value] = {f"R{axis}": (float(c), "force") for axis, c in zip("xyz", self.force, strict=True)}
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
        return [sums, about, wrench]

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
