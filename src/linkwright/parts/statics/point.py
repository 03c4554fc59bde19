"""Equilibrium of a point: unknown magnitudes of forces along known directions, in the plane or in space."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.errors import Finding
from linkwright.parts.base import Block, Result, Row, fault, number, put, signed
from linkwright.parts.statics.forces import ForceSystem, asked_blocks, asked_steps
from linkwright.words import Say
from linkwright.worked.matrix import Matrices
from linkwright.worked.page import Step

#: Singular values, and sums that stay, below this share of the largest count as zero.
ZERO = 1e-10


def point_findings(system: ForceSystem) -> list[Finding]:
    """Why equilibrium cannot tell the unknown magnitudes of a system."""
    places = [each.place for each in system.forces.values()]
    if system.couples or any(not np.array_equal(each, places[0]) for each in places):
        return [fault("statics.one_point", "couples" if system.couples else "forces")]
    a, b, names = _matrix(system)
    sizes = np.linalg.svd(a, compute_uv=False)
    rank = int((sizes > ZERO * sizes[0]).sum())
    if rank < len(names):
        return [fault("statics.point_unknown", "forces", count=len(names), equations=rank, names=names)]
    found = np.linalg.lstsq(a, b, rcond=None)[0]
    if np.abs(a @ found - b).max() > ZERO * max(float(np.abs(b).max()), float(np.abs(found).max())):
        left = b - a @ found
        return [
            fault(
                "statics.point_open",
                "forces",
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

    area: ClassVar[str] = "statics"
    system: ForceSystem

    @property
    def matrix(self) -> tuple[Floats, Floats]:
        """A (2 or 3, n) and B, N."""
        a, b, _ = _matrix(self.system)
        return a, b

    @cached_property
    def magnitudes(self) -> dict[str, float]:
        """Unknown magnitudes by name, N."""
        a, b, names = _matrix(self.system)
        found = np.linalg.lstsq(a, b, rcond=None)[0]
        largest = max(float(np.abs(found).max()), float(np.abs(b).max()))
        return dict(zip(names, np.where(np.abs(found) < ZERO * largest, 0.0, found).tolist(), strict=True))

    @property
    def vectors(self) -> dict[str, Floats]:
        """All forces by name, (3,) N."""
        found = self.magnitudes
        return {
            name: found[name] * each.unit if name in found else each.vector
            for name, each in self.system.forces.items()
        }

    def blocks(self, say: Say) -> list[Block]:
        rows = [Row(name, value, "force", name) for name, value in self.magnitudes.items()]
        remarks = [say("statics.against", name=name) for name, value in self.magnitudes.items() if value < 0]
        parts = [
            Row("component", float(c), "force", f"{name}.{axis}")
            for name in self.magnitudes
            for axis, c in zip("xyz"[: len(self.matrix[1])], self.vectors[name], strict=False)
        ]
        found = [Block("magnitudes", say("statics.magnitudes"), rows, remarks)]
        found.append(Block("components", say("statics.their_components"), parts))
        return [*found, *asked_blocks(self.system, self.vectors, np.zeros(3), say)]

    def steps(self, say: Say) -> list[Step]:
        a, b = self.matrix
        directions, sums, solved = (Step(str(i + 1), say(f"statics.point_{i + 1}")) for i in range(3))
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
        solved.say(say("statics.matrix"))
        solved.items.append(
            Matrices(("A", a), (("X", list(self.magnitudes)), ("B", b[:, None])), tuple(rows)).written()
        )
        for name, value in self.magnitudes.items():
            put(solved, name, "", value, "force")
            if value < 0:
                solved.say(say("statics.against", name=name))
        found = [directions, sums, solved]
        return [*found, *asked_steps(self.system, self.vectors, np.zeros(3), say, len(found))]


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
