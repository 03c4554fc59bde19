"""The equations of equilibrium of a structure as one linear system A·X = B, assembled from its model."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.equations.matrix import ROUNDING
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import applied_rows


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
