"""Every link with its loads: Newton's and Euler's equations put together again from the printed results alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.data import locked
from linkwright.core.outputs import row_name, row_names
from linkwright.formula.trace import Scalar
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.solver import ForceSolver


def balance_residual(forces: Forces) -> Floats:
    """Largest gap of any link's balance, (n,) N: |Σ F - m a|, and |Σ M - J α| over the mechanism's size.

    Joint forces, couples, driver efforts, loads and weights against mass times acceleration of the mass
    centre, moments about the frame's origin: nothing of the force analysis but its results enters.
    """
    mechanism = forces.mechanism
    size = max(
        abs(c) for link in (mechanism.frame, *mechanism.links.values()) for p in link.points.values() for c in p
    )
    worst = np.zeros(forces.steps)
    forces.motion.evaluate_together(motion_outputs(forces))
    forces.fetch(load_outputs(forces))
    for link in mechanism.links:
        force, moment = _joints(forces, link)
        for driven in (_drivers(forces, link), _loads(forces, link), _inertia(forces, link)):
            force, moment = force + driven[0], moment + driven[1]
        gap = np.maximum(np.hypot(force[:, 0], force[:, 1]), np.abs(moment) / (size or 1.0))
        worst = np.maximum(worst, gap)
    return locked(worst)


Pair = tuple[Floats, Floats]


def motion_outputs(forces: Forces) -> Iterator[str]:
    """Names of what the balance takes from the motion."""
    mechanism = forces.mechanism
    yield from (name for joint in mechanism.joints for name in row_names("reaction_place", joint))
    for link in mechanism.links:
        for kind in ("position",) if forces.static else ("position", "acceleration"):
            yield from row_names(kind, f"{link}.@centre")


def load_outputs(forces: Forces) -> tuple[str, ...]:
    """Names of what the balance takes from the loads."""
    return tuple(name for link in forces.mechanism.links for name in applied_rows(link))


def applied_rows(link: str) -> tuple[str, str, str]:
    """Names of the force (x, y) and the moment about the frame's origin of all loads on a link."""
    return (*row_names("applied", link), row_name("applied", link, "m"))


def _cross(place: Floats, force: Floats) -> Floats:
    return place[:, 0] * force[:, 1] - place[:, 1] * force[:, 0]


def _nothing(forces: Forces) -> Pair:
    return np.zeros((forces.steps, 2)), np.zeros(forces.steps)


def _joints(forces: Forces, link: str) -> Pair:
    total, moment = _nothing(forces)
    for name, joint in forces.mechanism.joints.items():
        if link not in joint.joined:
            continue
        force = forces.reaction(name, on=link)
        total = total + force
        moment = moment + _cross(forces.motion.reaction_place(name), force) + forces.couple(name, on=link)
    return total, moment


def driver_wrenches(forces: Forces, link: str) -> Iterator[tuple[str, Floats, Floats]]:
    """Drivers of a link, or against it, with the force (n, 2) N in frame axes, at the driven joint, and the couple
    (n,) N·m that they exert on it; one of both is zero."""
    mechanism = forces.mechanism
    for name, driver in mechanism.drivers.items():
        if link not in (driver.link, driver.relative_to):
            continue
        effort = forces.driver_effort(name) * (1.0 if link == driver.link else -1.0)
        force, couple = _nothing(forces)
        if mechanism.joints[driver.joint].coordinate == "turn":
            yield name, force, effort
        else:
            yield name, effort[:, None] * forces.guide_direction(driver.joint), couple


def _drivers(forces: Forces, link: str) -> Pair:
    total, moment = _nothing(forces)
    for name, force, couple in driver_wrenches(forces, link):
        total, moment = total + force, moment + couple
        if force.any():
            place = forces.motion.reaction_place(forces.mechanism.drivers[name].joint)
            moment = moment + _cross(place, force)
    return total, moment


def _loads(forces: Forces, link: str) -> Pair:
    """Loads and friction on a link, about the frame's origin."""
    fx, fy, moment = forces.fetch(applied_rows(link))
    return np.stack([fx, fy], axis=1), moment


def _inertia(forces: Forces, link: str) -> Pair:
    part, state = forces.mechanism.links[link], forces.motion.link(link)
    gravity = np.asarray(forces.mechanism.gravity)
    acceleration = np.zeros((forces.steps, 2)) if forces.static else state.centre.acceleration
    force = part.mass * (gravity - acceleration)
    turning = 0.0 if forces.static else part.inertia * state.angular_acceleration
    return force, _cross(state.centre.position, force) - turning


@dataclass(frozen=True)
class AppliedWrench:
    """What a load or the friction of a joint does to one link: force (N) at a place (m), both in frame axes, and
    torque (N·m); ``name``: of the load, or of the row that holds the friction."""

    name: str
    link: str
    force: tuple[float, float]
    place: tuple[float, float]
    torque: float

    @property
    def idle(self) -> bool:
        """Whether it does nothing."""
        return not (any(self.force) or self.torque)


def applied_wrenches(forces: Forces, index: int) -> list[AppliedWrench]:
    """All of them at one position, in the order of the model; those on the frame among them."""
    order = [(name, w.link) for name, group in forces.solver.forces.wrenches.items() for w in group]
    if not order:
        return []
    rows = forces.evaluate_traced(_wrench_parts)[:, index].reshape(-1, 5).tolist()
    return [
        AppliedWrench(name, link, (fx, fy), (px, py), torque)
        for (name, link), (fx, fy, px, py, torque) in zip(order, rows, strict=True)
    ]


def _wrench_parts(solver: ForceSolver) -> dict[str, Scalar]:
    """Force, place and torque of every applied wrench."""
    outputs: dict[str, Scalar] = {}
    for name, group in solver.forces.wrenches.items():
        for i, w in enumerate(group):
            parts = (w.force.x, w.force.y, w.place.x, w.place.y, w.torque)
            outputs |= {f"{name}#{i}#{j}": part for j, part in enumerate(parts)}
    return outputs
