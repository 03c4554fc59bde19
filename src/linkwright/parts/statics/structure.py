"""Pinned structures: the reactions of a model that cannot move, by the solver of mechanisms, or how it can move."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.rows import Block, Row
from linkwright.equations.matrix import system
from linkwright.equations.steps import Step
from linkwright.errors import Finding, ModelError, fault
from linkwright.kinematics.constraint_equations import ConstraintEquations
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Result
from linkwright.parts.statics.balance import Balance, structure_balance
from linkwright.parts.statics.body import describe
from linkwright.topology import StructureError, structure
from linkwright.words import Message, Translate, _, language_of

#: Starts of the search for a position, and the gap below which the joints close.
STARTS, CLOSED = 24, 1e-10


def equilibrium(mechanism: Mechanism) -> StructureForces:
    """Reactions of all joints of a structure at rest; with drivers, in the first position of the cycle.

    Raises ModelError, with the motion in words, where a structure without driver can move; StructureError where it
    is held more often than statics can tell.
    """
    if not mechanism.drivers:
        findings = _freedoms(mechanism)
        if findings:
            raise ModelError(findings)
    return StructureForces(solve_forces(solve_motion(mechanism, steps=1), static=True))


def _freedoms(mechanism: Mechanism) -> list[Finding]:
    """One finding for each way in which the structure can move; raises StructureError where counting refuses."""
    try:
        if structure(mechanism).mobility <= 0:
            return []
    except StructureError:
        pass
    system = ConstraintEquations(mechanism)
    place = _closed(system)
    if place is None:
        structure(mechanism)
        return []
    _unused, values, rows = np.linalg.svd(system.jacobian(place))
    rank = int((values > 1e-8 * values[0]).sum())
    return [
        fault(
            "structure_moves",
            "links",
            _("the structure can move: {how}"),
            _("add a bar or a support against this motion, or a driver that sets it"),
            how=_motion(system, row),
        )
        for row in rows[rank:]
    ]


def _closed(system: ConstraintEquations) -> Floats | None:
    """Coordinates in which all joints close, found from several starts; None where none was found."""
    from scipy.optimize import least_squares

    generator = np.random.default_rng(1)
    for _unused in range(STARTS):
        start = generator.uniform(-1.0, 1.0, system.freedoms)
        found = least_squares(system.residual, start, jac=system.jacobian, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if np.abs(found.fun).max() < CLOSED:
            return np.asarray(found.x)
    return None


def _motion(system: ConstraintEquations, motion: Floats) -> tuple[Message, ...]:
    """What every moving link does in a small motion."""
    found = []
    for i, link in enumerate(system.links):
        part = motion[3 * i : 3 * i + 3]
        if np.abs(part).max() > 1e-6:
            how = describe(np.where(np.abs(part) < 1e-9, 0.0, part), system.size, planar=True)
            slides = how.code == "statics.slides"
            found.append(
                _("{link} slides", code="statics.link_slides", link=link)
                if slides
                else _("{link} turns", code="statics.link_turns", link=link)
            )
    return tuple(found)


@dataclass(frozen=True, repr=False)
class StructureForces(Result):
    """Reactions at every joint of a structure; ``forces`` is the full result of the reaction solver."""

    forces: Forces

    @property
    def title(self) -> str:
        return self.forces.mechanism.name

    def reaction(self, joint: str, on: str) -> Floats:
        """Force (2,) N that a joint exerts on a link."""
        return np.asarray(self.forces.reaction(joint, on=on)[0])

    def pairs(self) -> list[tuple[str, str]]:
        """Joints and links on which their reactions are listed: every moving link that they touch."""
        joints = self.forces.mechanism.joints
        return [(name, link) for name, joint in joints.items() for link in joint.joined if link != "frame"]

    def blocks(self, say: Translate) -> list[Block]:
        rows = []
        for joint, link in self.pairs():
            x, y = self.reaction(joint, link)
            label = say(_("{joint} on {link}", joint=joint, link=link))
            rows += [
                Row("reaction", float(x), "force", f"{label} Fx"),
                Row("reaction", float(y), "force", f"{label} Fy"),
            ]
            couple = float(self.forces.couple(joint, on=link)[0])
            if abs(couple) > 1e-9:
                rows.append(Row("couple", couple, "torque", f"{label} M"))
        for driver in self.forces.mechanism.drivers:
            rows.append(Row("effort", float(self.forces.driver_effort(driver)[0]), "torque", driver))
        gaps = self.forces.balance_residual
        self.forces.solver.programs.checks.require_balance(gaps, self.forces.rows, self.forces.motion)
        gap = float(gaps.max())
        return [
            Block(
                "reactions",
                _("Reactions"),
                rows,
                (_("largest gap in the balance of a link: {gap} N", gap=f"{gap:.1e}"),),
            )
        ]

    @cached_property
    def balance(self) -> Balance | None:
        """The equations of equilibrium as A·X = B with the names of rows and unknowns; None where a pair other than
        pin, guide and weld takes part."""
        return structure_balance(self.forces)

    def steps(self, say: Translate) -> list[Step]:
        from linkwright.worked_solutions.solution import worked

        found = list(worked(self.forces, language=language_of(say)).steps)
        last = max(int(step.number.partition(".")[0]) for step in found)
        return [*found, balance_step(self.balance, str(last + 1), say)]


def balance_step(balance: Balance | None, number: str, say: Translate) -> Step:
    """The equations of equilibrium as a step: A·X = B, and X."""
    step = Step(number, say(_("Equilibrium in matrix form")))
    if balance is None:
        step.say(say(_("The matrix form is not shown for joints other than pins, guides and welds.")))
        return step
    links = dict.fromkeys(row.rpartition(" ")[0] for row in balance.rows)
    step.say(
        say(_("Rows: ΣFx, ΣFy and ΣM about the first joint of every link ({links}); N, m.", links=", ".join(links)))
    )
    acting = ", ".join(f"{name} → {link}" for name, link in zip(balance.names, balance.on, strict=True))
    step.say(
        say(
            _(
                "Unknowns X with the links on which they act: {names}; on the joint's other link "
                "they act the opposite way.",
                names=acting,
            )
        )
    )
    step.items.append(system(balance.a, list(balance.names), balance.b, balance.rows))
    for name, unit, value in zip(balance.names, balance.units, balance.x.tolist(), strict=True):
        step.put(name, "", value, "force" if unit == "N" else "torque")
    return step
