"""Pinned structures: reactions of a model that cannot move, from one linear system A·X = B, or how it can move."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.table import Block, Row
from linkwright.equations.matrix import ROUNDING, system
from linkwright.equations.steps import Step
from linkwright.errors import Finding, ModelError, fault
from linkwright.kinematics.constraint_equations import ConstraintEquations
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import applied_rows
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Result
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

    def blocks(self, translate: Translate) -> list[Block]:
        rows = []
        for joint, link in self.pairs():
            x, y = self.reaction(joint, link)
            label = translate(_("{joint} on {link}", joint=joint, link=link))
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

    def steps(self, translate: Translate) -> list[Step]:
        from linkwright.worked_solutions.solution import worked

        found = list(worked(self.forces, language=language_of(translate)).steps)
        last = max(int(step.number.partition(".")[0]) for step in found)
        return [*found, balance_step(self.balance, str(last + 1), translate)]


def balance_step(balance: Balance | None, number: str, translate: Translate) -> Step:
    """The equations of equilibrium as a step: A·X = B, and X."""
    step = Step(number, translate(_("Equilibrium in matrix form")))
    if balance is None:
        step.note(translate(_("The matrix form is not shown for joints other than pins, guides and welds.")))
        return step
    links = dict.fromkeys(row.rpartition(" ")[0] for row in balance.rows)
    step.note(
        translate(
            _("Rows: ΣFx, ΣFy and ΣM about the first joint of every link ({links}); N, m.", links=", ".join(links))
        )
    )
    acting = ", ".join(f"{name} → {link}" for name, link in zip(balance.names, balance.on, strict=True))
    step.note(
        translate(
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


@dataclass(frozen=True)
class Balance:
    """A (r, n), B (r,) and X (n,) of A·X = B: every moving link's ΣFx, ΣFy (N) and ΣM (N·m) about its first joint.

    ``names``: of the unknowns, ``Cx`` the force of the joint C along x, ``M`` its couple, ``N`` the force across a
    guide, of pins with several links ``bar_2.Cx``; ``on``: the links on which they act, with the opposite on the
    frame or the joint's other link; ``rows``: of the equations; ``units`` of the unknowns. X are the numbers of the
    reaction solver, which take no part in A and B.
    """

    names: tuple[str, ...]
    on: tuple[str, ...]
    rows: tuple[str, ...]
    units: tuple[str, ...]
    a: Floats
    b: Floats
    x: Floats


@dataclass(frozen=True)
class _Unknown:
    """One unknown: what it puts on links at a place, (2,) N and N·m each for a unit of it, and its value."""

    name: str
    unit: str
    value: float
    place: Floats
    on: tuple[tuple[str, Floats, float], ...]


def structure_balance(forces: Forces, index: int = 0) -> Balance | None:
    """The system of a structure, or of a mechanism at rest in one position; None where a pair of another kind than
    pin, guide and weld takes part, whose single force depends on its shape."""
    mechanism = forces.mechanism
    if any(each.higher for each in mechanism.joints.values()):
        return None
    unknowns = [*_of_joints(forces, index), *_of_drivers(forces, index)]
    links = tuple(mechanism.links)
    abouts = {link: _about(forces, link, index) for link in links}
    a, b = np.zeros((3 * len(links), len(unknowns))), np.zeros(3 * len(links))
    for k, link in enumerate(links):
        for j, unknown in enumerate(unknowns):
            for on, force, couple in unknown.on:
                if on == link:
                    arm = unknown.place - abouts[link]
                    a[3 * k : 3 * k + 2, j] += force
                    a[3 * k + 2, j] += arm[0] * force[1] - arm[1] * force[0] + couple
        force, moment = _known(forces, link, index)
        about = abouts[link]
        b[3 * k : 3 * k + 2] = -force
        b[3 * k + 2] = -(moment - about[0] * force[1] + about[1] * force[0])
    rows = tuple(f"{link} {sum_}" for link in links for sum_ in ("ΣFx", "ΣFy", "ΣM"))
    return Balance(
        tuple(each.name for each in unknowns),
        tuple(each.on[0][0] for each in unknowns),
        rows,
        tuple(each.unit for each in unknowns),
        _tidy(a),
        _tidy(b),
        np.array([each.value for each in unknowns]),
    )


def _tidy(values: Floats) -> Floats:
    largest = float(np.abs(values).max(initial=0.0))
    return np.where(np.abs(values) <= ROUNDING * largest, 0.0, values)


def _of_joints(forces: Forces, index: int) -> Iterator[_Unknown]:
    """Forces and couples of joints on all their links but the first, which has them turned round."""
    for name, joint in forces.mechanism.joints.items():
        place = forces.motion.reaction_place(name)[index]
        first = joint.joined[0]
        other = "frame" if "frame" in joint.joined else first
        bodies = [link for link in joint.joined if link != other]
        for link in bodies:
            own = name if len(bodies) == 1 else f"{link}.{name}"
            force = forces.reaction(name, on=link)[index]
            if name in forces.mechanism.guides:
                along = forces.guide_direction(name)[index]
                across = np.array([-along[1], along[0]])
                yield _unknown(f"{own}N", "N", float(force @ across), place, link, other, across, 0.0)
            else:
                for axis, way in (("x", np.array([1.0, 0.0])), ("y", np.array([0.0, 1.0]))):
                    yield _unknown(f"{own}{axis}", "N", float(force @ way), place, link, other, way, 0.0)
            if joint.couples:
                couple = float(forces.couple(name, on=link)[index])
                yield _unknown(f"{own}M", "N·m", couple, place, link, other, np.zeros(2), 1.0)


def _unknown(
    name: str, unit: str, value: float, place: Floats, link: str, other: str, way: Floats, couple: float
) -> _Unknown:
    """An unknown on a link, and turned round on the other one."""
    return _Unknown(name, unit, value, place, ((link, way, couple), (other, -way, -couple)))


def _of_drivers(forces: Forces, index: int) -> Iterator[_Unknown]:
    """Efforts of drivers."""
    for name, driver in forces.mechanism.drivers.items():
        joint, value = forces.mechanism.joints[driver.joint], float(forces.driver_effort(name)[index])
        place = forces.motion.reaction_place(driver.joint)[index]
        turning = joint.coordinate == "turn"
        way = np.zeros(2) if turning else forces.guide_direction(driver.joint)[index]
        unit, couple = ("N·m", 1.0) if turning else ("N", 0.0)
        yield _unknown(name, unit, value, place, driver.link, driver.relative_to, way, couple)


def _about(forces: Forces, link: str, index: int) -> Floats:
    """The point of a link about which its moments are taken: its first joint."""
    return next(
        np.asarray(forces.motion.reaction_place(joint.name)[index])
        for joint in forces.mechanism.joints.values()
        if link in joint.joined
    )


def _known(forces: Forces, link: str, index: int) -> tuple[Floats, float]:
    """Loads and weight of a link at rest, N, and their moment about the frame's origin, N·m."""
    fx, fy, moment = (float(each[index]) for each in forces.fetch(applied_rows(link)))
    weight = forces.mechanism.links[link].mass * np.asarray(forces.mechanism.gravity)
    centre = forces.motion.link(link).centre.position[index]
    turning = moment + float(centre[0] * weight[1] - centre[1] * weight[0])
    return np.array([fx, fy]) + weight, turning
